// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/cavity.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace wellknit {

namespace {

using Cell = std::array<std::int64_t, 3>;
using Node = std::array<std::int64_t, 3>;

/// The grid's cells as a mask of what is removed.
class RemovedCells {
 public:
  explicit RemovedCells(const CornerPointGrid& grid)
      : grid_(grid), mask_(static_cast<std::size_t>(grid.cell_count()), 0) {}

  [[nodiscard]] bool is_inside_grid(const Cell& c) const {
    for (std::size_t a = 0; a < 3; ++a)
      if (c[a] < 0 || c[a] >= grid_.dimensions[a]) return false;
    return true;
  }
  [[nodiscard]] bool contains(const Cell& c) const {
    return is_inside_grid(c) && mask_[grid_.cell_id(c[0], c[1], c[2]).index()] != 0;
  }
  bool add(const Cell& c) {
    if (!is_inside_grid(c)) return false;
    auto& m = mask_[grid_.cell_id(c[0], c[1], c[2]).index()];
    if (m != 0) return false;
    m = 1;
    ++count_;
    for (std::size_t a = 0; a < 3; ++a) {
      low_[a] = std::min(low_[a], c[a]);
      high_[a] = std::max(high_[a], c[a] + 1);
    }
    return true;
  }
  [[nodiscard]] bool contains(HostCellId c) const { return mask_[c.index()] != 0; }
  [[nodiscard]] std::int64_t count() const { return count_; }
  /// In order of their ids.
  [[nodiscard]] std::vector<Cell> list() const {
    std::vector<Cell> cells;
    for (std::int64_t k = low_[2]; k < high_[2]; ++k)
      for (std::int64_t j = low_[1]; j < high_[1]; ++j)
        for (std::int64_t i = low_[0]; i < high_[0]; ++i)
          if (contains({i, j, k})) cells.push_back({i, j, k});
    return cells;
  }

