// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/minimum_curvature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace wellknit {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// Stations of a circle of this radius in the vertical plane of an azimuth, from straight down to an inclination.
std::vector<SurveyStation> arc_stations(double radius, double azimuth, double to_inclination, int parts) {
  std::vector<SurveyStation> out;
  for (int n = 0; n <= parts; ++n) {
    const double inclination = to_inclination * n / parts;
    out.push_back({radius * inclination, inclination, azimuth});
  }
  return out;
}

/// Where that circle is: its centre lies one radius along the azimuth, at the depth of the start.
Vec3 on_circle(double radius, double azimuth, double angle) {
  const double out = radius * (1.0 - std::cos(angle));
  return {out * std::sin(azimuth), out * std::cos(azimuth), radius * std::sin(angle)};
}

TEST(MinimumCurvature, IsTheCircleArcExactly) {
  for (const double azimuth : {0.0, 37.0 * degree, 250.0 * degree}) {
    for (const int parts : {1, 3, 40}) {
      const auto path = minimum_curvature(arc_stations(286.0, azimuth, 90.0 * degree, parts), Vec3(5, 6, 7));
      EXPECT_GE(path.size(), 19U) << "90 degrees in turns of 5";
      for (const SurveyPoint& at : path) {
        const Vec3 exact = Vec3(5, 6, 7) + on_circle(286.0, azimuth, at.measured_depth / 286.0);
        EXPECT_LT((at.point - exact).norm(), 1e-10);
      }
    }
  }
}

TEST(MinimumCurvature, ChordsStayNearTheArc) {
  const auto path = minimum_curvature(arc_stations(286.0, 0.0, 90.0 * degree, 1), Vec3::Zero());
  for (std::size_t n = 1; n < path.size(); ++n) {
    const Vec3 middle = 0.5 * (path[n].point + path[n - 1].point);
    // The circle's centre is (0, 286, 0); the header promises a thousandth of the radius.
    EXPECT_LT(286.0 - (middle - Vec3(0, 286, 0)).norm(), 0.286);
  }
}

TEST(MinimumCurvature, StraightStretchesStayStraight) {
  const std::vector<SurveyStation> survey{{0, 0, 0}, {100, 0, 0}, {150, 0, 1.0}};
  const auto path = minimum_curvature(survey, Vec3::Zero());
  ASSERT_EQ(path.size(), 3U) << "azimuth means nothing in a vertical bore";
  EXPECT_EQ(path[2].point, Vec3(0, 0, 150));
}

TEST(MinimumCurvature, AgreesWithTheTextbookFormula) {
  // Two stations 100 m apart from 10 degrees at 20 to 15 degrees at 40: cos(dogleg) = cos(5) - sin(10) sin(15)
  // (1 - cos(20)); each coordinate is L/2 (sum of direction components) * 2/dogleg tan(dogleg/2).
  const double cosine =
      std::cos(5 * degree) - std::sin(10 * degree) * std::sin(15 * degree) * (1 - std::cos(20 * degree));
  const double beta = std::acos(cosine);
  const double factor = 50.0 * 2.0 / beta * std::tan(beta / 2.0);
  const std::vector<SurveyStation> survey{{0, 10 * degree, 20 * degree}, {100, 15 * degree, 40 * degree}};
  EXPECT_NEAR(dogleg(survey[0], survey[1]), beta, 1e-12);
  const Vec3 end = minimum_curvature(survey, Vec3::Zero()).back().point;
  EXPECT_NEAR(end.y(),
              factor * (std::sin(10 * degree) * std::cos(20 * degree) + std::sin(15 * degree) * std::cos(40 * degree)),
              1e-9);
  EXPECT_NEAR(end.x(),
              factor * (std::sin(10 * degree) * std::sin(20 * degree) + std::sin(15 * degree) * std::sin(40 * degree)),
              1e-9);
  EXPECT_NEAR(end.z(), factor * (std::cos(10 * degree) + std::cos(15 * degree)), 1e-9);
}

TEST(MinimumCurvature, StationsBetweenDoNotMoveTheEnd) {
  const std::uint32_t seed = 20261122;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angle(0.0, 1.0);
  for (int round = 0; round < 100; ++round) {
    const std::vector<SurveyStation> survey{{0, angle(random), angle(random)}, {200, angle(random), angle(random)}};
    const auto path = minimum_curvature(survey, Vec3::Zero());
    // An arc cut at any of its own points is the same arc: radius and length agree with each chord.
    const double beta = dogleg(survey[0], survey[1]);
    for (std::size_t n = 1; n < path.size(); ++n) {
      const double part = path[n].measured_depth - path[n - 1].measured_depth;
      const double turn = beta * part / 200.0;
      const double chord = turn < 1e-9 ? part : 2.0 * part / turn * std::sin(turn / 2.0);
      EXPECT_NEAR((path[n].point - path[n - 1].point).norm(), chord, 1e-9);
    }
  }
}

}  // namespace
}  // namespace wellknit
