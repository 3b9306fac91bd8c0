// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/grid_validity.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace wellknit {
namespace {

GridValidity two_gaps() {
  GridValidity validity;
  OddPlaces& gaps = validity[GridOddity::gap];
  gaps.count = 2;
  gaps.first = {{{0, 1, 2}, {0, 1, 1}, 0.5}, {{3, 1, 2}, {3, 1, 1}, 1.25}};
  gaps.worst = gaps.first[1];
  gaps.area = 400.0;
  return validity;
}

TEST(GridValidity, SaysNothingOfASoundGrid) {
  GridValidity validity;
  EXPECT_TRUE(validity.empty());
  EXPECT_TRUE(to_lines(validity).empty());
  EXPECT_EQ(to_json(validity), "{}");
  validity.open_fault_faces = 3;
  EXPECT_TRUE(validity.empty()) << "throws open columns";
  EXPECT_EQ(to_json(validity), R"({"open_fault_faces":3})");
}

TEST(GridValidity, CountsFromOneInItsLines) {
  const auto lines = to_lines(two_gaps());
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].starts_with("cells below a gap in their column: 2, 400 m2 in plan (")) << lines[0];
  EXPECT_NE(lines[0].find("worst (4, 2, 3): 1.25 m; first (1, 2, 3) (4, 2, 3); "), std::string::npos) << lines[0];
  EXPECT_TRUE(lines[0].ends_with(advice_on(GridOddity::gap))) << lines[0];
}

TEST(GridValidity, NamesPillarsByPairs) {
  GridValidity validity;
  OddPlaces& pillars = validity[GridOddity::crossing_pillars];
  pillars.count = 1;
  pillars.first = {{{0, 1, -1}, {1, 1, -1}, 170.0}};
  pillars.worst = pillars.first[0];
  EXPECT_NE(to_lines(validity).front().find("worst (1, 2)-(2, 2): 170 degrees"), std::string::npos)
      << to_lines(validity).front();
  const auto json = nlohmann::json::parse(to_json(validity));
  EXPECT_EQ(json["crossing_pillars"]["worst"]["cell"], nlohmann::json::parse("[1, 2]"));
  EXPECT_EQ(json["crossing_pillars"]["worst"]["other"], nlohmann::json::parse("[2, 2]"));
}

TEST(GridValidity, GivesEveryPlaceInJson) {
  const auto json = nlohmann::json::parse(to_json(two_gaps()));
  ASSERT_EQ(json.size(), 1U);
  const auto& gap = json["gap"];
  EXPECT_EQ(gap["count"], 2);
  EXPECT_EQ(gap["unit"], "m");
  EXPECT_EQ(gap["area"], 400.0);
  EXPECT_EQ(gap["worst"]["cell"], nlohmann::json::parse("[4, 2, 3]"));
  EXPECT_EQ(gap["worst"]["other"], nlohmann::json::parse("[4, 2, 2]"));
  EXPECT_EQ(gap["worst"]["figure"], 1.25);
  EXPECT_EQ(gap["first"].size(), 2U);
}

}  // namespace
}  // namespace wellknit
