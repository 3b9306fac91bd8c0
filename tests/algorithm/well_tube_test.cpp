// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What keeps a tube from being made. The meshes of tubes are tested in radial_mesh_test.cpp.

#include "algorithm/well_tube.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/grids.h"
#include "tests/support/near_well.h"
#include "tests/support/near_well_setting.h"

namespace wellknit {
namespace {

std::string reason_of(const TubeOrReason& made) {
  const auto* none = std::get_if<NoTube>(&made);
  return none == nullptr ? "none" : none->reason;
}

TEST(LayeredTube, IsNotMadeWhereALayerHasNoThickness) {
  // The obstacles of another grid, whose layers all have one: those of this grid keep tubes away before.
  const near_well::Setting whole(grids::box({12, 12, 8}));
  const near_well::Setting pinched(grids::pinched({12, 12, 8}, true, true));  // layer 8 / 2, counted from 0
  Well well = near_well::straight("V", {55.0, 110.0, 990.0}, {55.0, 110.0, 1050.0});
  well.radial.drainage_radius = 8.0;
  EXPECT_EQ(
      reason_of(build_layered_tube(pinched.frame(), well, path_in_reference(pinched.frame(), well), whole.obstacles)),
      "layer 5 pinches out within 8 m of it");
}

/// Columns of 20 m, each row of them `shear` cells further along x than the one before.
CornerPointGrid sheared(double shear) {
  grids::Recipe recipe;
  recipe.dimensions = {30, 30, 8};
  recipe.pillar = [shear](std::int64_t i, std::int64_t j) {
    const auto row = static_cast<double>(j);
    const Vec3 top(20.0 * (static_cast<double>(i) + shear * (row - 15.0)), 20.0 * row, 900.0);
    return std::array<Vec3, 2>{top, top + Vec3(0.0, 0.0, 2000.0)};
  };
  recipe.depth = [](std::array<std::int64_t, 3> cell, std::array<int, 3> corner) {
    return 2000.0 + 20.0 * static_cast<double>(cell[2] + corner[2]);
  };
  return grids::make(recipe);
}

TEST(SweptTube, IsNotMadeWhereTheGridBendsItTooSharply) {
  // Half a circle of 30 m around a tube of 10 m is within what a tube may bend by. In E_ref the sheared rows stand
  // square, and the circle is an ellipse.
  Well well;
  well.name = "A";
  for (int k = 0; k <= 40; ++k) {
    const double angle = std::numbers::pi * k / 40.0;
    well.trajectory.points.push_back({300.0 + 30.0 * std::cos(angle), 300.0 + 30.0 * std::sin(angle), 2080.0});
    well.trajectory.measured_depth.push_back(30.0 * angle);
  }
  well.radial.drainage_radius = 10.0;
  const MeasuredDepthRange whole{0.0, well.trajectory.measured_depth.back()};
  const auto tube_in = [&](double shear) {
    const near_well::Setting setting(sheared(shear));
    return reason_of(build_swept_tube(setting.frame(), well, whole));
  };
  EXPECT_EQ(tube_in(0.0), "none");
  const std::string reason = tube_in(1.0);
  EXPECT_EQ(reason.find("the grid bends too sharply around it at measured depth "), 0U) << reason;
  EXPECT_NE(reason.find(" m for a drainage radius of 10 m"), std::string::npos) << reason;
}

}  // namespace
}  // namespace wellknit
