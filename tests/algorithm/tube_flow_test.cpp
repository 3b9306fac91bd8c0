// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/tube_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "algorithm/radial_flow.h"
#include "tests/support/near_well.h"

namespace wellknit {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double bore = 1.0;  ///< m, of level_tube()

TEST(TubeFlow, MeanPressureRadiusIsTheAreaMeanOfTheLogarithm) {
  // The mean of ln r over a ring by Simpson's rule in r, weight r.
  const double a = 2.0;
  const double b = 5.0;
  constexpr int n = 2000;
  double mean = 0.0;
  for (int i = 0; i <= n; ++i) {
    const double r = a + (b - a) * i / n;
    mean += (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2) * r * std::log(r);
  }
  mean *= (b - a) / n / 3.0 / (0.5 * (b * b - a * a));
  EXPECT_NEAR(std::log(mean_pressure_radius(a, b)), mean, 1e-10);
}

TEST(TubeFlow, OpenLengthAddsUpTheOverlaps) {
  Well well = near_well::straight("W", {0, 0, 0}, {0, 0, 100});
  EXPECT_DOUBLE_EQ(open_length(well, 10.0, 30.0), 20.0);
  EXPECT_DOUBLE_EQ(open_length(well, 90.0, 130.0), 10.0);  // the path ends at 100 m
  well.open = {{0.0, 12.0}, {25.0, 26.0}, {29.0, 100.0}};
  EXPECT_DOUBLE_EQ(open_length(well, 10.0, 30.0), 2.0 + 1.0 + 1.0);
}

/// A tube along x, 7 m long, rings from 1 m or the radius given to 400 m, four sectors whose middles are along y,
/// depth, -y, -depth.
Tube level_tube(double bore_radius = 1.0) {
  Tube tube;
  const std::vector<double> radii{bore_radius, 3.0, 20.0, 400.0};
  std::vector<RingFrame> frames;
  for (const double x : {0.0, 7.0}) frames.push_back({{x, 0, 0}, Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()});
  tube.real = sweep_rings(frames, radii, 4, -0.25 * pi);
  return tube;
}

/// Resistance, 1/m3, from the bore to the outermost circle.
double resistance(const TubeSector& sector, double skin = 0.0) {
  double sum = 1.0 / sector.well_index(skin);
  for (int ring = 0; ring < 3; ++ring) {
    if (ring > 0) sum += 1.0 / sector.half_to_circle(ring, ring);
    sum += 1.0 / sector.half_to_circle(ring, ring + 1);
  }
  return sum;
}

TEST(TubeFlow, IsotropicRingsAddUpToThiem) {
  const Tube tube = level_tube();
  const Eigen::Matrix3d k = 3.0 * Eigen::Matrix3d::Identity();
  for (int s = 0; s < 4; ++s) {
    // k L theta / ln(R / r_w)
    const double wanted = 3.0 * 7.0 * 0.5 * pi / std::log(400.0);
    EXPECT_NEAR(resistance({tube, 0, s, k, bore}) * wanted, 1.0, 1e-12);
  }
  // Skin s is a drop of s more: k L theta / (ln(R / r_w) + 2).
  EXPECT_NEAR(1.0 / resistance({tube, 0, 0, k, bore}, 2.0), 3.0 * 7.0 * 0.5 * pi / (std::log(400.0) + 2.0), 1e-12);
}

// k_h = 4, k_v = 1/4: k = 1, sqrt(k_h/k_v) = 4, r_w = 1: x' = y / 2, y' = 2 depth, c^2 = 3.75, rho_bore = 1.25
// (line_sink_test.cpp). At R = 400 the drop to the bore is ln((x' + sqrt(x'^2 + c^2)) / 2 / 1.25) with x' = 200 along
// y, and ln((y' + sqrt(y'^2 - c^2)) / 2 / 1.25) with y' = 800 along depth. The sectors' sides, at 45 degrees, are at nu
// = atan 4 far away: shares 2 atan 4 and pi - 2 atan 4.
TEST(TubeFlow, AnisotropicRingsAddUpToTheLineSink) {
  const Tube tube = level_tube();
  const Eigen::Matrix3d k = Vec3(4.0, 4.0, 0.25).asDiagonal();
  const double level = std::log((200.0 + std::sqrt(40000.0 + 3.75)) / 2.5);
  const double upright = std::log((800.0 + std::sqrt(640000.0 - 3.75)) / 2.5);
  for (int s = 0; s < 4; ++s) {
    const double share = s % 2 == 0 ? 2.0 * std::atan(4.0) : pi - 2.0 * std::atan(4.0);
    const double drop = s % 2 == 0 ? level : upright;
    EXPECT_NEAR(resistance({tube, 0, s, k, bore}) * 7.0 * share / drop, 1.0, 2e-5) << s;  // c^2 / R'^2 in the shares
  }
}

TEST(TubeFlow, FlowAroundTheBoreKeepsTheLengthOfTheWay) {
  const Tube tube = level_tube();
  const double log_ratio = std::log(20.0);  // of the outermost ring
  // Isotropic: k L ln(r_2/r_1) / (theta / 2).
  const Eigen::Matrix3d even = Eigen::Matrix3d::Identity();
  EXPECT_NEAR(TubeSector(tube, 0, 0, even, bore).half_to_side(2, 0), 7.0 * log_ratio / (0.25 * pi), 1e-12);
  // k_h = 4, k_v = 1/4, far from the bore, from the middle (along y, rho = r / 2) to the side at 45 degrees (rho =
  // r sqrt(1/8 + 2), nu = atan 4): L ln(r_2/r_1) nu / (nu^2 + ln^2(sqrt(8.5))).
  const Eigen::Matrix3d k = Vec3(4.0, 4.0, 0.25).asDiagonal();
  const double nu = std::atan(4.0);
  const double turn = 0.5 * std::log(8.5);
  const double wanted = 7.0 * log_ratio * nu / (nu * nu + turn * turn);
  EXPECT_NEAR(TubeSector(tube, 0, 0, k, bore).half_to_side(2, 0) / wanted, 1.0, 1e-3);  // c^2 / r0'^2
  EXPECT_NEAR(TubeSector(tube, 0, 0, k, bore).half_to_side(2, 1) / wanted, 1.0, 1e-3);
}

TEST(TubeFlow, BeyondTheTubeTheDropIsThatFromTheChord) {
  const Tube tube = level_tube();
  // The site stands at 400 cos 45 + 300 m from the axis: k L theta / ln of that over 400.
  const double site = 400.0 * std::sqrt(0.5) + 300.0;
  const TubeSector sector(tube, 0, 1, Eigen::Matrix3d::Identity(), bore);
  EXPECT_NEAR(sector.half_beyond({0, 0, 5}, {0, 0, 300}), 7.0 * 0.5 * pi / std::log(site / 400.0), 1e-9);
  // So near that it is inside the circle: half the linear drop.
  EXPECT_NEAR(sector.half_beyond({0, 0, 5}, {0, 0, 40}), 7.0 * 0.5 * pi / 0.05, 1e-9);
}

TEST(TubeFlow, OfATubeMadeInAnotherSpaceIsThatOfTheRealOne) {
  // Depths times 4 there: k_h = 4, k_v = 1/4 is isotropic with 1, and the round bore of 1 m is an ellipse of mean
  // radius 2.5 m. From the bore to 400 m all around: 2 pi L / ln(400 / 2.5).
  Tube tube = level_tube(2.7);
  tube.space.matrix = Vec3(1.0, 1.0, 4.0).asDiagonal();
  tube.space.inverse = Vec3(1.0, 1.0, 0.25).asDiagonal();
  tube.space.determinant = 4.0;
  const Eigen::Matrix3d k = Vec3(4.0, 4.0, 0.25).asDiagonal();
  double conductance = 0.0;
  for (int s = 0; s < 4; ++s) conductance += 1.0 / resistance({tube, 0, s, k, bore});
  EXPECT_NEAR(conductance, 2.0 * pi * 7.0 / std::log(400.0 / 2.5), 1e-9);
}

TEST(TubeFlow, TightRockHasNoIndex) {
  const Tube tube = level_tube();
  const TubeSector sector(tube, 0, 0, Vec3(1.0, 1.0, 0.0).asDiagonal(), bore);
  EXPECT_FALSE(sector.conducts());
  EXPECT_EQ(sector.well_index(0.0), 0.0);
  EXPECT_EQ(sector.half_to_circle(0, 1), 0.0);
}

// K = diag(1, 1, 0.01): stretched by 10 along depth. A level face, n along depth: to l = (1, 0, 1) = (1, 0, 10) there
// the angle has the cosine 10 / sqrt(101); to l = (1, 0, 0.1) = (1, 0, 1) there it is 45 degrees.
TEST(RadialFlow, CosineIsTakenInTheStretchedSpace) {
  const Eigen::Matrix3d k = Vec3(1.0, 1.0, 0.01).asDiagonal();
  EXPECT_NEAR(permeability_cosine(k, {0, 0, 2.0}, {1.0, 0, 1.0}), 10.0 / std::sqrt(101.0), 1e-12);
  EXPECT_NEAR(permeability_cosine(k, {0, 0, 2.0}, {1.0, 0, 0.1}), std::sqrt(0.5), 1e-12);
  EXPECT_DOUBLE_EQ(permeability_cosine(k, {3.0, 0, 0}, {1.0, 0, 0}), 1.0);
  // Without flow along depth there is no measure.
  EXPECT_DOUBLE_EQ(permeability_cosine(Vec3(1.0, 1.0, 0.0).asDiagonal(), {0, 0, 1.0}, {1.0, 0, 1.0}), 1.0);
}

/// A face across the way from one centre to another, straight out from a well along depth through (0, 0).
double factor_at(const RadialFlow& flow, double from, double to, double half_width) {
  const double x = 0.5 * (from + to);
  const std::vector<Vec3> points{{x, -half_width, 1}, {x, half_width, 1}, {x, half_width, 2}, {x, -half_width, 2}};
  const PolygonGeometry g = polygon_geometry(points);
  const double linear = g.area / (to - from);
  return flow.factor({{Vec3(from, 0, 1.5), Vec3(to, 0, 1.5)}, points, g, Eigen::Matrix3d::Identity(), linear}).value;
}

TEST(RadialFlow, FactorIsTheLineSinksFluxOverItsDrop) {
  Tube tube;
  std::vector<RingFrame> frames;
  for (const double z : {0.0, 3.0}) frames.push_back({{0, 0, z}, Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()});
  tube.real = sweep_rings(frames, std::vector<double>{0.1, 1.0}, 6, 0.0);
  tube.real.measured_depth = {0.0, 3.0};
  const std::vector<Well> wells{near_well::straight("W", {0, 0, 0}, {0, 0, 3})};
  const RadialFlow flow({{&tube, CellId(0)}}, wells);
  // F = 2 atan(h / x) = 0.3973 at x = 3, h = 0.6 (each edge's middle has h/2 or 0: Simpson's rule would be needed for
  // more digits); drop ln 2; linear 1.2 / 2.
  EXPECT_NEAR(factor_at(flow, 2.0, 4.0, 0.6), 2.0 * std::atan(0.2) / std::log(2.0) / 0.6, 2e-3);
  // Beyond the end of the well nothing is known.
  const std::vector<Well> elsewhere{near_well::straight("W", {0, 0, 0}, {0, 0, 1})};
  tube.real.axis.back().z() = 1.0;
  tube.real.measured_depth = {0.0, 1.0};
  EXPECT_DOUBLE_EQ(factor_at(RadialFlow({{&tube, CellId(0)}}, elsewhere), 2.0, 4.0, 0.6), 1.0);
  // The same tube in a well that goes on.
  EXPECT_GT(factor_at(RadialFlow({{&tube, CellId(0)}}, wells), 2.0, 4.0, 0.6), 0.9);
  EXPECT_NE(factor_at(RadialFlow({{&tube, CellId(0)}}, wells), 2.0, 4.0, 0.6), 1.0);
}

}  // namespace
}  // namespace wellknit
