// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Columns beyond the grid take every second I and every second J, so that each has four pillars of its own and can
/// stand where its cells are. Cells above each other share a column as long as one square fits them.

#include "writers/nested_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/errors.h"

namespace wellknit {

namespace {

constexpr std::int64_t most_places = 50'000'000;  ///< of one deck, active or not: some 10 GB in a simulator
constexpr double same_place = 0.1;  ///< of a box's width: how far a cell may lie beside the first one of its column
constexpr double same_area = 0.1;   ///< how much its area may differ

/// Made cells one below the other.
struct Stack {
  Vec3 centre = Vec3::Zero();
  double area = 0.0;
  std::vector<CellId> cells;  ///< none reaches into the next
};

void require_source(const DeckLayoutInput& input) {
  if (input.source == nullptr)
    throw InvalidInput("layout=nested keeps the source grid, which is not known here; name it with --source CASE");
  if (input.source->dimensions != input.mesh.source_dimensions)
    throw InvalidInput(
        fmt::format("layout=nested: the source grid has {} x {} x {} cells, that of the mesh {} x {} x {}",
                    input.source->dimensions[0], input.source->dimensions[1], input.source->dimensions[2],
                    input.mesh.source_dimensions[0], input.mesh.source_dimensions[1], input.mesh.source_dimensions[2]));
  for (std::size_t c = 0; c < input.mesh.cells.size(); ++c) {
    const CellId cell(c);
    if (input.mesh.cells.kind[cell] != CellKind::host) continue;
    Eigen::AlignedBox3d box;
    for (const Vec3& corner : input.source->corners(input.mesh.cells.source_cell[cell])) box.extend(corner);
    // Faults that were healed move corners by no more than a cell.
    if (box.exteriorDistance(input.mesh.cells.center[cell]) <= box.diagonal().norm()) continue;
    throw InvalidInput("layout=nested: the source grid is not the one that the mesh was made from");
  }
}

class NestedLayout : public DeckLayout {
 public:
  explicit NestedLayout(const DeckLayoutInput& input)
      : DeckLayout(input.mesh.cells.size()), mesh_(input.mesh), boxes_(input.boxes), source_(*input.source) {
    std::vector<CellId> made;
    for (const CellId cell : input.order)
      if (!is_kept(cell)) made.push_back(cell);
    build_stacks(made);
    const auto [nx, ny, nz] = source_.dimensions;
    rows_ = (ny + 1) / 2;
    const std::int64_t columns = (static_cast<std::int64_t>(stacks_.size()) + rows_ - 1) / rows_;
    const std::array<std::int64_t, 3> dimensions{nx + 2 * columns, ny, nz};
    if (dimensions[0] * ny * nz > most_places)
      throw InvalidInput(fmt::format(
          "layout=nested: {} made cells beside {} x {} x {} cells need a grid of {} x {} x {} cells, more than {}; use "
          "layout=portable",
          made.size(), nx, ny, nz, dimensions[0], ny, nz, most_places));
    set_dimensions(dimensions);
    place_cells();
    is_mirrored_ = handedness() < 0.0;
  }

  [[nodiscard]] std::array<double, 6> pillar(std::int64_t i, std::int64_t j) const override {
    const std::int64_t nx = source_.dimensions[0];
    std::array<double, 6> out{};
    if (i <= nx) {
      std::copy_n(source_.coord.begin() + static_cast<std::ptrdiff_t>(6 * (i + (nx + 1) * j)), 6, out.begin());
      return out;
    }
    // Pillars of the last column where a place has none.
    const auto at = static_cast<std::size_t>(
        std::min((i - nx - 1) / 2 * rows_ + std::min(j / 2, rows_ - 1), static_cast<std::int64_t>(stacks_.size()) - 1));
    const Stack& stack = stacks_[at];
    const double half = 0.5 * std::sqrt(stack.area);
    const double x = stack.centre.x() + ((i - nx) % 2 == 1 ? -half : half);
    const bool is_first = (j % 2 == 0) != is_mirrored_;
    const double y = stack.centre.y() + (is_first ? -half : half);
    return {x, y, boxes_.above_all, x, y, boxes_.below_all};
  }

  [[nodiscard]] std::array<double, 8> depths(std::int64_t place) const override {
    const auto [nx, ny, nz] = dimensions();
    const std::int64_t i = place % nx;
    const CellId cell = cell_at()[static_cast<std::size_t>(place)];
    std::array<double, 8> out{};
    if (i < source_.dimensions[0]) {
      const auto corners = source_.corners(source_.cell_id(i, place / nx % ny, place / (nx * ny)));
      double mean = 0.0;
      for (const Vec3& corner : corners) mean += 0.125 * corner.z();
      // Where faults were healed, the mesh has the cell's depth.
      const double shift =
          cell.is_valid() && std::abs(mesh_.cells.depth[cell] - mean) > 1e-6 ? mesh_.cells.depth[cell] - mean : 0.0;
      for (std::size_t c = 0; c < 8; ++c) out[c] = corners[c].z() + shift;
      return out;
    }
    if (!cell.is_valid()) {
      out.fill(base_above(place));
      return out;
    }
    const double half = 0.5 * boxes_.thickness[cell.index()];
    for (std::size_t c = 0; c < 8; ++c) out[c] = mesh_.cells.depth[cell] + (c < 4 ? -half : half);
    return out;
  }
  [[nodiscard]] bool connects_boxes() const override { return true; }

