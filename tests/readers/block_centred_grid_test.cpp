// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/block_centred_grid.h"

#include <gtest/gtest.h>

#include <limits>

#include "model/corner_point_grid.h"
#include "model/errors.h"

namespace wellknit {
namespace {

constexpr double unset = std::numeric_limits<double>::quiet_NaN();

TEST(BlockCentredGrid, StacksLayersBelowTheTop) {
  const std::vector<double> dx{10, 20, 10, 20}, dy(4, 5.0), dz{1, 2, 3, 4}, tops{100, 110, unset, unset};
  const CornerPoints points = corner_points({{2, 1, 2}, dx, dy, dz, tops});
  CornerPointGrid grid;
  grid.dimensions = {2, 1, 2};
  grid.coord = points.coord;
  grid.zcorn = points.zcorn;
  grid.active.assign(4, 1);
  validate(grid);
  // The lower cell of the second column: x 10 to 30, its top at 110 + 2, its base 4 below.
  const auto corners = grid.corners(HostCellId(3));
  EXPECT_EQ(corners[0], Vec3(10, 0, 112));
  EXPECT_EQ(corners[7], Vec3(30, 5, 116));
  EXPECT_DOUBLE_EQ(bilinear_hexahedron_volume(corners), 20.0 * 5.0 * 4.0);
}

TEST(BlockCentredGrid, RefusesWhatHasNoPillars) {
  const std::vector<double> same(4, 1.0), varying{10, 20, 10, 21}, tops{0, 0, unset, unset};
  EXPECT_THROW(corner_points({{2, 1, 2}, varying, same, same, tops}), InvalidInput);
  EXPECT_THROW(corner_points({{1, 2, 2}, same, varying, same, tops}), InvalidInput);
}

TEST(BlockCentredGrid, RefusesMissingAndNegativeSizes) {
  const std::vector<double> same(2, 1.0), missing{1.0, unset}, negative{1.0, -1.0}, tops{0.0, unset}, none(2, unset);
  EXPECT_THROW(corner_points({{1, 1, 2}, missing, same, same, tops}), InvalidInput);
  EXPECT_THROW(corner_points({{1, 1, 2}, same, same, negative, tops}), InvalidInput);
  EXPECT_THROW(corner_points({{1, 1, 2}, same, same, same, none}), InvalidInput);
}

}  // namespace
}  // namespace wellknit
