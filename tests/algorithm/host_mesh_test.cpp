// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/host_mesh.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "algorithm/build_mesh.h"
#include "algorithm/host_validity.h"
#include "algorithm/id_limit.h"
#include "model/errors.h"
#include "model/mesh_check.h"
#include "readers/read_case.h"
#include "tests/support/grids.h"
#include "tests/support/host_checks.h"
#include "tests/support/random_seed.h"
#include "tests/support/rounds.h"

namespace wellknit {
namespace {

std::int64_t faces_where(const HostMesh& mesh, const auto& condition) {
  std::int64_t count = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) count += condition(FaceId(f)) ? 1 : 0;
  return count;
}

bool is_inner(const HostMesh& mesh, FaceId face) {
  const HostCellId second = mesh.faces.cells[face][1];
  return second.is_valid() && mesh.exists[second] == 1;
}

TEST(HostMesh, IsWatertightOverTheZoo) {
  for (const auto& [name, grid] : grids::zoo()) {
    SCOPED_TRACE(name);
    const auto checked = check_host(grid, build_host_mesh(grid));
    EXPECT_TRUE(checked.faults.empty()) << checked.faults.front();
    EXPECT_LT(checked.worst_openness, 1e-12);
    EXPECT_GT(checked.cells, 0);
  }
}

/// A grid of random faults; the number of its fault faces.
std::int64_t expect_watertight(std::uint32_t seed) {
  const std::int64_t nz = 1 + seed % 7;
  const auto grid = grids::random_faults({1 + seed % 3, 1 + seed / 3 % 4, nz}, seed);
  HostMesh mesh;
  try {
    mesh = build_host_mesh(grid);
  } catch (const InvalidInput&) {
    return 0;  // a tiny grid may have no active cell, or none with thickness
  }
  const auto checked = check_host(grid, mesh);
  EXPECT_TRUE(checked.faults.empty()) << "seed " << seed << ": " << checked.faults.front();
  EXPECT_LT(checked.worst_openness, 1e-12) << "seed " << seed;
  return faces_where(mesh, [&](FaceId f) { return mesh.faces.is_fault[f] == 1; });
}

TEST(HostMesh, IsWatertightOverRandomFaults) {
  std::int64_t fault_faces = 0;
  for (std::uint32_t seed = 1; seed <= rounds(300U); ++seed) fault_faces += expect_watertight(seed);
  EXPECT_GT(fault_faces, rounds(300) * 30);  // else the grids would not try what they are for
}

/// Other grids with WELLKNIT_SEED; WELLKNIT_RANDOM_GRIDS asks for more of them.
TEST(HostMesh, IsWatertightOverFreshRandomFaults) {
  const char* const asked = std::getenv("WELLKNIT_RANDOM_GRIDS");
  const int count = asked == nullptr ? rounds(200) : std::atoi(asked);
  const auto first = random_seed();
  for (int n = 0; n < count && !HasFailure(); ++n) {
    const std::uint32_t seed = first + static_cast<std::uint32_t>(n);
    expect_watertight(seed);
  }
}

/// A grid of all that can be odd: what must hold for it all the same. Grids that no cell is left of are refused.
struct RandomTally {
  std::int64_t grids = 0;
  std::int64_t refused = 0;
  std::int64_t cells = 0;
  std::int64_t spheres = 0;
  std::int64_t others = 0;  ///< cells that touch themselves
  std::int64_t odd_grids = 0;
  std::array<std::int64_t, grid_oddity_count> oddities{};
  // Where pillars are parallel:
  double worst_uncut_volume = 0.0;
  std::int64_t uncut_cells = 0;
  std::int64_t cut_cells = 0;
  std::int64_t far_off_cells = 0;
};

/// Cells with thickness whose volume is not positive, or with a Jacobian of 0 or less at a corner: counted at every
/// corner of every active cell, from the mesh's vertices.
std::int64_t misshapen_cells(const CornerPointGrid& grid, const HostMesh& mesh, double limit) {
  std::int64_t count = 0;
  const double handedness = mesh.left_handed ? -1.0 : 1.0;
  for (std::size_t c = 0; c < grid.active.size(); ++c) {
    std::array<Vec3, 8> points;
    const auto corners = mesh.corners_of(HostCellId(c));
    for (std::size_t n = 0; n < 8; ++n) points[n] = mesh.vertices[corners[n]];
    bool is_flat = true;
    for (std::size_t n = 0; n < 4; ++n) is_flat = is_flat && points[n] == points[n + 4];
    if (grid.active[c] == 0 || is_flat) continue;
    bool is_odd = handedness * bilinear_hexahedron_volume(points) <= (limit > 0.0 ? sliver_volume : -sliver_volume);
    for (std::size_t n = 0; n < 8; ++n) {
      const Vec3 u = points[n | 1U] - points[n & ~std::size_t{1}];
      const Vec3 v = points[n | 2U] - points[n & ~std::size_t{2}];
      const Vec3 w = points[n | 4U] - points[n & ~std::size_t{4}];
      const double lengths = u.norm() * v.norm() * w.norm();
      if (std::min({u.norm(), v.norm(), w.norm()}) > pillar_merge_tolerance)
        is_odd = is_odd || handedness * u.dot(v.cross(w)) < limit * lengths;
    }
    count += is_odd ? 1 : 0;
  }
  return count;
}

/// The report finds the same cells without looking at most of them. Figures within rounding of the limit may differ.
void expect_same_shapes(const CornerPointGrid& grid, const HostMesh& mesh, const GridValidity& validity,
                        std::uint32_t seed) {
  const std::int64_t found = validity[GridOddity::negative_volume].count +
                             validity[GridOddity::self_overlapping].count + validity[GridOddity::twisted].count;
  EXPECT_GE(found, misshapen_cells(grid, mesh, -1e-5)) << "seed " << seed;
  EXPECT_LE(found, misshapen_cells(grid, mesh, 1e-5)) << "seed " << seed;
}

/// The finished mesh of the grid alone: all that is checked of a mesh but what crossing pillars and cut tops may do to
/// the volumes of faces.
void expect_valid_mesh(const CornerPointGrid& grid, std::uint32_t seed) {
  MeshCheckOptions options;
  options.host_volume_limit = std::numeric_limits<double>::infinity();
  for (const Violation& v : check_mesh(build_mesh({grid, {}, {}, {}}, {}, {}).mesh, options)) {
    if (v.check == "volume not positive") continue;
    ADD_FAILURE() << "seed " << seed << ": " << v.check << ", " << v.entity << ": " << v.detail;
    return;
  }
}

void expect_sound(std::uint32_t seed, RandomTally& tally) {
  const auto random = grids::random_host({1 + seed % 4, 1 + seed / 4 % 3, 1 + seed / 12 % 7}, seed);
  const CornerPointGrid& grid = random.grid;
  ++tally.grids;
  HostMesh mesh;
  try {
    mesh = build_host_mesh(grid);
  } catch (const InvalidInput&) {
    ++tally.refused;
    return;
  }
  const HostCheck checked = check_host(grid, mesh);
  EXPECT_TRUE(checked.faults.empty()) << "seed " << seed << ": " << checked.faults.front();
  EXPECT_LT(checked.worst_openness, 1e-11) << "seed " << seed;
  const TopologyCheck topology = check_topology(mesh);
  EXPECT_TRUE(topology.faults.empty()) << "seed " << seed << ": " << topology.faults.front();
  if (checked.cells > 0) expect_valid_mesh(grid, seed);
  const GridValidity validity = check_host_validity(grid, mesh);
  expect_same_shapes(grid, mesh, validity, seed);
  tally.cells += checked.cells;
  tally.spheres += topology.spheres;
  tally.others += topology.others;
  tally.odd_grids += validity.empty() ? 0 : 1;
  for (std::size_t n = 0; n < grid_oddity_count; ++n) tally.oddities[n] += validity.kinds[n].count;
  if (!random.has_parallel_pillars) return;
  EXPECT_LT(checked.worst_uncut_volume, 1e-9) << "seed " << seed;
  tally.worst_uncut_volume = std::max(tally.worst_uncut_volume, checked.worst_uncut_volume);
  tally.uncut_cells += checked.uncut_cells;
  tally.cut_cells += checked.cut_cells;
  tally.far_off_cells += checked.far_off_cells;
}

/// Prints what was met, and checks what holds for many grids.
void expect_usual(const RandomTally& tally) {
  std::cout << tally.grids << " grids, " << tally.refused << " without a cell; " << tally.cells << " cells, "
            << tally.others << " of them touch themselves; odd grids " << tally.odd_grids << ":";
  for (std::size_t n = 0; n < grid_oddity_count; ++n)
    std::cout << ' ' << name_of(static_cast<GridOddity>(n)) << ' ' << tally.oddities[n];
  std::cout << "; between parallel pillars " << tally.uncut_cells << " cells with whole tops, volumes within "
            << tally.worst_uncut_volume << ", and " << tally.cut_cells << " with cut ones, " << tally.far_off_cells
            << " of all further off than 2 %\n";
  EXPECT_EQ(tally.others, 0) << "every cell's surface is a sphere";
  if (tally.grids >= 100) {
    EXPECT_LT(tally.far_off_cells, (tally.uncut_cells + tally.cut_cells) / 20);
  }
}

TEST(HostMesh, HoldsItsPropertiesOverRandomGrids) {
  RandomTally tally;
  for (std::uint32_t seed = 1; seed <= rounds(300U); ++seed) expect_sound(seed, tally);
  expect_usual(tally);
  if constexpr (has_few_rounds) return;  // too few to meet every oddity
  EXPECT_LT(tally.refused, 60);          // else the grids would not try what they are for
  for (std::size_t n = 0; n < grid_oddity_count; ++n)
    EXPECT_GT(tally.oddities[n], 10) << name_of(static_cast<GridOddity>(n));
}

TEST(HostMesh, HoldsItsPropertiesOverFreshRandomGrids) {
  const char* const asked = std::getenv("WELLKNIT_RANDOM_GRIDS");
  const int count = asked == nullptr ? rounds(200) : std::atoi(asked);
  const auto first = random_seed();
  RandomTally tally;
  for (int n = 0; n < count && !HasFailure(); ++n) expect_sound(first + static_cast<std::uint32_t>(n), tally);
  expect_usual(tally);
}

TEST(HostMesh, CountsFacesAndVerticesOfABox) {
  const auto mesh = build_host_mesh(grids::box({5, 4, 3}));
  EXPECT_EQ(mesh.vertices.size(), 6U * 5U * 4U);                             // (nx+1)(ny+1)(nz+1)
  EXPECT_EQ(mesh.faces.size(), 6U * 4U * 3U + 5U * 5U * 3U + 5U * 4U * 4U);  // along i, j, k
  EXPECT_EQ(faces_where(mesh, [&](FaceId f) { return is_inner(mesh, f); }),
            4 * 4 * 3 + 5 * 3 * 3 + 5 * 4 * 2);  // one less in each direction
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) EXPECT_EQ(mesh.faces.loop(FaceId(f)).size(), 4U);
  EXPECT_FALSE(mesh.left_handed);
  EXPECT_TRUE(mesh.notes.empty());
}

