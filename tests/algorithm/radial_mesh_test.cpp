// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/radial_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model/errors.h"

namespace wellknit {
namespace {

std::vector<Vec3> helix(int stations) {
  std::vector<Vec3> points;
  for (int k = 0; k < stations; ++k) {
    const double a = 0.03 * k;
    points.emplace_back(200 * std::sin(a), 200 * std::cos(a), 8.0 * k * a);
  }
  return points;
}

RadialMesh swept_helix() {
  const auto stations = helix(40);
  RadialOptions options;
  return sweep_rings(sweep_frames(stations, polyline_tangents(stations)), circle_radii(options), options.sectors, 0.3);
}

TEST(RadialMesh, RadiiAreInGeometricProgression) {
  RadialOptions options;
  options.bore_radius = 0.1;
  options.drainage_radius = 12.8;
  options.rings = 7;  // 0.1 * 2^7 = 12.8
  const auto radii = circle_radii(options);
  for (std::size_t i = 0; i < radii.size(); ++i)
    EXPECT_NEAR(radii[i], 0.1 * std::pow(2.0, static_cast<double>(i)), 1e-12);
}

TEST(RadialMesh, WidthsGrowByTheFactorGiven) {
  RadialOptions options;
  options.bore_radius = 1.0;
  options.drainage_radius = 8.0;
  options.rings = 3;
  options.growth = 2.0;  // widths 1, 2, 4
  EXPECT_NEAR(circle_radii(options)[1], 2.0, 1e-12);
  EXPECT_NEAR(circle_radii(options)[2], 4.0, 1e-12);
}

TEST(RadialMesh, SmallerTubesHaveFewerRings) {
  RadialOptions options;
  options.bore_radius = 0.1;
  options.drainage_radius = 12.8;
  options.rings = 7;  // circles at 0.1, 0.2, 0.4 … 12.8
  EXPECT_EQ(rings_within(options, 12.8), 7);
  EXPECT_EQ(rings_within(options, 20.0), 7);
  EXPECT_EQ(rings_within(options, 1.7), 4);   // 1.6 is the nearest
  EXPECT_EQ(rings_within(options, 0.5), 2);   // 0.4 by a ratio of 1.25, 0.8 by 1.6
  EXPECT_EQ(rings_within(options, 0.11), 1);  // at least one
  options.growth = 1.0;                       // circles 12.7 / 7 = 1.81 apart
  EXPECT_EQ(rings_within(options, 6.0), 3);   // 5.54 by a ratio of 1.08, 7.36 by 1.23
}

TEST(RadialMesh, RefusesRadiiThatMakeNoRings) {
  RadialOptions options;
  options.bore_radius = -0.1;
  EXPECT_THROW(circle_radii(options), InvalidInput);
  options = {};
  options.drainage_radius = options.bore_radius;
  EXPECT_THROW(circle_radii(options), InvalidInput);
  options = {};
  options.sectors = 2;
  EXPECT_THROW(circle_radii(options), InvalidInput);
  options = {};
  options.rings = 0;
  EXPECT_THROW(circle_radii(options), InvalidInput);
  options = {};
  options.growth = 0.0;
  EXPECT_THROW(circle_radii(options), InvalidInput);
  options = {};
  options.rings = 100;
  options.growth = 1e6;  // the first rings are narrower than the numbers are spaced
  EXPECT_THROW(circle_radii(options), InvalidInput);
  options = {};
  options.rings = 101;
  EXPECT_THROW(circle_radii(options), InvalidInput);
  options = {};
  options.segments = 0;
  EXPECT_THROW(circle_radii(options), InvalidInput);
}

/// Largest distance of the points from the plane and the circle of their first three.
double circle_defect(const std::vector<Vec3>& p) {
  const Vec3 a = p[1] - p[0];
  const Vec3 b = p[2] - p[0];
  const Vec3 n = a.cross(b);
  const Vec3 center = p[0] + (a.squaredNorm() * b.cross(n) + b.squaredNorm() * n.cross(a)) / (2 * n.squaredNorm());
  double worst = 0.0;
  for (const Vec3& q : p)
    worst = std::max({worst, std::abs(n.normalized().dot(q - p[0])),
                      std::abs((q - center).norm() - a.norm() * b.norm() * (a - b).norm() / (2 * n.norm()))});
  return worst;
}

TEST(RadialMesh, LateralFacesOfACurvedTubeArePlanarAndCocyclic) {
  const RadialMesh m = swept_helix();
  double worst = 0.0;
  for (int k = 0; k < m.segments; ++k)
    for (int c = 0; c <= m.rings; ++c)
      for (int s = 0; s < m.sectors; ++s)
        worst = std::max(worst, circle_defect({m.point(k, c, s), m.point(k, c, s + 1), m.point(k + 1, c, s + 1),
                                               m.point(k + 1, c, s)}));
  EXPECT_LT(worst, 1e-10);  // method.md §13; the coordinates are some 200 m
}

TEST(RadialMesh, CellsHaveTheirEightVerticesOnASphere) {
  const RadialMesh m = swept_helix();
  for (int k = 0; k < m.segments; ++k) {
    std::vector<Vec3> p;
    for (const int station : {k, k + 1})
      for (const int c : {4, 5})
        for (const int s : {2, 3}) p.push_back(m.point(station, c, s));
    // The sphere through four of them by its linear system.
    Eigen::Matrix3d a;
    Vec3 right;
    for (int i = 0; i < 3; ++i) {
      const Vec3 d = p[static_cast<std::size_t>(i == 2 ? 4 : i + 1)] - p[0];
      a.row(i) = 2 * d.transpose();
      right[i] = d.squaredNorm();
    }
    const Vec3 center = p[0] + Vec3(a.inverse() * right);
    for (const Vec3& q : p) EXPECT_NEAR((q - center).norm(), (p[0] - center).norm(), 1e-9);
  }
}

TEST(RadialMesh, FrameDoesNotTwistAndStaysRightHanded) {
  const auto stations = helix(40);
  const auto tangents = polyline_tangents(stations);
  const auto frames = sweep_frames(stations, tangents);
  for (const RingFrame& f : frames) EXPECT_NEAR(f.e1.cross(f.e2).dot(f.normal), 1.0, 1e-12);
  EXPECT_LT(largest_tilt(frames, tangents), 1.0 * std::numbers::pi / 180.0);
}

TEST(RadialMesh, LateralRatioTellsTheBend) {
  // A circle of radius 100 m with a tube of 25 m: the inner side is shorter by 25/100.
  std::vector<Vec3> stations;
  for (int k = 0; k <= 20; ++k) stations.emplace_back(100 * std::sin(0.05 * k), 100 * (1 - std::cos(0.05 * k)), 0.0);
  const std::vector<double> radii{1.0, 25.0};
  const RadialMesh m = sweep_rings(sweep_frames(stations, polyline_tangents(stations)), radii, 36, 0.0);
  EXPECT_NEAR(smallest_lateral_ratio(m), 0.75, 0.01);
}

TEST(RadialMesh, SmoothingKeepsAStraightLineAndFlattensAKink) {
  std::vector<Vec3> line;
  std::vector<Vec3> kink;
  for (int k = 0; k <= 10; ++k) {
    line.emplace_back(k, 2 * k, 3 * k);
    kink.emplace_back(k, std::abs(k - 5), 0);
  }
  const auto same = smoothed_stations(line, 10.0);
  for (std::size_t k = 0; k < line.size(); ++k) EXPECT_LT((same[k] - line[k]).norm(), 1e-9);
  const auto bend = [](const std::vector<Vec3>& p) { return (p[4] - 2 * p[5] + p[6]).norm(); };
  EXPECT_LT(bend(smoothed_stations(kink, 1.0)), 0.5 * bend(kink));
}

}  // namespace
}  // namespace wellknit
