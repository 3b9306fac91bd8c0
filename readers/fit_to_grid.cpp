// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/fit_to_grid.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace wellknit {

namespace {

using Vec2 = Eigen::Vector2d;
using Box = Eigen::AlignedBox2d;

Box plan_of(const CornerPointGrid& grid) {
  Box box;
  for (std::size_t i = 0; i + 2 < grid.coord.size(); i += 3) box.extend(Vec2(grid.coord[i], grid.coord[i + 1]));
  return box;
}

/// True when the line from a to b and the box have a point in common.
bool meets(const Box& box, const Vec2& a, const Vec2& b) {
  double from = 0.0;
  double to = 1.0;
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    const double step = b[axis] - a[axis];
    const double least = box.min()[axis] - a[axis];
    const double most = box.max()[axis] - a[axis];
    if (step == 0.0) {
      if (least > 0.0 || most < 0.0) return false;
      continue;
    }
    from = std::max(from, std::min(least / step, most / step));
    to = std::min(to, std::max(least / step, most / step));
  }
  return from <= to;
}

bool meets(const Box& box, const std::vector<Vec3>& points) {
  for (std::size_t n = 1; n < points.size(); ++n)
    if (meets(box, points[n - 1].head<2>(), points[n].head<2>())) return true;
  return false;
}

/// From map coordinates to the grid's: MAPAXES has a point on the grid's y axis, its origin, and a point on its x axis.
std::optional<Eigen::Affine2d> map_to_grid(const CornerPointGrid& grid) {
  if (!grid.mapaxes) return std::nullopt;
  const auto& axes = *grid.mapaxes;
  const Vec2 origin(axes[2], axes[3]);
  const Vec2 x = Vec2(axes[4], axes[5]) - origin;
  const Vec2 y = Vec2(axes[0], axes[1]) - origin;
  if (!(x.norm() > 0.0) || !(y.norm() > 0.0) || !x.allFinite() || !y.allFinite()) return std::nullopt;
  Eigen::Matrix2d turn;
  turn.col(0) = x.normalized();
  turn.col(1) = y.normalized();
  // Axes on one line are none.
  static constexpr double least_angle = 1e-6;  // of its sine
  if (std::abs(turn.determinant()) < least_angle) return std::nullopt;
  Eigen::Affine2d to_map = Eigen::Affine2d::Identity();
  to_map.linear() = turn;
  to_map.translation() = origin;
  return to_map.inverse();
}

}  // namespace

std::optional<std::string> fit_to_grid(Well& well, const CornerPointGrid& grid) {
  const Box box = plan_of(grid);
  std::vector<Vec3>& points = well.trajectory.points;
  if (points.size() < 2 || box.isEmpty() || meets(box, points)) return std::nullopt;
  if (const auto transform = map_to_grid(grid)) {
    std::vector<Vec3> turned = points;
    for (Vec3& point : turned) point.head<2>() = *transform * Vec2(point.head<2>());
    if (meets(box, turned)) {
      points = std::move(turned);
      return fmt::format(
          "well {}: its map coordinates were turned into the grid's own with MAPAXES, as it fits only so", well.name);
    }
  }
  Box path;
  for (const Vec3& point : points) path.extend(Vec2(point.head<2>()));
  return fmt::format(
      "well {}: it lies outside the grid: x {:.6g} to {:.6g} m, y {:.6g} to {:.6g} m, but the grid has x {:.6g} to "
      "{:.6g} m, y {:.6g} to {:.6g} m; check units and coordinates",
      well.name, path.min().x(), path.max().x(), path.min().y(), path.max().y(), box.min().x(), box.max().x(),
      box.min().y(), box.max().y());
}

}  // namespace wellknit
