// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/split_columns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "algorithm/build_mesh.h"
#include "model/errors.h"
#include "model/mesh_check.h"
#include "tests/support/grids.h"
#include "tests/support/near_well.h"

namespace wellknit {
namespace {

BuildResult split(const CornerPointGrid& grid, const std::vector<Well>& wells, int parts) {
  Case source;
  source.grid = grid;
  BuildOptions options;
  options.split = parts;
  return build_mesh(source, wells, options);
}

TEST(SplitColumns, KeepsVolumesAndCloses) {
  for (const auto& [name, grid] : grids::zoo()) {
    const BuildResult whole = split(grid, {}, 1);
    for (const int parts : {2, 3}) {
      const BuildResult result = split(grid, {}, parts);
      double expected = 0.0;
      double volume = 0.0;
      for (const double v : whole.mesh.cells.pore_volume.raw()) expected += v;
      for (const double v : result.mesh.cells.pore_volume.raw()) volume += v;
      EXPECT_NEAR(volume / expected, 1.0, 1e-12) << name;
      EXPECT_LE(check_mesh(result.mesh).size(), check_mesh(whole.mesh).size()) << name;
      for (const CellKind kind : result.mesh.cells.kind.raw()) EXPECT_EQ(kind, CellKind::refined) << name;
    }
  }
}

/// Pillars that lean to all sides: the straight lines between them are not those of a trilinear cell.
CornerPointGrid leaning() {
  CornerPointGrid grid = grids::box({4, 3, 5});
  for (std::size_t p = 0; p < grid.coord.size() / 6; ++p) {
    double* const pillar = grid.coord.data() + 6 * p;
    pillar[3] += 4.0 * std::sin(1.7 * static_cast<double>(p));
    pillar[4] += 6.0 * std::cos(2.3 * static_cast<double>(p));
  }
  // Dipping horizons: corners of one cell are at different depths.
  for (std::size_t n = 0; n < grid.zcorn.size(); ++n) {
    const std::size_t along = n % 8;  // two corners for each of four cells along i
    grid.zcorn[n] += 3.0 * static_cast<double>((along + 1) / 2);
  }
  return grid;
}

TEST(SplitColumns, KeepsTheBulkVolumeWherePillarsLean) {
  const CornerPointGrid grid = leaning();
  const auto volume_of = [](const BuildResult& result) {
    const auto& volume = result.mesh.cells.volume.raw();
    return std::accumulate(volume.begin(), volume.end(), 0.0);
  };
  const double expected = volume_of(split(grid, {}, 1));
  for (const int parts : {2, 5}) {
    const BuildResult result = split(grid, {}, parts);
    EXPECT_NEAR(volume_of(result) / expected, 1.0, 1e-12);
    // Cell by cell too: what a source cell's parts have is its own volume.
    const Transfer& transfer = result.mesh.transfer;
    for (std::size_t c = 0; c + 1 < transfer.start.size(); ++c) {
      double sum = 0.0;
      for (std::int64_t at = transfer.start[c]; at < transfer.start[c + 1]; ++at)
        sum += result.mesh.cells.volume[transfer.cell[static_cast<std::size_t>(at)]];
      EXPECT_NEAR(sum / result.mesh.source_volumes.bulk[c], 1.0, 1e-12);
    }
  }
}

TEST(SplitColumns, OfABoxAreTheCellsOfAFinerBox) {
  const BuildResult result = split(grids::box({3, 2, 4}), {}, 3);
  ASSERT_EQ(result.mesh.cells.size(), 3U * 2 * 4 * 9);
  for (const double v : result.mesh.cells.volume.raw()) EXPECT_NEAR(v, 10.0 * 20.0 * 5.0 / 9.0, 1e-9);
  // Half transmissibilities in series: k A / d across i, of cells of 10/3 x 20/3 x 5 m and 1e-13 m2.
  const double expected = 1e-13 * (20.0 / 3.0 * 5.0) / (10.0 / 3.0);
  const auto& c = result.mesh.connections;
  std::size_t count = 0;
  for (std::size_t n = 0; n < c.size(); ++n) {
    if (std::abs(c.normal[ConnectionId(n)].x()) < 0.9) continue;
    EXPECT_NEAR(c.transmissibility[ConnectionId(n)] / expected, 1.0, 1e-9);
    ++count;
  }
  EXPECT_EQ(count, 8U * 6 * 4);
}

TEST(SplitColumns, ConnectsAWellInTheMiddlePart) {
  const CornerPointGrid grid = grids::box({3, 3, 4});
  Well well = near_well::straight("W", {15, 30, 1000}, {15, 30, 1020});
  // What a deck states for whole cells does not count.
  DeckCompletion completion;
  completion.cell = grid.cell_id(1, 1, 0);
  completion.connection_factor = 1.0;
  well.completions.push_back(completion);
  const BuildResult result = split(grid, {well}, 3);
  const auto& connections = result.mesh.wells[WellId(0)].connections;
  ASSERT_EQ(connections.size(), 4U);
  // Peaceman in a part: k_x 1e-13, k_y 2e-13 m2, 10/3 x 20/3 x 5 m.
  const double ratio = std::sqrt(2.0);  // sqrt(k_y / k_x)
  const double dx = 10.0 / 3.0;
  const double dy = 20.0 / 3.0;
  const double radius =
      0.28 * std::sqrt(ratio * dx * dx + dy * dy / ratio) / (std::sqrt(ratio) + 1.0 / std::sqrt(ratio));
  const double expected = 2.0 * std::numbers::pi * std::sqrt(2.0) * 1e-13 * 5.0 / std::log(radius / 0.1);
  for (const WellConnection& c : connections) {
    const Vec3& center = result.mesh.cells.center[c.cell];
    EXPECT_NEAR(center.x(), 15.0, 1e-9);
    EXPECT_NEAR(center.y(), 30.0, 1e-9);
    EXPECT_NEAR(c.well_index / expected, 1.0, 1e-8);
  }
  EXPECT_FALSE(result.summary.wells[0].meshed);
  EXPECT_EQ(result.summary.wells[0].reason, "--split 3: finer columns, and no mesh around wells");
}

TEST(SplitColumns, RefusesMoreThanCanBeNumbered) {
  CornerPointGrid grid;
  grid.dimensions = {100000, 100000, 1};
  EXPECT_THROW(uniform_refinement(grid, 3), InvalidInput);
}

}  // namespace
}  // namespace wellknit
