// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Least value of a smooth function of many unknowns.
///
/// Source: D. C. Liu, J. Nocedal, On the limited memory BFGS method for large scale optimization (key Liu1989).
#pragma once

#include <Eigen/Core>
#include <functional>

namespace wellknit {

struct QuasiNewtonOptions {
  int iterations = 100;
  int memory = 12;            ///< pairs of steps that the curvature is taken from
  double largest_step = 1.0;  ///< of any unknown in one iteration: unknowns are to be of order 1
  double least_gain = 1e-3;   ///< of the value in ten iterations, relative: less ends the search
};

struct QuasiNewtonResult {
  double before = 0.0;
  double after = 0.0;  ///< never above `before`
  int iterations = 0;
  int evaluations = 0;
};

/// The function's value at x, its gradient into the second argument (which has x's size).
using SmoothFunction = std::function<double(const Eigen::VectorXd& x, Eigen::VectorXd& gradient)>;

/// Moves x downhill. Each step is cut until the value falls by a ten-thousandth of what the gradient promises.
QuasiNewtonResult minimise(const SmoothFunction& function, Eigen::VectorXd& x, const QuasiNewtonOptions& options);

}  // namespace wellknit
