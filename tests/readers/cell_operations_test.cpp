// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// OPERATE and the operations on regions. Boxes and the plain operations are in read_case_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "model/units.h"
#include "readers/cell_arrays.h"
#include "tests/readers/reader_helpers.h"

namespace wellknit {
namespace {

using Reals = std::vector<double>;
using Integers = std::vector<std::int32_t>;

CornerPointGrid grid_of(const std::string& text, int nx = 3) { return case_of(unit_boxes(nx, 1, 1) + text).grid; }

TEST(CellOperations, OperateKnowsEveryFunction) {
  // R is 2 and X is 3 before each; a = 0.5, b = 2.
  const std::vector<std::pair<std::string, double>> functions{{"MULTA", 0.5 * 3 + 2},
                                                              {"MULTX", 0.5 * 3},
                                                              {"ADDX", 0.5 + 3},
                                                              {"MULTIPLY", 2.0 * 3},
                                                              {"POLY", 2 + 0.5 * 9},
                                                              {"MULTP", 0.5 * 9},
                                                              {"SLOG", std::pow(10, 0.5 + 2 * 3)},
                                                              {"LOG10", std::log10(3.0)},
                                                              {"LOGE", std::log(3.0)},
                                                              {"INV", 1.0 / 3},
                                                              {"ABS", 3},
                                                              {"COPY", 3},
                                                              {"MAXLIM", 0.5},
                                                              {"MINLIM", 3}};
  for (const auto& [name, expected] : functions) {
    const CornerPointGrid grid =
        grid_of("SWL\n 3*2 /\nSWU\n 3*3 /\nOPERATE\n SWL 2 2 4* " + name + " SWU 0.5 2 /\n/\n");
    const Reals& values = std::get<Reals>(grid.properties.at("SWL"));
    EXPECT_EQ(values[0], 2.0) << name;
    EXPECT_DOUBLE_EQ(values[1], expected) << name;
  }
}

TEST(CellOperations, OperateWorksInTheDecksUnits) {
  // The usual use: permeability from porosity, in mD.
  const CornerPointGrid grid = grid_of(
      "FIELD\nPORO\n 0.1 0.2 0.3 /\nOPERATE\n PERMX 6* SLOG PORO 1 10 /\n WORK1 6* MULTX PERMX 3 /\n PERMZ 6* MAXLIM "
      "WORK1 1000 /\n/\n");
  for (std::size_t cell = 0; cell < 3; ++cell) {
    const double perm = std::pow(10.0, 1 + 10 * grid.porosity[cell]);
    EXPECT_DOUBLE_EQ(grid.permeability[0][cell], perm * m2_per_millidarcy);
    EXPECT_DOUBLE_EQ(grid.permeability[2][cell], std::min(3 * perm, 1000.0) * m2_per_millidarcy);
  }
  EXPECT_TRUE(grid.properties.empty()) << "WORK1 is scratch";
}

TEST(CellOperations, OperateOnIntegersCutsFractions) {
  const CornerPointGrid grid = grid_of("SATNUM\n 1 2 3 /\nOPERATE\n FIPNUM 6* MULTA SATNUM 2.5 0 /\n/\n");
  EXPECT_EQ(std::get<Integers>(grid.properties.at("FIPNUM")), (Integers{2, 5, 7})) << "2.5, 5, 7.5";
}

TEST(CellOperations, OperateByRegionTakesOpernumUnlessNamed) {
  const CornerPointGrid grid = grid_of(
      "OPERNUM\n 1 2 2 /\nSATNUM\n 5 5 6 /\nSWL\n 3*0.1 /\nOPERATER\n SWL 2 MULTX SWL 2 /\n SWL 6 ADDX SWL 1 1* SATNUM "
      "/\n/\n");
  EXPECT_EQ(std::get<Reals>(grid.properties.at("SWL")), (Reals{0.1, 0.2, 1.2}));
}

TEST(CellOperations, WorkOnRegions) {
  const CornerPointGrid grid = grid_of(R"(
FLUXNUM
 1 2 3 /
MULTNUM
 7 7 8 /
PORO
 3*0.1 /
EQUALREG
 PORO 0.2 2 /
 PERMX 100 7 M /
 PERMX 10 8 'M' /
 SATNUM 4 3 F /
/
ADDREG
 PORO 0.05 1 F /
/
MULTIREG
 PERMX 3 8 M /
/
COPYREG
 PERMX PERMY 7 M /
 PORO PERMY 3 /
/
)");
  EXPECT_EQ(grid.porosity, (Reals{0.1 + 0.05, 0.2, 0.1})) << "without a letter: FLUXNUM";
  EXPECT_EQ(grid.permeability[0], (Reals{100 * m2_per_millidarcy, 100 * m2_per_millidarcy, 30 * m2_per_millidarcy}));
  EXPECT_EQ(grid.permeability[1], (Reals{100 * m2_per_millidarcy, 100 * m2_per_millidarcy, 0.1 * m2_per_millidarcy}));
  EXPECT_EQ(std::get<Integers>(grid.properties.at("SATNUM")), (Integers{1, 1, 4}));
}

TEST(CellOperations, GridoptsMakesMultnumTheDefaultRegions) {
  const std::string text = "FLUXNUM\n 1 1 2 /\nMULTNUM\n 1 2 2 /\nEQUALREG\n PORO 0.2 1 /\n PORO 0.4 2 /\n/\n";
  EXPECT_EQ(grid_of(text).porosity, (Reals{0.2, 0.2, 0.4}));
  EXPECT_EQ(grid_of("GRIDOPTS\n YES 2 /\n" + text).porosity, (Reals{0.2, 0.4, 0.4}));
  EXPECT_EQ(grid_of("GRIDOPTS\n YES 0 /\n" + text).porosity, (Reals{0.2, 0.2, 0.4}));
}

TEST(CellOperations, NoteARegionWithoutCells) {
  const Case read = case_of(unit_boxes(1, 1, 1) + "FLUXNUM\n 1 /\nSWL\n 0 /\nEQUALREG\n SWL 0.2 9 F /\n/\n");
  ASSERT_EQ(read.notes.size(), 1U);
  EXPECT_EQ(read.notes[0], "case.GRDECL:17: EQUALREG: no cell is in region 9 of FLUXNUM");
}

TEST(CellOperations, NoteBoxesThatSimulatorsReadDifferently) {
  const Case read =
      case_of(unit_boxes(3, 1, 2) + "SWL\n 6*0 /\nEQUALS\n SWL 0.1 1 2 1 1 1 1 /\n SWL 0.2 3 3 /\n SWL 0.3 2 2 /\n/\n");
  ASSERT_EQ(read.notes.size(), 1U);
  EXPECT_NE(read.notes[0].find("case.GRDECL:21: EQUALS: the limits left out"), std::string::npos) << read.notes[0];
}

TEST(CellOperations, AnArrayOfTheTopLayerOnlyHoldsBelow) {
  const Case read = case_of(unit_boxes(2, 1, 3) + "BOX\n 1 2 1 1 1 1 /\nPORO\n 0.1 0.2 /\nENDBOX\n");
  EXPECT_EQ(read.grid.porosity, (Reals{0.1, 0.2, 0.1, 0.2, 0.1, 0.2}));
  ASSERT_EQ(read.notes.size(), 1U);
  EXPECT_EQ(read.notes[0], "case.GRDECL: PORO is given for the top layer only and holds for those below");
}

TEST(CellOperations, NoteActiveCellsWithoutAValue) {
  const Case read =
      case_of(unit_boxes(3, 1, 1) + "ACTNUM\n 1 1 0 /\nSWL\n 3*0.1 /\nCOPY\n SWL SWCR 1 1 /\n/\nSWU\n 2*0.9 1* /\n");
  EXPECT_EQ(std::get<Reals>(read.grid.properties.at("SWCR")), (Reals{0.1, 0, 0}));
  ASSERT_EQ(read.notes.size(), 1U) << "SWU lacks a value in an inactive cell only";
  EXPECT_NE(read.notes[0].find("SWCR has no value in 1 active cells; 0 stands there"), std::string::npos)
      << read.notes[0];
}

TEST(CellArrayRules, CarryDirectionalEndPoints) {
  for (const char* name : {"SWL", "SWLX", "SWLX-", "ISWLZ-", "KRWY", "IKRORGY-", "KRGRX", "SOWCRZ", "ISOGCR", "PCW",
                           "IPCG", "SWATINIT", "FIPZON", "KRNUMX-", "IMBNUMY", "THCONR", "DIFFMX-", "MINPVV", "WORK12"})
    EXPECT_NE(find_cell_array(name), nullptr) << name;
  for (const char* name :
       {"SWLW", "SWL-", "X", "I", "", "-", "SWLXX", "FIP", "FIPOWG", "WORK", "WORKX", "PRVD", "TRANX", "ISWATINIT"})
    EXPECT_EQ(find_cell_array(name), nullptr) << name;
  EXPECT_EQ(find_cell_array("ISWUX-")->default_value, 1.0);
}

}  // namespace
}  // namespace wellknit
