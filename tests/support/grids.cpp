// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "tests/support/grids.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace wellknit::grids {

namespace {

using Cell = std::array<std::int64_t, 3>;
using Corner = std::array<int, 3>;

constexpr double top = 1000.0;
constexpr Vec3::Scalar dx = 10.0;
constexpr Vec3::Scalar dy = 20.0;
constexpr Vec3::Scalar dz = 5.0;

double real(std::int64_t value) { return static_cast<double>(value); }

Recipe box_recipe(Dimensions dimensions, const Vec3& cell = {dx, dy, dz}) {
  Recipe recipe;
  recipe.dimensions = dimensions;
  const double base = top + cell[2] * real(dimensions[2]);
  recipe.pillar = [=](std::int64_t i, std::int64_t j) {
    return std::array<Vec3, 2>{Vec3(cell[0] * real(i), cell[1] * real(j), top),
                               Vec3(cell[0] * real(i), cell[1] * real(j), base)};
  };
  recipe.depth = [=](Cell at, Corner corner) { return top + cell[2] * real(at[2] + corner[2]); };
  return recipe;
}

void add_throw(Recipe& recipe, std::function<double(Cell, Corner)> throw_of) {
  recipe.depth = [depth = recipe.depth, throw_of = std::move(throw_of)](Cell at, Corner corner) {
    return depth(at, corner) + throw_of(at, corner);
  };
}

void add_scissor(Recipe& recipe, double throw_) {
  const auto [nx, ny, nz] = recipe.dimensions;
  add_throw(recipe, [=, nx = nx, ny = ny](Cell at, Corner corner) {
    return at[0] >= nx / 2 ? throw_ * (2.0 * real(at[1] + corner[1]) / real(ny) - 1.0) : 0.0;
  });
}

void twist(Recipe& recipe) {
  recipe.pillar = [pillar = recipe.pillar](std::int64_t i, std::int64_t j) {
    auto ends = pillar(i, j);
    ends[0] += Vec3(1.5 * std::sin(1.3 * real(i) + 0.7 * real(j)), 2.0 * std::cos(0.9 * real(i) - 1.1 * real(j)), -3.0);
    ends[1] += Vec3(1.5 * std::cos(2.1 * real(i) + 0.3 * real(j)), 2.0 * std::sin(1.7 * real(j) + 0.4 * real(i)), 4.0);
    return ends;
  };
  add_throw(recipe, [](Cell at, Corner corner) {
    return 1.2 * std::sin(0.8 * real(at[0] + corner[0])) * std::cos(1.1 * real(at[1] + corner[1])) +
           0.3 * real(at[0] + corner[0]);
  });
}

}  // namespace

CornerPointGrid make(const Recipe& recipe) {
  CornerPointGrid grid;
  grid.dimensions = recipe.dimensions;
  const auto [nx, ny, nz] = recipe.dimensions;
  for (std::int64_t j = 0; j <= ny; ++j) {
    for (std::int64_t i = 0; i <= nx; ++i) {
      for (const Vec3& end : recipe.pillar(i, j)) grid.coord.insert(grid.coord.end(), {end[0], end[1], end[2]});
    }
  }
  const auto cells = static_cast<std::size_t>(grid.cell_count());
  grid.zcorn.resize(8 * cells);
  for (std::size_t c = 0; c < cells; ++c) {
    const Cell at = grid.ijk(HostCellId(c));
    for (int corner = 0; corner < 8; ++corner) {
      const Corner d{corner & 1, (corner >> 1) & 1, corner >> 2};
      grid.zcorn[grid.zcorn_index(at, d[0], d[1], d[2])] = recipe.depth(at, d);
    }
  }
  grid.active.assign(cells, 1);
  grid.porosity.assign(cells, 0.2);
  grid.permeability = {std::vector<double>(cells, 1e-13), std::vector<double>(cells, 2e-13),
                       std::vector<double>(cells, 1e-14)};
  return grid;
}

CornerPointGrid box(Dimensions dimensions, const Vec3& cell) { return make(box_recipe(dimensions, cell)); }

