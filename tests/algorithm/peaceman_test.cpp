// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/peaceman.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "model/errors.h"
#include "model/units.h"
#include "readers/read_case.h"
#include "tests/support/grids.h"

namespace wellknit {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

CornerPointGrid cube(double edge, const Vec3& permeability) {
  auto grid = grids::box({1, 1, 1}, Vec3::Constant(edge));
  for (int axis = 0; axis < 3; ++axis) grid.permeability[static_cast<std::size_t>(axis)] = {permeability[axis]};
  return grid;
}

Well straight_well(const Vec3& from, const Vec3& to) {
  Well well;
  well.trajectory = {{0.0, (to - from).norm()}, {from, to}};
  well.radial.bore_radius = 0.1;
  return well;
}

std::vector<HostWellConnection> indices(const CornerPointGrid& grid, const Well& well) {
  const CellLocator locator(grid);
  return peaceman_indices(grid, build_host_mesh(grid), well, cells_along(grid, locator, well.trajectory));
}

std::vector<HostWellConnection> completions(const CornerPointGrid& grid, const Well& well) {
  return completion_indices(grid, build_host_mesh(grid), well, {});
}

TEST(Peaceman, RadiusOfAnIsotropicSquareIsTheKnownFifthOfItsEdge) {
  // 0.28 sqrt(2) / 2 = 0.19799 of the edge: Peaceman's 0.2.
  EXPECT_NEAR(peaceman_radius(1e-13, 1e-13, 10.0, 10.0), 10.0 * 0.28 * std::sqrt(2.0) / 2.0, 1e-12);
}

TEST(Peaceman, RadiusOfAnAnisotropicRectangle) {
  // k_c / k_b = 16: roots 4 and 2. 0.28 sqrt(4 * 10^2 + 20^2 / 4) / (2 + 1/2) = 0.28 * 22.36068 / 2.5 = 2.504396.
  EXPECT_NEAR(peaceman_radius(1e-14, 16e-14, 10.0, 20.0), 0.28 * std::sqrt(500.0) / 2.5, 1e-12);
  // Turned by a quarter it is the same.
  EXPECT_DOUBLE_EQ(peaceman_radius(1e-14, 16e-14, 10.0, 20.0), peaceman_radius(16e-14, 1e-14, 20.0, 10.0));
}

TEST(Peaceman, IndexOfAVerticalWellInACube) {
  // r_o = 1.979899 m, ln(r_o / 0.1) = 2.985631; 2 pi * 1e-13 * 10 / 2.985631 = 2.104475e-12 m3.
  const auto found = indices(cube(10.0, Vec3::Constant(1e-13)), straight_well(Vec3(5, 5, 990), Vec3(5, 5, 1020)));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].well_index, 2.104475e-12, 1e-18);
  EXPECT_NEAR(found[0].measured_depth.from, 10.0, 1e-5);
  EXPECT_NEAR(found[0].measured_depth.to, 20.0, 1e-5);
}

TEST(Peaceman, IndexOfADiagonalIsThatOfTheCubesDiagonalLength) {
  // In an isotropic cube each axis gives the same index over the same projection: sqrt(3) times that of one axis.
  const auto grid = cube(10.0, Vec3::Constant(1e-13));
  const auto axis = indices(grid, straight_well(Vec3(5, 5, 1000), Vec3(5, 5, 1010)));
  const auto diagonal = indices(grid, straight_well(Vec3(0, 0, 1000), Vec3(10, 10, 1010)));
  ASSERT_EQ(diagonal.size(), 1U);
  EXPECT_NEAR(diagonal[0].well_index / axis[0].well_index, std::sqrt(3.0), 1e-6);
}

TEST(Peaceman, ProjectsOnAllAxesOfAnAnisotropicCell) {
  // Half the cell along x, a quarter along depth: x from 2 to 7, depth from 1002 to 1004.5.
  const auto grid = cube(10.0, Vec3(1e-13, 4e-13, 1e-14));
  const auto found = indices(grid, straight_well(Vec3(2, 5, 1002), Vec3(7, 5, 1004.5)));
  ASSERT_EQ(found.size(), 1U);
  const double x = two_pi * std::sqrt(4e-13 * 1e-14) * 5.0 / std::log(peaceman_radius(4e-13, 1e-14, 10, 10) / 0.1);
  const double z = two_pi * std::sqrt(1e-13 * 4e-13) * 2.5 / std::log(peaceman_radius(1e-13, 4e-13, 10, 10) / 0.1);
  EXPECT_NEAR(found[0].well_index / std::hypot(x, z), 1.0, 1e-6);
}

