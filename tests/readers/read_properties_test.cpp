// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_properties.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/errors.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

PropertyFile read(const std::string& text, std::int64_t cells) {
  const ScratchFolder folder;
  folder.write("values.GRDECL", text);
  return read_properties(folder.file("values.GRDECL"), cells);
}

ParseError error_of(const std::string& text, std::int64_t cells) {
  try {
    (void)read(text, cells);
  } catch (const ParseError& error) {
    return error;
  }
  return {{"", -1, ""}, {"", "", ""}};
}

using Reals = std::vector<double>;
using Integers = std::vector<std::int32_t>;

TEST(ReadProperties, TakesKnownAndUnknownKeywords) {
  const PropertyFile file =
      read("-- a comment\nPORO\n 0.1 2*0.2 -- three of\n 0.3 /\nMYKEY 4*1.5 /\nsatnum\n1 2 1 2\n/\n", 4);
  ASSERT_EQ(file.properties.size(), 3U);
  EXPECT_EQ(std::get<Reals>(file.properties.at("PORO")), (Reals{0.1, 0.2, 0.2, 0.3}));
  EXPECT_EQ(std::get<Reals>(file.properties.at("MYKEY")), (Reals{1.5, 1.5, 1.5, 1.5}));
  EXPECT_EQ(std::get<Integers>(file.properties.at("SATNUM")), (Integers{1, 2, 1, 2}));
  EXPECT_TRUE(file.notes.empty());
}

TEST(ReadProperties, DefaultsAreNoNumbers) {
  const PropertyFile file = read("SWAT\n 0.1 2* 0.3 /\n", 4);
  const auto& values = std::get<Reals>(file.properties.at("SWAT"));
  EXPECT_TRUE(std::isnan(values[1]) && std::isnan(values[2]));
  EXPECT_EQ(values[3], 0.3);
}

TEST(ReadProperties, PassesOverWhatIsNoPropertyWithANote) {
  const PropertyFile file =
      read("SPECGRID\n 2 2 1 1 F /\nWELSPECS\n 'A' 'B' 1 /\n/\nPORO\n 4*0.2 /\nODD\n 1 2 3 /\n", 4);
  EXPECT_EQ(file.properties.size(), 1U);
  ASSERT_EQ(file.notes.size(), 2U);
  EXPECT_NE(file.notes[0].find("WELSPECS"), std::string::npos);
  EXPECT_NE(file.notes[1].find("ODD"), std::string::npos);
}

TEST(ReadProperties, RefusesWithTheLine) {
  EXPECT_EQ(error_of("\nPORO\n 3*0.2 /\n", 4).where().line, 2);
  EXPECT_EQ(error_of("PORO\n 5*0.2 /\n", 4).where().keyword, "PORO");
  EXPECT_EQ(error_of("PORO\n 4*0.2", 4).where().keyword, "PORO") << "no '/'";
  EXPECT_EQ(error_of("PORO\n 999999999999*0.2 /\n", 4).where().keyword, "PORO");
  EXPECT_EQ(error_of("FIPNUM\n 2*1 2* /\n", 4).where().keyword, "FIPNUM");
  EXPECT_EQ(error_of("INCLUDE\n 'x' /\n", 4).where().keyword, "INCLUDE");
  EXPECT_THROW((void)read("", 4), ParseError);
  EXPECT_THROW((void)read("ODD\n 1 /\n", 4), ParseError);
  EXPECT_THROW((void)read_properties("/nowhere/at/all", 4), ParseError);
}

TEST(ReadProperties, SurvivesEveryTruncation) {
  const std::string text = "PORO\n 0.1 2*0.2 0.3 /\r\nODD\n 'a' /\nSATNUM\n4*2 /\n";
  for (std::size_t length = 0; length <= text.size(); ++length) {
    try {
      for (const auto& [keyword, values] : read(text.substr(0, length), 4).properties)
        EXPECT_EQ(std::visit([](const auto& v) { return v.size(); }, values), 4U);
    } catch (const ParseError&) {
      continue;
    }
  }
}

}  // namespace
}  // namespace wellknit
