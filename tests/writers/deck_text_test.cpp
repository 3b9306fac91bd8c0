// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/deck_text.h"

#include <gtest/gtest.h>

#include <sstream>

namespace wellknit {
namespace {

std::string array_text(const std::vector<double>& values) {
  std::ostringstream out;
  write_deck_array(out, "PORO", values);
  return out.str();
}

TEST(DeckText, WritesEqualNeighboursWithARepeatCount) {
  EXPECT_EQ(array_text({0.25, 0.25, 0.25, 0.5}), "PORO\n 3*0.25 0.5\n/\n");
}

TEST(DeckText, WritesAnEmptyArray) { EXPECT_EQ(array_text({}), "PORO\n\n/\n"); }

TEST(DeckText, KeepsEveryDigit) {
  const double third = 1.0 / 3.0;
  std::istringstream in(array_text({third}));
  std::string keyword;
  double value = 0.0;
  in >> keyword >> value;
  EXPECT_EQ(value, third);
}

TEST(DeckText, KeepsLinesWithin128Characters) {
  std::vector<double> values;
  for (int i = 1; i <= 200; ++i) values.push_back(1.0 / i);
  std::istringstream in(array_text(values));
  std::string line;
  std::size_t longest = 0;
  while (std::getline(in, line)) longest = std::max(longest, line.size());
  EXPECT_LE(longest, 128U);
  EXPECT_GT(longest, 100U);
}

TEST(DeckText, CutsCommentsAndTheirControlCharacters) {
  std::ostringstream out;
  write_deck_comment(out, "two\nlines " + std::string(200, 'x'));
  EXPECT_EQ(out.str().substr(0, 13), "-- two?lines ");
  EXPECT_EQ(out.str().size(), 129U);  // 128 and the end of the line
}

TEST(DeckText, KeepsNamesThatFit) {
  const std::vector<std::string> names{"PROD", "inj-1", "A_234567"};
  EXPECT_EQ(deck_well_names(names), names);
}

TEST(DeckText, ShortensLongNamesUniquely) {
  EXPECT_EQ(deck_well_names({"PRODUCER-NORTH", "PRODUCER-SOUTH", "PRODUCER"}),
            (std::vector<std::string>{"PRODUC_2", "PRODUC_3", "PRODUCER"}));
}

TEST(DeckText, ReplacesWhatANameCannotHold) {
  EXPECT_EQ(deck_well_names({"A/B 1", "55_33-1", "", "'*'"}),
            (std::vector<std::string>{"A_B_1", "W55_33-1", "W", "W___"}));
}

TEST(DeckText, TellsNamesApartThatDifferInCaseOnly) {
  EXPECT_EQ(deck_well_names({"p1", "P1"}), (std::vector<std::string>{"p1", "P1_2"}));
}

}  // namespace
}  // namespace wellknit
