// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// PINCH as the ECLIPSE manual has it and OPM Flow computes it: the transmissibility goes through the base of the upper
// cell (TOPBOT), or through all cells in between as well (ALL).

#include "algorithm/pinch_connections.h"

#include <algorithm>
#include <cmath>

#include "algorithm/host_transmissibility.h"
#include "algorithm/source_pore_volume.h"

namespace wellknit {

namespace {

/// Mean depth of a cell's side towards smaller or larger k, m.
double side_depth(const CornerPointGrid& grid, HostCellId cell, bool high_side) {
  const auto corners = grid.corners(cell);
  double sum = 0.0;
  for (std::size_t n = 0; n < 4; ++n) sum += corners[n + (high_side ? 4 : 0)].z();
  return sum / 4.0;
}

/// Mean thickness, m.
double thickness_of(const CornerPointGrid& grid, HostCellId cell) {
  return std::abs(side_depth(grid, cell, true) - side_depth(grid, cell, false));
}

Vec3 area_of_side(const CornerPointGrid& grid, HostCellId cell, bool high_side) {
  const auto corners = grid.corners(cell);
  const std::size_t first = high_side ? 4 : 0;
  return 0.5 * (corners[first + 3] - corners[first]).cross(corners[first + 2] - corners[first + 1]);
}

class ColumnPinches {
 public:
  ColumnPinches(const CornerPointGrid& grid, const HostMesh& host, const HostMultipliers& multipliers,
                std::vector<PinchConnection>& out)
      : grid_(grid), host_(host), multipliers_(multipliers), options_(*grid.edits.pinch), out_(out) {}

  void column(std::int64_t i, std::int64_t j) {
    HostCellId upper;
    between_.clear();
    for (std::int64_t k = 0; k < grid_.dimensions[2]; ++k) {
      const HostCellId cell = grid_.cell_id(i, j, k);
      if (host_.exists[cell] != 0) {
        if (upper.is_valid() && !between_.empty()) connect(upper, cell);
        upper = cell;
        between_.clear();
      } else if (upper.is_valid() && is_bridged(cell)) {
        between_.push_back(cell);
      } else {
        upper = {};
      }
    }
  }

 private:
  [[nodiscard]] bool is_bridged(HostCellId cell) const {
    const double thickness = thickness_of(grid_, cell);
    if (thickness == 0.0) return true;
    const bool is_active = grid_.active[cell.index()] != 0;
    const bool is_small = is_active && host_.pore_volume[cell] < least_pore_volume(grid_, cell);
    if (is_small && options_.across_gaps) return true;
    return (is_small || !is_active) && thickness <= options_.threshold;
  }

  void connect(HostCellId upper, HostCellId lower) {
    bool meet = true;
    for (int n = 0; n < 4; ++n)
      meet = meet && host_.corner(upper, n & 1, n >> 1, 1) == host_.corner(lower, n & 1, n >> 1, 0);
    if (meet) return;  // the host has a face for it
    double solid = 0.0;
    for (const HostCellId c : between_) solid += thickness_of(grid_, c);
    const double distance = std::abs(side_depth(grid_, lower, false) - side_depth(grid_, upper, true));
    if (distance - solid > options_.largest_gap) return;
    const double multiplier = multiplier_of(upper, lower);
    const double t = transmissibility(upper, lower);
    if (t > 0.0) out_.push_back({upper, lower, multiplier * t, multiplier});
  }

  [[nodiscard]] double multiplier_of(HostCellId upper, HostCellId lower) const {
    double highest = multipliers_.of_face(upper, FaceDirection::k_plus);
    if (options_.multiplier == PinchMultiplier::all)
      for (const HostCellId c : between_) highest = std::min(highest, multipliers_.of_face(c, FaceDirection::k_plus));
    return highest * multipliers_.of_face(lower, FaceDirection::k_minus) *
           multipliers_.of_regions(upper, lower, Axis::k);
  }

  [[nodiscard]] double transmissibility(HostCellId upper, HostCellId lower) const {
    const Vec3 area = area_of_side(grid_, upper, true);
    const double t1 = host_half_transmissibility(grid_, upper, Axis::k, area);
    const double t2 = host_half_transmissibility(grid_, lower, Axis::k, area);
    if (!(t1 > 0.0) || !(t2 > 0.0)) return 0.0;
    double resistance = 1.0 / t1 + 1.0 / t2;
    if (options_.transmissibility == PinchTransmissibility::all_layers)
      for (const HostCellId c : between_)
        if (const double thickness = thickness_of(grid_, c); thickness > 0.0)
          resistance += thickness / (grid_.permeability[2][c.index()] * area.norm());
    return std::isfinite(resistance) ? 1.0 / resistance : 0.0;
  }

  const CornerPointGrid& grid_;
  const HostMesh& host_;
  const HostMultipliers& multipliers_;
  PinchOptions options_;
  std::vector<PinchConnection>& out_;
  std::vector<HostCellId> between_;
};

}  // namespace

std::vector<PinchConnection> pinch_connections(const CornerPointGrid& grid, const HostMesh& host,
                                               const HostMultipliers& multipliers) {
  std::vector<PinchConnection> out;
  if (!grid.edits.pinch || grid.permeability[2].empty()) return out;
  ColumnPinches pinches(grid, host, multipliers, out);
  for (std::int64_t j = 0; j < grid.dimensions[1]; ++j)
    for (std::int64_t i = 0; i < grid.dimensions[0]; ++i) pinches.column(i, j);
  return out;
}

}  // namespace wellknit
