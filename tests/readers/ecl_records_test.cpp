// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/ecl_records.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/readers/ecl_files.h"
#include "tests/readers/reader_helpers.h"

namespace wellknit {
namespace {

TEST(EclRecords, BlocksOfAnySizeAreJoined) {
  std::vector<std::int32_t> values(2500);
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = static_cast<std::int32_t>(n) - 7;
  for (const std::size_t block : {std::size_t{1000}, std::size_t{1}, std::size_t{2500}}) {
    const std::string bytes = ecl::array("A", "INTE", values, block) + ecl::inte("B", {});
    EclRecords file(bytes, "f");
    const auto a = file.next();
    ASSERT_TRUE(a);
    EXPECT_EQ(file.integers(*a), values);
    EXPECT_EQ(file.reals(*a)[2499], 2492.0);
    EXPECT_EQ(file.next()->name, "B");
    EXPECT_FALSE(file.next());
  }
}

TEST(EclRecords, EveryTypeIsKnown) {
  const std::string bytes = ecl::array<double>("D", "DOUB", {1.0 / 3.0}) +
                            ecl::array<std::int32_t>("L", "LOGI", {-1, 0}) + ecl::text("C", {"AB C", "D"}) +
                            ecl::text("LONG", {"twelve chars"}, 12) + ecl::header("M", 0, "MESS") +
                            ecl::real("R", {0.1F});
  EclRecords file(bytes, "f");
  EXPECT_EQ(file.reals(*file.next())[0], 1.0 / 3.0);
  EXPECT_EQ(file.next()->type, EclType::logical);
  EXPECT_EQ(file.strings(*file.next()), (std::vector<std::string>{"AB C", "D"}));
  EXPECT_EQ(file.strings(*file.next()), (std::vector<std::string>{"twelve chars"}));
  EXPECT_EQ(file.next()->count, 0);
  EXPECT_EQ(file.reals(*file.next())[0], static_cast<double>(0.1F)) << "single precision becomes double as it is";
  EXPECT_FALSE(file.next());
}

TEST(EclRecords, X231CarriesTheUpperPartOfACount) {
  // 2^31 + 1 integers are more than the file has: the count is understood, and refused.
  const std::string bytes = ecl::header("BIG", -1, "X231") + ecl::header("BIG", 1, "INTE");
  const auto error = error_of([&] { return EclRecords(bytes, "f").next()->count; });
  ASSERT_TRUE(error);
  EXPECT_NE(std::string(error->what()).find("expected 2147483649 values"), std::string::npos) << error->what();
  // Nothing in the upper part: an ordinary array.
  const std::string small = ecl::header("A", 0, "X231") + ecl::inte("A", {5});
  EclRecords file(small, "f");
  EXPECT_EQ(file.integers(*file.next()), std::vector<std::int32_t>{5});
}

TEST(EclRecords, FormattedTextIsReadByTokens) {
  const std::string text =
      " 'NAMES   '           2 'CHAR'\n 'it's    ' 'B       '\n 'D       '           2 'DOUB'\n  0.1D+01 -2.5d0\n"
      " 'L       '           2 'LOGI'\n  T  F\n 'N       '           3 'INTE'\r\n 1 2\r\n 3\r\n";
  EclRecords file(text, "f");
  EXPECT_TRUE(file.is_formatted());
  EXPECT_EQ(file.strings(*file.next()), (std::vector<std::string>{"it's", "B"})) << "a quote inside is no end";
  EXPECT_EQ(file.reals(*file.next()), (std::vector<double>{1.0, -2.5}));
  EXPECT_EQ(file.next()->type, EclType::logical);
  const auto integers = file.next();
  EXPECT_EQ(file.integers(*integers), (std::vector<std::int32_t>{1, 2, 3}));
  EXPECT_EQ(file.where(*integers).line, 7);
  EXPECT_FALSE(file.next());
}

TEST(EclRecords, HeadersAreRecognised) {
  EXPECT_TRUE(begins_with_ecl_header(ecl::inte("FILEHEAD", {1}), {"FILEHEAD"}));
  EXPECT_FALSE(begins_with_ecl_header(ecl::inte("INTEHEAD", {1}), {"FILEHEAD"}));
  EXPECT_TRUE(begins_with_ecl_header("\n 'INTEHEAD'  411 'INTE'\n", {"INTEHEAD"}));
  EXPECT_FALSE(begins_with_ecl_header("'WELL A'\n1 2 3 4\n", {})) << "the name line of a .dev file";
  EXPECT_FALSE(begins_with_ecl_header(std::string("\0\0\0\x10\x01\x02\x03\x04\x05\x06\x07\x08zzzz", 16), {}));
  EXPECT_FALSE(begins_with_ecl_header("", {}));
}

}  // namespace
}  // namespace wellknit