 private:
  const CornerPointGrid& grid_;
  std::vector<std::uint8_t> mask_;
  std::int64_t count_ = 0;
  Cell low_{std::numeric_limits<std::int64_t>::max() / 2, std::numeric_limits<std::int64_t>::max() / 2,
            std::numeric_limits<std::int64_t>::max() / 2};
  Cell high_{0, 0, 0};
};

Cell neighbour(const Cell& c, int side) {
  Cell out = c;
  out[static_cast<std::size_t>(side / 2)] += side % 2 == 0 ? -1 : 1;
  return out;
}

/// The four nodes of a side of a cell, in an order around it; side 0, 1 are low and high i, then j, then k.
std::array<Node, 4> side_nodes(const Cell& c, int side) {
  const auto a = static_cast<std::size_t>(side / 2);
  const std::size_t b = (a + 1) % 3;
  const std::size_t d = (a + 2) % 3;
  std::array<Node, 4> nodes;
  static constexpr std::array<std::array<std::int64_t, 2>, 4> around{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (std::size_t q = 0; q < 4; ++q) {
    nodes[q] = c;
    nodes[q][a] += side % 2;
    nodes[q][b] += around[q][0];
    nodes[q][d] += around[q][1];
  }
  return nodes;
}

// ---- cells that meet a tube
// -------------------------------------------------------------------------------------------

double distance_to_box(const Box& box, const Vec3& p) { return (p - p.cwiseMax(box.low).cwiseMin(box.high)).norm(); }

/// Least distance of a box to a segment: convex along the segment, so a ternary search finds it.
double distance_to_segment(const Box& box, const Vec3& p, const Vec3& q) {
  double a = 0.0;
  double b = 1.0;
  for (int step = 0; step < 60; ++step) {
    const double s = a + (b - a) / 3.0;
    const double t = b - (b - a) / 3.0;
    if (distance_to_box(box, p + s * (q - p)) <= distance_to_box(box, p + t * (q - p)))
      b = t;
    else
      a = s;
  }
  return distance_to_box(box, p + a * (q - p));
}

/// Index range of the cells of an axis that meet [low, high].
std::array<std::int64_t, 2> cell_range(const ReferenceSpace& space, int axis, double low, double high) {
  const std::int64_t a = space.place(axis, low).first;
  const std::int64_t b = space.place(axis, high).first;
  return {std::min(a, b), std::max(a, b)};
}

void remove_along_segment(const HostFrame& frame, const Vec3& p, const Vec3& q, double radius, RemovedCells& removed) {
  std::array<std::array<std::int64_t, 2>, 3> range;
  for (int a = 0; a < 3; ++a)
    range[static_cast<std::size_t>(a)] =
        cell_range(frame.space, a, std::min(p[a], q[a]) - radius, std::max(p[a], q[a]) + radius);
  for (std::int64_t k = range[2][0]; k <= range[2][1]; ++k)
    for (std::int64_t j = range[1][0]; j <= range[1][1]; ++j)
      for (std::int64_t i = range[0][0]; i <= range[0][1]; ++i)
        if (distance_to_segment(frame.space.box({i, j, k}), p, q) <= radius) removed.add({i, j, k});
}

/// Removes every cell that comes within the tube's radius of its axis: no less than the cells that meet it.
void remove_cells_at_tube(const HostFrame& frame, const Tube& tube, RemovedCells& removed) {
  const double radius = tube.reference_radius * (1.0 + 1e-9);
  for (std::size_t k = 0; k + 1 < tube.reference.axis.size(); ++k)
    remove_along_segment(frame, tube.reference.axis[k], tube.reference.axis[k + 1], radius, removed);
}

// ---- closed and manifold
// ----------------------------------------------------------------------------------------------

/// Layered cavities take whole columns: all their boundary faces are then lateral and their cells layered prisms.
void complete_columns(const CornerPointGrid& grid, RemovedCells& removed) {
  for (const Cell& c : removed.list())
    for (std::int64_t k = 0; k < grid.dimensions[2]; ++k) removed.add({c[0], c[1], k});
}

/// Where two removed cells touch along an edge only, the two others at the edge go too, so that the boundary is a
/// 2-manifold.
bool remove_touching_edges(RemovedCells& removed) {
  bool changed = false;
  for (const Cell& c : removed.list())
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3;
      for (const int sa : {-1, 1})
        for (const int sb : {-1, 1}) {
          Cell diagonal = c;
          diagonal[a] += sa;
          diagonal[b] += sb;
          if (!removed.contains(diagonal)) continue;
          Cell one = c;
          one[a] += sa;
          Cell two = c;
          two[b] += sb;
          if (removed.contains(one) || removed.contains(two)) continue;
          changed |= removed.add(one);
          changed |= removed.add(two);
        }
    }
  return changed;
}

void dilate(RemovedCells& removed) {
  for (const Cell& c : removed.list())
    for (int side = 0; side < 6; ++side) removed.add(neighbour(c, side));
}

// ---- boundary
// ---------------------------------------------------------------------------------------------------------

/// Vertex of the host mesh at a node, as the cells of the cavity see it; they must agree.
class HostNodes {
 public:
  explicit HostNodes(const HostFrame& frame) : frame_(frame) {}

  /// False when a cell sees another vertex at one of its corners than an earlier cell did (a fault), or two of its own
  /// corners are one vertex (a pinch-out).
  bool add(const Cell& c) {
    const HostCellId id = frame_.grid.cell_id(c[0], c[1], c[2]);
    for (int corner = 0; corner < 8; ++corner) {
      const Node n{c[0] + (corner & 1), c[1] + ((corner >> 1) & 1), c[2] + (corner >> 2)};
      const VertexId v = frame_.host.corner(id, corner & 1, (corner >> 1) & 1, corner >> 2);
      if (nodes_.emplace(n, v).first->second != v) return false;
    }
    for (int corner = 0; corner < 4; ++corner)
      if (frame_.host.corner(id, corner & 1, corner >> 1, 0) == frame_.host.corner(id, corner & 1, corner >> 1, 1))
        return false;
    return true;
  }
  [[nodiscard]] VertexId at(const Node& n) const { return nodes_.at(n); }
  [[nodiscard]] const std::map<Node, VertexId>& all() const { return nodes_; }

 private:
  const HostFrame& frame_;
  std::map<Node, VertexId> nodes_;
};

/// Collects the boundary of a set of removed cells and tubes.
class BoundaryBuilder {
 public:
  BoundaryBuilder(const HostFrame& frame, const RemovedCells& removed, Cavity& cavity)
      : frame_(frame), removed_(removed), cavity_(cavity) {}

  void build() {
    cavity_.vertices.clear();
    cavity_.faces.clear();
    cavity_.planes.clear();
    for (const Cell& c : cavity_.removed)
      for (int side = 0; side < 6; ++side) add_side(c, side);
    for (std::size_t t = 0; t < cavity_.tubes.size(); ++t) add_tube(t);
  }

