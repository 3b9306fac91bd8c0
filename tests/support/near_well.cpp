// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "tests/support/near_well.h"

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/grids.h"

namespace wellknit::near_well {

namespace {

constexpr double cell = 40.0;
constexpr double layer = 15.0;
constexpr std::int64_t lateral = 20;
constexpr std::int64_t layers = 12;
constexpr double top = 2000.0;
constexpr double length = cell * lateral;
constexpr double height = layer * layers;

double depth_at(double deformation, double u, double v, double k) {
  using std::numbers::pi;
  const double thickness = layer * (1.0 + 0.3 * deformation * std::sin(2 * pi * u) * std::cos(pi * v));
  const double dome = -0.4 * height * std::exp(-6.0 * ((u - 0.5) * (u - 0.5) + (v - 0.5) * (v - 0.5)));
  const double waves = 0.12 * height * std::sin(4 * pi * u) * std::cos(3 * pi * v);
  return top + deformation * (dome + waves) + k * thickness;
}

}  // namespace

Case deformed(double deformation) {
  grids::Recipe recipe;
  recipe.dimensions = {lateral, lateral, layers};
  recipe.pillar = [deformation](std::int64_t i, std::int64_t j) {
    const double x = cell * static_cast<double>(i);
    const double y = cell * static_cast<double>(j);
    const Vec3 slant(30.0, 20.0 * std::cos(2 * std::numbers::pi * x / length), 0.0);
    return std::array{Vec3(Vec3(x, y, top - height) - deformation * slant),
                      Vec3(Vec3(x, y, top + 2 * height) + deformation * slant)};
  };
  recipe.depth = [deformation](std::array<std::int64_t, 3> c, std::array<int, 3> corner) {
    const double u = static_cast<double>(c[0] + corner[0]) / lateral;
    const double v = static_cast<double>(c[1] + corner[1]) / lateral;
    return depth_at(deformation, u, v, static_cast<double>(c[2] + corner[2]));
  };
  Case out;
  out.grid = grids::make(recipe);
  const auto n = static_cast<std::size_t>(out.grid.cell_count());
  out.grid.porosity.assign(n, 0.2);
  out.grid.permeability = {std::vector<double>(n, 1e-13), std::vector<double>(n, 1e-13), std::vector<double>(n, 1e-14)};
  return out;
}

void randomise(CornerPointGrid& grid, std::uint32_t seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (std::size_t c = 0; c < grid.porosity.size(); ++c) {
    grid.porosity[c] = 0.05 + 0.25 * unit(generator);
    const double k = 1e-14 * std::pow(100.0, unit(generator));
    grid.permeability[0][c] = grid.permeability[1][c] = k;
    grid.permeability[2][c] = 0.1 * k;
  }
}

Well straight(const std::string& name, const Vec3& from, const Vec3& to) {
  Well out;
  out.name = name;
  constexpr int stations = 51;
  for (int s = 0; s < stations; ++s) {
    const double t = static_cast<double>(s) / (stations - 1);
    out.trajectory.points.push_back(from + t * (to - from));
    out.trajectory.measured_depth.push_back(t * (to - from).norm());
  }
  return out;
}

Well well(Path path, double drainage_radius) {
  Well out;
  switch (path) {
    case Path::vertical: out = straight("V", {411.0, 389.0, 1700.0}, {411.0, 389.0, 2500.0}); break;
    case Path::deviated: out = straight("D", {300.0, 330.0, 2030.0}, {500.0, 460.0, 2120.0}); break;
    case Path::horizontal: out = straight("H", {270.0, 380.0, 2075.0}, {530.0, 420.0, 2080.0}); break;
    case Path::curved:
      out = straight("C", {290.0, 340.0, 2040.0}, {510.0, 450.0, 2110.0});
      for (std::size_t s = 0; s < out.trajectory.points.size(); ++s) {
        const double t = static_cast<double>(s) / 50.0;
        out.trajectory.points[s] += t * (1 - t) * Vec3(-60.0, 120.0, -20.0);
      }
      break;
  }
  out.radial.drainage_radius = drainage_radius;
  return out;
}

}  // namespace wellknit::near_well
