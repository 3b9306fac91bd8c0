// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/assembly.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "algorithm/cavity_walls.h"
#include "algorithm/cell_center.h"
#include "algorithm/host_transmissibility.h"

namespace wellknit {

namespace {

constexpr double open_limit = 1e-9;  ///< |sum of area vectors| over the sum of areas, as the mesh check has it

class Assembler {
 public:
  Assembler(const CornerPointGrid& grid, const HostMesh& host, const std::vector<TransitionMesh>& cavities)
      : grid_(grid), host_(host), cavities_(cavities), vertex_of_host_(host.vertices.size()) {}

  Assembly build() {
    mark_removed();
    walls_ = find_cavity_walls(host_, cavities_, is_removed_);
    add_host_cells();
    for (const TransitionMesh& c : cavities_) add_transition_cells(c);
    for (const TransitionMesh& c : cavities_)
      for (const Tube& t : c.cavity.tubes) add_radial_cells(t);
    add_host_faces();
    out_.first_tube.push_back(0);
    for (const TransitionMesh& c : cavities_) out_.first_tube.push_back(out_.first_tube.back() + c.cavity.tubes.size());
    for (std::size_t c = 0; c < cavities_.size(); ++c) add_cavity(c, out_.first_tube[c]);
    set_made_geometry();
    out_.mesh.source_dimensions = grid_.dimensions;
    out_.mesh.mapaxes = grid_.mapaxes;
    out_.mesh.source_units = grid_.units;
    return std::move(out_);
  }

 private:
  using Loop = std::vector<VertexId>;

  void mark_removed() {
    is_removed_.resize(host_.volume.size(), 0);
    for (const TransitionMesh& c : cavities_)
      for (const HostCellId cell : c.cavity.removed_cells) is_removed_[cell] = 1;
  }

  CellId add_cell(CellKind kind, const Vec3& center) {
    Cells& cells = out_.mesh.cells;
    cells.kind.push_back(kind);
    cells.centroid.push_back(Vec3::Zero());
    cells.volume.push_back(0.0);
    cells.depth.push_back(center.z());
    cells.source_cell.push_back({});
    cells.well.push_back({});
    cells.radial_index.push_back({});
    return cells.center.push_back(center);
  }

  void add_host_cells() {
    out_.cell_of.resize(host_.volume.size());
    for (std::size_t c = 0; c < host_.volume.size(); ++c) {
      const HostCellId from(c);
      if (!host_.is_cell(from) || is_removed_[from] != 0) continue;
      const CellKind kind = c < host_.source_count() ? CellKind::host : CellKind::refined;
      const CellId cell = add_cell(kind, host_cell_center(host_, from));
      out_.cell_of[from] = cell;
      out_.host_cell.push_back(from);
      out_.mesh.cells.source_cell[cell] = host_.source_of(from);
      out_.mesh.cells.volume[cell] = host_.volume_of_sources(from);
    }
  }

  void add_transition_cells(const TransitionMesh& c) {
    out_.first_transition_cell.push_back(static_cast<std::int64_t>(out_.mesh.cells.size()));
    for (const Vec3& center : c.centers) add_cell(CellKind::transition, center);
  }

  void add_radial_cells(const Tube& tube) {
    const RadialMesh& m = tube.real;
    out_.tubes.push_back({&tube, CellId(out_.mesh.cells.size())});
    for (int k = 0; k < m.segments; ++k) {
      const bool has_spheres = !tube.layered && spheres_fit(m, k);
      for (int s = 0; s < m.sectors; ++s)
        for (int r = 0; r < m.rings; ++r) {
          const CellId cell =
              add_cell(CellKind::radial, has_spheres ? sphere_center(m, k, s, r) : middle_center(m, k, s, r));
          out_.mesh.cells.well[cell] = WellId(tube.well);
          out_.mesh.cells.radial_index[cell] = {k, s, r};
        }
    }
  }

