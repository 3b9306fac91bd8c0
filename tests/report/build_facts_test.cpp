// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/build_facts.h"

#include <gtest/gtest.h>

#include "model/errors.h"

namespace wellknit {
namespace {

TEST(BuildFacts, AreThoseOfTheSummary) {
  const BuildFacts facts = parse_build_facts(
      R"({"wells": [{"name": "A", "meshed": false, "mode": "host cells", "reason": "too near the side",
                     "radius_wanted": 15, "drainage_radius": 0, "length_in_rock": 90.5, "length_meshed": 0, "notes": ["n"]}],
          "times": [{"step": "read", "seconds": 0.5}], "notes": ["one"]})",
      "summary.json");
  ASSERT_NE(facts.well("A"), nullptr);
  EXPECT_EQ(facts.well("A")->reason, "too near the side");
  EXPECT_DOUBLE_EQ(facts.well("A")->length_in_rock, 90.5);
  EXPECT_EQ(facts.well("B"), nullptr);
  EXPECT_EQ(facts.steps.at(0).name, "read");
  EXPECT_EQ(facts.notes, std::vector<std::string>{"one"});
}

TEST(BuildFacts, OfAnythingElseAreRefused) {
  for (const char* text : {"", "{", "[]", "{}", R"({"wells": 1, "times": [], "notes": []})",
                           R"({"wells": [{}], "times": [], "notes": []})"})
    EXPECT_THROW(parse_build_facts(text, "summary.json"), ParseError) << text;
}

}  // namespace
}  // namespace wellknit
