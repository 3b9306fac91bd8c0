// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/near_well_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wellknit {

namespace {

/// Corners whose depths differ by less see one node: interpolation between merged nodes adds rounding only.
constexpr double same_depth = 4.0 * pillar_merge_tolerance;

bool are_source_layers(const ColumnLayers& layers, std::int64_t places) {
  if (static_cast<std::int64_t>(layers.cells.size()) != places) return false;
  for (std::int64_t p = 0; p < places; ++p)
    if (layers.cells[static_cast<std::size_t>(p)] != ColumnLayers::Cell{{p, 0.0}, {p, 1.0}}) return false;
  return true;
}

}  // namespace

NearWellGrid::NearWellGrid(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator,
                           LatticePoint parts, ColumnLayers layers)
    : grid_(grid), host_(host), locator_(locator), parts_(parts), layers_(std::move(layers)) {
  is_source_ = parts_ == LatticePoint{1, 1} && are_source_layers(layers_, grid.dimensions[2]);
  dimensions_ = {grid.dimensions[0] * parts_[0], grid.dimensions[1] * parts_[1],
                 static_cast<std::int64_t>(layers_.cells.size())};
}

HostCellId NearWellGrid::source_cell(const NearWellCell& c) const {
  const auto [i, j] = source_column(c);
  const ColumnLevel& upper = level(c[2], 0);
  const ColumnLevel& lower = level(c[2], 1);
  return grid_.cell_id(i, j, host_.corners.layer((upper.place + lower.place) / 2));
}

bool NearWellGrid::exists(const NearWellCell& c) const {
  const auto [i, j] = source_column(c);
  for (std::int64_t place = level(c[2], 0).place; place <= level(c[2], 1).place; ++place)
    if (host_.exists[grid_.cell_id(i, j, host_.corners.layer(place))] != 0) return true;
  return false;
}

double NearWellGrid::corner_depth(const NearWellCell& c, int corner) const {
  const auto [i, j] = source_column(c);
  const double s = static_cast<double>(c[0] - i * parts_[0] + (corner & 1)) / static_cast<double>(parts_[0]);
  const double t = static_cast<double>(c[1] - j * parts_[1] + ((corner >> 1) & 1)) / static_cast<double>(parts_[1]);
  return ColumnShape(grid_, host_, i, j).depth(s, t, level(c[2], corner >> 2));
}

Vec3 NearWellGrid::corner(const NearWellCell& c, int corner) const {
  const auto [i, j] = source_column(c);
  const double s = static_cast<double>(c[0] - i * parts_[0] + (corner & 1)) / static_cast<double>(parts_[0]);
  const double t = static_cast<double>(c[1] - j * parts_[1] + ((corner >> 1) & 1)) / static_cast<double>(parts_[1]);
  return ColumnShape(grid_, host_, i, j).point(s, t, level(c[2], corner >> 2));
}

double NearWellGrid::least_thickness(const NearWellCell& c) const {
  double least = std::numeric_limits<double>::infinity();
  for (int p = 0; p < 4; ++p) least = std::min(least, corner_depth(c, p + 4) - corner_depth(c, p));
  return least;
}

bool NearWellGrid::is_glued(const NearWellCell& c, int side) const {
  const auto axis = static_cast<std::size_t>(side / 2);
  const bool high = side % 2 != 0;
  NearWellCell other = c;
  other[axis] += high ? 1 : -1;
  if (!is_inside(other)) return false;
  // Inside one source column its layers go on.
  if (axis < 2 && source_column(c) == source_column(other)) return true;
  const int bit = 1 << axis;
  for (int p = 0; p < 8; ++p) {
    if (((p & bit) != 0) != high) continue;
    if (std::abs(corner_depth(c, p) - corner_depth(other, p ^ bit)) > same_depth) return false;
  }
  return true;
}

