// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/describe.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/readers/reader_helpers.h"

namespace wellknit {
namespace {

const std::string testdata = WELLKNIT_TESTDATA;

TEST(Describe, MeasuresAGrid) {
  const FileDescription file = describe_file(testdata + "/grdecl/box.GRDECL");
  EXPECT_EQ(file.format, "GRDECL");
  ASSERT_TRUE(file.grid);
  EXPECT_EQ(file.grid->active_cells, 2);
  EXPECT_EQ(file.grid->inverted_cells, 0);
  EXPECT_TRUE(file.grid->is_right_handed);
  EXPECT_DOUBLE_EQ(file.grid->bulk_volume, 1.0 + 2.0);
  EXPECT_DOUBLE_EQ(*file.grid->pore_volume, 0.1 * 1.0 + 0.2 * 2.0);
  EXPECT_EQ(file.grid->least, Vec3(0, 0, 0));
  EXPECT_EQ(file.grid->most, Vec3(3, 1, 1));
  ASSERT_EQ(file.grid->properties.size(), 3U);
  EXPECT_EQ(file.grid->properties[1].name, "PERMX");
  EXPECT_NEAR(file.grid->properties[1].most, 200.0, 1e-12) << "mD";
}

TEST(Describe, LeavesInactiveCellsOut) {
  const GridDescription grid =
      describe(case_of(unit_boxes(3, 1, 1) + "ACTNUM\n 1 1 0 /\nPORO\n 0.1 0.2 9 /\nNTG\n 3*0.5 /\n").grid);
  EXPECT_EQ(grid.active_cells, 2);
  EXPECT_DOUBLE_EQ(grid.bulk_volume, 2.0);
  EXPECT_DOUBLE_EQ(*grid.pore_volume, (0.1 + 0.2) * 0.5);
  EXPECT_EQ(grid.most, Vec3(2, 1, 1));
  EXPECT_EQ(grid.properties[0].most, 0.2);
}

TEST(Describe, SeesLeftHandedAndInvertedCells) {
  // The first layer upside down: its top at depth 1, its base at 0.
  CornerPointGrid grid = case_of(unit_boxes(1, 1, 3)).grid;
  for (std::size_t corner = 0; corner < 8; ++corner) grid.zcorn[corner] = corner < 4 ? 1.0 : 0.0;
  EXPECT_EQ(describe(grid).inverted_cells, 1);
  EXPECT_TRUE(describe(grid).is_right_handed);
  for (double& depth : grid.zcorn) depth = -depth;
  EXPECT_FALSE(describe(grid).is_right_handed);
  EXPECT_EQ(describe(grid).inverted_cells, 1);
}

TEST(Describe, MeasuresWells) {
  const FileDescription file = describe_file(testdata + "/wells/logged.rmswell");
  ASSERT_EQ(file.wells.size(), 1U);
  EXPECT_EQ(file.wells[0].stations, 4U);
  EXPECT_DOUBLE_EQ(file.wells[0].largest_deviation, 0.0);
  EXPECT_DOUBLE_EQ(file.wells[0].open_length, 1050.0 - 1030.0);
  const FileDescription dev = describe_file(testdata + "/wells/two.dev");
  // From (0, 0, 1100) to (50, 0, 1180): atan(50 / 80) = 32.005 degrees.
  EXPECT_NEAR(dev.wells[0].largest_deviation, 32.005, 1e-3);
  EXPECT_DOUBLE_EQ(dev.wells[1].open_length, 200.0);
}

TEST(Describe, TellsOfBranchesAndOfSurveysWithoutAHead) {
  const FileDescription survey = describe_file(testdata + "/wells/survey.csv");
  ASSERT_EQ(survey.wells.size(), 2U);
  EXPECT_EQ(survey.wells[1].parent, "A-1");
  EXPECT_NE(to_text(survey).find("well A-1:2: branch 2 of A-1, "), std::string::npos);
  const auto json = nlohmann::json::parse(to_json(survey));
  EXPECT_TRUE(json["wells"][0]["parent"].is_null());
  EXPECT_EQ(json["wells"][1]["branch"], 2);
  const FileDescription witsml = describe_file(testdata + "/wells/survey21.xml");
  ASSERT_EQ(witsml.wells.size(), 1U);
  // The last chord of an arc that ends at 60 degrees, cut in turns of 5: its mean direction is 57.5.
  EXPECT_NEAR(witsml.wells[0].largest_deviation, 57.5, 1e-6);
  EXPECT_EQ(witsml.notes.size(), 2U) << "true north, and no head";
}

TEST(Describe, TellsOfADecksWellsSourcesAndNotes) {
  const FileDescription file = describe_file(testdata + "/grdecl/deck/BOX.DATA");
  EXPECT_EQ(file.format, "Eclipse deck");
  ASSERT_EQ(file.wells.size(), 3U);
  EXPECT_EQ(file.wells[2].type, "injector");
  EXPECT_TRUE(file.wells[2].is_approximate);
  EXPECT_EQ(file.sources.size(), 3U);
  EXPECT_EQ(file.notes.size(), 1U) << "UNHEARD";
}

TEST(Describe, TextNamesWhatTheStructHolds) {
  const std::string text = to_text(describe_file(testdata + "/grdecl/deck/BOX.DATA"));
  for (const char* part :
       {"4 x 3 x 2 = 24, 24 active", "FIELD, with map axes", "PERMX         100 to 200 mD",
        "well INJ: injector, 2 completed cells", "read geometry.inc sha256 ", "note: ", "UNHEARD is not understood"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_EQ(text.back(), '\n');
}

TEST(Describe, TellsOfFaultsMultipliersAndRegions) {
  const FileDescription file = describe_file(testdata + "/grdecl/CONNECTIONS.DATA");
  const EditsDescription& edits = file.grid->edits;
  ASSERT_EQ(edits.faults.size(), 3U);
  EXPECT_EQ(edits.faults[0].name, "North fault");
  EXPECT_EQ(edits.faults[0].faces, 2 * 3 * 2);
  EXPECT_EQ(edits.faults[2].multiplier, 4.0);
  EXPECT_EQ(edits.multipliers, (std::vector<std::string>{"MULTX-", "MULTZ", "MULTPV", "MINPVV"}));
  EXPECT_EQ(edits.non_neighbours, 2);
  EXPECT_EQ(edits.array_edits,
            (std::map<std::string, std::int64_t>{{"DEPTH", 1}, {"PORV", 1}, {"TRANX", 1}, {"TRANY", 2}, {"TRANZ", 1}}));
  EXPECT_EQ(edits.regions,
            (std::map<std::string, std::int64_t>{{"FIPNUM", 2}, {"FLUXNUM", 4}, {"MULTNUM", 2}, {"OPERNUM", 2}}));
  const std::string text = to_text(file);
  for (const char* part :
       {"fault         North fault: 12 faces, multiplier 0.1\n", "multipliers   MULTX-, MULTZ, MULTPV, MINPVV\n",
        "region pairs  3 of MULTREGT\n", "connections   2 of NNC\n", "edited        2 of EDITNNC and EDITNNCR\n",
        "array edits   DEPTH (1), PORV (1), TRANX (1), TRANY (2), TRANZ (1)\n",
        "regions       FIPNUM (2), FLUXNUM (4), MULTNUM (2), OPERNUM (2)\n"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  const auto json = nlohmann::json::parse(to_json(file))["grid"]["edits"];
  EXPECT_EQ(json["faults"][1]["name"], "SOUTH");
  EXPECT_EQ(json["faults"][1]["multiplier"], 0.0);
  EXPECT_EQ(json["multipliers"].size(), 4U);
  EXPECT_EQ(json["non_neighbours"], 2);
  EXPECT_EQ(json["regions"]["FLUXNUM"], 4);
}

TEST(Describe, JsonHoldsTheSame) {
  const auto json = nlohmann::json::parse(to_json(describe_file(testdata + "/grdecl/box.GRDECL")));
  EXPECT_EQ(json["grid"]["dimensions"], (std::vector<int>{2, 1, 1}));
  EXPECT_NEAR(json["grid"]["bulk_volume"].get<double>(), 3.0, 1e-12);
  EXPECT_EQ(json["grid"]["properties"]["SATNUM"]["most"], 2.0);
  EXPECT_EQ(json["sources"].size(), 1U);
  EXPECT_TRUE(json["wells"].is_array());
}

TEST(Describe, JsonStandsAnyName) {
  FileDescription file;
  WellDescription well;
  well.name = "\xE5";
  well.depth_to = std::numeric_limits<double>::infinity();
  file.wells.push_back(well);
  const auto json = nlohmann::json::parse(to_json(file));
  EXPECT_TRUE(json["wells"][0]["depth"][1].is_null());
}

}  // namespace
}  // namespace wellknit
