// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/grid_part.h"

#include <fmt/format.h>

#include <algorithm>

#include "readers/cell_arrays.h"
#include "readers/grid_section.h"
#include "readers/unapplied.h"

namespace wellknit {

namespace {

std::string text_of(const std::array<std::int64_t, 3>& n) { return fmt::format("{} {} {}", n[0], n[1], n[2]); }

std::int64_t size_of(const CellProperty& values) {
  return std::visit([](const auto& v) { return static_cast<std::int64_t>(v.size()); }, values);
}

void require_count(const std::string& file, const char* keyword, std::size_t found, std::int64_t expected) {
  if (static_cast<std::int64_t>(found) != expected)
    throw ParseError({file, 0, keyword}, {fmt::format("{} values for these dimensions", expected),
                                          fmt::format("{}", found), "the file belongs to another grid"});
}

}  // namespace

std::optional<std::array<std::int64_t, 3>> checked_dimensions(const std::array<std::int64_t, 3>& dimensions) {
  std::int64_t cells = 1;
  for (const std::int64_t n : dimensions) {
    if (n < 1 || n > most_cells_of_a_file / cells) return std::nullopt;
    cells *= n;
  }
  return dimensions;
}

CellProperty spread_over_cells(const CellProperty& active_values, const std::vector<std::int32_t>& actnum) {
  const auto spread = [&](const auto& values, auto unset) {
    std::decay_t<decltype(values)> out(actnum.size(), unset);
    std::size_t next = 0;
    for (std::size_t cell = 0; cell < actnum.size() && next < values.size(); ++cell)
      if (actnum[cell] != 0) out[cell] = values[next++];
    return CellProperty(std::move(out));
  };
  if (const auto* reals = std::get_if<std::vector<double>>(&active_values)) return spread(*reals, unset_real);
  return spread(std::get<std::vector<std::int32_t>>(active_values), unset_integer);
}

std::string listed(const std::vector<std::string>& names) {
  static constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t n = 0; n < std::min(most, names.size()); ++n) text += (n == 0 ? "" : ", ") + names[n];
  if (names.size() > most) text += fmt::format(" and {} more", names.size() - most);
  return text;
}

void GridSection::take(GridPart part, const std::string& file) {
  if (part.dimensions && arrays_.has_dimensions() && arrays_.dimensions() != *part.dimensions)
    throw ParseError({file, 0, "DIMENS"},
                     {fmt::format("the dimensions given before, {}", text_of(arrays_.dimensions())),
                      text_of(*part.dimensions), "the files belong to different grids"});
  const bool is_first = !arrays_.has_dimensions();
  if (part.dimensions && is_first) arrays_.set_dimensions(*part.dimensions);
  if (!arrays_.has_dimensions())
    throw ParseError({file, 0, ""}, {"the dimensions of a grid in this file or one before it", "none",
                                     "read the file that holds the dimensions first"});
  take_frame(part, is_first);
  const auto& n = arrays_.dimensions();
  if (!part.coord.empty()) {
    require_count(file, "COORD", part.coord.size(), 6 * (n[0] + 1) * (n[1] + 1));
    coord_ = std::move(part.coord);
  }
  if (!part.zcorn.empty()) {
    require_count(file, "ZCORN", part.zcorn.size(), 8 * arrays_.cell_count());
    zcorn_ = std::move(part.zcorn);
  }
  for (GridPartArray& array : part.arrays) take_array(std::move(array));
}

void GridSection::take_frame(const GridPart& part, bool is_first) {
  if (part.units) units_ = *part.units;
  if (part.mapaxes) mapaxes_ = part.mapaxes;
  if (part.metre_per_map_unit) metre_per_map_unit_ = *part.metre_per_map_unit;
  if (part.has_map_coordinates) has_map_coordinates_ = *part.has_map_coordinates;
  if (!part.metre_per_grid_unit) return;
  metre_per_grid_unit_ = part.metre_per_grid_unit;
  if (!is_first || part.units) return;
  // A grid alone names its unit of length only.
  if (*part.metre_per_grid_unit == metre_per_foot)
    units_ = UnitSystem::field;
  else if (*part.metre_per_grid_unit == metre_per_length_unit(UnitSystem::lab))
    units_ = UnitSystem::lab;
}

void GridSection::take_array(GridPartArray array) {
  const std::int64_t count = size_of(array.values);
  const std::int64_t cells = arrays_.cell_count();
  if (count != cells) {
    const auto actnum = arrays_.arrays.find("ACTNUM");
    const bool has_actnum = actnum != arrays_.arrays.end();
    std::int64_t active = cells;
    if (has_actnum) {
      const auto& values = std::get<std::vector<std::int32_t>>(actnum->second.values);
      active = std::count_if(values.begin(), values.end(), [](std::int32_t v) { return v != 0; });
    }
    if (!array.may_be_active || count != active)
      throw ParseError(
          array.where,
          {array.may_be_active && has_actnum ? fmt::format("{} values (active cells) or {} (all cells)", active, cells)
                                             : fmt::format("{} values, one a cell", cells),
           fmt::format("{}", count),
           array.may_be_active ? "give it with the EGRID file of the same run" : "the file belongs to another grid"});
    stream_.charge_values(cells);
    array.values = spread_over_cells(array.values, std::get<std::vector<std::int32_t>>(actnum->second.values));
  }
  if (ends_in_edits(array.name)) note_not_applied(stream_, array.name, array.where.line);
  arrays_.arrays.insert_or_assign(array.name, CellArray{std::move(array.values), array.where});
}

}  // namespace wellknit
