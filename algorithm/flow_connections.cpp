// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/flow_connections.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "algorithm/cell_path.h"
#include "algorithm/host_transmissibility.h"
#include "algorithm/linear_flux_error.h"
#include "algorithm/radial_flow.h"
#include "algorithm/rock_tensor.h"
#include "algorithm/tube_flow.h"

namespace wellknit {

namespace {

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
double linear_half(const Eigen::Matrix3d& k, const Vec3& d, const Vec3& area_vector) {
  const double d2 = d.squaredNorm();
  return d2 > 0.0 ? std::abs(area_vector.dot(k * d)) / d2 : 0.0;
}

/// Of a transition cell: its site lies on the face's bisector, but the line to it misses the face's centroid, by 11
/// degrees in the mean. What counts is the distance to the face's plane: A n.K n / |n.d|; a tenth of |d| is the least.
double bisector_half(const Eigen::Matrix3d& k, const Vec3& d, const Vec3& area_vector) {
  const double area = area_vector.norm();
  if (!(area > 0.0)) return 0.0;
  const Vec3 n = area_vector / area;
  const double distance = std::max(std::abs(n.dot(d)), 0.1 * d.norm());
  return distance > 0.0 ? area * n.dot(k * n) / distance : 0.0;
}

double in_series(double t1, double t2) { return 1.0 / (1.0 / t1 + 1.0 / t2); }

class Connector {
 public:
  Connector(const FlowInput& input, Assembly& assembly)
      : grid_(input.grid),
        host_(input.host),
        locator_(input.locator),
        multipliers_(input.multipliers),
        assembly_(assembly),
        mesh_(assembly.mesh),
        wells_(input.wells),
        radial_flow_(assembly.tubes, input.wells) {
    tensors_.resize(mesh_.cells.size());
    tbb::parallel_for(std::size_t{0}, tensors_.size(),
                      [&](std::size_t c) { tensors_[c] = rock_tensor(assembly_, host_, CellId(c)); });
    for (const PlacedTube& t : assembly.tubes) {
      const auto& m = t.tube->real;
      tube_end_.push_back(t.first_cell.value() + static_cast<std::int64_t>(m.segments) * m.sectors * m.rings);
    }
  }

  void connect(FluxDefects* defects) {
    wants_defects_ = defects != nullptr;
    std::vector<Flux> fluxes(mesh_.faces.size());
    tbb::parallel_for(std::size_t{0}, fluxes.size(), [&](std::size_t f) {
      if (mesh_.faces.cells[FaceId(f)][1].is_valid()) fluxes[f] = flux_of(FaceId(f));
    });
    for (std::size_t f = 0; f < fluxes.size(); ++f)
      if (mesh_.faces.cells[FaceId(f)][1].is_valid()) add(FaceId(f), fluxes[f]);
    if (defects == nullptr) return;
    for (std::size_t f = 0; f < fluxes.size(); ++f) {
      const auto [a, b] = mesh_.faces.cells[FaceId(f)];
      if (!b.is_valid()) continue;
      const auto& [first, second] = fluxes[f].defects;
      if (const auto& near = fluxes[f].near) {
        defects->near_wells.push_back({ConnectionId(defects->ratio.size()), near->radial, *near->field, near->linear});
        if (b < a) defects->near_wells.back().field.flux *= -1.0;
      }
      defects->ratio.push_back(fluxes[f].ratio);
      defects->of_connection.push_back(b < a ? std::array<Vec3, 2>{-second, -first}
                                             : std::array<Vec3, 2>{first, second});
    }
    defects->permeability = std::move(tensors_);
  }

 private:
  /// What the flow towards a well does to a linear transmissibility.
  struct NearWell {
    double factor = 1.0;
    double radial = 0.0;  ///< how far the flow is the well's
    std::optional<WellField> field;
    double linear = 0.0;  ///< m3, in rock of one permeability
  };
  struct Flux {
    double transmissibility = 0.0;  ///< m3, without multiplier
    Vec3 linear_error = Vec3::Zero();
    std::array<Vec3, 2> defects{Vec3::Zero(), Vec3::Zero()};
    double ratio = 1.0;
    std::unique_ptr<NearWell> near;  ///< only where the flow is a well's
  };
  struct Sides {
    HalfFace first;
    HalfFace second;
  };

  [[nodiscard]] std::vector<Vec3> points_of(FaceId face) const {
    std::vector<Vec3> points;
    for (const VertexId v : mesh_.faces.loop(face)) points.push_back(mesh_.vertices[v]);
    return points;
  }

