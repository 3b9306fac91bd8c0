// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Corner points of a grid given by cell sizes and tops (DX, DY, DZ, TOPS).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace wellknit {

/// Cell sizes and depths, nx ny nz each, in any unit of length. In tops only the first layer is needed: an unset value
/// (NaN) is the bottom of the cell above.
struct BlockCentredGrid {
  std::array<std::int64_t, 3> dimensions{};
  std::span<const double> dx, dy, dz, tops;
};

struct CornerPoints {
  std::vector<double> coord;  ///< vertical pillars from (0, 0), as CornerPointGrid
  std::vector<double> zcorn;
};

/// Every cell is a box with a flat top. Throws InvalidInput when a size is missing or not positive, or when DX varies
/// along j or k, or DY along i or k: such a grid has no pillars.
CornerPoints corner_points(const BlockCentredGrid& grid);

}  // namespace wellknit
