// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Broken well files, each with the line of error that it must end in; and damage at random.
#include <gtest/gtest.h>

#include <iostream>
#include <random>

#include "readers/describe.h"
#include "readers/file_content.h"
#include "readers/parse_trajectory.h"
#include "tests/readers/reader_helpers.h"
#include "tests/support/random_seed.h"

namespace wellknit {
namespace {

struct Broken {
  const char* path;
  std::string text;
  const char* message;
};

const std::string las_start = "~V\nVERS. 2.0 :\nWRAP. NO :\n~W\nNULL. -999.25 :\n";
const std::string las_curves = "~C\nDEPT.M :\nDEVI.DEG :\nAZIM.DEG :\n";
const std::string petrel_start = "# WELL TRACE FROM PETREL\n# WELL NAME: A\n";
const std::string xml_start = "<?xml version=\"1.0\"?>\n<Trajectory xmlns=\"witsml\">\n";

std::string station(const std::string& md, const std::string& incl, const std::string& uom = "m") {
  return "<TrajectoryStation>\n<Md uom=\"" + uom + "\">" + md + "</Md><Incl uom=\"dega\">" + incl +
         "</Incl><Azi uom=\"dega\">0</Azi></TrajectoryStation>\n";
}

const std::vector<Broken>& broken_files() {
  static const std::vector<Broken> all{
      // CSV
      {"w.csv", "MD,INC,AZI\n0,0,0\n9,0,0\n",
       "w.csv:1: head: expected the head of well w, found no x and y and the datum (KB); add a line '# head X Y KB' "
       "(metres), or give x=, y= and kb= with --well"},
      {"w.csv", "# head 1 2\nMD,INC,AZI\n0,0,0\n",
       "w.csv:1: head: expected '# head X Y KB' with three numbers, found 2 of them; give x and y of the head and the "
       "elevation of the datum"},
      {"w.csv", "# head 0 0 0\nMD,INC,AZI\n0,0,0\n9,190,0\n",
       "w.csv:4: INC: expected an inclination of 0 to 180 degrees, found 190"},
      {"w.csv", "# head 0 0 0\nMD,INC,AZI\n0,0,0\n9,179,0\n",
       "w.csv:4: INC: expected a turn of at most 120 degrees since the station before, found 179.0; check inclination "
       "and azimuth, and their units"},
      {"w.csv", "# head 0 0 0\nMD,INC,AZI\n0,0,0\n9,0,0\n5,0,0\n20,0,0\n",
       "w.csv:5: MD: expected a measured depth above 9, found 5; the measured depth of well w falls: correct the "
       "station"},
      {"w.csv", "MD;X;Y;TVD\n0;0;0;1,000\n9;0;0;1,009\n",
       "w.csv:2: row: expected numbers with a decimal point, found a comma in a number that may be decimal or between "
       "thousands; write the numbers with a point and without commas"},
      {"w.csv", "MD;X;Y;TVD\n0;0.5;0;0\n9;0;0;9,5\n",
       "w.csv:3: row: expected numbers with a decimal point, found a comma in a number that may be decimal or between "
       "thousands; write the numbers with a point and without commas"},
      {"w.csv", "MD (km),X,Y,TVD\n0,0,0,0\n",
       "w.csv:1: header: expected metres or feet, found the unit 'KM'; convert the column"},
      {"w.csv", "# head 0 0 0\nMD,INC (gon),AZI\n0,0,0\n",
       "w.csv:2: header: expected degrees or radians, found the unit 'GON'; convert the column"},
      {"w.csv", "WELL,MD,X,Y,TVD\n,0,0,0,0\n", "w.csv:2: WELL: expected the name of a well, found nothing"},
      {"w.csv", "MD,X,Y,TVD\n0,0,0,nan\n", "w.csv:2: TVD: expected a number, found 'nan'"},
      {"w.csv", "MD,X,Y,TVD\n5,1,2,3\n",
       "w.csv:1: expected two or more different stations of well w, found one; a path needs a start and an end"},
      // ResInsight .dev
      {"w.dev", "MD X Y TVD\nname A\n0 0 0 0\n",
       "w.dev:1: header: expected the columns X Y TVD MD, found another order; reorder the columns, or write the file "
       "as CSV"},
      {"w.dev", "name A\n0 0 0 0\n0 0 9 9 9\n", "w.dev:3: row: expected 4 numbers: X Y TVD MD, found 5"},
      // RMS
      {"w.w", "1.0\nPlanned\nW\n0\n", "w.w:3: header: expected the well's name, X and Y, found 1 fields"},
      {"w.w", "1.0\nPlanned\nW 0 0\n1\nMD CONT lin\n0 0 0\n",
       "w.w:6: row: expected 4 numbers: X Y depth and 1 logs, found 3; check the number of logs in the header"},
      {"w.w", "1.0\nP\nA 0 0\n0\n0 0 0\n0 0 1\n1.0\nP\nB 0 0\n",
       "w.w:10: header: expected the number of logs, found the end of the file; the file is cut"},
      // JSON
      {"w.json", "{\"name\": \"A\",\n \"path\": [\n",
       "w.json:3: expected JSON, found the end of the file too early; check brackets, commas and quotes"},
      {"w.json", "{\"path\": [{\"east\": 1, \"north\": 2, \"md\": 3}]}",
       "w.json: path[0]: expected the number 'tvd', found none"},
      {"w.json", "{\"path\": [{\"east\": 1, \"north\": \"2\", \"tvd\": 3, \"md\": 3}]}",
       "w.json: path[0].north: expected a number, found '\"2\"'"},
      {"w.json", "{\"path\": [7]}", "w.json: path[0]: expected an object {east, north, tvd, md}, found another value"},
      {"w.json", "{\"path\": {}}", "w.json: path: expected a list 'path' of {east, north, tvd, md}, found none"},
      {"w.json", "[[[[[[[[[\"path\"]]]]]]]]]",
       "w.json:1: expected well paths in JSON, found deeper nesting than they have; is this a well path?"},
      // Petrel
      {"w.dev", petrel_start, "w.dev: header: expected a row naming the columns MD X Y Z, found none; the file is cut"},
      {"w.dev", petrel_start + "MD X Y\n",
       "w.dev:3: header: expected a row naming the columns MD X Y Z, found 'MD X Y'; the header is not whole"},
      {"w.dev", petrel_start + "MD X Y Z\n0 0 0\n",
       "w.dev:4: row: expected 4 numbers as in the row of column names, found 3; the file is cut or damaged"},
      {"w.dev", petrel_start + "# WELL HEAD X-COORDINATE: east\n",
       "w.dev:3: head: expected a coordinate of the well's head, found 'east'"},
      // LAS
      {"w.las", las_start + las_curves, "w.las:9: ~A: expected a data section ~A, found none; the file is cut"},
      {"w.las", las_start + "~C\nDEPT.M :\nGR.GAPI :\n~A\n0 1\n",
       "w.las:9: ~A: expected curves DEPT, DEVI and AZIM, or X, Y and TVD, found 2 curves without them; export the "
       "well's deviation with the logs"},
      {"w.las", las_start + las_curves + "~A\n0 0\n",
       "w.las:11: ~A: expected 3 values, one for each curve, found 2; check WRAP in the version section"},
      {"w.las", las_start + las_curves + "~A\n0 zero 0\n", "w.las:11: INC: expected a number, found 'zero'"},
      {"w.las", las_start + "~C\nDEPT.KM :\nDEVI.DEG :\nAZIM.DEG :\n~A\n",
       "w.las:10: ~C: expected metres, feet or degrees for MD, found the unit 'KM'"},
      // WITSML
      {"w.xml", xml_start + "<Md>", "w.xml:3: expected XML, found Start-end tags mismatch; the file is cut or damaged"},
      {"w.xml", xml_start + "</Trajectory>",
       "w.xml:2: trajectoryStation: expected stations with md, incl and azi, found none"},
      {"w.xml", xml_start + station("0", "0") + station("9", "0", "furlong") + "</Trajectory>",
       "w.xml:6: Md: expected the unit m or ft, found 'furlong'"},
      {"w.xml", xml_start + station("0", "x") + "</Trajectory>", "w.xml:4: Incl: expected a number, found 'x'"},
      {"w.xml", xml_start + "<TrajectoryStation><Md uom=\"m\">0</Md></TrajectoryStation></Trajectory>",
       "w.xml:2: trajectoryStation: expected md, incl and azi, or tvd, dispNs and dispEw, in every station, found "
       "stations without them; export the whole survey"},
      // None of them
      {"w.txt", "a,b\n1,2\n",
       "w.txt: expected a well path: CSV with MD,X,Y,TVD or MD,INC,AZI, or another of `wellknit formats`, found none "
       "that is known; see wellknit formats"},
  };
  return all;
}

TEST(BrokenWells, EndlessTurningIsRefused) {
  std::string text = "# head 0 0 0\nMD,INC,AZI\n0,0,0\n";
  for (int n = 1; n <= 400; ++n) text += std::to_string(n) + (n % 2 == 1 ? ",101,0\n" : ",0,0\n");
  const auto error = error_of([&] { return parse_trajectory(text, "w.csv"); });
  ASSERT_TRUE(error);
  // 356 turns of 101 degrees are 35,956; the next row is line 3 + 357.
  EXPECT_EQ(error->where().line, 360);
}

TEST(BrokenWells, EachEndsInItsOwnLine) {
  for (const Broken& broken : broken_files()) {
    const auto error = error_of([&] { return parse_trajectory(broken.text, broken.path); });
    ASSERT_TRUE(error) << broken.text;
    EXPECT_STREQ(error->what(), broken.message) << broken.text;
  }
  EXPECT_GE(broken_files().size(), 20U);
}

const std::vector<std::string>& samples() {
  static const std::vector<std::string> names{"curved.csv",   "survey.csv",     "comma.csv",      "two.dev",
                                              "heading.dev",  "two.json",       "trace.dev",      "deviation.las",
                                              "survey21.xml", "survey1411.xml", "logged.rmswell", "stacked.rmswell"};
  return names;
}

/// Either wells with whole paths, or one line.
void read_damaged(const std::string& text, const std::string& name) {
  try {
    const TrajectoryFile file = parse_trajectory(text, name, {{0.0, 0.0, 0.0}, false});
    EXPECT_FALSE(file.wells.empty());
    for (const Well& well : file.wells) {
      const Trajectory& path = well.trajectory;
      ASSERT_GE(path.points.size(), 2U);
      ASSERT_EQ(path.points.size(), path.measured_depth.size());
      for (std::size_t n = 1; n < path.points.size(); ++n)
        ASSERT_GT(path.measured_depth[n], path.measured_depth[n - 1]);
      (void)describe(well);
    }
  } catch (const ParseError& error) {
    EXPECT_EQ(error.where().file, name);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

TEST(DamagedWells, TruncationIsAnErrorOrValidWells) {
  for (const std::string& name : samples()) {
    const std::string text(load_file(std::string(WELLKNIT_TESTDATA) + "/wells/" + name).text);
    for (std::size_t n = 0; n < 200; ++n) read_damaged(text.substr(0, text.size() * n / 200), name);
  }
}

TEST(DamagedWells, FlippedBytesAreAnErrorOrValidWells) {
  const auto seed = random_seed();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (const std::string& name : samples()) {
    const std::string text(load_file(std::string(WELLKNIT_TESTDATA) + "/wells/" + name).text);
    for (int n = 0; n < 1000; ++n) {
      std::string damaged = text;
      damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
      read_damaged(damaged, name);
    }
  }
}

}  // namespace
}  // namespace wellknit