TEST(HostMesh, PutsTheSecondCellOnTheSideOfItsAxis) {
  const auto grid = grids::box({3, 3, 3});
  const auto mesh = build_host_mesh(grid);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const FaceId face(f);
    if (!is_inner(mesh, face)) continue;
    const auto axis = static_cast<int>(mesh.faces.axis[face]);
    const Vec3 normal = polygon_geometry(loop_points(mesh, face)).area_vector.normalized();
    // x, y and depth grow with i, j, k in this box, and the smaller id comes first.
    EXPECT_LT((normal - Vec3::Unit(axis)).norm(), 1e-12);
  }
}

TEST(HostMesh, FanVolumesEqualBilinearVolumesWithoutFaults) {
  for (const char* name : {"box", "wedge", "twisted", "half pinched and connected", "gap"}) {
    for (const auto& [zoo_name, grid] : grids::zoo()) {
      if (zoo_name != name) continue;
      EXPECT_LT(check_host(grid, build_host_mesh(grid)).worst_volume, 1e-12) << name;
    }
  }
}

TEST(HostMesh, CutsAFaultOfHalfALayerIntoHalves) {
  // Two columns of two layers of 5 m, throw 2.5 m; face width 20 m. From above: A1 | nothing 2.5 m, A1 | B1 2.5 m,
  // A2 | B1 2.5 m, A2 | B2 2.5 m, nothing | B2 2.5 m.
  const auto grid = grids::faulted({2, 1, 2}, 2.5);
  const auto mesh = build_host_mesh(grid);
  std::map<std::pair<std::int64_t, std::int64_t>, double> area;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const FaceId face(f);
    if (mesh.faces.is_fault[face] == 0) continue;
    const auto [a, b] = mesh.faces.cells[face];
    area[{a.value(), b.value()}] += polygon_geometry(loop_points(mesh, face)).area;
  }
  const std::map<std::pair<std::int64_t, std::int64_t>, double> expected{
      {{0, -1}, 50.0}, {{0, 1}, 50.0}, {{1, 2}, 50.0}, {{2, 3}, 50.0}, {{3, -1}, 50.0}};  // 2.5 m * 20 m
  ASSERT_EQ(area.size(), expected.size());
  for (const auto& [cells, value] : expected)
    EXPECT_NEAR(area[cells], value, 1e-9) << cells.first << ' ' << cells.second;
}

