// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// ZCORN is read once, in its own order, into one short list of levels per column and pillar. A pillar's up to four
// lists are sorted already, so they are merged, not sorted. Rows of columns and of pillars are independent of each
// other.

#include "algorithm/host_pillars.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "algorithm/host_mesh.h"

namespace wellknit {

namespace {

/// Cells whose levels had to be moved, of one row of columns.
struct Mended {
  std::int64_t reversed = 0;     ///< base above the top
  std::int64_t overlapping = 0;  ///< top above the base of the cell over it
  std::int64_t first_reversed = std::numeric_limits<std::int64_t>::max();
  std::int64_t first_overlapping = std::numeric_limits<std::int64_t>::max();

  void add(const Mended& other) {
    reversed += other.reversed;
    overlapping += other.overlapping;
    first_reversed = std::min(first_reversed, other.first_reversed);
    first_overlapping = std::min(first_overlapping, other.first_overlapping);
  }
};

bool is_upside_down(const CornerPointGrid& grid) {
  const std::int64_t layer = 4 * grid.dimensions[0] * grid.dimensions[1];
  std::int64_t balance = 0;
  for (std::int64_t k = 0; k < grid.dimensions[2]; ++k) {
    const double* top = grid.zcorn.data() + 2 * k * layer;
    for (std::int64_t c = 0; c < layer; ++c) balance += (top[c] < top[c + layer]) - (top[c] > top[c + layer]);
  }
  return balance < 0;
}

/// Reads the levels of row j of columns into `depth`, laid out as PillarNodes::level.
void read_row(const CornerPointGrid& grid, const PillarNodes& out, std::int64_t j, double* depth) {
  const std::int64_t nx = grid.dimensions[0];
  const std::int64_t levels = out.levels();
  for (std::int64_t l = 0; l < levels; ++l) {
    const std::int64_t k2 = out.upside_down ? levels - 1 - l : l;
    for (int dj = 0; dj < 2; ++dj) {
      const double* row = grid.zcorn.data() + 2 * nx * (2 * j + dj + 2 * grid.dimensions[1] * k2);
      double* to = depth + levels * (2 * dj) + l;
      for (std::int64_t i = 0; i < nx; ++i) {
        to[4 * levels * i] = row[2 * i];
        to[4 * levels * i + levels] = row[2 * i + 1];
      }
    }
  }
}

/// Makes the levels of row j rise downwards; reports what was more than rounding.
Mended order_row(const CornerPointGrid& grid, const PillarNodes& out, std::int64_t j, double* depth) {
  Mended mended;
  const std::int64_t levels = out.levels();
  for (std::int64_t i = 0; i < grid.dimensions[0]; ++i) {
    for (std::int64_t l = 1; l < levels; ++l) {
      double worst = 0.0;
      for (int corner = 0; corner < 4; ++corner) {
        double* z = depth + levels * (corner + 4 * i) + l;
        worst = std::max(worst, z[-1] - z[0]);
        z[0] = std::max(z[0], z[-1]);
      }
      if (worst <= pillar_merge_tolerance) continue;
      const std::int64_t cell = grid.cell_id(i, j, out.layer(l / 2)).value();
      if (l % 2 == 1) mended.add({1, 0, cell, std::numeric_limits<std::int64_t>::max()});
      if (l % 2 == 0) mended.add({0, 1, std::numeric_limits<std::int64_t>::max(), cell});
    }
  }
  return mended;
}

/// The lists of levels that meet at one pillar.
struct PillarLists {
  std::array<std::int64_t, 4> start{};  ///< places in PillarNodes::level
  int count = 0;
};

PillarLists lists_at(const PillarNodes& out, std::int64_t i, std::int64_t j) {
  PillarLists lists;
  for (int corner = 0; corner < 4; ++corner) {
    const std::int64_t ci = i - (corner & 1);
    const std::int64_t cj = j - (corner >> 1);
    if (ci < 0 || cj < 0 || ci >= out.dimensions[0] || cj >= out.dimensions[1]) continue;
    const std::int64_t column = ci + out.dimensions[0] * cj;
    lists.start[static_cast<std::size_t>(lists.count++)] = out.levels() * (corner + 4 * column);
  }
  return lists;
}

/// Merges the lists of one pillar: `rank` receives each level's node, counted from the pillar's first, `nodes` their
/// depths.
void merge_pillar(const PillarLists& lists, std::int64_t levels, const double* depth, std::int64_t* rank,
                  std::vector<double>& nodes) {
  const std::size_t first = nodes.size();
  std::array<std::int64_t, 4> head{};
  double last = 0.0;
  for (std::int64_t left = lists.count * levels; left > 0; --left) {
    std::size_t next = 4;
    for (std::size_t list = 0; list < static_cast<std::size_t>(lists.count); ++list) {
      if (head[list] == levels) continue;
      if (next == 4 || depth[lists.start[list] + head[list]] < depth[lists.start[next] + head[next]]) next = list;
    }
    const std::int64_t at = lists.start[next] + head[next]++;
    if (nodes.size() == first || depth[at] - last > pillar_merge_tolerance) nodes.push_back(depth[at]);
    last = depth[at];
    rank[at] = static_cast<std::int64_t>(nodes.size() - first) - 1;
  }
}

/// Nodes of one row of pillars.
struct PillarRow {
  std::vector<double> depth;        ///< pillar by pillar
  std::vector<std::int64_t> start;  ///< nx + 2 offsets into depth
};

PillarRow merge_row(PillarNodes& out, const std::vector<double>& depth, std::int64_t j) {
  PillarRow row;
  row.start.push_back(0);
  for (std::int64_t i = 0; i <= out.dimensions[0]; ++i) {
    merge_pillar(lists_at(out, i, j), out.levels(), depth.data(), out.level.data(), row.depth);
    row.start.push_back(static_cast<std::int64_t>(row.depth.size()));
  }
  return row;
}

/// Numbers a row's nodes from `base` and gives them their places.
void place_row(const CornerPointGrid& grid, const PillarRow& row, std::int64_t j, std::int64_t base, PillarNodes& out) {
  for (std::int64_t i = 0; i <= out.dimensions[0]; ++i) {
    const auto at = static_cast<std::size_t>(i);
    for (std::int64_t n = row.start[at]; n < row.start[at + 1]; ++n)
      out.nodes[VertexId(base + n)] = grid.pillar_point(i, j, row.depth[static_cast<std::size_t>(n)]);
    const PillarLists lists = lists_at(out, i, j);
    for (std::size_t list = 0; list < static_cast<std::size_t>(lists.count); ++list)
      for (std::int64_t l = 0; l < out.levels(); ++l)
        out.level[static_cast<std::size_t>(lists.start[list] + l)] += base + row.start[at];
  }
}

std::string where(const CornerPointGrid& grid, std::int64_t cell) {
  const auto [i, j, k] = grid.ijk(HostCellId(cell));
  return fmt::format("({}, {}, {})", i + 1, j + 1, k + 1);
}

void note(const CornerPointGrid& grid, const Mended& mended, PillarNodes& out) {
  if (out.upside_down) out.notes.emplace_back("The layers are numbered upwards.");
  if (mended.reversed > 0)
    out.notes.push_back(
        fmt::format("{} cells have corners in reverse order, which were given no thickness; the first is {}.",
                    mended.reversed, where(grid, mended.first_reversed)));
  if (mended.overlapping > 0)
    out.notes.push_back(
        fmt::format("{} cells begin above the base of the cell over them and were cut off there; the first is {}.",
                    mended.overlapping, where(grid, mended.first_overlapping)));
}

}  // namespace

PillarNodes resolve_pillars(const CornerPointGrid& grid) {
  PillarNodes out;
  out.dimensions = grid.dimensions;
  out.upside_down = is_upside_down(grid);
  const auto [nx, ny, nz] = grid.dimensions;

  std::vector<double> depth(grid.zcorn.size());
  std::vector<Mended> mended(static_cast<std::size_t>(ny));
  tbb::parallel_for(std::int64_t{0}, ny, [&, nx = nx](std::int64_t j) {
    double* row = depth.data() + 4 * out.levels() * nx * j;
    read_row(grid, out, j, row);
    mended[static_cast<std::size_t>(j)] = order_row(grid, out, j, row);
  });
  Mended all;
  for (const Mended& row : mended) all.add(row);
  note(grid, all, out);

  out.level.resize(depth.size());
  std::vector<PillarRow> rows(static_cast<std::size_t>(ny + 1));
  tbb::parallel_for(std::int64_t{0}, ny + 1,
                    [&](std::int64_t j) { rows[static_cast<std::size_t>(j)] = merge_row(out, depth, j); });
  std::vector<std::int64_t> base{0};
  for (const PillarRow& row : rows) base.push_back(base.back() + row.start.back());
  out.nodes.resize(static_cast<std::size_t>(base.back()), Vec3::Zero());
  tbb::parallel_for(std::int64_t{0}, ny + 1, [&](std::int64_t j) {
    const auto at = static_cast<std::size_t>(j);
    place_row(grid, rows[at], j, base[at], out);
  });
  return out;
}

}  // namespace wellknit