TEST(Peaceman, CountsOnlyOpenRangesAndSkin) {
  const auto grid = cube(10.0, Vec3::Constant(1e-13));
  Well well = straight_well(Vec3(5, 5, 1000), Vec3(5, 5, 1010));
  const double whole = indices(grid, well)[0].well_index;
  well.open = {{1.0, 2.0}, {4.0, 5.5}, {50.0, 60.0}};
  const auto open = indices(grid, well);
  ASSERT_EQ(open.size(), 1U);
  EXPECT_NEAR(open[0].well_index / whole, 0.25, 1e-6);  // (1 + 1.5) m of 10 m
  EXPECT_NEAR(open[0].measured_depth.from, 1.0, 1e-6);
  EXPECT_NEAR(open[0].measured_depth.to, 5.5, 1e-6);
  well.skin = std::log(0.28 * std::sqrt(2.0) / 2.0 * 10.0 / 0.1);  // doubles the resistance
  EXPECT_NEAR(indices(grid, well)[0].well_index / whole, 0.125, 1e-6);
  well.open = {{20.0, 30.0}};
  EXPECT_TRUE(indices(grid, well).empty());
}

TEST(Peaceman, AppliesNetToGrossToTheThickness) {
  auto grid = cube(10.0, Vec3::Constant(1e-13));
  const Well well = straight_well(Vec3(5, 5, 1000), Vec3(5, 5, 1010));
  const double gross = indices(grid, well)[0].well_index;
  grid.net_to_gross = {0.4};
  EXPECT_NEAR(indices(grid, well)[0].well_index / gross, 0.4, 1e-9);
}

TEST(Peaceman, AddsUpTheBendsOfAPathInOneCell) {
  const auto grid = cube(10.0, Vec3::Constant(1e-13));
  Well bent = straight_well(Vec3(5, 5, 1000), Vec3(5, 5, 1010));
  const double whole = indices(grid, bent)[0].well_index;
  bent.trajectory = {{0.0, 5.0, 10.0}, {Vec3(5, 5, 1000), Vec3(5, 5, 1005), Vec3(5, 5, 1010)}};
  const auto found = indices(grid, bent);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].well_index / whole, 1.0, 1e-6);
}

TEST(Peaceman, FullPassThroughASlantedCellCountsItsWholeThickness) {
  // Along the axis of a twisted cell, from the middle of its top to that of its base: the same as a COMPDAT completion.
  const auto grid = grids::twisted({3, 3, 1});
  const HostCellId cell = grid.cell_id(1, 1, 0);
  const auto corners = grid.corners(cell);
  Well well = straight_well(trilinear(corners, Vec3(0.5, 0.5, 0)), trilinear(corners, Vec3(0.5, 0.5, 1)));
  const auto along_path = indices(grid, well);
  ASSERT_EQ(along_path.size(), 1U);
  DeckCompletion completion;
  completion.cell = cell;
  completion.diameter = 0.2;
  well.completions = {completion};
  const auto by_deck = completions(grid, well);
  ASSERT_EQ(by_deck.size(), 1U);
  EXPECT_NEAR(along_path[0].well_index / by_deck[0].well_index, 1.0, 1e-6);
}

TEST(Peaceman, LeavesOutInactiveCellsAndCellsWithoutPermeability) {
  auto grid = grids::box({1, 1, 4});
  grid.active[1] = 0;
  grid.permeability[0][2] = 0.0;
  const auto found = indices(grid, straight_well(Vec3(5, 10, 999), Vec3(5, 10, 1030)));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].cell, HostCellId(0));
  EXPECT_EQ(found[1].cell, HostCellId(3));
}

TEST(Peaceman, RefusesABoreWiderThanTheCellsRadius) {
  const auto grid = cube(10.0, Vec3::Constant(1e-13));  // r_o = 1.98 m
  Well well = straight_well(Vec3(5, 5, 1000), Vec3(5, 5, 1010));
  well.radial.bore_radius = 2.0;
  EXPECT_THROW((void)indices(grid, well), InvalidInput);
  well.radial.bore_radius = 0.1;
  well.skin = -3.0;  // ln(19.8) = 2.99
  EXPECT_THROW((void)indices(grid, well), InvalidInput);
}

