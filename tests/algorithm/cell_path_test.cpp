// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/cell_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "readers/read_case.h"
#include "readers/read_trajectory.h"
#include "tests/support/grids.h"

namespace wellknit {
namespace {

Trajectory straight(const std::vector<Vec3>& points) {
  Trajectory out;
  double md = 0.0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (p > 0) md += (points[p] - points[p - 1]).norm();
    out.points.push_back(points[p]);
    out.measured_depth.push_back(md);
  }
  return out;
}

std::vector<CellPart> parts_in(const CornerPointGrid& grid, const Trajectory& trajectory) {
  const CellLocator locator(grid);
  return cells_along(grid, locator, trajectory);
}

/// Parts follow each other without holes and add up to the stretch between the first entry and the last exit.
void expect_gapless(const std::vector<CellPart>& parts) {
  for (std::size_t p = 1; p < parts.size(); ++p) {
    EXPECT_NEAR(parts[p].measured_depth.from, parts[p - 1].measured_depth.to, 1e-9);
    EXPECT_LT((parts[p].entry - parts[p - 1].exit).norm(), 1e-9);
  }
}

TEST(CellPath, CutsAVerticalWellAtTheLayers) {
  const auto grid = grids::box({3, 3, 3});
  // 100 m of well above the grid's top at 1000 m and 35 m below its base at 1015 m.
  const auto parts = parts_in(grid, straight({Vec3(15, 30, 900), Vec3(15, 30, 1050)}));
  ASSERT_EQ(parts.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    const double top = 100.0 + 5.0 * static_cast<double>(k);
    EXPECT_EQ(parts[k].cell, grid.cell_id(1, 1, static_cast<std::int64_t>(k)));
    EXPECT_NEAR(parts[k].measured_depth.from, top, 1e-6);
    EXPECT_NEAR(parts[k].measured_depth.to, top + 5.0, 1e-6);
    EXPECT_LT((parts[k].entry - Vec3(15, 30, 900.0 + top)).norm(), 1e-6);
    EXPECT_LT((parts[k].exit - Vec3(15, 30, 905.0 + top)).norm(), 1e-6);
  }
}

/// A path may be so long that neighbouring numbers on it are further apart than the accuracy that is asked for.
TEST(CellPath, EndsOnPathsOfAnyLength) {
  const auto grid = grids::box({3, 3, 3});
  for (const double half : {1e6, 1e9, 1e12, 1e15}) {
    const auto parts = parts_in(grid, straight({Vec3(15.0 - half, 30, 1007.5), Vec3(15.0 + half, 30, 1007.5)}));
    if (half > 1e10) continue;  // a grid of 30 m is within the rounding of such positions
    ASSERT_EQ(parts.size(), 3U) << half;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(parts[i].cell, grid.cell_id(static_cast<std::int64_t>(i), 1, 1));
  }
}

TEST(CellPath, FollowsADeviatedWellThroughThreeColumns) {
  const auto grid = grids::box({3, 1, 3});
  // x from 0 to 30 while the depth goes from 1000 to 1015: the diagonal crosses a column's side and a layer at once
  // every 10 m.
  const auto parts = parts_in(grid, straight({Vec3(0, 10, 1000), Vec3(30, 10, 1015)}));
  ASSERT_EQ(parts.size(), 3U);
  double length = 0.0;
  for (std::int64_t n = 0; n < 3; ++n) {
    const CellPart& part = parts[static_cast<std::size_t>(n)];
    EXPECT_EQ(part.cell, grid.cell_id(n, 0, n));
    length += (part.exit - part.entry).norm();
  }
  EXPECT_NEAR(length, std::sqrt(30.0 * 30.0 + 15.0 * 15.0), 1e-5);
  expect_gapless(parts);
}

TEST(CellPath, MeasuredDepthMayRunFasterThanThePolyline) {
  const auto grid = grids::box({1, 1, 2});
  Trajectory trajectory{{500.0, 522.0}, {Vec3(5, 10, 1000), Vec3(5, 10, 1010)}};  // 2.2 m measured a metre
  const auto parts = parts_in(grid, trajectory);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR(parts[0].measured_depth.to, 511.0, 1e-5);
}

TEST(CellPath, HasNoPartInGapsAndOutside) {
  const auto grid = grids::with_gap({1, 1, 2});  // cells 1000 to 1005 and 1006 to 1011 m
  const auto parts = parts_in(grid, straight({Vec3(5, 10, 0), Vec3(5, 10, 2000)}));
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR(parts[0].measured_depth.to, 1005.0, 1e-6);
  EXPECT_NEAR(parts[1].measured_depth.from, 1006.0, 1e-6);
  EXPECT_TRUE(parts_in(grid, straight({Vec3(500, 10, 0), Vec3(500, 10, 2000)})).empty());
  EXPECT_TRUE(parts_in(grid, straight({Vec3(5, 10, 0), Vec3(5, 10, 999)})).empty());
}

TEST(CellPath, SkipsCellsWithoutThickness) {
  const auto grid = grids::pinched({1, 1, 3}, true, false);
  const auto parts = parts_in(grid, straight({Vec3(5, 10, 999), Vec3(5, 10, 1020)}));
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].cell, HostCellId(0));
  EXPECT_EQ(parts[1].cell, HostCellId(2));
  expect_gapless(parts);
}

