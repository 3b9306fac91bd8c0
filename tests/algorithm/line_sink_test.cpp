// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/line_sink.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace wellknit {
namespace {

constexpr double pi = std::numbers::pi;

Eigen::Matrix2d rotated(double k1, double k2, double angle) {
  const Eigen::Rotation2Dd turn(angle);
  return turn.toRotationMatrix() * Eigen::Vector2d(k1, k2).asDiagonal() * turn.toRotationMatrix().transpose();
}

TEST(LineSink, IsTheLogarithmOfTheDistanceInIsotropicRock) {
  const LineSink sink(3.0 * Eigen::Matrix2d::Identity(), 0.1);
  EXPECT_DOUBLE_EQ(sink.conductance(), 3.0);
  EXPECT_DOUBLE_EQ(sink.bore(), 0.1);
  EXPECT_DOUBLE_EQ(std::abs(sink.at({3.0, -4.0})), 5.0);
  EXPECT_NEAR((sink.gradient({3.0, -4.0}) - Eigen::Vector2d(3.0, -4.0) / 25.0).norm(), 0.0, 1e-15);
}

// k_1 = 4, k_2 = 1/4: k = 1, sqrt(k_1/k_2) = 4; stretched: x' = x / 2, y' = 2 y. The bore of radius 1 has the half-axes
// 1/2 and 2, c^2 = 4 - 1/4 = 3.75, rho_bore = (1/2 + 2) / 2 = 1.25. The ellipse rho = 2.5 has the half-axes
// rho -+ c^2 / (4 rho) = 2.125 and 2.875, at x = 4.25 and y = 1.4375: there the drop to the bore is ln 2.
TEST(LineSink, HasConfocalEllipses) {
  const LineSink sink(rotated(4.0, 0.25, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(sink.conductance(), 1.0);
  EXPECT_DOUBLE_EQ(sink.bore(), 1.25);
  EXPECT_NEAR(std::log(std::abs(sink.at({4.25, 0.0})) / sink.bore()), std::log(2.0), 1e-14);
  EXPECT_NEAR(std::log(std::abs(sink.at({0.0, -1.4375})) / sink.bore()), std::log(2.0), 1e-14);
  // A quarter of the flow passes between the axes, whatever the permeability.
  EXPECT_NEAR(angle_between(sink.at({4.25, 0.0}), sink.at({0.0, 1.4375})), 0.5 * pi, 1e-14);
}

TEST(LineSink, FlowsEvenlyFromTheBoreAndAsTheTangentFarAway) {
  const LineSink sink(rotated(4.0, 0.25, 0.0), 1.0);
  for (const double phi : {0.1, 0.7, 1.5, 2.4, -0.4, -2.9}) {
    // On the bore nu is the angle itself: x' = cos(phi) / 2 and y' = 2 sin(phi) are the ellipse's own parameters.
    const auto wall = sink.at({std::cos(phi), std::sin(phi)});
    EXPECT_NEAR(std::abs(wall), 1.25, 1e-14);
    EXPECT_NEAR(std::arg(wall), phi, 1e-14);
  }
  // Far away tan nu = tan phi sqrt(k_1/k_2): 4 at 45 degrees.
  EXPECT_NEAR(std::arg(sink.at({1e6, 1e6})), std::atan(4.0), 1e-12);
}

TEST(LineSink, GradientGivesTheSameFlowThroughEveryCircle) {
  const Eigen::Matrix2d k = rotated(5.0, 0.02, 0.6);
  const LineSink sink(k, 0.1);
  // sqrt(5 x 0.02)
  EXPECT_NEAR(sink.conductance(), std::sqrt(0.1), 1e-14);
  for (const double r : {0.1001, 0.3, 1.0, 40.0}) {
    double flow = 0.0;
    constexpr int n = 4000;
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector2d normal(std::cos(2 * pi * i / n), std::sin(2 * pi * i / n));
      flow += normal.dot(k * sink.gradient(r * normal)) * 2 * pi * r / n;
    }
    EXPECT_NEAR(flow, 2 * pi * sink.conductance(), 1e-9) << r;
  }
}

TEST(LineSink, GradientIsThatOfItsPotential) {
  const LineSink sink(rotated(5.0, 0.02, 0.6), 0.1);
  const auto potential = [&](double x, double y) { return std::log(std::abs(sink.at({x, y}))); };
  for (const auto& [x, y] : {std::pair{0.2, 0.1}, {-1.0, 0.3}, {0.05, -2.0}}) {
    const double h = 1e-6;
    const Eigen::Vector2d numeric((potential(x + h, y) - potential(x - h, y)) / (2 * h),
                                  (potential(x, y + h) - potential(x, y - h)) / (2 * h));
    EXPECT_NEAR((sink.gradient({x, y}) - numeric).norm(), 0.0, 1e-7);
  }
}

TEST(LineSink, RockThatIsTightInOneDirectionDoesNotConduct) {
  EXPECT_EQ(LineSink(rotated(1.0, 0.0, 0.0), 0.1).conductance(), 0.0);
  EXPECT_EQ(LineSink(Eigen::Matrix2d::Zero(), 0.1).conductance(), 0.0);
}

// Across the bore sqrt(det of the 2 x 2 block) = sqrt(det K e.K^-1 e), e the bore's unit direction. In plan the section
// cuts the bore at an angle: conductance times length along the section's normal stays the same.
TEST(BoreSection, PermeabilityAcrossABoreIsTheCofactorsRoot) {
  const Eigen::Matrix3d k = Vec3(2.0, 3.0, 0.1).asDiagonal();
  const Vec3 e = Vec3(1.0, 0.0, 2.0).normalized();
  const BoreSection across(e, e);
  const BoreSection in_plan(e, Vec3::UnitZ());
  const double wanted = std::sqrt(k.determinant() * e.dot(k.inverse() * e));
  EXPECT_NEAR(LineSink(across.permeability(k), 0.1).conductance(), wanted, 1e-14);
  EXPECT_NEAR(LineSink(in_plan.permeability(k), 0.1).conductance() * e.z(), wanted, 1e-14);
  // det K e.K^-1 e = 0.6 (0.2 / 2 + 0.8 / 0.1) = 4.86
  EXPECT_NEAR(wanted, std::sqrt(4.86), 1e-14);
}

TEST(BoreSection, GradientDoesNotChangeAlongTheAxis) {
  const Vec3 e(1.0, 0.5, 2.0);
  const BoreSection in_plan(e, Vec3::UnitZ());
  EXPECT_NEAR(in_plan.gradient({0.3, -0.7}).dot(e), 0.0, 1e-15);
  EXPECT_NEAR(in_plan.along_axis(e).norm(), 0.0, 1e-15);
}

}  // namespace
}  // namespace wellknit