 private:
  void add_side(const Cell& c, int side) {
    const Cell outside = neighbour(c, side);
    if (removed_.contains(outside)) return;
    if (!removed_.is_inside_grid(outside)) {
      add_plane(side);
      return;
    }
    BoundaryFace face;
    face.kind = BoundaryFaceKind::host;
    face.removed_cell = frame_.grid.cell_id(c[0], c[1], c[2]);
    face.outside_cell = frame_.grid.cell_id(outside[0], outside[1], outside[2]);
    for (const Node& n : side_nodes(c, side)) face.loop.push_back(host_vertex(n));
    const int axis = side / 2;
    const auto half = [&](const Cell& cell) {
      const Box box = frame_.space.box(cell);
      return 0.5 * (box.high[axis] - box.low[axis]);
    };
    face.natural = half(c);
    face.natural_outside = -half(outside);
    const Box box = frame_.space.box(c);
    finish(face, 0.5 * (box.low + box.high));
  }

  std::int32_t host_vertex(const Node& n) {
    const auto [at, is_new] = host_vertices_.emplace(n, static_cast<std::int32_t>(cavity_.vertices.size()));
    if (is_new) {
      CavityVertex v;
      v.reference = frame_.space.node(n[0], n[1], n[2]);
      v.is_host = true;
      v.node = n;
      cavity_.vertices.push_back(v);
    }
    return at->second;
  }

  void add_plane(int side) {
    const int axis = side / 2;
    const std::int64_t n = frame_.grid.dimensions[static_cast<std::size_t>(axis)];
    const double coordinate = frame_.space.plane(axis, side % 2 == 0 ? 0 : n);
    const double other = frame_.space.plane(axis, side % 2 == 0 ? n : 0);
    for (const MirrorPlane& p : cavity_.planes)
      if (p.axis == axis && p.coordinate == coordinate) return;
    cavity_.planes.push_back({axis, coordinate, other > coordinate ? 1.0 : -1.0});
  }

  std::int32_t tube_vertex(std::size_t tube, std::size_t point) {
    const auto [at, is_new] =
        tube_vertices_.emplace(std::pair(tube, point), static_cast<std::int32_t>(cavity_.vertices.size()));
    if (is_new) {
      CavityVertex v;
      v.reference = cavity_.tubes[tube].reference.points[point];
      v.real = cavity_.tubes[tube].real.points[point];
      v.tube = tube;
      v.tube_point = point;
      cavity_.vertices.push_back(v);
    }
    return at->second;
  }

  void add_tube(std::size_t t) {
    const RadialMesh& mesh = cavity_.tubes[t].reference;
    for (int k = 0; k < mesh.segments; ++k)
      for (int s = 0; s < mesh.sectors; ++s) add_lateral(t, k, s);
    if (cavity_.tubes[t].layered) return;
    add_cap(t, 0);
    add_cap(t, mesh.segments);
  }

  void add_lateral(std::size_t t, int k, int s) {
    const RadialMesh& mesh = cavity_.tubes[t].reference;
    BoundaryFace face;
    face.kind = BoundaryFaceKind::lateral;
    face.tube = t;
    face.radial = {k, s, mesh.rings - 1};
    const int outer = mesh.rings;
    for (const auto& [station, sector] :
         {std::pair(k, s), std::pair(k, s + 1), std::pair(k + 1, s + 1), std::pair(k + 1, s)})
      face.loop.push_back(tube_vertex(t, mesh.point_index(station, outer, sector)));
    const double radius = cavity_.tubes[t].reference_radius;
    const double inner = (mesh.point(k, outer - 1, s) - mesh.axis[static_cast<std::size_t>(k)]).norm();
    // The next ring outwards would grow as the outermost one did.
    face.natural = 0.5 * (radius - inner) * radius / std::max(inner, 0.2 * radius);
    face.natural_outside = -0.5 * (radius - inner);
    const Vec3 axis_point = 0.5 * (mesh.axis[static_cast<std::size_t>(k)] + mesh.axis[static_cast<std::size_t>(k) + 1]);
    Vec3 mean = Vec3::Zero();
    for (const auto v : face.loop) mean += cavity_.vertices[static_cast<std::size_t>(v)].reference / 4.0;
    finish(face, mean + (mean - axis_point));
  }

