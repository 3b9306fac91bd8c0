// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/untangle.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace wellknit {

namespace {

double shortfall(const VertexBall& ball, double beta, const Vec3& p) {
  double sum = 0.0;
  for (std::size_t j = 0; j < ball.offset.size(); ++j) {
    const double s = std::max(0.0, beta - ball.value(j, p));
    sum += s * s;
  }
  return sum;
}

double largest_value(const VertexBall& ball, const Vec3& p) {
  double largest = 0.0;
  for (std::size_t j = 0; j < ball.offset.size(); ++j) largest = std::max(largest, std::abs(ball.value(j, p)));
  return largest;
}

}  // namespace

double VertexBall::smallest(const Vec3& p) const {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < offset.size(); ++j) smallest = std::min(smallest, value(j, p));
  return smallest;
}

Vec3 minimise_shortfall(const VertexBall& ball, double beta, const Vec3& start) {
  Vec3 p = start;
  double f = shortfall(ball, beta, p);
  for (int step = 0; step < 30 && f > 0.0; ++step) {
    Vec3 gradient = Vec3::Zero();
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
    for (std::size_t j = 0; j < ball.offset.size(); ++j) {
      const double s = beta - ball.value(j, p);
      if (s <= 0.0) continue;
      gradient -= 2.0 * s * ball.gradient[j];
      hessian += 2.0 * ball.gradient[j] * ball.gradient[j].transpose();
    }
    // A millionth of the trace: fewer than three active values leave directions without curvature.
    hessian += 1e-6 * hessian.trace() * Eigen::Matrix3d::Identity();
    const Vec3 move = -hessian.ldlt().solve(gradient);
    double length = 1.0;
    double next = shortfall(ball, beta, p + move);
    while (next > f && length > 1e-4) {
      length *= 0.5;
      next = shortfall(ball, beta, p + length * move);
    }
    if (!(next < f)) break;
    const bool is_done = f - next <= 1e-12 * f;
    p += length * move;
    f = next;
    if (is_done) break;
  }
  return p;
}

bool reaches(const VertexBall& ball, double beta, const Vec3& p, double scale) {
  return ball.smallest(p) >= beta - 1e-12 * scale;
}

Vec3 largest_smallest_value(const VertexBall& ball, double most, const Vec3& start) {
  // A value is asked for a little more than it must reach: Newton comes to the edge of the feasible set, not into it.
  const auto trial = [&](double beta, const Vec3& from) { return minimise_shortfall(ball, beta * 1.02, from); };
  Vec3 best = start;
  double best_value = ball.smallest(start);
  double low = std::max(best_value, 0.0);
  double high = most;
  for (int step = 0; step < 12; ++step) {
    const double beta = 0.5 * (low + high);
    const Vec3 p = trial(beta, best);
    const double value = ball.smallest(p);
    if (value > best_value) {
      best = p;
      best_value = value;
    }
    if (value >= beta)
      low = beta;
    else
      high = beta;
    if (high - low < 0.02 * high) break;
  }
  return best_value > 0.0 ? best : trial(0.05 * most, start);
}

Vec3 paper_position(const VertexBall& ball, const Vec3& start) {
  Vec3 p = minimise_shortfall(ball, 0.0, start);
  const double scale = largest_value(ball, p);
  if (!reaches(ball, 0.0, p, 1e3 * scale)) return start;
  double smallest = std::numeric_limits<double>::infinity();
  int null_count = 0;
  for (std::size_t j = 0; j < ball.offset.size(); ++j) {
    const double v = ball.value(j, p);
    if (v <= 1e-9 * scale)
      ++null_count;
    else
      smallest = std::min(smallest, v);
  }
  double beta = smallest / (null_count + 1);
  for (int halving = 0; halving < 40; ++halving, beta *= 0.5) {
    const Vec3 q = minimise_shortfall(ball, beta, p);
    if (ball.smallest(q) > 0.5 * beta) return q;
  }
  return p;
}

}  // namespace wellknit
