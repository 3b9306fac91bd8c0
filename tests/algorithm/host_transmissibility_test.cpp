// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/host_transmissibility.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "readers/read_case.h"
#include "tests/support/grids.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/simulator_output.h"

namespace wellknit {
namespace {

using Pairs = std::map<std::pair<HostCellId, HostCellId>, double>;

/// All connections of the host, m3.
Pairs host_transmissibilities(const CornerPointGrid& grid) {
  const HostMesh mesh = build_host_mesh(grid);
  Pairs out;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const FaceId face(f);
    const auto [a, b] = mesh.faces.cells[face];
    if (!b.is_valid() || mesh.exists[b] == 0) continue;
    const Vec3 area = host_face_area_vector(mesh, face);
    const Axis axis = mesh.faces.axis[face];
    const double ta = host_half_transmissibility(grid, mesh, a, axis, area);
    const double tb = host_half_transmissibility(grid, mesh, b, axis, area);
    const double t = ta > 0.0 && tb > 0.0 ? 1.0 / (1.0 / ta + 1.0 / tb) : 0.0;
    // Written with the face, in the same pass; slivers in map coordinates lose digits.
    EXPECT_NEAR(mesh.faces.transmissibility[face], t, 1e-7 * t);
    if (t > 0.0) out[{a, b}] += t;
  }
  return out;
}

struct Difference {
  double worst = 0.0;  ///< relative, over pairs that both connect
  double sum = 0.0;    ///< of what only one connects, relative to the largest transmissibility
  std::size_t pairs = 0;
};

Difference compare(const Pairs& ours, const Pairs& theirs) {
  Difference out;
  double largest = 0.0;
  for (const auto& [pair, value] : theirs) largest = std::max(largest, value);
  for (const auto& [pair, value] : theirs) {
    const auto found = ours.find(pair);
    if (found == ours.end()) {
      out.sum += value / largest;
      continue;
    }
    ++out.pairs;
    out.worst = std::max(out.worst, std::abs(found->second / value - 1.0));
  }
  for (const auto& [pair, value] : ours)
    if (!theirs.contains(pair)) out.sum += value / largest;
  return out;
}

TEST(HostTransmissibility, HasTheValueOfAPlainBox) {
  // k A / (dx / 2), with the box's 10 x 20 x 5 m cells and k 1e-13, 2e-13, 1e-14 m2:
  const auto grid = grids::box({2, 2, 2});
  const auto mesh = build_host_mesh(grid);
  const HostCellId cell(0);
  EXPECT_NEAR(host_half_transmissibility(grid, mesh, cell, Axis::i, Vec3(100, 0, 0)) / (1e-13 * 100 / 5), 1.0, 1e-12);
  EXPECT_NEAR(host_half_transmissibility(grid, mesh, cell, Axis::j, Vec3(0, 50, 0)) / (2e-13 * 50 / 10), 1.0, 1e-12);
  EXPECT_NEAR(host_half_transmissibility(grid, mesh, cell, Axis::k, Vec3(0, 0, -200)) / (1e-14 * 200 / 2.5), 1.0,
              1e-12);
}

TEST(HostTransmissibility, AppliesNetToGrossToLateralFacesOnly) {
  auto grid = grids::box({1, 1, 1});
  grid.net_to_gross = {0.25};
  const auto mesh = build_host_mesh(grid);
  EXPECT_NEAR(host_half_transmissibility(grid, mesh, HostCellId(0), Axis::i, Vec3(100, 0, 0)), 0.25 * 1e-13 * 20,
              1e-24);
  EXPECT_NEAR(host_half_transmissibility(grid, mesh, HostCellId(0), Axis::k, Vec3(0, 0, 200)), 1e-14 * 80, 1e-24);
}

TEST(HostTransmissibility, IsNothingWithoutPermeability) {
  auto grid = grids::box({1, 1, 1});
  grid.permeability[0].clear();
  grid.permeability[1] = {0.0};
  const auto mesh = build_host_mesh(grid);
  EXPECT_EQ(host_half_transmissibility(grid, mesh, HostCellId(0), Axis::i, Vec3(100, 0, 0)), 0.0);
  EXPECT_EQ(host_half_transmissibility(grid, mesh, HostCellId(0), Axis::j, Vec3(0, 50, 0)), 0.0);
}

TEST(HostTransmissibility, TakesTheDistanceToTheWholeFaceForEveryPart) {
  const auto grid = grids::box({1, 1, 1});
  const auto mesh = build_host_mesh(grid);
  const double whole = host_half_transmissibility(grid, mesh, HostCellId(0), Axis::i, Vec3(100, 0, 0));
  const double quarter = host_half_transmissibility(grid, mesh, HostCellId(0), Axis::i, Vec3(25, 0, 0));
  EXPECT_NEAR(quarter / whole, 0.25, 1e-12);
}

TEST(HostTransmissibility, TakesTopsByTheirFourCorners) {
  // Between skew pillars the crossings on a top's edges bulge; without them it is the quad of its corners.
  const auto grid = grids::twisted_fault({4, 4, 3}, 8.0);
  const HostMesh mesh = build_host_mesh(grid);
  int cut_tops = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const FaceId face(f);
    if (mesh.faces.axis[face] != Axis::k || mesh.faces.loop(face).size() == 4) continue;
    ++cut_tops;
    const auto corners = grid.corners(mesh.faces.cells[face][0]);
    const Vec3 diagonals =
        0.5 * (corners[3] - corners[0]).cross(corners[2] - corners[1]);  // of a top; a base is 5 m below
    const Vec3 base = 0.5 * (corners[7] - corners[4]).cross(corners[6] - corners[5]);
    const Vec3 area = host_face_area_vector(mesh, face);
    EXPECT_LT(std::min({(area - diagonals).norm(), (area + diagonals).norm(), (area - base).norm()}), 1e-9);
  }
  EXPECT_GT(cut_tops, 4);
}

