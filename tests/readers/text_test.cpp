// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/text.h"

#include <gtest/gtest.h>

namespace wellknit {
namespace {

TEST(ParseReal, TakesFortranExponentsAndSigns) {
  EXPECT_EQ(parse_real("1.0D+3"), 1000.0);
  EXPECT_EQ(parse_real("2.5d-1"), 0.25);
  EXPECT_EQ(parse_real("+7"), 7.0);
  EXPECT_EQ(parse_real("-.5"), -0.5);
  EXPECT_EQ(parse_real("1e3"), 1000.0);
}

TEST(ParseReal, RefusesWhatIsNotAFiniteNumber) {
  for (const char* text :
       {"", "+", "-", ".", "abc", "1.0x", "1 2", "nan", "inf", "-infinity", "1e999", "1D", "1,5", "+-1", "0x10"})
    EXPECT_FALSE(parse_real(text)) << text;
}

TEST(ParseInteger, TakesWholeNumbersOnly) {
  EXPECT_EQ(parse_integer("-12"), -12);
  EXPECT_EQ(parse_integer("+3"), 3);
  EXPECT_EQ(parse_integer("3.0"), 3);
  EXPECT_EQ(parse_integer("1e2"), 100);
  for (const char* text : {"", "1.5", "x", "1e300", "99999999999999999999", "3*"})
    EXPECT_FALSE(parse_integer(text)) << text;
}

TEST(Pattern, StarStandsForAnyCharacters) {
  EXPECT_TRUE(matches_pattern("PROD12", "PROD*"));
  EXPECT_TRUE(matches_pattern("prod12", "PROD*"));
  EXPECT_TRUE(matches_pattern("A-1H", "*1*"));
  EXPECT_TRUE(matches_pattern("", "*"));
  EXPECT_FALSE(matches_pattern("PROD", "PROD1*"));
  EXPECT_FALSE(matches_pattern("XPROD", "PROD*"));
  // A pattern with many stars takes no exponential time.
  EXPECT_FALSE(matches_pattern(std::string(200, 'a'), "*a*a*a*a*a*a*a*a*a*a*a*a*b"));
}

TEST(Lines, EndWithAnyOfTheThreeLineEnds) {
  LineReader lines("a\nb\r\nc\rd");
  for (const char* expected : {"a", "b", "c", "d"}) EXPECT_EQ(lines.next(), expected);
  EXPECT_EQ(lines.line(), 4);
  EXPECT_FALSE(lines.next());
}

TEST(Fields, KeepEmptyOnesUnlessBlanksSeparate) {
  EXPECT_EQ(split_fields("a; ;c", ';'), (std::vector<std::string_view>{"a", "", "c"}));
  EXPECT_EQ(split_fields("  a \t b ", ' '), (std::vector<std::string_view>{"a", "b"}));
  EXPECT_TRUE(split_fields(" ", ' ').empty());
}

TEST(MessageText, IsShortAndPrintable) {
  EXPECT_EQ(quoted_for_message("a\nb\x80"), "'a?b?'");
  EXPECT_EQ(quoted_for_message(std::string(50, 'x')), "'" + std::string(40, 'x') + "...'");
}

}  // namespace
}  // namespace wellknit