  /// Places in one sector's trapezoid at a station: the inner and outer chords' middles, and between them the centre of
  /// the circle through its four corners where that lies inside, else half way (method.md §3).
  struct Trapezoid {
    Vec3 low;
    Vec3 high;
    Vec3 center;
  };

  static Trapezoid trapezoid(const RadialMesh& m, int station, int s, int r) {
    const double half_angle = std::numbers::pi / m.sectors;
    const Vec3& axis = m.axis[static_cast<std::size_t>(station)];
    const double inner = (m.point(station, r, s) - axis).norm();
    const double outer = (m.point(station, r + 1, s) - axis).norm();
    const bool has_circumcentre = outer / inner * std::cos(2.0 * half_angle) > 1.02;
    const double at =
        has_circumcentre ? 0.5 * (inner + outer) / std::pow(std::cos(half_angle), 2) : 0.5 * (inner + outer);
    Trapezoid t;
    t.low = 0.5 * (m.point(station, r, s) + m.point(station, r, s + 1));
    t.high = 0.5 * (m.point(station, r + 1, s) + m.point(station, r + 1, s + 1));
    t.center = t.low + (at - inner) / (outer - inner) * (t.high - t.low);
    return t;
  }

  static Vec3 middle_center(const RadialMesh& m, int k, int s, int r) {
    return 0.5 * (trapezoid(m, k, s, r).center + trapezoid(m, k + 1, s, r).center);
  }

  /// Centre of the sphere through the eight vertices of a cell.
  static Vec3 sphere_center(const RadialMesh& m, int k, int s, int r) {
    const Vec3& axis = m.axis[static_cast<std::size_t>(k)];
    const Vec3 near = trapezoid(m, k, s, r).center;
    const Vec3 normal = (m.point(k, m.rings, 0) - axis).cross(m.point(k, m.rings, 1) - axis).normalized();
    const Vec3 chord = m.axis[static_cast<std::size_t>(k) + 1] - axis;
    return near + (axis + 0.5 * chord - near).dot(chord) / normal.dot(chord) * normal;
  }

  /// In a bend the spheres' centres move out of thin rings. They are used for all cells of a segment or for none: a
  /// mixture would turn the lines between centres.
  static bool spheres_fit(const RadialMesh& m, int k) {
    for (int s = 0; s < m.sectors; ++s)
      if (!spheres_fit_sector(m, k, s)) return false;
    return true;
  }

  static bool spheres_fit_sector(const RadialMesh& m, int k, int s) {
    constexpr double margin = 0.1;  // of the ring's width
    for (int r = 0; r < m.rings; ++r) {
      const Trapezoid one = trapezoid(m, k, s, r);
      const Trapezoid two = trapezoid(m, k + 1, s, r);
      const Vec3 low = 0.5 * (one.low + two.low);
      const Vec3 across = 0.5 * (one.high + two.high) - low;
      const double at = (sphere_center(m, k, s, r) - low).dot(across) / across.squaredNorm();
      if (at < margin || at > 1.0 - margin) return false;
    }
    return true;
  }

  VertexId host_vertex(VertexId v) {
    VertexId& to = vertex_of_host_[v];
    if (!to.is_valid()) {
      to = out_.mesh.vertices.push_back(host_.vertices[v]);
      if (!walls_.edges.empty()) {
        host_vertex_of_.resize(out_.mesh.vertices.size());
        host_vertex_of_[to] = v;
      }
    }
    return to;
  }

  void add_face(std::span<const VertexId> loop, CellId from, CellId to, const FaceInfo& info) {
    out_.mesh.faces.add(loop, from, to);
    out_.face_info.push_back(info);
  }

