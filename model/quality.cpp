// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "model/mesh_topology.h"

namespace wellknit {

namespace {

/// Value at the fraction q of the sorted sample, linear between neighbours (the usual definition of numerical
/// libraries).
double quantile(std::vector<double>& sample, double q) {
  if (sample.empty()) return 0.0;
  const double place = q * static_cast<double>(sample.size() - 1);
  const auto below = static_cast<std::ptrdiff_t>(place);
  std::nth_element(sample.begin(), sample.begin() + below, sample.end());
  const double low = sample[static_cast<std::size_t>(below)];
  if (below + 1 == static_cast<std::ptrdiff_t>(sample.size())) return low;
  const double high = *std::min_element(sample.begin() + below + 1, sample.end());
  return low + (place - static_cast<double>(below)) * (high - low);
}

struct Sample {
  std::vector<double> values;
  std::vector<double> areas;

  void add(double value, double area) {
    values.push_back(value);
    areas.push_back(area);
  }
  Distribution distribution() {
    Distribution out;
    if (values.empty()) return out;
    out.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    out.area_mean = std::inner_product(values.begin(), values.end(), areas.begin(), 0.0) /
                    std::accumulate(areas.begin(), areas.end(), 0.0);
    out.max = *std::max_element(values.begin(), values.end());
    out.p99 = quantile(values, 0.99);  // last: it reorders the values
    return out;
  }
};

/// How far a vertex of the face lies from its centroid along a direction: checkMesh's measure of the face's extent.
double extent_along(std::span<const Vec3> loop, const Vec3& centroid, const Vec3& direction) {
  double extent = 0.0;
  for (const Vec3& point : loop) extent = std::max(extent, std::abs(direction.dot(point - centroid)));
  return extent;
}

/// checkMesh's skewness: how far the line of centres crosses the face's plane from its centroid. `share` of the line's
/// length is the least extent that counts: 0.2 between cells, 0.4 of the distance to the plane on the boundary.
double skewness(std::span<const Vec3> loop, const PolygonGeometry& face, const Vec3& from, const Vec3& line,
                double share) {
  const Vec3 to_face = face.centroid - from;
  const double along = face.area_vector.dot(line);
  if (along == 0.0) return 0.0;  // a line in the face's plane: counted among the non-orthogonal ones
  const Vec3 miss = to_face - face.area_vector.dot(to_face) / along * line;
  const double distance = miss.norm();
  if (distance == 0.0) return 0.0;
  return distance / std::max(share * line.norm(), extent_along(loop, face.centroid, miss / distance));
}

class QualityPass {
 public:
  explicit QualityPass(const Mesh& mesh)
      : mesh_(mesh), geometry_(all_face_geometries(mesh)), smallest_area_(1e-9 * median_face_area(geometry_)) {}

  QualityReport run() {
    counts();
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) face(FaceId(f));
    distributions();
    cells();
    transmissibilities();
    return report_;
  }

 private:
  void counts() {
    for (const CellKind kind : mesh_.cells.kind) ++report_.cells_of_kind[static_cast<std::size_t>(kind)];
    report_.faces = static_cast<std::int64_t>(mesh_.faces.size());
    report_.vertices = static_cast<std::int64_t>(mesh_.vertices.size());
    report_.connections = static_cast<std::int64_t>(mesh_.connections.size());
    const auto [smallest, largest] = std::minmax_element(mesh_.cells.volume.begin(), mesh_.cells.volume.end());
    if (mesh_.cells.size() > 0) {
      report_.min_volume = *smallest;
      report_.max_volume = *largest;
    }
    if (mesh_.faces.size() > 0) report_.min_edge = report_.min_face_area = std::numeric_limits<double>::infinity();
  }

  void face(FaceId id) {
    const auto loop = face_points(mesh_, id, points_);
    const PolygonGeometry& face = geometry_[id];
    shape(loop, face);
    const auto& [first, second] = mesh_.faces.cells[id];
    if (second.is_valid())
      inner_face(loop, face, first, second);
    else
      boundary_face(loop, face, first);
  }

  void shape(std::span<const Vec3> loop, const PolygonGeometry& face) {
    double fan = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3& p = loop[i];
      const Vec3& q = loop[(i + 1) % loop.size()];
      report_.min_edge = std::min(report_.min_edge, (q - p).norm());
      fan += 0.5 * (p - face.mean).cross(q - face.mean).norm();
    }
    report_.min_face_area = std::min(report_.min_face_area, face.area);
    if (face.area > smallest_area_) report_.min_flatness = std::min(report_.min_flatness, face.area / fan);
  }

