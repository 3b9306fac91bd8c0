// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Damped Newton from the cell's middle; where that fails (strongly skewed, folded or partly collapsed cells) boxes of
// (u, v, w) are halved: the image of a box lies in the convex hull of its corners' images, so most boxes are ruled out
// at once.

#include "algorithm/trilinear.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wellknit {

namespace {

using Corners = std::array<Vec3, 8>;

/// Monomial form: a + b u + c v + d w + e uv + f uw + g vw + h uvw.
struct Map {
  std::array<Vec3, 8> a;

  [[nodiscard]] Vec3 at(const Vec3& t) const {
    const double u = t[0], v = t[1], w = t[2];
    return a[0] + u * (a[1] + v * (a[4] + w * a[7]) + w * a[5]) + v * (a[2] + w * a[6]) + w * a[3];
  }
  [[nodiscard]] Eigen::Matrix3d jacobian(const Vec3& t) const {
    const double u = t[0], v = t[1], w = t[2];
    Eigen::Matrix3d j;
    j.col(0) = a[1] + v * a[4] + w * (a[5] + v * a[7]);
    j.col(1) = a[2] + u * a[4] + w * (a[6] + u * a[7]);
    j.col(2) = a[3] + u * a[5] + v * (a[6] + u * a[7]);
    return j;
  }
};

/// The map relative to `origin`, so that large coordinates lose no digits.
Map map_of(const Corners& c, const Vec3& origin) {
  Map m;
  m.a[0] = c[0] - origin;
  m.a[1] = c[1] - c[0];
  m.a[2] = c[2] - c[0];
  m.a[3] = c[4] - c[0];
  m.a[4] = (c[3] - c[2]) - (c[1] - c[0]);
  m.a[5] = (c[5] - c[4]) - (c[1] - c[0]);
  m.a[6] = (c[6] - c[4]) - (c[2] - c[0]);
  m.a[7] = ((c[7] - c[6]) - (c[5] - c[4])) - ((c[3] - c[2]) - (c[1] - c[0]));
  return m;
}

Vec3 newton_step(const Eigen::Matrix3d& jacobian, const Vec3& residual) {
  const double scale = jacobian.col(0).norm() * jacobian.col(1).norm() * jacobian.col(2).norm();
  // On a collapsed edge one direction is lost: the shortest step that still mends the others.
  if (!(std::abs(jacobian.determinant()) > 1e-12 * scale))
    return -jacobian.completeOrthogonalDecomposition().solve(residual);
  return -(jacobian.inverse() * residual);
}

/// `floor` is the rounding error of a point, m.
std::optional<Vec3> newton(const Map& map, Vec3 t, double floor) {
  constexpr int max_iterations = 40;
  constexpr double converged_step = 1e-9;  // in (u, v, w); convergence is quadratic, so the next one is rounding
  Vec3 residual = map.at(t);
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    if (residual.norm() <= floor) return t;
    Vec3 step = newton_step(map.jacobian(t), residual);
    const double longest = step.cwiseAbs().maxCoeff();
    if (!std::isfinite(longest)) return std::nullopt;
    if (longest > 1.0) step /= longest;
    Vec3 next = t + step;
    Vec3 next_residual = map.at(next);
    for (int halving = 0; halving < 6 && next_residual.norm() > residual.norm(); ++halving) {
      step *= 0.5;
      next = t + step;
      next_residual = map.at(next);
    }
    t = next;
    residual = next_residual;
    if (longest < converged_step) return residual.norm() <= 1e6 * floor ? std::optional(t) : std::nullopt;
    if (t.minCoeff() < -3.0 || t.maxCoeff() > 4.0) return std::nullopt;
  }
  return std::nullopt;
}

/// Whether the image of the box can hold the origin.
bool may_hold_origin(const Map& map, const Vec3& low, double size, double slack) {
  Vec3 lowest = Vec3::Constant(std::numeric_limits<double>::max());
  Vec3 highest = -lowest;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p = map.at(low + size * Vec3(corner & 1, (corner >> 1) & 1, corner >> 2));
    lowest = lowest.cwiseMin(p);
    highest = highest.cwiseMax(p);
  }
  return lowest.maxCoeff() <= slack && highest.minCoeff() >= -slack;
}

bool in_unit_cube(const Vec3& t, double slack) { return t.minCoeff() >= -slack && t.maxCoeff() <= 1.0 + slack; }

/// Halves boxes, depth first in a fixed order, and starts Newton in each small one that may hold the point.
std::optional<Vec3> bisection(const Map& map, const Vec3& low, double size, double floor) {
  if (!may_hold_origin(map, low, size, floor)) return std::nullopt;
  if (size < 0.3) {  // quarters: 64 starts at most
    const auto t = newton(map, low + Vec3::Constant(0.5 * size), floor);
    if (t && in_unit_cube(*t, 1e-9)) return t;
  }
  if (size < 0.1) return std::nullopt;
  for (int child = 0; child < 8; ++child) {
    const Vec3 corner = low + 0.5 * size * Vec3(child & 1, (child >> 1) & 1, child >> 2);
    if (auto t = bisection(map, corner, 0.5 * size, floor)) return t;
  }
  return std::nullopt;
}

/// Whether the Jacobian changes its sign between corners: only then can a point have two preimages near the cell.
bool folds(const Map& map) {
  double lowest = std::numeric_limits<double>::max();
  double highest = -lowest;
  for (int corner = 0; corner < 8; ++corner) {
    const double determinant = map.jacobian(Vec3(corner & 1, (corner >> 1) & 1, corner >> 2)).determinant();
    lowest = std::min(lowest, determinant);
    highest = std::max(highest, determinant);
  }
  return lowest < 0.0 && highest > 0.0;
}

}  // namespace

Vec3 trilinear(const Corners& corners, const Vec3& uvw) { return corners[0] + map_of(corners, corners[0]).at(uvw); }

std::optional<Vec3> inverse_trilinear(const Corners& corners, const Vec3& point) {
  const Map map = map_of(corners, point);
  double diameter = 0.0;
  double magnitude = point.cwiseAbs().maxCoeff();
  for (const Vec3& c : corners) {
    diameter = std::max(diameter, (c - corners[0]).norm());
    magnitude = std::max(magnitude, c.cwiseAbs().maxCoeff());
  }
  const double floor = 1e-13 * diameter + std::numeric_limits<double>::epsilon() * magnitude;
  const auto direct = newton(map, Vec3::Constant(0.5), floor);
  if (direct && (in_unit_cube(*direct, 1e-9) || !folds(map))) return direct;
  if (const auto inside = bisection(map, Vec3::Zero(), 1.0, floor)) return inside;
  return direct;
}

}  // namespace wellknit
