// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/reference_space.h"

#include <algorithm>
#include <cmath>

namespace wellknit {

namespace {

/// Mean length of the four edges of a cell along an axis.
double mean_edge(const std::array<Vec3, 8>& corners, int axis) {
  const auto step = static_cast<std::size_t>(1 << axis);
  double sum = 0.0;
  for (std::size_t c = 0; c < 8; ++c)
    if ((c & step) == 0) sum += (corners[c + step] - corners[c]).norm();
  return sum / 4.0;
}

/// Mean spacing of slab `index` of an axis over the cells of the region; only_existing: over those alone. 0 when there
/// is none.
double mean_spacing(const CornerPointGrid& grid, const HostMesh& host, const CellRange& region, int axis,
                    std::int64_t index, bool only_existing) {
  CellRange slab = region;
  const auto a = static_cast<std::size_t>(axis);
  slab.low[a] = index;
  slab.high[a] = index + 1;
  double sum = 0.0;
  std::int64_t count = 0;
  for (std::int64_t k = slab.low[2]; k < slab.high[2]; ++k)
    for (std::int64_t j = slab.low[1]; j < slab.high[1]; ++j)
      for (std::int64_t i = slab.low[0]; i < slab.high[0]; ++i) {
        const HostCellId cell = grid.cell_id(i, j, k);
        if (only_existing && host.exists[cell] == 0) continue;
        sum += mean_edge(grid.corners(cell), axis);
        ++count;
      }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

}  // namespace

double on_reference_lattice(double value) { return std::round(value / reference_resolution) * reference_resolution; }

ReferenceSpace::ReferenceSpace(const CornerPointGrid& grid, const HostMesh& host, const CellRange& region) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const std::int64_t n = grid.dimensions[a];
    std::vector<double> spacing(static_cast<std::size_t>(n));
    for (std::int64_t index = 0; index < n; ++index) {
      double s = mean_spacing(grid, host, region, axis, index, true);
      if (s <= 0.0) s = mean_spacing(grid, host, region, axis, index, false);
      spacing[static_cast<std::size_t>(index)] = on_reference_lattice(s);
    }
    // The origin lies in the middle of the region: coordinates stay small where precision matters.
    const std::int64_t middle = (region.low[a] + region.high[a]) / 2;
    auto& planes = planes_[a];
    planes.assign(static_cast<std::size_t>(n) + 1, 0.0);
    const double sign = host.left_handed && axis == 1 ? -1.0 : 1.0;
    for (std::int64_t i = middle; i < n; ++i)
      planes[static_cast<std::size_t>(i) + 1] =
          planes[static_cast<std::size_t>(i)] + sign * spacing[static_cast<std::size_t>(i)];
    for (std::int64_t i = middle; i > 0; --i)
      planes[static_cast<std::size_t>(i) - 1] =
          planes[static_cast<std::size_t>(i)] - sign * spacing[static_cast<std::size_t>(i) - 1];
  }
}

Box ReferenceSpace::box(const std::array<std::int64_t, 3>& cell) const {
  const Vec3 a = node(cell[0], cell[1], cell[2]);
  const Vec3 b = node(cell[0] + 1, cell[1] + 1, cell[2] + 1);
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

Vec3 ReferenceSpace::map(const std::array<std::int64_t, 3>& cell, const Vec3& uvw) const {
  const Vec3 a = node(cell[0], cell[1], cell[2]);
  const Vec3 b = node(cell[0] + 1, cell[1] + 1, cell[2] + 1);
  return a + uvw.cwiseProduct(b - a);
}

std::pair<std::int64_t, double> ReferenceSpace::place(int axis, double coordinate) const {
  const auto& planes = planes_[static_cast<std::size_t>(axis)];
  const bool rising = planes.back() >= planes.front();
  const auto before = [rising](double a, double b) { return rising ? a < b : a > b; };
  const auto upper = std::upper_bound(planes.begin(), planes.end(), coordinate, before);
  const auto n = static_cast<std::int64_t>(planes.size()) - 1;
  const std::int64_t index = std::clamp<std::int64_t>(std::distance(planes.begin(), upper) - 1, 0, n - 1);
  const auto i = static_cast<std::size_t>(index);
  const double width = planes[i + 1] - planes[i];
  return {index, width != 0.0 ? (coordinate - planes[i]) / width : 0.0};
}

}  // namespace wellknit