TEST(HostMesh, CutsTheTrianglesOfAScissorFault) {
  // One layer of 5 m, the right column's throw from -2 m to +2 m over 20 m: tops cross in the middle, so do the bases.
  // A | B: the area between max of tops and min of bases: 20 * 5 - 2 * (10 * 2 / 2) = 80. Free: 10 m2 each of A above,
  // A below, B above, B below. Two crossings.
  const auto grid = grids::scissor_fault({2, 1, 1}, 2.0);
  const auto mesh = build_host_mesh(grid);
  std::vector<double> joint;
  std::vector<double> loose;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const FaceId face(f);
    if (mesh.faces.is_fault[face] == 0) continue;
    (is_inner(mesh, face) ? joint : loose).push_back(polygon_geometry(loop_points(mesh, face)).area);
  }
  ASSERT_EQ(joint.size(), 1U);
  EXPECT_NEAR(joint[0], 80.0, 1e-9);
  ASSERT_EQ(loose.size(), 4U);
  for (const double a : loose) EXPECT_NEAR(a, 10.0, 1e-9);
  EXPECT_EQ(mesh.vertices.size(),
            8U + 8U + 2U);  // four pillars outside with two nodes, two inside with four, two crossings
  const VertexId crossing(16);
  EXPECT_LT((mesh.vertices[crossing] - Vec3(10.0, 10.0, 1000.0)).norm(), 1e-12);
  // The tops of both cells carry the crossing: five vertices.
  EXPECT_EQ(
      faces_where(mesh, [&](FaceId f) { return mesh.faces.axis[f] == Axis::k && mesh.faces.loop(f).size() == 5; }), 4);
}

