// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/tube_flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "algorithm/metric_space.h"
#include "algorithm/rock_tensor.h"

namespace wellknit {

namespace {

Vec3 axis_of(const RadialMesh& m, int segment) {
  const auto station = static_cast<std::size_t>(segment);
  return m.axis[station + 1] - m.axis[station];
}

/// Circles of a layered tube are circles in plan.
BoreSection section_of(const Tube& tube, int segment) {
  const Vec3 axis = axis_of(tube.real, segment);
  return {axis, tube.layered ? Vec3(Vec3::UnitZ()) : axis};
}

/// Radius of a circle at a segment's first station, m; in plan for a layered tube, whose horizons may dip.
double circle_radius(const Tube& tube, int segment, int circle) {
  const Vec3 d = tube.real.point(segment, circle, 0) - tube.real.axis[static_cast<std::size_t>(segment)];
  return tube.layered ? std::hypot(d.x(), d.y()) : d.norm();
}

/// Radius of the bore at a segment, m. In another space a round bore is an ellipse, and the rings begin at
/// the largest of its mean radii.
double bore_of(const Tube& tube, int segment, double bore_radius) {
  if (tube.space.is_identity()) return circle_radius(tube, segment, 0);
  return std::min(circle_radius(tube, segment, 0),
                  moved_bore_radius(tube.space, tube.space.inverse * axis_of(tube.real, segment), bore_radius));
}

}  // namespace

double mean_pressure_radius(double inner, double outer) {
  const double a = inner * inner;
  const double b = outer * outer;
  return std::exp((b * std::log(outer) - a * std::log(inner)) / (b - a) - 0.5);
}

TubeSector::TubeSector(const Tube& tube, int segment, int sector, const Eigen::Matrix3d& k, double bore_radius)
    : mesh_(tube.real),
      space_(tube.space),
      layered_(tube.layered),
      segment_(segment),
      sector_(sector),
      section_(section_of(tube, segment)),
      field_(section_.permeability(moved_permeability(tube.space, k)), bore_of(tube, segment, bore_radius)) {
  if (!conducts()) return;
  const auto station = static_cast<std::size_t>(segment);
  for (int side = 0; side < 2; ++side) {
    const Vec3 offset = mesh_.point(segment, mesh_.rings, sector + side) - mesh_.axis[station] +
                        mesh_.point(segment + 1, mesh_.rings, sector + side) - mesh_.axis[station + 1];
    sides_[static_cast<std::size_t>(side)] = section_.in_plane(offset).normalized();
  }
  middle_ = (sides_[0] + sides_[1]).normalized();
  const double outermost = radius(mesh_.rings);
  share_ = std::abs(angle_between(field_.at(outermost * sides_[0]), field_.at(outermost * sides_[1])));
}

double TubeSector::radius(int circle) const {
  const Vec3 d = mesh_.point(segment_, circle, sector_) - mesh_.axis[static_cast<std::size_t>(segment_)];
  return layered_ ? std::hypot(d.x(), d.y()) : d.norm();
}

/// Along the section's normal.
double TubeSector::length(int circle, int side) const {
  const Vec3 edge = mesh_.point(segment_ + 1, circle, sector_ + side) - mesh_.point(segment_, circle, sector_ + side);
  return std::abs(section_.normal().dot(edge));
}

double TubeSector::half_to_circle(int ring, int circle) const {
  if (!conducts()) return 0.0;
  const double r0 = mean_pressure_radius(radius(ring), radius(ring + 1));
  return field_.conductance() * mean_length(circle) * share_ / std::abs(log_rho(radius(circle)) - log_rho(r0));
}

double TubeSector::half_to_side(int ring, int side) const {
  if (!conducts()) return 0.0;
  const double inner = radius(ring);
  const double outer = radius(ring + 1);
  const double r0 = mean_pressure_radius(inner, outer);
  const auto from = field_.at(r0 * middle_);
  const auto to = field_.at(r0 * sides_[static_cast<std::size_t>(side)]);
  const double around = std::abs(angle_between(from, to));
  const double along = std::log(std::abs(to) / std::abs(from));
  const double mean = 0.5 * (length(ring, side) + length(ring + 1, side));
  // Straight out the line of centres is along the circle's normal; across the sides it turns away from it, since ln rho
  // changes around the circle.
  return field_.conductance() * mean * std::log(outer / inner) * around / (around * around + along * along);
}

double TubeSector::half_beyond(const Vec3& area_vector, const Vec3& offset) const {
  if (!conducts()) return 0.0;
  const double distance = std::abs(moved_area(space_, area_vector).normalized().dot(space_.matrix * offset));
  const double r = radius(mesh_.rings);
  const double half_angle = 0.5 * std::acos(std::clamp(sides_[0].dot(sides_[1]), -1.0, 1.0));
  // The site stands off the chord. Very near the chord's middle it is inside the circle that the outermost ring's half
  // ends at: half the linear drop is kept as the least.
  const double site = r * std::cos(half_angle) + distance;
  const double drop = std::max(log_rho(std::max(site, r)) - log_rho(r), 0.5 * distance / r);
  return drop > 0.0 ? field_.conductance() * mean_length(mesh_.rings) * share_ / drop : 0.0;
}

double TubeSector::well_index(double skin) const {
  if (!conducts()) return 0.0;
  const double r0 = mean_pressure_radius(radius(0), radius(1));
  const double drop = log_rho(r0) - std::log(field_.bore()) + skin;
  return drop > 0.0 ? field_.conductance() * mean_length(0) * share_ / drop : 0.0;
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

std::vector<WellConnection> connect_tube(const Assembly& assembly, const PlacedTube& placed, const Well& well) {
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
      const double index =
          part *
          TubeSector(*placed.tube, k, s, rock_tensor(assembly, cell), well.radial.bore_radius).well_index(well.skin);
      if (index > 0.0) connections.push_back({cell, index, {md0, md1}});
    }
  }
  return connections;
}

}  // namespace wellknit
