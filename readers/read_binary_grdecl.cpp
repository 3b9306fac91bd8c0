// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_binary_grdecl.h"

#include <fmt/format.h>

#include "readers/ecl_grid_arrays.h"
#include "readers/text.h"

namespace wellknit {

namespace {

constexpr std::size_t specgrid_reservoirs = 3;

void take_dimensions(const EclRecords& file, const EclArray& array, GridPart& part) {
  const auto dimensions = dimensions_of(file, array, 0);
  if (array.name == "SPECGRID" && array.count > static_cast<std::int64_t>(specgrid_reservoirs)) {
    const std::int32_t reservoirs = file.integers(array)[specgrid_reservoirs];
    if (reservoirs > 1)
      file.fail(array, {"one reservoir (item 4)", fmt::format("{}", reservoirs), "split the reservoirs"});
  }
  if (part.dimensions && *part.dimensions != dimensions)
    file.fail(array, {"the dimensions given before", "others", "the file is damaged"});
  part.dimensions = dimensions;
}

}  // namespace

bool looks_like_binary_grdecl(std::string_view bytes) { return begins_with_ecl_header(bytes, {}); }

GridPart parse_binary_grdecl(std::string_view bytes, const std::string& path) {
  EclRecords file(bytes, path);
  GridPart part;
  note_byte_order(file, part);
  std::vector<std::string> unknown;
  while (const auto array = file.next()) {
    refuse_local_grids(file, *array);
    if (array->name == "SPECGRID" || array->name == "DIMENS")
      take_dimensions(file, *array, part);
    else if (array->name == "COORD")
      part.coord = file.reals(*array);
    else if (array->name == "ZCORN")
      part.zcorn = file.reals(*array);
    else if (!take_frame_array(file, *array, part) && !take_cell_array(file, *array, false, part) &&
             array->name != "COORDSYS" && array->name != "GDORIENT")
      unknown.push_back(quoted_for_message(array->name));
  }
  if (!unknown.empty()) part.notes.push_back(fmt::format("{} not understood, and skipped", listed(unknown)));
  return part;
}

}  // namespace wellknit