  /// The polar faces of an end: trapezoids, and the polygon of the bore.
  void add_cap(std::size_t t, int station) {
    const RadialMesh& mesh = cavity_.tubes[t].reference;
    const int segment = station == 0 ? 0 : mesh.segments - 1;
    const Vec3& end = mesh.axis[static_cast<std::size_t>(station)];
    const Vec3& next = mesh.axis[static_cast<std::size_t>(station == 0 ? 1 : station - 1)];
    const double half = 0.5 * (end - next).norm();
    const auto add = [&](BoundaryFace face) {
      face.kind = BoundaryFaceKind::cap;
      face.tube = t;
      face.natural = half;
      // Short of the centre of the radial cell's sphere: that passes through the lateral face behind, and two outside
      // sites with power 0 on one face would share it.
      face.natural_outside = -0.6 * half;
      finish(face, end + (end - next));
    };
    for (int ring = 0; ring < mesh.rings; ++ring)
      for (int s = 0; s < mesh.sectors; ++s) {
        BoundaryFace face;
        face.radial = {segment, s, ring};
        for (const auto& [circle, sector] :
             {std::pair(ring, s), std::pair(ring, s + 1), std::pair(ring + 1, s + 1), std::pair(ring + 1, s)})
          face.loop.push_back(tube_vertex(t, mesh.point_index(station, circle, sector)));
        add(std::move(face));
      }
    BoundaryFace bore;
    bore.radial = {segment, -1, -1};
    for (int s = 0; s < mesh.sectors; ++s) bore.loop.push_back(tube_vertex(t, mesh.point_index(station, 0, s)));
    add(std::move(bore));
  }

  /// Circle and normal of a face; `inside` is a point on the cavity's side.
  void finish(BoundaryFace face, const Vec3& inside) {
    std::vector<Vec3> points;
    for (const auto v : face.loop) points.push_back(cavity_.vertices[static_cast<std::size_t>(v)].reference);
    const PolygonGeometry geometry = polygon_geometry(points);
    face.normal = geometry.area_vector.normalized();
    if (face.normal.dot(inside - geometry.mean) < 0.0) {
      face.normal = -face.normal;
      std::reverse(face.loop.begin(), face.loop.end());
    }
    set_circle(face, points, geometry.mean);
    cavity_.faces.push_back(std::move(face));
  }

  /// Circle through the first three well spread vertices; the others lie on it to rounding.
  static void set_circle(BoundaryFace& face, const std::vector<Vec3>& points, const Vec3& mean) {
    if (points.size() == 4 && face.kind == BoundaryFaceKind::host) {
      face.center = mean;  // a rectangle: exact
    } else {
      const std::size_t n = points.size();
      const Vec3 a = points[n / 3] - points[0];
      const Vec3 b = points[(2 * n) / 3] - points[0];
      const Vec3 normal = a.cross(b);
      face.center = points[0] + (a.squaredNorm() * b.cross(normal) + b.squaredNorm() * normal.cross(a)) /
                                    (2.0 * normal.squaredNorm());
    }
    for (const Vec3& p : points) face.radius += (p - face.center).norm() / static_cast<double>(points.size());
  }

