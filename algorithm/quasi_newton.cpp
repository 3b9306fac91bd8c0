// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/quasi_newton.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <vector>

namespace wellknit {

namespace {

/// What the last steps say of the curvature.
class Memory {
 public:
  explicit Memory(int most) : most_(static_cast<std::size_t>(most)) {}

  void add(Eigen::VectorXd step, Eigen::VectorXd change) {
    const double product = step.dot(change);
    // Without positive curvature along the step the pair says nothing of a minimum.
    if (!(product > 1e-10 * step.norm() * change.norm())) return;
    pairs_.push_back({std::move(step), std::move(change), 1.0 / product});
    if (pairs_.size() > most_) pairs_.pop_front();
  }

  void forget() { pairs_.clear(); }
  [[nodiscard]] bool empty() const { return pairs_.empty(); }

  /// The step that the memory takes for Newton's.
  [[nodiscard]] Eigen::VectorXd descent(const Eigen::VectorXd& gradient) const {
    Eigen::VectorXd q = -gradient;
    std::vector<double> alpha(pairs_.size());
    for (std::size_t i = pairs_.size(); i-- > 0;) {
      alpha[i] = pairs_[i].inverse * pairs_[i].step.dot(q);
      q -= alpha[i] * pairs_[i].change;
    }
    if (!pairs_.empty()) {
      const Pair& last = pairs_.back();
      q *= 1.0 / (last.inverse * last.change.squaredNorm());
    }
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      q += (alpha[i] - pairs_[i].inverse * pairs_[i].change.dot(q)) * pairs_[i].step;
    return q;
  }

 private:
  struct Pair {
    Eigen::VectorXd step;
    Eigen::VectorXd change;  ///< of the gradient
    double inverse;          ///< 1 / (step . change)
  };
  std::size_t most_;
  std::deque<Pair> pairs_;
};

}  // namespace

QuasiNewtonResult minimise(const SmoothFunction& function, Eigen::VectorXd& x, const QuasiNewtonOptions& options) {
  constexpr double sufficient = 1e-4;
  constexpr double shortest = 1e-8;
  constexpr int stretch = 10;
  QuasiNewtonResult out;
  Eigen::VectorXd gradient(x.size());
  Eigen::VectorXd next_gradient(x.size());
  double value = function(x, gradient);
  out.before = out.after = value;
  out.evaluations = 1;
  Memory memory(options.memory);
  double at_stretch = value;
  while (out.iterations < options.iterations) {
    Eigen::VectorXd direction = memory.descent(gradient);
    double slope = gradient.dot(direction);
    if (!(slope < 0.0)) {
      memory.forget();
      direction = -gradient;
      slope = -gradient.squaredNorm();
      if (!(slope < 0.0)) break;
    }
    const double largest = direction.cwiseAbs().maxCoeff();
    // The first step has no scale of its own.
    const double limit = memory.empty() ? 0.1 * options.largest_step : options.largest_step;
    double length = memory.empty() ? limit / largest : std::min(1.0, limit / largest);
    Eigen::VectorXd next;
    double next_value = value;
    bool is_found = false;
    while (length * largest > shortest) {
      next = x + length * direction;
      next_value = function(next, next_gradient);
      ++out.evaluations;
      if (next_value <= value + sufficient * length * slope) {
        is_found = true;
        break;
      }
      // The parabola through value, slope and the new value has its least there.
      const double parabola = -0.5 * slope * length / ((next_value - value) / length - slope);
      length *= std::clamp(parabola / length, 0.1, 0.5);
    }
    if (!is_found) {
      if (memory.empty()) break;
      memory.forget();
      continue;
    }
    memory.add(next - x, next_gradient - gradient);
    x = std::move(next);
    gradient = next_gradient;
    value = next_value;
    if (++out.iterations % stretch != 0) continue;
    if (at_stretch - value < options.least_gain * std::abs(at_stretch)) break;
    at_stretch = value;
  }
  out.after = value;
  return out;
}

}  // namespace wellknit
