// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/untangle.h"

#include <gtest/gtest.h>

namespace wellknit {
namespace {

/// The six values "distance from a wall" of the unit cube; the best position is its centre, where all are 0.5.
VertexBall cube() {
  VertexBall ball;
  for (int axis = 0; axis < 3; ++axis) {
    ball.offset.push_back(0.0);
    ball.gradient.push_back(Vec3::Unit(axis));
    ball.offset.push_back(1.0);
    ball.gradient.push_back(-Vec3::Unit(axis));
  }
  return ball;
}

TEST(Untangle, FindsTheCentreOfACube) {
  const Vec3 p = largest_smallest_value(cube(), 0.5, {7.0, -3.0, 0.2});
  EXPECT_GT(cube().smallest(p), 0.45);
}

TEST(Untangle, StopsOnTheEdgeOfTheFeasibleSetForBetaZero) {
  const Vec3 p = minimise_shortfall(cube(), 0.0, {2.0, 0.5, 0.5});
  EXPECT_NEAR(p.x(), 1.0, 1e-6);
}

TEST(Untangle, PaperPositionEntersTheFeasibleSet) {
  const Vec3 p = paper_position(cube(), {2.0, 0.5, 0.5});
  EXPECT_GT(cube().smallest(p), 1e-3);
}

TEST(Untangle, PaperPositionLeavesAVertexWithoutAPlace) {
  VertexBall ball = cube();
  ball.offset.push_back(-2.0);  // x >= 2 contradicts x <= 1
  ball.gradient.push_back(Vec3::UnitX());
  const Vec3 start(0.3, 0.4, 0.5);
  EXPECT_EQ(paper_position(ball, start), start);
}

TEST(Untangle, WithoutAFeasiblePlaceTheShortfallIsLeast) {
  VertexBall ball = cube();
  ball.offset.push_back(-2.0);
  ball.gradient.push_back(Vec3::UnitX());
  const Vec3 p = largest_smallest_value(ball, 0.5, {0.1, 0.5, 0.5});
  EXPECT_NEAR(p.x(), 1.5, 0.05);  // between x <= 1 and x >= 2
}

}  // namespace
}  // namespace wellknit