  void add_host_faces() {
    Loop loop;
    for (std::size_t index = 0; index < host_.faces.size(); ++index) {
      const FaceId f(index);
      const auto [a, b] = host_.faces.cells[f];
      const CellId first = out_.cell_of[a];
      const CellId second = b.is_valid() ? out_.cell_of[b] : no_cell;
      // Faces at removed cells come with the cavity; faces of removed cells alone are gone.
      const bool is_beside_removed = is_removed_[a] != 0 || (b.is_valid() && is_removed_[b] != 0);
      if ((is_beside_removed && walls_.has(f)) || (!first.is_valid() && !second.is_valid())) continue;
      loop.clear();
      for (const VertexId v : host_.faces.loop(f)) loop.push_back(host_vertex(v));
      FaceInfo info = host_face_info(f, a, b);
      info.host_face = f;
      if (first.is_valid())
        add_face(loop, first, second, info);
      else  // no boundary face of the cavity stands for it: the outside of what is left
        add_face(Loop(loop.rbegin(), loop.rend()), second, no_cell, info);
    }
  }

  [[nodiscard]] FaceInfo host_face_info(FaceId f, HostCellId one, HostCellId other) const {
    FaceInfo info;
    info.role = FaceRole::host;
    info.axis = host_.faces.axis[f];
    info.is_fault = host_.faces.is_fault[f];
    info.is_pinch = host_.faces.is_pinch[f];
    info.host = {host_.source_of(one), other.is_valid() ? host_.source_of(other) : HostCellId{}};
    return info;
  }

  /// Mesh vertices of a cavity, made when first used.
  struct CavityVertices {
    std::vector<VertexId> of_diagram;
    std::vector<std::vector<VertexId>> of_tube;  ///< per tube of the cavity, per point
  };

  VertexId tube_vertex(const TransitionMesh& c, std::size_t tube, std::size_t point, CavityVertices& vertices) {
    VertexId& v = vertices.of_tube[tube][point];
    if (!v.is_valid()) v = out_.mesh.vertices.push_back(c.cavity.tubes[tube].real.points[point]);
    return v;
  }

  VertexId diagram_vertex(const TransitionMesh& c, std::int32_t index, CavityVertices& vertices) {
    const auto i = static_cast<std::size_t>(index);
    VertexId& v = vertices.of_diagram[i];
    if (v.is_valid()) return v;
    if (i >= c.cavity.vertices.size()) {
      v = out_.mesh.vertices.push_back(c.vertices[i]);
    } else {
      const CavityVertex& from = c.cavity.vertices[i];
      v = from.is_host ? host_vertex(from.host) : tube_vertex(c, from.tube, from.tube_point, vertices);
    }
    return v;
  }

  void add_cavity(std::size_t index, std::size_t first_tube) {
    const TransitionMesh& c = cavities_[index];
    CavityVertices vertices;
    vertices.of_diagram.resize(c.vertices.size());
    for (const Tube& t : c.cavity.tubes) vertices.of_tube.emplace_back(t.real.points.size());
    Loop loop;
    for (std::size_t f = 0; f < c.faces.size(); ++f) {
      loop.clear();
      for (const auto v : c.faces[f].loop) loop.push_back(diagram_vertex(c, v, vertices));
      if (!walls_.edges.empty()) divide_edges(loop);
      add_diagram_face(index, f, first_tube, loop);
    }
    for (std::size_t t = 0; t < c.cavity.tubes.size(); ++t) add_tube_faces(c, t, out_.tubes[first_tube + t], vertices);
  }

  /// Puts the host's vertices into a loop's edges.
  void divide_edges(Loop& loop) {
    Loop divided;
    for (std::size_t n = 0; n < loop.size(); ++n) {
      const VertexId a = loop[n];
      const VertexId b = loop[n + 1 == loop.size() ? 0 : n + 1];
      divided.push_back(a);
      const auto known = [&](VertexId v) {
        return host_vertex_of_.size() > v.index() ? host_vertex_of_[v] : VertexId{};
      };
      for (const VertexId v : walls_.between(known(a), known(b))) divided.push_back(host_vertex(v));
    }
    loop = std::move(divided);
  }

