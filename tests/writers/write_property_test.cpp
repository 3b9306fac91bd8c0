// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/write_property.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "model/errors.h"
#include "readers/read_properties.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

TEST(WriteProperty, IsReadBackTheSame) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(-1e3, 1e3);
  std::vector<double> values(1000, 0.25);
  for (std::size_t n = 0; n < values.size(); n += 3) values[n] = uniform(random);
  values[5] = 1e-300;
  const ScratchFolder folder;
  write_property(folder.file("p.GRDECL"), "MYPROP", values, "a test");
  EXPECT_EQ(std::get<std::vector<double>>(read_properties(folder.file("p.GRDECL"), 1000).properties.at("MYPROP")),
            values);
  const std::vector<std::int32_t> regions{1, 1, 1, -7, 2, 2};
  write_property(folder.file("f.GRDECL"), "FIPNUM", regions, "a test");
  EXPECT_EQ(std::get<std::vector<std::int32_t>>(read_properties(folder.file("f.GRDECL"), 6).properties.at("FIPNUM")),
            regions);
  EXPECT_NE(folder.read("f.GRDECL").find("FIPNUM\n 3*1 -7 2*2\n/\n"), std::string::npos);
}

TEST(WriteProperty, RefusesWhatADeckCannotHold) {
  const ScratchFolder folder;
  const std::vector<double> good{1.0};
  for (const char* keyword : {"", "TOOLONGNAME", "1ST", "small", "A B", "A/B"})
    EXPECT_THROW(write_property(folder.file("p"), keyword, good, ""), InvalidInput) << keyword;
  const std::vector<double> bad{1.0, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_THROW(write_property(folder.file("p"), "PORO", bad, ""), InvalidInput);
  EXPECT_EQ(folder.count(), 0U) << "nothing is left";
}

}  // namespace
}  // namespace wellknit
