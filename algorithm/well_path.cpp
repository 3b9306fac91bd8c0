// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/well_path.h"

#include <fmt/format.h>

#include <algorithm>

#include "model/errors.h"

namespace wellknit {

double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto upper = std::upper_bound(x.begin(), x.end(), at);
  const auto i = std::clamp<std::size_t>(static_cast<std::size_t>(upper - x.begin()), 1, x.size() - 1) - 1;
  return y[i] + (at - x[i]) / (x[i + 1] - x[i]) * (y[i + 1] - y[i]);
}

WellPath::WellPath(const Trajectory& trajectory)
    : depth_(trajectory.measured_depth), points_(trajectory.points), original_(trajectory.moved.measured_depth) {
  const std::size_t n = points_.size();
  if (n < 2 || depth_.size() != n) throw InvalidInput("a trajectory needs two or more stations");
  for (std::size_t i = 1; i < n; ++i)
    if (!(depth_[i] > depth_[i - 1]))
      throw InvalidInput(
          fmt::format("measured depth does not rise at station {}: {} after {}", i + 1, depth_[i], depth_[i - 1]));
  slopes_.resize(n);
  const auto chord = [&](std::size_t i) { return Vec3((points_[i + 1] - points_[i]) / (depth_[i + 1] - depth_[i])); };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = depth_[i] - depth_[i - 1];
    const double after = depth_[i + 1] - depth_[i];
    slopes_[i] = (after * chord(i - 1) + before * chord(i)) / (before + after);
  }
  if (n == 2) {
    slopes_[0] = slopes_[1] = chord(0);
  } else {
    slopes_[0] = 1.5 * chord(0) - 0.5 * slopes_[1];
    slopes_[n - 1] = 1.5 * chord(n - 2) - 0.5 * slopes_[n - 2];
  }
}

std::size_t WellPath::interval(double measured_depth) const {
  const auto upper = std::upper_bound(depth_.begin(), depth_.end(), measured_depth);
  const auto i = static_cast<std::size_t>(std::distance(depth_.begin(), upper));
  return std::clamp<std::size_t>(i, 1, depth_.size() - 1) - 1;
}

Vec3 WellPath::point(double measured_depth) const {
  if (measured_depth <= depth_.front()) return points_.front() + (measured_depth - depth_.front()) * slopes_.front();
  if (measured_depth >= depth_.back()) return points_.back() + (measured_depth - depth_.back()) * slopes_.back();
  const std::size_t i = interval(measured_depth);
  const double h = depth_[i + 1] - depth_[i];
  const double t = (measured_depth - depth_[i]) / h;
  const double s = 1.0 - t;
  return s * s * (1.0 + 2.0 * t) * points_[i] + t * t * (3.0 - 2.0 * t) * points_[i + 1] +
         h * t * s * (s * slopes_[i] - t * slopes_[i + 1]);
}

Vec3 WellPath::derivative(double measured_depth) const {
  if (measured_depth <= depth_.front()) return slopes_.front();
  if (measured_depth >= depth_.back()) return slopes_.back();
  const std::size_t i = interval(measured_depth);
  const double h = depth_[i + 1] - depth_[i];
  const double t = (measured_depth - depth_[i]) / h;
  return 6.0 * t * (1.0 - t) / h * (points_[i + 1] - points_[i]) + (1.0 - t) * (1.0 - 3.0 * t) * slopes_[i] +
         t * (3.0 * t - 2.0) * slopes_[i + 1];
}

double WellPath::original(double measured_depth) const {
  return original_.empty() ? measured_depth : interpolated(depth_, original_, measured_depth);
}

}  // namespace wellknit