TEST(HostTransmissibility, IsWrittenWithEveryFace) {
  for (const auto& [name, grid] : grids::zoo()) {
    SCOPED_TRACE(name);
    EXPECT_EQ(host_transmissibilities(grid).empty(), grid.cell_count() == 1);
  }
  auto bare = grids::box({2, 1, 1});
  for (auto& k : bare.permeability) k.clear();
  EXPECT_TRUE(build_host_mesh(bare).faces.transmissibility.empty());
}

TEST(HostTransmissibility, EqualsFlowOverTheZoo) {
  if (!has_flow()) GTEST_SKIP() << "flow is not installed";
  for (auto& [name, grid] : grids::zoo()) {
    const ScratchFolder folder;
    const auto difference =
        compare(host_transmissibilities(grid), flow_transmissibilities(grid, folder.path().string()));
    // Flow's files hold single precision: 6e-8.
    EXPECT_LT(difference.worst, 1e-6) << name;
    EXPECT_LT(difference.sum, 1e-6) << name;
  }
}

TEST(HostTransmissibility, EqualsFlowOnPublicGrids) {
  if (!has_flow()) GTEST_SKIP() << "flow is not installed";
  for (const std::string file : {"spe9/SPE9_CP.DATA", "model5/MODEL5.DATA", "nwm/NWM.data", "reek/reek_sim.grdecl"}) {
    const std::string path = std::string(WELLKNIT_SHARED) + "/data/" + file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    CornerPointGrid grid = read_case(path).grid;
    const auto cells = static_cast<std::size_t>(grid.cell_count());
    if (grid.porosity.empty()) grid.porosity.assign(cells, 0.2);
    for (auto& k : grid.permeability)
      if (k.empty()) k.assign(cells, 1e-13);
    const ScratchFolder folder;
    const auto difference =
        compare(host_transmissibilities(grid), flow_transmissibilities(grid, folder.path().string()));
    RecordProperty(file, std::to_string(difference.worst));
    EXPECT_LT(difference.worst, 1e-6) << file;
    EXPECT_LT(difference.sum, 1e-6) << file;
  }
}

}  // namespace
}  // namespace wellknit
