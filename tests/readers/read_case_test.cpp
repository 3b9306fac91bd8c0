// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <variant>

#include "model/units.h"
#include "readers/file_content.h"
#include "tests/readers/reader_helpers.h"

namespace wellknit {
namespace {

using Integers = std::vector<std::int32_t>;
using Reals = std::vector<double>;

const std::string box_file = std::string(WELLKNIT_TESTDATA) + "/grdecl/box.GRDECL";

double volume(const CornerPointGrid& grid) {
  double sum = 0.0;
  for (std::int64_t cell = 0; cell < grid.cell_count(); ++cell)
    sum += bilinear_hexahedron_volume(grid.corners(HostCellId(cell)));
  return sum;
}

void expect_same(const CornerPointGrid& a, const CornerPointGrid& b) {
  EXPECT_EQ(a.dimensions, b.dimensions);
  EXPECT_EQ(a.coord, b.coord);
  EXPECT_EQ(a.zcorn, b.zcorn);
  EXPECT_EQ(a.active, b.active);
  EXPECT_EQ(a.porosity, b.porosity);
  EXPECT_EQ(a.permeability, b.permeability);
  EXPECT_EQ(a.properties, b.properties);
}

TEST(ReadCase, ReadsABareGrid) {
  const Case read = read_case(box_file);
  const CornerPointGrid& grid = read.grid;
  EXPECT_EQ(grid.dimensions, (std::array<std::int64_t, 3>{2, 1, 1}));
  EXPECT_DOUBLE_EQ(volume(grid), 1.0 * 1.0 * 1.0 + 2.0 * 1.0 * 1.0);
  EXPECT_EQ(grid.active, (std::vector<std::uint8_t>{1, 1}));
  EXPECT_EQ(grid.porosity, (Reals{0.1, 0.2}));
  EXPECT_DOUBLE_EQ(grid.permeability[0][1], 200.0 * m2_per_millidarcy) << "2.0D+2";
  EXPECT_TRUE(grid.permeability[1].empty());
  EXPECT_TRUE(grid.net_to_gross.empty());
  EXPECT_EQ(std::get<Integers>(grid.properties.at("SATNUM")), (Integers{1, 2}));
  EXPECT_TRUE(read.notes.empty());
  EXPECT_TRUE(read.deck_wells.empty());
}

TEST(ReadCase, ListsTheFileWithItsHash) {
  const Case read = read_case(box_file);
  ASSERT_EQ(read.sources.size(), 1U);
  EXPECT_EQ(read.sources[0].path, box_file);
  EXPECT_EQ(read.sources[0].sha256, sha256_hex(load_file(box_file).text));
}

TEST(ReadCase, TakesAnyLineEnd) {
  const std::string text(load_file(box_file).text);
  std::string windows;
  std::string old_mac = text;
  for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
  const CornerPointGrid grid = case_of(text).grid;
  expect_same(case_of(windows).grid, grid);
  expect_same(case_of(old_mac).grid, grid);
  expect_same(case_of(text.substr(0, text.size() - 1)).grid, grid);
}

TEST(ReadCase, ReadsInSmallLettersWithTabsAndAccents) {
  std::string text(load_file(box_file).text);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  std::replace(text.begin(), text.end(), ' ', '\t');
  expect_same(case_of("-- \xE5\xF8 m\xC2\xB3\n" + text).grid, read_case(box_file).grid);
}

TEST(ReadCase, TakesTextAfterTheSlashAndDataOnTheKeywordsLine) {
  const Case read = case_of(unit_boxes(2, 1, 1) + "PORO 2*0.2/ Garn 3\nNTG 1 0.5 / -- comment\nSATNUM\n2*3/\n");
  EXPECT_EQ(read.grid.porosity, (Reals{0.2, 0.2}));
  EXPECT_EQ(read.grid.net_to_gross, (Reals{1.0, 0.5}));
  EXPECT_EQ(std::get<Integers>(read.grid.properties.at("SATNUM")), (Integers{3, 3}));
}

TEST(ReadCase, GivesDefaultsTheirMeaning) {
  const Case read =
      case_of(unit_boxes(3, 1, 1) + "ACTNUM\n 0 2* /\nPORO\n 1* 0.2 0.3 /\nNTG\n 2* 0.5 /\nFIPNUM\n 1* 7 1* /\n");
  EXPECT_EQ(read.grid.active, (std::vector<std::uint8_t>{0, 1, 1}));
  EXPECT_EQ(read.grid.porosity, (Reals{0.0, 0.2, 0.3})) << "an inactive cell needs no porosity";
  EXPECT_EQ(read.grid.net_to_gross, (Reals{1.0, 1.0, 0.5}));
  EXPECT_EQ(std::get<Integers>(read.grid.properties.at("FIPNUM")), (Integers{1, 7, 1}));
}

TEST(ReadCase, ConvertsFieldUnits) {
  const Case read = case_of("FIELD\n" + unit_boxes(1, 1, 1) + "PERMX\n 1000 /\nSWAT\n 0.5 /\n");
  EXPECT_EQ(read.grid.units, UnitSystem::field);
  EXPECT_DOUBLE_EQ(volume(read.grid), 0.3048 * 0.3048 * 0.3048);
  EXPECT_DOUBLE_EQ(read.grid.permeability[0][0], m2_per_darcy);
  EXPECT_EQ(std::get<Reals>(read.grid.properties.at("SWAT")), (Reals{0.5}));
}

TEST(ReadCase, ConvertsLabUnits) {
  EXPECT_DOUBLE_EQ(volume(case_of("LAB\n" + unit_boxes(1, 1, 1)).grid), 1e-6) << "1 cm3";
}

TEST(ReadCase, LetsGridUnitOverrideTheGeometrysUnit) {
  EXPECT_DOUBLE_EQ(volume(case_of("GRIDUNIT\n 'FEET' /\n" + unit_boxes(1, 1, 1)).grid), 0.3048 * 0.3048 * 0.3048);
  EXPECT_DOUBLE_EQ(volume(case_of("FIELD\nGRIDUNIT\n METRES MAP /\n" + unit_boxes(1, 1, 1)).grid), 1.0);
}

TEST(ReadCase, KeepsMapAxesAndPinch) {
  const Case read =
      case_of("MAPAXES\n 0 100 0 0 100 0 /\n" + unit_boxes(1, 1, 1) + "PINCH\n 0.001 GAP 1* TOPBOT TOP/\n");
  EXPECT_EQ(read.grid.mapaxes, (std::array<double, 6>{0, 100, 0, 0, 100, 0}));
  EXPECT_TRUE(read.grid.connects_across_pinch);
  EXPECT_FALSE(case_of(unit_boxes(1, 1, 1)).grid.connects_across_pinch);
}

TEST(ReadCase, AppliesBoxesAndOperations) {
  const Case read = case_of(unit_boxes(2, 1, 2) + R"(
EQUALS
 'PORO'  0.2 /
 'PERMX' 100 1 2 1 1 1 1 /
 'PERMX' 50  1 2 1 1 2 2 /
 SATNUM  2 1 1 1 1 1 2 /
/
BOX
 2 2 1 1 1 2 /
PORO
 0.3 0.4 /
MULTIPLY
 'PERMX' 2 /
/
ENDBOX
COPY
 PERMX PERMY /
 PERMX PERMZ 1 1 1 1 1 2 /
 PERMX PERMZ 2 2 /
/
ADD
 PORO 0.05 1 1 1 1 1 1 /
/
MAXVALUE
 PERMY 120 /
/
MINVALUE
 PERMY 60 /
/
)");
  const auto& grid = read.grid;
  // Cells in order: (1,1,1), (2,1,1), (1,1,2), (2,1,2).
  EXPECT_EQ(grid.porosity, (Reals{0.2 + 0.05, 0.3, 0.2, 0.4}));
  const auto millidarcies = [](Reals values) {
    for (double& value : values) value *= m2_per_millidarcy;
    return values;
  };
  EXPECT_EQ(grid.permeability[0], millidarcies({100, 100 * 2, 50, 50 * 2}));
  EXPECT_EQ(grid.permeability[1], millidarcies({100, 120, 60, 100})) << "200 held down to 120, 50 lifted to 60";
  EXPECT_EQ(grid.permeability[2], grid.permeability[0]) << "the third record keeps J and K of the second";
  EXPECT_EQ(std::get<Integers>(grid.properties.at("SATNUM")), (Integers{2, 1, 2, 1})) << "1 where nothing was given";
}

TEST(ReadCase, NotesOnceWhatItDoesNotApply) {
  const Case read = case_of(
      unit_boxes(2, 1, 1) +
      "HALFTRAN\nMULTX\n 2*0.5 /\nAQUCON\n 1 1 2 1 1 1 1 'I-' /\n/\nHALFTRAN\nAQUCON\n 1 1 2 1 1 1 1 'I-' /\n/\n");
  ASSERT_EQ(read.notes.size(), 2U);
  EXPECT_EQ(read.notes[0], "case.GRDECL:14: HALFTRAN is not applied yet");
  EXPECT_EQ(read.notes[1], "case.GRDECL:17: AQUCON is not applied yet");
}

TEST(ReadCase, PassesOverUnknownKeywordsWithoutMisreadingTheirData) {
  const Case read = case_of(unit_boxes(2, 1, 1) + R"(UNHEARD
 1 2 3
 'PORO' 4 /
 PORO 9 9 /
/
ANOTHER
FLAGONLY
PORO
 0.1 0.2 /
UNHEARD
 5 /
)");
  EXPECT_EQ(read.grid.porosity, (Reals{0.1, 0.2}));
  ASSERT_EQ(read.notes.size(), 3U);
  EXPECT_EQ(read.notes[0], "case.GRDECL:14: UNHEARD is not understood and is skipped");
  EXPECT_EQ(read.notes[1], "case.GRDECL:19: ANOTHER is not understood and is skipped");
  EXPECT_EQ(read.notes[2], "case.GRDECL:20: FLAGONLY is not understood and is skipped");
}

TEST(ReadCase, PassesOverListsThatOpenWithNamesOfArrays) {
  const Case read =
      case_of(unit_boxes(1, 1, 1) + "UNHEARD\nPORO 0.25 1 M /\nPERMX 100 1 M /\n/\nCOPYBOX\nPORO 6*1 6*1 /\n/\n");
  EXPECT_TRUE(read.grid.porosity.empty());
  EXPECT_EQ(read.notes.size(), 2U);
}

TEST(ReadCase, PassesOverGridKeywordsByTheirForm) {
  // One record, a list, a flag, an array: names of arrays in their data are data.
  const Case read = case_of("GRID\n" + unit_boxes(2, 1, 1) + R"(RPTGRID
PORO
PERMX /
THPRESFT
PERMX 10 /
PORO 2 /
/
RPTISOL
NOGGF
GRIDFILE
 0 1 /
JFUNC
 WATER 20 1* 0.5 0.5 XY /
AQUANCON
 1 1 1 1 1 1 1 'I-' /
/
MULTREGD
 1 2 0.5 /
/
EDIT
REGIONS
RPTREGS
SATNUM
FIPNUM /
)");
  EXPECT_TRUE(read.notes.empty());
  EXPECT_TRUE(read.grid.porosity.empty());
  EXPECT_TRUE(read.grid.properties.empty());
}

TEST(ReadCase, NotesOnceWhatItRecognisesAndDoesNotApply) {
  const Case read = case_of(unit_boxes(2, 1, 1) + R"(PINCHREG
 0.1 /
/
HALFTRAN
PERMXX
 2*100 /
DIFFX
 2*1 /
MINNNCT
 1E-5 /
AQUNUM
 1 1 1 1 100 /
/
PERMXX
 2*100 /
)");
  ASSERT_EQ(read.notes.size(), 6U);
  for (const std::string& note : read.notes) EXPECT_NE(note.find(" is not applied yet"), std::string::npos) << note;
}

TEST(ReadCase, KeepsWhatTheMapIs) {
  const CornerPointGrid grid = case_of("MAPUNITS\n FEET /\nGRIDUNIT\n METRES MAP /\n" + unit_boxes(1, 1, 1)).grid;
  EXPECT_EQ(grid.metre_per_map_unit, 0.3048);
  EXPECT_TRUE(grid.has_map_coordinates);
  EXPECT_FALSE(case_of(unit_boxes(1, 1, 1)).grid.has_map_coordinates);
  EXPECT_EQ(case_of(unit_boxes(1, 1, 1)).grid.metre_per_map_unit, 1.0);
}

TEST(ReadCase, NotesDepthsThatWouldBeHeights) {
  EXPECT_TRUE(case_of("GDORIENT\n INC DEC INC DOWN LEFT /\n" + unit_boxes(1, 1, 1)).notes.empty());
  const Case read = case_of("GDORIENT\n INC INC INC UP /\n" + unit_boxes(1, 1, 1));
  ASSERT_EQ(read.notes.size(), 1U);
  EXPECT_NE(read.notes[0].find("case.GRDECL:2: GDORIENT says that Z points UP"), std::string::npos);
}

TEST(ReadCase, TakesASpecgridTwiceAndSkipsWhatOtherSimulatorsSkip) {
  const Case read =
      case_of(unit_boxes(1, 1, 1) + "SPECGRID\n 1 1 1 1 F /\nSKIP\nPORO\n x /\nENDSKIP\nSKIP100\nPORO\n y " +
              "/\nENDSKIP\nSKIP300\nporo 0.25/\nENDSKIP\n");
  EXPECT_EQ(read.grid.porosity, (Reals{0.25})) << "ECLIPSE 100 reads what SKIP300 encloses";
  EXPECT_TRUE(read.notes.empty());
}

TEST(ReadCase, CarriesArraysOfEverySection) {
  const Case read = case_of("GRID\n" + unit_boxes(1, 1, 1) +
                            "THCONR\n 2 /\nPROPS\nSWLX-\n 0.1 /\nIKRORGZ\n 0.5 /\nSWATINIT\n 0.3 /\nPRVD\n 1000 100 /\n"
                            "REGIONS\nKRNUMX\n 2 /\nSOLUTION\nRVW\n 0.01 /\nTEMPI\n 60 /\n");
  EXPECT_EQ(read.grid.properties.size(), 7U) << "PRVD is a table";
  EXPECT_EQ(std::get<Integers>(read.grid.properties.at("KRNUMX")), (Integers{2}));
  EXPECT_EQ(std::get<Reals>(read.grid.properties.at("SWLX-")), (Reals{0.1}));
}

TEST(ReadCase, ReadsFurtherGridFilesAfterTheCase) {
  MemoryFiles files({{"a/grid", unit_boxes(2, 1, 1) + "END\n"},
                     {"poro", "NOECHO\nPORO\n 0.1 0.2 /\nECHO\n"},
                     {"faults", "SPECGRID\n 2 1 1 1 F /\nFAULTS\n 'F' 1 1 1 1 1 1 I- /\n/\n"}});
  const Case read = parse_case(files, "a/grid", {"poro", "faults"});
  EXPECT_EQ(read.grid.porosity, (Reals{0.1, 0.2}));
  EXPECT_EQ(read.sources.size(), 3U);
  EXPECT_TRUE(read.notes.empty());
  EXPECT_EQ(read.grid.edits.faults.size(), 1U);
}

TEST(ReadCase, StopsAtEndAndAtEndInc) {
  const Case read = case_of(unit_boxes(1, 1, 1) + "INCLUDE\n 'p.inc' /\nNTG\n 0.5 /\nEND\nNTG\n nonsense /\n",
                            {{"p.inc", "PORO\n 0.2 /\nENDINC\nPORO\n x /\n"}});
  EXPECT_EQ(read.grid.porosity, (Reals{0.2}));
  EXPECT_EQ(read.grid.net_to_gross, (Reals{0.5}));
}

TEST(ReadCase, LooksForIncludesBesideTheIncludingFileThenBesideTheDeck) {
  MemoryFiles files({{"deck/main", "INCLUDE\n inc/a.inc /\n"},
                     {"deck/inc/a.inc", unit_boxes(1, 1, 1) + "INCLUDE\n 'near.inc' /\nINCLUDE\n 'far.inc' /\n"},
                     {"deck/inc/near.inc", "PORO\n 0.2 /\n"},
                     {"deck/far.inc", "NTG\n 0.5 /\n"}});
  const Case read = parse_case(files, "deck/main");
  EXPECT_EQ(read.grid.porosity, (Reals{0.2}));
  EXPECT_EQ(read.grid.net_to_gross, (Reals{0.5}));
  EXPECT_EQ(read.sources[2].path, "near.inc");
}

TEST(ReadCase, ReadsBlockCentredGrids) {
  const Case read = case_of(R"(FIELD
DIMENS
 2 1 2 /
DXV
 100 300 /
DY
 4*200 /
DZ
 2*10 2*20 /
TOPS
 2*1000 /
)");
  // Two columns of 100 and 300 ft by 200 ft, 10 + 20 ft high.
  EXPECT_NEAR(volume(read.grid), (100 + 300) * 200.0 * 30.0 * 0.3048 * 0.3048 * 0.3048, 1e-6);
  EXPECT_DOUBLE_EQ(read.grid.zcorn.front(), 1000 * 0.3048);
  EXPECT_TRUE(read.grid.properties.empty()) << "DX and TOPS are geometry, no properties";
}

TEST(ReadCase, ReadsTopsOfEveryLayerWithGapsBetweenThem) {
  const Case read =
      case_of("DIMENS\n 1 1 2 /\nEQUALS\n DX 10 /\n DZ 5 /\n TOPS 100 4* 1 1 /\n TOPS 120 4* 2 2 /\n/\nDYV\n 20 /\n");
  EXPECT_NEAR(volume(read.grid), 2 * 10.0 * 20.0 * 5.0, 1e-9);
  const std::vector<double> zcorn{100, 100, 100, 100, 105, 105, 105, 105, 120, 120, 120, 120, 125, 125, 125, 125};
  EXPECT_EQ(read.grid.zcorn, zcorn) << "a gap of 15 m between the layers";
}

TEST(ReadCase, HoldsCellSizesOfTheTopLayerForAll) {
  const Case read = case_of(
      "DIMENS\n 2 1 2 /\nBOX\n 1 2 1 1 1 1 /\nDX\n 10 30 /\nDY\n 2*20 /\nDZ\n 5 6 /\nTOPS\n 100 101 /\nENDBOX\n");
  EXPECT_NEAR(volume(read.grid), 2 * (10 * 20 * 5 + 30 * 20 * 6), 1e-9);
  EXPECT_EQ(read.notes.size(), 3U) << "DX, DY and DZ hold for the lower layer";
}

}  // namespace
}  // namespace wellknit
