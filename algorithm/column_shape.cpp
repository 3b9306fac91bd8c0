// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/column_shape.h"

namespace wellknit {

namespace {

template <class T>
T bilinear(double s, double t, const T& v00, const T& v10, const T& v01, const T& v11) {
  // In this form (s, t) on a side gives the side's own interpolation to the last bit.
  return T((1.0 - t) * T((1.0 - s) * v00 + s * v10) + t * T((1.0 - s) * v01 + s * v11));
}

}  // namespace

ColumnShape::ColumnShape(const CornerPointGrid& grid, const HostMesh& host, std::int64_t i, std::int64_t j)
    : grid_(grid), host_(host), i_(i), j_(j) {}

double ColumnShape::depth(double s, double t, const ColumnLevel& level) const {
  const HostCorners& corners = host_.corners;
  const std::int64_t column = i_ + corners.dimensions[0] * j_;
  std::array<double, 4> z{};
  // At a corner of the column the other three count for nothing.
  const bool is_corner = (s == 0.0 || s == 1.0) && (t == 0.0 || t == 1.0);
  const int corner = (s == 1.0 ? 1 : 0) + (t == 1.0 ? 2 : 0);
  for (int c = 0; c < 4; ++c) {
    if (is_corner && c != corner) continue;
    const std::int64_t first = corners.first[corners.pillar(i_, j_, c)].value();
    const std::int32_t* rank = corners.on_pillar(column, c);
    const double top = host_.vertices[VertexId(first + rank[2 * level.place])].z();
    const double base = host_.vertices[VertexId(first + rank[2 * level.place + 1])].z();
    z[static_cast<std::size_t>(c)] = level.fraction == 0.0   ? top
                                     : level.fraction == 1.0 ? base
                                                             : (1.0 - level.fraction) * top + level.fraction * base;
  }
  if (is_corner) return z[static_cast<std::size_t>(corner)];
  return bilinear(s, t, z[0], z[1], z[2], z[3]);
}

Vec3 ColumnShape::on_line(double s, double t, double depth) const {
  if ((s == 0.0 || s == 1.0) && (t == 0.0 || t == 1.0))
    return grid_.pillar_point(i_ + (s == 1.0 ? 1 : 0), j_ + (t == 1.0 ? 1 : 0), depth);
  return bilinear<Vec3>(s, t, grid_.pillar_point(i_, j_, depth), grid_.pillar_point(i_ + 1, j_, depth),
                        grid_.pillar_point(i_, j_ + 1, depth), grid_.pillar_point(i_ + 1, j_ + 1, depth));
}

}  // namespace wellknit
