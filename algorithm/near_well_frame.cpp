// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/near_well_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace wellknit {

namespace {

constexpr double swept_cell = 1.5;    ///< largest lateral size of a cell beside a swept tube, in drainage radii
constexpr double walled_cell = 1.0;   ///< the same where a fault is near: the cavity has a wall there
constexpr double layered_cell = 2.0;  ///< the same beside a layered one
constexpr double thickest = 1.5;      ///< layer beside a swept tube, in drainage radii
constexpr int most_levels = 10;       ///< of splitting a source column in two

bool is_within(const Piece& piece, double measured_depth) {
  if (piece.layered) return true;
  const double margin = 2.0 * piece.radius;
  return measured_depth >= piece.range.from - margin && measured_depth <= piece.range.to + margin;
}

/// Mean lateral size of the source cells around a piece, along i and j, m.
std::array<double, 2> cell_size(const WellTask& task, const CellRange& region) {
  std::array<double, 2> sum{};
  double count = 0.0;
  for (std::int64_t j = region.low[1]; j < region.high[1]; ++j)
    for (std::int64_t i = region.low[0]; i < region.high[0]; ++i) {
      const std::int64_t k = task.host.corners.layer((region.low[2] + region.high[2]) / 2);
      const auto c = task.grid.corners(task.grid.cell_id(i, j, k));
      sum[0] += 0.5 * ((c[1] - c[0]).norm() + (c[3] - c[2]).norm());
      sum[1] += 0.5 * ((c[2] - c[0]).norm() + (c[3] - c[1]).norm());
      count += 1.0;
    }
  return {sum[0] / count, sum[1] / count};
}

LatticePoint parts_for(const WellTask& task, const std::vector<Piece>& pieces, const CellRange& region) {
  if (task.options.refinement_levels == 0) return {1, 1};
  if (task.options.refinement_levels > 0)
    return {std::int64_t{1} << task.options.refinement_levels, std::int64_t{1} << task.options.refinement_levels};
  const auto size = cell_size(task, region);
  LatticePoint parts{1, 1};
  for (std::size_t a = 0; a < 2; ++a) {
    int levels = 0;
    for (const Piece& p : pieces) {
      const double most = (p.layered ? layered_cell : p.has_wall ? walled_cell : swept_cell) * p.radius;
      const int needed = size[a] > most ? static_cast<int>(std::ceil(std::log2(size[a] / most))) : 0;
      levels = std::max(levels, needed + p.extra_levels);
    }
    parts[a] = std::int64_t{1} << std::min(levels, most_levels);
  }
  return parts;
}

/// Source cells that the pieces run through, each once.
std::vector<std::array<std::int64_t, 3>> cells_on(const WellTask& task, const std::vector<Piece>& pieces) {
  std::set<std::array<std::int64_t, 3>> out;
  for (const Piece& piece : pieces)
    for (const PathCell& c : task.samples[piece.well].cells)
      if (is_within(piece, c.measured_depth)) out.insert(c.cell);
  return {out.begin(), out.end()};
}

CellRange region_of(const WellTask& task, const std::vector<Piece>& pieces) {
  constexpr std::int64_t around = 3;
  CellRange region{task.grid.dimensions, {0, 0, 0}};
  for (const Piece& piece : pieces)
    for (const PathCell& c : task.samples[piece.well].cells) {
      if (!is_within(piece, c.measured_depth)) continue;
      for (std::size_t a = 0; a < 3; ++a) {
        region.low[a] = std::min(region.low[a], std::max<std::int64_t>(0, c.cell[a] - around));
        region.high[a] = std::max(region.high[a], std::min(task.grid.dimensions[a], c.cell[a] + 1 + around));
      }
    }
  return region;
}

/// Of the column of a path's cell and those around it: where a cavity around this place may stand.
void widen_windows(const WellTask& task, const Piece& piece, const PathCell& at, double most,
                   std::map<std::array<std::int64_t, 2>, ColumnWindow>& windows) {
  constexpr double reach = 6.0;  // drainage radii
  const double infinity = std::numeric_limits<double>::infinity();
  const double low = piece.layered ? -infinity : at.depth - reach * piece.radius;
  const double high = piece.layered ? infinity : at.depth + reach * piece.radius;
  for (std::int64_t dj = -1; dj <= 1; ++dj)
    for (std::int64_t di = -1; di <= 1; ++di) {
      const std::array<std::int64_t, 2> column{at.cell[0] + di, at.cell[1] + dj};
      if (column[0] < 0 || column[1] < 0 || column[0] >= task.grid.dimensions[0] ||
          column[1] >= task.grid.dimensions[1])
        continue;
      const auto [entry, is_new] = windows.try_emplace(column, ColumnWindow{column, low, high, most});
      if (is_new) continue;
      entry->second.low = std::min(entry->second.low, low);
      entry->second.high = std::max(entry->second.high, high);
    }
}

}  // namespace

ColumnLayers layers_of(const WellTask& task, const std::vector<Piece>& pieces) {
  double widest = 0.0;
  for (const Piece& p : pieces) widest = std::max(widest, p.radius);
  std::vector<ColumnWindow> all;
  for (const Piece& piece : pieces) {
    const bool is_split = !piece.layered && task.options.refinement_levels != 0;
    const double most =
        is_split ? thickest * std::max(piece.radius, 0.25 * widest) : std::numeric_limits<double>::infinity();
    std::map<std::array<std::int64_t, 2>, ColumnWindow> windows;
    for (const PathCell& c : task.samples[piece.well].cells)
      if (is_within(piece, c.measured_depth)) widen_windows(task, piece, c, most, windows);
    for (const auto& [column, window] : windows) all.push_back(window);
  }
  return layers_for(task.grid, task.host, all, least_cell_thickness);
}

NearWellFrame near_well_frame(const WellTask& task, const std::vector<Piece>& pieces,
                              const std::optional<std::pair<LatticePoint, ColumnLayers>>& cells) {
  NearWellFrame frame;
  frame.region = region_of(task, pieces);
  frame.grid = cells ? std::make_shared<NearWellGrid>(task.grid, task.host, task.locator, cells->first, cells->second)
                     : std::make_shared<NearWellGrid>(task.grid, task.host, task.locator,
                                                      parts_for(task, pieces, frame.region), layers_of(task, pieces));
  frame.space = std::make_unique<ReferenceSpace>(*frame.grid, frame.region, cells_on(task, pieces));
  frame.obstacles = std::make_unique<Obstacles>(*frame.grid, *frame.space, frame.region);
  return frame;
}

}  // namespace wellknit
