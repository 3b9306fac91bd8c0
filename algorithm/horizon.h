// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The surface between two layers of the host, as bilinear patches over its columns.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "algorithm/near_well_grid.h"

namespace wellknit {

/// A point on a horizon: column, place in it (0 … 1 each) and position.
struct HorizonPoint {
  std::array<std::int64_t, 2> column{};
  double u = 0.0;
  double v = 0.0;
  Vec3 point = Vec3::Zero();
};

/// Horizon `level` of 0 … nK is the top of the grid's layer `level`, and the base of the last one for nK.
class Horizon {
 public:
  Horizon(const NearWellGrid& grid, std::int64_t level) : grid_(grid), level_(level) {}

  /// The corners of the patch of a column: (di, dj) at di + 2 dj.
  [[nodiscard]] std::array<Vec3, 4> patch(std::array<std::int64_t, 2> column) const;
  /// The point above or below (x, y), walking from a column near by. Empty outside of the grid, or where a throw or a
  /// fold leaves no single answer.
  [[nodiscard]] std::optional<HorizonPoint> at(double x, double y, std::array<std::int64_t, 2> start) const;

 private:
  const NearWellGrid& grid_;
  std::int64_t level_;
};

}  // namespace wellknit
