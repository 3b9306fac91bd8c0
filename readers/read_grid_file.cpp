// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_grid_file.h"

#include <fmt/format.h>

#include <set>

#include "readers/ecl_grid_arrays.h"
#include "readers/pillar_builder.h"
#include "readers/text.h"

namespace wellknit {

namespace {

// Items of COORDS, from 0: i, j, k from 1, the cell's number, then 1 for an active cell where they are that many.
constexpr std::size_t coords_active = 4;
constexpr std::size_t coords_coarsened = 6;
constexpr std::int64_t numbers_of_corners = 24;

/// A file may leave out inactive cells: so many for each that is there, and a few thousand whatever it holds.
constexpr std::int64_t most_cells_for_one_given = 10;
constexpr std::int64_t free_cells = 10'000;

struct GridFileCell {
  std::array<std::int64_t, 3> ijk{};
  bool is_active = true;
  std::array<Vec3, 8> corners;
};

class GridFileReader {
 public:
  GridFileReader(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path) {}
  GridPart read();

 private:
  template <class Visit>
  void for_each_cell(Visit visit);
  bool take_head(const EclRecords& file, const EclArray& array);
  void take_cell(const EclRecords& file, const EclArray& array, GridFileCell& cell) const;
  void check_size(std::int64_t given) const;
  void set_depths(const GridFileCell& cell);
  void fill_missing();