TEST(CellPath, FindsLayersOfAMillimetre) {
  auto grid = grids::box({1, 1, 3});
  for (int corner = 0; corner < 4; ++corner) {
    grid.zcorn[grid.zcorn_index({0, 0, 1}, corner & 1, corner >> 1, 1)] = 1005.001;
    grid.zcorn[grid.zcorn_index({0, 0, 2}, corner & 1, corner >> 1, 0)] = 1005.001;
  }
  const auto parts = parts_in(grid, straight({Vec3(5, 10, 1001), Vec3(5, 10, 1010)}));
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_NEAR(parts[1].measured_depth.to - parts[1].measured_depth.from, 1e-3, 1e-6);
}

TEST(CellPath, LosesNoLengthInTwistedFaultedGrids) {
  constexpr std::uint32_t seed = 20263;
  SCOPED_TRACE(seed);
  std::mt19937 engine(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(engine()) / 4294967296.0);
  };
  const auto grid = grids::twisted_fault({4, 4, 8}, 8.0);
  const CellLocator locator(grid);
  for (int trial = 0; trial < 50; ++trial) {  // inside of all columns' depths: about 1012 to 1028 m
    const auto end = [&] { return Vec3(uniform(5, 35), uniform(10, 70), uniform(1013, 1027)); };
    const Trajectory trajectory = straight({end(), end(), end()});
    const auto parts = cells_along(grid, locator, trajectory);
    double length = 0.0;
    for (const CellPart& part : parts) {
      length += part.measured_depth.to - part.measured_depth.from;
      const auto middle = locator.locate(0.5 * (part.entry + part.exit));
      ASSERT_TRUE(middle);
    }
    EXPECT_NEAR(length, trajectory.measured_depth.back(), 1e-4) << "trial " << trial;
    expect_gapless(parts);
  }
}

TEST(CellPath, PassesTheWorkedExampleOfNwm) {
  const std::string folder = std::string(WELLKNIT_SHARED) + "/data/nwm/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  const auto grid = read_case(folder + "NWM.data").grid;
  const auto wells = read_trajectory(folder + "trajectory.csv").wells;
  ASSERT_EQ(wells.size(), 1U);
  const auto parts = parts_in(grid, wells[0].trajectory);
  ASSERT_FALSE(parts.empty());
  double covered = 0.0;
  for (const CellPart& part : parts) covered += (part.exit - part.entry).norm();
  double whole = 0.0;
  for (std::size_t p = 1; p < wells[0].trajectory.points.size(); ++p)
    whole += (wells[0].trajectory.points[p] - wells[0].trajectory.points[p - 1]).norm();
  EXPECT_NEAR(covered / whole, 1.0, 1e-6);  // the example's well lies in the reservoir over its whole length
}

}  // namespace
}  // namespace wellknit
