// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Real binary grids against a reader of their own in Python (check_binary_grid.py). They are not part of the project:
/// without the folder WELLKNIT_SHARED the tests are skipped.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "model/units.h"
#include "readers/describe.h"
#include "readers/read_case.h"
#include "tests/readers/reader_helpers.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

class PublicBinary : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* variable = std::getenv("WELLKNIT_SHARED");
    folder_ = std::filesystem::path(variable != nullptr ? variable : WELLKNIT_SHARED) / "data";
    if (!std::filesystem::is_directory(folder_)) GTEST_SKIP() << "no folder " << folder_;
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }

  /// Leaves the arrays, in SI and raw, for the other reader to compare with the file's own.
  void expect_as_in_python(const std::string& name, const CornerPointGrid& grid) const {
    const ScratchFolder scratch;
    const auto write = [&](const std::string& array, const auto& values) {
      scratch.write(array, {reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]});
    };
    write("COORD.f8", grid.coord);
    write("ZCORN.f8", grid.zcorn);
    write("ACTNUM.u1", grid.active);
    if (!grid.porosity.empty()) write("PORO.f8", grid.porosity);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!grid.permeability[axis].empty()) write(std::string("PERM") + "XYZ"[axis] + ".f8", grid.permeability[axis]);
    for (const auto& [key, property] : grid.properties)
      if (const auto* integers = std::get_if<std::vector<std::int32_t>>(&property)) write(key + ".i4", *integers);
    const std::string command = std::string(WELLKNIT_PYTHON) + " " + WELLKNIT_SOURCE_DIR +
                                "/tests/readers/check_binary_grid.py " + file(name) + " " + scratch.path().string();
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
  }

  std::filesystem::path folder_;
};

/// The largest differences of two grids: of corner depths, and of corner positions along x and y.
std::array<double, 3> largest_differences(const CornerPointGrid& a, const CornerPointGrid& b) {
  std::array<double, 3> out{};
  for (std::int64_t cell = 0; cell < a.cell_count(); ++cell) {
    const auto corners = a.corners(HostCellId(cell));
    const auto others = b.corners(HostCellId(cell));
    for (std::size_t c = 0; c < 8; ++c)
      for (std::size_t axis = 0; axis < 3; ++axis)
        out[axis] = std::max(out[axis], std::abs(corners[c][static_cast<Eigen::Index>(axis)] -
                                                 others[c][static_cast<Eigen::Index>(axis)]));
  }
  return out;
}

TEST_F(PublicBinary, ReekIsOneGridInTextAndInBinary) {
  const Case text = read_case(file("reek/reek_sim.grdecl"));
  const Case binary = read_case(file("reek/reek_sim.bgrdecl"));
  EXPECT_EQ(binary.grid.dimensions, text.grid.dimensions);
  EXPECT_EQ(binary.grid.active, text.grid.active);
  const auto off = largest_differences(text.grid, binary.grid);
  // Text has 3 decimals, binary single precision: 1/32 m in x of 4.6e5, 1/2 m in y of 5.9e6, 1/8192 m in depths of 2e3,
  // each rounded by half of that; on a pillar extended beyond its points the error grows, here by less than 2.
  EXPECT_LT(off[0], 2 * (1.0 / 64 + 0.0005));
  EXPECT_LT(off[1], 2 * (0.25 + 0.0005));
  EXPECT_LT(off[2], 1.0 / 16384 + 0.0005);
}

TEST_F(PublicBinary, ReekAsEgridIsThatFieldInItsOwnFrame) {
  const CornerPointGrid egrid = read_case(file("reek/REEK.EGRID")).grid;
  EXPECT_EQ(egrid.dimensions, (std::array<std::int64_t, 3>{40, 64, 14}));
  ASSERT_TRUE(egrid.mapaxes);
  expect_as_in_python("reek/REEK.EGRID", egrid);
}

TEST_F(PublicBinary, BinaryGrdeclAsInPython) {
  for (const char* name : {"reek/reek_sim.bgrdecl", "odd/sixcells2_hdr2.bgrdecl"})
    expect_as_in_python(name, read_case(file(name)).grid);
}

TEST_F(PublicBinary, SixCellsAreOneGridInTextAndInBinary) {
  const CornerPointGrid text = read_case(file("odd/sixcells2_hdr2.grdecl")).grid;
  const CornerPointGrid binary = read_case(file("odd/sixcells2_hdr2.bgrdecl")).grid;
  EXPECT_EQ(binary.coord, text.coord) << "all numbers are exact in single precision";
  EXPECT_EQ(binary.zcorn, text.zcorn);
  EXPECT_EQ(binary.active, text.active);
  EXPECT_EQ(binary.mapaxes, text.mapaxes);
}

TEST_F(PublicBinary, Spe9HasItsPropertiesFromInit) {
  const Case read = read_case(file("spe9/BENCH_SPE9.EGRID"));
  EXPECT_EQ(read.grid.units, UnitSystem::field);
  EXPECT_EQ(read.sources.size(), 2U);
  expect_as_in_python("spe9/BENCH_SPE9.EGRID", read.grid);
  expect_as_in_python("spe9/BENCH_SPE9.INIT", read.grid);
  // The deck of the same model, by its own reader of text.
  const Case deck = read_case(file("spe9/SPE9_CP.DATA"));
  const double volume = describe(deck.grid).bulk_volume;
  EXPECT_NEAR(describe(read.grid).bulk_volume, volume, 1e-5 * volume) << "depths of 9000 ft in single precision";
  ASSERT_EQ(read.grid.permeability[0].size(), deck.grid.permeability[0].size());
  for (std::size_t cell = 0; cell < deck.grid.porosity.size(); ++cell) {
    EXPECT_NEAR(read.grid.porosity[cell], deck.grid.porosity[cell], 1e-7 * deck.grid.porosity[cell]);
    EXPECT_NEAR(read.grid.permeability[0][cell], deck.grid.permeability[0][cell],
                1e-7 * deck.grid.permeability[0][cell]);
  }
}

}  // namespace
}  // namespace wellknit