TEST(HostMesh, PartsOfASideAddUpToItsArea) {
  for (const auto& [name, grid] : grids::zoo()) {
    if (name.find("twisted") != std::string::npos || name == "left-handed" || name == "random faults")
      continue;  // not planar
    const auto mesh = build_host_mesh(grid);
    EXPECT_LT(worst_side_area(grid, mesh), 1e-12) << name;
  }
}

TEST(HostMesh, CellsOnASharedSideOfAFaultKeepTheirOwnSidesWhole) {
  const auto mesh = build_host_mesh(grids::faulted({2, 1, 2}, 40.0));  // no contact: every side is one whole face
  EXPECT_EQ(faces_where(mesh, [&](FaceId f) { return is_inner(mesh, f) && mesh.faces.axis[f] == Axis::i; }), 0);
  EXPECT_EQ(faces_where(mesh, [&](FaceId f) { return mesh.faces.is_fault[f] == 1; }), 0);
  EXPECT_EQ(faces_where(mesh, [&](FaceId f) { return mesh.faces.axis[f] == Axis::i; }), 2 * 4);
}

TEST(HostMesh, ConnectsAcrossAPinchOnlyWhenAsked) {
  const auto closed = build_host_mesh(grids::pinched({2, 2, 3}, true, false));
  const auto open = build_host_mesh(grids::pinched({2, 2, 3}, true, true));
  const auto pinches = [](const HostMesh& mesh) {
    return faces_where(mesh, [&](FaceId f) { return mesh.faces.is_pinch[f] == 1; });
  };
  EXPECT_EQ(pinches(closed), 0);
  EXPECT_EQ(pinches(open), 4);  // one in each column
  EXPECT_EQ(closed.faces.size(), open.faces.size() + 4);
  for (std::size_t f = 0; f < open.faces.size(); ++f) {
    if (open.faces.is_pinch[FaceId(f)] == 0) continue;
    const auto [a, b] = open.faces.cells[FaceId(f)];
    EXPECT_EQ(b.value() - a.value(), 2 * 4);  // layers 0 and 2
  }
  EXPECT_EQ(std::count(open.exists.begin(), open.exists.end(), 1), 8);
}