  void boundary_face(std::span<const Vec3> loop, const PolygonGeometry& face, CellId cell) {
    if (face.area <= smallest_area_) return;
    const Vec3& center = mesh_.cells.center[cell];
    const Vec3 normal = face.area_vector / face.area;
    const Vec3 line = normal.dot(face.centroid - center) * normal;
    report_.max_boundary_skewness = std::max(report_.max_boundary_skewness, skewness(loop, face, center, line, 0.4));
  }

  void inner_face(std::span<const Vec3> loop, const PolygonGeometry& face, CellId first, CellId second) {
    const double volume_a = mesh_.cells.volume[first];
    const double volume_b = mesh_.cells.volume[second];
    report_.min_volume_ratio =
        std::min(report_.min_volume_ratio, std::min(volume_a, volume_b) / std::max(volume_a, volume_b));
    if (face.area <= smallest_area_) return;

    const Vec3& a = mesh_.cells.center[first];
    const Vec3& b = mesh_.cells.center[second];
    const double angle = non_orthogonality(face.area_vector, b - a);
    const FacePair pair = face_pair(mesh_.cells.kind[first], mesh_.cells.kind[second]);
    angles_[static_cast<std::size_t>(pair)].add(angle, face.area);
    planarities_[static_cast<std::size_t>(pair)].add(planarity(loop, face), face.area);
    if (angle > quality_limit::severe_non_orthogonality) ++report_.faces_above_70_degrees;
    if (angle >= quality_limit::reversed_face && pair != FacePair::host) ++report_.made_faces_beyond_90_degrees;

    const double skew = skewness(loop, face, a, b - a, 0.2);
    report_.max_skewness = std::max(report_.max_skewness, skew);
    if (skew > quality_limit::skewness) ++report_.faces_above_skewness_4;

    const double to_a = std::abs(face.area_vector.dot(face.centroid - a));
    const double to_b = std::abs(face.area_vector.dot(b - face.centroid));
    const double weight = to_a + to_b > 0.0 ? std::min(to_a, to_b) / (to_a + to_b) : 0.0;
    report_.min_interpolation_weight = std::min(report_.min_interpolation_weight, weight);
    if (weight < quality_limit::interpolation_weight) ++report_.faces_below_weight_005;
  }

  void distributions() {
    std::array<Sample, face_pair_count> k_angles;
    for (std::size_t i = 0; i < mesh_.connections.size(); ++i) {
      const FaceId face = mesh_.connections.face[ConnectionId(i)];
      if (!face.is_valid() || geometry_[face].area <= smallest_area_) continue;
      const auto& [a, b] = mesh_.connections.cells[ConnectionId(i)];
      const FacePair pair = face_pair(mesh_.cells.kind[a], mesh_.cells.kind[b]);
      k_angles[static_cast<std::size_t>(pair)].add(mesh_.connections.k_non_orthogonality[ConnectionId(i)],
                                                   geometry_[face].area);
    }
    for (std::size_t p = 0; p < face_pair_count; ++p) {
      PairQuality& pair = report_.pairs[p];
      pair.faces = static_cast<std::int64_t>(angles_[p].values.size());
      pair.non_orthogonality = angles_[p].distribution();
      pair.k_non_orthogonality = k_angles[p].distribution();
      pair.planarity = planarities_[p].distribution();
    }
  }

  void cells() {
    const CellFaces faces = faces_of_cells(mesh_);
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) cell(CellId(c), faces.of(CellId(c)));
  }

  void cell(CellId id, std::span<const CellFace> faces) {
    Vec3 flux = Vec3::Zero();
    Vec3 projected = Vec3::Zero();  // sum of the areas' components without sign
    double area = 0.0;
    bool seen = true;
    for (const CellFace& side : faces) {
      const PolygonGeometry& face = geometry_[side.face];
      const double sign = side.outward ? 1.0 : -1.0;
      flux += sign * face.area_vector;
      projected += face.area_vector.cwiseAbs();
      area += face.area;
      seen =
          seen && sign * fan_volume6(face_points(mesh_, side.face, points_), face.mean, mesh_.cells.center[id]) > 0.0;
    }
    const double openness = area > 0.0 ? flux.norm() / area : 0.0;
    const double volume = mesh_.cells.volume[id];
    double aspect = projected.maxCoeff() / std::max(projected.minCoeff(), std::numeric_limits<double>::min());
    if (volume > 0.0) aspect = std::max(aspect, projected.sum() / 6.0 / std::pow(volume, 2.0 / 3.0));
    report_.max_openness = std::max(report_.max_openness, openness);
    report_.max_aspect_ratio = std::max(report_.max_aspect_ratio, aspect);
    if (openness > quality_limit::openness) ++report_.cells_above_openness_1e6;
    if (aspect > quality_limit::aspect_ratio) ++report_.cells_above_aspect_ratio_1000;
    if (!seen)
      ++(mesh_.cells.kind[id] >= CellKind::transition ? report_.made_cells_not_seen_from_centre
                                                      : report_.host_cells_not_seen_from_centre);
  }

  void transmissibilities() {
    for (const double t : mesh_.connections.transmissibility) {
      if (t < 0.0) ++report_.negative_transmissibilities;
      if (t == 0.0) ++report_.zero_transmissibilities;
    }
  }

  const Mesh& mesh_;
  IdVector<FaceId, PolygonGeometry> geometry_;
  double smallest_area_;  ///< m2; faces not above it have no meaningful angle
  QualityReport report_;
  std::array<Sample, face_pair_count> angles_;
  std::array<Sample, face_pair_count> planarities_;
  std::vector<Vec3> points_;
};

