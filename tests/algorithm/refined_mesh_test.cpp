// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What follows a refinement: the mesh, its properties, connections and wells.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>

#include "algorithm/assembly.h"
#include "algorithm/cell_path.h"
#include "algorithm/edit_connections.h"
#include "algorithm/flow_connections.h"
#include "algorithm/host_refinement.h"
#include "algorithm/host_transmissibility.h"
#include "algorithm/peaceman.h"
#include "algorithm/property_transfer.h"
#include "algorithm/refined_path.h"
#include "model/errors.h"
#include "model/mesh_check.h"
#include "tests/support/grids.h"
#include "tests/support/near_well.h"
#include "tests/support/refinements.h"
#include "tests/support/rounds.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/steady_flow.h"
#include "writers/write_hdf5.h"

namespace wellknit {
namespace {

using refinements::Dice;
using refinements::random_demands;
using refinements::whole_column;

HostMesh refined_host(const CornerPointGrid& grid, LatticePoint unit, const std::vector<RefinementDemand>& demands) {
  HostMesh host = build_host_mesh(grid);
  auto plan = plan_refinement(grid, host, unit, demands);
  refine_host(grid, plan, host);
  return host;
}

Assembly finished(const CornerPointGrid& grid, const HostMesh& host, const std::vector<TransitionMesh>& cavities) {
  const CellLocator locator(grid);
  Assembly assembly = assemble(grid, host, cavities);
  transfer_properties(grid, host, locator, cavities, assembly);
  const HostMultipliers multipliers(grid);
  connect_cells({grid, host, locator, multipliers, {}}, assembly);
  edit_connections(grid, host, multipliers, assembly);
  return assembly;
}

/// Volumes and views apart: twisted cells and cells made by hand need not have good ones.
void expect_valid(const Mesh& mesh) {
  MeshCheckOptions options;
  options.host_volume_limit = std::numeric_limits<double>::infinity();
  for (const Violation& v : check_mesh(mesh, options)) {
    if (v.check.ends_with("volume not positive") || v.check == not_seen_from_centre) continue;
    ADD_FAILURE() << v.check << ", " << v.entity << ": " << v.detail;
    return;
  }
}

double pore_volume(const CornerPointGrid& grid, const HostMesh& host) {
  double sum = 0.0;
  for (std::int64_t c = 0; c < grid.cell_count(); ++c)
    if (host.exists[HostCellId(c)] != 0) sum += host.pore_volume[HostCellId(c)];
  return sum;
}

TEST(RefinedMesh, IsValidOverTheZoo) {
  for (const auto& [name, grid] : grids::zoo())
    for (std::uint32_t seed = 1; seed <= rounds(10U) && !HasFailure(); ++seed) {
      SCOPED_TRACE(name + ", seed " + std::to_string(seed));
      Dice dice(seed);
      const auto [unit, demands] = random_demands(grid, dice);
      const HostMesh host = refined_host(grid, unit, demands);
      const Mesh mesh = finished(grid, host, {}).mesh;
      expect_valid(mesh);
      double sum = 0.0;
      for (const double v : mesh.cells.pore_volume) sum += v;
      EXPECT_NEAR(sum, pore_volume(grid, host), 1e-9 * sum);
    }
}

// --- A cavity of one cell
// ---------------------------------------------------------------------------------------------

/// One transition cell in the place of a host cell: its six sides are boundary faces of the cavity.
TransitionMesh cube_in_place_of(const HostMesh& host, HostCellId removed) {
  TransitionMesh out;
  out.cavity.removed_cells = {removed};
  const auto corners = host.corners_of(removed);
  for (const VertexId v : corners) {
    CavityVertex vertex;
    vertex.is_host = true;
    vertex.host = v;
    vertex.real = host.vertices[v];
    out.cavity.vertices.push_back(vertex);
    out.vertices.push_back(vertex.real);
  }
  // Outwards where i, j, k are right-handed.
  static constexpr std::array<std::array<std::int32_t, 4>, 6> sides{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  std::array<Vec3, 8> points;
  for (std::size_t n = 0; n < 8; ++n) points[n] = host.vertices[corners[n]];
  const bool mirrored = bilinear_hexahedron_volume(points) < 0.0;
  for (std::size_t side = 0; side < 6; ++side) {
    DiagramFace face;
    face.loop.assign(sides[side].begin(), sides[side].end());
    if (mirrored) std::reverse(face.loop.begin(), face.loop.end());
    face.cell = 0;
    face.other_kind = DiagramFace::Other::outer;
    BoundaryFace boundary;
    boundary.loop.assign(face.loop.rbegin(), face.loop.rend());
    boundary.removed_cell = removed;
    out.cavity.faces.push_back(boundary);
    out.faces.push_back(face);
    out.boundary_face.push_back(static_cast<std::int32_t>(side));
  }
  out.centers = {host_cell_center(host, removed)};
  return out;
}

bool has_eight_corners(const HostMesh& host, HostCellId cell) {
  auto corners = host.corners_of(cell);
  std::sort(corners.begin(), corners.end());
  return std::adjacent_find(corners.begin(), corners.end()) == corners.end();
}

/// Returns how many faces the cell made in a random cell's place has; 0: none was found.
std::size_t expect_closed_cavity(const CornerPointGrid& grid, bool with_inactive, std::uint32_t seed) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  HostMesh host;
  try {
    host = build_host_mesh(grid);
  } catch (const InvalidInput&) {
    return 0;
  }
  const auto [unit, demands] = random_demands(grid, dice);
  auto plan = plan_refinement(grid, host, unit, demands);
  refine_host(grid, plan, host);
  for (int trial = 0; trial < 20; ++trial) {
    const HostCellId cell(dice.number(static_cast<std::int64_t>(host.volume.size())));
    const bool is_replaced = cell.index() < host.source_count() && host.is_refined(cell);
    if (is_replaced || (host.exists[cell] == 0 && !with_inactive) || !(host.volume[cell] > 0.0) ||
        !has_eight_corners(host, cell))
      continue;
    const std::vector<TransitionMesh> cavities{cube_in_place_of(host, cell)};
    const Mesh mesh = finished(grid, host, cavities).mesh;
    expect_valid(mesh);
    std::size_t faces = 0;
    for (const auto& cells : mesh.faces.cells)
      for (const CellId c : cells) faces += c.is_valid() && mesh.cells.kind[c] == CellKind::transition ? 1 : 0;
    return faces;
  }
  return 0;
}

TEST(RefinedMesh, ClosesACavityOfOneCellBesideAnything) {
  std::size_t with_divided_walls = 0;
  for (std::uint32_t seed = 1; seed <= rounds(1500U) && !HasFailure(); ++seed) {
    const grids::Dimensions dimensions{1 + seed % 4, 1 + seed / 4 % 3, 1 + seed / 12 % 5};
    const auto random = grids::random_host(dimensions, seed);
    const auto grid = seed % 2 == 0 ? grids::random_faults(dimensions, seed) : random.grid;
    // Between pillars that are not parallel a crossing lies off its edge's straight line, by which alone those on the
    // edges of an inactive cell are known.
    const bool has_straight_edges = seed % 2 != 0 && random.has_parallel_pillars;
    with_divided_walls += expect_closed_cavity(grid, has_straight_edges, seed) > 6 ? 1 : 0;
  }
  EXPECT_GT(with_divided_walls, rounds(250U));
}

TEST(RefinedMesh, MeetsHalvesOnEachSideOfACavity) {
  // The middle one of three columns goes whole; those beside it are halved along j: two faces each.
  const auto grid = grids::box({3, 1, 1});
  const auto layers = ColumnLayers::of_source(1);
  const HostMesh host = refined_host(
      grid, {1, 2}, {whole_column({0, 0}, {1, 2}, {1, 1}, layers), whole_column({2, 0}, {1, 2}, {1, 1}, layers)});
  const std::vector<TransitionMesh> cavities{cube_in_place_of(host, HostCellId(1))};
  const Assembly assembly = finished(grid, host, cavities);
  expect_valid(assembly.mesh);
  EXPECT_EQ(assembly.mesh.cells.size(), 5U);
  EXPECT_EQ(assembly.mesh.connections.size(), 6U);  // 4 with the made cell, 2 between halves
  // The made cell's permeability is the source's 1e-13; each half's face is 10 m by 5 m, distances are 5 m at an angle
  // from the made cell's centre to the plane of the face: A / (n.d) = 50 / 5, as the half's own.
  const double inner = 1e-13 * 50.0 / 5.0;
  const double outer = 1e-13 * 50.0 / 5.0;
  std::size_t walls = 0;
  for (std::size_t n = 0; n < 6; ++n) {
    const ConnectionId c(n);
    const CellId made = assembly.mesh.connections.cells[c][1];
    if (assembly.mesh.cells.kind[made] != CellKind::transition) continue;
    EXPECT_NEAR(assembly.mesh.connections.transmissibility[c], 1.0 / (1.0 / inner + 1.0 / outer), 1e-20);
    ++walls;
  }
  EXPECT_EQ(walls, 4U);
}

TEST(RefinedMesh, GivesARemovedPartsVolumeToTheMadeCell) {
  auto grid = grids::box({2, 1, 1});
  grid.porosity = {0.1, 0.3};
  const HostMesh host = refined_host(grid, {2, 2}, {whole_column({0, 0}, {2, 2}, {1, 1}, ColumnLayers::of_source(1))});
  const std::vector<TransitionMesh> cavities{cube_in_place_of(host, HostCellId(2))};
  const Mesh mesh = finished(grid, host, cavities).mesh;
  const CellId made(mesh.cells.size() - 1);
  EXPECT_NEAR(mesh.cells.pore_volume[made], 0.1 * 250.0, 1e-9);  // a quarter of 10 by 20 by 5 m
  ASSERT_EQ(mesh.transfer.start[1], 4);
  for (std::size_t n = 0; n < 4; ++n) EXPECT_NEAR(mesh.transfer.fraction[n], 0.25, 1e-12);
}

// --- Flow
// -------------------------------------------------------------------------------------------------------------

/// Sum of the flow out of the cells for which `from` holds.
double flow_out(const Mesh& mesh, const std::vector<double>& p, const std::function<bool(CellId)>& from) {
  double sum = 0.0;
  const Connections& c = mesh.connections;
  for (std::size_t n = 0; n < c.size(); ++n) {
    const auto [a, b] = c.cells[ConnectionId(n)];
    if (from(a) == from(b)) continue;
    const double flow = c.transmissibility[ConnectionId(n)] * (p[a.index()] - p[b.index()]);
    sum += from(a) ? flow : -flow;
  }
  return sum;
}

TEST(RefinedMesh, CarriesLinearFlowThroughAGradedPart) {
  const auto grid = grids::box({7, 7, 2}, {20.0, 20.0, 5.0});
  const ColumnLayers split{{{{0, 0.0}, {0, 0.5}}, {{0, 0.5}, {1, 1.0}}}};
  const HostMesh host = refined_host(grid, {4, 4}, {{{1, 1}, {{13, 13}, {14, 13}, {13, 14}}, split}});
  const Mesh mesh = finished(grid, host, {}).mesh;
  expect_valid(mesh);
  const auto at_inlet = [&](CellId c) { return mesh.cells.center[c].x() < 20.0; };
  const auto at_outlet = [&](CellId c) { return mesh.cells.center[c].x() > 120.0; };
  const auto p = steady_flow::pressures(mesh, 0.0, [&](CellId c) -> std::optional<double> {
    if (at_inlet(c)) return 1.0;
    if (at_outlet(c)) return 0.0;
    return std::nullopt;
  });
  const double in = flow_out(mesh, p, at_inlet);
  const double out = -flow_out(mesh, p, at_outlet);
  // k A / L between the centres of the first and the last column.
  const double exact = 1e-13 * 140.0 * 10.0 / 120.0;
  EXPECT_NEAR(in / exact, 1.0, 3e-2);  // two-point flow across hanging sides is not exact
  EXPECT_NEAR(in / out, 1.0, 1e-9);
}

TEST(RefinedMesh, IsValidForAnIndependentChecker) {
  const std::string tool = std::string(WELLKNIT_SHARED) + "/tools/check_mesh.py";
  if (!std::filesystem::exists(tool)) GTEST_SKIP() << "no " << tool;
  const ScratchFolder folder;
  const auto grid = grids::twisted_fault({6, 6, 4}, 3.0);
  const ColumnLayers layers{{{{0, 0.0}, {0, 0.5}}, {{0, 0.5}, {0, 1.0}}, {{1, 0.0}, {2, 1.0}}, {{3, 0.0}, {3, 1.0}}}};
  const HostMesh host = refined_host(grid, {4, 4}, {whole_column({2, 2}, {4, 4}, {1, 2}, layers)});
  const std::string path = folder.file("refined.h5");
  write_hdf5(finished(grid, host, {}).mesh, {}, path, {});
  const std::string command = std::string(WELLKNIT_PYTHON) + " " + tool + " " + path;
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
}

TEST(RefinedMesh, MultipliesBetweenSourceCellsAlone) {
  auto grid = grids::box({3, 1, 1});
  grid.edits.face_multiplier[static_cast<std::size_t>(FaceDirection::i_plus)] = {0.5, 0.25, 1.0};
  const HostMesh host = refined_host(grid, {2, 1}, {whole_column({1, 0}, {2, 1}, {1, 1}, ColumnLayers::of_source(1))});
  const Mesh mesh = finished(grid, host, {}).mesh;
  std::map<std::pair<std::int64_t, std::int64_t>, double> multiplier;
  for (std::size_t n = 0; n < mesh.connections.size(); ++n) {
    const auto [a, b] = mesh.connections.cells[ConnectionId(n)];
    multiplier[{a.value(), b.value()}] = mesh.connections.multiplier[ConnectionId(n)];
  }
  // Cells: the first and the last source cell, then the halves.
  EXPECT_EQ(multiplier, (decltype(multiplier){{{0, 2}, 0.5}, {{2, 3}, 1.0}, {{1, 3}, 0.25}}));
}

// --- Wells
// ------------------------------------------------------------------------------------------------------------

TEST(RefinedMesh, GivesAWellTheIndexOfTheRefinedCell) {
  const auto grid = grids::box({3, 3, 1}, {40.0, 40.0, 5.0});
  const HostMesh host = refined_host(grid, {4, 4}, {whole_column({1, 1}, {4, 4}, {1, 1}, ColumnLayers::of_source(1))});
  Well well = near_well::straight("W", {45.0, 45.0, 990.0}, {45.0, 45.0, 1010.0});
  well.radial.bore_radius = 0.1;
  const CellLocator locator(grid);
  const auto path = split_at_refined(grid, host, cells_along(grid, locator, well.trajectory));
  const auto found = peaceman_indices(grid, host, well, path.parts);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_GE(found[0].cell.value(), grid.cell_count());
  // 10 by 10 m, k 1e-13 and 2e-13 m2.
  const double radius = peaceman_radius(1e-13, 2e-13, 10.0, 10.0);
  const double expected = 2.0 * std::numbers::pi * std::sqrt(2e-26) * 5.0 / std::log(radius / 0.1);
  EXPECT_NEAR(found[0].well_index / expected, 1.0, 1e-6);
}

TEST(RefinedMesh, SharesADecksFactorOutAmongRefinedCells) {
  const auto grid = grids::box({3, 3, 1}, {40.0, 40.0, 5.0});
  const HostMesh host = refined_host(grid, {4, 4}, {whole_column({1, 1}, {4, 4}, {1, 1}, ColumnLayers::of_source(1))});
  Well well = near_well::straight("W", {40.0, 45.0, 1002.5}, {65.0, 45.0, 1002.5});
  DeckCompletion completion;
  completion.cell = HostCellId(4);
  completion.connection_factor = 3e-12;
  well.completions = {completion};
  const CellLocator locator(grid);
  const auto found = completion_indices(grid, host, well, cells_along(grid, locator, well.trajectory));
  // 10, 10 and 5 m of the path lie in three refined cells.
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found[0].well_index, 3e-12 * 10.0 / 25.0, 1e-18);
  EXPECT_NEAR(found[2].well_index, 3e-12 * 5.0 / 25.0, 1e-18);
  // A path elsewhere: all of it to the cells at the middle.
  const auto beside = completion_indices(grid, host, well, {});
  double sum = 0.0;
  for (const auto& c : beside) sum += c.well_index;
  EXPECT_NEAR(sum, 3e-12, 1e-20);
  EXPECT_EQ(beside.size(), 1U);
}

TEST(RefinedMesh, SplitsAPathAtTheSidesOfRefinedCells) {
  const auto grid = grids::box({1, 1, 2}, {40.0, 40.0, 5.0});
  const ColumnLayers layers{{{{0, 0.0}, {0, 0.2}}, {{0, 0.2}, {1, 1.0}}}};
  const HostMesh host = refined_host(grid, {2, 2}, {whole_column({0, 0}, {2, 2}, {1, 1}, layers)});
  const CellLocator locator(grid);
  const auto well = near_well::straight("W", {5.0, 5.0, 1000.0}, {5.0, 5.0, 1010.0});
  const auto path = split_at_refined(grid, host, cells_along(grid, locator, well.trajectory));
  std::map<std::int64_t, double> length;
  for (const CellPart& part : path.parts)
    length[part.cell.value()] += part.measured_depth.to - part.measured_depth.from;
  ASSERT_EQ(length.size(), 2U);  // the first column's two cells: 1 m and 9 m
  EXPECT_NEAR(length.at(2), 1.0, 1e-5);
  EXPECT_NEAR(length.at(3), 9.0, 1e-5);
}

TEST(RefinedMesh, ConnectsAcrossGapsPartByPart) {
  const auto grid = grids::with_gap({2, 1, 2});
  const HostMesh host = refined_host(grid, {1, 2}, {whole_column({0, 0}, {1, 2}, {1, 1}, ColumnLayers::of_source(2))});
  const Mesh mesh = finished(grid, host, {}).mesh;
  double across = 0.0;
  double across_whole = 0.0;
  std::size_t count = 0;
  for (std::size_t n = 0; n < mesh.connections.size(); ++n) {
    const ConnectionId c(n);
    if (mesh.connections.kind[c] != ConnectionKind::pinch_out) continue;
    const bool is_part = mesh.cells.kind[mesh.connections.cells[c][0]] == CellKind::refined;
    (is_part ? across : across_whole) += mesh.connections.transmissibility[c];
    count += is_part ? 1 : 0;
  }
  EXPECT_EQ(count, 2U);
  EXPECT_NEAR(across, across_whole, 1e-12 * across_whole);
}

}  // namespace
}  // namespace wellknit
