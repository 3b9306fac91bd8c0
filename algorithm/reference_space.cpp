// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/reference_space.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

using SourceCell = std::array<std::int64_t, 3>;

/// The source cells whose edges along an axis set the spacing of slab `index`.
std::vector<SourceCell> cells_of_slab(const CellRange& region, const std::vector<SourceCell>& path, int axis,
                                      std::int64_t index) {
  const auto a = static_cast<std::size_t>(axis);
  std::vector<SourceCell> out;
  CellRange slab = region;
  slab.low[a] = index;
  slab.high[a] = index + 1;
  const auto add = [&](const CellRange& cells) {
    for (std::int64_t k = cells.low[2]; k < cells.high[2]; ++k)
      for (std::int64_t j = cells.low[1]; j < cells.high[1]; ++j)
        for (std::int64_t i = cells.low[0]; i < cells.high[0]; ++i) out.push_back({i, j, k});
  };
  if (path.empty()) {
    add(slab);
    return out;
  }
  std::int64_t nearest = std::numeric_limits<std::int64_t>::max();
  for (const SourceCell& c : path) nearest = std::min(nearest, std::abs(c[a] - index));
  for (const SourceCell& c : path) {
    if (std::abs(c[a] - index) > nearest) continue;
    CellRange around = slab;
    for (std::size_t b = 0; b < 3; ++b) {
      if (b == a) continue;
      around.low[b] = std::max(slab.low[b], c[b] - 1);
      around.high[b] = std::min(slab.high[b], c[b] + 2);
    }
    add(around);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// Mean edge length along an axis over the cells that exist, else over all. 0 without cells.
double mean_spacing(const NearWellGrid& near, const std::vector<SourceCell>& cells, int axis) {
  const HostMesh& host = near.host();
  std::array<double, 2> sum{};
  std::array<std::int64_t, 2> count{};
  for (const SourceCell& c : cells) {
    const HostCellId cell = near.source().cell_id(c[0], c[1], host.corners.layer(c[2]));
    const double length = mean_edge(near.source().corners(cell), axis);
    for (const std::size_t n : {std::size_t{0}, std::size_t{1}}) {
      if (n == 0 && host.exists[cell] == 0) continue;
      sum[n] += length;
      ++count[n];
    }
  }
  const std::size_t n = sum[0] > 0.0 ? 0 : 1;
  return count[n] > 0 ? sum[n] / static_cast<double>(count[n]) : 0.0;
}

/// Of the planes of an axis: those of the source, split and merged as the grid's cells are.
std::vector<double> spacings(const NearWellGrid& near, const CellRange& region, const std::vector<SourceCell>& path,
                             int axis) {
  const auto a = static_cast<std::size_t>(axis);
  std::vector<double> source;
  for (std::int64_t index = 0; index < near.source().dimensions[a]; ++index)
    source.push_back(mean_spacing(near, cells_of_slab(region, path, axis, index), axis));
  std::vector<double> out;
  if (axis < 2) {
    for (const double s : source)
      out.insert(out.end(), static_cast<std::size_t>(near.parts()[a]), s / static_cast<double>(near.parts()[a]));
  } else {
    for (const ColumnLayers::Cell& c : near.layers().cells) {
      double s = 0.0;
      for (std::int64_t p = c.upper.place; p <= c.lower.place; ++p)
        s += source[static_cast<std::size_t>(p)] *
             ((p == c.lower.place ? c.lower.fraction : 1.0) - (p == c.upper.place ? c.upper.fraction : 0.0));
      out.push_back(s);
    }
  }
  for (double& s : out) s = on_reference_lattice(s);
  return out;
}

}  // namespace

double on_reference_lattice(double value) { return std::round(value / reference_resolution) * reference_resolution; }

ReferenceSpace::ReferenceSpace(const NearWellGrid& grid, const CellRange& region,
                               const std::vector<std::array<std::int64_t, 3>>& path) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const std::vector<double> spacing = spacings(grid, region, path, axis);
    const auto n = static_cast<std::int64_t>(spacing.size());
    // The origin lies in the middle of the region: coordinates stay small where precision matters.
    std::int64_t middle = (region.low[a] + region.high[a]) / 2;
    middle = axis < 2 ? middle * grid.parts()[a] : std::min(middle, n);
    auto& planes = planes_[a];
    planes.assign(static_cast<std::size_t>(n) + 1, 0.0);
    const double sign = grid.left_handed() && axis == 1 ? -1.0 : 1.0;
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
