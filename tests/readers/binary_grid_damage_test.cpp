// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Every sample cut at 200 places and with bytes changed at random: it reads, or ends in ParseError, within time and
/// memory.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <filesystem>
#include <random>

#include "readers/describe.h"
#include "tests/readers/reader_helpers.h"
#include "tests/support/random_seed.h"
#include "tests/support/rounds.h"

namespace wellknit {
namespace {

constexpr int cuts = 200;
constexpr int flips = 1000;
constexpr std::size_t small_sample = 15'000;  // bytes; real ones are larger
// The address sanitizer keeps up to 256 MB of freed memory aside, and notes beside all of it.
constexpr long sanitizer_kb = has_few_rounds ? 400'000 : 0;
constexpr long most_growth_kb = 300'000 + sanitizer_kb;  // the largest sample has 1.4 MB

long peak_kb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

/// The project's own, and real ones where they are.
std::vector<std::filesystem::path> samples() {
  std::vector<std::filesystem::path> out;
  const char* variable = std::getenv("WELLKNIT_SHARED");
  const auto shared = std::filesystem::path(variable != nullptr ? variable : WELLKNIT_SHARED) / "data";
  for (const char* name : {"reek/REEK.EGRID", "reek/reek_sim.bgrdecl", "spe9/BENCH_SPE9.EGRID", "spe9/BENCH_SPE9.INIT"})
    if (std::filesystem::exists(shared / name)) out.push_back(shared / name);
  for (const char* folder : {"ecl", "roff"})
    for (const auto& entry : std::filesystem::directory_iterator(std::string(WELLKNIT_TESTDATA) + "/" + folder))
      if (entry.path().extension() != ".md" && entry.path().extension() != ".GRDECL") out.push_back(entry.path());
  std::sort(out.begin(), out.end());
  return out;
}

/// As CASE, and beside a grid of its own dimensions. True when both can be read.
bool reads(const std::string& bytes, const std::string& grid) {
  bool all = true;
  DeckLimits limits;
  limits.hashes_sources = false;
  for (const bool is_include : {false, true}) {
    if (is_include && bytes.size() > small_sample) continue;
    MemoryFiles copy({{"case", bytes}, {"grid", grid}});
    try {
      const Case read = is_include ? parse_case(copy, "grid", {"case"}, limits) : parse_case(copy, "case", {}, limits);
      validate(read.grid);
    } catch (const ParseError& error) {
      all = false;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  return all;
}

class DamagedGrids : public ::testing::TestWithParam<std::filesystem::path> {
 protected:
  void SetUp() override {
    bytes_ = std::string(load_file(GetParam().string()).text);
    grid_ = std::string(load_file(std::string(WELLKNIT_TESTDATA) + "/ecl/fault.GRDECL").text);
    before_ = peak_kb();
  }
  void TearDown() override { EXPECT_LT(peak_kb() - before_, most_growth_kb); }

  std::string bytes_;
  std::string grid_;
  long before_ = 0;
};

TEST_P(DamagedGrids, CutsEndInAnError) {
  int read = 0;
  for (int cut = 0; cut < cuts; ++cut)
    read += reads(bytes_.substr(0, bytes_.size() * static_cast<std::size_t>(cut) / cuts), grid_) ? 1 : 0;
  // What follows the geometry may be missing in an EGRID, cells in a GRID file, arrays in others: never most of it.
  if (bytes_.size() < small_sample) {
    EXPECT_LT(read, cuts / 2);
  }
}

TEST_P(DamagedGrids, ChangedBytesEndInAnErrorOrAGrid) {
  const unsigned seed = random_seed();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (int flip = 0; flip < flips; ++flip) {
    std::string damaged = bytes_;
    damaged[random() % damaged.size()] = static_cast<char>(random() & 0xFF);
    if (flip % 2 == 1) damaged[random() % damaged.size()] ^= static_cast<char>(1U << (random() % 8));
    (void)reads(damaged, grid_);
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, DamagedGrids, ::testing::ValuesIn(samples()), [](const auto& sample) {
  std::string name = sample.param.filename().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

}  // namespace
}  // namespace wellknit