 private:
  [[nodiscard]] bool is_kept(CellId cell) const {
    return mesh_.cells.kind[cell] == CellKind::host && mesh_.cells.source_cell[cell].is_valid();
  }

  void build_stacks(std::vector<CellId> made) {
    std::vector<std::size_t> rank(mesh_.cells.size());
    for (std::size_t n = 0; n < made.size(); ++n) rank[made[n].index()] = n;
    // Radial cells of one sector and ring lie above each other in a steep well; others where x and y agree.
    const auto key = [&](CellId cell) {
      const RadialIndex& at = mesh_.cells.radial_index[cell];
      const Vec3& centre = mesh_.cells.center[cell];
      const bool is_radial = mesh_.cells.well[cell].is_valid();
      return std::tuple(mesh_.cells.well[cell].value(), at.sector, at.ring, is_radial ? 0.0 : std::round(centre.x()),
                        is_radial ? 0.0 : std::round(centre.y()), mesh_.cells.depth[cell], cell.value());
    };
    std::vector<CellId> sorted = made;
    std::sort(sorted.begin(), sorted.end(), [&](CellId a, CellId b) { return key(a) < key(b); });
    for (const CellId cell : sorted) {
      if (stacks_.empty() || !fits(stacks_.back(), cell))
        stacks_.push_back({mesh_.cells.center[cell], boxes_.area[cell.index()], {}});
      stacks_.back().cells.push_back(cell);
    }
    std::stable_sort(stacks_.begin(), stacks_.end(), [&](const Stack& a, const Stack& b) {
      return rank[a.cells.front().index()] < rank[b.cells.front().index()];
    });
  }

  [[nodiscard]] bool fits(const Stack& stack, CellId cell) const {
    if (static_cast<std::int64_t>(stack.cells.size()) >= source_.dimensions[2]) return false;
    const CellId above = stack.cells.back();
    const double base = mesh_.cells.depth[above] + 0.5 * boxes_.thickness[above.index()];
    const double top = mesh_.cells.depth[cell] - 0.5 * boxes_.thickness[cell.index()];
    const Vec3 beside = mesh_.cells.center[cell] - stack.centre;
    const double width = std::sqrt(stack.area);
    return top >= base && std::abs(beside.x()) <= same_place * width && std::abs(beside.y()) <= same_place * width &&
           std::abs(boxes_.area[cell.index()] - stack.area) <= same_area * stack.area;
  }

  void place_cells() {
    const auto [nx, ny, nz] = dimensions();
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      if (!is_kept(CellId(c))) continue;
      const auto [i, j, k] = source_.ijk(mesh_.cells.source_cell[CellId(c)]);
      set_place(CellId(c), i + nx * (j + ny * k));
    }
    for (std::size_t s = 0; s < stacks_.size(); ++s) {
      const auto column = static_cast<std::int64_t>(s) / rows_;
      const std::int64_t i = source_.dimensions[0] + 1 + 2 * column;
      const std::int64_t j = 2 * (static_cast<std::int64_t>(s) % rows_);
      for (std::size_t k = 0; k < stacks_[s].cells.size(); ++k)
        set_place(stacks_[s].cells[k], i + nx * (j + ny * static_cast<std::int64_t>(k)));
    }
  }

  /// Places below a stack's last cell have no thickness there; those of a column without cells lie at the top.
  [[nodiscard]] double base_above(std::int64_t place) const {
    const std::int64_t layer = dimensions()[0] * dimensions()[1];
    for (std::int64_t at = place - layer; at >= 0; at -= layer) {
      const CellId cell = cell_at()[static_cast<std::size_t>(at)];
      if (cell.is_valid()) return mesh_.cells.depth[cell] + 0.5 * boxes_.thickness[cell.index()];
    }
    return boxes_.above_all;
  }

  /// Of the source grid, by its first cell with a volume.
  [[nodiscard]] double handedness() const {
    for (std::int64_t c = 0; c < source_.cell_count(); ++c)
      if (const double volume = bilinear_hexahedron_volume(source_.corners(HostCellId(c))); volume != 0.0)
        return volume;
    return 1.0;
  }

  const Mesh& mesh_;
  const DeckBoxes& boxes_;
  const CornerPointGrid& source_;
  std::vector<Stack> stacks_;
  std::int64_t rows_ = 1;  ///< of columns beyond the grid that have cells
  bool is_mirrored_ = false;
};

}  // namespace

std::unique_ptr<DeckLayout> make_nested_layout(const DeckLayoutInput& input) {
  require_source(input);
  return std::make_unique<NestedLayout>(input);
}

}  // namespace wellknit
