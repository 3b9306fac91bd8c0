// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Columns are found by their boxes in plan, kept in a uniform grid of bins; cells of a column by their range of depth;
// the decision is the inverse of the trilinear map. Two columns along a fault share the pillars but not the corners, so
// between pillars that are not parallel their bilinear faces part a little. A point that no cell holds is therefore
// looked up a second time between the surfaces that the pillars span at constant depth, which leave no gap between
// columns.

#include "algorithm/cell_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wellknit {

namespace {

/// Relative part of the slack in (u, v, w): far above the rounding of Newton's iteration, far below any length that
/// matters.
constexpr double relative_slack = 1e-9;
/// Cells thinner than this on all four pillars hold nothing, m. The pillars' merge tolerance.
constexpr double least_thickness = 1e-6;
/// How far outside of [0, 1] a point may be that only the pillars' surfaces give to a cell.
constexpr double pillar_surface_slack = 0.1;

/// Rounding of the coordinates as a part of the cell's extent along each of its axes, plus the relative slack.
Vec3 slack_of(const std::array<Vec3, 8>& c) {
  double magnitude = 0.0;
  for (const Vec3& corner : c) magnitude = std::max(magnitude, corner.cwiseAbs().maxCoeff());
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * magnitude;
  Vec3 slack;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t step = std::size_t{1} << static_cast<unsigned>(axis);
    double longest = 0.0;
    for (std::size_t corner = 0; corner < 8; ++corner)
      if ((corner & step) == 0) longest = std::max(longest, (c[corner + step] - c[corner]).norm());
    slack[axis] = relative_slack + (longest > 0.0 ? rounding / longest : 0.0);
  }
  return slack;
}

/// Outside of the box around the corners by more than any slack: no need to invert the map.
bool is_far(const std::array<Vec3, 8>& corners, const Vec3& point) {
  Vec3 low = corners[0];
  Vec3 high = corners[0];
  for (const Vec3& corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const double margin = 0.1 * (high - low).maxCoeff();
  return (point.array() < low.array() - margin).any() || (point.array() > high.array() + margin).any();
}

double bilinear(const std::array<double, 4>& values, double u, double v) {
  return (1 - v) * ((1 - u) * values[0] + u * values[1]) + v * ((1 - u) * values[2] + u * values[3]);
}

}  // namespace

CellLocator::CellLocator(const CornerPointGrid& grid) : grid_(grid) {
  const auto [nx, ny, nz] = grid.dimensions;
  column_boxes_.reserve(static_cast<std::size_t>(nx * ny));
  Eigen::Vector2d high = Eigen::Vector2d::Constant(std::numeric_limits<double>::lowest());
  origin_ = -high;
  for (std::int64_t j = 0; j < ny; ++j) {
    for (std::int64_t i = 0; i < nx; ++i) {
      column_boxes_.push_back(column_box(i, j));
      origin_ = origin_.cwiseMin(column_boxes_.back().low);
      high = high.cwiseMax(column_boxes_.back().high);
    }
  }
  bounds_ = {Vec3(origin_[0], origin_[1], column_boxes_.front().top),
             Vec3(high[0], high[1], column_boxes_.front().bottom)};
  for (const Box& box : column_boxes_) {
    bounds_[0][2] = std::min(bounds_[0][2], box.top - least_thickness);
    bounds_[1][2] = std::max(bounds_[1][2], box.bottom + least_thickness);
  }
  bins_ = {static_cast<std::size_t>(nx), static_cast<std::size_t>(ny)};
  for (int axis = 0; axis < 2; ++axis) {
    const double size = (high[axis] - origin_[axis]) / static_cast<double>(bins_[static_cast<std::size_t>(axis)]);
    bin_size_[axis] = size > 0.0 ? size : 1.0;
  }
  fill_bins();
}

std::array<double, 2> CellLocator::depth_range(std::array<std::int64_t, 3> cell) const {
  const double* z = grid_.zcorn.data() + grid_.zcorn_index(cell, 0, 0, 0);
  const std::int64_t row = 2 * grid_.dimensions[0];
  const std::int64_t layer = 2 * row * grid_.dimensions[1];
  double low = z[0];
  double high = z[0];
  for (const std::int64_t at : {std::int64_t{1}, row, row + 1, layer, layer + 1, layer + row, layer + row + 1}) {
    low = std::min(low, z[at]);
    high = std::max(high, z[at]);
  }
  return {low, high};
}