  [[nodiscard]] Sides sides_of(FaceId face, const PolygonGeometry& g) const {
    const FaceInfo& info = assembly_.face_info[face];
    const auto [a, b] = mesh_.faces.cells[face];
    return {{a, g.centroid, g.area_vector, info, {a, b}}, {b, g.centroid, -g.area_vector, info, {a, b}}};
  }

  [[nodiscard]] Flux flux_of(FaceId face) const {
    const std::vector<Vec3> points = points_of(face);
    const PolygonGeometry g = polygon_geometry(points);
    const auto [first, second] = sides_of(face, g);
    NearWell near;
    const double t = transmissibility(first, second, points, g, near);
    Flux out;
    out.transmissibility = t;
    out.linear_error = linear_error(first, second, t);
    if (wants_defects_ && t > 0.0) {
      out.defects = defects(first, second);
      out.ratio = 1.0 / near.factor;
      if (near.field) out.near = std::make_unique<NearWell>(std::move(near));
    }
    return out;
  }

  /// Of the sides as the face has them. Beside a tube nothing is left out: the pressure is that of the well, not
  /// linear.
  [[nodiscard]] std::array<Vec3, 2> defects(const HalfFace& first, const HalfFace& second) const {
    if (mesh_.cells.kind[first.cell] == CellKind::radial || mesh_.cells.kind[second.cell] == CellKind::radial)
      return {Vec3::Zero(), Vec3::Zero()};
    const Vec3& a = first.area_vector;
    const Vec3 to_face = first.centroid - mesh_.cells.center[first.cell];
    const Vec3 from_face = mesh_.cells.center[second.cell] - second.centroid;
    const double t1 = half(first);
    const double t2 = half(second);
    if (!(t1 > 0.0) || !(t2 > 0.0)) return {Vec3::Zero(), Vec3::Zero()};
    return {tensors_[first.cell.index()] * a / t1 - to_face, tensors_[second.cell.index()] * a / t2 - from_face};
  }

  void add(FaceId face, const Flux& flux) {
    const std::vector<Vec3> points = points_of(face);
    const PolygonGeometry g = polygon_geometry(points);
    const auto [first, second] = sides_of(face, g);
    const FaceInfo& info = first.info;
    const auto [a, b] = first.cells;
    const bool is_swapped = b < a;
    const double multiplier = multipliers_.exist() ? multiplier_of(first, second) : 1.0;
    Connections& c = mesh_.connections;
    c.cells.push_back(is_swapped ? std::array{b, a} : std::array{a, b});
    c.face.push_back(face);
    c.transmissibility.push_back(multiplier * flux.transmissibility);
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
    c.linear_flux_error.push_back(flux.linear_error);
  }

  [[nodiscard]] Vec3 linear_error(const HalfFace& first, const HalfFace& second, double t) const {
    return linear_flux_error({first.centroid,
                              first.area_vector,
                              {mesh_.cells.center[first.cell], mesh_.cells.center[second.cell]},
                              {tensors_[first.cell.index()], tensors_[second.cell.index()]}},
                             t);
  }

  /// Without multiplier.
  [[nodiscard]] double transmissibility(const HalfFace& first, const HalfFace& second, std::span<const Vec3> points,
                                        const PolygonGeometry& geometry, NearWell& near) const {
    const bool is_of_host = first.info.host_face.is_valid();
    const auto& known = host_.faces.transmissibility;
    if (is_of_host && known.empty()) return 0.0;
    if (is_of_host && is_untouched(first.cell) && is_untouched(second.cell)) return known[first.info.host_face];
    const double t1 = half(first);
    const double t2 = half(second);
    if (!(t1 > 0.0) || !(t2 > 0.0)) return 0.0;
    const double linear = is_of_host ? known[first.info.host_face] : in_series(t1, t2);
    const FaceRole role = first.info.role;
    const bool is_inside = role == FaceRole::host || role == FaceRole::general;
    const bool is_whole = first.info.is_fault == 0 && first.info.is_pinch == 0;
    if (!is_inside || !is_whole) return linear;
    near = near_well_factor(first, second, {t1, t2}, points, geometry);
    return linear * near.factor;
  }

  [[nodiscard]] bool is_untouched(CellId cell) const { return mesh_.cells.kind[cell] == CellKind::host; }

