// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Tiny named corner-point grids for tests. All cells are active unless said otherwise; porosity 0.2 and permeability
/// 1e-13, 2e-13, 1e-14 m2 everywhere. Depths start at 1000 m.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "model/corner_point_grid.h"

namespace wellknit::grids {

using Dimensions = std::array<std::int64_t, 3>;

/// Upper and lower end of pillar (i, j), and depth of corner (di, dj, dk) of cell (i, j, k).
struct Recipe {
  Dimensions dimensions{};
  std::function<std::array<Vec3, 2>(std::int64_t i, std::int64_t j)> pillar;
  std::function<double(std::array<std::int64_t, 3> cell, std::array<int, 3> corner)> depth;
};
CornerPointGrid make(const Recipe& recipe);

CornerPointGrid box(Dimensions dimensions, const Vec3& cell = {10.0, 20.0, 5.0});
/// A box whose columns i >= nx / 2 lie deeper by this much, m; negative: higher.
CornerPointGrid faulted(Dimensions dimensions, double throw_);
/// As faulted, with a throw that goes from -throw_ at j = 0 to throw_ at j = ny: lines of both sides cross.
CornerPointGrid scissor_fault(Dimensions dimensions, double throw_);
/// Faults along i and j that meet in the middle: four columns at one pillar with four depths.
CornerPointGrid crossing_faults(Dimensions dimensions, double throw_);
/// Every layer thins out towards i = 0 and has no thickness there.
CornerPointGrid wedge(Dimensions dimensions);
/// Layer nz / 2 has no thickness anywhere (pinched = everywhere) or only in columns i < nx / 2.
CornerPointGrid pinched(Dimensions dimensions, bool everywhere, bool connects);
/// A gap of 1 m below layer 0.
CornerPointGrid with_gap(Dimensions dimensions);
/// Pillars of different slants and curved horizons: no face is planar, all match.
CornerPointGrid twisted(Dimensions dimensions);
/// twisted with scissor_fault's throw: cut lines between pillars that are not parallel.
CornerPointGrid twisted_fault(Dimensions dimensions, double throw_);
/// j runs towards negative y.
CornerPointGrid left_handed(Dimensions dimensions);
/// The faulted box with every third cell inactive.
CornerPointGrid with_inactive(Dimensions dimensions, double throw_);
/// Every column has its own throw, tilt and layer thicknesses, some layers without thickness, some pillars slanted.
CornerPointGrid random_faults(Dimensions dimensions, std::uint32_t seed);

struct RandomHost {
  CornerPointGrid grid;
  bool has_parallel_pillars = false;
};
/// All that a grid can do, each thing by the seed's chance: throws, layers without thickness or thinner than the merge
/// tolerance, gaps, overlaps, reversed corners, slanted, crossing and coinciding pillars, twisted and concave columns,
/// inactive cells, MINPV, PINCH, left-handed, layers numbered upwards. It may have no cell with a volume.
RandomHost random_host(Dimensions dimensions, std::uint32_t seed);

struct Named {
  std::string name;
  CornerPointGrid grid;
};
/// One or more of each, for properties that must hold for all.
std::vector<Named> zoo();

}  // namespace wellknit::grids
