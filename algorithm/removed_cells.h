// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The cells of the near-well grid that a cavity takes (method.md §5).
///
/// Source: T. Mouton, C. Bennis, H. Borouchaki (key Mouton).
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_set>
#include <vector>

#include "algorithm/well_tube.h"

namespace wellknit {

/// A cell is taken only where it matches the removed ones beside it: a cavity is one piece of rock without throws,
/// gaps, or places without thickness.
class RemovedCells {
 public:
  explicit RemovedCells(const NearWellGrid& grid) : grid_(grid) {}

  [[nodiscard]] bool is_inside_grid(const NearWellCell& c) const { return grid_.is_inside(c); }
  [[nodiscard]] bool contains(const NearWellCell& c) const {
    return is_inside_grid(c) && cells_.contains(grid_.index(c));
  }
  /// True when it was added. Nothing happens outside of the grid.
  bool add(const NearWellCell& c);
  /// The same for a cell that may as well stay.
  bool add_if_sound(const NearWellCell& c);
  /// It may be taken.
  [[nodiscard]] bool is_sound(const NearWellCell& c) const;
  /// The first cell that could not be taken.
  [[nodiscard]] const std::optional<NearWellCell>& blocked() const { return blocked_; }
  [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(cells_.size()); }
  /// In order of their indices.
  [[nodiscard]] std::vector<NearWellCell> list();

 private:
  const NearWellGrid& grid_;
  std::unordered_set<std::int64_t> cells_;
  std::vector<std::int64_t> sorted_;  ///< the cells when list() was last called
  std::vector<std::int64_t> added_;   ///< those since
  std::optional<NearWellCell> blocked_;
};

/// Takes every cell that comes within the tube's radius of its axis: no less than the cells that meet it. A cell
/// beyond an end does not meet it; it may stay where it cannot be taken.
void remove_cells_at_tube(const HostFrame& frame, const Tube& tube, RemovedCells& removed);

/// How far around a tube cells are taken that need not be, m (CavityOptions::dilation).
double width_of_shell(const HostFrame& frame, const Tube& tube, int dilation);

/// Takes the cells of that shell, where nothing keeps them. `in_columns`: only whole columns.
void remove_cells_around_tube(const HostFrame& frame, const Tube& tube, int dilation, bool in_columns,
                              RemovedCells& removed);

/// Takes cells until the boundary is a 2-manifold. `in_columns`: whole columns, as layered cavities need them: all
/// their boundary faces are then lateral and their cells layered prisms.
void make_closed(const NearWellGrid& grid, bool in_columns, RemovedCells& removed);

}  // namespace wellknit
