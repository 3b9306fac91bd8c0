// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_egrid.h"

#include <fmt/format.h>

#include <algorithm>

#include "readers/ecl_grid_arrays.h"
#include "readers/text.h"

namespace wellknit {

namespace {

// Items of FILEHEAD and GRIDHEAD, from 0.
constexpr std::size_t filehead_grid_type = 4;
constexpr std::size_t filehead_dual = 5;
constexpr std::size_t gridhead_type = 0;
constexpr std::size_t gridhead_dimensions = 1;
constexpr std::size_t gridhead_grid_number = 4;
constexpr std::size_t gridhead_reservoirs = 24;
constexpr std::size_t gridhead_cylindrical = 26;

class EgridReader {
 public:
  EgridReader(std::string_view bytes, const std::string& path) : file_(bytes, path) {}
  GridPart read();

 private:
  void take(const EclArray& array);
  void check_file_head(const EclArray& array) const;
  void take_grid_head(const EclArray& array);
  void take_active(const EclArray& array);
  void require_grid_head(const EclArray& array) const;
  void require_whole(const EclArray& last) const;

  EclRecords file_;
  GridPart part_;
  std::vector<std::string> unknown_;
};

bool is_of_no_concern(const std::string& name) {
  // COORDSYS: one reservoir, by GRIDHEAD. GDORIENT: the order of the arrays is always the same.
  static constexpr std::array names{"ENDGRID", "COORDSYS", "GDORIENT", "NNCHEAD", "NNC2", "NNCHEADA", "NNA1", "NNA2"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

GridPart EgridReader::read() {
  note_byte_order(file_, part_);
  EclArray last;
  while (const auto array = file_.next()) {
    take(*array);
    last = *array;
  }
  require_whole(last);
  if (!unknown_.empty()) part_.notes.push_back(fmt::format("{} not understood, and skipped", listed(unknown_)));
  return std::move(part_);
}

void EgridReader::take(const EclArray& array) {
  refuse_local_grids(file_, array);
  const std::int64_t nx = part_.dimensions ? (*part_.dimensions)[0] : 0;
  const std::int64_t ny = part_.dimensions ? (*part_.dimensions)[1] : 0;
  const std::int64_t nz = part_.dimensions ? (*part_.dimensions)[2] : 0;
  if (array.name == "FILEHEAD") return check_file_head(array);
  if (array.name == "GRIDHEAD") return take_grid_head(array);
  if (array.name == "COORD") {
    require_grid_head(array);
    file_.require_count(array, 6 * (nx + 1) * (ny + 1));
    part_.coord = file_.reals(array);
  } else if (array.name == "ZCORN") {
    require_grid_head(array);
    file_.require_count(array, 8 * nx * ny * nz);
    part_.zcorn = file_.reals(array);
  } else if (array.name == "ACTNUM") {
    require_grid_head(array);
    file_.require_count(array, nx * ny * nz);
    take_active(array);
  } else if (array.name == "NNC1") {
    if (array.count > 0)
      part_.notes.push_back(fmt::format(
          "{} non-neighbour connections (NNC) are not taken: those across faults come from the geometry", array.count));
  } else if (array.name == "CORSNUM" && array.count > 0) {
    file_.fail(array, {"a grid without coarsened cells", "CORSNUM", "export the grid before its coarsening"});
  } else if (!take_frame_array(file_, array, part_) && !is_of_no_concern(array.name)) {
    unknown_.push_back(quoted_for_message(array.name));
  }
}

void EgridReader::check_file_head(const EclArray& array) const {
  file_.require_at_least(array, static_cast<std::int64_t>(filehead_dual) + 1);
  const std::vector<std::int32_t> head = file_.integers(array);
  if (head[filehead_grid_type] != 0)
    file_.fail(array, {"a corner-point grid (0 as item 5)", fmt::format("{}", head[filehead_grid_type]),
                       "unstructured and hybrid grids are not read; export a corner-point grid"});
  if (head[filehead_dual] != 0)
    file_.fail(array, {"one medium (0 as item 6)", "a dual medium (matrix and fractures)",
                       "not read; export the matrix or the fractures as a grid of its own"});
}

void EgridReader::take_grid_head(const EclArray& array) {
  file_.require_at_least(array, static_cast<std::int64_t>(gridhead_grid_number) + 1);
  const std::vector<std::int32_t> head = file_.integers(array);
  if (part_.dimensions || head[gridhead_grid_number] != 0)
    file_.fail(array, {"the head of one global grid (0 as item 5)", fmt::format("grid {}", head[gridhead_grid_number]),
                       "run or export the case without its LGRs"});
  if (head[gridhead_type] != 1)
    file_.fail(array, {"a corner-point grid (1 as item 1)", fmt::format("{}", head[gridhead_type]),
                       "composite and unstructured grids are not read; export a corner-point grid"});
  if (head.size() > gridhead_reservoirs && head[gridhead_reservoirs] > 1)
    file_.fail(array,
               {"one reservoir (item 25)", fmt::format("{}", head[gridhead_reservoirs]), "split the reservoirs"});
  if (head.size() > gridhead_cylindrical && head[gridhead_cylindrical] != 0)
    file_.fail(array, {"Cartesian coordinates (0 as item 27)", "cylindrical ones", "radial grids are not read"});
  part_.dimensions = dimensions_of(file_, array, gridhead_dimensions);
}

void EgridReader::take_active(const EclArray& array) {
  GridPartArray active;
  active.name = "ACTNUM";
  active.where = file_.where(array);
  std::vector<std::int32_t> values = file_.integers(array);
  const auto dual = std::find_if(values.begin(), values.end(), [](std::int32_t v) { return v == 2 || v == 3; });
  if (dual != values.end())
    file_.fail(array, {"0 or 1 for every cell", fmt::format("{}: a dual medium (matrix and fractures)", *dual),
                       "not read; export the matrix or the fractures as a grid of its own"});
  active.values = std::move(values);
  part_.arrays.push_back(std::move(active));
}

void EgridReader::require_grid_head(const EclArray& array) const {
  if (!part_.dimensions) file_.fail(array, {"GRIDHEAD before it", "none", "the file is damaged"});
}

void EgridReader::require_whole(const EclArray& last) const {
  const char* missing = !part_.dimensions     ? "GRIDHEAD"
                        : part_.coord.empty() ? "COORD"
                        : part_.zcorn.empty() ? "ZCORN"
                                              : nullptr;
  if (missing != nullptr)
    throw ParseError({file_.path(), 0, missing},
                     {fmt::format("{} in a grid file", missing),
                      fmt::format("the end of the file after {}", quoted_for_message(last.name)),
                      "the file is cut: copy it again, in binary mode"});
}

}  // namespace

bool looks_like_egrid(std::string_view bytes) { return begins_with_ecl_header(bytes, {"FILEHEAD"}); }

GridPart parse_egrid(std::string_view bytes, const std::string& path) { return EgridReader(bytes, path).read(); }

}  // namespace wellknit
