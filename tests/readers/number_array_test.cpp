// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/number_array.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <bit>
#include <cstdint>
#include <random>
#include <string>

#include "reader_helpers.h"
#include "readers/text.h"

namespace wellknit {
namespace {

constexpr double unset = -777.0;
constexpr std::int32_t unset_count = -777;

template <class T>
std::optional<std::vector<T>> values_of(std::string_view text, std::int64_t most, T none) {
  const auto array = parse_number_array<T>(text, most, none);
  return array ? std::optional(array->values) : std::nullopt;
}
std::optional<std::vector<double>> reals(std::string_view text, std::int64_t most = 1 << 22) {
  return values_of(text, most, unset);
}
std::optional<std::vector<std::int32_t>> integers(std::string_view text, std::int64_t most = 1 << 22) {
  return values_of(text, most, unset_count);
}

TEST(NumberArray, ReadsNumbersRepeatsDefaultsAndComments) {
  EXPECT_EQ(reals("1 -2.5\t+3 2*0.5 3* 1.5D2 -- 9 / 9\r\n .5 5. 1e-3/"),
            (std::vector<double>{1, -2.5, 3, 0.5, 0.5, unset, unset, unset, 150, 0.5, 5, 0.001}));
  EXPECT_EQ(integers("1 0 2*-3 2* 4.0\n/"), (std::vector<std::int32_t>{1, 0, -3, -3, unset_count, unset_count, 4}));
  EXPECT_EQ(reals("/"), std::vector<double>());
}

TEST(NumberArray, LeavesWhatIsNotPlain) {
  for (const char* text : {"1 x 2 /", "1 'A' /", "1 0*2 /", "1 -3*2 /", "1.5*2 /", "1 nan /", "1 1e999 /", "1 2--3 /",
                           "1 2", "", "99999999999999999999*1 /", "1..2 /", "- /", "1 2*3*4 /"})
    EXPECT_FALSE(reals(text)) << text;
  EXPECT_FALSE(integers("1 2.5 /"));
  EXPECT_FALSE(integers("2147483648 /"));
  EXPECT_FALSE(reals("1 2 3 /", 2));
  EXPECT_FALSE(reals("3*1 /", 2));
}

/// A number as files have them: up to 24 digits, with or without point, sign and exponent.
std::string random_number(std::mt19937& engine) {
  const auto below = [&](unsigned n) { return static_cast<unsigned>(engine() % n); };
  std::string text = below(4) == 0 ? "-" : "";
  const unsigned digits = 1 + below(below(8) == 0 ? 24 : 9);
  const unsigned point = below(digits + 2);  // beyond the digits: none
  for (unsigned n = 0; n < digits; ++n) {
    if (n == point) text += '.';
    text += static_cast<char>('0' + below(10));
  }
  if (point == digits) text += '.';
  if (below(8) == 0) text += fmt::format("{}{}", "eEdD"[below(4)], static_cast<int>(below(60)) - 30);
  return text;
}

TEST(NumberArray, EveryValueIsTheNearestDouble) {
  const std::uint32_t seed = 20261122;
  SCOPED_TRACE(fmt::format("seed {}", seed));
  std::mt19937 engine(seed);
  std::string text;
  std::vector<double> expected;
  for (int n = 0; n < 200'000; ++n) {
    const std::string number = random_number(engine);
    expected.push_back(*parse_real(number));  // by fast_float
    text += number;
    text += n % 7 == 6 ? "\n" : " ";
  }
  const auto found = reals(text + "/");
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), expected.size());
  for (std::size_t n = 0; n < expected.size(); ++n)
    ASSERT_EQ(std::bit_cast<std::uint64_t>((*found)[n]), std::bit_cast<std::uint64_t>(expected[n])) << "value " << n;
}

TEST(NumberArray, IsTheSameForAnyNumberOfThreads) {
  std::string text;
  for (int n = 0; n < 300'000; ++n) text += fmt::format("{}.{} {}", n, n % 97, n % 9 == 8 ? "2*0.25\n" : "");
  text += "/";
  const auto with_threads = [&](std::size_t count) {
    const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, count);
    return reals(text);
  };
  const auto one = with_threads(1);
  ASSERT_TRUE(one);
  EXPECT_EQ(one->size(), 300'000U + 2 * 33'333U);
  EXPECT_EQ(one, with_threads(2));
  EXPECT_EQ(one, with_threads(4));
}

TEST(NumberArray, EndsAtTheFirstSlashOutsideComments) {
  const auto length = [](std::string_view text) {
    const auto array = parse_number_array<double>(text, 1 << 22, unset);
    return array ? array->length : 0;
  };
  EXPECT_EQ(length("1 2 / 3 /"), 5U);
  EXPECT_EQ(length("1 -- a/b\n2 -- c/d\n/ rest"), 19U);
  EXPECT_EQ(length("1 -- a/b"), 0U);
  const auto array = parse_number_array<double>("1\n2 -- /\r\n3\r/\n", 3, unset);
  ASSERT_TRUE(array);
  EXPECT_EQ(array->line_ends, 3);
}

TEST(NumberArray, LargeOnesEndLikeSmallOnes) {
  std::string text;
  for (int n = 0; n < 200'000; ++n) text += "1.25\n";
  const auto array = parse_number_array<double>(text + "-- 1/2\n/ PORO\n" + text, 1 << 22, unset);
  ASSERT_TRUE(array);
  EXPECT_EQ(array->values.size(), 200'000U);
  EXPECT_EQ(array->length, 5U * 200'000U + 8U);
  EXPECT_EQ(array->line_ends, 200'001);
  EXPECT_FALSE(reals(text)) << "no '/'";
  EXPECT_FALSE(reals(text + "/", 199'999));
}

TEST(NumberArray, CountsEndsOfLines) {
  EXPECT_EQ(count_line_ends(""), 0);
  EXPECT_EQ(count_line_ends("a\nb\r\nc\rd"), 3);
  EXPECT_EQ(count_line_ends("a\r"), 1);
  std::string text;
  for (int n = 0; n < 1000; ++n) text += n % 3 == 0 ? "x\r\n" : n % 3 == 1 ? "\n" : "yy\r";
  EXPECT_EQ(count_line_ends(text), 1000);
}

TEST(NumberArray, LinesAfterItAreCountedOn) {
  std::string text = unit_boxes(2, 1, 1);
  text += "PORO\n0.1\n0.2 -- 1 / 2\n/ rest\nPERMX\n1\nx /\n";
  const auto line = std::count(text.begin(), text.end(), '\n');
  const auto error = error_in(text);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->where().line, line);
  EXPECT_EQ(error->where().keyword, "PERMX");
}

}  // namespace
}  // namespace wellknit
