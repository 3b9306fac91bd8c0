// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/reference_space.h"

#include <gtest/gtest.h>

#include "tests/support/grids.h"
#include "tests/support/near_well_setting.h"

namespace wellknit {
namespace {

TEST(ReferenceSpace, OfABoxHasItsSpacings) {
  const CornerPointGrid grid = grids::box({3, 4, 5}, {10.0, 20.0, 5.0});
  const near_well::Setting setting(grid);
  const ReferenceSpace& space = setting.space;
  EXPECT_DOUBLE_EQ(space.plane(0, 3) - space.plane(0, 0), 30.0);
  EXPECT_DOUBLE_EQ(space.plane(1, 4) - space.plane(1, 0), 80.0);
  EXPECT_DOUBLE_EQ(space.plane(2, 5) - space.plane(2, 0), 25.0);
}

TEST(ReferenceSpace, FollowsThePathItIsMadeFor) {
  // Each layer is as thick as its column number plus one: a path that steps down one layer a column sees 1, 2, 3 … m.
  grids::Recipe recipe;
  recipe.dimensions = {5, 1, 5};
  recipe.pillar = [](std::int64_t i, std::int64_t j) {
    const double x = 10.0 * static_cast<double>(i);
    const double y = 10.0 * static_cast<double>(j);
    return std::array<Vec3, 2>{Vec3(x, y, 1000.0), Vec3(x, y, 1040.0)};
  };
  recipe.depth = [](std::array<std::int64_t, 3> at, std::array<int, 3> corner) {
    return 1000.0 + static_cast<double>((at[0] + 1) * (at[2] + corner[2]));
  };
  const near_well::Setting setting(grids::make(recipe));
  const CellRange all{{0, 0, 0}, {5, 1, 5}};
  const ReferenceSpace mean(setting.near, all);
  for (std::int64_t k = 0; k < 5; ++k) EXPECT_NEAR(mean.plane(2, k + 1) - mean.plane(2, k), 3.0, 1e-9);
  const ReferenceSpace along(setting.near, all, {{0, 0, 0}, {1, 0, 1}, {2, 0, 2}, {3, 0, 3}, {4, 0, 4}});
  // Over the path's column and those beside it: 1.5, 2, 3, 4 and 4.5 m.
  const std::array thickness{1.5, 2.0, 3.0, 4.0, 4.5};
  for (std::size_t k = 0; k < 5; ++k) {
    const auto at = static_cast<std::int64_t>(k);
    EXPECT_NEAR(along.plane(2, at + 1) - along.plane(2, at), thickness[k], 1e-9);
  }
}

TEST(ReferenceSpace, RunsBackwardsAlongJInALeftHandedGrid) {
  const CornerPointGrid grid = grids::left_handed({3, 3, 3});
  const near_well::Setting setting(grid);
  const ReferenceSpace& space = setting.space;
  EXPECT_LT(space.plane(1, 3), space.plane(1, 0));
  EXPECT_LT(space.box({0, 0, 0}).low.y(), space.box({0, 0, 0}).high.y());
}

TEST(ReferenceSpace, PlaceInvertsThePlanes) {
  for (const bool is_left : {false, true}) {
    const CornerPointGrid grid = is_left ? grids::left_handed({4, 4, 4}) : grids::box({4, 4, 4});
    const near_well::Setting setting(grid);
    const ReferenceSpace& space = setting.space;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = 0.25 * space.plane(axis, 2) + 0.75 * space.plane(axis, 3);
      const auto [index, fraction] = space.place(axis, x);
      EXPECT_EQ(index, 2);
      EXPECT_NEAR(fraction, 0.75, 1e-12);
    }
  }
}

TEST(ReferenceSpace, MirrorImagesAreExact) {
  const CornerPointGrid grid = grids::twisted({4, 4, 4});
  const near_well::Setting setting(grid);
  const ReferenceSpace& space = setting.space;
  const double plane = space.plane(2, 4);
  const double x = on_reference_lattice(3.14159);
  EXPECT_EQ(2.0 * plane - (2.0 * plane - x), x);
}

}  // namespace
}  // namespace wellknit
