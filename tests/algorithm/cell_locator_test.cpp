// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/cell_locator.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/grids.h"

namespace wellknit {
namespace {

double uniform(std::mt19937& engine) { return static_cast<double>(engine()) / 4294967296.0; }

bool has_thickness(const CornerPointGrid& grid, HostCellId cell) {
  const auto c = grid.corners(cell);
  return std::abs(bilinear_hexahedron_volume(c)) > 1e-3;
}

TEST(CellLocator, FindsEveryCellOfTheZooFromPointsInsideIt) {
  constexpr std::uint32_t seed = 20262;
  SCOPED_TRACE(seed);
  std::mt19937 engine(seed);
  for (const auto& [name, grid] : grids::zoo()) {
    if (name == "random faults") continue;  // its cells overlap
    const CellLocator locator(grid);
    for (std::int64_t c = 0; c < grid.cell_count(); ++c) {
      if (!has_thickness(grid, HostCellId(c))) continue;
      const auto corners = grid.corners(HostCellId(c));
      for (int trial = 0; trial < 5; ++trial) {
        const Vec3 uvw = Vec3(uniform(engine), uniform(engine), uniform(engine)) * 0.8 + Vec3::Constant(0.1);
        const auto found = locator.locate(trilinear(corners, uvw));
        ASSERT_TRUE(found) << name << " cell " << c;
        EXPECT_EQ(found->cell.value(), c) << name;
        EXPECT_LT((found->uvw - uvw).norm(), 1e-7) << name << " cell " << c;
      }
    }
  }
}

TEST(CellLocator, GivesAPointOnAFaceToTheSmallestIdWhateverTheHint) {
  const auto grid = grids::box({3, 3, 3});
  const CellLocator locator(grid);
  const Vec3 corner(10.0, 20.0, 1005.0);  // eight cells touch here: (0,0,0) to (1,1,1)
  for (const std::int64_t hint :
       {std::int64_t{-1}, std::int64_t{0}, std::int64_t{4}, std::int64_t{13}, std::int64_t{26}}) {
    const auto found = locator.locate(corner, HostCellId(hint));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->cell, HostCellId(0));
    EXPECT_LT((found->uvw - Vec3::Ones()).norm(), 1e-9);
  }
  const auto inside = locator.locate(Vec3(15.0, 30.0, 1007.0), HostCellId(26));  // a wrong hint costs nothing but time
  ASSERT_TRUE(inside);
  EXPECT_EQ(inside->cell, grid.cell_id(1, 1, 1));
}

TEST(CellLocator, FindsNothingOutsideAndInGaps) {
  const auto grid = grids::with_gap({3, 3, 3});
  const CellLocator locator(grid);
  EXPECT_FALSE(locator.locate(Vec3(15.0, 30.0, 1005.5)));  // layer 0 ends at 1005 m, layer 1 starts at 1006 m
  EXPECT_TRUE(locator.locate(Vec3(15.0, 30.0, 1004.5)));
  EXPECT_TRUE(locator.locate(Vec3(15.0, 30.0, 1006.5)));
  EXPECT_FALSE(locator.locate(Vec3(15.0, 30.0, 999.0)));
  EXPECT_FALSE(locator.locate(Vec3(15.0, 30.0, 1017.0)));
  EXPECT_FALSE(locator.locate(Vec3(-1.0, 30.0, 1004.0)));
  EXPECT_FALSE(locator.locate(Vec3(1e9, 1e9, 1004.0)));
  EXPECT_FALSE(locator.locate(Vec3(std::nan(""), 1.0, 1004.0)));
}

TEST(CellLocator, LeavesNoHoleAlongAFaultBetweenSkewPillars) {
  // Depths well inside of both columns, points all along the fault's surface: every one is in some cell.
  const auto grid = grids::twisted_fault({4, 4, 8}, 8.0);
  const CellLocator locator(grid);
  for (std::int64_t j = 0; j < 4; ++j) {
    for (double z = 1012.0; z < 1028.0; z += 0.37) {
      for (double s = 0.01; s < 1.0; s += 0.07) {
        const Vec3 point = (1.0 - s) * grid.pillar_point(2, j, z) + s * grid.pillar_point(2, j + 1, z);
        for (const double off : {-0.05, -1e-4, 0.0, 1e-4, 0.05})
          EXPECT_TRUE(locator.locate(point + Vec3(off, 0.0, 0.0))) << j << ' ' << z << ' ' << s << ' ' << off;
      }
    }
  }
}

TEST(CellLocator, IgnoresCellsWithoutThickness) {
  const auto grid = grids::pinched({2, 2, 3}, true, false);  // layer 1 lies flat at 1005 m
  const CellLocator locator(grid);
  const auto on_it = locator.locate(Vec3(5.0, 10.0, 1005.0));
  ASSERT_TRUE(on_it);
  EXPECT_EQ(on_it->cell, grid.cell_id(0, 0, 0));
  const auto below = locator.locate(Vec3(5.0, 10.0, 1005.1));
  ASSERT_TRUE(below);
  EXPECT_EQ(below->cell, grid.cell_id(0, 0, 2));
}

}  // namespace
}  // namespace wellknit