  const HostFrame& frame_;
  const RemovedCells& removed_;
  Cavity& cavity_;
  std::map<Node, std::int32_t> host_vertices_;
  std::map<std::pair<std::size_t, std::size_t>, std::int32_t> tube_vertices_;
};

// ---- rounds
// -----------------------------------------------------------------------------------------------------------

std::vector<std::size_t> all_wells(const Cavity& cavity) {
  std::vector<std::size_t> wells;
  for (const Tube& t : cavity.tubes) wells.push_back(t.well);
  return wells;
}

double least_t_high(const BoundaryFace& face, const CavityOptions& options) {
  if (face.kind == BoundaryFaceKind::host) return options.least_host_clearance * face.natural;
  return options.least_radial_clearance * std::min(face.natural, face.radius);
}

bool is_good(const BoundaryFace& face, const CavityOptions& options) {
  // Between the bounds both sites must find room: a tenth of the inner one's.
  return face.t_high >= least_t_high(face, options) && face.t_low < 0.9 * std::min(face.t_high, face.natural);
}

/// Removes all cells around a node; an earlier face of the same round may have done so already.
void remove_at_node(const Node& n, RemovedCells& removed) {
  for (int c = 0; c < 8; ++c) removed.add({n[0] - (c & 1), n[1] - ((c >> 1) & 1), n[2] - (c >> 2)});
}

/// One face that is not admissible: removes what is in its way. Returns a reason when nothing can be removed.
std::optional<NoCavity> make_room(const CornerPointGrid& grid, const Cavity& cavity, const BoundaryFace& face,
                                  const CavityOptions& options, RemovedCells& removed) {
  if (face.kind == BoundaryFaceKind::host) {
    removed.add(grid.ijk(face.outside_cell));
    return std::nullopt;
  }
  const bool is_high = face.t_high < least_t_high(face, options);
  const std::int32_t culprit = is_high ? face.high_vertex : face.low_vertex;
  const std::size_t well = cavity.tubes[face.tube].well;
  if (culprit < 0)
    return NoCavity{"the tube comes too close to the top, base or a side of the grid: choose a smaller radius", {well}};
  const CavityVertex& v = cavity.vertices[static_cast<std::size_t>(culprit)];
  if (v.is_host) {
    remove_at_node(v.node, removed);
    return std::nullopt;
  }
  const std::size_t other = cavity.tubes[v.tube].well;
  if (other == well)
    return NoCavity{"the tube comes too close to itself: choose a smaller radius or more segments", {well}};
  return NoCavity{"the tube comes too close to another well's: choose smaller radii", {std::max(well, other)}};
}

std::string cell_name(const Cell& c) { return fmt::format("({}, {}, {})", c[0] + 1, c[1] + 1, c[2] + 1); }

/// The host's faces on the cavity's wall must have just their four corners: one that carries more, cut by a fault next
/// to it, would not meet the cavity's face edge by edge. So must those on the grid's outside that share an edge with
/// the wall; they belong to kept cells, and the extra vertex then is on a wall's face too.
std::optional<std::string> check_walls(const HostFrame& frame, const RemovedCells& removed) {
  const HostFaces& faces = frame.host.faces;
  for (std::size_t index = 0; index < faces.size(); ++index) {
    const auto [a, b] = faces.cells[FaceId(index)];
    if (!b.is_valid() || removed.contains(a) == removed.contains(b)) continue;
    if (faces.loop(FaceId(index)).size() != 4 || faces.is_fault[FaceId(index)] != 0)
      return fmt::format(
          "a fault beside cells {} and {} puts vertices on the cavity's wall; this is not handled yet: choose a "
          "smaller radius",
          cell_name(frame.grid.ijk(a)), cell_name(frame.grid.ijk(b)));
  }
  return std::nullopt;
}

/// Every cell of the cavity and every kept cell at its boundary must see one vertex at each node: no fault and no
/// pinch-out.
std::optional<std::string> check_nodes(const HostFrame& frame, const RemovedCells& removed, const Cavity& cavity,
                                       HostNodes& nodes) {
  for (const Cell& c : cavity.removed)
    if (!nodes.add(c))
      return fmt::format(
          "a fault or a pinch-out at cell {} lies inside the cavity; these are not handled yet: choose a smaller "
          "radius",
          cell_name(c));
  for (const Cell& c : cavity.removed)
    for (int side = 0; side < 6; ++side) {
      const Cell outside = neighbour(c, side);
      if (!removed.is_inside_grid(outside) || removed.contains(outside)) continue;
      const HostCellId id = frame.grid.cell_id(outside[0], outside[1], outside[2]);
      for (const Node& n : side_nodes(c, side))
        if (frame.host.corner(id, static_cast<int>(n[0] - outside[0]), static_cast<int>(n[1] - outside[1]),
                              static_cast<int>(n[2] - outside[2])) != nodes.at(n))
          return fmt::format(
              "a fault or a gap between cells {} and {} lies on the cavity's wall; this is not handled yet: choose a "
              "smaller radius",
              cell_name(c), cell_name(outside));
    }
  return check_walls(frame, removed);
}

/// Nodes of the footprint on the mirror planes that no boundary face uses.
void add_plane_nodes(const HostFrame& frame, const HostNodes& nodes, Cavity& cavity) {
  std::set<Node> used;
  for (const CavityVertex& v : cavity.vertices)
    if (v.is_host) used.insert(v.node);
  for (const auto& [n, vertex] : nodes.all()) {
    if (used.contains(n)) continue;
    bool is_on_plane = false;
    for (std::size_t a = 0; a < 3; ++a) is_on_plane |= n[a] == 0 || n[a] == frame.grid.dimensions[a];
    if (is_on_plane) cavity.plane_nodes.push_back({frame.space.node(n[0], n[1], n[2]), frame.host.vertices[vertex]});
  }
}

/// Volume of a tube in E_ref: each segment as the prismatoid between its two polygons, faces as fans.
double tube_volume(const RadialMesh& mesh) {
  double volume = 0.0;
  const auto fan = [&](const std::array<Vec3, 4>& p, const Vec3& o) {
    const PolygonGeometry g = polygon_geometry(p);
    return (g.mean - o).dot(g.area_vector) / 3.0;
  };
  for (int k = 0; k < mesh.segments; ++k) {
    const Vec3 o = 0.5 * (mesh.axis[static_cast<std::size_t>(k)] + mesh.axis[static_cast<std::size_t>(k) + 1]);
    double segment = 0.0;
    for (int s = 0; s < mesh.sectors; ++s)
      segment += fan({mesh.point(k, mesh.rings, s), mesh.point(k, mesh.rings, s + 1),
                      mesh.point(k + 1, mesh.rings, s + 1), mesh.point(k + 1, mesh.rings, s)},
                     o);
    for (const int station : {k, k + 1}) {
      std::vector<Vec3> ring;
      for (int s = 0; s < mesh.sectors; ++s) ring.push_back(mesh.point(station, mesh.rings, s));
      const PolygonGeometry g = polygon_geometry(ring);
      segment += (station == k ? -1.0 : 1.0) * (g.mean - o).dot(g.area_vector) / 3.0;
    }
    volume += std::abs(segment);
  }
  return volume;
}

void set_reference_volume(const HostFrame& frame, Cavity& cavity) {
  cavity.reference_volume = 0.0;
  for (const Cell& c : cavity.removed) {
    const Box box = frame.space.box(c);
    cavity.reference_volume += (box.high - box.low).prod();
  }
  for (const Tube& t : cavity.tubes) cavity.reference_volume -= tube_volume(t.reference);
}

/// Least distance of two segments, by their ends and by the interior minimum.
double segment_distance(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
  const Vec3 u = q - p;
  const Vec3 v = s - r;
  const Vec3 w = p - r;
  const double a = u.squaredNorm();
  const double b = u.dot(v);
  const double c = v.squaredNorm();
  const double det = a * c - b * b;
  const auto on = [](double t) { return std::clamp(t, 0.0, 1.0); };
  double best = std::numeric_limits<double>::infinity();
  const auto trial = [&](double t, double x) { best = std::min(best, (p + on(t) * u - r - on(x) * v).norm()); };
  if (det > 1e-12 * a * c) trial((b * v.dot(w) - c * u.dot(w)) / det, (a * v.dot(w) - b * u.dot(w)) / det);
  trial(0.0, v.dot(w) / c);
  trial(1.0, v.dot(q - r) / c);
  trial(-u.dot(w) / a, 0.0);
  trial(u.dot(s - p) / a, 1.0);
  return best;
}

/// Two tubes that overlap: the later well gives way.
std::optional<NoCavity> overlapping_tubes(const std::vector<Tube>& tubes) {
  for (std::size_t a = 0; a < tubes.size(); ++a)
    for (std::size_t b = a + 1; b < tubes.size(); ++b) {
      const double least = tubes[a].reference_radius + tubes[b].reference_radius;
      const auto& one = tubes[a].reference.axis;
      const auto& two = tubes[b].reference.axis;
      for (std::size_t i = 0; i + 1 < one.size(); ++i)
        for (std::size_t j = 0; j + 1 < two.size(); ++j)
          if (const double d = segment_distance(one[i], one[i + 1], two[j], two[j + 1]); d < least)
            return NoCavity{fmt::format("its tube overlaps another well's: their paths come within {:.1f} m where the "
                                        "two radii need {:.1f} m; choose smaller "
                                        "radii",
                                        d, least),
                            {std::max(tubes[a].well, tubes[b].well)}};
    }
  return std::nullopt;
}

void make_closed(const HostFrame& frame, const std::vector<Tube>& tubes, RemovedCells& removed) {
  const bool all_layered = std::all_of(tubes.begin(), tubes.end(), [](const Tube& t) { return t.layered; });
  do {
    if (all_layered) complete_columns(frame.grid, removed);
  } while (remove_touching_edges(removed));
}

}  // namespace

