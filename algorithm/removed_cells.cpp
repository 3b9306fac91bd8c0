// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/removed_cells.h"

#include <algorithm>
#include <array>
#include <set>

namespace wellknit {

namespace {

using Cell = NearWellCell;

Cell neighbour(const Cell& c, int side) {
  Cell out = c;
  out[static_cast<std::size_t>(side / 2)] += side % 2 == 0 ? -1 : 1;
  return out;
}

/// Half the derivative of the squared distance to a box along p + t u: rises with t, linear between the places where
/// the line meets the planes of the box's sides.
double slope_to_box(const Box& box, const Vec3& p, const Vec3& u, double t) {
  const Vec3 x = p + t * u;
  return u.dot(x - x.cwiseMax(box.low).cwiseMin(box.high));
}

/// Least distance of a box to a segment: where the slope is 0.
double distance_to_segment(const Box& box, const Vec3& p, const Vec3& q) {
  const Vec3 u = q - p;
  double low = 0.0;
  double high = 1.0;
  double slope_low = slope_to_box(box, p, u, low);
  double slope_high = slope_to_box(box, p, u, high);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {box.low[axis], box.high[axis]}) {
      const double t = (side - p[axis]) / u[axis];  // not a number where they are parallel: no place between
      if (!(t > low && t < high)) continue;
      const double slope = slope_to_box(box, p, u, t);
      (slope < 0.0 ? low : high) = t;
      (slope < 0.0 ? slope_low : slope_high) = slope;
    }
  double t = low;
  if (slope_low < 0.0) t = slope_high <= 0.0 ? high : low + (high - low) * slope_low / (slope_low - slope_high);
  const Vec3 x = p + t * u;
  return (x - x.cwiseMax(box.low).cwiseMin(box.high)).norm();
}

/// Index range of the cells of an axis that meet [low, high].
std::array<std::int64_t, 2> cell_range(const ReferenceSpace& space, int axis, double low, double high) {
  const std::int64_t a = space.place(axis, low).first;
  const std::int64_t b = space.place(axis, high).first;
  return {std::min(a, b), std::max(a, b)};
}

/// All of a box lies before the plane through p normal to `along`.
bool is_before(const Box& box, const Vec3& p, const Vec3& along) {
  const Vec3 farthest = (along.array() > 0.0).select(box.high, box.low);
  return (farthest - p).dot(along) < 0.0;
}

/// Calls take(cell, box) for every cell that comes within a distance of a segment.
template <class Take>
void for_cells_along_segment(const HostFrame& frame, const Vec3& p, const Vec3& q, double radius, const Take& take) {
  std::array<std::array<std::int64_t, 2>, 3> range;
  for (int a = 0; a < 3; ++a)
    range[static_cast<std::size_t>(a)] =
        cell_range(frame.space, a, std::min(p[a], q[a]) - radius, std::max(p[a], q[a]) + radius);
  for (std::int64_t k = range[2][0]; k <= range[2][1]; ++k)
    for (std::int64_t j = range[1][0]; j <= range[1][1]; ++j)
      for (std::int64_t i = range[0][0]; i <= range[0][1]; ++i)
        if (const Box box = frame.space.box({i, j, k}); distance_to_segment(box, p, q) <= radius)
          take(Cell{i, j, k}, box);
}

/// Lateral size in E_ref of the cell at the middle of a tube's axis.
double lateral_cell(const HostFrame& frame, const Tube& tube) {
  const Vec3& at = tube.reference.axis[tube.reference.axis.size() / 2];
  double size = 0.0;
  for (const int axis : {0, 1}) {
    const std::int64_t n = frame.space.place(axis, at[axis]).first;
    size = std::max(size, std::abs(frame.space.plane(axis, n + 1) - frame.space.plane(axis, n)));
  }
  return size;
}

/// Whole columns that come within `reach` of a layered tube's axis, where nothing keeps a cell of them.
void remove_columns_around(const HostFrame& frame, const Tube& tube, double reach, RemovedCells& removed) {
  const auto& axis = tube.reference.axis;
  std::set<std::array<std::int64_t, 2>> columns;
  for (std::size_t k = 0; k + 1 < axis.size(); ++k) {
    std::array<std::array<std::int64_t, 2>, 2> range;
    for (int a = 0; a < 2; ++a)
      range[static_cast<std::size_t>(a)] = cell_range(frame.space, a, std::min(axis[k][a], axis[k + 1][a]) - reach,
                                                      std::max(axis[k][a], axis[k + 1][a]) + reach);
    for (std::int64_t j = range[1][0]; j <= range[1][1]; ++j)
      for (std::int64_t i = range[0][0]; i <= range[0][1]; ++i) {
        Box box = frame.space.box({i, j, 0});
        box.low.z() = std::min(axis[k].z(), axis[k + 1].z());
        box.high.z() = std::max(axis[k].z(), axis[k + 1].z());
        if (distance_to_segment(box, axis[k], axis[k + 1]) <= reach) columns.insert({i, j});
      }
  }
  const std::int64_t layers = frame.grid.dimensions()[2];
  const auto take = [&](std::int64_t i, std::int64_t j) {
    for (std::int64_t k = 0; k < layers; ++k)
      if (!removed.is_sound({i, j, k}) || (k + 1 < layers && !frame.grid.is_glued({i, j, k}, 5))) return false;
    for (std::int64_t k = 0; k < layers; ++k) removed.add_if_sound({i, j, k});
    return true;
  };
  std::vector<Cell> front = removed.list();
  std::erase_if(front, [](const Cell& c) { return c[2] != 0; });
  for (std::size_t n = 0; n < front.size(); ++n)
    for (int side = 0; side < 4; ++side) {
      const Cell c = neighbour(front[n], side);
      if (columns.contains({c[0], c[1]}) && !removed.contains(c) && take(c[0], c[1])) front.push_back(c);
    }
}

/// Layered cavities take whole columns: all their boundary faces are then lateral and their cells layered prisms.
void complete_columns(const NearWellGrid& grid, RemovedCells& removed) {
  for (const Cell& c : removed.list())
    for (std::int64_t k = 0; k < grid.dimensions()[2]; ++k) removed.add({c[0], c[1], k});
}

/// Where two removed cells touch along an edge only, the two others at the edge go too, so that the boundary is a
/// 2-manifold.
bool remove_touching_edges(RemovedCells& removed) {
  bool changed = false;
  for (const Cell& c : removed.list())
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3;
      for (const int sa : {-1, 1})
        for (const int sb : {-1, 1}) {
          Cell diagonal = c;
          diagonal[a] += sa;
          diagonal[b] += sb;
          if (!removed.contains(diagonal)) continue;
          Cell one = c;
          one[a] += sa;
          Cell two = c;
          two[b] += sb;
          if (removed.contains(one) || removed.contains(two)) continue;
          changed |= removed.add(one);
          changed |= removed.add(two);
        }
    }
  return changed;
}

}  // namespace