/// Worst values over the connections of each cell.
void add_connections(const Mesh& mesh, CellQuality& out) {
  std::vector<bool> connected(mesh.cells.size(), false);
  const Connections& all = mesh.connections;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ConnectionId id(i);
    for (const CellId cell : all.cells[id]) {
      const double t = all.transmissibility[id];
      out.min_transmissibility[cell] = connected[cell.index()] ? std::min(out.min_transmissibility[cell], t) : t;
      connected[cell.index()] = true;
      if (!all.face[id].is_valid()) continue;  // no face, no angle
      out.max_non_orthogonality[cell] = std::max(out.max_non_orthogonality[cell], all.non_orthogonality[id]);
      out.max_k_non_orthogonality[cell] = std::max(out.max_k_non_orthogonality[cell], all.k_non_orthogonality[id]);
      out.max_planarity[cell] = std::max(out.max_planarity[cell], all.planarity[id]);
    }
  }
}

}  // namespace

std::string_view name_of(FacePair pair) {
  static constexpr std::array<std::string_view, face_pair_count> names{
      "transition", "transition_host", "transition_radial", "radial", "host", "radial_host"};
  return names[static_cast<std::size_t>(pair)];
}

FacePair face_pair(CellKind a, CellKind b) {
  const auto is_host = [](CellKind kind) { return kind == CellKind::host || kind == CellKind::refined; };
  const bool transition = a == CellKind::transition || b == CellKind::transition;
  const bool radial = a == CellKind::radial || b == CellKind::radial;
  if (is_host(a) && is_host(b)) return FacePair::host;
  if (is_host(a) || is_host(b)) return transition ? FacePair::transition_host : FacePair::radial_host;
  if (transition && radial) return FacePair::transition_radial;
  return transition ? FacePair::transition : FacePair::radial;
}

double non_orthogonality(const Vec3& area_vector, const Vec3& line) {
  if (area_vector.norm() == 0.0 || line.norm() == 0.0) return 90.0;  // no direction, no flux
  // The arc cosine would lose half of the digits near 0.
  return std::atan2(area_vector.cross(line).norm(), area_vector.dot(line)) * 180.0 / std::numbers::pi;
}

double median_face_area(const IdVector<FaceId, PolygonGeometry>& faces) {
  std::vector<double> areas;
  areas.reserve(faces.size());
  for (const PolygonGeometry& face : faces) areas.push_back(face.area);
  return quantile(areas, 0.5);
}

QualityReport quality(const Mesh& mesh) { return QualityPass(mesh).run(); }

CellQuality cell_quality(const Mesh& mesh) {
  const std::size_t n = mesh.cells.size();
  CellQuality out;
  for (auto* values : {&out.max_non_orthogonality, &out.max_k_non_orthogonality, &out.max_planarity,
                       &out.min_transmissibility, &out.centring})
    values->resize(n, 0.0);
  add_connections(mesh, out);

  const CellFaces faces = faces_of_cells(mesh);
  const auto geometry = all_face_geometries(mesh);
  for (std::size_t c = 0; c < n; ++c) {
    const CellId cell(c);
    double nearest = std::numeric_limits<double>::infinity();
    for (const CellFace& side : faces.of(cell)) {
      const PolygonGeometry& face = geometry[side.face];
      if (face.area <= 0.0) continue;
      const double distance = face.area_vector.dot(face.centroid - mesh.cells.center[cell]) / face.area;
      nearest = std::min(nearest, side.outward ? distance : -distance);
    }
    if (std::isfinite(nearest) && mesh.cells.volume[cell] > 0.0)
      out.centring[cell] = nearest / std::cbrt(mesh.cells.volume[cell]);
  }
  return out;
}

}  // namespace wellknit
