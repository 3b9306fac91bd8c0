// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/minimum_curvature.h"

#include <algorithm>
#include <cmath>

namespace wellknit {

namespace {

/// tan(angle / 2) / (angle / 2): half of the sum of the two directions times this, times length, is the chord.
/// The series holds to rounding below a ten-thousandth of a radian, where the quotient loses digits.
double ratio_factor(double angle) {
  static constexpr double small = 1e-4;  // rad
  return angle < small ? 1.0 + angle * angle / 12.0 : 2.0 / angle * std::tan(angle / 2.0);
}

Vec3 chord(const Vec3& from, const Vec3& to, double angle, double length) {
  return 0.5 * length * ratio_factor(angle) * (from + to);
}

/// The direction at this fraction of an arc: between the two, at a constant rate of turning.
Vec3 direction_at(const Vec3& from, const Vec3& to, double angle, double fraction) {
  const double sine = std::sin(angle);
  return (std::sin((1.0 - fraction) * angle) * from + std::sin(fraction * angle) * to) / sine;
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

}  // namespace

Vec3 direction_of(const SurveyStation& station) {
  const double sine = std::sin(station.inclination);
  return {sine * std::sin(station.azimuth), sine * std::cos(station.azimuth), std::cos(station.inclination)};
}

double dogleg(const SurveyStation& from, const SurveyStation& to) {
  return angle_between(direction_of(from), direction_of(to));
}

std::vector<SurveyPoint> minimum_curvature(std::span<const SurveyStation> stations, const Vec3& start) {
  std::vector<SurveyPoint> path;
  if (stations.empty()) return path;
  path.push_back({stations.front().measured_depth, start, 0});
  for (std::size_t n = 1; n < stations.size(); ++n) {
    const Vec3 from = direction_of(stations[n - 1]);
    const Vec3 to = direction_of(stations[n]);
    const double angle = angle_between(from, to);
    const double length = stations[n].measured_depth - stations[n - 1].measured_depth;
    const Vec3 origin = path.back().point;
    const auto parts = static_cast<int>(std::ceil(angle / largest_turn));
    for (int part = 1; part < parts; ++part) {
      const double fraction = static_cast<double>(part) / parts;
      const Vec3 here = direction_at(from, to, angle, fraction);
      path.push_back({stations[n - 1].measured_depth + fraction * length,
                      origin + chord(from, here, fraction * angle, fraction * length), n});
    }
    path.push_back({stations[n].measured_depth, origin + chord(from, to, angle, length), n});
  }
  return path;
}

}  // namespace wellknit