  /// The host's faces in the place of a face of the cavity, and where they leave a part of it open that part.
  void add_wall(std::size_t index, CellId cell, const CavityWall& wall, const Loop& outline) {
    LoopRemainder rest;
    rest.add(outline);
    Loop loop;
    for (const FaceId f : wall.faces) {
      const auto [a, b] = host_.faces.cells[f];
      const bool is_first = a == wall.removed;  // the normal points away from it
      const HostCellId beyond = is_first ? b : a;
      loop.clear();
      for (const VertexId v : host_.faces.loop(f)) loop.push_back(host_vertex(v));
      if (!is_first) std::reverse(loop.begin(), loop.end());
      rest.remove(loop);
      CellId other = beyond.is_valid() ? out_.cell_of[beyond] : no_cell;
      if (const auto shared = walls_.shared.find(f); shared != walls_.shared.end()) {
        const auto& [cavity, number] = shared->second[is_first ? 1 : 0];
        if (cavity < index) continue;  // made with that one
        other = cell_at_wall(cavity, number);
      }
      add_face(loop, cell, other, host_face_info(f, wall.removed, beyond));
    }
    FaceInfo info;
    info.role = FaceRole::host;
    for (const Loop& open : rest.loops()) add_face(open, cell, no_cell, info);
  }

  /// The transition cell behind a boundary face of a cavity.
  [[nodiscard]] CellId cell_at_wall(std::size_t cavity, std::size_t boundary_face) {
    cells_at_walls_.resize(cavities_.size());
    auto& cells = cells_at_walls_[cavity];
    if (cells.empty()) {
      const TransitionMesh& c = cavities_[cavity];
      cells.resize(c.cavity.faces.size());
      for (std::size_t f = 0; f < c.faces.size(); ++f)
        if (c.boundary_face[f] >= 0)
          cells[static_cast<std::size_t>(c.boundary_face[f])] =
              CellId(out_.first_transition_cell[cavity] + c.faces[f].cell);
    }
    return cells[boundary_face];
  }

  void add_diagram_face(std::size_t index, std::size_t f, std::size_t first_tube, const Loop& loop) {
    const TransitionMesh& c = cavities_[index];
    const DiagramFace& face = c.faces[f];
    const auto cell = [&](std::int32_t site) { return CellId(out_.first_transition_cell[index] + site); };
    FaceInfo info;
    CellId other = no_cell;
    if (face.other_kind == DiagramFace::Other::inner) {
      other = cell(face.other);
    } else if (face.other_kind == DiagramFace::Other::outer) {
      const BoundaryFace& b = c.cavity.faces[static_cast<std::size_t>(c.boundary_face[f])];
      if (b.kind == BoundaryFaceKind::host) {
        const CavityWall* wall = walls_.find(index, static_cast<std::size_t>(c.boundary_face[f]));
        if (wall != nullptr && !wall->is_plain) return add_wall(index, cell(face.cell), *wall, loop);
        const HostCellId outside = wall != nullptr ? beyond(*wall) : beside(c.cavity, b);
        other = outside.is_valid() ? out_.cell_of[outside] : no_cell;
        info = wall_info(b, outside, wall);
      } else {
        info.role = b.kind == BoundaryFaceKind::lateral ? FaceRole::lateral : FaceRole::axial;
        info.circle = b.radial.ring + 1;
        if (b.radial.ring >= 0)
          other = out_.tubes[first_tube + b.tube].cell(b.radial.segment, b.radial.sector, b.radial.ring);
      }
    }
    add_face(loop, cell(face.cell), other, info);
  }

  /// The cell on the other side of a plain wall.
  [[nodiscard]] HostCellId beyond(const CavityWall& wall) const {
    const auto [a, b] = host_.faces.cells[wall.faces.front()];
    return a == wall.removed ? b : a;
  }

