// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/ecl_grid_arrays.h"

#include <fmt/format.h>

#include <algorithm>

#include "readers/deck_keywords.h"
#include "readers/text.h"

namespace wellknit {

namespace {

double metre_per_unit(const EclRecords& file, const EclArray& array, const std::string& name) {
  const std::string unit = upper_case(name);
  if (unit == "METRES" || unit == "METERS") return 1.0;
  if (unit == "FEET") return metre_per_foot;
  if (unit == "CM" || unit == "CENTIMES" || unit == "CENTIMET") return metre_per_length_unit(UnitSystem::lab);
  file.fail(array, {"METRES, FEET or CM", quoted_for_message(name), ""});
}

void take_grid_unit(const EclRecords& file, const EclArray& array, GridPart& part) {
  const std::vector<std::string> words = file.strings(array);
  if (words.empty()) file.fail(array, {"METRES, FEET or CM", "no text", ""});
  part.metre_per_grid_unit = metre_per_unit(file, array, words[0]);
  if (words.size() > 1 && !words[1].empty() && upper_case(words[1]) != "MAP")
    file.fail(array, {"MAP or a blank as item 2", quoted_for_message(words[1]), ""});
  part.has_map_coordinates = words.size() > 1 && upper_case(words[1]) == "MAP";
}

}  // namespace

bool take_frame_array(const EclRecords& file, const EclArray& array, GridPart& part) {
  if (array.name == "MAPUNITS") {
    const std::vector<std::string> words = file.strings(array);
    if (!words.empty() && !words[0].empty()) part.metre_per_map_unit = metre_per_unit(file, array, words[0]);
    return true;
  }
  if (array.name == "GRIDUNIT") {
    take_grid_unit(file, array, part);
    return true;
  }
  if (array.name != "MAPAXES") return false;
  std::array<double, 6> axes{};
  file.require_count(array, static_cast<std::int64_t>(axes.size()));
  const std::vector<double> values = file.reals(array);
  std::copy(values.begin(), values.end(), axes.begin());
  part.mapaxes = axes;
  return true;
}

bool take_cell_array(const EclRecords& file, const EclArray& array, bool may_be_active, GridPart& part) {
  const std::string name = upper_case(array.name);
  const CellArrayRule* rule = find_cell_array(name);
  if (rule == nullptr) return false;
  GridPartArray out;
  out.name = name;
  out.where = file.where(array);
  out.may_be_active = may_be_active;
  if (rule->kind == CellArrayKind::real)
    out.values = file.reals(array);
  else
    out.values = file.integers(array);
  part.arrays.push_back(std::move(out));
  return true;
}

std::array<std::int64_t, 3> dimensions_of(const EclRecords& file, const EclArray& array, std::size_t first) {
  file.require_at_least(array, static_cast<std::int64_t>(first) + 3);
  const std::vector<std::int32_t> values = file.integers(array);
  const auto dimensions = checked_dimensions({values[first], values[first + 1], values[first + 2]});
  if (!dimensions)
    file.fail(array,
              {fmt::format("three numbers of cells of 1 or more, {} cells in all at most", most_cells_of_a_file),
               fmt::format("{} {} {}", values[first], values[first + 1], values[first + 2]), "the file is damaged"});
  return *dimensions;
}

void refuse_local_grids(const EclRecords& file, const EclArray& array) {
  static constexpr std::array names{"LGR",      "LGRPARNT", "LGRSGRID", "LGRILG", "LGRNAMES", "LGRHEADI",
                                    "LGRHEADQ", "LGRHEADD", "HOSTNUM",  "NNCL",   "NNCG",     "ENDLGR"};
  if (std::find(names.begin(), names.end(), array.name) != names.end())
    file.fail(array, {"a single grid without local refinements (LGR)", quoted_for_message(array.name),
                      "run or export the case without its LGRs; wellknit makes the mesh around wells itself"});
}

void note_byte_order(const EclRecords& file, GridPart& part) {
  if (file.is_little_endian())
    part.notes.emplace_back("its bytes stand in little-endian order, which no simulator writes; it is read so");
}

}  // namespace wellknit