CornerPointGrid faulted(Dimensions dimensions, double throw_) {
  Recipe recipe = box_recipe(dimensions);
  add_throw(recipe, [=](Cell at, Corner) { return at[0] >= dimensions[0] / 2 ? throw_ : 0.0; });
  return make(recipe);
}

CornerPointGrid scissor_fault(Dimensions dimensions, double throw_) {
  Recipe recipe = box_recipe(dimensions);
  add_scissor(recipe, throw_);
  return make(recipe);
}

CornerPointGrid crossing_faults(Dimensions dimensions, double throw_) {
  Recipe recipe = box_recipe(dimensions);
  add_throw(recipe, [=](Cell at, Corner) {
    return (at[0] >= dimensions[0] / 2 ? throw_ : 0.0) + (at[1] >= dimensions[1] / 2 ? 0.37 * throw_ : 0.0);
  });
  return make(recipe);
}

CornerPointGrid wedge(Dimensions dimensions) {
  Recipe recipe = box_recipe(dimensions);
  recipe.depth = [=](Cell at, Corner corner) {
    return top + dz * real(at[2] + corner[2]) * real(at[0] + corner[0]) / real(dimensions[0]);
  };
  return make(recipe);
}

CornerPointGrid pinched(Dimensions dimensions, bool everywhere, bool connects) {
  Recipe recipe = box_recipe(dimensions);
  add_throw(recipe, [=](Cell at, Corner corner) {
    const bool here = everywhere || at[0] < dimensions[0] / 2;
    return here && at[2] + corner[2] > dimensions[2] / 2 ? -dz : 0.0;
  });
  CornerPointGrid grid = make(recipe);
  grid.connects_across_pinch = connects;
  return grid;
}

CornerPointGrid with_gap(Dimensions dimensions) {
  Recipe recipe = box_recipe(dimensions);
  add_throw(recipe, [](Cell at, Corner) { return at[2] > 0 ? 1.0 : 0.0; });
  return make(recipe);
}

CornerPointGrid twisted(Dimensions dimensions) {
  Recipe recipe = box_recipe(dimensions);
  twist(recipe);
  return make(recipe);
}

CornerPointGrid twisted_fault(Dimensions dimensions, double throw_) {
  Recipe recipe = box_recipe(dimensions);
  twist(recipe);
  add_scissor(recipe, throw_);
  return make(recipe);
}

CornerPointGrid left_handed(Dimensions dimensions) {
  Recipe recipe = box_recipe(dimensions);
  twist(recipe);
  add_scissor(recipe, 7.0);
  recipe.pillar = [pillar = recipe.pillar](std::int64_t i, std::int64_t j) {
    auto ends = pillar(i, j);
    for (Vec3& end : ends) end[1] = -end[1];
    return ends;
  };
  return make(recipe);
}

CornerPointGrid with_inactive(Dimensions dimensions, double throw_) {
  CornerPointGrid grid = faulted(dimensions, throw_);
  for (std::size_t c = 0; c < grid.active.size(); c += 3) grid.active[c] = 0;
  return grid;
}

CornerPointGrid random_faults(Dimensions dimensions, std::uint32_t seed) {
  std::mt19937 engine(seed);
  // The engine's numbers are the standard's; those of std distributions differ between libraries.
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(engine()) / 4294967296.0);
  };
  const auto columns = static_cast<std::size_t>(dimensions[0] * dimensions[1]);
  const auto layers = static_cast<std::size_t>(dimensions[2]);
  std::vector<double> depths(4 * columns * (layers + 1));
  for (std::size_t column = 0; column < columns; ++column) {
    const double shift = uniform(0.0, 1.0) < 0.3 ? 0.0 : uniform(-12.0, 12.0);
    for (std::size_t corner = 0; corner < 4; ++corner) {
      // Whole metres now and then, so that lines of both sides meet on a pillar or coincide.
      double depth = top + (uniform(0.0, 1.0) < 0.5 ? std::round(shift) : shift + uniform(-6.0, 6.0));
      for (std::size_t k = 0; k <= layers; ++k) {
        depths[k + (layers + 1) * (corner + 4 * column)] = depth;
        const double kind = uniform(0.0, 1.0);
        depth += kind < 0.2 ? 0.0 : kind < 0.5 ? dz : uniform(0.1, 2.0 * dz);
      }
    }
  }
  Recipe recipe = box_recipe(dimensions);
  recipe.pillar = [&, pillar = recipe.pillar](std::int64_t i, std::int64_t j) {
    auto ends = pillar(i, j);
    ends[1] += Vec3(uniform(-2.0, 2.0), uniform(-2.0, 2.0), 0.0);
    return ends;
  };
  recipe.depth = [&](Cell at, Corner corner) {
    const auto column = static_cast<std::size_t>(at[0] + dimensions[0] * at[1]);
    return depths[static_cast<std::size_t>(at[2] + corner[2]) +
                  (layers + 1) * (static_cast<std::size_t>(corner[0] + 2 * corner[1]) + 4 * column)];
  };
  CornerPointGrid grid = make(recipe);
  for (auto& active : grid.active) active = uniform(0.0, 1.0) < 0.85 ? 1 : 0;
  return grid;
}

