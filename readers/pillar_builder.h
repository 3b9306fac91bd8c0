// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Straight pillars through the corners of cells.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/geometry.h"

namespace wellknit {

/// Makes the pillars of a grid of cells that come one by one: each pillar goes from the shallowest to the deepest
/// corner on it. Corners are given twice: first to make the pillars, then to check them.
class PillarBuilder {
 public:
  explicit PillarBuilder(const std::array<std::int64_t, 3>& dimensions);

  /// A corner on pillar (i, j).
  void add(std::int64_t i, std::int64_t j, const Vec3& corner);
  /// How far a corner lies from its pillar, in the unit of the corners, and how far single precision lets it lie.
  struct Distance {
    double found = 0.0;
    double allowed = 0.0;
  };
  [[nodiscard]] Distance distance(std::int64_t i, std::int64_t j, const Vec3& corner) const;
  /// As CornerPointGrid::coord. A pillar without corners is a copy of one that has some: the one before it.
  std::vector<double> take_coord();

 private:
  [[nodiscard]] std::size_t place(std::int64_t i, std::int64_t j) const;

  std::array<std::int64_t, 3> dimensions_;
  std::vector<double> coord_;
  std::vector<bool> is_set_;
};

}  // namespace wellknit
