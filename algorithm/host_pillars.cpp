// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// ZCORN is read in its own order, one row of columns at a time, into one short list of levels per column and pillar. A
// pillar's up to four lists are sorted already: equal ones are taken once, different ones are merged, not sorted. Rows
// of pillars are independent of each other.

#include "algorithm/host_pillars.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <functional>

#include "algorithm/ordered_pipeline.h"

namespace wellknit {

namespace {

/// The depths of all columns of one row on the pillars of one of its sides, a list of levels for each column and
/// corner.
class DepthLists {
 public:
  /// Side 0 has the pillars of row j, side 1 those of row j + 1.
  void read(const CornerPointGrid& grid, bool upside_down, std::int64_t j, int side) {
    const std::int64_t count = 2 * grid.dimensions[0];
    levels_ = 2 * grid.dimensions[2];
    stride_ = levels_ | 1;  // an even length would put all lists into the same few lines of the cache
    depth_.resize(static_cast<std::size_t>(count * stride_));
    for (std::int64_t l = 0; l < levels_; ++l) {
      const std::int64_t k2 = upside_down ? levels_ - 1 - l : l;
      const double* row = grid.zcorn.data() + count * (2 * j + side + 2 * grid.dimensions[1] * k2);
      double* to = depth_.data() + l;
      for (std::int64_t list = 0; list < count; ++list, to += stride_) *to = row[list];
    }
    for (std::int64_t list = 0; list < count; ++list) make_rise(depth_.data() + list * stride_);
  }
  /// Of column i at its low (0) or high (1) side along i.
  [[nodiscard]] const double* at(std::int64_t i, int di) const { return depth_.data() + (2 * i + di) * stride_; }

 private:
  void make_rise(double* depth) const {
    for (std::int64_t l = 1; l < levels_; ++l) depth[l] = std::max(depth[l], depth[l - 1]);
  }

  std::int64_t levels_ = 0;
  std::int64_t stride_ = 0;
  std::vector<double> depth_;
};

/// The different lists of levels that meet at one pillar, and where their ranks go.
struct PillarLists {
  std::array<const double*, 4> depth{};
  std::array<std::int32_t*, 4> rank{};
  std::size_t count = 0;
};

/// Gives each level its rank and appends the depths of the pillar's nodes.
void merge(const PillarLists& lists, std::int64_t levels, std::vector<double>& nodes) {
  const std::size_t first = nodes.size();
  std::array<std::int64_t, 4> head{};
  double last = 0.0;
  std::int32_t rank = -1;
  for (std::int64_t left = static_cast<std::int64_t>(lists.count) * levels; left > 0; --left) {
    std::size_t next = 4;
    for (std::size_t list = 0; list < lists.count; ++list) {
      if (head[list] == levels) continue;
      if (next == 4 || lists.depth[list][head[list]] < lists.depth[next][head[next]]) next = list;
    }
    const double depth = lists.depth[next][head[next]];
    if (nodes.size() == first || depth - last > pillar_merge_tolerance) {
      nodes.push_back(depth);
      ++rank;
    }
    last = depth;
    lists.rank[next][head[next]++] = rank;
  }
}

/// One list alone, the common case.
void number(const double* depth, std::int32_t* ranks, std::int64_t levels, std::vector<double>& nodes) {
  nodes.push_back(depth[0]);
  std::int32_t rank = 0;
  ranks[0] = 0;
  for (std::int64_t l = 1; l < levels; ++l) {
    if (depth[l] - depth[l - 1] > pillar_merge_tolerance) {
      nodes.push_back(depth[l]);
      ++rank;
    }
    ranks[l] = rank;
  }
}

/// Nodes of some rows of pillars.
struct RowNodes {
  std::array<DepthLists, 2> lists;  ///< of the row of columns before and after a row of pillars
  std::vector<double> depth;        ///< of one pillar
  std::vector<Vec3> nodes;
  std::vector<std::int64_t> count;  ///< of each pillar
};

class PillarResolver {
 public:
  PillarResolver(const CornerPointGrid& grid, HostCorners& corners) : grid_(grid), corners_(corners) {}

  /// Rows [begin, end) of pillars.
  void resolve(std::int64_t begin, std::int64_t end, RowNodes& out) const {
    out.nodes.clear();
    out.count.clear();
    for (std::int64_t j = begin; j < end; ++j) {
      if (j > 0) out.lists[0].read(grid_, corners_.upside_down, j - 1, 1);
      if (j < grid_.dimensions[1]) out.lists[1].read(grid_, corners_.upside_down, j, 0);
      for (std::int64_t i = 0; i <= grid_.dimensions[0]; ++i) resolve_pillar(i, j, out);
    }
  }

