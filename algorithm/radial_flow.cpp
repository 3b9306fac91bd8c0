// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/radial_flow.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "algorithm/line_sink.h"

namespace wellknit {

namespace {

/// Foot of a point on a segment; `parameter` is below 0 or above 1 where it would lie beyond one of the ends.
Vec3 foot_on(const Vec3& from, const Vec3& to, const Vec3& point, double& parameter) {
  const Vec3 along = to - from;
  parameter = (point - from).dot(along) / along.squaredNorm();
  return from + std::clamp(parameter, 0.0, 1.0) * along;
}

/// Flux of ln rho through a face: each triangle of its fan by the middles of the edges.
double flux_through(const LinearFace& face, const BoreSection& section, const LineSink& sink, const Vec3& foot) {
  const Vec3& mean = face.geometry.mean;
  const auto gradient = [&](const Vec3& a, const Vec3& b) {
    return section.gradient(sink.gradient(section.along_axis(0.5 * (a + b) - foot)));
  };
  const Vec3 first = gradient(mean, face.points[0]);
  Vec3 before = first;
  double sum = 0.0;
  for (std::size_t i = 0; i < face.points.size(); ++i) {
    const std::size_t next = (i + 1) % face.points.size();
    const Vec3& a = face.points[i];
    const Vec3& b = face.points[next];
    const Vec3 after = next == 0 ? first : gradient(mean, b);
    const Vec3 flux_vector = face.permeability * (0.5 * (a - mean).cross(b - mean));
    sum += flux_vector.dot(before + gradient(a, b) + after) / 3.0;
    before = after;
  }
  return sum;
}

/// Square of a line's length where the permeability measures: l.K^-1 l, 1; infinite where K cannot be inverted.
double squared_length(const Eigen::Matrix3d& k, const Vec3& line) {
  Eigen::Matrix3d inverse;
  bool is_invertible = false;
  // In units of its trace, so that the threshold has no unit.
  const double scale = k.trace();
  (k / scale).computeInverseWithCheck(inverse, is_invertible, 1e-18);
  return is_invertible ? line.dot(inverse * line) / scale : std::numeric_limits<double>::infinity();
}

}  // namespace

double permeability_cosine(const Eigen::Matrix3d& k, const Vec3& area_vector, const Vec3& line) {
  const double length = std::sqrt(squared_length(k, line));
  const double area = std::sqrt(area_vector.dot(k * area_vector));
  if (!std::isfinite(length) || !(length > 0.0) || !(area > 0.0)) return 1.0;
  return std::min(1.0, std::abs(area_vector.dot(line)) / (area * length));
}

RadialFlow::RadialFlow(const std::vector<PlacedTube>& tubes, const std::vector<Well>& wells) {
  for (const PlacedTube& t : tubes) axes_.push_back(axis_of(*t.tube, wells[t.tube->well]));
}

RadialFlow::Axis RadialFlow::axis_of(const Tube& tube, const Well& well) {
  std::vector<Vec3> points = tube.real.axis;
  const auto& depths = tube.real.measured_depth;
  if (!tube.space.is_identity())
    for (Vec3& p : points) p = tube.space.from(p);
  // What the well goes on, straight, as far as it matters to cells beside the tube.
  const double most = 4.0 * (tube.real.point(0, tube.real.rings, 0) - tube.real.axis[0]).norm();
  const Vec3 first = (points[0] - points[1]).normalized();
  const Vec3 last = (points.back() - points[points.size() - 2]).normalized();
  const bool is_downwards = depths.front() < depths.back();
  const auto [least, largest] = std::minmax(depths.front(), depths.back());
  const double before = std::clamp(least - well.trajectory.measured_depth.front(), 0.0, most);
  const double after = std::clamp(well.trajectory.measured_depth.back() - largest, 0.0, most);
  if (const double more = is_downwards ? before : after; more > 0.0)
    points.insert(points.begin(), points.front() + more * first);
  if (const double more = is_downwards ? after : before; more > 0.0) points.push_back(points.back() + more * last);
  Axis out;
  out.tube = &tube;
  out.bore_radius =
      tube.space.is_identity() ? (tube.real.point(0, 0, 0) - tube.real.axis[0]).norm() : well.radial.bore_radius;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) out.pieces.push_back({points[k], points[k + 1]});
  while (out.leaves * run_length < out.pieces.size()) out.leaves *= 2;
  out.boxes.resize(2 * out.leaves - 1);
  for (std::size_t k = 0; k < out.pieces.size(); ++k) {
    Box& leaf = out.boxes[out.leaves - 1 + k / run_length];
    leaf.add(out.pieces[k].from);
    leaf.add(out.pieces[k].to);
  }
  for (std::size_t n = out.leaves - 1; n-- > 0;) {
    out.boxes[n] = out.boxes[2 * n + 1];
    out.boxes[n].add(out.boxes[2 * n + 2]);
  }
  return out;
}

