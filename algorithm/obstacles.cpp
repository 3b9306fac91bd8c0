// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/obstacles.h"

#include <algorithm>
#include <cmath>

namespace wellknit {

namespace {

constexpr double same_depth = 4.0 * pillar_merge_tolerance;

/// Depths of all levels of a source column in the near-well layers at one of its corners.
std::vector<double> corner_levels(const NearWellGrid& grid, std::int64_t i, std::int64_t j, int corner) {
  const ColumnShape shape(grid.source(), grid.host(), i, j);
  std::vector<double> z;
  for (const ColumnLayers::Cell& c : grid.layers().cells)
    for (const ColumnLevel& level : {c.upper, c.lower}) z.push_back(shape.depth(corner & 1, corner >> 1, level));
  return z;
}

/// Layers where two columns differ at one of the two corners that they share.
std::vector<std::uint8_t> thrown_layers(const NearWellGrid& grid, std::array<std::int64_t, 2> one,
                                        std::array<std::int64_t, 2> other, std::array<int, 2> corners_of_one,
                                        std::array<int, 2> corners_of_other) {
  std::vector<std::uint8_t> out(grid.layers().cells.size(), 0);
  for (std::size_t c = 0; c < 2; ++c) {
    const auto a = corner_levels(grid, one[0], one[1], corners_of_one[c]);
    const auto b = corner_levels(grid, other[0], other[1], corners_of_other[c]);
    for (std::size_t n = 0; n < a.size(); ++n)
      if (std::abs(a[n] - b[n]) > same_depth) out[n / 2] = 1;
  }
  return out;
}

std::vector<std::uint8_t> thin_layers(const NearWellGrid& grid, std::int64_t i, std::int64_t j) {
  std::vector<std::uint8_t> out(grid.layers().cells.size(), 0);
  for (int c = 0; c < 4; ++c) {
    const auto z = corner_levels(grid, i, j, c);
    for (std::size_t n = 0; n < out.size(); ++n)
      if (z[2 * n + 1] - z[2 * n] < least_cell_thickness) out[n] = 1;
  }
  return out;
}

Vec3 nearest_in(const Box& box, const Vec3& p) { return p.cwiseMax(box.low).cwiseMin(box.high); }

}  // namespace

Obstacles::Obstacles(const NearWellGrid& grid, const ReferenceSpace& space, const CellRange& region) {
  const auto& n = grid.source().dimensions;
  for (std::int64_t j = region.low[1]; j < region.high[1]; ++j)
    for (std::int64_t i = region.low[0]; i < region.high[0]; ++i) {
      if (i + 1 < n[0])
        add(grid, space, thrown_layers(grid, {i, j}, {i + 1, j}, {1, 3}, {0, 2}), {i + 1, j}, {i + 1, j + 1});
      if (j + 1 < n[1])
        add(grid, space, thrown_layers(grid, {i, j}, {i, j + 1}, {2, 3}, {0, 1}), {i, j + 1}, {i + 1, j + 1});
      add(grid, space, thin_layers(grid, i, j), {i, j}, {i + 1, j + 1});
      add_gaps(grid, space, i, j);
    }
}

/// One box for each run of layers; `low` and `high` are source pillars.
void Obstacles::add(const NearWellGrid& grid, const ReferenceSpace& space, const std::vector<std::uint8_t>& is_bad,
                    std::array<std::int64_t, 2> low, std::array<std::int64_t, 2> high) {
  for (std::size_t first = 0; first < is_bad.size(); ++first) {
    if (is_bad[first] == 0) continue;
    std::size_t last = first;
    while (last + 1 < is_bad.size() && is_bad[last + 1] != 0) ++last;
    const Vec3 a = space.node(low[0] * grid.parts()[0], low[1] * grid.parts()[1], static_cast<std::int64_t>(first));
    const Vec3 b =
        space.node(high[0] * grid.parts()[0], high[1] * grid.parts()[1], static_cast<std::int64_t>(last) + 1);
    boxes_.push_back({a.cwiseMin(b), a.cwiseMax(b)});
    first = last;
  }
}

void Obstacles::add_gaps(const NearWellGrid& grid, const ReferenceSpace& space, std::int64_t i, std::int64_t j) {
  const std::size_t layers = grid.layers().cells.size();
  std::vector<std::uint8_t> has_gap(layers, 0);
  for (int c = 0; c < 4; ++c) {
    const auto z = corner_levels(grid, i, j, c);
    for (std::size_t k = 0; k + 1 < layers; ++k)
      if (std::abs(z[2 * k + 2] - z[2 * k + 1]) > same_depth) has_gap[k] = 1;
  }
  for (std::size_t k = 0; k < layers; ++k) {
    if (has_gap[k] == 0) continue;
    const auto level = static_cast<std::int64_t>(k) + 1;
    const Vec3 a = space.node(i * grid.parts()[0], j * grid.parts()[1], level);
    const Vec3 b = space.node((i + 1) * grid.parts()[0], (j + 1) * grid.parts()[1], level);
    boxes_.push_back({a.cwiseMin(b), a.cwiseMax(b)});
  }
}

bool Obstacles::is_clear(const Vec3& center, const Vec3& along, double radius, double gap) const {
  return std::none_of(boxes_.begin(), boxes_.end(), [&](const Box& box) {
    const Vec3 d = nearest_in(box, center) - center;
    const double distance = d.norm();
    if (distance >= radius + gap) return false;
    if (distance == 0.0) return true;
    // An end needs two thirds of the room that a side needs: its faces are smaller.
    const double cosine = along.dot(d) / distance;
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return distance < radius * sine + gap * (2.0 + sine) / 3.0;
  });
}

bool Obstacles::is_clear_in_plan(double x, double y, double distance) const {
  return std::none_of(boxes_.begin(), boxes_.end(), [&](const Box& box) {
    const Vec3 d = nearest_in(box, {x, y, box.low.z()}) - Vec3(x, y, box.low.z());
    return d.norm() < distance;
  });
}

}  // namespace wellknit