TEST(CompletionIndices, TakesTheDecksFactorAndOnlyOpenOnes) {
  const auto grid = grids::box({1, 1, 3});
  Well well;
  well.completions.resize(3);
  for (std::size_t k = 0; k < 3; ++k) well.completions[k].cell = HostCellId(k);
  well.completions[0].connection_factor = 3.5e-12;
  well.completions[1].open = false;
  well.completions[2].connection_factor = 1.5e-12;
  const auto found = completions(grid, well);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].well_index, 3.5e-12);
  EXPECT_EQ(found[1].cell, HostCellId(2));
}

TEST(CompletionIndices, UsesTheDirectionTheDiameterAndTheGivenPermeabilityThickness) {
  const auto grid = grids::box({1, 1, 1});  // 10 x 20 x 5 m; k 1e-13, 2e-13, 1e-14 m2
  Well well;
  well.completions.resize(1);
  DeckCompletion& completion = well.completions[0];
  completion.cell = HostCellId(0);
  completion.direction = 'X';
  completion.diameter = 0.25;
  completion.skin = 1.5;
  const double resistance = std::log(peaceman_radius(2e-13, 1e-14, 20.0, 5.0) / 0.125) + 1.5;
  EXPECT_NEAR(completions(grid, well)[0].well_index / (two_pi * std::sqrt(2e-27) * 10.0 / resistance), 1.0, 1e-9);
  completion.permeability_thickness = 7e-13;
  EXPECT_NEAR(completions(grid, well)[0].well_index / (two_pi * 7e-13 / resistance), 1.0, 1e-9);
  completion = {};
  completion.cell = HostCellId(0);  // no diameter: one foot
  const double z = std::log(peaceman_radius(1e-13, 2e-13, 10.0, 20.0) / 0.1524);
  EXPECT_NEAR(completions(grid, well)[0].well_index / (two_pi * std::sqrt(2e-26) * 5.0 / z), 1.0, 1e-9);
}

TEST(CompletionIndices, ReplacesARepeatedCell) {
  const auto grid = grids::box({1, 1, 1});
  Well well;
  well.completions.resize(2);
  for (auto& completion : well.completions) completion.cell = HostCellId(0);
  well.completions[0].connection_factor = 1e-12;
  well.completions[1].connection_factor = 2e-12;
  const auto found = completions(grid, well);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].well_index, 2e-12);
}

TEST(CompletionIndices, EqualFlowsConnectionFactorsOfSpe9) {
  const std::string path = std::string(WELLKNIT_SHARED) + "/data/spe9/SPE9_CP.DATA";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  // Flow 2022.10: item 0 of SCON in the restart file after one day, cP rb / (day psi), single precision.
  struct Expected {
    const char* well;
    std::array<std::int64_t, 3> cell;  ///< 1-based, as in the deck
    double factor;
  };
  const std::vector<Expected> expected{{"INJE1", {24, 25, 11}, 0.16582094},  {"INJE1", {24, 25, 14}, 12.443308},
                                       {"PRODU2", {5, 1, 2}, 0.89350754},    {"PRODU2", {5, 1, 3}, 3.8287203},
                                       {"PRODU14", {8, 13, 2}, 180.99503},   {"PRODU14", {8, 13, 4}, 0.5317784},
                                       {"PRODU26", {17, 25, 2}, 0.77023864}, {"PRODU26", {17, 25, 4}, 0.17576405}};
  const Case spe9 = read_case(path);
  const HostMesh host = build_host_mesh(spe9.grid);
  const CellLocator locator(spe9.grid);
  const double unit = m3_per_transmissibility_unit(UnitSystem::field);
  for (const Expected& e : expected) {
    const auto well =
        std::find_if(spe9.deck_wells.begin(), spe9.deck_wells.end(), [&](const Well& w) { return w.name == e.well; });
    ASSERT_NE(well, spe9.deck_wells.end()) << e.well;
    const auto found = completion_indices(spe9.grid, host, *well, cells_along(spe9.grid, locator, well->trajectory));
    const HostCellId cell = spe9.grid.cell_id(e.cell[0] - 1, e.cell[1] - 1, e.cell[2] - 1);
    const auto connection = std::find_if(found.begin(), found.end(), [&](const auto& c) { return c.cell == cell; });
    ASSERT_NE(connection, found.end()) << e.well;
    EXPECT_NEAR(connection->well_index / unit / e.factor, 1.0, 1e-6) << e.well << " layer " << e.cell[2];
    EXPECT_GT(connection->measured_depth.to, connection->measured_depth.from) << e.well << " layer " << e.cell[2];
  }
}

}  // namespace
}  // namespace wellknit
