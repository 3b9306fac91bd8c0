// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_init.h"

#include <fmt/format.h>

#include <algorithm>

#include "readers/deck_keywords.h"
#include "readers/ecl_grid_arrays.h"
#include "readers/text.h"

namespace wellknit {

namespace {

// Items of INTEHEAD, from 0.
constexpr std::size_t intehead_units = 2;
constexpr std::size_t intehead_dimensions = 8;
constexpr std::size_t intehead_active = 11;

/// What a simulator computed from the grid: taken from the geometry here, or not used.
bool is_result(const std::string& name) {
  static constexpr std::array names{"PORV",    "DX",     "DY",     "DZ",     "TOPS",   "DEPTH",
                                    "TRANX",   "TRANY",  "TRANZ",  "DIFFX",  "DIFFY",  "DIFFZ",
                                    "TRANNNC", "DIFFMX", "DIFFMY", "DIFFMZ", "MINPVV", "DEPTHCORR"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Heads and tables, which are not of cells.
bool is_of_no_concern(const std::string& name) {
  static constexpr std::array names{"LOGIHEAD", "DOUBHEAD", "TABDIMS", "TAB",     "CON",    "ENDSOL",
                                    "TITLE",    "NNC1",     "NNC2",    "NNCHEAD", "REGDIMS"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

void refuse_other_kinds(const EclRecords& file, const EclArray& array) {
  static constexpr std::array names{"STARTSOL", "SEQNUM", "ICON", "IWEL", "ZWEL", "KEYWORDS", "DIMENS"};
  if (std::find(names.begin(), names.end(), array.name) != names.end())
    file.fail(array, {"an INIT file (static properties)", "a restart or summary file", "give CASE.INIT"});
}

void take_head(const EclRecords& file, const EclArray& array, GridPart& part) {
  file.require_at_least(array, static_cast<std::int64_t>(intehead_active) + 1);
  const std::vector<std::int32_t> head = file.integers(array);
  switch (head[intehead_units]) {
    case 1: part.units = UnitSystem::metric; break;
    case 2: part.units = UnitSystem::field; break;
    case 3: part.units = UnitSystem::lab; break;
    default:
      file.fail(array, {"METRIC, FIELD or LAB (1, 2 or 3 as item 3)", fmt::format("{}", head[intehead_units]),
                        head[intehead_units] == 4 ? "the unit system PVT-M is not read" : "the file is damaged"});
  }
  const auto dimensions = dimensions_of(file, array, intehead_dimensions);
  if (part.dimensions) file.fail(array, {"one INTEHEAD", "a second one", "is this a restart file? give CASE.INIT"});
  part.dimensions = dimensions;
}

/// PORV stands for every cell, the others for the active ones or for all.
bool is_of_cells(const EclArray& array, std::int64_t active, std::int64_t cells) {
  return array.count == active || array.count == cells;
}

}  // namespace

bool looks_like_init(std::string_view bytes) { return begins_with_ecl_header(bytes, {"INTEHEAD"}); }

GridPart parse_init(std::string_view bytes, const std::string& path) {
  EclRecords file(bytes, path);
  GridPart part;
  note_byte_order(file, part);
  std::int64_t active = 0;
  std::int64_t cells = 0;
  std::vector<std::string> results;
  std::vector<std::string> unknown;
  while (const auto array = file.next()) {
    refuse_local_grids(file, *array);
    refuse_other_kinds(file, *array);
    if (array->name == "INTEHEAD") {
      take_head(file, *array, part);
      active = file.integers(*array)[intehead_active];
      cells = (*part.dimensions)[0] * (*part.dimensions)[1] * (*part.dimensions)[2];
    } else if (is_result(array->name)) {
      results.push_back(array->name);
    } else if (is_of_no_concern(array->name)) {
      continue;
    } else if (find_cell_array(array->name) != nullptr) {
      if (!is_of_cells(*array, active, cells))
        file.fail(*array, {fmt::format("{} values (active cells) or {} (all cells)", active, cells),
                           fmt::format("{}", array->count), "the file is damaged"});
      (void)take_cell_array(file, *array, true, part);
    } else {
      unknown.push_back(quoted_for_message(array->name));
    }
  }
  if (!results.empty()) part.notes.push_back(fmt::format("{}: results of the simulator, not used", listed(results)));
  if (!unknown.empty()) part.notes.push_back(fmt::format("{} not understood, and skipped", listed(unknown)));
  return part;
}

}  // namespace wellknit
