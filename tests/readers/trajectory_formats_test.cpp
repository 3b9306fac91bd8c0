// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// One sample of each kind of trajectory file, with the places it must give.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "readers/parse_trajectory.h"
#include "readers/read_trajectory.h"
#include "tests/readers/reader_helpers.h"

namespace wellknit {
namespace {

const std::string folder = std::string(WELLKNIT_TESTDATA) + "/wells/";
constexpr double pi = std::numbers::pi;
constexpr double thousand_feet = 304.8;  // m
const TrajectoryOptions head_of_survey{{1000.0, 2000.0, 25.0}, false};

void expect_near(const Vec3& found, const Vec3& expected) {
  EXPECT_LT((found - expected).norm(), 1e-9) << found.transpose() << " for " << expected.transpose();
}

bool has_note(const TrajectoryFile& file, const std::string& part) {
  return std::any_of(file.notes.begin(), file.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

TEST(TrajectoryFormats, CsvSurveyWithBranchesAndFeet) {
  const TrajectoryFile file = read_trajectory(folder + "survey.csv");
  ASSERT_EQ(file.wells.size(), 2U);
  const Well& main = file.wells[0];
  EXPECT_EQ(main.name, "A-1");
  EXPECT_EQ(main.parent, "");
  EXPECT_EQ(main.branch, 1);
  // Head (1000, 2000), datum 25 above; 1000 ft down, then a quarter circle to the east over 1000 ft.
  const double radius = thousand_feet / (pi / 2);
  expect_near(main.trajectory.points.front(), {1000, 2000, -25});
  expect_near(main.trajectory.points.back(), {1000 + radius, 2000, -25 + thousand_feet + radius});
  EXPECT_NEAR(main.trajectory.measured_depth.back(), 2 * thousand_feet, 1e-9);
  const Well& branch = file.wells[1];
  EXPECT_EQ(branch.name, "A-1:2");
  EXPECT_EQ(branch.parent, "A-1");
  EXPECT_EQ(branch.branch, 2);
  // A sixth of a circle to the west.
  const double wide = thousand_feet / (pi / 3);
  expect_near(branch.trajectory.points.back(), {1000 - wide / 2, 2000, -25 + thousand_feet + wide * std::sqrt(0.75)});
}

TEST(TrajectoryFormats, CsvWithDecimalCommaAndUnitsRow) {
  const TrajectoryFile file = read_trajectory(folder + "comma.csv");
  ASSERT_EQ(file.wells.size(), 1U);
  expect_near(file.wells[0].trajectory.points[2], {1030.25, 2040, 1150.5});
  EXPECT_EQ(file.wells[0].trajectory.measured_depth[1], 1125.5);
  EXPECT_TRUE(has_note(file, "comma.csv:3: the comma in its numbers is taken as decimal"));
}

TEST(TrajectoryFormats, ResInsightJson) {
  const TrajectoryFile file = read_trajectory(folder + "two.json");
  ASSERT_EQ(file.wells.size(), 2U);
  EXPECT_EQ(file.wells[0].name, "P-1");
  // tvd is measured from a datum 25 m above the zero of depth.
  EXPECT_EQ(file.wells[0].trajectory.points, (std::vector<Vec3>{{100, 200, 1000}, {100, 200, 1100}, {130, 240, 1100}}));
  EXPECT_TRUE(has_note(file, "well P-1: TVD is measured from the datum: 25 m are taken off"));
  EXPECT_EQ(file.wells[1].trajectory.points[0], Vec3(500, 200, 1000));
}

TEST(TrajectoryFormats, PetrelTrace) {
  const TrajectoryFile file = read_trajectory(folder + "trace.dev");
  ASSERT_EQ(file.wells.size(), 1U);
  EXPECT_EQ(file.wells[0].name, "B-2 H");
  EXPECT_EQ(file.wells[0].trajectory.points,
            (std::vector<Vec3>{{1000, 2000, -25}, {1000, 2000, 975}, {1030, 2000, 1015}, {1070, 2030, 1015}}));
  EXPECT_EQ(file.wells[0].trajectory.measured_depth, (std::vector<double>{0, 1000, 1050, 1100}));
  EXPECT_TRUE(file.notes.empty());
}

TEST(TrajectoryFormats, LasDeviationInFeetOverWrappedLines) {
  const TrajectoryFile file = read_trajectory(folder + "deviation.las");
  ASSERT_EQ(file.wells.size(), 1U);
  EXPECT_EQ(file.wells[0].name, "C-3");
  // Datum 100 ft = 30.48 m; an eighth of a circle to the east over 1000 ft, then 1000 ft straight at 45 degrees.
  const double radius = thousand_feet / (pi / 4);
  const double slope = std::sqrt(0.5);
  expect_near(file.wells[0].trajectory.points.back(), {1000 + radius * (1 - slope) + thousand_feet * slope, 2000,
                                                       -30.48 + thousand_feet + (radius + thousand_feet) * slope});
  EXPECT_TRUE(has_note(file, "well C-3: 1 rows with undefined values (-999.25) are dropped"));
}

TEST(TrajectoryFormats, Witsml21Survey) {
  const TrajectoryFile file = read_trajectory(folder + "survey21.xml", head_of_survey);
  ASSERT_EQ(file.wells.size(), 1U);
  EXPECT_EQ(file.wells[0].name, "D-4");
  // From 1000 m to 4500 ft = 1371.6 m a sixth of a circle to the south.
  const double radius = 371.6 / (pi / 3);
  expect_near(file.wells[0].trajectory.points.back(), {1000, 2000 - radius / 2, -25 + 1000 + radius * std::sqrt(0.75)});
  EXPECT_TRUE(has_note(file, "survey21.xml:2: well D-4: its azimuths refer to 'true north'"));
}

TEST(TrajectoryFormats, Witsml1411WithOffsets) {
  const TrajectoryFile file = read_trajectory(folder + "survey1411.xml", head_of_survey);
  ASSERT_EQ(file.wells.size(), 1U);
  EXPECT_EQ(file.wells[0].name, "E-5 A");
  EXPECT_EQ(file.wells[0].trajectory.points,
            (std::vector<Vec3>{{1000, 2000, -25}, {1000, 2000, 975}, {1030, 2000, 1075}}));
}

TEST(TrajectoryFormats, StackedRmsWellsFillInMeasuredDepth) {
  const TrajectoryFile file = read_trajectory(folder + "stacked.rmswell");
  ASSERT_EQ(file.wells.size(), 2U);
  EXPECT_EQ(file.wells[0].name, "F 1");
  EXPECT_EQ(file.wells[0].trajectory.measured_depth, (std::vector<double>{1025, 1035, 1045}));
  ASSERT_EQ(file.wells[0].open.size(), 1U);
  EXPECT_EQ(file.wells[0].open[0].to, 1040.0) << "halfway to the shut station";
  EXPECT_EQ(file.wells[1].name, "F-2");
  EXPECT_EQ(file.wells[1].trajectory.measured_depth, (std::vector<double>{0, 40}));
  EXPECT_TRUE(has_note(file, "its measured depth is undefined at 1 of 3 stations"));
  EXPECT_TRUE(has_note(file, "1 stations have no place"));
}

TEST(TrajectoryFormats, DevWithHeadingAndTypographicQuotes) {
  const TrajectoryFile file = read_trajectory(folder + "heading.dev");
  ASSERT_EQ(file.wells.size(), 2U);
  EXPECT_EQ(file.wells[0].name, "Well_1");
  EXPECT_EQ(file.wells[1].name, "WELL 2");
}

Well survey_well(const std::string& text, const TrajectoryOptions& options = {}) {
  return parse_trajectory(text, "w.csv", options).wells.at(0);
}

TEST(TrajectoryHead, ComesFromCommentColumnsOrOptions) {
  const std::string rows = "MD,INC,AZI\n0,0,0\n100,0,0\n";
  const Vec3 head(10, 20, -5);
  EXPECT_EQ(survey_well("# head 10 20 5\n" + rows).trajectory.points[0], head);
  EXPECT_EQ(survey_well("# HEAD X=10, Y=20, KB=5\n" + rows).trajectory.points[0], head);
  EXPECT_EQ(survey_well("# head: other 0 0 0\n# head w 10 20 5 m\n" + rows).trajectory.points[0], head);
  EXPECT_EQ(survey_well("MD,INC,AZI,HEAD_X,HEAD_Y,KB\n0,0,0,10,20,5\n9,0,0,10,20,5\n").trajectory.points[0], head);
  EXPECT_EQ(survey_well(rows, {{10.0, 20.0, 5.0}, false}).trajectory.points[0], head);
  EXPECT_EQ(survey_well("# head 0 0 0\n" + rows, {{10.0, 20.0, 5.0}, false}).trajectory.points[0], head)
      << "the options go first";
  EXPECT_EQ(survey_well("# head 1000 2000 100 ft\n" + rows).trajectory.points[0], Vec3(304.8, 609.6, -30.48));
}

TEST(TrajectoryHead, MayBeMissingWhenItIsOnlyLookedAt) {
  const TrajectoryFile file = parse_trajectory("MD,INC,AZI\n0,0,0\n100,0,0\n", "w.csv", {{}, true});
  EXPECT_EQ(file.wells[0].trajectory.points[1], Vec3(0, 0, 100));
  EXPECT_TRUE(has_note(file, "no head is given"));
}

TEST(TrajectoryDatum, TurnsTvdIntoDepthAndLeavesTvdssAlone) {
  EXPECT_EQ(survey_well("# head 0 0 25\nX,Y,TVD\n0,0,100\n0,0,200\n").trajectory.points[0].z(), 75.0);
  EXPECT_EQ(survey_well("# head 0 0 25\nX,Y,TVDSS\n0,0,100\n0,0,200\n").trajectory.points[0].z(), 100.0);
  EXPECT_EQ(survey_well("X,Y,TVD\n0,0,100\n0,0,200\n").trajectory.points[0].z(), 100.0) << "no datum is known";
  EXPECT_EQ(survey_well("X,Y,Z\n0,0,25\n0,0,-200\n").trajectory.points[1].z(), 200.0) << "elevation from the rig down";
}

TEST(TrajectorySurvey, LateStartAndRepeatedStationsAreNoted) {
  const std::string head = "# head 0 0 0\nMD,INC,AZI\n";
  const TrajectoryFile late = parse_trajectory(head + "100,0,0\n200,0,0\n", "w.csv");
  EXPECT_EQ(late.wells[0].trajectory.points.back(), Vec3(0, 0, 200));
  EXPECT_TRUE(has_note(late, "its survey begins at 100 m"));
  const TrajectoryFile twice = parse_trajectory(head + "0,0,0\n100,0,0\n100,1,5\n200,0,0\n", "w.csv");
  EXPECT_EQ(twice.wells[0].trajectory.points.size(), 3U);
  EXPECT_TRUE(has_note(twice, "w.csv:5: well w: 1 repeated stations dropped"));
  const TrajectoryFile turned = parse_trajectory(head + "200,0,0\n100,0,0\n0,0,0\n", "w.csv");
  EXPECT_EQ(turned.wells[0].trajectory.points.back(), Vec3(0, 0, 200));
  EXPECT_TRUE(has_note(turned, "turned"));
}

TEST(TrajectoryStations, TieInsOfOneMeasuredDepthAreOne) {
  const TrajectoryFile file = parse_trajectory("MD,X,Y,TVD\n0,0,0,0\n9,0,0,9\n9,0,0.01,9\n20,0,0,20\n", "w.csv");
  EXPECT_EQ(file.wells[0].trajectory.points.size(), 3U);
  EXPECT_TRUE(has_note(file, "1 repeated stations dropped"));
}

TEST(TrajectoryCsvWells, RowsOfOneWellMayStandApart) {
  const TrajectoryFile file = parse_trajectory("WELL,X,Y,TVD\nA,0,0,0\nB,5,0,0\nA,0,0,1\nB,5,0,2\n", "w.csv");
  ASSERT_EQ(file.wells.size(), 2U);
  EXPECT_EQ(file.wells[1].trajectory.points[1], Vec3(5, 0, 2));
}

TEST(TrajectoryCsvUnits, OneUnitServesTheColumnsWithoutOne) {
  const TrajectoryFile file = parse_trajectory("MD[ft],X,Y,TVD\n0,0,0,0\n1000,0,0,1000\n", "w.csv");
  EXPECT_NEAR(file.wells[0].trajectory.points[1].z(), 304.8, 1e-9);
  EXPECT_TRUE(has_note(file, "w.csv:1: columns without a unit are taken in FT, as the others"));
}

}  // namespace
}  // namespace wellknit