  std::string_view bytes_;
  std::string path_;
  GridPart part_;
  std::vector<std::int32_t> active_;
  std::vector<bool> is_given_;
  std::set<std::string> unknown_;
};

bool GridFileReader::take_head(const EclRecords& file, const EclArray& array) {
  refuse_local_grids(file, array);
  if (array.name == "DIMENS" || array.name == "DIMENSIO") {
    if (!part_.dimensions) part_.dimensions = dimensions_of(file, array, 0);
    return true;
  }
  if (array.name == "RADIAL") {
    const std::vector<std::string> words = file.strings(array);
    if (!words.empty() && (words[0] == "TRUE" || words[0] == "T"))
      file.fail(array, {"Cartesian coordinates (RADIAL FALSE)", "a radial grid", "radial grids are not read"});
    return true;
  }
  return take_frame_array(file, array, part_);
}

void GridFileReader::take_cell(const EclRecords& file, const EclArray& array, GridFileCell& cell) const {
  file.require_at_least(array, 4);
  const std::vector<std::int32_t> coords = file.integers(array);
  if (!part_.dimensions) file.fail(array, {"DIMENS before it", "none", "the file is damaged"});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cell.ijk[axis] = coords[axis] - 1;
    if (coords[axis] < 1 || coords[axis] > (*part_.dimensions)[axis])
      file.fail(array, {fmt::format("a cell within {} {} {}", (*part_.dimensions)[0], (*part_.dimensions)[1],
                                    (*part_.dimensions)[2]),
                        fmt::format("{} {} {}", coords[0], coords[1], coords[2]), "the file is damaged"});
  }
  cell.is_active = coords.size() <= coords_active || coords[coords_active] != 0;
  if (coords.size() > coords_coarsened && coords[coords_coarsened] != 0)
    file.fail(array, {"a grid without coarsened cells (0 as item 7)", fmt::format("{}", coords[coords_coarsened]),
                      "export the grid before its coarsening"});
  if (coords.size() > coords_active && coords[coords_active] > 1)
    file.fail(array, {"0 or 1 as item 5", fmt::format("{}: a dual medium", coords[coords_active]), "not read"});
}

/// All cells in the order of the file: COORDS, then CORNERS.
template <class Visit>
void GridFileReader::for_each_cell(Visit visit) {
  EclRecords file(bytes_, path_);
  GridFileCell cell;
  bool has_coords = false;
  std::int64_t given = 0;
  while (const auto array = file.next()) {
    if (take_head(file, *array)) continue;
    if (array->name == "COORDS") {
      take_cell(file, *array, cell);
      has_coords = true;
    } else if (array->name == "CORNERS") {
      if (!has_coords) file.fail(*array, {"COORDS before it", "none", "the file is damaged"});
      file.require_count(*array, numbers_of_corners);
      const std::vector<double> values = file.reals(*array);
      for (std::size_t c = 0; c < 8; ++c) cell.corners[c] = {values[3 * c], values[3 * c + 1], values[3 * c + 2]};
      visit(file, *array, cell);
      has_coords = false;
      ++given;
    } else if (array->name != "COORDSYS") {
      unknown_.insert(quoted_for_message(array->name));
    }
  }
  if (has_coords || given == 0)
    throw ParseError({path_, 0, "CORNERS"},
                     {"CORNERS after COORDS", "the end of the file", "the file is cut: copy it again, in binary mode"});
}

void GridFileReader::check_size(std::int64_t given) const {
  const auto& n = *part_.dimensions;
  if (n[0] * n[1] * n[2] > free_cells + most_cells_for_one_given * given)
    throw ParseError({path_, 0, "DIMENS"},
                     {fmt::format("dimensions for a file of {} cells", given),
                      fmt::format("{} {} {}", n[0], n[1], n[2]), "write all cells (GRIDFILE 2), or an EGRID file"});
}

void GridFileReader::set_depths(const GridFileCell& cell) {
  CornerPointGrid shape;  // for its numbering alone
  shape.dimensions = *part_.dimensions;
  for (int c = 0; c < 8; ++c)
    part_.zcorn[shape.zcorn_index(cell.ijk, c & 1, (c >> 1) & 1, c >> 2)] =
        cell.corners[static_cast<std::size_t>(c)].z();
  const auto id = static_cast<std::size_t>(shape.cell_id(cell.ijk[0], cell.ijk[1], cell.ijk[2]).value());
  is_given_[id] = true;
  active_[id] = cell.is_active ? 1 : 0;
}

/// A cell that is not in the file gets no thickness: it lies on the bottom of the cell above it, or, where there is
/// none, at the top of its pillars.
void GridFileReader::fill_missing() {
  CornerPointGrid shape;
  shape.dimensions = *part_.dimensions;
  std::int64_t missing = 0;
  for (std::int64_t id = 0; id < shape.cell_count(); ++id) {
    if (is_given_[static_cast<std::size_t>(id)]) continue;
    ++missing;
    const auto ijk = shape.ijk(HostCellId(id));
    for (int c = 0; c < 4; ++c) {
      const int di = c & 1;
      const int dj = c >> 1;
      const auto pillar = static_cast<std::size_t>(ijk[0] + di + (shape.dimensions[0] + 1) * (ijk[1] + dj));
      const double depth = ijk[2] == 0 ? part_.coord[6 * pillar + 2]
                                       : part_.zcorn[shape.zcorn_index({ijk[0], ijk[1], ijk[2] - 1}, di, dj, 1)];
      for (const int dk : {0, 1}) part_.zcorn[shape.zcorn_index(ijk, di, dj, dk)] = depth;
    }
  }
  if (missing > 0) part_.notes.push_back(fmt::format("{} cells are not in the file and become inactive", missing));
}

GridPart GridFileReader::read() {
  std::int64_t given = 0;
  for_each_cell([&](const EclRecords&, const EclArray&, const GridFileCell&) { ++given; });
  check_size(given);
  note_byte_order(EclRecords(bytes_, path_), part_);
  PillarBuilder pillars(*part_.dimensions);
  const auto pillar_of = [](const GridFileCell& cell, std::size_t c) {
    return std::array{cell.ijk[0] + static_cast<std::int64_t>(c & 1),
                      cell.ijk[1] + static_cast<std::int64_t>((c >> 1) & 1)};
  };
  for_each_cell([&](const EclRecords&, const EclArray&, const GridFileCell& cell) {
    for (std::size_t c = 0; c < 8; ++c) {
      const auto [i, j] = pillar_of(cell, c);
      pillars.add(i, j, cell.corners[c]);
    }
  });
  const auto& n = *part_.dimensions;
  const auto cells = static_cast<std::size_t>(n[0] * n[1] * n[2]);
  part_.zcorn.assign(8 * cells, 0.0);
  active_.assign(cells, 0);
  is_given_.assign(cells, false);
  for_each_cell([&](const EclRecords& file, const EclArray& array, const GridFileCell& cell) {
    for (std::size_t c = 0; c < 8; ++c) {
      const auto [i, j] = pillar_of(cell, c);
      const auto off = pillars.distance(i, j, cell.corners[c]);
      if (off.found > off.allowed)
        file.fail(array, {"corners on straight pillars",
                          fmt::format("a corner of cell {} {} {} {:.3g} beside pillar {} {}", cell.ijk[0] + 1,
                                      cell.ijk[1] + 1, cell.ijk[2] + 1, off.found, i + 1, j + 1),
                          "this is no corner-point grid; export it as EGRID or GRDECL"});
    }
    set_depths(cell);
  });
  part_.coord = pillars.take_coord();
  fill_missing();
  if (!unknown_.empty())
    part_.notes.push_back(fmt::format("{} not understood, and skipped", listed({unknown_.begin(), unknown_.end()})));
  part_.arrays.push_back({"ACTNUM", std::move(active_), {path_, 0, "ACTNUM"}, false});
  return std::move(part_);
}

}  // namespace

bool looks_like_grid_file(std::string_view bytes) { return begins_with_ecl_header(bytes, {"DIMENS", "DIMENSIO"}); }

GridPart parse_grid_file(std::string_view bytes, const std::string& path) { return GridFileReader(bytes, path).read(); }

}  // namespace wellknit
