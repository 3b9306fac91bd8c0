// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/horizon.h"

#include <algorithm>
#include <cmath>

namespace wellknit {

namespace {

/// Place (u, v) of a plan position in a patch by Newton's method on its bilinear plan; the patch may be any convex
/// quadrilateral.
std::optional<std::array<double, 2>> plan_place(const std::array<Vec3, 4>& c, double x, double y) {
  double u = 0.5;
  double v = 0.5;
  const Vec3 along_u = c[1] - c[0];
  const Vec3 along_v = c[2] - c[0];
  const Vec3 twist = c[3] - c[2] - c[1] + c[0];
  for (int step = 0; step < 50; ++step) {
    const double rx = c[0].x() + u * along_u.x() + v * along_v.x() + u * v * twist.x() - x;
    const double ry = c[0].y() + u * along_u.y() + v * along_v.y() + u * v * twist.y() - y;
    const double xu = along_u.x() + v * twist.x();
    const double yu = along_u.y() + v * twist.y();
    const double xv = along_v.x() + u * twist.x();
    const double yv = along_v.y() + u * twist.y();
    const double det = xu * yv - xv * yu;
    if (det == 0.0) return std::nullopt;
    const double du = (rx * yv - ry * xv) / det;
    const double dv = (ry * xu - rx * yu) / det;
    // A patch is left behind by at most two of its widths a step: far points are reached by walking, not by
    // extrapolation.
    u = std::clamp(u - du, -2.0, 3.0);
    v = std::clamp(v - dv, -2.0, 3.0);
    if (std::abs(du) + std::abs(dv) < 1e-14) break;
  }
  return std::array<double, 2>{u, v};
}

}  // namespace

std::array<Vec3, 4> Horizon::patch(std::array<std::int64_t, 2> column) const {
  const std::int64_t layers = grid_.dimensions()[2];
  const bool is_base = level_ == layers;
  std::array<Vec3, 4> out;
  for (int c = 0; c < 4; ++c)
    out[static_cast<std::size_t>(c)] =
        grid_.corner({column[0], column[1], is_base ? layers - 1 : level_}, is_base ? c + 4 : c);
  return out;
}

std::optional<HorizonPoint> Horizon::at(double x, double y, std::array<std::int64_t, 2> start) const {
  std::array<std::int64_t, 2> column = start;
  constexpr double slack = 1e-9;  // of a cell's width: a point on the line between two columns belongs to both
  for (int step = 0; step < 1000; ++step) {
    const auto corners = patch(column);
    const auto place = plan_place(corners, x, y);
    if (!place) return std::nullopt;
    const auto [u, v] = *place;
    std::array<std::int64_t, 2> next = column;
    if (u < -slack) --next[0];
    if (u > 1.0 + slack) ++next[0];
    if (v < -slack) --next[1];
    if (v > 1.0 + slack) ++next[1];
    if (next == column) {
      const Vec3 p =
          (1 - u) * (1 - v) * corners[0] + u * (1 - v) * corners[1] + (1 - u) * v * corners[2] + u * v * corners[3];
      return HorizonPoint{column, u, v, Vec3(x, y, p.z())};
    }
    for (std::size_t a = 0; a < 2; ++a)
      if (next[a] < 0 || next[a] >= grid_.dimensions()[a]) return std::nullopt;
    column = next;
  }
  return std::nullopt;
}

}  // namespace wellknit
