// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What one binary, formatted or ROFF file says of a grid, before it is joined to the rest of the case.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/corner_point_grid.h"
#include "model/errors.h"

namespace wellknit {

/// Cells that a run can number; a file beyond it is damaged or hostile.
inline constexpr std::int64_t most_cells_of_a_file = 2'000'000'000;

/// An array with one value a cell, in the units of the file. Unset values as in cell_arrays.h.
struct GridPartArray {
  std::string name;            ///< upper case; has a rule (find_cell_array)
  CellProperty values;         ///< every cell, or only the active ones
  ParseError::Where where;     ///< for errors
  bool may_be_active = false;  ///< the length tells which: an array of INIT
};

struct GridPart {
  std::optional<std::array<std::int64_t, 3>> dimensions;
  std::optional<UnitSystem> units;
  std::optional<double> metre_per_grid_unit;
  std::optional<std::array<double, 6>> mapaxes;
  std::optional<double> metre_per_map_unit;
  std::optional<bool> has_map_coordinates;
  std::vector<double> coord;  ///< as CornerPointGrid, in the file's unit of length; empty: not in this file
  std::vector<double> zcorn;
  std::vector<GridPartArray> arrays;
  std::vector<std::string> notes;  ///< without the file's name

  [[nodiscard]] bool has_geometry() const { return !coord.empty() && !zcorn.empty(); }
};

/// The dimensions, when each is 1 or more and they make at most this many cells.
std::optional<std::array<std::int64_t, 3>> checked_dimensions(const std::array<std::int64_t, 3>& dimensions);

/// Values on the active cells spread over all of them, the others unset.
CellProperty spread_over_cells(const CellProperty& active_values, const std::vector<std::int32_t>& actnum);

/// "a, b and 12 more", for notes.
std::string listed(const std::vector<std::string>& names);

}  // namespace wellknit
