// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Which corner-point cell holds a point.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "algorithm/trilinear.h"
#include "model/corner_point_grid.h"
#include "model/ids.h"

namespace wellknit {

/// A point of a corner-point grid.
struct Location {
  HostCellId cell;
  Vec3 uvw = Vec3::Zero();  ///< in the cell's trilinear map, each in [0, 1]
};

/// Finds source cells, active or not, by their trilinear shape; cells without thickness hold nothing.
/// The grid must outlive the locator. locate() may be called from several threads.
class CellLocator {
 public:
  /// O(columns) memory and O(cells) time. The grid must pass validate().
  explicit CellLocator(const CornerPointGrid& grid);

  /// The cell that holds the point; the smallest id where several touch there. Nothing outside of the grid and in gaps
  /// between layers. `hint`: a cell to try first, and then its neighbours; it saves time and changes the result only
  /// where cells overlap.
  [[nodiscard]] std::optional<Location> locate(const Vec3& point, HostCellId hint = {}) const;

  /// (u, v, w) of the point in this cell when the cell holds it.
  [[nodiscard]] std::optional<Vec3> locate_in(HostCellId cell, const Vec3& point) const;

  /// Lowest and highest x, y, depth of all cells, a little widened.
  [[nodiscard]] std::array<Vec3, 2> bounds() const { return bounds_; }

 private:
  struct Box {
    Eigen::Vector2d low;
    Eigen::Vector2d high;
    double top;     ///< least depth
    double bottom;  ///< largest depth
  };

  [[nodiscard]] std::optional<Location> clearly_inside(HostCellId cell, const Vec3& point) const;
  [[nodiscard]] Box column_box(std::int64_t i, std::int64_t j) const;
  [[nodiscard]] std::size_t bin_of(double value, int axis) const;
  void fill_bins();
  [[nodiscard]] std::span<const std::int64_t> columns_near(const Vec3& point) const;
  [[nodiscard]] std::optional<Location> search_by_cells(const Vec3& point) const;
  [[nodiscard]] std::optional<Location> search_by_pillars(const Vec3& point) const;
  [[nodiscard]] std::optional<Location> in_column_by_pillars(std::int64_t column, const Vec3& point) const;
  [[nodiscard]] std::array<double, 2> depth_range(std::array<std::int64_t, 3> cell) const;

  const CornerPointGrid& grid_;
  std::vector<Box> column_boxes_;  ///< nx ny
  std::array<Vec3, 2> bounds_;
  Eigen::Vector2d origin_;    ///< of the bins, m
  Eigen::Vector2d bin_size_;  ///< m
  std::array<std::size_t, 2> bins_{1, 1};
  std::vector<std::size_t> bin_start_;     ///< offsets into bin_columns_
  std::vector<std::int64_t> bin_columns_;  ///< columns i + nx j, rising within a bin
};

}  // namespace wellknit
