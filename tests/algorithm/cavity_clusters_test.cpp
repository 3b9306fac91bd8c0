// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What happens to cavities that stay in each other's way. Those that make room are tested in build_mesh_test.cpp.

#include "algorithm/cavity_clusters.h"

#include <gtest/gtest.h>

#include "tests/support/grids.h"
#include "tests/support/near_well.h"

namespace wellknit {
namespace {

TEST(CavityClusters, TheLastGivesWayWhenTheRoundsAreUsedUp) {
  const CornerPointGrid grid = grids::box({4, 4, 4});
  const HostMesh host = build_host_mesh(grid);
  const CellLocator locator(grid);
  const std::vector<Well> wells(2, near_well::straight("V", {20.0, 40.0, 990.0}, {20.0, 40.0, 1030.0}));
  const BuildOptions options;
  const WellTask task{grid, host, locator, wells, options, {}};
  std::vector<Cluster> clusters(1);
  clusters[0].pieces.push_back({1, {0.0, 40.0}, false, 5.0});
  std::vector<std::string> reasons(2);
  const RefinementPlan plan = resolve_conflicts(task, clusters, reasons, 0);
  EXPECT_TRUE(clusters.empty());
  EXPECT_TRUE(plan.columns.empty());
  EXPECT_EQ(reasons, (std::vector<std::string>{"", "its cavity stays in another one's way"}));
}

}  // namespace
}  // namespace wellknit