TEST(HostMesh, LeavesGapsOpen) {
  const auto mesh = build_host_mesh(grids::with_gap({2, 1, 2}));
  EXPECT_EQ(faces_where(mesh, [&](FaceId f) { return is_inner(mesh, f) && mesh.faces.axis[f] == Axis::k; }), 0);
  EXPECT_EQ(faces_where(mesh, [&](FaceId f) { return mesh.faces.axis[f] == Axis::k; }),
            8);  // top and base of four cells
}

TEST(HostMesh, NamesInactiveNeighbours) {
  auto grid = grids::box({3, 1, 1});
  grid.active = {1, 0, 1};
  const auto mesh = build_host_mesh(grid);
  EXPECT_EQ(mesh.faces.size(), 12U);  // two cells of six faces that share none
  EXPECT_EQ(faces_where(mesh, [&](FaceId f) { return mesh.faces.cells[f][1] == HostCellId(1); }), 2);
}

TEST(HostMesh, DropsFacesOfAWedgeThatHaveNoExtent) {
  const auto mesh = build_host_mesh(grids::wedge({1, 1, 1}));
  // Triangles at both sides, a quad at i = 1, top and base; nothing at i = 0.
  EXPECT_EQ(mesh.faces.size(), 5U);
  EXPECT_EQ(faces_where(mesh, [&](FaceId f) { return mesh.faces.loop(f).size() == 3; }), 2);
  EXPECT_NEAR(mesh.volume[HostCellId(0)], 10.0 * 20.0 * 5.0 / 2.0, 1e-9);
}

TEST(HostMesh, KnowsLeftHandedGridsAndKeepsVolumesPositive) {
  const auto grid = grids::left_handed({3, 3, 3});
  const auto mesh = build_host_mesh(grid);
  EXPECT_TRUE(mesh.left_handed);
  EXPECT_LT(bilinear_hexahedron_volume(grid.corners(HostCellId(0))), 0.0);
  EXPECT_GT(mesh.volume[HostCellId(0)], 0.0);
}

