// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/fit_to_grid.h"

#include <gtest/gtest.h>

#include "tests/readers/reader_helpers.h"

namespace wellknit {
namespace {

Well straight(const Vec3& from, const Vec3& to) {
  Well well;
  well.name = "W";
  well.trajectory = {{0.0, 1.0}, {from, to}};
  return well;
}

/// Boxes [0,4] x [0,3]; the grid's x axis is the map's north, its y axis the map's west, its origin at (1000, 2000).
CornerPointGrid turned_grid() {
  CornerPointGrid grid = case_of(unit_boxes(4, 3, 2)).grid;
  grid.mapaxes = {900, 2000, 1000, 2000, 1000, 2100};
  return grid;
}

TEST(FitToGrid, LeavesAWellThatMeetsTheGrid) {
  Well well = straight({1, 1, -5}, {1, 1, 1});
  EXPECT_FALSE(fit_to_grid(well, turned_grid()));
  EXPECT_EQ(well.trajectory.points[0], Vec3(1, 1, -5));
  Well across = straight({-5, 1, 0}, {9, 1, 0});
  EXPECT_FALSE(fit_to_grid(across, turned_grid())) << "no station is inside, but the path crosses";
}

TEST(FitToGrid, TurnsMapCoordinates) {
  // 3 north and 1 west of the origin: x 3, y 1 in the grid.
  Well well = straight({999, 2003, 0}, {998, 2002, 2});
  const auto note = fit_to_grid(well, turned_grid());
  ASSERT_TRUE(note);
  EXPECT_NE(note->find("with MAPAXES"), std::string::npos);
  EXPECT_LT((well.trajectory.points[0] - Vec3(3, 1, 0)).norm(), 1e-9);
  EXPECT_LT((well.trajectory.points[1] - Vec3(2, 2, 2)).norm(), 1e-9);
  EXPECT_EQ(well.trajectory.measured_depth[1], 1.0);
}

TEST(FitToGrid, SaysWhenAWellFitsNeitherWay) {
  Well well = straight({500, 500, 0}, {501, 501, 2});
  const auto note = fit_to_grid(well, turned_grid());
  ASSERT_TRUE(note);
  EXPECT_EQ(
      *note,
      "well W: it lies outside the grid: x 500 to 501 m, y 500 to 501 m, but the grid has x 0 to 4 m, y 0 to 3 m; "
      "check units and coordinates");
  EXPECT_EQ(well.trajectory.points[0], Vec3(500, 500, 0));
}

TEST(FitToGrid, TakesNoAxesThatAreNone) {
  CornerPointGrid grid = turned_grid();
  grid.mapaxes = {0, 0, 0, 0, 0, 0};
  Well well = straight({500, 500, 0}, {501, 501, 2});
  EXPECT_TRUE(fit_to_grid(well, grid));
  EXPECT_EQ(well.trajectory.points[0], Vec3(500, 500, 0));
}

}  // namespace
}  // namespace wellknit
