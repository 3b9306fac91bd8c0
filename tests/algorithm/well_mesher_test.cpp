// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Wells that are left out. Those that get a mesh are tested in build_mesh_test.cpp.

#include "algorithm/well_mesher.h"

#include <gtest/gtest.h>

#include "tests/support/grids.h"
#include "tests/support/near_well.h"

namespace wellknit {
namespace {

TEST(MeshWells, AWellThatIsLeftOutHasAReason) {
  const CornerPointGrid grid = grids::box({4, 4, 4});
  const HostMesh host = build_host_mesh(grid);
  const CellLocator locator(grid);
  const std::vector<Well> wells(2, near_well::straight("V", {20.0, 40.0, 990.0}, {20.0, 40.0, 1030.0}));
  const MeshedWells meshed = mesh_wells(grid, host, locator, wells, {}, {{0, "it is in the way"}, {1, ""}});
  EXPECT_TRUE(meshed.cavities.empty());
  EXPECT_EQ(meshed.wells.at(0).reason, "it is in the way");
  EXPECT_EQ(meshed.wells.at(1).reason, "no tube of any radius was found");  // none was given
}

}  // namespace
}  // namespace wellknit
