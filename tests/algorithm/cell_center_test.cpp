// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/cell_center.h"

#include <gtest/gtest.h>

#include <vector>

namespace wellknit {
namespace {

std::vector<OutwardFace> box(double x, double y, double z) {
  return {{{0, y / 2, z / 2}, {-y * z, 0, 0}}, {{x, y / 2, z / 2}, {y * z, 0, 0}},  {{x / 2, 0, z / 2}, {0, -x * z, 0}},
          {{x / 2, y, z / 2}, {0, x * z, 0}},  {{x / 2, y / 2, 0}, {0, 0, -x * y}}, {{x / 2, y / 2, z}, {0, 0, x * y}}};
}

TEST(CellCenter, HeightIsTheDistanceToTheNearestWall) {
  EXPECT_DOUBLE_EQ(smallest_height(box(4, 6, 8), {1.0, 3.0, 4.0}), 1.0);
  EXPECT_DOUBLE_EQ(smallest_height(box(4, 6, 8), {-0.5, 3.0, 4.0}), -0.5);
}

TEST(CellCenter, ComesInFromOutside) {
  const auto p = point_that_sees_all(box(4, 6, 8), {50.0, -20.0, 4.0}, 5.0);
  ASSERT_TRUE(p);
  EXPECT_GT(smallest_height(box(4, 6, 8), *p), 0.0);
}

TEST(CellCenter, SaysWhenNoPointSeesAll) {
  auto faces = box(4, 6, 8);
  faces.push_back({{5.0, 3.0, 4.0}, {-1.0, 0.0, 0.0}});  // asks for x > 5
  EXPECT_FALSE(point_that_sees_all(faces, {2.0, 3.0, 4.0}, 5.0));
}

}  // namespace
}  // namespace wellknit
