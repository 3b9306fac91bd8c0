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

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// Share of the weights in each class; empty where they add up to nothing.
std::vector<double> shares(const std::vector<double>& values, const std::vector<double>& weights,
                           std::span<const double> classes) {
  const double total = sum(weights);
  if (!(total > 0.0)) return {};
  std::vector<double> out(classes.size(), 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto above = std::upper_bound(classes.begin() + 1, classes.end(), values[i]);
    out[static_cast<std::size_t>(above - classes.begin()) - 1] += weights[i] / total;
  }
  return out;
}

/// What the faces of one kind are weighted with, in the order of their values.
struct Weights {
  std::vector<double> areas;
  std::vector<double> flows;  ///< m3/s without sign; empty without a solution

  void reserve(std::size_t faces, bool has_flow) {
    areas.reserve(faces);
    if (has_flow) flows.reserve(faces);
  }
};

/// Takes the values, in an order of its own, and leaves none.
Distribution distribution(FaceMeasure measure, std::vector<double>& values, const Weights& weights) {
  Distribution out;
  if (values.empty()) return out;
  const auto weighted = [&](const std::vector<double>& by) {
    return std::inner_product(values.begin(), values.end(), by.begin(), 0.0) / sum(by);
  };
  out.mean = sum(values) / static_cast<double>(values.size());
  out.area_mean = weighted(weights.areas);
  out.area_share = shares(values, weights.areas, classes_of(measure));
  out.flow_share = shares(values, weights.flows, classes_of(measure));
  if (!out.flow_share.empty()) out.flow_mean = weighted(weights.flows);
  out.max = *std::max_element(values.begin(), values.end());
  out.p99 = quantile(values, 0.99);  // last: it reorders the values
  values = {};
  return out;
}

