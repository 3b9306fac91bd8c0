// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/fixed_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

std::string fixed(double value, int width = 10) {
  const ScratchFolder folder;
  TextFile out(folder.file("a"), "a");
  fixed_number(out, value, width);
  out.close();
  return folder.read("a");
}

TEST(FixedField, FillsItsWidth) {
  EXPECT_EQ(fixed(1.0), "1.00000000");
  EXPECT_EQ(fixed(-0.5), "-0.5000000");
  EXPECT_EQ(fixed(0.0), "        0.");
  EXPECT_EQ(fixed(-0.0), "        0.");
  EXPECT_EQ(fixed(464213.123456), "464213.123");
  EXPECT_EQ(fixed(-5931000.7), "-5931000.7");
  EXPECT_EQ(fixed(123456789.4), "123456789.");
  EXPECT_EQ(fixed(1234567890.0), "1.234568E9");
  EXPECT_EQ(fixed(6.579488e-14), "6.5795E-14");
  EXPECT_EQ(fixed(-6.579488e-14), "-6.579E-14");
  EXPECT_EQ(fixed(1e-300), "1.000E-300");
  EXPECT_EQ(fixed(0.00123456789), "1.23457E-3");
  EXPECT_EQ(fixed(0.0123456789), "0.01234568");
  EXPECT_EQ(fixed(std::nan("")), "        0.");
}

TEST(FixedField, FitsWhenRoundingMakesADigitMore) {
  EXPECT_EQ(fixed(9.9999999999), "10.0000000");
  EXPECT_EQ(fixed(999999999.9), " 1.00000E9");
  EXPECT_EQ(fixed(9.9999999e-10), " 1.0000E-9");
  EXPECT_EQ(fixed(9.9999999e9), "1.00000E10");
}

TEST(FixedField, KeepsTheDigitsThatTheWidthAllows) {
  std::mt19937_64 random(20260301);  // seed
  std::uniform_real_distribution<double> exponent(-30.0, 30.0);
  std::vector<double> values;
  for (int n = 0; n < 20000; ++n) values.push_back(std::pow(10.0, exponent(random)) * (n % 2 == 0 ? 1.0 : -1.0));
  const ScratchFolder folder;
  TextFile out(folder.file("a"), "a");
  for (const double value : values) fixed_number(out, value, 10);
  out.close();
  const std::string all = folder.read("a");
  ASSERT_EQ(all.size(), 10 * values.size());
  for (std::size_t n = 0; n < values.size(); ++n) {
    const std::string text = all.substr(10 * n, 10);
    ASSERT_NE(text.find('.'), std::string::npos) << values[n];
    // The worst: a sign, one digit, the point, three more, E-12.
    const bool is_plain = std::abs(values[n]) >= 0.01 && std::abs(values[n]) < 1e7;
    ASSERT_NEAR(std::stod(text) / values[n], 1.0, is_plain ? 5.1e-6 : 5.1e-4) << text;
  }
}

}  // namespace
}  // namespace wellknit
