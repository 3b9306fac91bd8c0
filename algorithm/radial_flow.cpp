// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/radial_flow.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

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
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    if (k % run_length == 0) out.runs.emplace_back();
    for (const Vec3& p : {points[k], points[k + 1]}) {
      out.runs.back().add(p);
      out.box.add(p);
    }
    out.pieces.push_back({points[k], points[k + 1]});
  }
  return out;
}

RadialFlow::Nearest RadialFlow::nearest_on(const Axis& axis, const Vec3& point) {
  Nearest out;
  out.axis = &axis;
  const auto& pieces = axis.pieces;
  std::size_t best = pieces.size();
  const auto look_at = [&](std::size_t run) {
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
  };
  const auto nearest = std::min_element(axis.runs.begin(), axis.runs.end(), [&](const Box& one, const Box& other) {
    return one.distance(point) < other.distance(point);
  });
  const auto first = static_cast<std::size_t>(std::distance(axis.runs.begin(), nearest));
  look_at(first);
  for (std::size_t run = 0; run < axis.runs.size(); ++run)
    // A billionth: rounding must not pass over the nearest piece.
    if (run != first && axis.runs[run].distance(point) <= out.distance * (1.0 + 1e-9)) look_at(run);
  return out;
}

RadialFlow::Nearest RadialFlow::nearest_axis(const Vec3& point) const {
  Nearest out;
  for (const Axis& axis : axes_) {
    if (axis.box.distance(point) > out.next_distance) continue;
    Nearest other = nearest_on(axis, point);
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
