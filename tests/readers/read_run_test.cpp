// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_run.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/readers/ecl_files.h"
#include "tests/readers/reader_helpers.h"
#include "tests/support/random_seed.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {

namespace {

std::string specification() {
  return ecl::inte("DIMENS", {5, 3, 2, 1, 0, -1}) +
         ecl::text("KEYWORDS", {"TIME", "FOPR", "WBHP", "WBHP", "BPR", "WBHP"}) +
         ecl::text("WGNAMES", {":+:+:+:+", ":+:+:+:+", "P1", "I1", "", ":+:+:+:+"}) +
         ecl::inte("NUMS", {0, 0, 1, 2, 4, 0}) +
         ecl::text("UNITS", {"DAYS", "SM3/DAY", "BARSA", "BARSA", "BARSA", "BARSA"});
}

std::string steps() {
  return ecl::inte("SEQHDR", {0}) + ecl::inte("MINISTEP", {0}) +
         ecl::real("PARAMS", {1.F, 10.F, 200.F, 300.F, 250.F, 0.F}) + ecl::inte("MINISTEP", {1}) +
         ecl::real("PARAMS", {3.5F, 11.F, 190.F, 310.F, 249.F, 0.F});
}

}  // namespace

TEST(ReadRun, NamesVectorsByWellAndNumber) {
  const ScratchFolder folder;
  folder.write("RUN.SMSPEC", specification());
  folder.write("RUN.UNSMRY", steps());
  const SummaryRun run = read_summary(folder.file("RUN"));
  EXPECT_EQ(run.dimensions, (std::array<std::int64_t, 3>{3, 2, 1}));
  EXPECT_EQ(run.time, (std::vector<double>{1.0, 3.5}));
  EXPECT_EQ(run.time_unit, "DAYS");
  ASSERT_EQ(run.vectors.size(), 4U) << "a well's vector without a well is none";
  EXPECT_EQ(run.vectors.at("FOPR").values, (std::vector<double>{10.0, 11.0}));
  EXPECT_EQ(run.vectors.at("WBHP:I1").values, (std::vector<double>{300.0, 310.0}));
  EXPECT_EQ(run.vectors.at("BPR:4").unit, "BARSA");
}

TEST(ReadRun, ReadsAnArrayByReportStep) {
  const ScratchFolder folder;
  folder.write("RUN.UNRST", ecl::inte("SEQNUM", {0}) + ecl::real("PRESSURE", {1.F, 2.F}) + ecl::inte("SEQNUM", {3}) +
                                ecl::real("SWAT", {0.F, 0.F}) + ecl::real("PRESSURE", {3.F, 4.F}));
  const auto pressure = read_restart_array(folder.file("RUN"), "PRESSURE");
  ASSERT_TRUE(pressure);
  EXPECT_EQ(*pressure, (std::map<std::int32_t, std::vector<double>>{{0, {1.0, 2.0}}, {3, {3.0, 4.0}}}));
  EXPECT_FALSE(read_restart_array(folder.file("OTHER"), "PRESSURE"));
}

TEST(ReadRun, DamageEndsInAParseErrorOrARun) {
  const ScratchFolder folder;
  const auto survives = [&](const std::string& spec, const std::string& unsmry) {
    folder.write("RUN.SMSPEC", spec);
    folder.write("RUN.UNSMRY", unsmry);
    try {
      (void)read_summary(folder.file("RUN"));
    } catch (const ParseError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  };
  const std::string spec = specification();
  const std::string unsmry = steps();
  for (std::size_t length = 0; length < spec.size(); ++length) survives(spec.substr(0, length), unsmry);
  for (std::size_t length = 0; length < unsmry.size(); ++length) survives(spec, unsmry.substr(0, length));
  const unsigned seed = random_seed();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 chance(seed);
  for (int n = 0; n < 200; ++n) {
    std::string a = spec;
    std::string b = unsmry;
    a[chance() % a.size()] = static_cast<char>(chance());
    b[chance() % b.size()] = static_cast<char>(chance());
    survives(a, b);
  }
}

TEST(ReadRun, KnowsARunByAnyOfItsFiles) {
  EXPECT_EQ(run_stem("/a/RUN.DATA"), "/a/RUN");
  EXPECT_EQ(run_stem("/a/RUN.unsmry"), "/a/RUN");
  EXPECT_EQ(run_stem("/a/RUN.1"), "/a/RUN.1");
}

TEST(ReadRun, SaysWhichFileIsMissing) {
  const auto error = error_of([] { return read_summary("/nowhere/RUN"); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->where().file, "/nowhere/RUN.SMSPEC");
}

}  // namespace wellknit
