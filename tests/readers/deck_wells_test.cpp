// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/deck_wells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <random>

#include "model/units.h"
#include "readers/read_case.h"
#include "tests/readers/reader_helpers.h"
#include "tests/support/random_seed.h"

namespace wellknit {
namespace {

/// Boxes of 1 m; wells after SCHEDULE.
Case deck(const std::string& schedule, const std::string& grid_section = "") {
  return case_of("RUNSPEC\nGRID\n" + unit_boxes(4, 3, 4) + grid_section +
                 "SCHEDULE\nWELSPECS\n 'W' 'G' 2 3 /\n 'V1' 'G' 1 1 /\n 'V2' 'G' 1 2 /\n/\n" + schedule);
}

std::vector<Vec3> path(const Well& well) { return well.trajectory.points; }

TEST(DeckWells, VerticalWellGoesFromTopFaceToBaseFace) {
  const Case read = deck("COMPDAT\n W 2* 2 3 OPEN 2* 0.2 /\n/\n");
  ASSERT_EQ(read.deck_wells.size(), 1U);
  const Well& well = read.deck_wells[0];
  // Column i 2, j 3: centre at (1.5, 2.5); layers 2 and 3 span depths 1 to 3.
  EXPECT_EQ(path(well), (std::vector<Vec3>{{1.5, 2.5, 1}, {1.5, 2.5, 1.5}, {1.5, 2.5, 2.5}, {1.5, 2.5, 3}}));
  EXPECT_EQ(well.trajectory.measured_depth, (std::vector<double>{0, 0.5, 1.5, 2}));
  EXPECT_TRUE(well.approximate_path);
  ASSERT_EQ(well.open.size(), 1U);
  EXPECT_EQ(well.open[0].from, 0.0);
  EXPECT_EQ(well.open[0].to, 2.0);
  EXPECT_EQ(well.radial.bore_radius, 0.1);
  EXPECT_EQ(read.notes.size(), 2U) << "V1 and V2 are completed nowhere";
}

TEST(DeckWells, OneCellIsCrossedAlongItsDirection) {
  const Case read = deck("COMPDAT\n W 2* 1 1 3* 0.2 3* X /\n/\n");
  EXPECT_EQ(path(read.deck_wells[0]), (std::vector<Vec3>{{1, 2.5, 0.5}, {2, 2.5, 0.5}}));
}

TEST(DeckWells, HorizontalWellFollowsItsRecords) {
  const Case read = deck("COMPDAT\n W 3 2 1 1 3* 0.2 3* X /\n W 2 2 1 1 3* 0.2 3* X /\n W 2 1 1 1 3* 0.2 3* Y /\n/\n");
  // Enters at the high-i face of cell 3, runs towards low i, then towards low j and out of cell (2,1).
  EXPECT_EQ(path(read.deck_wells[0]),
            (std::vector<Vec3>{{3, 1.5, 0.5}, {2.5, 1.5, 0.5}, {1.5, 1.5, 0.5}, {1.5, 0.5, 0.5}, {1.5, 0, 0.5}}));
  EXPECT_EQ(read.deck_wells[0].open.size(), 1U);
}

TEST(DeckWells, ColumnGivenFromBelowIsPutInOrder) {
  const Case read = deck("COMPDAT\n W 2* 4 4 /\n W 2* 1 1 /\n W 2* 2 2 SHUT /\n/\n");
  const Well& well = read.deck_wells[0];
  EXPECT_EQ(path(well).front().z(), 0.0);
  EXPECT_EQ(path(well).back().z(), 4.0);
  // Layer 1 is open, 2 is shut, 3 is not completed, 4 is open.
  ASSERT_EQ(well.open.size(), 2U);
  EXPECT_DOUBLE_EQ(well.open[0].from, 0.0);
  EXPECT_DOUBLE_EQ(well.open[0].to, 1.0);
  EXPECT_DOUBLE_EQ(well.open[1].from, 3.0);
  EXPECT_DOUBLE_EQ(well.open[1].to, 4.0);
}

TEST(DeckWells, ShutWellIsOpenNowhere) {
  const Case read = deck("COMPDAT\n W 2* 1 2 SHUT /\n/\n");
  ASSERT_EQ(read.deck_wells[0].open.size(), 1U) << "an empty list would mean open everywhere";
  EXPECT_EQ(read.deck_wells[0].open[0].to, 0.0);
  EXPECT_EQ(read.notes[0], "case.GRDECL: well W: all its completions are shut");
}

TEST(DeckWells, LaterRecordsReplaceEarlierOnes) {
  const Case read = deck("COMPDAT\n W 2* 1 4 OPEN /\n/\nTSTEP\n 1 /\nCOMPDAT\n W 2* 2 2 SHUT 1* 5 /\n/\n");
  const Well& well = read.deck_wells[0];
  ASSERT_EQ(well.completions.size(), 4U);
  EXPECT_FALSE(well.completions[1].open);
  EXPECT_DOUBLE_EQ(*well.completions[1].connection_factor, 5.0 * m3_per_transmissibility_unit(UnitSystem::metric));
}

TEST(DeckWells, NamesMayHoldAStar) {
  const Case read = deck("COMPDAT\n 'V*' 2* 1 1 /\n/\nWCONINJE\n '*2' WATER OPEN /\n/\n");
  ASSERT_EQ(read.deck_wells.size(), 2U);
  EXPECT_EQ(read.deck_wells[0].type, WellType::producer);
  EXPECT_EQ(read.deck_wells[1].type, WellType::injector);
}

TEST(DeckWells, LayersDefaultToTheWholeColumn) {
  EXPECT_EQ(deck("COMPDAT\n W 0 0 /\n/\n").deck_wells[0].completions.size(), 4U);
}

TEST(DeckWells, CommonSkinIsThatOfTheWell) {
  EXPECT_EQ(deck("COMPDAT\n W 2* 1 2 4* 1* 2.5 /\n/\n").deck_wells[0].skin, 2.5);
  EXPECT_EQ(deck("COMPDAT\n W 2* 1 1 4* 1* 2.5 /\n W 2* 2 2 /\n/\n").deck_wells[0].skin, 0.0);
}

TEST(DeckWells, InactiveCellsAreDropped) {
  const Case read = deck("COMPDAT\n W 2* 1 4 /\n V1 2* 1 1 /\n/\n", "EQUALS\n ACTNUM 0 1 4 1 3 1 1 /\n/\n");
  ASSERT_EQ(read.deck_wells.size(), 1U);
  EXPECT_EQ(read.deck_wells[0].completions.size(), 3U);
  ASSERT_EQ(read.notes.size(), 3U);
  EXPECT_EQ(read.notes[0], "case.GRDECL: well W: 1 of its 4 completions are in inactive cells and are dropped");
  EXPECT_EQ(read.notes[1], "case.GRDECL: well V1 is left out: all its completions are in inactive cells");
}

TEST(DeckWells, CellsWithoutThicknessAddNoStation) {
  const std::string flat = "ZCORN\n 48*0 48*1  48*1 48*1  48*1 48*2  48*2 48*3 /\n";
  const Case read = deck("COMPDAT\n W 2* 1 3 /\n V1 2* 2 2 /\n/\n", flat);
  ASSERT_EQ(read.deck_wells.size(), 1U);
  EXPECT_EQ(read.deck_wells[0].trajectory.measured_depth, (std::vector<double>{0, 0.5, 1, 1.5, 2}));
  EXPECT_EQ(read.notes[0], "case.GRDECL: well V1 is left out: its completed cells have no thickness along it");
}

void expect_error(const std::string& schedule, const std::string& keyword, const std::string& expected) {
  const auto error = error_of([&] { return deck(schedule); });
  ASSERT_TRUE(error) << schedule;
  EXPECT_EQ(error->where().keyword, keyword);
  EXPECT_GT(error->where().line, 0);
  EXPECT_NE(std::string(error->what()).find(expected), std::string::npos) << error->what();
}

TEST(DeckWells, FaultsAreNamed) {
  expect_error("COMPDAT\n X 2* 1 1 /\n/\n", "COMPDAT", "a well that WELSPECS has named, found 'X'");
  expect_error("COMPDAT\n W 5 1 1 1 /\n/\n", "COMPDAT",
               "I between 1 and 4 as item 2, found 5; the well is outside the grid");
  expect_error("COMPDAT\n W 2* 1 5 /\n/\n", "COMPDAT", "K between 1 and 4 as item 5");
  expect_error("COMPDAT\n W 2* 2 1 /\n/\n", "COMPDAT", "a first layer above the last");
  expect_error("COMPDAT\n W 2* 1 1 AJAR /\n/\n", "COMPDAT", "OPEN, SHUT or AUTO as item 6");
  expect_error("COMPDAT\n W 2* 1 1 3* 0.2 3* U /\n/\n", "COMPDAT", "X, Y or Z as item 13");
  expect_error("COMPDAT\n W 2* 1 1 3* -0.2 /\n/\n", "COMPDAT", "a bore diameter of 0 or more");
  expect_error("COMPDAT\n W 2* 1 1 OPEN 1* 1..0 /\n/\n", "COMPDAT", "a number as item 8, found '1..0'");
  expect_error("COMPDAT\n W 2* 1 1 OPEN\n", "COMPDAT", "the end of the file");
  expect_error("WELSPECS\n 'W2' 'G' 9 1 /\n/\n", "WELSPECS", "I between 1 and 4 as item 3");
  expect_error("WELSPECS\n 'N' 'G' /\n/\nCOMPDAT\n N 2* 1 1 /\n/\n", "COMPDAT", "I and J of 'N'");
  expect_error("COMPDATL\n W 'LGR' 2* 1 1 /\n/\n", "COMPDATL", "a local grid refinement");
}

bool has_note(const Case& read, const std::string& part) {
  return std::any_of(read.notes.begin(), read.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

TEST(DeckWells, ListsAndQuestionMarksNameWells) {
  const Case read = deck(
      "WLIST\n '*L' NEW V1 W /\n '*L' DEL W /\n '*M' NEW 'V?' /\n '*M' MOV V2 /\n/\nCOMPDAT\n '*L' 2* 1 1 /\n '*M' 2* "
      "2 2 "
      "/\n/\n");
  ASSERT_EQ(read.deck_wells.size(), 2U);
  EXPECT_EQ(read.deck_wells[0].completions.size(), 2U) << "V1 is in both lists";
  EXPECT_EQ(read.deck_wells[1].completions.size(), 1U);
}

TEST(DeckTrajectories, GivePathAndPerforations) {
  const Case read = deck(
      "WELTRAJ\n W 1* 1.5 2.5 -1 0 /\n W 1 1.5 2.5 3 4 /\n W 1* 3.5 2.5 3 6 /\n/\n"
      "COMPTRAJ\n W 1* 2 4.5 3* 1* 1* 0.2 1* 3 /\n W 1* 3 3.5 MD 1* SHUT 2* 0.2 1* 3 /\n/\nCOMPDAT\n V1 2* 1 1 /\n/\n");
  ASSERT_EQ(read.deck_wells.size(), 2U);
  const Well& well = read.deck_wells[0];
  EXPECT_EQ(path(well), (std::vector<Vec3>{{1.5, 2.5, -1}, {1.5, 2.5, 3}, {3.5, 2.5, 3}}));
  EXPECT_EQ(well.trajectory.measured_depth, (std::vector<double>{0, 4, 6}));
  EXPECT_FALSE(well.approximate_path);
  ASSERT_EQ(well.open.size(), 2U) << "2 to 4.5 but for 3 to 3.5";
  EXPECT_EQ(well.open[0].to, 3.0);
  EXPECT_EQ(well.open[1].from, 3.5);
  EXPECT_EQ(well.open[1].to, 4.5);
  EXPECT_EQ(well.radial.bore_radius, 0.1);
  EXPECT_EQ(well.skin, 3.0);
  ASSERT_EQ(well.perforations.size(), 2U);
  EXPECT_FALSE(well.perforations[1].open);
}

TEST(DeckTrajectories, PerforationsByDepthFollowThePath) {
  // Down to depth 2 at 2, level to 4, down to depth 4 at 6: depth 1 to 3 is 1 to 5 along it.
  const std::string rows = "WELTRAJ\n W 1* 0 0 0 0 /\n W 1* 0 0 2 2 /\n W 1* 2 0 2 4 /\n W 1* 2 0 4 6 /\n/\n";
  const Case read = deck(rows + "COMPTRAJ\n W 1* 1 3 TVD /\n W 1* 7 9 TVD /\n W 1* 5.5 7 /\n/\n");
  const Well& well = read.deck_wells[0];
  ASSERT_EQ(well.open.size(), 2U);
  EXPECT_EQ(well.open[0].from, 1.0);
  EXPECT_EQ(well.open[0].to, 5.0);
  EXPECT_EQ(well.open[1].to, 6.0) << "cut at the end of the path";
  EXPECT_TRUE(has_note(read, "(7 to 9 m TVD) is not on its path and is left out"));
  EXPECT_TRUE(has_note(read, "reaches beyond its path and is cut"));
}

TEST(DeckTrajectories, BranchesAreWellsOfTheirOwn) {
  const Case read = deck(
      "WELTRAJ\n W 1* 0 0 0 0 /\n W 1* 0 0 4 4 /\n W 2 0 0 2 2 /\n W 2 3 0 2 5 /\n/\n"
      "COMPTRAJ\n W 1* 1 2 /\n W 2 3 5 /\n/\n");
  ASSERT_EQ(read.deck_wells.size(), 2U);
  EXPECT_EQ(read.deck_wells[1].name, "W:2");
  EXPECT_EQ(read.deck_wells[1].parent, "W");
  EXPECT_EQ(read.deck_wells[1].branch, 2);
  EXPECT_EQ(read.deck_wells[1].trajectory.measured_depth, (std::vector<double>{2, 5}));
  EXPECT_EQ(read.deck_wells[1].open[0].from, 3.0);
}

TEST(DeckTrajectories, AreOpenedByCompdatWithoutComptraj) {
  // Column (2, 3), layers 2 and 3: the path along x 1.5, y 2.5 is in them from depth 1 to 3.
  const Case read = deck("WELTRAJ\n W 1* 1.5 2.5 -1 0 /\n W 1* 1.5 2.5 4 5 /\n/\nCOMPDAT\n W 2* 2 3 /\n/\n");
  const Well& well = read.deck_wells[0];
  ASSERT_EQ(well.open.size(), 1U);
  EXPECT_NEAR(well.open[0].from, 2.0, 1e-12);
  EXPECT_NEAR(well.open[0].to, 4.0, 1e-12);
  EXPECT_EQ(well.completions.size(), 2U);
  EXPECT_TRUE(has_note(read, "no COMPTRAJ"));
}

TEST(DeckTrajectories, LaterOnesReplaceTheirs) {
  const Case read = deck(
      "WELTRAJ\n W 1* 0 0 0 0 /\n W 1* 0 0 4 4 /\n/\nWELTRAJ\n W 1* 1 0 0 0 /\n W 1* 1 0 3 3 /\n/\nWELTRAJ\n W 1* 1 0 "
      "4 4 "
      "/\n/\n");
  EXPECT_EQ(path(read.deck_wells[0]), (std::vector<Vec3>{{1, 0, 0}, {1, 0, 3}, {1, 0, 4}})) << "the third goes on";
  EXPECT_TRUE(has_note(read, "replaces the path of branch 1 of 'W'"));
}

TEST(DeckTrajectories, FaultsAreNamed) {
  expect_error("WELTRAJ\n X 1* 0 0 0 0 /\n/\n", "WELTRAJ", "a well that WELSPECS has named, found 'X'");
  expect_error("WELTRAJ\n W 1* 0 0 0 /\n/\n", "WELTRAJ", "MD as item 6, found a default");
  expect_error("WELTRAJ\n W 1* 0 0 0 5 /\n W 1* 0 0 1 4 /\n/\n", "WELTRAJ", "a measured depth above 5 as item 6");
  expect_error("WELTRAJ\n W 0 0 0 0 5 /\n/\n", "WELTRAJ", "a branch between 1 and 10000 as item 2, found 0");
  expect_error("COMPTRAJ\n W 1* 5 4 /\n/\n", "COMPTRAJ", "a bottom of the perforation below its top");
  expect_error("COMPTRAJ\n W 1* 4 5 SS /\n/\n", "COMPTRAJ", "MD or TVD as item 5, found 'SS'");
  expect_error("COMPTRAJ\n W 1* 4 5 1* 1* AJAR /\n/\n", "COMPTRAJ", "OPEN, SHUT or AUTO as item 7");
  expect_error("COMPTRAJ\n W 1* 4 5 5* -1 /\n/\n", "COMPTRAJ", "a bore diameter of 0 or more as item 10");
  expect_error("WLIST\n L NEW W /\n/\n", "WLIST", "the name of a list, *NAME, as item 1");
  expect_error("WLIST\n '*L' PUT W /\n/\n", "WLIST", "NEW, ADD, DEL or MOV as item 2");
}

const std::string column = "COMPDAT\n W 2* 1 4 /\n/\n";

TEST(DeckSegments, GiveThePathWhereTheyHaveXAndY) {
  const std::string segments =
      "WELSEGS\n W 0 10 1* ABS 2* 1.5 2.5 /\n"
      " 2 3 1 1 12 2 0.1 1e-4 2* 1.5 2.5 /\n 4 4 1 3 14 4 0.1 1e-4 2* 1.5 2.5 /\n/\n"
      "COMPSEGS\n W /\n 2 3 1 1 10 11 /\n 2 3 2 1 11 12 /\n 2 3 4 1 13 14 /\n/\n";
  const Case read = deck(column + segments);
  ASSERT_EQ(read.deck_wells.size(), 1U);
  const Well& well = read.deck_wells[0];
  EXPECT_EQ(path(well), (std::vector<Vec3>{{1.5, 2.5, 0}, {1.5, 2.5, 1}, {1.5, 2.5, 2}, {1.5, 2.5, 4}}))
      << "segments 2 and 3 share the way from 10 to 12";
  EXPECT_EQ(well.trajectory.measured_depth, (std::vector<double>{10, 11, 12, 14}));
  EXPECT_FALSE(well.approximate_path);
  ASSERT_EQ(well.open.size(), 2U);
  EXPECT_EQ(well.open[0].to, 12.0);
  EXPECT_EQ(well.open[1].from, 13.0);
  EXPECT_EQ(well.completions.size(), 3U);
  EXPECT_TRUE(has_note(read, "1 cells of COMPDAT are in no segment"));
}

TEST(DeckSegments, GoThroughTheirCellsWithoutXAndY) {
  const std::string segments =
      "WELSEGS\n W 0 10 1* INC /\n 2 5 1 1 1 1 0.1 1e-4 /\n/\n"
      "COMPSEGS\n W /\n 2 3 1 1 10 11 /\n 2 3 2 1 11 12 /\n 2 3 3 1 12 13 /\n 2 3 4 1 13 14 /\n/\n";
  const Well well = deck(column + segments).deck_wells.at(0);
  EXPECT_TRUE(well.approximate_path);
  EXPECT_EQ(path(well).front(), Vec3(1.5, 2.5, 0));
  EXPECT_EQ(path(well).back(), Vec3(1.5, 2.5, 4));
  EXPECT_EQ(well.trajectory.measured_depth, (std::vector<double>{10, 10.5, 11.5, 12.5, 13.5, 14}));
  ASSERT_EQ(well.open.size(), 1U);
  EXPECT_EQ(well.open[0].to, 14.0);
}

TEST(DeckSegments, BranchesAreWellsOfTheirOwn) {
  const std::string schedule =
      "COMPDAT\n W 2 3 1 4 /\n W 3 3 4 4 3* 0.2 3* X /\n W 4 3 4 4 3* 0.2 3* X /\n/\n"
      "WELSEGS\n W 0 10 1* INC /\n 2 5 1 1 1 1 0.1 1e-4 /\n 6 7 2 5 1 0 0.1 1e-4 /\n/\n"
      "COMPSEGS\n W /\n 2 3 1 1 10 11 /\n 2 3 2 1 11 12 /\n 2 3 3 1 12 13 /\n 2 3 4 1 13 14 /\n"
      " 3 3 4 2 14.5 15.5 /\n 4 3 4 2 15.5 16.5 /\n/\n";
  const Case read = deck(schedule);
  ASSERT_EQ(read.deck_wells.size(), 2U);
  EXPECT_EQ(read.deck_wells[1].name, "W:2");
  EXPECT_EQ(path(read.deck_wells[1]),
            (std::vector<Vec3>{{2, 2.5, 3.5}, {2.5, 2.5, 3.5}, {3.5, 2.5, 3.5}, {4, 2.5, 3.5}}));
  EXPECT_EQ(read.deck_wells[1].trajectory.measured_depth, (std::vector<double>{14.5, 15, 16, 16.5}));
  EXPECT_EQ(read.deck_wells[0].completions.size(), 4U);
}

TEST(DeckSegments, DevicesAlongOneBoreAreNoBranches) {
  const std::string segments =
      "WELSEGS\n W 0 10 1* INC /\n 2 5 1 1 1 1 0.1 1e-4 /\n 6 6 2 3 0.1 0 /\n 7 7 3 4 0.1 0 /\n 8 8 4 5 0.1 0 /\n/\n"
      "COMPSEGS\n W /\n 2 3 1 2 10 11 /\n 2 3 2 3 11 12 /\n 2 3 3 4 12 13 /\n/\n";
  const Case read = deck(column + segments);
  ASSERT_EQ(read.deck_wells.size(), 1U);
  EXPECT_EQ(read.deck_wells[0].completions.size(), 3U);
  EXPECT_TRUE(has_note(read, "taken as devices along one bore"));
}

TEST(DeckSegments, RangesOfCellsTakeArcLength) {
  const Case read = deck(column + "COMPSEGS\n W /\n 2 3 1 1 2* Z 4 /\n/\n");
  EXPECT_EQ(read.deck_wells[0].completions.size(), 4U);
  EXPECT_TRUE(has_note(read, "arc length is taken"));
}

TEST(DeckSegments, FaultsAreNamed) {
  expect_error("WELSEGS\n X 0 0 1* INC /\n/\n", "WELSEGS", "a well that WELSPECS has named");
  expect_error("WELSEGS\n W 0 0 1* FOO /\n/\n", "WELSEGS", "INC or ABS as item 5, found 'FOO'");
  expect_error("WELSEGS\n W 0 0 1* INC /\n 2 2 1 7 1 1 /\n/\n", "WELSEGS", "an outlet segment that was defined before");
  expect_error("WELSEGS\n W 0 0 1* INC /\n 3 2 1 1 1 1 /\n/\n", "WELSEGS", "segments from 2 on");
  expect_error("COMPSEGS\n W /\n 9 1 1 1 0 1 /\n/\n", "COMPSEGS", "I between 1 and 4 as item 1, found 9");
  expect_error("COMPSEGS\n W /\n 1 1 1 1 2 1 /\n/\n", "COMPSEGS", "an end below the start, items 5 and 6");
  expect_error("COMPSEGS\n W /\n 1 1 1 1 2* U 3 /\n/\n", "COMPSEGS", "X, Y, Z, I, J or K as item 7");
}

TEST(DeckWells, SampleHasEveryKindOfPath) {
  const Case read = read_case(std::string(WELLKNIT_TESTDATA) + "/grdecl/laterals.DATA");
  ASSERT_EQ(read.deck_wells.size(), 5U);
  const auto named = [&](const std::string& name) {
    return *std::find_if(read.deck_wells.begin(), read.deck_wells.end(), [&](const Well& w) { return w.name == name; });
  };
  // 1010 to 1030 without 1012 to 1014, where the path is vertical from depth 0 at 0.
  EXPECT_EQ(named("T").open.size(), 2U);
  EXPECT_EQ(named("T").open[1].from, 1014.0);
  EXPECT_EQ(named("T:2").trajectory.points.back(), Vec3(350, 50, 1005));
  EXPECT_FALSE(named("S").approximate_path);
  EXPECT_EQ(named("S").trajectory.points.back(), Vec3(150, 150, 1030));
  EXPECT_EQ(named("S").trajectory.measured_depth, (std::vector<double>{1050, 1060, 1070, 1080}));
  EXPECT_TRUE(named("S:2").approximate_path);
  // From the face of the first cell at x 200 to the face of the last at 400, in the middle of layer 2.
  EXPECT_EQ(named("S:2").trajectory.points.front(), Vec3(200, 150, 1015));
  EXPECT_EQ(named("S:2").trajectory.points.back(), Vec3(400, 150, 1015));
  EXPECT_EQ(named("S:2").open[0].to, 1320.0);
  EXPECT_TRUE(named("C").approximate_path);
}

/// Either wells with whole paths, or one line.
void read_damaged(const std::string& text) {
  DeckLimits limits;
  limits.free_values = 100'000;
  limits.free_steps = 1'000'000;
  MemoryFiles files({{"case", text}});
  try {
    const Case read = parse_case(files, "case", {}, limits);
    for (const Well& well : read.deck_wells) {
      ASSERT_GE(well.trajectory.points.size(), 2U);
      ASSERT_EQ(well.trajectory.points.size(), well.trajectory.measured_depth.size());
      ASSERT_FALSE(well.open.empty());
      for (std::size_t n = 1; n < well.trajectory.points.size(); ++n)
        ASSERT_GT(well.trajectory.measured_depth[n], well.trajectory.measured_depth[n - 1]);
    }
  } catch (const ParseError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

TEST(DeckWells, DamageIsAnErrorOrValidWells) {
  const std::string text(load_file(std::string(WELLKNIT_TESTDATA) + "/grdecl/laterals.DATA").text);
  for (std::size_t n = 0; n < 200; ++n) read_damaged(text.substr(0, text.size() * n / 200));
  const auto seed = random_seed();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (int n = 0; n < 1000; ++n) {
    std::string damaged = text;
    damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
    read_damaged(damaged);
  }
}

}  // namespace
}  // namespace wellknit
