// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/cavity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "tests/support/grids.h"
#include "tests/support/near_well.h"
#include "tests/support/near_well_setting.h"

namespace wellknit {
namespace {

/// One tube of a well in a deformed grid.
struct Setting : near_well::Setting {
  Tube tube;

  Setting(double deformation, near_well::Path path) : near_well::Setting(near_well::deformed(deformation).grid) {
    tube = near_well::Setting::tube(near_well::well(path, 12.0), path == near_well::Path::vertical);
  }
  [[nodiscard]] Cavity cavity(const CavityOptions& options = {}) const {
    return near_well::Setting::cavity(tube, options);
  }
};

const std::vector<std::pair<double, near_well::Path>> settings{{0.0, near_well::Path::vertical},
                                                               {0.0, near_well::Path::curved},
                                                               {0.6, near_well::Path::deviated},
                                                               {1.0, near_well::Path::horizontal},
                                                               {1.0, near_well::Path::curved}};

TEST(Cavity, BoundaryIsAClosedManifold) {
  for (const auto& [deformation, path] : settings) {
    const Cavity cavity = Setting(deformation, path).cavity();
    std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
    for (const BoundaryFace& f : cavity.faces)
      for (std::size_t i = 0; i < f.loop.size(); ++i) ++edges[{f.loop[i], f.loop[(i + 1) % f.loop.size()]}];
    for (const auto& entry : edges) {
      const auto& edge = entry.first;
      const auto count = entry.second;
      EXPECT_EQ(count, 1);
      const auto on_plane = [&](const MirrorPlane& p) {
        return cavity.vertices[static_cast<std::size_t>(edge.first)].reference[p.axis] == p.coordinate &&
               cavity.vertices[static_cast<std::size_t>(edge.second)].reference[p.axis] == p.coordinate;
      };
      // An edge on the grid's outside has its second face in the mirror image.
      const bool is_open = std::any_of(cavity.planes.begin(), cavity.planes.end(), on_plane);
      EXPECT_EQ(edges.contains({edge.second, edge.first}), !is_open);
    }
  }
}

TEST(Cavity, EveryFaceIsCocyclicAndHasAnEmptySphere) {
  for (const auto& [deformation, path] : settings) {
    const Cavity cavity = Setting(deformation, path).cavity();
    for (const BoundaryFace& f : cavity.faces) {
      for (const auto v : f.loop)
        EXPECT_NEAR((cavity.vertices[static_cast<std::size_t>(v)].reference - f.center).norm(), f.radius,
                    1e-9 * f.radius);
      ASSERT_LT(f.t_low, f.t_high);
      // The bounds against a direct test of the sphere half way (or a radius within, where a bound is infinite).
      const double t = 0.5 * (std::max(f.t_low, -f.radius) + std::min(f.t_high, f.radius));
      const double r2 = f.radius * f.radius + t * t;
      for (const CavityVertex& v : cavity.vertices)
        EXPECT_GE((v.reference - (f.center + t * f.normal)).squaredNorm() - r2, -1e-8 * r2);
    }
  }
}

TEST(Cavity, SphereBoundsAreThoseOfATestAgainstAllVertices) {
  for (const auto& [deformation, path] : settings) {
    const Cavity cavity = Setting(deformation, path).cavity();
    for (const BoundaryFace& f : cavity.faces) {
      double low = -std::numeric_limits<double>::infinity();
      double high = std::numeric_limits<double>::infinity();
      for (const CavityVertex& v : cavity.vertices) {
        const Vec3 d = v.reference - f.center;
        const double h = f.normal.dot(d);
        const double t = (d.squaredNorm() - f.radius * f.radius) / (2.0 * h);
        if (h > 1e-9 * f.radius) high = std::min(high, t);
        if (h < -1e-9 * f.radius) low = std::max(low, t);
      }
      // The search ends at four times the larger of natural distance and radius; a plane may end it earlier.
      EXPECT_EQ(f.t_low, std::max(low, -4.0 * std::max(-f.natural_outside, f.radius)));
      const double reached = std::min(high, 4.0 * std::max(f.natural, f.radius));
      const bool is_cut_by_plane = f.high_vertex < 0 && !cavity.planes.empty();
      EXPECT_EQ(is_cut_by_plane ? std::max(f.t_high, reached) : f.t_high, reached);
    }
  }
}

TEST(Cavity, HoldsItsTube) {
  for (const auto& [deformation, path] : settings) {
    const Setting setting(deformation, path);
    const Cavity cavity = setting.cavity();
    const std::set<std::array<std::int64_t, 3>> removed(cavity.removed.begin(), cavity.removed.end());
    for (const Vec3& p : setting.tube.reference.points) {
      std::array<std::int64_t, 3> c;
      for (int a = 0; a < 3; ++a) c[static_cast<std::size_t>(a)] = setting.space.place(a, p[a]).first;
      EXPECT_TRUE(removed.contains(c));
    }
  }
}

TEST(Cavity, LayeredTubeTakesWholeColumns) {
  const Cavity cavity = Setting(0.0, near_well::Path::vertical).cavity();
  EXPECT_EQ(cavity.removed.size() % 12, 0U);
  EXPECT_EQ(cavity.planes.size(), 2U);  // top and base
  for (const BoundaryFace& f : cavity.faces) EXPECT_LT(std::abs(f.normal.z()), 1e-12);
}

TEST(Cavity, GrowsWhenAskedTo) {
  const Setting setting(0.0, near_well::Path::curved);
  CavityOptions wide;
  wide.dilation = 1;
  EXPECT_GT(setting.cavity(wide).removed.size(), setting.cavity().removed.size());
}

/// A swept tube of 12 m along x through the box grid, from (270, y) to (530, y).
Tube horizontal_tube(const near_well::Setting& setting, double y, double depth) {
  Well well = near_well::straight("H", {270.0, y, depth}, {530.0, y, depth});
  well.radial.drainage_radius = 12.0;
  return std::get<Tube>(build_swept_tube(setting.frame(), well, {0.0, 260.0}));
}

std::string refusal(const near_well::Setting& setting, std::vector<Tube> tubes, const CavityOptions& options = {}) {
  const auto made = build_cavity(setting.frame(), std::move(tubes), options);
  const auto* none = std::get_if<NoCavity>(&made);
  return none == nullptr ? "none" : none->reason;
}

TEST(Cavity, RefusesATubeThatAllButTouchesTheTop) {
  // The top is at 2000 m: one metre is left above the tube, a twelfth of its radius where a fifth is asked for.
  const near_well::Setting setting(near_well::deformed(0.0).grid);
  EXPECT_EQ(refusal(setting, {horizontal_tube(setting, 400.0, 2013.0)}),
            "its tube comes too close to the top, base or a side of the grid");
  EXPECT_EQ(refusal(setting, {horizontal_tube(setting, 400.0, 2015.0)}), "none");
}

TEST(Cavity, RefusesTwoTubesThatAllButTouch) {
  const near_well::Setting setting(near_well::deformed(0.0).grid);
  const Tube first = horizontal_tube(setting, 400.0, 2090.0);
  EXPECT_EQ(refusal(setting, {first, horizontal_tube(setting, 425.0, 2090.0)}),
            "its tube comes too close to another one");
  EXPECT_EQ(refusal(setting, {first, horizontal_tube(setting, 432.0, 2090.0)}), "none");
}

TEST(Cavity, RefusesATubeWhoseEndsAllButTouch) {
  // All but a circle of 60 m: of 356 degrees the ends are 2 x 60 m x sin 2 degrees = 4.2 m apart, of 340 degrees 21 m.
  const near_well::Setting setting(near_well::deformed(0.0).grid);
  const auto ring = [&](double degrees) {
    Well well;
    well.name = "O";
    for (int k = 0; k <= 90; ++k) {
      const double angle = degrees * k / 90.0 * std::numbers::pi / 180.0;
      well.trajectory.points.push_back({400.0 + 60.0 * std::cos(angle), 400.0 + 60.0 * std::sin(angle), 2090.0});
      well.trajectory.measured_depth.push_back(60.0 * angle);
    }
    well.radial.drainage_radius = 12.0;
    return std::get<Tube>(build_swept_tube(setting.frame(), well, {0.0, well.trajectory.measured_depth.back()}));
  };
  EXPECT_EQ(refusal(setting, {ring(356.0)}), "its tube comes too close to itself");
  EXPECT_EQ(refusal(setting, {ring(340.0)}), "none");
}

TEST(Cavity, IsGivenUpBeyondItsLimits) {
  const near_well::Setting setting(near_well::deformed(0.0).grid);
  const Tube tube = horizontal_tube(setting, 400.0, 2090.0);
  CavityOptions options;
  options.most_rounds = 1;
  EXPECT_EQ(refusal(setting, {tube}, options).find("no cavity was found in 1 rounds of removing cells ("), 0U);
  options = {};
  options.most_cells = 10;
  EXPECT_EQ(refusal(setting, {tube}, options).find("its cavity would swallow "), 0U);
}

TEST(Cavity, RefusesAFaultThatEndsInsideItself) {
  // Columns i >= 5 are thrown by 3 m at j = 0, by 1 m at j = 2, and by nothing from j = 3 on; the throw also dies out
  // along i. A tube passes the fault's end, and the cells around it are taken on both sides.
  grids::Recipe recipe;
  recipe.dimensions = {10, 8, 8};
  recipe.pillar = [](std::int64_t i, std::int64_t j) {
    const Vec3 top(10.0 * static_cast<double>(i), 20.0 * static_cast<double>(j), 900.0);
    return std::array<Vec3, 2>{top, top + Vec3(0.0, 0.0, 300.0)};
  };
  recipe.depth = [](std::array<std::int64_t, 3> cell, std::array<int, 3> corner) {
    const auto at = [&](std::size_t axis) { return static_cast<double>(cell[axis] + corner[axis]); };
    const double thrown = cell[0] >= 5 ? std::max(0.0, 3.0 - at(1)) * (10.0 - at(0)) / 5.0 : 0.0;
    return 1000.0 + 5.0 * at(2) + thrown;
  };
  const near_well::Setting setting(grids::make(recipe));
  const Vec3 from(24.0, 92.0, 1024.0);
  const Vec3 to(51.0, 80.0, 1019.0);
  Well well = near_well::straight("F", from, to);
  well.radial.drainage_radius = 4.0;
  const auto tube = build_swept_tube(setting.frame(), well, {0.0, (to - from).norm()});
  CavityOptions wide;
  wide.dilation = 1;
  EXPECT_EQ(refusal(setting, {std::get<Tube>(tube)}, wide), "a fault ends inside its cavity, at cell (5, 3, 4)");
}

TEST(Cavity, RefusesAFaultInsideItself) {
  const near_well::Setting setting(grids::faulted({12, 12, 8}, 3.0));
  Well well = near_well::straight("F", {52.0, 110.0, 1020.0}, {55.0, 130.0, 1020.0});  // 5 m from the fault at x = 60
  well.radial.drainage_radius = 4.0;
  EXPECT_TRUE(setting.stretches(well).empty());
  const auto tube = build_swept_tube(setting.frame(), well, {0.0, 20.0});
  ASSERT_TRUE(std::holds_alternative<Tube>(tube)) << std::get<NoTube>(tube).reason;
  const auto cavity = build_cavity(setting.frame(), {std::get<Tube>(tube)}, {});
  ASSERT_TRUE(std::holds_alternative<NoCavity>(cavity));
  EXPECT_NE(std::get<NoCavity>(cavity).reason.find("fault"), std::string::npos);
}

}  // namespace
}  // namespace wellknit
