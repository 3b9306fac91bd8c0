// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/trilinear.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/grids.h"

namespace wellknit {
namespace {

double uniform(std::mt19937& engine) { return static_cast<double>(engine()) / 4294967296.0; }

TEST(Trilinear, MeetsCornersAndMiddle) {
  const auto corners = grids::twisted({2, 2, 2}).corners(HostCellId(0));
  Vec3 mean = Vec3::Zero();
  for (int c = 0; c < 8; ++c) {
    const auto at = static_cast<std::size_t>(c);
    EXPECT_LT((trilinear(corners, Vec3(c & 1, (c >> 1) & 1, c >> 2)) - corners[at]).norm(), 1e-12);
    mean += corners[at] / 8.0;
  }
  EXPECT_LT((trilinear(corners, Vec3::Constant(0.5)) - mean).norm(), 1e-12);
}

TEST(Trilinear, InverseReturnsThePlaceInRandomHexahedra) {
  constexpr std::uint32_t seed = 20261;
  SCOPED_TRACE(seed);
  std::mt19937 engine(seed);
  for (int trial = 0; trial < 2000; ++trial) {
    auto corners = grids::box({1, 1, 1}, Vec3(10, 10, 0.1 + 9.9 * uniform(engine))).corners(HostCellId(0));
    const double thickness = corners[4][2] - corners[0][2];
    for (Vec3& c : corners)
      c += Vec3(2.0 * uniform(engine) + 4e5, 2.0 * uniform(engine) + 6e6, 0.4 * thickness * uniform(engine));
    const Vec3 uvw(uniform(engine), uniform(engine), uniform(engine));
    const auto found = inverse_trilinear(corners, trilinear(corners, uvw));
    ASSERT_TRUE(found) << "trial " << trial;
    // Coordinates of 6e6 m are known to 1e-9 m: 1e-8 of the thinnest cell, 0.06 m, or a little more where the cell is
    // skewed.
    EXPECT_LT((*found - uvw).cwiseAbs().maxCoeff(), 2e-7) << "trial " << trial;
  }
}

TEST(Trilinear, InverseExtrapolatesOutside) {
  const auto corners = grids::box({1, 1, 1}, Vec3(10, 20, 5)).corners(HostCellId(0));
  const auto found = inverse_trilinear(corners, Vec3(15.0, -10.0, 1002.5));
  ASSERT_TRUE(found);
  EXPECT_LT((*found - Vec3(1.5, -0.5, 0.5)).norm(), 1e-12);  // 15 / 10, -10 / 20, 2.5 / 5
}

TEST(Trilinear, InverseWorksOnACollapsedEdge) {
  const auto corners = grids::wedge({1, 1, 1}).corners(HostCellId(0));  // no thickness at u = 0
  for (const double u : {0.0, 1e-6, 0.25, 1.0}) {
    const Vec3 point = trilinear(corners, Vec3(u, 0.3, 0.6));
    const auto found = inverse_trilinear(corners, point);
    ASSERT_TRUE(found) << u;
    EXPECT_LT((trilinear(corners, *found) - point).norm(), 1e-9) << u;
    EXPECT_NEAR((*found)[0], u, 1e-9);
  }
}

TEST(Trilinear, InverseFindsNothingWhereThereIsNothing) {
  auto corners = grids::box({1, 1, 1}).corners(HostCellId(0));
  for (std::size_t c = 4; c < 8; ++c) corners[c] = corners[c - 4];  // no thickness
  EXPECT_FALSE(inverse_trilinear(corners, Vec3(5.0, 5.0, 1002.0)));
}

}  // namespace
}  // namespace wellknit