TEST(HostMesh, TakesLayersNumberedUpwards) {
  // The scissor fault with layers in reverse: the same faces, cells renamed.
  const auto down = grids::scissor_fault({4, 4, 3}, 7.0);
  auto up = down;
  for (std::int64_t c = 0; c < up.cell_count(); ++c) {
    const auto [i, j, k] = up.ijk(HostCellId(c));
    for (int corner = 0; corner < 8; ++corner)
      up.zcorn[up.zcorn_index({i, j, 2 - k}, corner & 1, (corner >> 1) & 1, 1 - (corner >> 2))] =
          down.zcorn[down.zcorn_index({i, j, k}, corner & 1, (corner >> 1) & 1, corner >> 2)];
  }
  const auto mesh = build_host_mesh(up);
  EXPECT_TRUE(mesh.left_handed);
  const auto checked = check_host(up, mesh);
  EXPECT_TRUE(checked.faults.empty()) << checked.faults.front();
  EXPECT_LT(checked.worst_volume, 1e-12);
  EXPECT_EQ(mesh.faces.size(), build_host_mesh(down).faces.size());
}

TEST(HostMesh, MergesCornersWithinTheTolerance) {
  auto grid = grids::box({2, 1, 1});
  grid.zcorn[grid.zcorn_index({1, 0, 0}, 0, 0, 0)] += 0.5 * pillar_merge_tolerance;
  EXPECT_EQ(build_host_mesh(grid).vertices.size(), 12U);
  grid.zcorn[grid.zcorn_index({1, 0, 0}, 0, 0, 0)] += 2.0 * pillar_merge_tolerance;
  EXPECT_EQ(build_host_mesh(grid).vertices.size(), 13U);
}

TEST(HostMesh, GivesReversedCornersNoThickness) {
  auto grid = grids::box({2, 1, 2});
  grid.zcorn[grid.zcorn_index({0, 0, 0}, 0, 0, 1)] = 999.0;  // base above the top on one pillar
  const auto mesh = build_host_mesh(grid);
  EXPECT_EQ(check_host_validity(grid, mesh)[GridOddity::reversed_corners].count, 1);
  EXPECT_EQ(mesh.corner(HostCellId(0), 0, 0, 0), mesh.corner(HostCellId(0), 0, 0, 1));
  const auto checked = check_host(grid, mesh);
  EXPECT_TRUE(checked.faults.empty()) << checked.faults.front();
}

TEST(HostMesh, CutsOverlappingLayers) {
  auto grid = grids::box({1, 1, 2});
  for (int corner = 0; corner < 4; ++corner)  // the upper cell's base 2 m below the lower one's top
    grid.zcorn[grid.zcorn_index({0, 0, 0}, corner & 1, corner >> 1, 1)] += 2.0;
  const auto mesh = build_host_mesh(grid);
  EXPECT_EQ(check_host_validity(grid, mesh)[GridOddity::overlapping].count, 1);
  EXPECT_NEAR(mesh.volume[HostCellId(1)], 10.0 * 20.0 * 3.0, 1e-9);
  EXPECT_EQ(faces_where(mesh, [&](FaceId f) { return is_inner(mesh, f); }), 1);
}

TEST(HostMesh, RefusesAFaultThatCrossesTooManyLayers) {
  // Every one of 2101 lines crosses every other side's: 2101 x 2101 points, above 1000 for each of 2 x 2100 levels.
  auto grid = grids::box({2, 1, 2100});
  const double height = 5.0 * 2100;
  for (std::int64_t k = 0; k < 2100; ++k)
    for (int corner = 0; corner < 8; ++corner)
      grid.zcorn[grid.zcorn_index({1, 0, k}, corner & 1, (corner >> 1) & 1, corner >> 2)] +=
          (corner & 2) != 0 ? 2.0 * height : -2.0 * height;
  try {
    (void)build_host_mesh(grid);
    FAIL() << "built";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("at pillar (2, 1) cross in 4414201 points"), std::string::npos)
        << error.what();
  }
}

