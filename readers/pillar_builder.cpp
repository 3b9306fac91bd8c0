// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/pillar_builder.h"

#include <algorithm>
#include <cmath>

namespace wellknit {

PillarBuilder::PillarBuilder(const std::array<std::int64_t, 3>& dimensions) : dimensions_(dimensions) {
  const auto pillars = static_cast<std::size_t>((dimensions[0] + 1) * (dimensions[1] + 1));
  coord_.assign(6 * pillars, 0.0);
  is_set_.assign(pillars, false);
}

std::size_t PillarBuilder::place(std::int64_t i, std::int64_t j) const {
  return static_cast<std::size_t>(i + (dimensions_[0] + 1) * j);
}

void PillarBuilder::add(std::int64_t i, std::int64_t j, const Vec3& corner) {
  const std::size_t pillar = place(i, j);
  double* points = &coord_[6 * pillar];
  const bool is_first = !is_set_[pillar];
  is_set_[pillar] = true;
  if (is_first || corner.z() < points[2]) std::copy(corner.data(), corner.data() + 3, points);
  if (is_first || corner.z() > points[5]) std::copy(corner.data(), corner.data() + 3, points + 3);
}

PillarBuilder::Distance PillarBuilder::distance(std::int64_t i, std::int64_t j, const Vec3& corner) const {
  const double* p = &coord_[6 * place(i, j)];
  const double height = p[5] - p[2];
  const double t = height > 0.0 ? (corner.z() - p[2]) / height : 0.0;
  const double dx = corner.x() - (p[0] + t * (p[3] - p[0]));
  const double dy = corner.y() - (p[1] + t * (p[4] - p[1]));
  // Coordinates are rounded to single precision, 2^-24 of their size: three of them enter here, and depths through the
  // slope.
  const double slope = height > 0.0 ? std::hypot(p[3] - p[0], p[4] - p[1]) / height : 0.0;
  const double size = std::max(std::abs(corner.x()), std::abs(corner.y())) + slope * std::abs(corner.z());
  return {std::hypot(dx, dy), 4.0 * size * std::ldexp(1.0, -24) + 1e-6};
}

std::vector<double> PillarBuilder::take_coord() {
  const auto first = std::find(is_set_.begin(), is_set_.end(), true);
  auto source = static_cast<std::size_t>(first - is_set_.begin());
  for (std::size_t pillar = 0; pillar < is_set_.size() && first != is_set_.end(); ++pillar) {
    if (is_set_[pillar])
      source = pillar;
    else
      std::copy_n(&coord_[6 * source], 6, &coord_[6 * pillar]);
  }
  return std::move(coord_);
}

}  // namespace wellknit
