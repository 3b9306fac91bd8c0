// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// PINCH as the ECLIPSE manual has it and OPM Flow computes it: the transmissibility goes through the base of the upper
// cell (TOPBOT), or through all cells in between as well (ALL). Neighbours in a column with a void between them are
// connected without PINCH too; its item 3 is the largest void that is still crossed. So does OPM Flow since
// opm-grid's pull request 658 of 2023 (opm-tests, pinch/T2A_NOPINCH, T2A_GAP, T2A1_GAP); 2022.10 connects nothing
// there.

#include "algorithm/pinch_connections.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

/// PINCH or PINCHOUT: cells that are not there are bridged.
bool has_bridges(const CornerPointGrid& grid) {
  return grid.connects_across_pinch || grid.edits.pinch || grid.edits.pinchout;
}

class ColumnPinches {
 public:
  ColumnPinches(const CornerPointGrid& grid, const HostMesh& host, const HostMultipliers& multipliers,
                std::vector<PinchConnection>& out)
      : grid_(grid),
        host_(host),
        multipliers_(multipliers),
        options_(options_of(grid.edits)),
        bridges_(has_bridges(grid)),
        out_(out) {}

  void column(std::int64_t i, std::int64_t j) {
    HostCellId upper;
    between_.clear();
    for (std::int64_t k = 0; k < grid_.dimensions[2]; ++k) {
      const HostCellId cell = grid_.cell_id(i, j, k);
      if (host_.exists[cell] != 0) {
        if (upper.is_valid()) connect(upper, cell);
        upper = cell;
        between_.clear();
      } else if (upper.is_valid() && bridges_ && is_bridged(cell)) {
        between_.push_back(cell);
      } else {
        upper = {};
      }
    }
  }

 private:
  using Depths = std::array<double, 4>;

  /// Without PINCH any gap is crossed, and PINCHOUT bridges nothing that has thickness.
  static PinchOptions options_of(const ConnectionEdits& edits) {
    if (edits.pinch) return *edits.pinch;
    PinchOptions options;
    options.threshold = 0.0;
    options.across_gaps = false;
    options.largest_gap = std::numeric_limits<double>::infinity();
    return options;
  }

  [[nodiscard]] bool is_bridged(HostCellId cell) const {
    const double thickness = thickness_of(grid_, cell);
    if (thickness <= pillar_merge_tolerance) return true;
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
    if (gap_between(upper, lower) > options_.largest_gap) return;
    const double multiplier = multiplier_of(upper, lower);
    const double t = transmissibility(upper, lower);
    if (t > 0.0) out_.push_back({upper, lower, multiplier * t, multiplier});
  }

  /// The void between two cells where it is least, without the cells that are bridged, m.
  [[nodiscard]] double gap_between(HostCellId upper, HostCellId lower) const {
    Depths gap = difference(depths_of(lower, false), depths_of(upper, true));
    const double sign = gap[0] + gap[1] + gap[2] + gap[3] < 0.0 ? -1.0 : 1.0;  // -1: layers are numbered upwards
    for (const HostCellId c : between_) gap = difference(gap, difference(depths_of(c, true), depths_of(c, false)));
    double least = sign * gap[0];
    for (const double g : gap) least = std::min(least, sign * g);
    return std::max(least, 0.0);
  }

  static Depths difference(const Depths& a, const Depths& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]};
  }

  [[nodiscard]] Depths depths_of(HostCellId cell, bool high_side) const {
    const auto at = grid_.ijk(cell);
    Depths out{};
    for (int c = 0; c < 4; ++c)
      out[static_cast<std::size_t>(c)] = grid_.zcorn[grid_.zcorn_index(at, c & 1, c >> 1, high_side ? 1 : 0)];
    return out;
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
    const double t1 = host_half_transmissibility(grid_, host_, upper, Axis::k, area);
    const double t2 = host_half_transmissibility(grid_, host_, lower, Axis::k, area);
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
  bool bridges_;
  std::vector<PinchConnection>& out_;
  std::vector<HostCellId> between_;
};

/// Marks the columns of row j that have a gap or, where cells are bridged, a cell that does not exist. Few have: all
/// others are passed over in the order in which depths are stored.
std::vector<std::uint8_t> columns_to_look_at(const CornerPointGrid& grid, const HostMesh& host, std::int64_t j) {
  const auto [nx, ny, nz] = grid.dimensions;
  std::vector<std::uint8_t> marks(static_cast<std::size_t>(nx));
  for (std::int64_t k = 0; k < nz; ++k) {
    if (has_bridges(grid))
      for (std::int64_t i = 0; i < nx; ++i)
        if (host.exists[grid.cell_id(i, j, k)] == 0) marks[static_cast<std::size_t>(i)] = 1;
    for (int dj = 0; dj < 2 && k + 1 < nz; ++dj) {
      const double* base = &grid.zcorn[grid.zcorn_index({0, j, k}, 0, dj, 1)];
      const double* top = &grid.zcorn[grid.zcorn_index({0, j, k + 1}, 0, dj, 0)];
      if (std::equal(base, base + 2 * nx, top)) continue;
      for (std::int64_t n = 0; n < 2 * nx; ++n)
        if (base[n] != top[n]) marks[static_cast<std::size_t>(n / 2)] = 1;
    }
  }
  return marks;
}

}  // namespace

std::vector<PinchConnection> pinch_connections(const CornerPointGrid& grid, const HostMesh& host,
                                               const HostMultipliers& multipliers) {
  std::vector<PinchConnection> out;
  if (grid.permeability[2].empty()) return out;
  std::vector<std::vector<PinchConnection>> rows(static_cast<std::size_t>(grid.dimensions[1]));
  tbb::parallel_for(std::int64_t{0}, grid.dimensions[1], [&](std::int64_t j) {
    ColumnPinches pinches(grid, host, multipliers, rows[static_cast<std::size_t>(j)]);
    const auto marks = columns_to_look_at(grid, host, j);
    for (std::int64_t i = 0; i < grid.dimensions[0]; ++i)
      if (marks[static_cast<std::size_t>(i)] != 0) pinches.column(i, j);
  });
  for (const auto& row : rows) out.insert(out.end(), row.begin(), row.end());
  return out;
}

}  // namespace wellknit