void set_sphere_bounds(std::vector<BoundaryFace>& faces, const std::vector<CavityVertex>& vertices,
                       const std::vector<MirrorPlane>& planes) {
  tbb::parallel_for(std::size_t{0}, faces.size(), [&](std::size_t index) {
    BoundaryFace& f = faces[index];
    f.t_low = -std::numeric_limits<double>::infinity();
    f.t_high = std::numeric_limits<double>::infinity();
    f.low_vertex = f.high_vertex = -1;
    const double flat = 1e-9 * f.radius;  // closer to the face's plane counts as on it: rounding of the vertices
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const Vec3 d = vertices[v].reference - f.center;
      const double h = f.normal.dot(d);
      const double p = d.squaredNorm() - f.radius * f.radius;
      const auto id = static_cast<std::int32_t>(v);
      if (std::abs(h) <= flat) {
        if (p >= -1e-9 * f.radius * f.radius) continue;
        if (std::find(f.loop.begin(), f.loop.end(), id) != f.loop.end()) continue;
        f.t_high = -std::numeric_limits<double>::infinity();
        f.high_vertex = id;
        continue;
      }
      const double t = p / (2.0 * h);
      if (h > 0.0 && t < f.t_high) {
        f.t_high = t;
        f.high_vertex = id;
      } else if (h < 0.0 && t > f.t_low) {
        f.t_low = t;
        f.low_vertex = id;
      }
    }
    for (const MirrorPlane& plane : planes) {
      const double toward = -plane.inward * f.normal[plane.axis];  // speed of c(t) towards the plane
      const double distance = plane.inward * (f.center[plane.axis] - plane.coordinate);
      // A site stays on its side of the plane: four fifths of the way at most.
      if (toward > 1e-9 && 0.8 * distance / toward < f.t_high) {
        f.t_high = 0.8 * distance / toward;
        f.high_vertex = -1;
      }
    }
  });
}

