// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/host_validity.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <functional>
#include <optional>

#include "algorithm/build_mesh.h"
#include "model/errors.h"
#include "tests/support/grids.h"

namespace wellknit {
namespace {

using Place = std::array<std::int64_t, 3>;

/// A box of 10 x 20 x 5 m cells with pillars moved to these points in plan at their upper and lower ends (the grid's
/// top and base); nothing: left where it is.
using Ends = std::array<std::array<double, 2>, 2>;
CornerPointGrid with_pillars(grids::Dimensions dimensions,
                             const std::function<std::optional<Ends>(std::int64_t, std::int64_t)>& move) {
  CornerPointGrid grid = grids::box(dimensions);
  for (std::int64_t j = 0; j <= dimensions[1]; ++j)
    for (std::int64_t i = 0; i <= dimensions[0]; ++i) {
      const auto ends = move(i, j);
      if (!ends) continue;
      double* p = &grid.coord[static_cast<std::size_t>(6 * (i + (dimensions[0] + 1) * j))];
      for (std::size_t end = 0; end < 2; ++end)
        for (std::size_t axis = 0; axis < 2; ++axis) p[3 * end + axis] = (*ends)[end][axis];
    }
  return grid;
}

Ends vertical(double x, double y) { return {{{x, y}, {x, y}}}; }

/// One cell with vertical pillars at these corners, di + 2 dj.
CornerPointGrid one_cell(const std::array<std::array<double, 2>, 4>& corners) {
  return with_pillars({1, 1, 1}, [&](std::int64_t i, std::int64_t j) {
    const auto& c = corners[static_cast<std::size_t>(i + 2 * j)];
    return std::optional(vertical(c[0], c[1]));
  });
}

/// Nothing is odd but this.
const OddPlaces& only(const GridValidity& validity, GridOddity kind) {
  for (std::size_t n = 0; n < grid_oddity_count; ++n) {
    if (n == static_cast<std::size_t>(kind)) continue;
    EXPECT_EQ(validity.kinds[n].count, 0) << name_of(static_cast<GridOddity>(n));
  }
  return validity[kind];
}

CornerPointGrid upside_down(const CornerPointGrid& down) {
  CornerPointGrid up = down;
  const std::int64_t nz = down.dimensions[2];
  for (std::int64_t c = 0; c < up.cell_count(); ++c) {
    const auto [i, j, k] = up.ijk(HostCellId(c));
    for (int corner = 0; corner < 8; ++corner)
      up.zcorn[up.zcorn_index({i, j, nz - 1 - k}, corner & 1, (corner >> 1) & 1, 1 - (corner >> 2))] =
          down.zcorn[down.zcorn_index({i, j, k}, corner & 1, (corner >> 1) & 1, corner >> 2)];
    up.active[up.cell_id(i, j, nz - 1 - k).index()] = down.active[static_cast<std::size_t>(c)];
  }
  return up;
}

TEST(HostValidity, FindsNothingInSoundGrids) {
  for (const auto& [name, grid] : grids::zoo()) {
    if (name == "gap") continue;
    EXPECT_TRUE(check_host_validity(grid).empty()) << name << ": " << to_lines(check_host_validity(grid)).front();
    EXPECT_TRUE(check_host_validity(upside_down(grid)).empty()) << name;
  }
}

TEST(HostValidity, NamesCellsWithReversedCorners) {
  auto grid = grids::box({2, 1, 2});
  grid.zcorn[grid.zcorn_index({0, 0, 0}, 0, 0, 1)] = 999.0;  // its top is at 1000 m
  const GridValidity validity = check_host_validity(grid);
  const OddPlaces& found = validity[GridOddity::reversed_corners];
  EXPECT_EQ(found.count, 1);
  EXPECT_EQ(found.worst, (OddPlace{{0, 0, 0}, no_place, 1.0}));
  EXPECT_EQ(found.first, std::vector{found.worst});
  // On that pillar the cell ends at 1000 m, the one below begins at 1005 m.
  EXPECT_EQ(validity[GridOddity::gap].worst, (OddPlace{{0, 0, 1}, {0, 0, 0}, 5.0}));
  EXPECT_EQ(validity[GridOddity::gap].count, 1);
}

TEST(HostValidity, NamesCellsThatBeginAboveTheBaseOverThem) {
  auto grid = grids::box({1, 1, 2});
  for (int corner = 0; corner < 4; ++corner)
    grid.zcorn[grid.zcorn_index({0, 0, 0}, corner & 1, corner >> 1, 1)] += corner == 3 ? 2.5 : 2.0;
  EXPECT_EQ(only(check_host_validity(grid), GridOddity::overlapping).worst, (OddPlace{{0, 0, 1}, {0, 0, 0}, 2.5}));
  grid.active[1] = 0;
  EXPECT_TRUE(check_host_validity(grid).empty()) << "an inactive cell may overlap";
}

TEST(HostValidity, MeasuresGapsBetweenLayers) {
  const GridValidity validity = check_host_validity(grids::with_gap({2, 1, 2}));  // 1 m below layer 0
  const OddPlaces& found = only(validity, GridOddity::gap);
  EXPECT_EQ(found.count, 2);
  EXPECT_EQ(found.first, (std::vector{OddPlace{{0, 0, 1}, {0, 0, 0}, 1.0}, OddPlace{{1, 0, 1}, {1, 0, 0}, 1.0}}));
  EXPECT_NEAR(found.area, 2 * 10.0 * 20.0, 1e-9);
  EXPECT_EQ(check_host_validity(upside_down(grids::with_gap({2, 1, 2})))[GridOddity::gap].worst,
            (OddPlace{{0, 0, 0}, {0, 0, 1}, 1.0}));
}

TEST(HostValidity, AddsUpAGapAroundACellWithoutThickness) {
  auto grid = grids::with_gap({1, 1, 3});  // cells at 0 to 5, 6 to 11, 11 to 16 m
  for (int corner = 0; corner < 4; ++corner)
    for (int dk = 0; dk < 2; ++dk)  // the middle one at 8 m, without thickness
      grid.zcorn[grid.zcorn_index({0, 0, 1}, corner & 1, corner >> 1, dk)] = 1008.0;
  EXPECT_EQ(only(check_host_validity(grid), GridOddity::gap).worst, (OddPlace{{0, 0, 2}, {0, 0, 0}, 6.0}));
  grid.active[0] = 0;
  EXPECT_TRUE(check_host_validity(grid).empty()) << "nothing to connect to";
}

TEST(HostValidity, TakesAShaleForNoGap) {
  auto grid = grids::box({1, 1, 3});
  grid.active[1] = 0;
  EXPECT_TRUE(check_host_validity(grid).empty());
}

TEST(HostValidity, NamesCellsOfNegativeVolume) {
  // Pillars at x = 0, 20, 10, 30 m: the middle column runs backwards, -10 x 20 x 5 m.
  const auto grid = with_pillars({3, 1, 1}, [](std::int64_t i, std::int64_t j) -> std::optional<Ends> {
    static constexpr std::array x{0.0, 20.0, 10.0, 30.0};
    return vertical(x[static_cast<std::size_t>(i)], 20.0 * static_cast<double>(j));
  });
  const GridValidity validity = check_host_validity(grid);
  const OddPlaces& found = only(validity, GridOddity::negative_volume);
  EXPECT_EQ(found.count, 1);
  EXPECT_EQ(found.worst.cell, (Place{1, 0, 0}));
  EXPECT_NEAR(found.worst.figure, 1000.0, 1e-9);
  EXPECT_EQ(build_host_mesh(grid).exists[HostCellId(1)], 0) << "left out, as the report says";
}

TEST(HostValidity, NamesBowTies) {
  // Corners 2 and 3 are exchanged in part: edges 0-2 and 1-3 cross, and 60 m2 remain. At corners 2 and 3 the edges
  // along i and j make -80 m2; scaled: -80 / (4 sqrt(6^2 + 20^2)) and -80 / (4 sqrt(8^2 + 20^2)).
  const auto validity = check_host_validity(one_cell({{{0, 0}, {10, 0}, {6, 20}, {2, 20}}}));
  const OddPlaces& found = only(validity, GridOddity::self_overlapping);
  EXPECT_EQ(found.count, 1);
  EXPECT_NEAR(found.worst.figure, -20.0 / std::sqrt(436.0), 1e-12);
}

TEST(HostValidity, NamesCellsInWhichPillarsCross) {
  // Pillars (0, 0) and (1, 0) stand 10 m apart at the top, and -4 m at the base, 5 m deeper.
  const auto grid = with_pillars({1, 1, 1}, [](std::int64_t i, std::int64_t j) -> std::optional<Ends> {
    if (j == 1) return std::nullopt;
    return i == 0 ? Ends{{{0, 0}, {8, 0}}} : Ends{{{10, 0}, {4, 0}}};
  });
  const GridValidity validity = check_host_validity(grid);
  EXPECT_EQ(validity[GridOddity::self_overlapping].count, 1);
  EXPECT_EQ(validity[GridOddity::twisted].count + validity[GridOddity::negative_volume].count, 0);
  const OddPlaces& pillars = validity[GridOddity::crossing_pillars];
  EXPECT_EQ(pillars.count, 1);
  EXPECT_EQ(pillars.worst.cell, (Place{0, 0, -1}));
  EXPECT_EQ(pillars.worst.other, (Place{1, 0, -1}));
  EXPECT_NEAR(pillars.worst.figure, 180.0, 1e-9);
}

TEST(HostValidity, LooksForCrossingPillarsOnlyWhereCellsAre) {
  // As above with the crossing 10/14 x 5 m below the top; the cells end 3 m below it.
  auto grid = with_pillars({1, 1, 1}, [](std::int64_t i, std::int64_t j) -> std::optional<Ends> {
    if (j == 1) return std::nullopt;
    return i == 0 ? Ends{{{0, 0}, {8, 0}}} : Ends{{{10, 0}, {4, 0}}};
  });
  for (int corner = 0; corner < 4; ++corner) grid.zcorn[grid.zcorn_index({0, 0, 0}, corner & 1, corner >> 1, 1)] = 1003;
  EXPECT_TRUE(check_host_validity(grid).empty());
}

TEST(HostValidity, NamesConcaveCells) {
  // Corner 3 is drawn in to (2, 3): u = (2, -17), v = (-8, 3), u x v = 6 - 136 = -130.
  const auto validity = check_host_validity(one_cell({{{0, 0}, {10, 0}, {0, 20}, {2, 3}}}));
  const OddPlaces& found = only(validity, GridOddity::twisted);
  EXPECT_EQ(found.count, 1);
  EXPECT_NEAR(found.worst.figure, -130.0 / std::sqrt((4.0 + 289.0) * (64.0 + 9.0)), 1e-12);
}

TEST(HostValidity, NamesCellsTwistedBetweenTopAndBase) {
  // A square of 10 m whose corner 3 stands at (10, 10) at the top and, 5 m deeper, at (3, 3): only the base is concave,
  // u = (3, -7), v = (-7, 3), u x v = 9 - 49 = -40. The edge down is (-7, -7, 5), and u, v, down span 5 times -40.
  const auto grid = with_pillars({1, 1, 1}, [](std::int64_t i, std::int64_t j) -> std::optional<Ends> {
    if (i + j == 2) return Ends{{{10, 10}, {3, 3}}};
    return vertical(10.0 * static_cast<double>(i), 10.0 * static_cast<double>(j));
  });
  const auto validity = check_host_validity(grid);
  const OddPlaces& found = only(validity, GridOddity::twisted);
  EXPECT_EQ(found.count, 1);
  EXPECT_NEAR(found.worst.figure, -200.0 / (58.0 * std::sqrt(49.0 + 49.0 + 25.0)), 1e-12);
}

TEST(HostValidity, TakesTrianglesAndPyramidsAsTheyAre) {
  EXPECT_TRUE(check_host_validity(one_cell({{{0, 0}, {10, 0}, {0, 20}, {0, 20}}})).empty()) << "two pillars are one";
  const auto pyramid = with_pillars({1, 1, 1}, [](std::int64_t i, std::int64_t j) {
    return std::optional(Ends{{{10.0 * static_cast<double>(i), 20.0 * static_cast<double>(j)}, {5.0, 10.0}}});
  });
  EXPECT_TRUE(check_host_validity(pyramid).empty()) << to_lines(check_host_validity(pyramid)).front();
}

TEST(HostValidity, DoesNotLookAtInactiveCells) {
  auto grid = one_cell({{{0, 0}, {10, 0}, {0, 20}, {2, 3}}});
  grid.active[0] = 0;
  EXPECT_TRUE(check_host_validity(grid).empty());
}

TEST(HostValidity, TakesLeftHandedGridsAsTheyAre) {
  // The concave cell in a mirror: the same figure.
  const auto validity = check_host_validity(one_cell({{{0, 0}, {10, 0}, {0, -20}, {2, -3}}}));
  EXPECT_NEAR(only(validity, GridOddity::twisted).worst.figure, -130.0 / std::sqrt(293.0 * 73.0), 1e-12);
}

TEST(HostValidity, KeepsTheFirstTenByLayerThenRow) {
  const GridValidity validity = check_host_validity(grids::with_gap({4, 5, 2}));
  const OddPlaces& found = only(validity, GridOddity::gap);
  EXPECT_EQ(found.count, 20);
  ASSERT_EQ(found.first.size(), 10U);
  for (std::int64_t n = 0; n < 10; ++n)
    EXPECT_EQ(found.first[static_cast<std::size_t>(n)].cell, (Place{n % 4, n / 4, 1}));
  EXPECT_EQ(found.worst.cell, (Place{0, 0, 1})) << "of equal ones the first";
}

TEST(HostValidity, DoesNotDependOnTheNumberOfThreads) {
  const auto grid = grids::random_host({9, 8, 6}, 7).grid;
  const auto check_with = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return check_host_validity(grid);
  };
  const GridValidity one = check_with(1);
  EXPECT_FALSE(one.empty());
  EXPECT_EQ(one, check_with(2));
}

TEST(HostValidity, CountsPartsOfFaultFacesWithNothingBehind) {
  // A throw of half a layer: above the deeper column's top and below the higher one's base.
  const auto grid = grids::faulted({2, 1, 2}, 2.5);
  EXPECT_EQ(check_host_validity(grid, build_host_mesh(grid)).open_fault_faces, 2);
  EXPECT_FALSE(check_host_validity(grid).open_fault_faces);
}

TEST(HostValidity, IsPartOfTheSummary) {
  const BuildSummary summary = build_mesh({grids::with_gap({2, 1, 2}), {}, {}, {}}, {}, {}).summary;
  EXPECT_EQ(summary.validity[GridOddity::gap].count, 2);
  EXPECT_EQ(summary.validity.open_fault_faces, 0);
}

TEST(HostValidity, RefusesGridsThatAreNotWhole) {
  auto grid = grids::box({2, 2, 2});
  grid.zcorn.pop_back();
  EXPECT_THROW((void)check_host_validity(grid), InvalidInput);
}

}  // namespace
}  // namespace wellknit
