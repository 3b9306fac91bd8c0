// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/corner_point_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/errors.h"

namespace wellknit {

Vec3 CornerPointGrid::pillar_point(std::int64_t i, std::int64_t j, double depth) const {
  const double* p = &coord[static_cast<std::size_t>(6 * (i + (dimensions[0] + 1) * j))];
  const double height = p[5] - p[2];
  // A pillar whose two points have one depth carries no direction: it is taken as vertical, as simulators do.
  const double t = height != 0.0 ? (depth - p[2]) / height : 0.0;
  return {p[0] + t * (p[3] - p[0]), p[1] + t * (p[4] - p[1]), depth};
}

std::array<Vec3, 8> CornerPointGrid::corners(HostCellId cell) const {
  const auto at = ijk(cell);
  std::array<Vec3, 8> out;
  for (int corner = 0; corner < 8; ++corner) {
    const int di = corner & 1;
    const int dj = (corner >> 1) & 1;
    const int dk = corner >> 2;
    out[static_cast<std::size_t>(corner)] = pillar_point(at[0] + di, at[1] + dj, zcorn[zcorn_index(at, di, dj, dk)]);
  }
  return out;
}

double bilinear_hexahedron_volume(const std::array<Vec3, 8>& corners) {
  // Faces with outward loops; the fan around the mean of four corners has the volume of the bilinear patch.
  static constexpr std::array<std::array<std::size_t, 4>, 6> loops{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  Vec3 origin = Vec3::Zero();
  for (const Vec3& c : corners) origin += c / 8.0;
  double volume = 0.0;
  for (const auto& loop : loops) {
    Vec3 mean = Vec3::Zero();
    for (const std::size_t c : loop) mean += corners[c] / 4.0;
    for (std::size_t s = 0; s < 4; ++s) {
      const Vec3 a = corners[loop[s]] - origin;
      const Vec3 b = corners[loop[(s + 1) % 4]] - origin;
      volume += (mean - origin).dot(a.cross(b)) / 6.0;
    }
  }
  return volume;
}

void validate(const CornerPointGrid& grid) {
  const auto [nx, ny, nz] = grid.dimensions;
  if (nx < 1 || ny < 1 || nz < 1) throw InvalidInput("the grid has no cells: its dimensions must be at least 1 1 1");
  const auto expect = [](std::string_view name, std::size_t found, std::int64_t expected) {
    if (found != static_cast<std::size_t>(expected))
      throw InvalidInput(fmt::format("{} has {} values where the dimensions ask for {}", name, found, expected));
  };
  const std::int64_t n = grid.cell_count();
  expect("COORD", grid.coord.size(), 6 * (nx + 1) * (ny + 1));
  expect("ZCORN", grid.zcorn.size(), 8 * n);
  expect("ACTNUM", grid.active.size(), n);
  if (!grid.porosity.empty()) expect("PORO", grid.porosity.size(), n);
  if (!grid.net_to_gross.empty()) expect("NTG", grid.net_to_gross.size(), n);
  for (const auto& k : grid.permeability)
    if (!k.empty()) expect("permeability", k.size(), n);
  for (const auto& [name, values] : grid.properties)
    std::visit([&, &key = name](const auto& v) { expect(key, v.size(), n); }, values);
  validate(grid.edits, grid.dimensions);
  const auto finite = [](double v) { return std::isfinite(v); };
  if (!std::all_of(grid.coord.begin(), grid.coord.end(), finite))
    throw InvalidInput("COORD holds a value that is not finite");
  if (!std::all_of(grid.zcorn.begin(), grid.zcorn.end(), finite))
    throw InvalidInput("ZCORN holds a value that is not finite");
}

}  // namespace wellknit