  /// Of the flow's form near wells: the same on both sides, from the linear transmissibility in rock of one
  /// permeability.
  [[nodiscard]] NearWell near_well_factor(const HalfFace& first, const HalfFace& second, const std::array<double, 2>& t,
                                          std::span<const Vec3> points, const PolygonGeometry& geometry) const {
    if (assembly_.tubes.empty()) return {};
    const Eigen::Matrix3d& k1 = tensors_[first.cell.index()];
    const Eigen::Matrix3d& k2 = tensors_[second.cell.index()];
    const Eigen::Matrix3d k = 0.5 * (k1 + k2);
    const Vec3& a = geometry.area_vector;
    const std::array centers{mesh_.cells.center[first.cell], mesh_.cells.center[second.cell]};
    const double oblique =
        first.info.role == FaceRole::general ? permeability_cosine(k, a, centers[1] - centers[0]) : 1.0;
    const double across = a.dot(k * a);
    const double linear = oblique * in_series(t[0] * across / a.dot(k1 * a), t[1] * across / a.dot(k2 * a));
    const RadialFlow::Factor factor = radial_flow_.factor({centers, points, geometry, k, linear});
    return {oblique * factor.value, factor.radial, factor.field, linear / oblique};
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
    const Eigen::Matrix3d k = rock_tensor(assembly_, h.cell);
    return degrees_between(k * h.area_vector, h.centroid - mesh_.cells.center[h.cell]);
  }

  [[nodiscard]] double half(const HalfFace& h) const {
    const Eigen::Matrix3d& k = tensors_[h.cell.index()];
    const Vec3 d = h.centroid - mesh_.cells.center[h.cell];
    switch (mesh_.cells.kind[h.cell]) {
      case CellKind::host:
      case CellKind::refined: return host_half(h);
      case CellKind::radial: return radial_half(h, k, d);
      case CellKind::transition: break;
    }
    return h.info.role == FaceRole::lateral ? beyond_tube_half(h, k, d) : bisector_half(k, d, h.area_vector);
  }

  /// Between the outermost circle and a transition cell's site the flow is still radial: the linear half is 15 to 30 %
  /// too low there.
  [[nodiscard]] double beyond_tube_half(const HalfFace& h, const Eigen::Matrix3d& k, const Vec3& d) const {
    const auto [a, b] = h.cells;
    const CellId radial = a == h.cell ? b : a;
    const RadialIndex at = mesh_.cells.radial_index[radial];
    const Tube& tube = *tube_of(radial).tube;
    return TubeSector(tube, at.segment, at.sector, k, bore_radius(tube)).half_beyond(h.area_vector, d);
  }

  /// Beside a transition cell; host cells see host faces only.
  [[nodiscard]] double host_half(const HalfFace& h) const {
    return host_half_transmissibility(grid_, host_, assembly_.host_cell[h.cell.index()], h.info.axis, h.area_vector);
  }

  [[nodiscard]] double bore_radius(const Tube& tube) const { return wells_[tube.well].radial.bore_radius; }

  [[nodiscard]] const PlacedTube& tube_of(CellId cell) const {
    std::size_t t = 0;
    while (cell.value() >= tube_end_[t]) ++t;
    return assembly_.tubes[t];
  }

  [[nodiscard]] double radial_half(const HalfFace& h, const Eigen::Matrix3d& k, const Vec3& d) const {
    const Tube& tube = *tube_of(h.cell).tube;
    const RadialIndex at = mesh_.cells.radial_index[h.cell];
    switch (h.info.role) {
      case FaceRole::ring:
      case FaceRole::lateral:
        return TubeSector(tube, at.segment, at.sector, k, bore_radius(tube)).half_to_circle(at.ring, h.info.circle);
      case FaceRole::sector: {
        const CellId other = h.cells[0] == h.cell ? h.cells[1] : h.cells[0];
        const bool is_second = mesh_.cells.radial_index[other].sector == (at.sector + 1) % tube.real.sectors;
        return TubeSector(tube, at.segment, at.sector, k, bore_radius(tube)).half_to_side(at.ring, is_second ? 1 : 0);
      }
      case FaceRole::axial: {
        const double distance = std::abs(h.area_vector.normalized().dot(d));
        return distance > 0.0 ? h.area_vector.dot(k * h.area_vector) / h.area_vector.norm() / distance : 0.0;
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
  const std::vector<Well>& wells_;
  RadialFlow radial_flow_;
  std::vector<Eigen::Matrix3d> tensors_;  ///< of all cells, along their own axes
  bool wants_defects_ = false;
  std::vector<std::int64_t> tube_end_;  ///< one past the last cell of each tube
};

}  // namespace

void connect_cells(const FlowInput& input, Assembly& assembly, FluxDefects* defects) {
  Connector(input, assembly).connect(defects);
}

}  // namespace wellknit
