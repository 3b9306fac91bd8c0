// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/deck_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/errors.h"
#include "writers/nested_layout.h"

namespace wellknit {

namespace {

constexpr double thinnest_host = 2e-4;  ///< m; below it a cell takes a box, which has a least thickness
constexpr double longest_row = 1e6;     ///< m, of all boxes side by side: single precision still resolves 0.06 m there
constexpr double same_depth = 1e-6;     ///< m, of a cell and its corners: far below what any deck resolves

std::array<double, 8> box_depths(double depth, double thickness) {
  const double top = depth - 0.5 * thickness;
  const double base = depth + 0.5 * thickness;
  return {top, top, top, top, base, base, base, base};
}

class RowLayout : public DeckLayout {
 public:
  explicit RowLayout(const DeckLayoutInput& input)
      : DeckLayout(input.mesh.cells.size()), mesh_(input.mesh), boxes_(input.boxes), source_(input.source) {
    const auto count = static_cast<std::int64_t>(input.order.size());
    set_dimensions({count, 1, 1});
    for (std::int64_t n = 0; n < count; ++n) set_place(input.order[static_cast<std::size_t>(n)], n);
    // As far apart as makes the boxes about as wide as long, or the row short enough.
    double total = 0.0;
    for (const double area : boxes_.area) total += area;
    width_ = std::max(std::sqrt(total / static_cast<double>(count)), total / longest_row);
    edge_.push_back(0.0);
    for (const CellId cell : input.order) edge_.push_back(edge_.back() + boxes_.area[cell.index()] / width_);
  }

  /// Vertical, two rows of them.
  [[nodiscard]] std::array<double, 6> pillar(std::int64_t i, std::int64_t j) const override {
    const double x = edge_[static_cast<std::size_t>(i)];
    const double y = j == 0 ? 0.0 : width_;
    return {x, y, boxes_.above_all, x, y, boxes_.below_all};
  }

  [[nodiscard]] std::array<double, 8> depths(std::int64_t place) const override {
    const CellId cell = cell_at()[static_cast<std::size_t>(place)];
    std::array<double, 8> out = box_depths(mesh_.cells.depth[cell], boxes_.thickness[cell.index()]);
    const HostCellId source = mesh_.cells.source_cell[cell];
    if (source_ == nullptr || mesh_.cells.kind[cell] != CellKind::host || !source.is_valid()) return out;
    const auto corners = source_->corners(source);
    if (takes(corners, cell))
      for (std::size_t c = 0; c < 8; ++c) out[c] = corners[c].z();
    return out;
  }
  [[nodiscard]] bool connects_boxes() const override { return true; }

 private:
  /// Corners of which none of the base lies above that of the top, and whose mean is the cell's depth.
  [[nodiscard]] bool takes(const std::array<Vec3, 8>& corners, CellId cell) const {
    double mean = 0.0;
    for (const Vec3& corner : corners) mean += 0.125 * corner.z();
    for (std::size_t pillar = 0; pillar < 4; ++pillar)
      if (corners[pillar + 4].z() < corners[pillar].z()) return false;
    return boxes_.thickness[cell.index()] > thinnest_host && std::abs(mean - mesh_.cells.depth[cell]) < same_depth;
  }

  const Mesh& mesh_;
  const DeckBoxes& boxes_;
  const CornerPointGrid* source_;
  double width_ = 0.0;
  std::vector<double> edge_;  ///< x between the boxes, m
};

class PortableLayout : public DeckLayout {
 public:
  explicit PortableLayout(const DeckLayoutInput& input)
      : DeckLayout(input.mesh.cells.size()), mesh_(input.mesh), boxes_(input.boxes) {
    const auto count = static_cast<std::int64_t>(input.order.size());
    set_dimensions({2 * count - 1, 1, 1});
    for (std::int64_t n = 0; n < count; ++n) set_place(input.order[static_cast<std::size_t>(n)], 2 * n);
  }

  /// A square around the cell's centre.
  [[nodiscard]] std::array<double, 6> pillar(std::int64_t i, std::int64_t j) const override {
    const CellId cell = cell_at()[static_cast<std::size_t>(i - i % 2)];
    const double half = 0.5 * std::sqrt(boxes_.area[cell.index()]);
    const Vec3& centre = mesh_.cells.center[cell];
    const double x = centre.x() + (i % 2 == 0 ? -half : half);
    const double y = centre.y() + (j == 0 ? -half : half);
    return {x, y, boxes_.above_all, x, y, boxes_.below_all};
  }

  [[nodiscard]] std::array<double, 8> depths(std::int64_t place) const override {
    const CellId cell = cell_at()[static_cast<std::size_t>(place)];
    if (cell.is_valid()) return box_depths(mesh_.cells.depth[cell], boxes_.thickness[cell.index()]);
    return box_depths(mesh_.cells.depth[cell_at()[static_cast<std::size_t>(place - 1)]], 0.0);
  }
  [[nodiscard]] bool connects_boxes() const override { return false; }

 private:
  const Mesh& mesh_;
  const DeckBoxes& boxes_;
};

}  // namespace

std::array<std::int64_t, 3> DeckLayout::ijk(CellId cell) const {
  const std::int64_t at = place_[cell];
  const auto [nx, ny, nz] = dimensions_;
  return {at % nx + 1, at / nx % ny + 1, at / (nx * ny) + 1};
}

void DeckLayout::set_dimensions(const std::array<std::int64_t, 3>& dimensions) {
  dimensions_ = dimensions;
  cell_at_.assign(static_cast<std::size_t>(dimensions[0] * dimensions[1] * dimensions[2]), no_cell);
}

void DeckLayout::set_place(CellId cell, std::int64_t place) {
  place_[cell] = place;
  cell_at_[static_cast<std::size_t>(place)] = cell;
}

std::unique_ptr<DeckLayout> make_deck_layout(DeckLayoutKind form, const DeckLayoutInput& input) {
  switch (form) {
    case DeckLayoutKind::portable: return std::make_unique<PortableLayout>(input);
    case DeckLayoutKind::nested: return make_nested_layout(input);
    case DeckLayoutKind::row: break;
  }
  return std::make_unique<RowLayout>(input);
}

}  // namespace wellknit