namespace {

/// The engine's numbers are the standard's; those of std distributions differ between libraries.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }

 private:
  std::mt19937 engine_;
};

/// Pillars of a grid in one of five moods; true when all are parallel.
bool place_pillars(CornerPointGrid& grid, Dice& dice) {
  const int mood = static_cast<int>(dice.uniform(0.0, 5.0));
  const Vec3 common = mood == 0 ? Vec3::Zero() : Vec3(dice.uniform(-6.0, 6.0), dice.uniform(-6.0, 6.0), 0.0);
  const double jitter = mood == 2 ? 6.0 : 0.0;                        // concave columns
  const double skew = mood == 3 ? 2.0 : mood == 4 ? 12.0 : 0.0;       // 12 m: pillars cross
  const double coincide = mood != 0 && dice.chance(0.3) ? 0.1 : 0.0;  // with the pillar before
  const std::int64_t nx = grid.dimensions[0];
  for (std::int64_t j = 0; j <= grid.dimensions[1]; ++j)
    for (std::int64_t i = 0; i <= nx; ++i) {
      double* p = &grid.coord[static_cast<std::size_t>(6 * (i + (nx + 1) * j))];
      if (i > 0 && dice.chance(coincide)) {
        std::copy(p - 6, p, p);
        continue;
      }
      for (int axis = 0; axis < 2; ++axis) {
        p[axis] += dice.uniform(-jitter, jitter);
        p[3 + axis] = p[axis] + common[axis] + dice.uniform(-skew, skew);
      }
    }
  return skew == 0.0;
}

/// How the layers of a grid are drawn.
struct LayerMood {
  double flat = 0.0;      ///< chance of no thickness
  double thin = 0.0;      ///< chance of less than the merge tolerance
  double gap = 0.0;       ///< chance of a void over a layer
  double overlap = 0.0;   ///< chance of a layer that begins above the base over it
  double reversed = 0.0;  ///< chance of a corner whose base lies above its top
};

LayerMood layer_mood(Dice& dice) {
  LayerMood mood;
  mood.flat = dice.chance(0.7) ? 0.25 : 0.0;
  mood.thin = dice.chance(0.2) ? 0.1 : 0.0;
  mood.gap = dice.chance(0.4) ? 0.15 : 0.0;
  mood.overlap = dice.chance(0.3) ? 0.1 : 0.0;
  mood.reversed = dice.chance(0.2) ? 0.05 : 0.0;
  return mood;
}

/// Depths of one corner of one column, top and base of each layer.
void draw_corner(CornerPointGrid& grid, Cell at, Corner corner, double depth, const LayerMood& mood, Dice& dice) {
  for (at[2] = 0; at[2] < grid.dimensions[2]; ++at[2]) {
    if (dice.chance(mood.gap)) depth += dice.uniform(0.0, 3.0);
    if (dice.chance(mood.overlap)) depth -= dice.uniform(0.0, 3.0);
    grid.zcorn[grid.zcorn_index(at, corner[0], corner[1], 0)] = depth;
    if (dice.chance(mood.thin))
      depth += 3e-7;
    else if (dice.chance(mood.reversed))
      depth -= dice.uniform(0.0, 2.0);
    else if (!dice.chance(mood.flat))
      depth += dice.chance(0.4) ? dz : dice.uniform(0.1, 2.0 * dz);
    grid.zcorn[grid.zcorn_index(at, corner[0], corner[1], 1)] = depth;
  }
}

