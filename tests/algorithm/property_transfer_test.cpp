// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/property_transfer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numeric>

#include "algorithm/build_mesh.h"
#include "tests/support/near_well.h"

namespace wellknit {
namespace {

constexpr std::uint32_t seed = 20040913;

BuildResult random_case(near_well::Path path) {
  Case source = near_well::deformed(0.8);
  near_well::randomise(source.grid, seed);
  std::vector<std::int32_t> region(source.grid.porosity.size());
  for (std::size_t c = 0; c < region.size(); ++c) region[c] = static_cast<std::int32_t>(c % 3) + 1;
  source.grid.properties["FIPNUM"] = region;
  source.grid.properties["SWATINIT"] = source.grid.porosity;
  return build_mesh(source, {near_well::well(path, 12.0)}, {});
}

TEST(PropertyTransfer, ConservesPoreVolumeInEverySourceCell) {
  std::cout << "seed " << seed << '\n';
  Case source = near_well::deformed(0.8);
  near_well::randomise(source.grid, seed);
  const HostMesh host = build_host_mesh(source.grid);
  for (const auto path : {near_well::Path::curved, near_well::Path::vertical}) {
    const Mesh mesh = random_case(path).mesh;
    double expected = 0.0;
    for (std::size_t c = 0; c < source.grid.porosity.size(); ++c) {
      expected += host.volume[HostCellId(c)] * source.grid.porosity[c];
      double sum = 0.0;
      for (std::int64_t i = mesh.transfer.start[c]; i < mesh.transfer.start[c + 1]; ++i)
        sum += mesh.transfer.fraction[static_cast<std::size_t>(i)];
      ASSERT_NEAR(sum, 1.0, 1e-12);
    }
    const double found = std::accumulate(mesh.cells.pore_volume.begin(), mesh.cells.pore_volume.end(), 0.0);
    EXPECT_NEAR(found / expected, 1.0, 1e-12);
  }
}

TEST(PropertyTransfer, FillsMadeCellsToTheirVolume) {
  const Mesh mesh = random_case(near_well::Path::curved).mesh;
  const HostMesh host = build_host_mesh(near_well::deformed(0.8).grid);
  std::vector<double> filled(mesh.cells.size(), 0.0);
  for (std::size_t c = 0; c + 1 < mesh.transfer.start.size(); ++c)
    for (std::int64_t i = mesh.transfer.start[c]; i < mesh.transfer.start[c + 1]; ++i)
      filled[mesh.transfer.cell[static_cast<std::size_t>(i)].index()] +=
          mesh.transfer.fraction[static_cast<std::size_t>(i)] * host.volume[HostCellId(c)];
  for (std::size_t c = 0; c < filled.size(); ++c)
    if (mesh.cells.kind[CellId(c)] >= CellKind::transition) {
      EXPECT_NEAR(filled[c] / mesh.cells.volume[CellId(c)], 1.0, 0.02);
    }
}

TEST(PropertyTransfer, KeepsValuesInTheRangeOfTheSource) {
  const Mesh mesh = random_case(near_well::Path::curved).mesh;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const CellId cell(c);
    EXPECT_GE(mesh.cells.porosity[cell], 0.05);
    EXPECT_LE(mesh.cells.porosity[cell], 0.30);
    EXPECT_GE(mesh.cells.permeability[cell].x(), 1e-14);
    EXPECT_LE(mesh.cells.permeability[cell].x(), 1e-12);
    // Harmonic below arithmetic: k_v was a tenth of k_h in every source cell.
    EXPECT_LE(mesh.cells.permeability[cell].z(), 0.1 * mesh.cells.permeability[cell].x() * (1 + 1e-9));
  }
  const auto& region = std::get<std::vector<std::int32_t>>(mesh.cells.properties.at("FIPNUM"));
  EXPECT_TRUE(std::all_of(region.begin(), region.end(), [](std::int32_t r) { return r >= 1 && r <= 3; }));
  const auto& saturation = std::get<std::vector<double>>(mesh.cells.properties.at("SWATINIT"));
  for (std::size_t c = 0; c < saturation.size(); ++c) EXPECT_NEAR(saturation[c], mesh.cells.porosity[CellId(c)], 1e-12);
}

TEST(PropertyTransfer, InactiveCellsGiveNothing) {
  Case source = near_well::deformed(0.0);
  for (std::int64_t c = 0; c < source.grid.cell_count(); c += 7) source.grid.active[static_cast<std::size_t>(c)] = 0;
  const BuildResult result = build_mesh(source, {near_well::well(near_well::Path::curved, 12.0)}, {});
  EXPECT_TRUE(result.summary.wells[0].meshed) << result.summary.wells[0].reason;
  double expected = 0.0;
  for (const auto active : source.grid.active)
    expected += active * 40.0 * 40.0 * 15.0 * 0.2;  // cells of 40 x 40 x 15 m, porosity 0.2
  const auto& pv = result.mesh.cells.pore_volume;
  EXPECT_NEAR(std::accumulate(pv.begin(), pv.end(), 0.0) / expected, 1.0, 1e-12);
}

}  // namespace
}  // namespace wellknit
