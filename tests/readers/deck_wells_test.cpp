// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/deck_wells.h"

#include <gtest/gtest.h>

#include "model/units.h"
#include "tests/readers/reader_helpers.h"

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

TEST(DeckWells, TrajectoryKeywordsAreNotedOnce) {
  const Case read = deck("WELTRAJ\n W 1* 0 0 0 0 /\n W 1* 0 0 4 4 /\n/\nWELTRAJ\n/\nCOMPDAT\n W 2* 1 1 /\n/\n");
  EXPECT_EQ(read.deck_wells.size(), 1U);
  ASSERT_EQ(read.notes.size(), 3U);
  EXPECT_NE(read.notes[0].find("WELTRAJ is not read yet"), std::string::npos);
}

}  // namespace
}  // namespace wellknit
