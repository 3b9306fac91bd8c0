// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What a deck says of connections and pore volumes, on grids small enough to work out by hand. The same rules against
// OPM Flow's own numbers, on generated decks: tests/simulators/compare_with_flow.py.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "algorithm/array_edits.h"
#include "algorithm/build_mesh.h"
#include "algorithm/host_balance.h"
#include "algorithm/host_multipliers.h"
#include "model/errors.h"
#include "tests/support/grids.h"
#include "tests/support/host_checks.h"
#include "tests/support/near_well.h"

namespace wellknit {
namespace {

BuildResult host_of(const CornerPointGrid& grid) { return build_mesh({grid, {}, {}, {}}, {}, {}); }

/// Transmissibility between two source cells of a mesh without wells; 0 where there is no connection.
double between(const Mesh& mesh, HostCellId a, HostCellId b) {
  double sum = 0.0;
  for (std::size_t n = 0; n < mesh.connections.size(); ++n) {
    const auto [one, other] = mesh.connections.cells[ConnectionId(n)];
    const HostCellId s = mesh.cells.source_cell[one];
    const HostCellId t = mesh.cells.source_cell[other];
    if ((s == a && t == b) || (s == b && t == a)) sum += mesh.connections.transmissibility[ConnectionId(n)];
  }
  return sum;
}

TEST(HostMultipliers, MultiplyHighSideOfTheLowerAndLowSideOfTheUpperCell) {
  auto grid = grids::box({3, 1, 1});
  grid.edits.face_multiplier[static_cast<std::size_t>(FaceDirection::i_plus)] = {0.5, 1.0, 1.0};
  grid.edits.face_multiplier[static_cast<std::size_t>(FaceDirection::i_minus)] = {1.0, 0.25, 4.0};
  const HostMultipliers multipliers(grid);
  EXPECT_EQ(multipliers.across(HostCellId(0), HostCellId(1), Axis::i), 0.5 * 0.25);
  EXPECT_EQ(multipliers.across(HostCellId(2), HostCellId(1), Axis::i), 4.0) << "in either order";
  const double plain = between(host_of(grids::box({3, 1, 1})).mesh, HostCellId(0), HostCellId(1));
  const Mesh mesh = host_of(grid).mesh;
  EXPECT_DOUBLE_EQ(between(mesh, HostCellId(0), HostCellId(1)), 0.125 * plain);
  EXPECT_EQ(mesh.connections.multiplier[ConnectionId(0)], 0.125);
}

TEST(HostMultipliers, FaultsMultiplyTheFacesTheyName) {
  auto grid = grids::box({3, 2, 2});
  grid.edits.faults.push_back({"F", {{{{0, 0, 0}, {0, 1, 0}}, FaceDirection::i_plus}}, 0.1});
  const HostMultipliers multipliers(grid);
  EXPECT_EQ(multipliers.across(grid.cell_id(0, 1, 0), grid.cell_id(1, 1, 0), Axis::i), 0.1);
  EXPECT_EQ(multipliers.across(grid.cell_id(0, 1, 1), grid.cell_id(1, 1, 1), Axis::i), 1.0) << "another layer";
  EXPECT_EQ(multipliers.across(grid.cell_id(1, 0, 0), grid.cell_id(2, 0, 0), Axis::i), 1.0);
}

TEST(HostMultipliers, LastRecordOfAPairOfRegionsCounts) {
  auto grid = grids::box({2, 1, 2});
  grid.properties["MULTNUM"] = std::vector<std::int32_t>{1, 2, 1, 2};
  auto record = RegionMultiplier{1, 2, 0.5, {true, true, true}, RegionConnections::all, RegionSet::multnum};
  grid.edits.region_multipliers = {record};
  record.from = 2;
  record.to = 1;
  record.multiplier = 0.2;
  record.directions = {true, false, false};
  grid.edits.region_multipliers.push_back(record);
  const HostMultipliers multipliers(grid);
  EXPECT_EQ(multipliers.across(HostCellId(0), HostCellId(1), Axis::i), 0.2);
  EXPECT_EQ(multipliers.across(HostCellId(0), HostCellId(2), Axis::k), 1.0) << "one region";
  EXPECT_EQ(multipliers.of_regions(HostCellId(0), HostCellId(1), Axis::j), 1.0) << "not a direction of the record";
}

TEST(HostMultipliers, RegionRecordsTellNeighboursFromOtherConnections) {
  auto grid = grids::faulted({2, 1, 2}, 2.0);
  grid.properties["MULTNUM"] = std::vector<std::int32_t>{1, 2, 1, 2};
  auto record = RegionMultiplier{1, 2, 0.5, {true, true, true}, RegionConnections::only_neighbours, RegionSet::multnum};
  grid.edits.region_multipliers = {record};
  EXPECT_EQ(HostMultipliers(grid).across(HostCellId(0), HostCellId(1), Axis::i), 0.5);
  EXPECT_EQ(HostMultipliers(grid).across(HostCellId(2), HostCellId(1), Axis::i), 1.0) << "another layer: an NNC";
  grid.edits.region_multipliers[0].connections = RegionConnections::only_non_neighbours;
  EXPECT_EQ(HostMultipliers(grid).across(HostCellId(0), HostCellId(1), Axis::i), 1.0);
  EXPECT_EQ(HostMultipliers(grid).across(HostCellId(2), HostCellId(1), Axis::i), 0.5);
}

TEST(HostMultipliers, AskForTheRegionsTheyNeed) {
  auto grid = grids::box({2, 1, 1});
  grid.edits.region_multipliers = {{1, 2, 0.5, {true, true, true}, RegionConnections::all, RegionSet::fluxnum}};
  EXPECT_THROW(HostMultipliers{grid}, InvalidInput);
}

TEST(ArrayEdits, AreOneStepACell) {
  auto grid = grids::box({3, 1, 1});
  const auto step = [](ArrayOperation operation, double value, CellBox cells = {{0, 0, 0}, {2, 0, 0}}) {
    ArrayEdit edit;
    edit.operation = operation;
    edit.cells = cells;
    edit.value = value;
    return edit;
  };
  grid.edits.array_edits = {step(ArrayOperation::multiply, 2.0), step(ArrayOperation::add, 3.0),
                            step(ArrayOperation::at_most, 10.0), step(ArrayOperation::multiply, 0.5),
                            step(ArrayOperation::set, 7.0, {{1, 0, 0}, {1, 0, 0}})};
  const ArrayEdits edits(grid, ComputedArray::transmissibility_x);
  EXPECT_EQ(edits.applied(HostCellId(0), 1.0), (2.0 + 3.0) * 0.5);
  EXPECT_EQ(edits.applied(HostCellId(0), 100.0), 5.0) << "held at 10, then halved";
  EXPECT_EQ(edits.applied(HostCellId(1), 100.0), 7.0);
  EXPECT_TRUE(edits.is_set(HostCellId(1)));
  EXPECT_FALSE(edits.factor(HostCellId(0)));
  EXPECT_FALSE(ArrayEdits(grid, ComputedArray::transmissibility_y).exist());
}

TEST(SourcePoreVolume, FollowsMultipliersRegionsAndEdits) {
  auto grid = grids::box({3, 1, 1});  // 10 x 20 x 5 m, porosity 0.2: 200 m3
  grid.edits.pore_volume_multiplier = {2.0, 1.0, 1.0};
  grid.properties["MULTNUM"] = std::vector<std::int32_t>{1, 1, 5};
  grid.edits.region_pore_volumes = {{5, 0.5, RegionSet::multnum}};
  ArrayEdit edit;
  edit.array = ComputedArray::pore_volume;
  edit.cells = {{1, 0, 0}, {1, 0, 0}};
  edit.value = 77.0;
  grid.edits.array_edits = {edit};
  const Mesh mesh = host_of(grid).mesh;
  EXPECT_NEAR(mesh.cells.pore_volume[CellId(0)], 400.0, 1e-9);
  EXPECT_NEAR(mesh.cells.pore_volume[CellId(1)], 77.0, 1e-9);
  EXPECT_NEAR(mesh.cells.pore_volume[CellId(2)], 100.0, 1e-9);
}

TEST(PinchConnections, BridgeCellsThatMinpvLeavesOut) {
  auto grid = grids::box({1, 1, 3});
  const double plain = between(host_of(grid).mesh, HostCellId(0), HostCellId(1));  // two halves of 2.5 m
  grid.edits.least_pore_volume = 100.0;
  grid.porosity = {0.2, 0.05, 0.2};  // 200, 50, 200 m3
  const BuildResult without = host_of(grid);
  EXPECT_EQ(without.mesh.cells.size(), 2U);
  EXPECT_EQ(without.mesh.connections.size(), 0U) << "no PINCH, no bridge";
  grid.edits.pinch = PinchOptions{};
  grid.edits.pinch->largest_gap = 1e20;
  const Mesh bridged = host_of(grid).mesh;
  ASSERT_EQ(bridged.connections.size(), 1U);
  EXPECT_EQ(bridged.connections.kind[ConnectionId(0)], ConnectionKind::pinch_out);
  EXPECT_FALSE(bridged.connections.face[ConnectionId(0)].is_valid());
  EXPECT_DOUBLE_EQ(bridged.connections.transmissibility[ConnectionId(0)], plain) << "TOPBOT: the same two halves";
  grid.edits.pinch->transmissibility = PinchTransmissibility::all_layers;
  EXPECT_NEAR(between(host_of(grid).mesh, HostCellId(0), HostCellId(2)), plain / 2.0, 1e-9 * plain)
      << "ALL: 5 m of the layer between, as much again";
  grid.edits.pinch->across_gaps = false;
  EXPECT_EQ(host_of(grid).mesh.connections.size(), 0U) << "NOGAP: 5 m is above the threshold";
}

TEST(PinchConnections, TakeTheLeastMultiplierBetweenOnRequest) {
  auto grid = grids::box({1, 1, 3});
  grid.active = {1, 0, 1};
  grid.edits.pinch = PinchOptions{};
  grid.edits.pinch->threshold = 6.0;  // the cells are 5 m thick
  grid.edits.pinch->largest_gap = 1e20;
  grid.edits.face_multiplier[static_cast<std::size_t>(FaceDirection::k_plus)] = {0.5, 0.1, 1.0};
  EXPECT_EQ(host_of(grid).mesh.connections.multiplier[ConnectionId(0)], 0.5);
  grid.edits.pinch->multiplier = PinchMultiplier::all;
  EXPECT_EQ(host_of(grid).mesh.connections.multiplier[ConnectionId(0)], 0.1);
}

/// Of the two cells of a box of 10 x 20 x 5 m cells with 1 m between them: each half is k A / 2.5 m.
constexpr double across_gap = 1e-14 * 200.0 / 5.0;

TEST(PinchConnections, CrossGapsBetweenNeighboursWithoutPinch) {
  const Mesh mesh = host_of(grids::with_gap({1, 1, 2})).mesh;
  ASSERT_EQ(mesh.connections.size(), 1U);
  EXPECT_EQ(mesh.connections.kind[ConnectionId(0)], ConnectionKind::pinch_out);
  EXPECT_NEAR(mesh.connections.transmissibility[ConnectionId(0)], across_gap, 1e-12 * across_gap)
      << "as if the void were not there";
}

TEST(PinchConnections, CrossNoGapAboveItem3) {
  auto grid = grids::with_gap({1, 1, 2});
  grid.edits.pinch = PinchOptions{};
  grid.edits.pinch->largest_gap = 0.9;
  EXPECT_EQ(host_of(grid).mesh.connections.size(), 0U) << "the gap is 1 m";
  grid.edits.pinch->largest_gap = 1.0;
  EXPECT_EQ(host_of(grid).mesh.connections.size(), 1U);
  grid.edits.pinch->across_gaps = false;
  EXPECT_EQ(host_of(grid).mesh.connections.size(), 1U) << "NOGAP is about cells that MINPV leaves out";
}

TEST(PinchConnections, MeasureAGapWhereItIsLeast) {
  auto grid = grids::with_gap({1, 1, 2});
  grid.zcorn[grid.zcorn_index({0, 0, 1}, 1, 1, 0)] -= 0.7;  // 0.3 m at one corner
  grid.edits.pinch = PinchOptions{};
  grid.edits.pinch->largest_gap = 0.5;
  EXPECT_EQ(host_of(grid).mesh.connections.size(), 1U);
  grid.edits.pinch->largest_gap = 0.2;
  EXPECT_EQ(host_of(grid).mesh.connections.size(), 0U);
}

TEST(PinchConnections, TakeLayersNumberedUpwards) {
  auto grid = grids::with_gap({1, 1, 2});
  std::reverse(grid.zcorn.begin(), grid.zcorn.end());  // a box: corners of one horizon are alike
  grid.edits.pinch = PinchOptions{};
  grid.edits.pinch->largest_gap = 1.5;
  const Mesh mesh = host_of(grid).mesh;
  ASSERT_EQ(mesh.connections.size(), 1U);
  EXPECT_NEAR(mesh.connections.transmissibility[ConnectionId(0)], across_gap, 1e-12 * across_gap);
  grid.edits.pinch->largest_gap = 0.5;
  EXPECT_EQ(host_of(grid).mesh.connections.size(), 0U);
}

/// Three cells; the middle one without thickness, 0.4 m below the first and 0.6 m above the last.
CornerPointGrid flat_in_a_gap() {
  auto grid = grids::with_gap({1, 1, 3});
  for (int corner = 0; corner < 4; ++corner) {
    for (int dk = 0; dk < 2; ++dk) grid.zcorn[grid.zcorn_index({0, 0, 1}, corner & 1, corner >> 1, dk)] = 1005.4;
    grid.zcorn[grid.zcorn_index({0, 0, 2}, corner & 1, corner >> 1, 0)] = 1006.0;
    grid.zcorn[grid.zcorn_index({0, 0, 2}, corner & 1, corner >> 1, 1)] = 1011.0;
  }
  return grid;
}

TEST(PinchConnections, CrossACellWithoutThicknessOnlyWithPinch) {
  auto grid = flat_in_a_gap();
  EXPECT_EQ(host_of(grid).mesh.connections.size(), 0U);
  grid.edits.pinchout = true;
  EXPECT_NEAR(between(host_of(grid).mesh, HostCellId(0), HostCellId(2)), across_gap, 1e-12 * across_gap);
  grid.edits.pinch = PinchOptions{};
  grid.edits.pinch->largest_gap = 1.1;
  EXPECT_EQ(host_of(grid).mesh.connections.size(), 1U);
  grid.edits.pinch->largest_gap = 0.9;
  EXPECT_EQ(host_of(grid).mesh.connections.size(), 0U) << "0.4 m and 0.6 m";
}

TEST(PinchConnections, PinchoutBridgesNothingThick) {
  auto grid = grids::box({1, 1, 3});
  grid.edits.least_pore_volume = 100.0;
  grid.porosity = {0.2, 0.05, 0.2};
  grid.edits.pinchout = true;
  EXPECT_EQ(host_of(grid).mesh.connections.size(), 0U);
}

TEST(PinchConnections, FollowMultipliersAndTranzAcrossAGap) {
  auto grid = grids::with_gap({1, 1, 2});
  grid.edits.face_multiplier[static_cast<std::size_t>(FaceDirection::k_plus)] = {0.5, 1.0};
  grid.edits.face_multiplier[static_cast<std::size_t>(FaceDirection::k_minus)] = {1.0, 0.25};
  EXPECT_NEAR(between(host_of(grid).mesh, HostCellId(0), HostCellId(1)), 0.125 * across_gap, 1e-12 * across_gap);
  ArrayEdit edit;
  edit.array = ComputedArray::transmissibility_z;
  edit.operation = ArrayOperation::multiply;
  edit.cells = {{0, 0, 0}, {0, 0, 1}};
  edit.value = 2.0;
  grid.edits.array_edits = {edit};
  EXPECT_NEAR(between(host_of(grid).mesh, HostCellId(0), HostCellId(1)), 0.25 * across_gap, 1e-12 * across_gap);
}

TEST(EditConnections, AddMultiplyAndReplaceNonNeighbours) {
  auto grid = grids::box({3, 1, 1});
  const double plain = between(host_of(grid).mesh, HostCellId(0), HostCellId(1));
  grid.edits.non_neighbours = {{HostCellId(0), HostCellId(2), 1e-13},
                               {HostCellId(2), HostCellId(0), 2e-13},
                               {HostCellId(0), HostCellId(1), 5e-13}};
  grid.edits.non_neighbour_multipliers = {{HostCellId(1), HostCellId(0), 0.5}};
  Mesh mesh = host_of(grid).mesh;
  EXPECT_DOUBLE_EQ(between(mesh, HostCellId(0), HostCellId(2)), 3e-13) << "records of one pair add up";
  EXPECT_EQ(mesh.connections.kind[ConnectionId(2)], ConnectionKind::deck_nnc);
  EXPECT_DOUBLE_EQ(between(mesh, HostCellId(0), HostCellId(1)), 0.5 * plain + 5e-13);
  grid.edits.non_neighbour_transmissibilities = {{HostCellId(0), HostCellId(2), 9e-13}};
  EXPECT_DOUBLE_EQ(between(host_of(grid).mesh, HostCellId(0), HostCellId(2)), 9e-13);
  grid.edits.non_neighbour_multipliers = {{HostCellId(1), HostCellId(2), 0.5}, {HostCellId(0), HostCellId(2), 3.0}};
  grid.active = {1, 0, 1};
  const BuildResult result = host_of(grid);
  ASSERT_EQ(result.summary.notes.size(), 2U) << "EDITNNC of no connection; an NNC with an inactive cell";
}

TEST(EditConnections, ArraysOfEditChangeNeighboursOnly) {
  auto grid = grids::faulted({2, 1, 2}, 2.0);
  const Mesh plain = host_of(grid).mesh;
  ArrayEdit edit;
  edit.operation = ArrayOperation::multiply;
  edit.cells = {{0, 0, 0}, {1, 0, 1}};
  edit.value = 3.0;
  grid.edits.array_edits = {edit};
  const Mesh mesh = host_of(grid).mesh;
  EXPECT_DOUBLE_EQ(between(mesh, HostCellId(0), HostCellId(1)), 3.0 * between(plain, HostCellId(0), HostCellId(1)));
  EXPECT_DOUBLE_EQ(between(mesh, HostCellId(1), HostCellId(2)), between(plain, HostCellId(1), HostCellId(2)));
  EXPECT_GT(between(plain, HostCellId(1), HostCellId(2)), 0.0) << "across the fault";
}

/// A box of 9 x 9 x 5 cells of 20 m with a vertical well in its middle.
struct NearWell {
  CornerPointGrid grid = grids::box({9, 9, 5}, {20.0, 20.0, 4.0});
  std::vector<Well> wells{near_well::straight("W", {90.0, 90.0, 990.0}, {90.0, 90.0, 1030.0})};
  BuildResult build() const { return build_mesh({grid, {}, {}, {}}, wells, {}); }
};

TEST(EditConnections, BarriersBetweenLayersStayInsideTheWellsMesh) {
  NearWell near;
  near.grid.edits.face_multiplier[static_cast<std::size_t>(FaceDirection::k_plus)].assign(9 * 9 * 5, 1.0);
  auto& multiplier = near.grid.edits.face_multiplier[static_cast<std::size_t>(FaceDirection::k_plus)];
  for (std::size_t c = 81; c < 162; ++c) multiplier[c] = 0.0;  // below layer 2
  const BuildResult result = near.build();
  ASSERT_TRUE(result.summary.wells[0].meshed) << result.summary.wells[0].reason;
  const Mesh& mesh = result.mesh;
  std::int64_t across = 0;
  for (std::size_t n = 0; n < mesh.connections.size(); ++n) {
    const auto [a, b] = mesh.connections.cells[ConnectionId(n)];
    const bool is_across = (mesh.cells.center[a].z() - 1008.0) * (mesh.cells.center[b].z() - 1008.0) < 0.0;
    if (!is_across) continue;
    ++across;
    EXPECT_EQ(mesh.connections.transmissibility[ConnectionId(n)], 0.0);
  }
  EXPECT_GT(across, 81) << "host, transition and radial cells above and below the barrier";
}

TEST(EditConnections, NonNeighboursOfReplacedCellsAreShared) {
  NearWell near;
  const HostCellId middle = near.grid.cell_id(4, 4, 2);
  const HostCellId corner = near.grid.cell_id(0, 0, 0);
  near.grid.edits.non_neighbours = {{corner, middle, 1e-12}};
  const BuildResult result = near.build();
  ASSERT_TRUE(result.summary.wells[0].meshed);
  const Connections& c = result.mesh.connections;
  double sum = 0.0;
  std::int64_t count = 0;
  for (std::size_t n = 0; n < c.size(); ++n) {
    if (c.kind[ConnectionId(n)] != ConnectionKind::deck_nnc) continue;
    sum += c.transmissibility[ConnectionId(n)];
    ++count;
  }
  EXPECT_GT(count, 4);
  EXPECT_NEAR(sum, 1e-12, 1e-18);
}

TEST(HostBalance, CutTopsKeepTheVolumeOfTheirCorners) {
  // A twisted layer, 1 m thick, its corners 2 m above and below their mean; beside it 20 flat layers of 0.1 m, all of
  // whose lines cross its top and base near one corner.
  grids::Recipe recipe;
  recipe.dimensions = {2, 1, 20};
  recipe.pillar = [](std::int64_t i, std::int64_t j) {
    const double x = 50.0 * static_cast<double>(i);
    const double y = 50.0 * static_cast<double>(j);
    return std::array{Vec3(x, y, 900.0), Vec3(x, y, 1100.0)};
  };
  recipe.depth = [](std::array<std::int64_t, 3> cell, std::array<int, 3> corner) {
    if (cell[0] == 1) return 1000.5 + 0.1 * static_cast<double>(cell[2] + corner[2]);
    const double top = corner[0] != corner[1] ? 1002.0 : 998.0;
    return top + (cell[2] > 0 || corner[2] == 1 ? 1.0 : 0.0);
  };
  const CornerPointGrid grid = grids::make(recipe);
  const HostCheck check = check_host(grid, build_host_mesh(grid));
  EXPECT_TRUE(check.faults.empty()) << check.faults.front();
  EXPECT_LT(check.worst_volume, 0.01) << "0.18 without the points";
}

}  // namespace
}  // namespace wellknit
