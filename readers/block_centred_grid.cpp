// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/block_centred_grid.h"

#include <fmt/format.h>

#include <cmath>

#include "model/errors.h"

namespace wellknit {

namespace {

std::string cell_name(std::int64_t i, std::int64_t j, std::int64_t k) {
  return fmt::format("cell {} {} {}", i + 1, j + 1, k + 1);
}

/// Positions of the nx+1 (or ny+1) lines between columns; sizes may vary along `axis` only.
std::vector<double> lines(const BlockCentredGrid& grid, std::span<const double> sizes, std::size_t axis) {
  const auto [nx, ny, nz] = grid.dimensions;
  std::vector<double> out{0.0};
  for (std::int64_t n = 0; n < grid.dimensions[axis]; ++n)
    out.push_back(out.back() + sizes[static_cast<std::size_t>(axis == 0 ? n : n * nx)]);
  // Sizes are often written with few digits and summed elsewhere: the sixth digit is no difference.
  static constexpr double tolerance = 1e-6;
  for (std::int64_t k = 0; k < nz; ++k) {
    for (std::int64_t j = 0; j < ny; ++j) {
      for (std::int64_t i = 0; i < nx; ++i) {
        const auto n = static_cast<std::size_t>(axis == 0 ? i : j);
        const double size = sizes[static_cast<std::size_t>(i + nx * (j + ny * k))];
        const double width = out[n + 1] - out[n];
        if (!(size > 0.0))
          throw InvalidInput(fmt::format("D{} of {} is not given or not positive", "XY"[axis], cell_name(i, j, k)));
        if (std::abs(size - width) > tolerance * width) {
          throw InvalidInput(fmt::format(
              "D{} of {} is {} and that of its column {}: without pillars; write the grid as COORD and ZCORN",
              "XY"[axis], cell_name(i, j, k), size, width));
        }
      }
    }
  }
  return out;
}

/// Depth of the top of every cell.
std::vector<double> complete_tops(const BlockCentredGrid& grid) {
  const std::int64_t nx = grid.dimensions[0];
  const std::int64_t ny = grid.dimensions[1];
  std::vector<double> tops(grid.tops.begin(), grid.tops.end());
  const auto layer = static_cast<std::size_t>(nx * ny);
  for (std::size_t cell = 0; cell < tops.size(); ++cell) {
    const auto n = static_cast<std::int64_t>(cell);
    const auto name = [&] { return cell_name(n % nx, (n / nx) % ny, n / (nx * ny)); };
    if (!(grid.dz[cell] >= 0.0)) throw InvalidInput(fmt::format("DZ of {} is not given or negative", name()));
    if (std::isnan(tops[cell]) && cell < layer) throw InvalidInput(fmt::format("TOPS of {} is not given", name()));
    if (std::isnan(tops[cell])) tops[cell] = tops[cell - layer] + grid.dz[cell - layer];
  }
  return tops;
}

}  // namespace

CornerPoints corner_points(const BlockCentredGrid& grid) {
  const auto [nx, ny, nz] = grid.dimensions;
  const std::vector<double> x = lines(grid, grid.dx, 0);
  const std::vector<double> y = lines(grid, grid.dy, 1);
  const std::vector<double> tops = complete_tops(grid);
  double least = tops.front();
  double most = tops.front() + grid.dz.front();
  CornerPoints out;
  out.zcorn.resize(8 * tops.size());
  for (std::size_t cell = 0; cell < tops.size(); ++cell) {
    const auto n = static_cast<std::int64_t>(cell);
    const std::int64_t i = n % nx, j = (n / nx) % ny, k = n / (nx * ny);
    least = std::min(least, tops[cell]);
    most = std::max(most, tops[cell] + grid.dz[cell]);
    for (int corner = 0; corner < 8; ++corner) {
      const std::int64_t at =
          (2 * i + (corner & 1)) + 2 * nx * ((2 * j + ((corner >> 1) & 1)) + 2 * ny * (2 * k + (corner >> 2)));
      out.zcorn[static_cast<std::size_t>(at)] = tops[cell] + (corner < 4 ? 0.0 : grid.dz[cell]);
    }
  }
  out.coord.reserve(6 * x.size() * y.size());
  for (const double yj : y)
    for (const double xi : x) out.coord.insert(out.coord.end(), {xi, yj, least, xi, yj, most});
  return out;
}

}  // namespace wellknit
