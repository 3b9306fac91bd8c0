// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/rock_tensor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/grids.h"

namespace wellknit {
namespace {

/// A box of 2 x 1 x 1 cells of 10 x 20 x 5 m whose layers dip towards i by 3 in 4 in column 1 and not at all in column
/// 0.
CornerPointGrid bent() {
  CornerPointGrid grid = grids::box({2, 1, 1});
  for (int level = 0; level < 2; ++level)
    for (int dj = 0; dj < 2; ++dj) grid.zcorn[static_cast<std::size_t>(3 + 4 * (dj + 2 * level))] += 7.5;
  return grid;
}

TEST(RockTensor, AxesLieInTheLayer) {
  const CornerPointGrid grid = bent();
  const HostMesh host = build_host_mesh(grid);
  EXPECT_NEAR((layer_axes(host, HostCellId(0)) - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-15);
  // Along (4, 0, 3) / 5; down across it (-3, 0, 4) / 5.
  const Eigen::Matrix3d axes = layer_axes(host, HostCellId(1));
  EXPECT_NEAR((axes.col(0) - Vec3(0.8, 0.0, 0.6)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((axes.col(1) - Vec3(0.0, 1.0, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((axes.col(2) - Vec3(-0.6, 0.0, 0.8)).norm(), 0.0, 1e-15);
  // Twisted, and j towards negative y: the normal points down all the same, about along depth.
  EXPECT_GT(layer_axes(build_host_mesh(grids::left_handed({1, 1, 1})), HostCellId(0))(2, 2), 0.5);
}

/// One made cell of source cells 0 and 1 (in these parts), after one host cell.
Assembly one_made_cell(const std::array<double, 2>& parts) {
  Assembly out;
  Cells& cells = out.mesh.cells;
  for (const CellKind kind : {CellKind::host, CellKind::transition}) {
    cells.kind.push_back(kind);
    cells.permeability.push_back({2.0, 3.0, 0.5});
    cells.net_to_gross.push_back(0.5);
  }
  out.host_cell = {HostCellId(1)};
  out.first_transition_cell = {1};
  out.mesh.transfer.start = {0, 1, 2};
  out.mesh.transfer.cell = {CellId(1), CellId(1)};
  out.mesh.transfer.fraction = {parts[0], parts[1]};
  return out;
}

TEST(RockTensor, TurnsWithTheLayerThatTheCellIsMadeFrom) {
  const CornerPointGrid grid = bent();
  const HostMesh host = build_host_mesh(grid);
  Assembly assembly = one_made_cell({0.0, 1.0});
  // Lateral ones with net to gross: 1, 1.5; normal 0.5. Without axes along x, y, depth.
  EXPECT_NEAR((rock_tensor(assembly, CellId(1)).diagonal() - Vec3(1.0, 1.5, 0.5)).norm(), 0.0, 1e-15);
  set_rock_axes(host, assembly);
  // c = 0.8, s = 0.6: xx = c2 + 0.5 s2 = 0.82, zz = s2 + 0.5 c2 = 0.68, xz = (1 - 0.5) c s = 0.24.
  Eigen::Matrix3d wanted = Vec3(0.82, 1.5, 0.68).asDiagonal();
  wanted(0, 2) = wanted(2, 0) = 0.24;
  EXPECT_NEAR((rock_tensor(assembly, CellId(1)) - wanted).norm(), 0.0, 1e-14);
  EXPECT_NEAR((rock_tensor(assembly, host, CellId(1)) - wanted).norm(), 0.0, 1e-14);
  // The host cell is source cell 1.
  EXPECT_NEAR((rock_tensor(assembly, host, CellId(0)) - wanted).norm(), 0.0, 1e-14);
}

TEST(RockTensor, AveragesTheAxesOfSeveralLayers) {
  const CornerPointGrid grid = bent();
  const HostMesh host = build_host_mesh(grid);
  // Both have 10 x 20 x 5 m3: the mean of the normals (0, 0, 1) and (-0.6, 0, 0.8) is along (-0.6, 0, 1.8).
  Assembly assembly = one_made_cell({0.5, 0.5});
  set_rock_axes(host, assembly);
  EXPECT_NEAR((assembly.rock_axes[0].col(2) - Vec3(-1.0, 0.0, 3.0) / std::sqrt(10.0)).norm(), 0.0, 1e-14);
  // Nothing known: along x, y, depth.
  assembly = one_made_cell({0.0, 0.0});
  set_rock_axes(host, assembly);
  EXPECT_EQ(assembly.rock_axes[0], Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
}

}  // namespace
}  // namespace wellknit
