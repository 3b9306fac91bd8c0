// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/reference_space.h"

#include <gtest/gtest.h>

#include "tests/support/grids.h"

namespace wellknit {
namespace {

CellRange all_of(const CornerPointGrid& grid) { return {{0, 0, 0}, grid.dimensions}; }

TEST(ReferenceSpace, OfABoxHasItsSpacings) {
  const CornerPointGrid grid = grids::box({3, 4, 5}, {10.0, 20.0, 5.0});
  const HostMesh host = build_host_mesh(grid);
  const ReferenceSpace space(grid, host, all_of(grid));
  EXPECT_DOUBLE_EQ(space.plane(0, 3) - space.plane(0, 0), 30.0);
  EXPECT_DOUBLE_EQ(space.plane(1, 4) - space.plane(1, 0), 80.0);
  EXPECT_DOUBLE_EQ(space.plane(2, 5) - space.plane(2, 0), 25.0);
}

TEST(ReferenceSpace, RunsBackwardsAlongJInALeftHandedGrid) {
  const CornerPointGrid grid = grids::left_handed({3, 3, 3});
  const HostMesh host = build_host_mesh(grid);
  const ReferenceSpace space(grid, host, all_of(grid));
  EXPECT_LT(space.plane(1, 3), space.plane(1, 0));
  EXPECT_LT(space.box({0, 0, 0}).low.y(), space.box({0, 0, 0}).high.y());
}

TEST(ReferenceSpace, PlaceInvertsThePlanes) {
  for (const bool is_left : {false, true}) {
    const CornerPointGrid grid = is_left ? grids::left_handed({4, 4, 4}) : grids::box({4, 4, 4});
    const HostMesh host = build_host_mesh(grid);
    const ReferenceSpace space(grid, host, all_of(grid));
    for (int axis = 0; axis < 3; ++axis) {
      const double x = 0.25 * space.plane(axis, 2) + 0.75 * space.plane(axis, 3);
      const auto [index, fraction] = space.place(axis, x);
      EXPECT_EQ(index, 2);
      EXPECT_NEAR(fraction, 0.75, 1e-12);
    }
  }
}

TEST(ReferenceSpace, MirrorImagesAreExact) {
  const CornerPointGrid grid = grids::twisted({4, 4, 4});
  const HostMesh host = build_host_mesh(grid);
  const ReferenceSpace space(grid, host, all_of(grid));
  const double plane = space.plane(2, 4);
  const double x = on_reference_lattice(3.14159);
  EXPECT_EQ(2.0 * plane - (2.0 * plane - x), x);
}

}  // namespace
}  // namespace wellknit
