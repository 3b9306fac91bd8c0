// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/cell_center.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
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

TEST(CellCenter, FindsTheDeepestPointOfABox) {
  // The largest ball in a box of 4 x 6 x 8 m has a radius of 2 m, with its centre at x = 2.
  for (const Vec3& start : {Vec3(1.0, 1.0, 1.0), Vec3(50.0, -20.0, 4.0)}) {
    const DeepestPoint deepest = deepest_point(box(4, 6, 8), start, 5.0);
    EXPECT_NEAR(deepest.height, 2.0, 1e-9);
    EXPECT_NEAR(deepest.point.x(), 2.0, 1e-9);
  }
}

TEST(CellCenter, FindsAKernelThatIsATenThousandthOfTheCell) {
  auto faces = box(4, 6, 8);
  faces.push_back({{3.9995, 3.0, 4.0}, {-1.0, 0.0, 0.0}});  // x > 3.9995
  const auto p = point_that_sees_all(faces, {0.5, 1.0, 1.0}, 5.0);
  ASSERT_TRUE(p);
  // At least half of the largest height, which is half of the gap.
  EXPECT_GE(smallest_height(faces, *p), 0.000125 - 1e-12);
  EXPECT_LE(smallest_height(faces, *p), 0.00025 + 1e-12);
}

TEST(CellCenter, OfRandomHalfSpacesNoPointIsDeeper) {
  constexpr unsigned seed = 11;
  SCOPED_TRACE(seed);
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<OutwardFace> faces = box(2, 2, 2);
    for (int f = 0; f < 20; ++f) {
      const Vec3 n = Vec3(normal(generator), normal(generator), normal(generator)).normalized();
      faces.push_back({Vec3(1, 1, 1) + (0.3 + 0.2 * normal(generator)) * n, n});
    }
    const DeepestPoint deepest = deepest_point(faces, {0.2, 0.2, 0.2}, 2.0);
    for (int sample = 0; sample < 200; ++sample) {
      const Vec3 d(normal(generator), normal(generator), normal(generator));
      EXPECT_LE(smallest_height(faces, deepest.point + std::pow(10.0, -0.03 * sample) * d), deepest.height + 1e-9);
    }
  }
}

TEST(CellCenter, SaysWhenNoPointSeesAll) {
  auto faces = box(4, 6, 8);
  faces.push_back({{5.0, 3.0, 4.0}, {-1.0, 0.0, 0.0}});  // asks for x > 5
  EXPECT_FALSE(point_that_sees_all(faces, {2.0, 3.0, 4.0}, 5.0));
}

}  // namespace
}  // namespace wellknit
