// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/flow_connections.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "algorithm/cell_path.h"
#include "algorithm/host_transmissibility.h"
#include "algorithm/radial_flow.h"

namespace wellknit {

namespace {

/// Permeability with net-to-gross on the lateral directions, as NEWTRAN applies it, m2.
Vec3 flow_permeability(const Cells& cells, CellId cell) {
  const double ntg = cells.net_to_gross[cell];
  const Vec3& k = cells.permeability[cell];
  return {k.x() * ntg, k.y() * ntg, k.z()};
}

double degrees_between(const Vec3& a, const Vec3& b) {
  const double scale = a.norm() * b.norm();
  if (!(scale > 0.0)) return 0.0;
  // The cross product keeps small angles that the cosine loses.
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

/// A face as one of its cells sees it; the area vector points out of the cell.
struct HalfFace {
  CellId cell;
  Vec3 centroid;
  Vec3 area_vector;
  const FaceInfo& info;
  std::array<CellId, 2> cells;  ///< of the face
};

/// Linear two-point half: A n.K d / d^2.
double linear_half(const Vec3& k, const Vec3& d, const Vec3& area_vector) {
  const double d2 = d.squaredNorm();
  return d2 > 0.0 ? std::abs(area_vector.dot(k.cwiseProduct(d))) / d2 : 0.0;
}

class Connector {
 public:
  Connector(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator,
            const HostMultipliers& multipliers, Assembly& assembly)
      : grid_(grid),
        host_(host),
        locator_(locator),
        multipliers_(multipliers),
        assembly_(assembly),
        mesh_(assembly.mesh),
        radial_flow_(assembly) {
    for (const PlacedTube& t : assembly.tubes) {
      const auto& m = t.tube->real;
      tube_end_.push_back(t.first_cell.value() + static_cast<std::int64_t>(m.segments) * m.sectors * m.rings);
    }
  }

  void connect() {
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
      if (mesh_.faces.cells[FaceId(f)][1].is_valid()) add(FaceId(f));
  }

 private:
  void add(FaceId face) {
    std::vector<Vec3> points;
    for (const VertexId v : mesh_.faces.loop(face)) points.push_back(mesh_.vertices[v]);
    const PolygonGeometry g = polygon_geometry(points);
    const FaceInfo& info = assembly_.face_info[face];
    const auto [a, b] = mesh_.faces.cells[face];
    const bool is_swapped = b < a;
    const HalfFace first{a, g.centroid, g.area_vector, info, {a, b}};
    const HalfFace second{b, g.centroid, -g.area_vector, info, {a, b}};
    const bool is_transition =
        mesh_.cells.kind[a] == CellKind::transition && mesh_.cells.kind[b] == CellKind::transition;
    const double factor = is_transition ? radial_flow_.factor(a, b, points) : 1.0;
    const double t = transmissibility(first, second) * factor;
    const double multiplier = multipliers_.exist() ? multiplier_of(first, second) : 1.0;
    Connections& c = mesh_.connections;
    c.cells.push_back(is_swapped ? std::array{b, a} : std::array{a, b});
    c.face.push_back(face);
    c.transmissibility.push_back(multiplier * t);
    c.area.push_back(g.area);
    const Vec3 normal = g.area > 0.0 ? Vec3(g.area_vector / g.area) : Vec3::Zero();
    c.normal.push_back(is_swapped ? Vec3(-normal) : normal);
    const double d1 = (g.centroid - mesh_.cells.center[a]).norm();
    const double d2 = (g.centroid - mesh_.cells.center[b]).norm();
    c.half_distance.push_back(is_swapped ? std::array{d2, d1} : std::array{d1, d2});
    c.non_orthogonality.push_back(degrees_between(normal, mesh_.cells.center[b] - mesh_.cells.center[a]));
    c.k_non_orthogonality.push_back(std::max(k_angle(first), k_angle(second)));
    c.planarity.push_back(planarity(points, g));
    c.kind.push_back(info.is_pinch != 0   ? ConnectionKind::pinch_out
                     : info.is_fault != 0 ? ConnectionKind::fault
                                          : ConnectionKind::face);
    c.multiplier.push_back(multiplier);
  }

  /// Without multiplier.
  [[nodiscard]] double transmissibility(const HalfFace& first, const HalfFace& second) const {
    if (first.info.host_face.is_valid()) {
      const auto& known = host_.faces.transmissibility;
      return known.empty() ? 0.0 : known[first.info.host_face];
    }
    const double t1 = half(first);
    const double t2 = half(second);
    return t1 > 0.0 && t2 > 0.0 ? 1.0 / (1.0 / t1 + 1.0 / t2) : 0.0;
  }

  /// A face of the corner-point grid has its own multiplier. Any other has those of the grid's faces that the line
  /// from centre to centre crosses; several act in series, so their harmonic mean counts.
  [[nodiscard]] double multiplier_of(const HalfFace& first, const HalfFace& second) const {
    if (first.info.role == FaceRole::host) {
      const auto [one, other] = first.info.host;
      return one.is_valid() && other.is_valid() ? multipliers_.across(one, other, first.info.axis) : 1.0;
    }
    const std::array points{mesh_.cells.center[first.cell], mesh_.cells.center[second.cell]};
    const double length = (points[1] - points[0]).norm();
    if (!(length > 0.0)) return 1.0;
    const auto parts = cells_along(grid_, locator_, {{0.0, length}, {points[0], points[1]}});
    double count = 0.0;
    double inverse = 0.0;
    for (std::size_t n = 0; n + 1 < parts.size(); ++n) {
      const auto axis = axis_between(parts[n].cell, parts[n + 1].cell);
      if (!axis) continue;
      count += 1.0;
      inverse += 1.0 / multipliers_.across(parts[n].cell, parts[n + 1].cell, *axis);
    }
    return count > 0.0 ? count / inverse : 1.0;
  }

  /// The axis along which two cells are neighbours.
  [[nodiscard]] std::optional<Axis> axis_between(HostCellId one, HostCellId other) const {
    const auto a = grid_.ijk(one);
    const auto b = grid_.ijk(other);
    std::optional<Axis> axis;
    for (std::size_t n = 0; n < 3; ++n) {
      if (a[n] == b[n]) continue;
      if (axis || std::abs(a[n] - b[n]) != 1) return std::nullopt;
      axis = static_cast<Axis>(n);
    }
    return axis;
  }

  [[nodiscard]] double k_angle(const HalfFace& h) const {
    const Vec3 k = flow_permeability(mesh_.cells, h.cell);
    return degrees_between(k.cwiseProduct(h.area_vector), h.centroid - mesh_.cells.center[h.cell]);
  }

  [[nodiscard]] double half(const HalfFace& h) const {
    const Vec3 k = flow_permeability(mesh_.cells, h.cell);
    const Vec3 d = h.centroid - mesh_.cells.center[h.cell];
    switch (mesh_.cells.kind[h.cell]) {
      case CellKind::host: return host_half(h);
      case CellKind::radial: return radial_half(h, k, d);
      case CellKind::refined:
      case CellKind::transition: break;
    }
    return h.info.role == FaceRole::lateral ? beyond_tube_half(h, k, d) : linear_half(k, d, h.area_vector);
  }

  /// Between the outermost circle and a transition cell's site the flow is still radial: the linear half is 15 to 30 %
  /// too low there.
  [[nodiscard]] double beyond_tube_half(const HalfFace& h, const Vec3& k, const Vec3& d) const {
    const auto [a, b] = h.cells;
    const CellId radial = a == h.cell ? b : a;
    const RadialMesh& m = tube_of(radial).tube->real;
    const RadialIndex at = mesh_.cells.radial_index[radial];
    const Vec3 n = h.area_vector.normalized();
    const double radius = circle_radius(*tube_of(radial).tube, at, m.rings);
    const double theta = 2.0 * std::numbers::pi / m.sectors;
    // The site stands off the chord by its distance along the normal. Very near the chord's middle it is inside the
    // circle that the outermost ring's half ends at: half the linear drop is kept as the least.
    const double distance = std::abs(n.dot(d));
    const double drop =
        std::max(std::log((radius * std::cos(0.5 * theta) + distance) / radius), 0.5 * distance / radius);
    return drop > 0.0 ? n.dot(k.cwiseProduct(n)) * length_along_well(m, at, m.rings) * theta / drop : 0.0;
  }

  /// Beside a transition cell; host cells see host faces only.
  [[nodiscard]] double host_half(const HalfFace& h) const {
    return host_half_transmissibility(grid_, host_, mesh_.cells.source_cell[h.cell], h.info.axis, h.area_vector);
  }

  [[nodiscard]] const PlacedTube& tube_of(CellId cell) const {
    std::size_t t = 0;
    while (cell.value() >= tube_end_[t]) ++t;
    return assembly_.tubes[t];
  }

  /// Radius of a circle; in a layered tube it is a circle in plan on a horizon that may dip.
  static double circle_radius(const Tube& tube, const RadialIndex& at, int circle) {
    const Vec3 d =
        tube.real.point(at.segment, circle, at.sector) - tube.real.axis[static_cast<std::size_t>(at.segment)];
    return tube.layered ? std::hypot(d.x(), d.y()) : d.norm();
  }

  /// Mean distance of the two ends of a sector's face on a circle, m.
  static double length_along_well(const RadialMesh& m, const RadialIndex& at, int circle) {
    const auto edge = [&](int sector) {
      return (m.point(at.segment + 1, circle, sector) - m.point(at.segment, circle, sector)).norm();
    };
    return 0.5 * (edge(at.sector) + edge(at.sector + 1));
  }

  [[nodiscard]] double radial_half(const HalfFace& h, const Vec3& k, const Vec3& d) const {
    const RadialMesh& m = tube_of(h.cell).tube->real;
    const RadialIndex at = mesh_.cells.radial_index[h.cell];
    const Vec3 n = h.area_vector.normalized();
    const double along_normal = n.dot(k.cwiseProduct(n));
    const double inner = circle_radius(*tube_of(h.cell).tube, at, at.ring);
    const double outer = circle_radius(*tube_of(h.cell).tube, at, at.ring + 1);
    const double theta = 2.0 * std::numbers::pi / m.sectors;
    switch (h.info.role) {
      case FaceRole::ring:
      case FaceRole::lateral: {
        const double r_face = h.info.circle == at.ring ? inner : outer;
        return along_normal * length_along_well(m, at, h.info.circle) * theta /
               std::abs(std::log(r_face / mean_pressure_radius(inner, outer)));
      }
      case FaceRole::sector: {
        // Flow around the axis: a length r theta / 2 for each radius, L dr wide.
        const double length = h.area_vector.norm() / (outer - inner);
        return along_normal * length * std::log(outer / inner) / (0.5 * theta);
      }
      case FaceRole::axial: {
        const double distance = std::abs(n.dot(d));
        return distance > 0.0 ? along_normal * h.area_vector.norm() / distance : 0.0;
      }
      case FaceRole::host:
      case FaceRole::general: break;
    }
    return linear_half(k, d, h.area_vector);
  }

  const CornerPointGrid& grid_;
  const HostMesh& host_;
  const CellLocator& locator_;
  const HostMultipliers& multipliers_;
  Assembly& assembly_;
  Mesh& mesh_;
  RadialFlow radial_flow_;
  std::vector<std::int64_t> tube_end_;  ///< one past the last cell of each tube
};

}  // namespace

double mean_pressure_radius(double inner, double outer) {
  const double a = inner * inner;
  const double b = outer * outer;
  return std::exp((b * std::log(outer) - a * std::log(inner)) / (b - a) - 0.5);
}

void connect_cells(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator,
                   const HostMultipliers& multipliers, Assembly& assembly) {
  Connector(grid, host, locator, multipliers, assembly).connect();
}

double open_length(const Well& well, double from, double to) {
  // Without intervals the whole path is open: a layered tube goes on beyond its ends.
  if (well.open.empty())
    return std::max(0.0, std::min(to, well.trajectory.measured_depth.back()) -
                             std::max(from, well.trajectory.measured_depth.front()));
  double length = 0.0;
  for (const MeasuredDepthRange& o : well.open) length += std::max(0.0, std::min(to, o.to) - std::max(from, o.from));
  return std::min(length, to - from);
}

std::vector<WellConnection> connect_tube(const Mesh& mesh, const PlacedTube& placed, const Well& well) {
  const RadialMesh& m = placed.tube->real;
  std::vector<WellConnection> connections;
  for (int k = 0; k < m.segments; ++k) {
    const auto station = static_cast<std::size_t>(k);
    const double md0 = std::min(m.measured_depth[station], m.measured_depth[station + 1]);
    const double md1 = std::max(m.measured_depth[station], m.measured_depth[station + 1]);
    const double part = md1 > md0 ? open_length(well, md0, md1) / (md1 - md0) : 0.0;
    // A millionth of a segment is what rounding leaves at the ends of intervals.
    if (part < 1e-6) continue;
    for (int s = 0; s < m.sectors; ++s) {
      const CellId cell = placed.cell(k, s, 0);
      const double inner = (m.point(k, 0, s) - m.axis[station]).norm();
      const double outer = (m.point(k, 1, s) - m.axis[station]).norm();
      const Vec3 middle =
          0.25 * (m.point(k, 0, s) + m.point(k, 0, s + 1) + m.point(k + 1, 0, s) + m.point(k + 1, 0, s + 1));
      const Vec3 n = (middle - 0.5 * (m.axis[station] + m.axis[station + 1])).normalized();
      const double length = 0.5 * ((m.point(k + 1, 0, s) - m.point(k, 0, s)).norm() +
                                   (m.point(k + 1, 0, s + 1) - m.point(k, 0, s + 1)).norm());
      const double permeability = n.dot(flow_permeability(mesh.cells, cell).cwiseProduct(n));
      const double theta = 2.0 * std::numbers::pi / m.sectors;
      const double resistance = std::log(mean_pressure_radius(inner, outer) / inner) + well.skin;
      if (!(permeability > 0.0) || !(resistance > 0.0)) continue;
      connections.push_back({cell, permeability * part * length * theta / resistance, {md0, md1}});
    }
  }
  return connections;
}

}  // namespace wellknit
