// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/well_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/errors.h"

namespace wellknit {
namespace {

TEST(WellPath, PassesThroughItsStations) {
  const Trajectory t{{0.0, 10.0, 25.0}, {{0, 0, 0}, {0, 0, 10}, {9, 0, 20}}};
  const WellPath path(t);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT((path.point(t.measured_depth[i]) - t.points[i]).norm(), 1e-12);
}

TEST(WellPath, IsStraightBetweenTwoStationsAndBeyondThem) {
  const WellPath path(Trajectory{{0.0, 10.0}, {{0, 0, 0}, {6, 0, 8}}});
  EXPECT_LT((path.point(5.0) - Vec3(3, 0, 4)).norm(), 1e-12);
  EXPECT_LT((path.point(-5.0) - Vec3(-3, 0, -4)).norm(), 1e-12);
  EXPECT_LT((path.point(20.0) - Vec3(12, 0, 16)).norm(), 1e-12);
}

TEST(WellPath, FollowsAnArcToThirdOrder) {
  // A quarter circle of radius 100 m by 10 stations: Hermite's error is of the order of (step/radius)^3.
  Trajectory t;
  for (int i = 0; i <= 9; ++i) {
    const double a = i * 0.1745;
    t.measured_depth.push_back(100 * a);
    t.points.emplace_back(100 * std::sin(a), 0, 100 * (1 - std::cos(a)));
  }
  const WellPath path(t);
  const Vec3 p = path.point(100 * 0.85);
  EXPECT_NEAR((p - Vec3(0, 0, 100)).norm(), 100.0, 100 * std::pow(0.1745, 3));
  EXPECT_NEAR(path.derivative(100 * 0.85).norm(), 1.0, 0.02);
}

TEST(WellPath, DerivativeIsContinuousAtAStation) {
  const WellPath path(Trajectory{{0.0, 10.0, 25.0}, {{0, 0, 0}, {0, 0, 10}, {9, 0, 20}}});
  EXPECT_LT((path.derivative(10.0 - 1e-9) - path.derivative(10.0 + 1e-9)).norm(), 1e-6);
}

TEST(WellPath, RefusesDepthThatDoesNotRise) {
  EXPECT_THROW(WellPath(Trajectory{{0.0, 0.0}, {{0, 0, 0}, {0, 0, 1}}}), InvalidInput);
  EXPECT_THROW(WellPath(Trajectory{{0.0}, {{0, 0, 0}}}), InvalidInput);
}

}  // namespace
}  // namespace wellknit