  /// The cell on the other side of a boundary face that the host has no face for: the one with the same corners. Where
  /// a removed cell is inactive and stands on a fault, the cell beyond may lie wholly above or below it.
  [[nodiscard]] HostCellId beside(const Cavity& cavity, const BoundaryFace& b) const {
    if (!b.outside_cell.is_valid()) return {};
    const auto corners = host_.corners_of(b.outside_cell);
    const bool is_there = std::all_of(b.loop.begin(), b.loop.end(), [&](std::int32_t v) {
      const VertexId corner = cavity.vertices[static_cast<std::size_t>(v)].host;
      return std::find(corners.begin(), corners.end(), corner) != corners.end();
    });
    return is_there ? b.outside_cell : HostCellId{};
  }

  [[nodiscard]] FaceInfo wall_info(const BoundaryFace& b, HostCellId outside, const CavityWall* wall) const {
    FaceInfo info;
    info.role = FaceRole::host;
    info.host = {host_.source_of(b.removed_cell), outside.is_valid() ? host_.source_of(outside) : HostCellId{}};
    if (wall != nullptr) info.axis = wall->axis;
    return info;
  }

  /// All faces of a tube but those that the transition mesh brings.
  void add_tube_faces(const TransitionMesh& c, std::size_t t, const PlacedTube& placed, CavityVertices& vertices) {
    const Tube& tube = c.cavity.tubes[t];
    const RadialMesh& m = tube.real;
    const auto at = [&](int k, int circle, int s) { return tube_vertex(c, t, m.point_index(k, circle, s), vertices); };
    for (int k = 0; k < m.segments; ++k)
      for (int s = 0; s < m.sectors; ++s)
        for (int r = 0; r < m.rings; ++r) {
          const CellId cell = placed.cell(k, s, r);
          FaceInfo ring;
          ring.role = FaceRole::ring;
          ring.circle = r;
          // Inwards; the bore's wall is a part of the outer boundary.
          add_face(Loop{at(k, r, s), at(k + 1, r, s), at(k + 1, r, s + 1), at(k, r, s + 1)}, cell,
                   r > 0 ? placed.cell(k, s, r - 1) : no_cell, ring);
          FaceInfo sector;
          sector.role = FaceRole::sector;
          add_face(Loop{at(k, r, s + 1), at(k + 1, r, s + 1), at(k + 1, r + 1, s + 1), at(k, r + 1, s + 1)}, cell,
                   placed.cell(k, s + 1, r), sector);
          FaceInfo axial;
          axial.role = FaceRole::axial;
          const bool is_last = k + 1 == m.segments;
          if (!is_last || tube.layered)
            add_face(Loop{at(k + 1, r, s), at(k + 1, r + 1, s), at(k + 1, r + 1, s + 1), at(k + 1, r, s + 1)}, cell,
                     is_last ? no_cell : placed.cell(k + 1, s, r), axial);
          if (k == 0 && tube.layered)
            add_face(Loop{at(0, r, s), at(0, r, s + 1), at(0, r + 1, s + 1), at(0, r + 1, s)}, cell, no_cell, axial);
        }
  }

