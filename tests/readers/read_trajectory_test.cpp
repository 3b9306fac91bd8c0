// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_trajectory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "readers/file_content.h"
#include "readers/parse_trajectory.h"
#include "tests/readers/reader_helpers.h"

namespace wellknit {
namespace {

const std::string folder = std::string(WELLKNIT_TESTDATA) + "/wells/";

Well one_well(const std::string& text, const std::string& path = "w.csv") {
  TrajectoryFile file = parse_trajectory(text, path);
  EXPECT_EQ(file.wells.size(), 1U);
  return file.wells.at(0);
}

std::vector<std::string> notes_of(const std::string& text, const std::string& path = "w.csv") {
  return parse_trajectory(text, path).notes;
}

void expect_error(const std::string& text, const std::string& path, std::int64_t line, const std::string& keyword,
                  const std::string& expected) {
  const auto error = error_of([&] { return parse_trajectory(text, path); });
  ASSERT_TRUE(error) << text;
  EXPECT_EQ(error->where().file, path);
  EXPECT_EQ(error->where().line, line) << error->what();
  EXPECT_EQ(error->where().keyword, keyword) << error->what();
  EXPECT_NE(std::string(error->what()).find(expected), std::string::npos) << error->what();
}

TEST(ReadTrajectory, ReadsCsv) {
  const TrajectoryFile file = read_trajectory(folder + "curved.csv");
  ASSERT_EQ(file.wells.size(), 1U);
  EXPECT_EQ(file.wells[0].name, "curved");
  EXPECT_EQ(file.wells[0].trajectory.measured_depth, (std::vector<double>{0, 50, 91, 133}));
  EXPECT_EQ(file.wells[0].trajectory.points[2], Vec3(107, 206, 1090));
  EXPECT_TRUE(file.wells[0].open.empty());
  EXPECT_FALSE(file.wells[0].approximate_path);
  EXPECT_TRUE(file.notes.empty());
}

TEST(ReadTrajectory, ReadsSeveralDevWells) {
  const TrajectoryFile file = read_trajectory(folder + "two.dev");
  ASSERT_EQ(file.wells.size(), 2U);
  EXPECT_EQ(file.wells[0].name, "P 1");
  EXPECT_EQ(file.wells[0].trajectory.points[2], Vec3(50, 0, 1180));
  EXPECT_EQ(file.wells[1].name, "I1");
  EXPECT_EQ(file.wells[1].trajectory.measured_depth, (std::vector<double>{0, 200}));
}

TEST(ReadTrajectory, ReadsRmsWellsWithPerforations) {
  const TrajectoryFile file = read_trajectory(folder + "logged.rmswell");
  ASSERT_EQ(file.wells.size(), 1U);
  const Well& well = file.wells[0];
  EXPECT_EQ(well.name, "W-1");
  EXPECT_EQ(well.trajectory.measured_depth, (std::vector<double>{1025, 1035, 1045, 1055}));
  // Open from halfway between 1025 and 1035 to halfway between 1045 and 1055.
  ASSERT_EQ(well.open.size(), 1U);
  EXPECT_EQ(well.open[0].from, 1030.0);
  EXPECT_EQ(well.open[0].to, 1050.0);
}

TEST(ReadTrajectory, TakesAnyLineEnd) {
  for (const char* name : {"curved.csv", "two.dev", "logged.rmswell"}) {
    const std::string text(load_file(folder + name).text);
    std::string windows;
    std::string old_mac = text;
    for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
    const auto points = parse_trajectory(text, name).wells.at(0).trajectory.points;
    EXPECT_EQ(parse_trajectory(windows, name).wells.at(0).trajectory.points, points) << name;
    EXPECT_EQ(parse_trajectory(old_mac, name).wells.at(0).trajectory.points, points) << name;
    EXPECT_EQ(parse_trajectory(text.substr(0, text.size() - 1), name).wells.at(0).trajectory.points, points) << name;
  }
}

TEST(ReadTrajectory, EveryTruncationIsAnErrorOrAValidWell) {
  for (const char* name : {"curved.csv", "two.dev", "logged.rmswell"}) {
    const std::string text(load_file(folder + name).text);
    for (std::size_t size = 0; size < text.size(); ++size) {
      try {
        for (const Well& well : parse_trajectory(text.substr(0, size), name).wells)
          EXPECT_GE(well.trajectory.points.size(), 2U);
      } catch (const ParseError& error) {
        EXPECT_EQ(error.where().file, name);
      }
    }
  }
}

TEST(ReadTrajectory, ExtensionInAnyCaseAndContentDecide) {
  EXPECT_EQ(one_well("MD,X,Y,TVD\n0,0,0,0\n1,0,0,1\n", "a/W.1.DEV").name, "W.1") << "content first";
  EXPECT_EQ(one_well("\n0 0 0 0\n0 0 1 1\n", "well.txt").name, "well");
}

TEST(TrajectoryCsv, TakesColumnsInAnyOrderAndForm) {
  const Well well = one_well("# survey\n\"tvd (m)\"; Y ;easting[m];Inc;md\n10;2;1;0;0\n20;2;1;0;10\n");
  EXPECT_EQ(well.trajectory.points[1], Vec3(1, 2, 20));
  EXPECT_EQ(one_well("MD\tX\tY\tTVD\n0\t1\t2\t3\n1\t1\t2\t4\n").trajectory.points[0], Vec3(1, 2, 3));
}

TEST(TrajectoryCsv, TakesArcLengthWithoutMd) {
  const std::string text = "X,Y,TVD\n0,0,0\n3,0,4\n3,0,10\n";
  EXPECT_EQ(one_well(text).trajectory.measured_depth, (std::vector<double>{0, 5, 11})) << "sqrt(9 + 16) and 6 more";
  EXPECT_EQ(notes_of(text), (std::vector<std::string>{"w.csv: no column MD: arc length is taken"}));
}

TEST(TrajectoryCsv, ReadsSeveralWells) {
  const TrajectoryFile file =
      parse_trajectory("WELL,MD,X,Y,TVD\nA,0,0,0,0\nA,1,0,0,1\nB,0,5,0,0\nB,2,5,0,2\n", "w.csv");
  ASSERT_EQ(file.wells.size(), 2U);
  EXPECT_EQ(file.wells[1].name, "B");
  EXPECT_EQ(file.wells[1].trajectory.points[1], Vec3(5, 0, 2));
}

TEST(TrajectoryCsv, TurnsElevationIntoDepth) {
  const std::string text = "MD,X,Y,Z\n0,0,0,-100\n10,0,0,-110\n";
  EXPECT_EQ(one_well(text).trajectory.points[1], Vec3(0, 0, 110));
  EXPECT_EQ(notes_of(text).size(), 1U);
}

TEST(TrajectoryCsv, FaultsAreNamed) {
  expect_error("", "w.csv", 0, "header", "an empty file");
  expect_error("MD,X,Y,TVD\n", "w.csv", 1, "", "two or more different stations of well w, found none");
  expect_error("MD,X,Y,TVD\n0,0,0,0\n", "w.csv", 1, "", "found one; a path needs a start and an end");
  expect_error("MD,X,Y,TVD\n0,0,0,0\n1,0,0,x\n", "w.csv", 3, "TVD", "expected a number, found 'x'");
  expect_error("MD,X,Y,TVD\n0,0,0,0\n1,0,0\n", "w.csv", 3, "row", "expected 4 fields as in the header, found 3");
  expect_error("MD,X,Y,TVD\n0,0,0,0\n1,,0,1\n", "w.csv", 3, "X", "found nothing");
  expect_error("MD,X,Y\n0,0,0\n", "w.csv", 1, "header", "a header naming the columns");
  expect_error("MD(fathom),X,Y,TVD\n0,0,0,0\n", "w.csv", 1, "header",
               "expected metres or feet, found the unit 'FATHOM'");
  expect_error("MD,X,Y,TVD\n0,0,0,0\n1,1e300,0,1\n", "w.csv", 3, "X", "a length in metres");
}

TEST(Stations, RepeatedOnesAreDroppedWithANote) {
  const std::string text = "MD,X,Y,TVD\n0,0,0,0\n5,0,0,5\n5,0,0,5\n6,0,0,5\n9,0,0,9\n";
  EXPECT_EQ(one_well(text).trajectory.measured_depth, (std::vector<double>{0, 5, 9}));
  EXPECT_EQ(notes_of(text), (std::vector<std::string>{"w.csv:4: well w: 2 repeated stations dropped"}));
}

TEST(Stations, PathWrittenFromItsEndIsTurned) {
  const std::string text = "MD,X,Y,TVD\n9,0,0,9\n5,0,0,5\n0,0,0,0\n";
  EXPECT_EQ(one_well(text).trajectory.measured_depth, (std::vector<double>{0, 5, 9}));
  EXPECT_EQ(notes_of(text), (std::vector<std::string>{"w.csv:1: well w: written from its end; turned"}));
}

TEST(Stations, MeasuredDepthThatFallsIsRefused) {
  expect_error("MD,X,Y,TVD\n0,0,0,0\n9,0,0,9\n8,0,0,12\n10,0,0,13\n", "w.csv", 4, "MD",
               "a measured depth above 9, found 8");
  expect_error("MD,X,Y,TVD\n0,0,0,0\n9,0,0,9\n9,0,0,12\n", "w.csv", 4, "MD", "a measured depth above 9, found 9");
}

TEST(Stations, MeasuredDepthInAnotherUnitIsNoted) {
  const auto notes = notes_of("MD,X,Y,TVD\n0,0,0,0\n328,0,0,100\n");
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("328 m over a path of 100 m; check the units"), std::string::npos);
}

TEST(DevWells, TakeEveryKindOfNameLine) {
  const std::string rows = "\n0 0 0 0\n0 0 1 1\n";
  EXPECT_EQ(one_well("name A B\t\t" + rows, "w.dev").name, "A B");
  EXPECT_EQ(one_well("WELLNAME: 'A B'" + rows, "w.dev").name, "A B");
  EXPECT_EQ(one_well("WellName 'A B'" + rows, "w.dev").name, "A B");
  EXPECT_EQ(one_well("'A B'" + rows, "w.dev").name, "A B");
  EXPECT_EQ(one_well("Bare" + rows, "w.dev").name, "Bare");
  EXPECT_EQ(one_well("-- comment" + rows, "x/w.dev").name, "w");
}

TEST(DevWells, NumberTheUnnamed) {
  const TrajectoryFile file = parse_trajectory("0 0 0 0\n0 0 1 1\n-999\n5 0 0 0\n5 0 1 1\n-999\n", "w.dev");
  ASSERT_EQ(file.wells.size(), 2U);
  EXPECT_EQ(file.wells[0].name, "w");
  EXPECT_EQ(file.wells[1].name, "w_2");
}

TEST(DevWells, FaultsAreNamed) {
  expect_error("name A\n", "w.dev", 1, "", "two or more different stations of well A");
  expect_error("name A\n0 0 0 0\n-999\n", "w.dev", 1, "", "found one");
  expect_error("name A\n0 0 0 0\nx 0 1 1\n", "w.dev", 3, "X", "expected a number, found 'x'");
  expect_error("name A\n0 0 0 0\n0 0 1m 1\n", "w.dev", 3, "TVD", "found '1m'");
  expect_error("name A\n0 0 0 0\n0 0 1\n", "w.dev", 3, "row", "4 numbers: X Y TVD MD, found 3");
  expect_error("name A\n-999\n", "w.dev", 1, "", "found none");
  expect_error("0 0 0 0\n0 0 1 1\n-999\n-999\n", "w.dev", 4, "-999", "found none");
  expect_error("", "w.dev", 0, "", "rows X Y TVD MD");
}

const std::string rms_header = "1.0\nPlanned\nW 0 0 25\n";

TEST(RmsWells, TakeArcLengthWithoutAnMdLog) {
  const Well well = one_well(rms_header + "1\nPoro UNK lin\n0 0 0 -999\n3 0 4 0.2\n3 0 4 0.2\n3 0 14 0.2\n", "w.w");
  EXPECT_EQ(well.trajectory.measured_depth, (std::vector<double>{0, 5, 15}));
}

TEST(RmsWells, FillInTheMdLogWhereItIsUndefined) {
  const std::string text = rms_header + "1\nM_MDEPTH CONT lin\n0 0 0 -999\n0 0 4 1004\n0 0 5 -999\n";
  EXPECT_EQ(one_well(text, "w.w").trajectory.measured_depth, (std::vector<double>{1000, 1004, 1005}));
  EXPECT_EQ(notes_of(text, "w.w").size(), 1U);
  const std::string undefined = rms_header + "1\nM_MDEPTH CONT lin\n0 0 0 -999\n0 0 4 -999\n";
  EXPECT_EQ(one_well(undefined, "w.w").trajectory.measured_depth, (std::vector<double>{0, 4})) << "arc length";
}

TEST(RmsWells, FaultsAreNamed) {
  expect_error("1.0\nPlanned\nW 0 0\n", "w.w", 4, "header", "expected the number of logs, found the end of the file");
  expect_error(rms_header + "-1\n", "w.w", 4, "header", "the number of logs, 0 to 10000");
  expect_error(rms_header + "99999999999\n", "w.w", 4, "header", "the number of logs");
  expect_error(rms_header + "2\nPoro UNK lin\n", "w.w", 6, "header", "one more log");
  expect_error(rms_header + "0\n0 0 0\n0 0 y\n", "w.w", 6, "depth", "expected a number, found 'y'");
  expect_error(rms_header + "0\n0 0 0\n0 0 1 5\n", "w.w", 6, "row", "expected 3 numbers");
  expect_error(rms_header + "0\n0 0 0\n", "w.w", 3, "", "found one");
  expect_error("text\n", "w.w", 1, "header", "the version, 1.0");
}

TEST(ReadTrajectory, RefusesOtherFiles) {
  expect_error("SPECGRID\n 1 1 1 /\n", "w.grdecl", 0, "", "found a file in the format GRDECL");
  expect_error("%!\n", "w.xyz", 0, "", "none that is known");
}

}  // namespace
}  // namespace wellknit