CellLocator::Box CellLocator::column_box(std::int64_t i, std::int64_t j) const {
  Box box;
  box.top = std::numeric_limits<double>::max();
  box.bottom = std::numeric_limits<double>::lowest();
  for (std::int64_t k = 0; k < grid_.dimensions[2]; ++k) {
    const auto range = depth_range({i, j, k});
    box.top = std::min(box.top, range[0]);
    box.bottom = std::max(box.bottom, range[1]);
  }
  box.low = Eigen::Vector2d::Constant(std::numeric_limits<double>::max());
  box.high = -box.low;
  for (int corner = 0; corner < 4; ++corner) {
    for (const double depth : {box.top, box.bottom}) {  // pillars are straight: their extremes are at the ends
      const Vec3 p = grid_.pillar_point(i + (corner & 1), j + (corner >> 1), depth);
      box.low = box.low.cwiseMin(p.head<2>());
      box.high = box.high.cwiseMax(p.head<2>());
    }
  }
  const Eigen::Vector2d margin = 1e-9 * (box.high - box.low) + Eigen::Vector2d::Constant(1e-6);
  box.low -= margin;
  box.high += margin;
  return box;
}

std::size_t CellLocator::bin_of(double value, int axis) const {
  const double bin = std::floor((value - origin_[axis]) / bin_size_[axis]);
  const auto last = static_cast<double>(bins_[static_cast<std::size_t>(axis)] - 1);
  return static_cast<std::size_t>(std::clamp(bin, 0.0, last));
}

void CellLocator::fill_bins() {
  const auto for_bins_of = [&](const Box& box, const auto& visit) {
    for (std::size_t y = bin_of(box.low[1], 1); y <= bin_of(box.high[1], 1); ++y)
      for (std::size_t x = bin_of(box.low[0], 0); x <= bin_of(box.high[0], 0); ++x) visit(x + bins_[0] * y);
  };
  bin_start_.assign(bins_[0] * bins_[1] + 1, 0);
  for (const Box& box : column_boxes_) for_bins_of(box, [&](std::size_t bin) { ++bin_start_[bin + 1]; });
  for (std::size_t bin = 1; bin < bin_start_.size(); ++bin) bin_start_[bin] += bin_start_[bin - 1];
  bin_columns_.resize(bin_start_.back());
  std::vector<std::size_t> next(bin_start_.begin(), bin_start_.end() - 1);
  for (std::size_t column = 0; column < column_boxes_.size(); ++column)
    for_bins_of(column_boxes_[column],
                [&](std::size_t bin) { bin_columns_[next[bin]++] = static_cast<std::int64_t>(column); });
}

std::span<const std::int64_t> CellLocator::columns_near(const Vec3& point) const {
  const std::size_t bin = bin_of(point[0], 0) + bins_[0] * bin_of(point[1], 1);
  return {bin_columns_.data() + bin_start_[bin], bin_start_[bin + 1] - bin_start_[bin]};
}

std::optional<Vec3> CellLocator::locate_in(HostCellId cell, const Vec3& point) const {
  const auto corners = grid_.corners(cell);
  double thickness = 0.0;
  for (std::size_t c = 0; c < 4; ++c) thickness = std::max(thickness, std::abs(corners[c + 4][2] - corners[c][2]));
  if (thickness <= least_thickness) return std::nullopt;
  if (is_far(corners, point)) return std::nullopt;
  const auto uvw = inverse_trilinear(corners, point);
  if (!uvw) return std::nullopt;
  const Vec3 slack = slack_of(corners);
  for (int axis = 0; axis < 3; ++axis)
    if ((*uvw)[axis] < -slack[axis] || (*uvw)[axis] > 1.0 + slack[axis]) return std::nullopt;
  return Vec3(uvw->cwiseMax(0.0).cwiseMin(1.0));
}

/// The point in this cell, unless it is so near a face that the neighbour may hold it too and have the smaller id.
std::optional<Location> CellLocator::clearly_inside(HostCellId cell, const Vec3& point) const {
  constexpr double clear = 1e-6;
  const auto uvw = locate_in(cell, point);
  if (!uvw || uvw->minCoeff() <= clear || uvw->maxCoeff() >= 1.0 - clear) return std::nullopt;
  return Location{cell, *uvw};
}

