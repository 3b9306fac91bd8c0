// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/host_refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <random>

#include "model/errors.h"
#include "tests/support/grids.h"
#include "tests/support/host_checks.h"
#include "tests/support/random_seed.h"
#include "tests/support/refinements.h"
#include "tests/support/rounds.h"

namespace wellknit {
namespace {

using refinements::Dice;
using refinements::random_demands;
using refinements::whole_column;

struct Refined {
  RefinementPlan plan;
  HostMesh host;
};

Refined refined(const CornerPointGrid& grid, LatticePoint unit, const std::vector<RefinementDemand>& demands) {
  Refined out;
  out.host = build_host_mesh(grid);
  out.plan = plan_refinement(grid, out.host, unit, demands);
  refine_host(grid, out.plan, out.host);
  return out;
}

// --- The plan
// ---------------------------------------------------------------------------------------------------------

using Extent = std::array<std::int64_t, 2>;

/// Size of the column over each cell of the lattice; fails where columns overlap or leave one bare.
std::vector<Extent> sizes_of(const CornerPointGrid& grid, const RefinementPlan& plan) {
  const auto [u, v] = plan.unit;
  const std::int64_t width = grid.dimensions[0] * u;
  std::vector<Extent> size(static_cast<std::size_t>(width * grid.dimensions[1] * v), Extent{u, v});
  std::vector<int> covered(size.size(), 0);
  for (const RefinedColumn& column : plan.columns)
    for (std::int64_t y = column.low[1]; y < column.high[1]; ++y)
      for (std::int64_t x = column.low[0]; x < column.high[0]; ++x) {
        const auto at = static_cast<std::size_t>(x + width * y);
        EXPECT_EQ(covered[at]++, 0);
        EXPECT_EQ(column.source[0], x / u);
        EXPECT_EQ(column.source[1], y / v);
        size[at] = {column.high[0] - column.low[0], column.high[1] - column.low[1]};
      }
  for (std::int64_t y = 0; y < grid.dimensions[1] * v; ++y)
    for (std::int64_t x = 0; x < width; ++x)
      EXPECT_EQ(covered[static_cast<std::size_t>(x + width * y)],
                covered[static_cast<std::size_t>(x / u * u + width * (y / v * v))])
          << "a part of a column is refined";
  return size;
}

std::int64_t worst_ratio(const CornerPointGrid& grid, const RefinementPlan& plan) {
  const auto size = sizes_of(grid, plan);
  const std::int64_t width = grid.dimensions[0] * plan.unit[0];
  std::int64_t worst = 1;
  for (std::size_t n = 0; n < size.size(); ++n) {
    const auto x = static_cast<std::int64_t>(n) % width;
    for (const std::size_t other : {x + 1 < width ? n + 1 : n, n + static_cast<std::size_t>(width)}) {
      if (other >= size.size()) continue;
      for (std::size_t a = 0; a < 2; ++a)
        worst = std::max({worst, size[n][a] / size[other][a], size[other][a] / size[n][a]});
    }
  }
  return worst;
}

TEST(PlanRefinement, IsEmptyWithoutDemands) {
  const auto grid = grids::box({2, 2, 2});
  const HostMesh host = build_host_mesh(grid);
  EXPECT_TRUE(plan_refinement(grid, host, {8, 8}, {}).empty());
  const auto layers = ColumnLayers::of_source(2);
  EXPECT_TRUE(plan_refinement(grid, host, {8, 8}, {{{8, 8}, {{0, 0}}, layers}}).empty()) << "as it is already";
}

TEST(PlanRefinement, HalvesAroundADemandedColumn) {
  const auto grid = grids::box({1, 1, 2});
  const HostMesh host = build_host_mesh(grid);
  // 4 by 4 parts; the corner one is wanted: with its two neighbours of its size that is 2 by 2 parts, and 3 times 2
  // by 2.
  const auto plan = plan_refinement(grid, host, {4, 4}, {{{1, 1}, {{0, 0}}, ColumnLayers::of_source(2)}});
  EXPECT_LE(plan.columns.size(), 4U + 3U);
  EXPECT_EQ(worst_ratio(grid, plan), 2);
}

TEST(PlanRefinement, SplitsAlongOneAxisWhereOneIsWanted) {
  const auto grid = grids::box({1, 1, 2});
  const HostMesh host = build_host_mesh(grid);
  const auto demand = whole_column({0, 0}, {4, 4}, {1, 4}, ColumnLayers::of_source(2));
  const auto plan = plan_refinement(grid, host, {4, 4}, {demand});
  ASSERT_EQ(plan.columns.size(), 4U);
  for (const auto& column : plan.columns) EXPECT_EQ(column.high[1] - column.low[1], 4);
}

TEST(PlanRefinement, GradesOverSourceColumns) {
  const auto grid = grids::box({9, 9, 1});
  const HostMesh host = build_host_mesh(grid);
  const RefinementDemand demand{{1, 1}, {{4 * 16, 4 * 16}}, ColumnLayers::of_source(1)};
  const auto plan = plan_refinement(grid, host, {16, 16}, {demand});
  EXPECT_EQ(worst_ratio(grid, plan), 2);
  EXPECT_LT(plan.columns.size(), 200U);  // 4,096 parts of one size lie in the four columns around
}

TEST(PlanRefinement, PutsTheDemandsLayersOnItsColumnsAlone) {
  const auto grid = grids::box({3, 1, 2});
  const HostMesh host = build_host_mesh(grid);
  const ColumnLayers merged{{{{0, 0.0}, {1, 1.0}}}};
  const auto plan = plan_refinement(grid, host, {2, 2}, {{{1, 1}, {{2, 0}, {2, 1}}, merged}});
  ASSERT_EQ(plan.layers.size(), 2U);
  EXPECT_EQ(plan.layers[0], ColumnLayers::of_source(2));
  for (const auto& column : plan.columns) EXPECT_EQ(column.layers, column.low[0] == 2 ? 1 : 0);
}

TEST(PlanRefinement, RefusesWhatDoesNotFit) {
  const auto grid = grids::box({2, 2, 2});
  const HostMesh host = build_host_mesh(grid);
  const auto layers = ColumnLayers::of_source(2);
  const ColumnLayers merged{{{{0, 0.0}, {1, 1.0}}}};
  const auto plan = [&](const std::vector<RefinementDemand>& demands) {
    return plan_refinement(grid, host, {4, 4}, demands);
  };
  EXPECT_THROW(plan({{{3, 1}, {{0, 0}}, layers}}), InvalidInput);
  EXPECT_THROW(plan({{{8, 1}, {{0, 0}}, layers}}), InvalidInput);
  EXPECT_THROW(plan_refinement(grid, host, {3, 4}, {}), InvalidInput);
  EXPECT_THROW(plan({{{2, 2}, {{1, 0}}, layers}}), InvalidInput);
  EXPECT_THROW(plan({{{2, 2}, {{8, 0}}, layers}}), InvalidInput);
  EXPECT_THROW(plan({{{1, 1}, {{0, 0}}, layers}, {{2, 2}, {{0, 0}}, layers}}), InvalidInput);
  EXPECT_THROW(plan({{{1, 4}, {{0, 0}}, layers}, {{4, 1}, {{0, 0}}, layers}}), InvalidInput);
  EXPECT_THROW(plan({{{1, 1}, {{0, 0}}, layers}, {{1, 1}, {{0, 0}}, merged}}), InvalidInput);
  EXPECT_NO_THROW(plan({{{1, 1}, {{0, 0}}, merged}, {{1, 1}, {{0, 0}}, merged}}));
}

/// Levels of a column's cells as pairs of numbers: place and fraction in one.
std::vector<std::array<double, 2>> levels_of(const ColumnLayers& layers) {
  std::vector<std::array<double, 2>> out;
  for (const auto& cell : layers.cells)
    out.push_back({static_cast<double>(cell.upper.place) + cell.upper.fraction,
                   static_cast<double>(cell.lower.place) + cell.lower.fraction});
  return out;
}

/// A layer in eight parts, four layers in one, a layer as it is.
ColumnLayers eighths_and_stacks() {
  ColumnLayers layers;
  for (int n = 0; n < 8; ++n) layers.cells.push_back({{0, n / 8.0}, {0, (n + 1) / 8.0}});
  layers.cells.push_back({{1, 0.0}, {4, 1.0}});
  layers.cells.push_back({{5, 0.0}, {5, 1.0}});
  return layers;
}

/// The layers of a demanded column when some are needed.
std::vector<std::array<double, 2>> trimmed_levels(const std::vector<std::uint8_t>& is_needed) {
  const auto grid = grids::box({1, 1, 6});
  const HostMesh host = build_host_mesh(grid);
  auto plan = plan_refinement(grid, host, {1, 1}, {{{1, 1}, {{0, 0}}, eighths_and_stacks()}});
  trim_layers(plan, {{{0, 0}, is_needed}});
  return levels_of(plan.layers[static_cast<std::size_t>(plan.columns.front().layers)]);
}

TEST(TrimLayers, GivesTheSourcesLayersWhereNoneIsNeeded) {
  EXPECT_EQ(trimmed_levels({0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), levels_of(ColumnLayers::of_source(6)));
}

TEST(TrimLayers, LeavesWhatIsNeeded) {
  EXPECT_EQ(trimmed_levels({1, 1, 1, 1, 1, 1, 1, 1, 1, 1}), levels_of(eighths_and_stacks()));
}

TEST(TrimLayers, GrowsByTwoAwayFromWhatIsNeeded) {
  // Below the first eighth: two of them, then four, then the last; stacks are the source's layers.
  EXPECT_EQ(trimmed_levels({1, 0, 0, 0, 0, 0, 0, 0, 0, 0}),
            (std::vector<std::array<double, 2>>{
                {0, 0.125}, {0.125, 0.375}, {0.375, 0.875}, {0.875, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}}));
  // Above the last one: the other way round.
  EXPECT_EQ(
      trimmed_levels({0, 0, 0, 0, 0, 0, 0, 1, 1, 1}),
      (std::vector<std::array<double, 2>>{{0, 0.125}, {0.125, 0.625}, {0.625, 0.875}, {0.875, 1}, {1, 5}, {5, 6}}));
  // Six between two: three go with each.
  EXPECT_EQ(trimmed_levels({1, 0, 0, 0, 0, 0, 0, 1, 1, 1}),
            (std::vector<std::array<double, 2>>{
                {0, 0.125}, {0.125, 0.375}, {0.375, 0.5}, {0.5, 0.625}, {0.625, 0.875}, {0.875, 1}, {1, 5}, {5, 6}}));
}

TEST(TrimLayers, AddsUpWhatIsNeededForTwoReasons) {
  const auto grid = grids::box({1, 1, 6});
  const HostMesh host = build_host_mesh(grid);
  auto plan = plan_refinement(grid, host, {1, 1}, {{{1, 1}, {{0, 0}}, eighths_and_stacks()}});
  const std::vector<std::uint8_t> first{1, 1, 1, 1, 0, 0, 0, 0, 0, 0};
  const std::vector<std::uint8_t> second{0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
  trim_layers(plan, {{{0, 0}, first}, {{0, 0}, second}});
  const ColumnLayers& layers = plan.layers[static_cast<std::size_t>(plan.columns.front().layers)];
  EXPECT_EQ(layers, eighths_and_stacks());
  EXPECT_EQ(layers.place_of({{1, 0.0}, {4, 1.0}}), 8);
  EXPECT_THROW((void)layers.place_of({{1, 0.0}, {3, 1.0}}), InvalidInput);
  EXPECT_THROW(trim_layers(plan, {{{0, 0}, {1}}}), InvalidInput);
  try {
    trim_layers(plan, {{{0, 0}, first}, {{0, 0}, {1}}});
    FAIL() << "trimmed";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "a column is asked for two numbers of layers");
  }
}

// --- The mesh
// ---------------------------------------------------------------------------------------------------------

/// What every refined host must hold: fractions, pore volume, corners.
void expect_whole_cells(const CornerPointGrid& grid, const HostMesh& before, const HostMesh& host) {
  const auto sources = static_cast<std::size_t>(grid.cell_count());
  ASSERT_EQ(host.volume.size(), sources + host.refined.size());
  ASSERT_EQ(host.pore_volume.size(), host.volume.size());
  ASSERT_EQ(host.exists.size(), host.volume.size());
  std::map<HostCellId, double> sum;
  for (std::size_t p = 0; p < host.refined.piece_source.size(); ++p) {
    EXPECT_TRUE(host.is_refined(host.refined.piece_source[p]));
    sum[host.refined.piece_source[p]] += host.refined.piece_fraction[p];
  }
  for (const auto& [source, fraction] : sum) EXPECT_NEAR(fraction, 1.0, 1e-12);
  double pore_volume = 0.0;
  for (std::size_t c = 0; c < sources; ++c) {
    const HostCellId cell(c);
    EXPECT_EQ(host.exists[cell], before.exists[cell]);
    if (host.is_refined(cell) && host.exists[cell] != 0 && sum.contains(cell)) pore_volume += host.pore_volume[cell];
  }
  double refined_pore_volume = 0.0;
  for (std::size_t c = sources; c < host.pore_volume.size(); ++c) {
    refined_pore_volume += host.pore_volume[HostCellId(c)];
    EXPECT_TRUE(host.exists[HostCellId(c)] == 0 || host.volume[HostCellId(c)] > 0.0);
  }
  EXPECT_NEAR(refined_pore_volume, pore_volume, 1e-9 * (1.0 + pore_volume));
}

void trim_at_random(RefinementPlan& plan, Dice& dice) {
  std::vector<NeededLayers> needed;
  for (const RefinedColumn& column : plan.columns) {
    if (column.layers == 0) continue;
    NeededLayers of_column{column.low, {}};
    const double share = dice.chance(0.3) ? 0.0 : 0.4;
    for (std::size_t k = 0; k < plan.layers[static_cast<std::size_t>(column.layers)].cells.size(); ++k)
      of_column.is_needed.push_back(dice.chance(share) ? 1 : 0);
    needed.push_back(std::move(of_column));
  }
  trim_layers(plan, needed);
}

/// Returns the number of refined cells.
std::size_t expect_watertight(const CornerPointGrid& grid, Dice& dice) {
  HostMesh before;
  try {
    before = build_host_mesh(grid);
  } catch (const InvalidInput&) {
    return 0;  // a tiny grid may have no cell left
  }
  const auto [unit, demands] = random_demands(grid, dice);
  HostMesh host = before;
  auto plan = plan_refinement(grid, host, unit, demands);
  if (dice.chance(0.5)) trim_at_random(plan, dice);
  refine_host(grid, plan, host);
  if (plan.empty()) return 0;
  sizes_of(grid, plan);
  expect_whole_cells(grid, before, host);
  const auto checked = check_host(grid, host);
  EXPECT_TRUE(checked.faults.empty()) << checked.faults.size() << " faults: " << checked.faults.front();
  EXPECT_LT(checked.worst_openness, 1e-12);
  const auto topology = check_topology(host);
  EXPECT_TRUE(topology.faults.empty()) << topology.faults.size() << " faults: " << topology.faults.front();
  return host.refined.size();
}

TEST(HostRefinement, IsWatertightOverTheZoo) {
  for (const auto& [name, grid] : grids::zoo())
    for (std::uint32_t seed = 1; seed <= rounds(20U); ++seed) {
      SCOPED_TRACE(name + ", seed " + std::to_string(seed));
      Dice dice(seed);
      expect_watertight(grid, dice);
      if (testing::Test::HasFailure()) return;
    }
}

std::size_t expect_watertight_at_random(std::uint32_t seed) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  const grids::Dimensions dimensions{1 + dice.number(4), 1 + dice.number(4), 1 + dice.number(6)};
  const auto grid =
      dice.chance(0.5) ? grids::random_host(dimensions, seed).grid : grids::random_faults(dimensions, seed);
  return expect_watertight(grid, dice);
}

TEST(HostRefinement, IsWatertightOverRandomHosts) {
  std::size_t cells = 0;
  for (std::uint32_t seed = 1; seed <= rounds(400U) && !HasFailure(); ++seed)
    cells += expect_watertight_at_random(seed);
  EXPECT_GT(cells, rounds(15'000U));  // else the demands would not try what they are for
}

/// Other hosts with WELLKNIT_SEED; WELLKNIT_RANDOM_GRIDS asks for more of them.
TEST(HostRefinement, IsWatertightOverFreshRandomHosts) {
  const char* const asked = std::getenv("WELLKNIT_RANDOM_GRIDS");
  const int count = asked == nullptr ? rounds(100) : std::atoi(asked);
  const auto first = random_seed();
  for (int n = 0; n < count && !HasFailure(); ++n) expect_watertight_at_random(first + static_cast<std::uint32_t>(n));
}

/// Where pillars are straight down, parts of a cell fill it exactly.
TEST(HostRefinement, PartsFillVerticalColumns) {
  for (const auto& [name, grid] : grids::zoo()) {
    if (name.find("twisted") != std::string::npos || name == "left-handed" || name == "random faults") continue;
    SCOPED_TRACE(name);
    const HostMesh before = build_host_mesh(grid);
    const auto unit = LatticePoint{4, 2};
    ColumnLayers halves;
    for (std::int64_t p = 0; p < grid.dimensions[2]; ++p)
      halves.cells.insert(halves.cells.end(), {{{p, 0.0}, {p, 0.3}}, {{p, 0.3}, {p, 1.0}}});
    const auto [plan, host] = refined(grid, unit, {whole_column({0, 0}, unit, {1, 1}, halves)});
    std::map<HostCellId, double> sum;
    for (std::size_t c = 0; c < host.refined.size(); ++c)
      sum[host.refined.parent[c]] += host.volume[HostCellId(c + before.volume.size())];
    ASSERT_FALSE(sum.empty());
    for (const auto& [parent, volume] : sum)
      EXPECT_NEAR(volume, before.volume[parent], 1e-12 * before.volume[parent]) << parent.value();
  }
}

TEST(HostRefinement, PartsAllButFillLeaningColumns) {
  const auto grid = grids::twisted({4, 4, 3});
  const HostMesh before = build_host_mesh(grid);
  const auto [plan, host] = refined(grid, {8, 8}, {whole_column({1, 1}, {8, 8}, {1, 1}, ColumnLayers::of_source(3))});
  std::map<HostCellId, double> sum;
  for (std::size_t c = 0; c < host.refined.size(); ++c)
    sum[host.refined.parent[c]] += host.volume[HostCellId(c + before.volume.size())];
  // The sides of a part lie on the straight lines between its own corners, not on those between the source's.
  for (const auto& [parent, volume] : sum) EXPECT_NEAR(volume / before.volume[parent], 1.0, 2e-2);
}

// --- Transmissibilities
// -----------------------------------------------------------------------------------------------

using Pair = std::pair<HostCellId, HostCellId>;

std::map<Pair, double> transmissibilities(const HostMesh& host) {
  std::map<Pair, double> out;
  for (std::size_t f = 0; f < host.faces.size(); ++f) {
    const auto [a, b] = host.faces.cells[FaceId(f)];
    if (host.faces.transmissibility[FaceId(f)] > 0.0) out[{a, b}] += host.faces.transmissibility[FaceId(f)];
  }
  return out;
}

TEST(HostRefinement, LeavesOtherTransmissibilitiesAlone) {
  for (const auto& [name, grid] : grids::zoo()) {
    if (grid.dimensions[0] < 4) continue;
    SCOPED_TRACE(name);
    const auto before = transmissibilities(build_host_mesh(grid));
    const auto [plan, host] =
        refined(grid, {4, 4}, {whole_column({2, 1}, {4, 4}, {2, 2}, ColumnLayers::of_source(grid.dimensions[2]))});
    const auto after = transmissibilities(host);
    std::size_t compared = 0;
    for (const auto& [pair, value] : before) {
      if (host.is_refined(pair.first) || host.is_refined(pair.second)) continue;
      ASSERT_TRUE(after.contains(pair));
      EXPECT_NEAR(after.at(pair), value, 1e-12 * value);
      ++compared;
    }
    EXPECT_GT(compared, 0U);
  }
}

TEST(HostRefinement, ConductsAsTheUnrefinedBox) {
  const auto grid = grids::box({3, 1, 1});
  const auto before = transmissibilities(build_host_mesh(grid));
  const HostCellId first(0);
  const HostCellId last(2);
  const double whole = 1.0 / (1.0 / before.at({first, HostCellId(1)}) + 1.0 / before.at({HostCellId(1), last}));
  const auto [plan, host] = refined(grid, {2, 2}, {whole_column({1, 0}, {2, 2}, {1, 1}, ColumnLayers::of_source(1))});
  const auto after = transmissibilities(host);
  // Two rows of two: resistances in a row add up, rows stand side by side, and nothing flows between them.
  double sum = 0.0;
  for (const std::size_t row : {0U, 2U}) {
    const HostCellId a = plan.columns[row].first_cell;
    const HostCellId b = plan.columns[row + 1].first_cell;
    sum += 1.0 / (1.0 / after.at({first, a}) + 1.0 / after.at({a, b}) + 1.0 / after.at({last, b}));
  }
  EXPECT_NEAR(sum, whole, 1e-12 * whole);
}

TEST(HostRefinement, SplitsAndMergesLayers) {
  // 10 by 20 by 5 m; k_z 1e-14 and 4e-14, k_x 1e-13 and 3e-13.
  auto grid = grids::box({2, 1, 2});
  for (const std::size_t c : {2U, 3U}) {
    grid.permeability[0][c] = 3e-13;
    grid.permeability[2][c] = 4e-14;
  }
  const ColumnLayers layers{{{{0, 0.0}, {0, 0.2}}, {{0, 0.2}, {1, 1.0}}}};
  const auto [plan, host] = refined(grid, {1, 1}, {{{1, 1}, {{1, 0}}, layers}});
  ASSERT_EQ(host.refined.size(), 2U);
  const HostCellId thin(4);
  const HostCellId thick(5);
  EXPECT_NEAR(host.volume[thin], 200.0, 1e-9);
  EXPECT_NEAR(host.volume[thick], 1800.0, 1e-9);
  EXPECT_NEAR(host.pore_volume[thick], 360.0, 1e-9);
  EXPECT_EQ(host.source_of(thin), HostCellId(1));
  EXPECT_EQ(host.source_of(thick), HostCellId(3));  // 5 m of 9
  const auto t = transmissibilities(host);
  // Along depth, 200 m2: half of 1 m at 1e-14; half of 9 m at 9 / (4 / 1e-14 + 5 / 4e-14).
  const double k_vertical = 9.0 / (4.0 / 1e-14 + 5.0 / 4e-14);
  EXPECT_NEAR(t.at({thin, thick}), 200.0 / (0.5 / 1e-14 + 4.5 / k_vertical), 1e-24);
  // Along i: the upper source cell meets 1 m of the thin and 4 m of the thick one, whose mean is (4 1 + 5 3) / 9.
  const double k_mean = (4.0 * 1e-13 + 5.0 * 3e-13) / 9.0;
  EXPECT_NEAR(t.at({HostCellId(0), thin}), 20.0 / (5.0 / 1e-13 + 5.0 / 1e-13), 1e-24);
  EXPECT_NEAR(t.at({HostCellId(0), thick}), 80.0 / (5.0 / 1e-13 + 5.0 / k_mean), 1e-24);
  EXPECT_NEAR(t.at({HostCellId(2), thick}), 100.0 / (5.0 / 3e-13 + 5.0 / k_mean), 1e-24);
  for (std::size_t f = 0; f < host.faces.size(); ++f) EXPECT_EQ(host.faces.is_fault[FaceId(f)], 0) << f;
}

TEST(HostRefinement, KeepsFaultsWhereTheSourceHasThem) {
  const auto grid = grids::faulted({2, 1, 2}, 2.5);
  const auto [plan, host] = refined(grid, {2, 2}, {whole_column({0, 0}, {2, 2}, {1, 1}, ColumnLayers::of_source(2))});
  const HostMesh before = build_host_mesh(grid);
  std::map<Pair, int> flags;
  for (std::size_t f = 0; f < before.faces.size(); ++f)
    flags[std::pair(before.faces.cells[FaceId(f)][0], before.faces.cells[FaceId(f)][1])] =
        before.faces.is_fault[FaceId(f)];
  std::int64_t faults = 0;
  for (std::size_t f = 0; f < host.faces.size(); ++f) {
    const FaceId face(f);
    const auto [a, b] = host.faces.cells[face];
    if (!b.is_valid()) continue;
    const HostCellId one = host.source_of(a);
    const HostCellId other = host.source_of(b);
    EXPECT_EQ(host.faces.is_fault[face], one == other ? 0 : flags.at(std::minmax(one, other)));
    faults += host.faces.is_fault[face];
  }
  EXPECT_EQ(faults, 2 * 3);  // two parts along the fault; each layer meets one and a half
}

/// A wedge of 0.5 m with a twisted base, across a fault from a refined column. The edge of its base there has new
/// vertices at a half, 0 m over the base's plane, and at three quarters, where a line of the other side crosses it,
/// 0.125 m. Without balance the fan's volume is off by 0.125 / (3 * 6) of 0.25 m, 2.8 %.
TEST(HostRefinement, KeepsTheVolumesOfTwistedWedges) {
  const auto depth = [](std::array<std::int64_t, 3> cell, std::array<int, 3> corner) {
    const bool even = (cell[0] + corner[0] + cell[1] + corner[1]) % 2 == 0;
    const auto level = static_cast<std::size_t>(cell[2] + corner[2]);
    const std::array<double, 4> wedge{1000.0, 1010.0, even ? 1010.0 : 1010.5, 1030.0};
    const std::array<double, 4> beside{1000.0, 1005.0, corner[1] == 0 ? 1010.2 : 1010.1, 1030.0};
    return cell[0] == 0 ? wedge.at(level) : beside.at(level);
  };
  const auto pillar = [](std::int64_t i, std::int64_t j) {
    const Vec3 top(10.0 * static_cast<double>(i), 20.0 * static_cast<double>(j), 0.0);
    return std::array<Vec3, 2>{top, top + Vec3(0.0, 0.0, 2000.0)};
  };
  const auto grid = grids::make({{2, 1, 3}, pillar, depth});
  const auto [plan, host] = refined(grid, {2, 2}, {whole_column({1, 0}, {2, 2}, {1, 1}, ColumnLayers::of_source(3))});
  EXPECT_EQ(host.refined.size(), 12U);
  const auto checked = check_host(grid, host);
  EXPECT_TRUE(checked.faults.empty()) << checked.faults.front();
  EXPECT_LT(checked.worst_volume, 2e-3);
  EXPECT_NEAR(host.volume[HostCellId(2)], 50.0, 1e-9);  // 200 m2, two corners of 0.5 m and two of 0
}

TEST(HostRefinement, RefusesAFaultThatCrossesTooManyLayers) {
  // As HostMesh.RefusesAFaultThatCrossesTooManyLayers, with layers that only their parts make so many: 60 layers have
  // 61 x 61 points, their 40 parts each 2401 x 2401, above 1000 for each of the levels.
  constexpr std::int64_t layers = 60;
  constexpr int parts = 40;
  auto grid = grids::box({2, 1, layers});
  const double height = 5.0 * layers;
  for (std::int64_t k = 0; k < layers; ++k)
    for (int corner = 0; corner < 8; ++corner)
      grid.zcorn[grid.zcorn_index({1, 0, k}, corner & 1, (corner >> 1) & 1, corner >> 2)] +=
          (corner & 2) != 0 ? 2.0 * height : -2.0 * height;
  ColumnLayers thin;
  for (std::int64_t k = 0; k < layers; ++k)
    for (int p = 0; p < parts; ++p)
      thin.cells.push_back({{k, static_cast<double>(p) / parts}, {k, static_cast<double>(p + 1) / parts}});
  try {
    (void)refined(grid, {1, 1}, {{{1, 1}, {{0, 0}, {1, 0}}, thin}});
    FAIL() << "refined";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(),
                 "the layers on both sides of a fault cross in 5764801 points; check ZCORN there");  // 2401 x 2401
  }
}

TEST(HostRefinement, RefusesAPlanThatLeavesAHole) {
  const auto grid = grids::box({1, 1, 1});
  HostMesh host = build_host_mesh(grid);
  auto plan = plan_refinement(grid, host, {2, 2}, {whole_column({0, 0}, {2, 2}, {1, 1}, ColumnLayers::of_source(1))});
  auto disordered = plan;
  disordered.layers[0].cells[0].upper.fraction = 2.0;
  EXPECT_THROW(refine_host(grid, disordered, host), InvalidInput);
  auto with_hole = plan;
  with_hole.columns.pop_back();
  EXPECT_THROW(refine_host(grid, with_hole, host), InvalidInput);
  refine_host(grid, plan, host);
  EXPECT_THROW(refine_host(grid, plan, host), InvalidInput) << "twice";
}

}  // namespace
}  // namespace wellknit