bool RemovedCells::add(const Cell& c) {
  if (!is_inside_grid(c) || contains(c)) return false;
  if (add_if_sound(c)) return true;
  if (!blocked_) blocked_ = c;
  return false;
}

bool RemovedCells::add_if_sound(const Cell& c) {
  if (!is_inside_grid(c) || contains(c) || !is_sound(c)) return false;
  cells_.insert(grid_.index(c));
  added_.push_back(grid_.index(c));
  return true;
}

bool RemovedCells::is_sound(const Cell& c) const {
  if (grid_.least_thickness(c) < least_cell_thickness) return false;
  for (int side = 0; side < 6; ++side)
    if (contains(neighbour(c, side)) && !grid_.is_glued(c, side)) return false;
  return true;
}

std::vector<Cell> RemovedCells::list() {
  std::sort(added_.begin(), added_.end());
  const auto middle = sorted_.insert(sorted_.end(), added_.begin(), added_.end());
  std::inplace_merge(sorted_.begin(), middle, sorted_.end());
  added_.clear();
  std::vector<Cell> cells;
  cells.reserve(sorted_.size());
  const auto& n = grid_.dimensions();
  for (const std::int64_t s : sorted_) cells.push_back({s % n[0], (s / n[0]) % n[1], s / (n[0] * n[1])});
  return cells;
}

void remove_cells_at_tube(const HostFrame& frame, const Tube& tube, RemovedCells& removed) {
  const double radius = tube.reference_radius * (1.0 + 1e-9);
  const auto& axis = tube.reference.axis;
  for (std::size_t k = 0; k + 1 < axis.size(); ++k) {
    const Vec3& p = axis[k];
    const Vec3& q = axis[k + 1];
    for_cells_along_segment(frame, p, q, radius, [&](const Cell& c, const Box& box) {
      const bool is_beyond = (k == 0 && is_before(box, p, q - p)) || (k + 2 == axis.size() && is_before(box, q, p - q));
      if (is_beyond)
        removed.add_if_sound(c);
      else
        removed.add(c);
    });
  }
}

double width_of_shell(const HostFrame& frame, const Tube& tube, int dilation) {
  return dilation * std::max(lateral_cell(frame, tube), 0.5 * tube.reference_radius);
}

// From the removed cells outwards, so that no cell beyond a fault is taken.
void remove_cells_around_tube(const HostFrame& frame, const Tube& tube, int dilation, bool in_columns,
                              RemovedCells& removed) {
  const double width = width_of_shell(frame, tube, dilation);
  if (width <= 0.0) return;
  const double reach = tube.reference_radius + width;
  const auto& axis = tube.reference.axis;
  if (in_columns) return remove_columns_around(frame, tube, reach, removed);
  std::unordered_set<std::int64_t> near;
  for (std::size_t k = 0; k + 1 < axis.size(); ++k)
    for_cells_along_segment(frame, axis[k], axis[k + 1], reach,
                            [&](const Cell& c, const Box&) { near.insert(frame.grid.index(c)); });
  std::vector<Cell> front = removed.list();
  for (std::size_t n = 0; n < front.size(); ++n)
    for (int side = 0; side < 6; ++side) {
      const Cell c = neighbour(front[n], side);
      if (removed.is_inside_grid(c) && near.contains(frame.grid.index(c)) && removed.add_if_sound(c))
        front.push_back(c);
    }
}

void make_closed(const NearWellGrid& grid, bool in_columns, RemovedCells& removed) {
  do {
    if (in_columns) complete_columns(grid, removed);
  } while (remove_touching_edges(removed));
}

}  // namespace wellknit