std::optional<Location> CellLocator::locate(const Vec3& point, HostCellId hint) const {
  if (!point.allFinite()) return std::nullopt;
  if (hint.is_valid()) {
    if (auto found = clearly_inside(hint, point)) return found;
    // The next point asked for is often just across a face.
    const auto at = grid_.ijk(hint);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const std::int64_t step : {-1, 1}) {
        auto next = at;
        next[axis] += step;
        if (next[axis] < 0 || next[axis] >= grid_.dimensions[axis]) continue;
        if (auto found = clearly_inside(grid_.cell_id(next[0], next[1], next[2]), point)) return found;
      }
  }
  if (auto found = search_by_cells(point)) return found;
  return search_by_pillars(point);
}

std::optional<Location> CellLocator::search_by_cells(const Vec3& point) const {
  const auto [nx, ny, nz] = grid_.dimensions;
  std::optional<Location> best;
  for (const std::int64_t column : columns_near(point)) {
    const Box& box = column_boxes_[static_cast<std::size_t>(column)];
    if ((point.head<2>().array() < box.low.array()).any() || (point.head<2>().array() > box.high.array()).any())
      continue;
    if (point[2] < box.top - least_thickness || point[2] > box.bottom + least_thickness) continue;
    for (std::int64_t k = 0; k < nz; ++k) {
      const auto cell = grid_.cell_id(column % nx, column / nx, k);
      if (best && best->cell < cell) break;
      const auto range = depth_range({column % nx, column / nx, k});
      if (point[2] < range[0] - least_thickness || point[2] > range[1] + least_thickness) continue;
      if (const auto uvw = locate_in(cell, point)) {
        best = Location{cell, *uvw};
        break;
      }
    }
  }
  return best;
}

std::optional<Location> CellLocator::search_by_pillars(const Vec3& point) const {
  for (const std::int64_t column : columns_near(point)) {
    const Box& box = column_boxes_[static_cast<std::size_t>(column)];
    if ((point.head<2>().array() < box.low.array()).any() || (point.head<2>().array() > box.high.array()).any())
      continue;
    if (point[2] < box.top || point[2] > box.bottom) continue;
    if (auto found = in_column_by_pillars(column, point)) return found;
  }
  return std::nullopt;
}

std::optional<Location> CellLocator::in_column_by_pillars(std::int64_t column, const Vec3& point) const {
  const std::int64_t i = column % grid_.dimensions[0];
  const std::int64_t j = column / grid_.dimensions[0];
  const Box& box = column_boxes_[static_cast<std::size_t>(column)];
  // With level ends the trilinear map is bilinear at every depth: exactly the pillars' surfaces.
  std::array<Vec3, 8> prism;
  for (std::size_t c = 0; c < 8; ++c) {
    const auto at = static_cast<std::int64_t>(c);
    prism[c] = grid_.pillar_point(i + (at & 1), j + ((at >> 1) & 1), c < 4 ? box.top : box.bottom);
  }
  const auto place = inverse_trilinear(prism, point);
  if (!place || place->minCoeff() < -relative_slack || place->maxCoeff() > 1.0 + relative_slack) return std::nullopt;
  for (std::int64_t k = 0; k < grid_.dimensions[2]; ++k) {
    const auto corners = grid_.corners(grid_.cell_id(i, j, k));
    const double top = bilinear({corners[0][2], corners[1][2], corners[2][2], corners[3][2]}, (*place)[0], (*place)[1]);
    const double bottom =
        bilinear({corners[4][2], corners[5][2], corners[6][2], corners[7][2]}, (*place)[0], (*place)[1]);
    if (bottom - top <= least_thickness || point[2] < top || point[2] > bottom) continue;
    const auto uvw = inverse_trilinear(corners, point);
    if (!uvw || uvw->minCoeff() < -pillar_surface_slack || uvw->maxCoeff() > 1.0 + pillar_surface_slack) continue;
    return Location{grid_.cell_id(i, j, k), uvw->cwiseMax(0.0).cwiseMin(1.0)};
  }
  return std::nullopt;
}

}  // namespace wellknit
