// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// One small faulted grid in every form: they hold the same numbers. The samples come from tools/make_grid_samples.py,
/// which shares no code with the readers.
#include <gtest/gtest.h>

#include <algorithm>

#include "readers/describe.h"
#include "readers/read_case.h"
#include "tests/readers/ecl_files.h"
#include "tests/readers/reader_helpers.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

std::string sample(const std::string& name) { return std::string(WELLKNIT_TESTDATA) + "/" + name; }

const Case& fault() {
  static const Case read = read_case(sample("ecl/fault.GRDECL"));
  return read;
}

bool has_note(const Case& read, const std::string& text) {
  return std::any_of(read.notes.begin(), read.notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

void expect_geometry(const CornerPointGrid& grid) {
  EXPECT_EQ(grid.dimensions, fault().grid.dimensions);
  EXPECT_EQ(grid.coord, fault().grid.coord);
  EXPECT_EQ(grid.zcorn, fault().grid.zcorn);
  EXPECT_EQ(grid.active, fault().grid.active);
}

/// On active cells: the files of simulators have no others.
void expect_rock(const CornerPointGrid& grid) {
  const CornerPointGrid& other = fault().grid;
  ASSERT_EQ(grid.porosity.size(), other.porosity.size());
  ASSERT_EQ(grid.permeability[0].size(), other.permeability[0].size());
  ASSERT_EQ(grid.permeability[2].size(), other.permeability[2].size());
  ASSERT_EQ(grid.properties.count("SATNUM"), 1U);
  const auto& regions = std::get<std::vector<std::int32_t>>(grid.properties.at("SATNUM"));
  const auto& other_regions = std::get<std::vector<std::int32_t>>(other.properties.at("SATNUM"));
  for (std::size_t cell = 0; cell < other.active.size(); ++cell) {
    if (other.active[cell] == 0) continue;
    EXPECT_EQ(grid.porosity[cell], other.porosity[cell]);
    EXPECT_EQ(grid.permeability[0][cell], other.permeability[0][cell]);
    EXPECT_EQ(grid.permeability[2][cell], other.permeability[2][cell]);
    EXPECT_EQ(regions[cell], other_regions[cell]);
  }
}

TEST(GridForms, SampleIsAsItsGeneratorSays) {
  const CornerPointGrid& grid = fault().grid;
  EXPECT_EQ(grid.dimensions, (std::array<std::int64_t, 3>{3, 2, 3}));
  EXPECT_EQ(std::count(grid.active.begin(), grid.active.end(), 1), 17);
  // Volume of a cell: 64 m x 32 m x thickness; 8, 12 and 16 m; the dip does not change it.
  EXPECT_NEAR(describe(grid).bulk_volume, 64.0 * 32.0 * (6 * (8 + 12 + 16) - 8), 1.0);
  EXPECT_TRUE(describe(grid).is_right_handed);
}

TEST(GridForms, EgridWithItsInitIsTheSameGrid) {
  const Case read = read_case(sample("ecl/fault.EGRID"));
  expect_geometry(read.grid);
  expect_rock(read.grid);
  EXPECT_EQ(read.grid.mapaxes, fault().grid.mapaxes);
  EXPECT_EQ(read.sources.size(), 2U);
  EXPECT_TRUE(has_note(read, "fault.INIT: properties are read from this file beside the grid"));
  EXPECT_TRUE(has_note(read, "PORV: results of the simulator, not used"));
  EXPECT_TRUE(has_note(read, "1 non-neighbour connections (NNC) are not taken"));
  EXPECT_EQ(read.notes.size(), 3U);
}

TEST(GridForms, FormattedEgridIsTheSameGrid) {
  const Case read = read_case(sample("ecl/fault.FEGRID"), {sample("ecl/formatted.FINIT")});
  expect_geometry(read.grid);
  expect_rock(read.grid);
  EXPECT_FALSE(has_note(read, "beside the grid")) << "an INIT file was given";
}

TEST(GridForms, LittleEndianFilesAreTheSameGridWithANote) {
  for (const char* name : {"ecl/little_endian.EGRID", "ecl/little_endian.bgrdecl"}) {
    const Case read = read_case(sample(name));
    expect_geometry(read.grid);
    EXPECT_TRUE(has_note(read, "little-endian")) << name;
  }
}

TEST(GridForms, BinaryGrdeclIsTheSameGrid) {
  const Case read = read_case(sample("ecl/fault.bgrdecl"));
  expect_geometry(read.grid);
  expect_rock(read.grid);
  EXPECT_TRUE(read.notes.empty());
}

TEST(GridForms, CellsOfAGridFileMakePillars) {
  for (const char* name : {"ecl/cells.GRID", "ecl/cells.FGRID"}) {
    const Case read = read_case(sample(name));
    EXPECT_EQ(read.grid.dimensions, fault().grid.dimensions);
    EXPECT_EQ(read.grid.zcorn, fault().grid.zcorn);
    EXPECT_EQ(read.grid.active, fault().grid.active);
    EXPECT_TRUE(read.notes.empty());
    for (std::int64_t cell = 0; cell < read.grid.cell_count(); ++cell) {
      const auto corners = read.grid.corners(HostCellId(cell));
      const auto expected = fault().grid.corners(HostCellId(cell));
      for (std::size_t c = 0; c < 8; ++c) {
        // Single precision: y of 5.93e6 is rounded to 0.5, x of 4.6e5 to 1/32.
        EXPECT_NEAR(corners[c].x(), expected[c].x(), 1.0 / 32) << name;
        EXPECT_NEAR(corners[c].y(), expected[c].y(), 0.5) << name;
      }
    }
  }
}

TEST(GridForms, RoffIsTheSameGrid) {
  for (const char* form : {".roff", "_big_endian.roff", ".roffasc"}) {
    const Case read = read_case(sample(std::string("roff/grid") + form), {sample(std::string("roff/rock") + form)});
    expect_geometry(read.grid);
    expect_rock(read.grid);
    EXPECT_TRUE(read.notes.empty()) << form;
  }
}

TEST(GridForms, MayBeMixed) {
  const Case read = read_case(sample("roff/grid.roff"), {sample("ecl/fault.INIT")});
  expect_geometry(read.grid);
  expect_rock(read.grid);
  const Case text = read_case(sample("ecl/fault.GRDECL"), {sample("roff/rock.roffasc")});
  expect_rock(text.grid);
}

TEST(GridForms, ARoffParameterIsUnsetWhereItIsUndefined) {
  // Cell 1 1 1 is inactive in the grid and -999 in PORO: a default there, and no error.
  EXPECT_EQ(read_case(sample("roff/grid.roff"), {sample("roff/rock.roff")}).grid.porosity[0], 0.0);
}

TEST(GridForms, UnitsComeFromTheFile) {
  const std::string feet = ecl::text("GRIDUNIT", {"FEET", "MAP"});
  const CornerPointGrid grid =
      case_of(ecl::two_heads() + feet + ecl::real("COORD", ecl::two_coord()) + ecl::real("ZCORN", ecl::two_zcorn()))
          .grid;
  EXPECT_EQ(grid.units, UnitSystem::field);
  EXPECT_DOUBLE_EQ(grid.zcorn.back(), 0.3048);
  EXPECT_DOUBLE_EQ(grid.coord[15], 2 * 0.3048) << "pillar 3 stands at x = 2 ft";
  EXPECT_EQ(case_of(ecl::two_boxes()).grid.units, UnitSystem::metric);
}

TEST(GridForms, InitOfAnotherUnitSystemDoesNotChangeTheGridsUnit) {
  std::vector<std::int32_t> head(100, 0);
  head[2] = 2;
  head[8] = 2;
  head[9] = head[10] = 1;
  head[11] = 2;
  const ScratchFolder folder;
  folder.write("A.EGRID", ecl::two_heads() + ecl::text("GRIDUNIT", {"METRES"}) + ecl::real("COORD", ecl::two_coord()) +
                              ecl::real("ZCORN", ecl::two_zcorn()));
  folder.write("A.INIT", ecl::inte("INTEHEAD", head) + ecl::real("PORO", {0.25F, 0.5F}));
  const CornerPointGrid grid = read_case(folder.file("A.EGRID")).grid;
  EXPECT_EQ(grid.units, UnitSystem::field);
  EXPECT_EQ(grid.zcorn.back(), 1.0);
  EXPECT_EQ(grid.porosity, (std::vector<double>{0.25, 0.5}));
}

TEST(GridForms, MissingActnumMeansAllActive) {
  EXPECT_EQ(case_of(ecl::two_boxes()).grid.active, (std::vector<std::uint8_t>{1, 1}));
}

TEST(GridForms, CellsThatAGridFileLeavesOutAreInactive) {
  std::vector<float> corners;
  for (const float z : {5.0F, 6.0F})
    for (const float y : {0.0F, 1.0F})
      for (const float x : {0.0F, 1.0F}) corners.insert(corners.end(), {x, y, z});
  const Case read =
      case_of(ecl::inte("DIMENS", {2, 1, 2}) + ecl::inte("COORDS", {1, 1, 1, 1}) + ecl::real("CORNERS", corners));
  EXPECT_EQ(read.grid.active, (std::vector<std::uint8_t>{1, 0, 0, 0}));
  EXPECT_TRUE(has_note(read, "3 cells are not in the file"));
  // Below the one cell: without thickness at its bottom. Beside it: without width, at the last pillar.
  EXPECT_EQ(read.grid.corners(HostCellId(2))[0], Vec3(0, 0, 6));
  EXPECT_EQ(read.grid.corners(HostCellId(2))[7], Vec3(1, 1, 6));
  EXPECT_EQ(read.grid.corners(HostCellId(1))[1], Vec3(1, 0, 5));
}

TEST(GridForms, AreDescribed) {
  const FileDescription grid = describe_file(sample("ecl/fault.EGRID"));
  EXPECT_EQ(grid.format, "EGRID");
  ASSERT_TRUE(grid.grid);
  EXPECT_EQ(grid.grid->active_cells, 17);
  const FileDescription rock = describe_file(sample("roff/rock.roff"));
  EXPECT_EQ(rock.format, "ROFF");
  ASSERT_TRUE(rock.grid);
  EXPECT_FALSE(rock.grid->has_geometry);
  ASSERT_EQ(rock.grid->properties.size(), 4U);
  EXPECT_EQ(rock.grid->properties[0].name, "PERMX");
  EXPECT_EQ(rock.grid->properties[0].least, 100.0);
  EXPECT_EQ(rock.grid->properties[0].most, 117.0);
  EXPECT_EQ(rock.grid->properties[0].unit, "mD");
  EXPECT_EQ(to_text(rock).find("bulk volume"), std::string::npos);
  EXPECT_NE(to_json(rock).find("\"bulk_volume\": null"), std::string::npos);
  EXPECT_EQ(describe_file(sample("ecl/fault.INIT")).grid->dimensions, (std::array<std::int64_t, 3>{3, 2, 3}));
}

}  // namespace
}  // namespace wellknit