void RadialFlow::look_at_run(const Axis& axis, std::size_t run, const Vec3& point, std::size_t& best, Nearest& out) {
  const auto& pieces = axis.pieces;
  const std::size_t end = std::min((run + 1) * run_length, pieces.size());
  for (std::size_t k = run * run_length; k < end; ++k) {
    double parameter = 0.0;
    const Vec3 foot = foot_on(pieces[k].from, pieces[k].to, point, parameter);
    const double distance = (point - foot).norm();
    // Of two that meet at the foot the first, whatever the order.
    if (distance > out.distance || (distance == out.distance && k > best)) continue;
    best = k;
    out.distance = distance;
    out.foot = foot;
    out.along = pieces[k].to - pieces[k].from;
    out.is_beyond_end = (k == 0 && parameter < 0.0) || (k + 1 == pieces.size() && parameter > 1.0);
  }
}

/// The nearer half first; what is farther than the nearest piece is passed over.
void RadialFlow::look_below(const Axis& axis, std::size_t box, const Vec3& point, std::size_t& best, Nearest& out) {
  if (box + 1 >= axis.leaves) return look_at_run(axis, box + 1 - axis.leaves, point, best, out);
  std::array<std::size_t, 2> halves{2 * box + 1, 2 * box + 2};
  std::array<double, 2> distances{axis.boxes[halves[0]].distance(point), axis.boxes[halves[1]].distance(point)};
  if (distances[1] < distances[0]) {
    std::swap(halves[0], halves[1]);
    std::swap(distances[0], distances[1]);
  }
  for (std::size_t h = 0; h < 2; ++h)
    // A billionth: rounding must not pass over the nearest piece.
    if (distances[h] <= out.distance * (1.0 + 1e-9)) look_below(axis, halves[h], point, best, out);
}

RadialFlow::Nearest RadialFlow::nearest_on(const Axis& axis, const Vec3& point, double most) {
  Nearest out;
  out.axis = &axis;
  std::size_t best = axis.pieces.size();
  if (axis.boxes[0].distance(point) <= most) {
    // Pieces farther than that are not looked for.
    out.distance = std::isfinite(most) ? most * (1.0 + 1e-9) : most;
    look_below(axis, 0, point, best, out);
  }
  if (best == axis.pieces.size()) out.distance = std::numeric_limits<double>::infinity();
  return out;
}

RadialFlow::Nearest RadialFlow::nearest_axis(const Vec3& point) const {
  Nearest out;
  for (const Axis& axis : axes_) {
    // Another well more than twice as far does not count: factor().
    Nearest other = nearest_on(axis, point, std::min(out.next_distance, 2.0 * out.distance));
    if (!std::isfinite(other.distance)) continue;
    const bool is_same_well = out.axis == nullptr || out.axis->tube->well == axis.tube->well;
    if (other.distance < out.distance) {
      other.next_distance = is_same_well ? out.next_distance : out.distance;
      out = other;
    } else if (!is_same_well) {
      out.next_distance = std::min(out.next_distance, other.distance);
    }
  }
  return out;
}

RadialFlow::Factor RadialFlow::factor(const LinearFace& face) const {
  if (!(face.geometry.area > 0.0) || !(face.transmissibility > 0.0)) return {};
  const Nearest near = nearest_axis(face.geometry.mean);
  if (near.axis == nullptr || near.is_beyond_end || !(near.distance > 0.0)) return {};
  const double alone = std::clamp(near.next_distance / near.distance - 1.0, 0.0, 1.0);
  const BoreSection section(near.along, near.axis->tube->layered ? Vec3(Vec3::UnitZ()) : near.along);
  const LineSink sink(section.permeability(face.permeability), near.axis->bore_radius);
  if (!(alone > 0.0) || !(sink.conductance() > 0.0)) return {};
  const auto rho = [&](const Vec3& point) { return std::abs(sink.at(section.along_axis(point - near.foot))); };
  const double drop = std::log(rho(face.centers[1]) / rho(face.centers[0]));
  const double length =
      std::sqrt(sink.conductance() * squared_length(face.permeability, face.centers[1] - face.centers[0]));
  // 1: straight out; 0: around the well or along it.
  const double radial_part = std::abs(drop) * rho(face.geometry.mean) / length;
  const double turn = std::clamp((radial_part - 0.1) / 0.2, 0.0, 1.0);
  if (!(turn > 0.0)) return {};
  const double flux = flux_through(face, section, sink, near.foot);
  const double radial = turn * alone;
  return {1.0 + radial * (std::clamp(std::abs(flux / drop) / face.transmissibility, 0.5, 2.0) - 1.0), radial,
          WellField{section, sink, near.foot, flux}};
}

}  // namespace wellknit
