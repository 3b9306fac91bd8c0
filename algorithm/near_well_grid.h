// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The host near a well as the near-well mesh sees it: its columns split along i and j into equal parts, its layers
/// merged where they are too thin and split where they are too thick (method.md §2). Nothing is stored for its cells:
/// they are computed from the source's columns when asked for, so that any fineness costs nothing. What a cavity takes
/// or touches of it is made by refine_host() afterwards.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "algorithm/cell_locator.h"
#include "algorithm/host_refinement.h"

namespace wellknit {

/// A cell (I, J, K) of a NearWellGrid; K counts downwards. Also a node: the upper low corner of a cell.
using NearWellCell = std::array<std::int64_t, 3>;

struct NearWellLocation {
  NearWellCell cell{};
  Vec3 uvw = Vec3::Zero();
  HostCellId source;  ///< to be given as the next search's hint
};

class NearWellGrid {
 public:
  /// All arguments must outlive it. `parts`: of each source column along i and j, powers of two.
  NearWellGrid(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator, LatticePoint parts,
               ColumnLayers layers);

  [[nodiscard]] const std::array<std::int64_t, 3>& dimensions() const { return dimensions_; }
  [[nodiscard]] const LatticePoint& parts() const { return parts_; }
  [[nodiscard]] const ColumnLayers& layers() const { return layers_; }
  [[nodiscard]] const CornerPointGrid& source() const { return grid_; }
  [[nodiscard]] const HostMesh& host() const { return host_; }
  /// I, J, K make a left-handed triple.
  [[nodiscard]] bool left_handed() const { return host_.left_handed != host_.corners.upside_down; }
  /// Neither split nor merged: its cells are the source's.
  [[nodiscard]] bool is_source() const { return is_source_; }

  [[nodiscard]] bool is_inside(const NearWellCell& c) const {
    return c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && c[0] < dimensions_[0] && c[1] < dimensions_[1] &&
           c[2] < dimensions_[2];
  }
  [[nodiscard]] std::int64_t index(const NearWellCell& c) const {
    return c[0] + dimensions_[0] * (c[1] + dimensions_[1] * c[2]);
  }
  [[nodiscard]] std::array<std::int64_t, 2> source_column(const NearWellCell& c) const {
    return {c[0] / parts_[0], c[1] / parts_[1]};
  }
  /// The source cell of the middle of its height.
  [[nodiscard]] HostCellId source_cell(const NearWellCell& c) const;
  /// A part of it is an existing cell.
  [[nodiscard]] bool exists(const NearWellCell& c) const;

  /// Corner di + 2 dj + 4 dk.
  [[nodiscard]] Vec3 corner(const NearWellCell& c, int corner) const;
  [[nodiscard]] double corner_depth(const NearWellCell& c, int corner) const;
  /// Least distance of base and top at the four corners, m.
  [[nodiscard]] double least_thickness(const NearWellCell& c) const;

  /// Both cells at this side (low and high I, J, K: 0 … 5) see the same corners there: no throw, no gap. False at the
  /// grid's outside.
  [[nodiscard]] bool is_glued(const NearWellCell& c, int side) const;

  [[nodiscard]] std::optional<NearWellLocation> locate(const Vec3& point, HostCellId hint = {}) const;

 private:
  [[nodiscard]] const ColumnLevel& level(std::int64_t k, int lower) const {
    const auto& cell = layers_.cells[static_cast<std::size_t>(k)];
    return lower == 0 ? cell.upper : cell.lower;
  }
  [[nodiscard]] NearWellLocation in_layers(HostCellId cell, const Vec3& uvw) const;

  const CornerPointGrid& grid_;
  const HostMesh& host_;
  const CellLocator& locator_;
  LatticePoint parts_;
  ColumnLayers layers_;
  bool is_source_ = false;
  std::array<std::int64_t, 3> dimensions_{};
};

/// A source column and the depths between which a cavity may stand in it, m.
struct ColumnWindow {
  std::array<std::int64_t, 2> column{};
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  double thickest = std::numeric_limits<double>::infinity();  ///< that a layer between these depths may be
};

/// The layers for wells in these windows: each at least `least` thick everywhere there and no less than a tenth of its
/// mean (thinner ones are merged with the next); one that is thicker than a window that it reaches into asks for is
/// split.
ColumnLayers layers_for(const CornerPointGrid& grid, const HostMesh& host, const std::vector<ColumnWindow>& windows,
                        double least);

}  // namespace wellknit