/// Flow through each face without sign, m3/s; 0 where it is not known. Empty without a solution.
IdVector<FaceId, double> flow_of_faces(const Mesh& mesh) {
  if (!mesh.flow || mesh.flow->flux.size() != mesh.connections.size()) return {};
  IdVector<FaceId, double> out(mesh.faces.size(), 0.0);
  for (std::size_t i = 0; i < mesh.connections.size(); ++i) {
    const FaceId face = mesh.connections.face[ConnectionId(i)];
    const double flux = mesh.flow->flux[ConnectionId(i)];
    if (face.is_valid() && std::isfinite(flux)) out[face] += std::abs(flux);
  }
  return out;
}

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
      : mesh_(mesh),
        geometry_(all_face_geometries(mesh)),
        flow_(flow_of_faces(mesh)),
        smallest_area_(1e-9 * median_face_area(geometry_)) {}

  /// Of a large mesh the arrays of faces are most of what a run of the program holds: each is gone after its last use.
  QualityReport run() {
    counts();
    reserve();
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) face(FaceId(f));
    for (std::size_t p = 0; p < face_pair_count; ++p) distributions(p);
    connections();
    cells();
    geometry_ = {};
    transmissibilities();
    report_.conservation = conservation(mesh_);
    report_.linear_flux = linear_flux_errors(mesh_);
    report_.polymesh = polymesh_quality(mesh_);
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

  void reserve() {
    std::array<std::size_t, face_pair_count> faces{};
    for (const auto& [first, second] : mesh_.faces.cells)
      if (second.is_valid())
        ++faces[static_cast<std::size_t>(face_pair(mesh_.cells.kind[first], mesh_.cells.kind[second]))];
    for (std::size_t p = 0; p < face_pair_count; ++p) {
      weights_[p].reserve(faces[p], has_flow());
      for (auto* values : {&non_orthogonality_[p], &planarity_[p], &skewness_[p]}) values->reserve(faces[p]);
    }
  }

  void face(FaceId id) {
    const auto loop = face_points(mesh_, id, points_);
    const PolygonGeometry& face = geometry_[id];
    shape(loop, face);
    const auto& [first, second] = mesh_.faces.cells[id];
    if (second.is_valid())
      inner_face(loop, id, first, second);
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

  void inner_face(std::span<const Vec3> loop, FaceId id, CellId first, CellId second) {
    const PolygonGeometry& face = geometry_[id];
    const double volume_a = mesh_.cells.volume[first];
    const double volume_b = mesh_.cells.volume[second];
    report_.min_volume_ratio =
        std::min(report_.min_volume_ratio, std::min(volume_a, volume_b) / std::max(volume_a, volume_b));
    if (face.area <= smallest_area_) return;

    const Vec3& a = mesh_.cells.center[first];
    const Vec3& b = mesh_.cells.center[second];
    const double angle = non_orthogonality(face.area_vector, b - a);
    const FacePair pair = face_pair(mesh_.cells.kind[first], mesh_.cells.kind[second]);
    const auto p = static_cast<std::size_t>(pair);
    weigh(id, weights_[p]);
    non_orthogonality_[p].push_back(angle);
    planarity_[p].push_back(planarity(loop, face));
    if (angle > quality_limit::severe_non_orthogonality) ++report_.faces_above_70_degrees;
    if (angle >= quality_limit::reversed_face && pair != FacePair::host) ++report_.made_faces_beyond_90_degrees;

    const double skew = skewness(loop, face, a, b - a, 0.2);
    skewness_[p].push_back(skew);
    report_.max_skewness = std::max(report_.max_skewness, skew);
    if (skew > quality_limit::skewness) ++report_.faces_above_skewness_4;

    const double to_a = std::abs(face.area_vector.dot(face.centroid - a));
    const double to_b = std::abs(face.area_vector.dot(b - face.centroid));
    const double weight = to_a + to_b > 0.0 ? std::min(to_a, to_b) / (to_a + to_b) : 0.0;
    report_.min_interpolation_weight = std::min(report_.min_interpolation_weight, weight);
    if (weight < quality_limit::interpolation_weight) ++report_.faces_below_weight_005;
  }

  void distributions(std::size_t p) {
    PairQuality& out = report_.pairs[p];
    out.faces = static_cast<std::int64_t>(non_orthogonality_[p].size());
    out.area = sum(weights_[p].areas);
    out.non_orthogonality = distribution(FaceMeasure::non_orthogonality, non_orthogonality_[p], weights_[p]);
    out.planarity = distribution(FaceMeasure::planarity, planarity_[p], weights_[p]);
    out.skewness = distribution(FaceMeasure::skewness, skewness_[p], weights_[p]);
    weights_[p] = {};
  }

  /// K-non-orthogonality belongs to connections, of which a face may have none.
  void connections() {
    std::array<std::vector<double>, face_pair_count> angles;
    const auto each = [&](const auto& take) {
      for (std::size_t i = 0; i < mesh_.connections.size(); ++i) {
        const ConnectionId id(i);
        const FaceId face = mesh_.connections.face[id];
        if (!face.is_valid() || geometry_[face].area <= smallest_area_) continue;
        const auto& [a, b] = mesh_.connections.cells[id];
        take(static_cast<std::size_t>(face_pair(mesh_.cells.kind[a], mesh_.cells.kind[b])), id, face);
      }
    };
    std::array<std::size_t, face_pair_count> counts{};
    each([&](std::size_t p, ConnectionId, FaceId) { ++counts[p]; });
    for (std::size_t p = 0; p < face_pair_count; ++p) {
      angles[p].reserve(counts[p]);
      weights_[p].reserve(counts[p], has_flow());
    }
    each([&](std::size_t p, ConnectionId id, FaceId face) {
      weigh(face, weights_[p]);
      angles[p].push_back(mesh_.connections.k_non_orthogonality[id]);
    });
    for (std::size_t p = 0; p < face_pair_count; ++p) {
      report_.pairs[p].k_non_orthogonality = distribution(FaceMeasure::k_non_orthogonality, angles[p], weights_[p]);
      weights_[p] = {};
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

  [[nodiscard]] bool has_flow() const { return flow_.size() > 0; }
  void weigh(FaceId face, Weights& weights) const {
    weights.areas.push_back(geometry_[face].area);
    if (has_flow()) weights.flows.push_back(flow_[face]);
  }

  const Mesh& mesh_;
  IdVector<FaceId, PolygonGeometry> geometry_;
  IdVector<FaceId, double> flow_;
  double smallest_area_;  ///< m2; faces not above it have no meaningful angle
  QualityReport report_;
  // Of the inner faces, by pair of cells.
  std::array<Weights, face_pair_count> weights_;
  std::array<std::vector<double>, face_pair_count> non_orthogonality_, planarity_, skewness_;
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

/// Smallest distance of each cell's centre from its faces, over its size. Face by face: no array of them is needed.
void add_centring(const Mesh& mesh, CellQuality& out) {
  auto& nearest = out.centring;
  nearest.resize(mesh.cells.size(), std::numeric_limits<double>::infinity());
  std::vector<Vec3> points;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const PolygonGeometry face = polygon_geometry(face_points(mesh, FaceId(f), points));
    if (face.area <= 0.0) continue;
    double sign = 1.0;
    for (const CellId cell : mesh.faces.cells[FaceId(f)]) {
      if (cell.is_valid()) {
        const double distance = face.area_vector.dot(face.centroid - mesh.cells.center[cell]) / face.area;
        nearest[cell] = std::min(nearest[cell], sign * distance);
      }
      sign = -1.0;
    }
  }
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const CellId cell(c);
    const bool is_known = std::isfinite(nearest[cell]) && mesh.cells.volume[cell] > 0.0;
    nearest[cell] = is_known ? nearest[cell] / std::cbrt(mesh.cells.volume[cell]) : 0.0;
  }
}

/// Largest skewness over each cell's inner faces.
void add_skewness(const Mesh& mesh, const IdVector<FaceId, PolygonGeometry>& geometry, CellQuality& out) {
  const double smallest_area = 1e-9 * median_face_area(geometry);
  std::vector<Vec3> points;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const PolygonGeometry& face = geometry[FaceId(f)];
    const auto& [first, second] = mesh.faces.cells[FaceId(f)];
    if (!second.is_valid() || face.area <= smallest_area) continue;
    const Vec3& from = mesh.cells.center[first];
    const double skew =
        skewness(face_points(mesh, FaceId(f), points), face, from, mesh.cells.center[second] - from, 0.2);
    for (const CellId cell : {first, second}) out.max_skewness[cell] = std::max(out.max_skewness[cell], skew);
  }
}

}  // namespace

