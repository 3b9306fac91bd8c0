// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What a tube and its cavity may not cross: faults, gaps between layers, and places without thickness (method.md §4,
/// policy `stop`).
#pragma once

#include <vector>

#include "algorithm/reference_space.h"

namespace wellknit {

/// Cells thinner than this anywhere are no part of a cavity, m.
inline constexpr double least_cell_thickness = 0.01;

/// Faces between source columns that do not match, and cells without thickness, as boxes of E_ref (flat ones for
/// faces).
class Obstacles {
 public:
  /// Of the source columns of the region. O(columns x layers).
  Obstacles(const NearWellGrid& grid, const ReferenceSpace& space, const CellRange& region);

  [[nodiscard]] bool empty() const { return boxes_.empty(); }

  /// A disc of this radius normal to `along` stays clear of all by `gap`: the distance to each, less what the disc
  /// reaches towards it. Lengths of E_ref, m; `along` of length 1.
  [[nodiscard]] bool is_clear(const Vec3& center, const Vec3& along, double radius, double gap) const;

  /// No obstacle within this distance in plan of a vertical line.
  [[nodiscard]] bool is_clear_in_plan(double x, double y, double distance) const;

 private:
  void add(const NearWellGrid& grid, const ReferenceSpace& space, const std::vector<std::uint8_t>& is_bad,
           std::array<std::int64_t, 2> low, std::array<std::int64_t, 2> high);
  void add_gaps(const NearWellGrid& grid, const ReferenceSpace& space, std::int64_t i, std::int64_t j);

  std::vector<Box> boxes_;
};

}  // namespace wellknit
