// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/cell_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/support/meshes.h"

namespace wellknit {
namespace {

std::vector<std::int64_t> places(const Mesh& mesh, CellOrder order) {
  const std::vector<CellId> cells = ordered_cells(mesh, order);
  std::vector<std::int64_t> out(cells.size(), -1);
  for (std::size_t n = 0; n < cells.size(); ++n) out[cells[n].index()] = static_cast<std::int64_t>(n);
  return out;
}

/// How far the two cells of a connection are apart at most.
std::int64_t bandwidth(const Mesh& mesh, const std::vector<std::int64_t>& place) {
  std::int64_t widest = 0;
  for (const auto& [a, b] : mesh.connections.cells)
    widest = std::max(widest, std::abs(place[a.index()] - place[b.index()]));
  return widest;
}

TEST(CellOrder, HasEveryCellOnce) {
  for (const Mesh& mesh : {meshes::two_boxes(), meshes::box_grid(4), meshes::ring_in_boxes()})
    for (const CellOrder order : {CellOrder::mesh, CellOrder::layer, CellOrder::rcm}) {
      std::vector<std::int64_t> sorted = places(mesh, order);
      std::sort(sorted.begin(), sorted.end());
      std::vector<std::int64_t> all(mesh.cells.size());
      std::iota(all.begin(), all.end(), 0);
      EXPECT_EQ(sorted, all);
    }
}

TEST(CellOrder, OfTheMeshIsTheMeshs) {
  const std::vector<CellId> cells = ordered_cells(meshes::box_grid(2), CellOrder::mesh);
  for (std::size_t n = 0; n < cells.size(); ++n) EXPECT_EQ(cells[n], CellId(n));
}

TEST(CellOrder, CuthillMcKeeMakesAShuffledRowNarrow) {
  // Nine cells in a row, numbered by multiples of 5 modulo 9: neighbours are 4 or 5 apart, and 1 in the right order.
  Mesh mesh;
  mesh.cells = meshes::box_grid(3).cells;
  mesh.cells.kind = IdVector<CellId, CellKind>(9, CellKind::host);
  for (int n = 0; n < 8; ++n) {
    const CellId a(n * 5 % 9);
    const CellId b((n + 1) * 5 % 9);
    mesh.connections.cells.push_back({std::min(a, b), std::max(a, b)});
  }
  EXPECT_EQ(bandwidth(mesh, places(mesh, CellOrder::mesh)), 5);
  EXPECT_EQ(bandwidth(mesh, places(mesh, CellOrder::rcm)), 1);
}

TEST(CellOrder, CuthillMcKeeIsNarrowerThanTheMeshs) {
  const Mesh mesh = meshes::ring_in_boxes();
  EXPECT_LT(bandwidth(mesh, places(mesh, CellOrder::rcm)), bandwidth(mesh, places(mesh, CellOrder::mesh)));
}

TEST(CellOrder, OfLayersFollowsTheSource) {
  // Cells of the grid in reverse: layer, row and column put them right again.
  Mesh mesh = meshes::box_grid(2);
  for (int c = 0; c < 8; ++c) mesh.cells.source_cell[CellId(c)] = HostCellId(7 - c);
  EXPECT_EQ(places(mesh, CellOrder::layer), (std::vector<std::int64_t>{7, 6, 5, 4, 3, 2, 1, 0}));
}

TEST(CellOrder, MainSourceCellHoldsMostOfTheVolume) {
  Mesh mesh = meshes::two_boxes();
  mesh.cells.source_cell = IdVector<CellId, HostCellId>(2, HostCellId());
  mesh.transfer.start = {0, 2, 3, 3};
  mesh.transfer.cell = {CellId(0), CellId(1), CellId(1)};
  mesh.transfer.fraction = {0.5, 0.5, 1.0};
  mesh.source_volumes.bulk = {3.0, 1.0, 1.0};
  // Of cell 1, 1.5 m3 lie in the first source cell and 1 m3 in the second.
  EXPECT_EQ(main_source_cells(mesh)[CellId(1)], HostCellId(0));
  mesh.source_volumes.bulk = {1.0, 1.0, 1.0};
  EXPECT_EQ(main_source_cells(mesh)[CellId(1)], HostCellId(1));
}

}  // namespace
}  // namespace wellknit
