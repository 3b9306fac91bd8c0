// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/horizon.h"

#include <gtest/gtest.h>

#include "tests/support/grids.h"
#include "tests/support/near_well.h"
#include "tests/support/near_well_setting.h"

namespace wellknit {
namespace {

TEST(Horizon, OfABoxIsFlat) {
  const near_well::Setting setting(grids::box({4, 4, 3}, {10.0, 20.0, 5.0}));
  for (std::int64_t level = 0; level <= 3; ++level) {
    const auto p = Horizon(setting.near, level).at(33.0, 7.0, {0, 3});
    ASSERT_TRUE(p);
    EXPECT_EQ(p->column, (std::array<std::int64_t, 2>{3, 0}));
    EXPECT_NEAR(p->point.z(), 1000.0 + 5.0 * static_cast<double>(level), 1e-9);
    EXPECT_NEAR(p->u, 0.3, 1e-12);
    EXPECT_NEAR(p->v, 0.35, 1e-12);
  }
}

TEST(Horizon, PassesThroughTheCornersOfADeformedGrid) {
  const near_well::Setting setting(near_well::deformed(1.0).grid);
  const Horizon horizon(setting.near, 5);
  for (const auto& column : {std::array<std::int64_t, 2>{3, 4}, {10, 10}, {15, 2}}) {
    const auto corners = horizon.patch(column);
    const Vec3 middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
    const auto p = horizon.at(middle.x(), middle.y(), {9, 9});
    ASSERT_TRUE(p);
    EXPECT_EQ(p->column, column);
    EXPECT_NEAR(p->point.z(), middle.z(), 1e-9);
  }
}

TEST(Horizon, HasNoPointOutsideOfTheGrid) {
  const near_well::Setting setting(grids::box({4, 4, 3}));
  EXPECT_FALSE(Horizon(setting.near, 1).at(-1.0, 5.0, {2, 2}));
  EXPECT_FALSE(Horizon(setting.near, 1).at(1e6, 5.0, {2, 2}));
}

}  // namespace
}  // namespace wellknit