std::string_view name_of(FaceMeasure measure) {
  static constexpr std::array<std::string_view, face_measure_count> names{"nonorth", "knonorth", "planarity",
                                                                          "skewness"};
  return names[static_cast<std::size_t>(measure)];
}

std::span<const double> classes_of(FaceMeasure measure) {
  static constexpr std::array angles{0.0,  5.0,  10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0,
                                     50.0, 55.0, 60.0, 65.0, 70.0, 75.0, 80.0, 85.0, 90.0};
  static constexpr std::array flatness{0.0,   1e-6,   3.2e-6, 1e-5,  3.2e-5, 1e-4, 3.2e-4,
                                       0.001, 0.0032, 0.01,   0.032, 0.1,    0.32};
  static constexpr std::array skewness{0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.5, 2.0, 3.0, 4.0};
  if (measure == FaceMeasure::planarity) return flatness;
  if (measure == FaceMeasure::skewness) return skewness;
  return angles;
}

const Distribution& PairQuality::of(FaceMeasure measure) const {
  switch (measure) {
    case FaceMeasure::k_non_orthogonality: return k_non_orthogonality;
    case FaceMeasure::planarity: return planarity;
    case FaceMeasure::skewness: return skewness;
    default: return non_orthogonality;
  }
}

std::optional<MadeFaces> made_faces(const QualityReport& report, FaceMeasure measure) {
  MadeFaces out;
  double area = 0.0;
  for (std::size_t p = 0; p < face_pair_count; ++p) {
    const PairQuality& pair = report.pairs[p];
    if (FacePair(p) == FacePair::host || pair.faces == 0) continue;
    out.max = std::max(out.max, pair.of(measure).max);
    out.area_mean += pair.area * pair.of(measure).area_mean;
    area += pair.area;
  }
  if (area == 0.0) return std::nullopt;
  out.area_mean /= area;
  return out;
}

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

CellQuality cell_quality_without_skewness(const Mesh& mesh) {
  const std::size_t n = mesh.cells.size();
  CellQuality out;
  for (auto* values :
       {&out.max_non_orthogonality, &out.max_k_non_orthogonality, &out.max_planarity, &out.min_transmissibility})
    values->resize(n, 0.0);
  add_connections(mesh, out);
  add_centring(mesh, out);
  return out;
}

CellQuality cell_quality(const Mesh& mesh) {
  CellQuality out = cell_quality_without_skewness(mesh);
  out.max_skewness.resize(mesh.cells.size(), 0.0);
  add_skewness(mesh, all_face_geometries(mesh), out);
  return out;
}

}  // namespace wellknit