TEST(RequireIds, RefusesMoreThanCanBeNumbered) {
  EXPECT_NO_THROW(require_ids(2'147'483'647, "vertices"));
  try {
    require_ids(2'147'483'648, "vertices");
    FAIL() << "numbered";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(),
                 "the grid has 2147483648 vertices, and 2147483647 can be numbered; check ZCORN, or refine less");
  }
}

TEST(HostMesh, ThrowsWhenNothingHasAVolume) {
  auto grid = grids::box({2, 2, 2});
  std::fill(grid.active.begin(), grid.active.end(), std::uint8_t{0});
  EXPECT_THROW((void)build_host_mesh(grid), InvalidInput);
  grid = grids::box({2, 2, 2});
  grid.zcorn.pop_back();
  EXPECT_THROW((void)build_host_mesh(grid), InvalidInput);
}

TEST(HostMesh, DoesNotDependOnTheNumberOfThreads) {
  const auto grid = grids::random_faults({6, 7, 5}, 77);
  const auto build_with = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return build_host_mesh(grid);
  };
  const auto one = build_with(1);
  const auto two = build_with(2);
  EXPECT_EQ(one.vertices.raw(), two.vertices.raw());
  EXPECT_EQ(one.corners.rank, two.corners.rank);
  EXPECT_EQ(one.corners.first, two.corners.first);
  EXPECT_EQ(one.faces.vertices, two.faces.vertices);
  EXPECT_EQ(one.faces.vertex_start, two.faces.vertex_start);
  EXPECT_EQ(one.faces.cells.raw(), two.faces.cells.raw());
}

TEST(HostMesh, IsWatertightOnPublicGrids) {
  struct Expected {
    const char* file;
    std::int64_t cells;  ///< with a volume
    bool faulted;
  };
  // Cells: nx ny nz of SPE9 and Model 5; NWM and Reek have inactive cells (their ACTNUM sums to these numbers).
  for (const Expected& expected :
       {Expected{"spe9/SPE9_CP.DATA", 24 * 25 * 15, false}, Expected{"model5/MODEL5.DATA", 20 * 30 * 10, false},
        Expected{"nwm/NWM.data", 6200, false}, Expected{"reek/reek_sim.grdecl", 35812, true}}) {
    const std::string path = std::string(WELLKNIT_SHARED) + "/data/" + expected.file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    const auto grid = read_case(path).grid;
    const auto mesh = build_host_mesh(grid);
    const auto checked = check_host(grid, mesh);
    EXPECT_EQ(checked.cells, expected.cells) << path;
    EXPECT_TRUE(checked.faults.empty()) << path << ": " << checked.faults.front();
    EXPECT_LT(checked.worst_openness, 1e-12) << path;
    const auto fault_faces = faces_where(mesh, [&](FaceId f) { return mesh.faces.is_fault[f] == 1; });
    EXPECT_EQ(fault_faces > 0, expected.faulted) << path;
    // Cut sides between skew pillars: the fan around a part's mean is not the bilinear volume.
    EXPECT_LT(checked.worst_volume, expected.faulted ? 0.02 : 1e-12) << path;
  }
}

TEST(HostMesh, IsWatertightOnOddGrids) {
  const std::string folder = std::string(WELLKNIT_SHARED) + "/data/odd";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  int grids_read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".grdecl") continue;
    const auto grid = read_case(entry.path().string()).grid;
    const auto checked = check_host(grid, build_host_mesh(grid));
    EXPECT_TRUE(checked.faults.empty()) << entry.path() << ": " << checked.faults.front();
    EXPECT_LT(checked.worst_openness, 1e-12) << entry.path();
    ++grids_read;
  }
  EXPECT_GT(grids_read, 10);
}

TEST(HostMesh, NumbersEveryCornerOfEveryCell) {
  for (const auto& [name, grid] : grids::zoo()) {
    const auto mesh = build_host_mesh(grid);
    ASSERT_EQ(mesh.corners.rank.size(), grid.zcorn.size()) << name;
    for (std::int64_t c = 0; c < grid.cell_count(); ++c) {
      const auto corners = grid.corners(HostCellId(c));
      const auto vertices = mesh.corners_of(HostCellId(c));
      for (std::size_t n = 0; n < 8; ++n) {
        const Vec3 placed = mesh.vertices[vertices[n]];
        EXPECT_LT((placed - corners[n]).norm(), 1e-5) << name;  // merged by up to a few tolerances
      }
    }
  }
}

}  // namespace
}  // namespace wellknit
