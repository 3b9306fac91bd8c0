// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A smooth curve through the stations of a survey, by measured depth.
#pragma once

#include "model/well.h"

namespace wellknit {

/// Cubic Hermite curve through all stations; C1, so that a sweep along it does not see the survey's kinks.
class WellPath {
 public:
  /// Throws InvalidInput when there are fewer than two stations or measured depth does not rise strictly.
  explicit WellPath(const Trajectory& trajectory);

  [[nodiscard]] double first_depth() const { return depth_.front(); }
  [[nodiscard]] double last_depth() const { return depth_.back(); }
  /// The point at this measured depth, m; beyond the ends the curve goes on straight.
  [[nodiscard]] Vec3 point(double measured_depth) const;
  /// Derivative of the point with respect to measured depth, not normalised.
  [[nodiscard]] Vec3 derivative(double measured_depth) const;
  /// The measured depth, m, that this one was before the path was moved (Trajectory::moved).
  [[nodiscard]] double original(double measured_depth) const;

 private:
  [[nodiscard]] std::size_t interval(double measured_depth) const;

  std::vector<double> depth_;
  std::vector<Vec3> points_;
  std::vector<Vec3> slopes_;  ///< derivative at the stations
  std::vector<double> original_;
};

/// The piecewise linear function through (x, y) at a place; beyond the ends its end pieces go on. `x` rises strictly;
/// two points or more.
double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at);

}  // namespace wellknit