std::variant<Cavity, NoCavity> build_cavity(const HostFrame& frame, std::vector<Tube> tubes,
                                            const CavityOptions& options) {
  if (auto overlap = overlapping_tubes(tubes)) return *overlap;
  Cavity cavity;
  cavity.tubes = std::move(tubes);
  RemovedCells removed(frame.grid);
  for (const Tube& t : cavity.tubes) remove_cells_at_tube(frame, t, removed);
  constexpr std::int64_t most_rounds = 200;
  int dilations = options.dilation;
  for (cavity.rounds = 1;; ++cavity.rounds) {
    make_closed(frame, cavity.tubes, removed);
    if (cavity.rounds > most_rounds)
      return NoCavity{fmt::format("no cavity was found in {} rounds of removing cells ({} removed): choose a smaller "
                                  "radius, or more segments",
                                  most_rounds, removed.count()),
                      all_wells(cavity)};
    if (removed.count() > options.most_cells)
      return NoCavity{
          fmt::format(
              "the cavity would swallow {} cells: the host's cells are too flat or too large for this radius and its "
              "refinement is not available yet; choose a smaller radius or refine the grid laterally near the well",
              removed.count()),
          all_wells(cavity)};
    cavity.removed = removed.list();
    BoundaryBuilder(frame, removed, cavity).build();
    set_sphere_bounds(cavity.faces, cavity.vertices, cavity.planes);
    const std::int64_t before = removed.count();
    for (const BoundaryFace& f : cavity.faces)
      if (!is_good(f, options))
        if (auto reason = make_room(frame.grid, cavity, f, options, removed)) return *reason;
    if (removed.count() != before) continue;
    if (!std::all_of(cavity.faces.begin(), cavity.faces.end(),
                     [&](const BoundaryFace& f) { return is_good(f, options); }))
      return NoCavity{
          "the tube comes too close to a corner of the cavity that cannot be removed: choose a smaller radius",
          all_wells(cavity)};
    if (dilations == 0) break;
    --dilations;
    dilate(removed);
  }
  HostNodes nodes(frame);
  if (const auto reason = check_nodes(frame, removed, cavity, nodes)) return NoCavity{*reason, all_wells(cavity)};
  for (CavityVertex& v : cavity.vertices)
    if (v.is_host) {
      v.host = nodes.at(v.node);
      v.real = frame.host.vertices[v.host];
    }
  add_plane_nodes(frame, nodes, cavity);
  set_reference_volume(frame, cavity);
  return cavity;
}

}  // namespace wellknit