void draw_layers(CornerPointGrid& grid, Dice& dice) {
  const LayerMood mood = layer_mood(dice);
  const double faulted = dice.uniform(0.0, 1.0);
  const double tilt = dice.chance(0.5) ? 6.0 : 0.0;
  for (std::int64_t j = 0; j < grid.dimensions[1]; ++j)
    for (std::int64_t i = 0; i < grid.dimensions[0]; ++i) {
      const double shift = dice.chance(faulted) ? dice.uniform(-12.0, 12.0) : 0.0;
      // Whole metres now and then, so that lines of both sides meet on a pillar or coincide.
      const bool is_level = dice.chance(0.5);
      for (int c = 0; c < 4; ++c) {
        const double depth = top + (is_level ? std::round(shift) : shift + dice.uniform(-tilt, tilt));
        draw_corner(grid, {i, j, 0}, {c & 1, c >> 1, 0}, depth, mood, dice);
      }
    }
}

/// The same layers, numbered upwards.
CornerPointGrid numbered_upwards(const CornerPointGrid& down) {
  CornerPointGrid up = down;
  const std::int64_t last = down.dimensions[2] - 1;
  for (std::int64_t c = 0; c < up.cell_count(); ++c) {
    const auto [i, j, k] = up.ijk(HostCellId(c));
    for (int corner = 0; corner < 8; ++corner)
      up.zcorn[up.zcorn_index({i, j, last - k}, corner & 1, (corner >> 1) & 1, 1 - (corner >> 2))] =
          down.zcorn[down.zcorn_index({i, j, k}, corner & 1, (corner >> 1) & 1, corner >> 2)];
  }
  return up;
}

}  // namespace

RandomHost random_host(Dimensions dimensions, std::uint32_t seed) {
  Dice dice(seed);
  RandomHost out;
  out.grid = box(dimensions);
  CornerPointGrid& grid = out.grid;
  out.has_parallel_pillars = place_pillars(grid, dice);
  draw_layers(grid, dice);
  const double inactive = dice.chance(0.6) ? 0.15 : 0.0;
  for (auto& active : grid.active) active = dice.chance(inactive) ? 0 : 1;
  for (double& porosity : grid.porosity) porosity = dice.uniform(0.01, 0.3);
  if (dice.chance(0.3)) grid.edits.least_pore_volume = dice.uniform(10.0, 150.0);
  if (dice.chance(0.4)) {
    grid.connects_across_pinch = true;
    grid.edits.pinch = PinchOptions{dice.uniform(0.0, 2.0), dice.chance(0.5), dice.uniform(0.0, 4.0), {}, {}};
  }
  if (dice.chance(0.3))
    for (std::size_t n = 1; n < grid.coord.size(); n += 3) grid.coord[n] = -grid.coord[n];
  if (dice.chance(0.3)) grid = numbered_upwards(grid);
  return out;
}

std::vector<Named> zoo() {
  constexpr Dimensions d{4, 4, 3};
  return {{"box", box(d)},
          {"one cell", box({1, 1, 1})},
          {"fault of half a layer", faulted(d, 2.5)},
          {"fault of two layers", faulted(d, 10.0)},
          {"fault upwards", faulted(d, -7.3)},
          {"fault without contact", faulted(d, 40.0)},
          {"scissor fault", scissor_fault(d, 7.0)},
          {"crossing faults", crossing_faults(d, 6.0)},
          {"wedge", wedge(d)},
          {"pinched", pinched(d, true, false)},
          {"pinched and connected", pinched(d, true, true)},
          {"half pinched and connected", pinched(d, false, true)},
          {"gap", with_gap(d)},
          {"twisted", twisted(d)},
          {"twisted fault", twisted_fault(d, 8.0)},
          {"left-handed", left_handed(d)},
          {"inactive cells", with_inactive(d, 3.0)},
          {"random faults", random_faults(d, 1)}};
}

}  // namespace wellknit::grids
