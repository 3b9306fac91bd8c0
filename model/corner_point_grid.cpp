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
  // Three determinants, all of differences. With bilinear faces a hexahedron has the volume of the one whose faces are
  // fans around the means of their corners: Grandy, "Efficient computation of volume of hexahedral cells", 1997.
  const auto& x = corners;
  const Vec3 a = x[7] - x[1];
  const Vec3 b = x[6] - x[0];
  const Vec3 c = x[7] - x[2];
  const Vec3 d = x[3] - x[0];
  const Vec3 e = x[5] - x[0];
  const Vec3 f = x[7] - x[4];
  return ((a + b).dot(c.cross(d)) + b.dot((c + e).cross(f)) + a.dot(e.cross(f + d))) / 12.0;
}

void validate(const CornerPointGrid& grid) {
  const auto [nx, ny, nz] = grid.dimensions;
  if (nx < 1 || ny < 1 || nz < 1) throw InvalidInput("the grid has no cells: its dimensions must be at least 1 1 1");
  const auto expect = [](std::string_view name, std::size_t found, std::int64_t expected) {
    if (found != static_cast<std::size_t>(expected))
      throw InvalidInput(fmt::format("{} has {} values where the dimensions ask for {}", name, found, expected));
  };
  // One after the other, so that the product cannot overflow.
  if (nx > max_cells || ny > max_cells / nx || nz > max_cells / (nx * ny))
    throw InvalidInput(fmt::format("the grid of {} x {} x {} cells is too large: at most {} cells can be read", nx, ny,
                                   nz, max_cells));
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