 private:
  void resolve_pillar(std::int64_t i, std::int64_t j, RowNodes& out) const {
    const std::int64_t levels = corners_.levels();
    PillarLists different;
    std::array<std::pair<std::int32_t*, std::int32_t*>, 4> same{};  // ranks of an equal list, and their place
    std::size_t same_count = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const std::int64_t ci = i - (corner & 1);
      const std::int64_t cj = j - (corner >> 1);
      if (ci < 0 || cj < 0 || ci >= grid_.dimensions[0] || cj >= grid_.dimensions[1]) continue;
      const double* depth = out.lists[cj < j ? 0 : 1].at(ci, corner & 1);
      std::int32_t* rank = corners_.rank.data() + levels * (corner + 4 * (ci + grid_.dimensions[0] * cj));
      const auto* known = std::find_if(different.depth.begin(), different.depth.begin() + different.count,
                                       [&](const double* other) { return std::equal(depth, depth + levels, other); });
      const auto at = static_cast<std::size_t>(known - different.depth.begin());
      if (at < different.count) {
        same[same_count++] = {different.rank[at], rank};
        continue;
      }
      different.depth[different.count] = depth;
      different.rank[different.count++] = rank;
    }
    out.depth.clear();
    if (different.count == 1)
      number(different.depth[0], different.rank[0], levels, out.depth);
    else
      merge(different, levels, out.depth);
    for (std::size_t s = 0; s < same_count; ++s) std::copy_n(same[s].first, levels, same[s].second);
    for (const double depth : out.depth) out.nodes.push_back(grid_.pillar_point(i, j, depth));
    out.count.push_back(static_cast<std::int64_t>(out.depth.size()));
  }

  const CornerPointGrid& grid_;
  HostCorners& corners_;
};

}  // namespace

bool is_upside_down(const CornerPointGrid& grid) {
  const std::int64_t layer = 4 * grid.dimensions[0] * grid.dimensions[1];
  const auto balance_of = [&](const tbb::blocked_range<std::int64_t>& layers, std::int64_t balance) {
    for (std::int64_t k = layers.begin(); k < layers.end(); ++k) {
      const double* top = grid.zcorn.data() + 2 * k * layer;
      std::int64_t down = 0;
      std::int64_t up = 0;
      for (std::int64_t c = 0; c < layer; ++c) {
        down += top[c] < top[c + layer] ? 1 : 0;
        up += top[c] > top[c + layer] ? 1 : 0;
      }
      balance += down - up;
    }
    return balance;
  };
  return tbb::parallel_reduce(tbb::blocked_range<std::int64_t>(0, grid.dimensions[2]), std::int64_t{0}, balance_of,
                              std::plus<>{}) < 0;
}

PillarNodes resolve_pillars(const CornerPointGrid& grid) {
  PillarNodes out;
  const auto [nx, ny, nz] = grid.dimensions;
  HostCorners& corners = out.corners;
  corners.dimensions = grid.dimensions;
  corners.upside_down = is_upside_down(grid);
  if (corners.upside_down) out.notes.emplace_back("The layers are numbered upwards.");
  corners.rank.resize(grid.zcorn.size());
  corners.first.reserve(static_cast<std::size_t>((nx + 1) * (ny + 1)));
  // Without faults each pillar has nz + 1 nodes.
  out.nodes.reserve(static_cast<std::size_t>((nx + 1) * (ny + 1) * (nz + 1)));

  const PillarResolver resolver(grid, corners);
  constexpr std::int64_t pillars_in_a_piece = 512;
  run_in_order<RowNodes>(
      ny + 1, std::max<std::int64_t>(1, pillars_in_a_piece / (nx + 1)),
      [&](std::int64_t begin, std::int64_t end, RowNodes& rows) { resolver.resolve(begin, end, rows); },
      [&](std::int64_t /*begin*/, std::int64_t /*end*/, const RowNodes& rows) {
        auto next = static_cast<std::int64_t>(out.nodes.size());
        for (const std::int64_t count : rows.count) {
          corners.first.emplace_back(next);
          next += count;
        }
        out.nodes.raw().insert(out.nodes.end(), rows.nodes.begin(), rows.nodes.end());
      });
  return out;
}

}  // namespace wellknit