NearWellLocation NearWellGrid::in_layers(HostCellId cell, const Vec3& uvw) const {
  const auto [i, j, k] = grid_.ijk(cell);
  NearWellLocation out;
  out.source = cell;
  for (std::size_t a = 0; a < 2; ++a) {
    const double at = uvw[static_cast<int>(a)] * static_cast<double>(parts_[a]);
    const auto part = std::clamp<std::int64_t>(static_cast<std::int64_t>(at), 0, parts_[a] - 1);
    out.cell[a] = (a == 0 ? i : j) * parts_[a] + part;
    out.uvw[static_cast<int>(a)] = at - static_cast<double>(part);
  }
  const std::int64_t place = host_.corners.layer(k);
  const double w = host_.corners.upside_down ? 1.0 - uvw.z() : uvw.z();
  // The last cell that begins at or above the point.
  const auto after = std::upper_bound(
      layers_.cells.begin(), layers_.cells.end(), static_cast<double>(place) + w,
      [](double v, const ColumnLayers::Cell& c) { return v < static_cast<double>(c.upper.place) + c.upper.fraction; });
  out.cell[2] = std::max<std::int64_t>(0, std::distance(layers_.cells.begin(), after) - 1);
  // A layer's base is the next one's top; a point on it belongs to the cell that was found.
  if (out.cell[2] > 0 && level(out.cell[2], 0).place > place) --out.cell[2];
  const ColumnLevel& upper = level(out.cell[2], 0);
  const ColumnLevel& lower = level(out.cell[2], 1);
  if (upper.place == lower.place) {
    out.uvw.z() = std::clamp((w - upper.fraction) / (lower.fraction - upper.fraction), 0.0, 1.0);
  } else {
    const ColumnShape shape(grid_, host_, i, j);
    const double top = shape.depth(uvw.x(), uvw.y(), upper);
    const double base = shape.depth(uvw.x(), uvw.y(), lower);
    const double at =
        (1.0 - w) * shape.depth(uvw.x(), uvw.y(), {place, 0.0}) + w * shape.depth(uvw.x(), uvw.y(), {place, 1.0});
    out.uvw.z() = base > top ? std::clamp((at - top) / (base - top), 0.0, 1.0) : 0.5;
  }
  return out;
}

std::optional<NearWellLocation> NearWellGrid::locate(const Vec3& point, HostCellId hint) const {
  const auto location = locator_.locate(point, hint);
  if (!location) return std::nullopt;
  return in_layers(location->cell, location->uvw);
}

namespace {

/// Depths of the levels at one corner of a column, and the depths that matter there.
struct CornerLevels {
  std::vector<double> z;
  const ColumnWindow* window = nullptr;
};

/// Of a stack of places.
struct Thickness {
  double least = std::numeric_limits<double>::infinity();  ///< where it lies in the windows
  double mean = 0.0;                                       ///< everywhere
  double parts = 1.0;                                      ///< that the windows ask for
};

Thickness thickness_of(const std::vector<CornerLevels>& corners, std::int64_t first, std::int64_t last) {
  Thickness t;
  for (const CornerLevels& c : corners) {
    const double top = c.z[static_cast<std::size_t>(2 * first)];
    const double base = c.z[static_cast<std::size_t>(2 * last + 1)];
    t.mean += (base - top) / static_cast<double>(corners.size());
    if (base < c.window->low || top > c.window->high) continue;
    t.least = std::min(t.least, base - top);
    t.parts = std::max(t.parts, std::ceil((base - top) / c.window->thickest));
  }
  return t;
}

}  // namespace

ColumnLayers layers_for(const CornerPointGrid& grid, const HostMesh& host, const std::vector<ColumnWindow>& windows,
                        double least) {
  const std::int64_t places = grid.dimensions[2];
  std::vector<CornerLevels> levels;
  for (const ColumnWindow& window : windows) {
    const ColumnShape shape(grid, host, window.column[0], window.column[1]);
    for (int c = 0; c < 4; ++c) {
      CornerLevels corner{{}, &window};
      for (std::int64_t p = 0; p < places; ++p)
        for (const double f : {0.0, 1.0}) corner.z.push_back(shape.depth(c & 1, c >> 1, {p, f}));
      levels.push_back(std::move(corner));
    }
  }
  std::vector<std::array<std::int64_t, 2>> stacks;
  const auto is_thick = [&](std::int64_t first, std::int64_t last) {
    const Thickness t = thickness_of(levels, first, last);
    return t.least >= std::max(least, 0.1 * t.mean);
  };
  std::int64_t first = 0;
  for (std::int64_t p = 0; p < places; ++p) {
    if (!is_thick(first, p)) continue;
    stacks.push_back({first, p});
    first = p + 1;
  }
  if (first < places) {
    if (stacks.empty())
      stacks.push_back({0, places - 1});
    else
      stacks.back()[1] = places - 1;
  }
  ColumnLayers layers;
  for (const auto& [top, base] : stacks) {
    // Of a stack the member that is thickest where it is thinnest is split; the others go with its first and last part.
    std::int64_t split = top;
    for (std::int64_t p = top; p <= base; ++p)
      if (thickness_of(levels, p, p).least > thickness_of(levels, split, split).least) split = p;
    const Thickness thickness = thickness_of(levels, split, split);
    // Where it wedges out its parts must keep some thickness.
    const double most_parts = std::floor(thickness.least / (2.0 * least));
    const int parts = std::max(1, static_cast<int>(std::min(thickness.parts, most_parts)));
    for (int n = 0; n < parts; ++n) {
      const ColumnLevel upper{split, static_cast<double>(n) / parts};
      const ColumnLevel lower{split, static_cast<double>(n + 1) / parts};
      layers.cells.push_back({n == 0 ? ColumnLevel{top, 0.0} : upper, n + 1 == parts ? ColumnLevel{base, 1.0} : lower});
    }
  }
  return layers;
}

}  // namespace wellknit