  /// Volumes and centroids from the faces' fans; source cells keep the volume of their eight corners.
  void set_made_geometry() {
    Mesh& mesh = out_.mesh;
    IdVector<CellId, double> volume(mesh.cells.size(), 0.0);
    IdVector<CellId, Vec3> open(mesh.cells.size(), Vec3::Zero());
    IdVector<CellId, double> area(mesh.cells.size(), 0.0);
    std::vector<std::vector<OutwardFace>> made_faces(mesh.cells.size());
    for (std::size_t index = 0; index < mesh.faces.size(); ++index) {
      const FaceId f(index);
      std::vector<Vec3> points;
      for (const VertexId v : mesh.faces.loop(f)) points.push_back(mesh.vertices[v]);
      const PolygonGeometry g = polygon_geometry(points);
      for (int side = 0; side < 2; ++side) {
        const CellId cell = mesh.faces.cells[f][static_cast<std::size_t>(side)];
        if (!cell.is_valid()) continue;
        const double sign = side == 0 ? 1.0 : -1.0;
        open[cell] += sign * g.area_vector;
        area[cell] += g.area_vector.norm();
        add_fan(points, g.mean, mesh.cells.center[cell], sign, volume[cell], mesh.cells.centroid[cell]);
        if (mesh.cells.kind[cell] >= CellKind::transition)
          made_faces[cell.index()].push_back({g.mean, sign * g.area_vector});
      }
    }
    for (std::size_t c = 0; c < mesh.cells.size() && !cavities_.empty(); ++c) {
      const CellId cell(c);
      const bool is_made = mesh.cells.kind[cell] >= CellKind::transition;
      if (open[cell].norm() > open_limit * area[cell] || (is_made && !(volume[cell] > 0.0)))
        out_.unsound_cells.push_back(cell);
    }
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
      const CellId cell(c);
      mesh.cells.centroid[cell] =
          mesh.cells.center[cell] + mesh.cells.centroid[cell] / (volume[cell] != 0.0 ? volume[cell] : 1.0);
      const CellKind kind = mesh.cells.kind[cell];
      if (kind == CellKind::host || (kind == CellKind::refined && !(volume[cell] > 0.0)))
        compare_volumes(cell, volume[cell]);
      else if (kind != CellKind::refined || !is_near(mesh.cells.volume[cell], volume[cell]))
        mesh.cells.volume[cell] = volume[cell];
      if (mesh.cells.kind[cell] < CellKind::transition) continue;
      // Rings that lean against their segment can hide a face of a thin radial cell from its natural centre; vertices
      // of the host on a wall can turn the faces of a transition cell there a little.
      if (smallest_height(made_faces[c], mesh.cells.center[cell]) <= 0.0)
        if (const auto p =
                point_that_sees_all(made_faces[c], mesh.cells.center[cell], std::cbrt(std::abs(volume[cell])))) {
          mesh.cells.center[cell] = *p;
          mesh.cells.depth[cell] = p->z();
        }
    }
  }

  /// The parts of a column follow straight lines between its pillars: where these lean, what a refined cell encloses
  /// is not just its part of the source cell, and a host cell beside it encloses the rest. Parts keep the total right.
  /// Not so where the two are this far apart: a wedge that is much longer than thick.
  static bool is_near(double of_sources, double of_faces) {
    constexpr double limit = 0.02;
    return std::abs(of_sources - of_faces) <= limit * of_faces;
  }

  void compare_volumes(CellId cell, double of_faces) {
    VolumeMismatch& found = out_.volume_mismatch;
    const double difference = std::abs(of_faces / out_.mesh.cells.volume[cell] - 1.0);
    if (difference > VolumeMismatch::limit) ++found.count;
    if (difference <= found.worst) return;
    found.worst = difference;
    found.cell = cell;
  }

  /// Adds the tetrahedra between a face's fan and a cell's centre: volume, and first moment about the centre.
  static void add_fan(const std::vector<Vec3>& points, const Vec3& mean, const Vec3& center, double sign,
                      double& volume, Vec3& moment) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 a = points[i] - center;
      const Vec3 b = points[(i + 1) % points.size()] - center;
      const Vec3 m = mean - center;
      const double v = sign * m.dot(a.cross(b)) / 6.0;
      volume += v;
      moment += v * (a + b + m) / 4.0;
    }
  }

  const CornerPointGrid& grid_;
  const HostMesh& host_;
  const std::vector<TransitionMesh>& cavities_;
  IdVector<VertexId, VertexId> vertex_of_host_;
  IdVector<HostCellId, std::uint8_t> is_removed_;
  CavityWalls walls_;
  std::vector<std::vector<CellId>> cells_at_walls_;  ///< per cavity and boundary face; made when first asked for
  IdVector<VertexId, VertexId> host_vertex_of_;      ///< the host's vertex of each of the mesh's, if it is one
  Assembly out_;
};

}  // namespace

Assembly assemble(const CornerPointGrid& grid, const HostMesh& host, const std::vector<TransitionMesh>& cavities) {
  return Assembler(grid, host, cavities).build();
}

}  // namespace wellknit
