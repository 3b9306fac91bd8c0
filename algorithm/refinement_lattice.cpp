// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// All depths come from the shape of the source column (column_shape.h), which is that of its side on its side: where
// nothing is faulted, columns of any size agree to the last bit, and so do their ranks.

#include "algorithm/refinement_lattice.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "model/errors.h"

namespace wellknit {

namespace {

class LatticeBuilder {
 public:
  LatticeBuilder(const CornerPointGrid& grid, const HostMesh& host, const RefinementPlan& plan,
                 const std::vector<std::uint8_t>& is_refined)
      : grid_(grid), host_(host), plan_(plan), is_refined_(is_refined) {
    out_.unit = plan.unit;
  }

  RefinementLattice build() {
    add_columns();
    place_pillars();
    for (std::size_t c = 0; c < out_.columns.size(); ++c) touch_pillars(static_cast<std::int32_t>(c));
    make_strips();
    make_nodes();
    return std::move(out_);
  }

 private:
  [[nodiscard]] bool refines(std::int64_t i, std::int64_t j) const {
    return i >= 0 && j >= 0 && i < grid_.dimensions[0] && j < grid_.dimensions[1] &&
           is_refined_[static_cast<std::size_t>(i + grid_.dimensions[0] * j)] != 0;
  }

  void add_columns() {
    std::vector<std::array<std::int64_t, 2>> beside;
    for (const RefinedColumn& column : plan_.columns) {
      out_.columns.push_back({column.source,
                              column.low,
                              column.high,
                              &plan_.layers[static_cast<std::size_t>(column.layers)],
                              true,
                              {},
                              {}});
      for (const ColumnSide side : column_sides) {
        const std::array<std::int64_t, 2> other{column.source[0] + step_over(side)[0],
                                                column.source[1] + step_over(side)[1]};
        if (other[0] < 0 || other[1] < 0 || other[0] >= grid_.dimensions[0] || other[1] >= grid_.dimensions[1])
          continue;
        if (!refines(other[0], other[1])) beside.push_back({other[1], other[0]});
      }
    }
    std::sort(beside.begin(), beside.end());
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    const LatticePoint u = plan_.unit;
    for (const auto& [j, i] : beside)
      out_.columns.push_back(
          {{i, j}, {i * u[0], j * u[1]}, {(i + 1) * u[0], (j + 1) * u[1]}, plan_.layers.data(), false, {}, {}});
  }

  void place_pillars() {
    auto& pillars = out_.pillars;
    for (const RefinedColumn& c : plan_.columns)
      for (const LatticePoint& corner : {c.low, LatticePoint{c.high[0], c.low[1]}, c.high, {c.low[0], c.high[1]}})
        pillars.push_back(corner);
    std::sort(pillars.begin(), pillars.end());
    pillars.erase(std::unique(pillars.begin(), pillars.end()), pillars.end());
    by_j_.resize(pillars.size());
    std::iota(by_j_.begin(), by_j_.end(), 0);
    const auto key = [&](std::int32_t n) {
      const LatticePoint& p = pillars[static_cast<std::size_t>(n)];
      return std::pair(p[1], p[0]);
    };
    std::sort(by_j_.begin(), by_j_.end(), [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); });
    out_.along_j.resize(pillars.size());
    for (std::size_t n = 0; n < by_j_.size(); ++n)
      out_.along_j[static_cast<std::size_t>(by_j_[n])] = static_cast<std::int32_t>(n);
  }

  /// Pillars on a side, going round the column.
  void pillars_along(const LatticeColumn& column, ColumnSide side, std::vector<std::int32_t>& out) const {
    out.clear();
    const auto& pillars = out_.pillars;
    const auto [low, high] = std::pair(column.low, column.high);
    if (side == ColumnSide::east || side == ColumnSide::west) {
      const std::int64_t x = side == ColumnSide::east ? high[0] : low[0];
      auto at = std::lower_bound(pillars.begin(), pillars.end(), LatticePoint{x, low[1]});
      for (; at != pillars.end() && *at <= LatticePoint{x, high[1]}; ++at)
        out.push_back(static_cast<std::int32_t>(at - pillars.begin()));
    } else {
      const std::int64_t y = side == ColumnSide::north ? high[1] : low[1];
      const auto before = [&](std::int32_t n, const LatticePoint& p) {
        const LatticePoint& q = pillars[static_cast<std::size_t>(n)];
        return std::pair(q[1], q[0]) < std::pair(p[1], p[0]);
      };
      auto at = std::lower_bound(by_j_.begin(), by_j_.end(), LatticePoint{low[0], y}, before);
      for (; at != by_j_.end() && !before(*at, {low[0], y}) && before(*at, {high[0] + 1, y}); ++at) out.push_back(*at);
    }
    if (side == ColumnSide::north || side == ColumnSide::west) std::reverse(out.begin(), out.end());
  }

  void touch_pillars(std::int32_t number) {
    LatticeColumn& column = out_.columns[static_cast<std::size_t>(number)];
    const std::size_t first_touch = out_.touches.size();
    std::vector<std::int32_t> pillars;
    for (const ColumnSide side : column_sides) {
      const auto s = static_cast<std::size_t>(side);
      column.side_begin[s] = column.side_end[s] = out_.side_touches.size();
      if (!column.is_refined && !refines(column.source[0] + step_over(side)[0], column.source[1] + step_over(side)[1]))
        continue;
      pillars_along(column, side, pillars);
      for (const std::int32_t pillar : pillars) out_.side_touches.push_back(touch(number, pillar, first_touch));
      column.side_end[s] = out_.side_touches.size();
    }
  }

  /// The column's touch of a pillar; corners are on two sides.
  std::int32_t touch(std::int32_t column, std::int32_t pillar, std::size_t first_touch) {
    auto& touches = out_.touches;
    for (std::size_t t = first_touch; t < touches.size(); ++t)
      if (touches[t].pillar == pillar) return static_cast<std::int32_t>(t);
    touches.push_back({column, pillar, levels_});
    levels_ += 2 * out_.columns[static_cast<std::size_t>(column)].layers->cells.size();
    return static_cast<std::int32_t>(touches.size() - 1);
  }

  void make_strips() {
    out_.strips.resize(2 * out_.pillars.size());
    for (std::size_t c = 0; c < out_.columns.size(); ++c)
      for (const ColumnSide side : column_sides) {
        const auto along = out_.side(static_cast<std::int32_t>(c), side);
        const bool is_low = side == ColumnSide::east || side == ColumnSide::north;
        for (std::size_t n = 0; n + 1 < along.size(); ++n) {
          LatticeStrip& strip = out_.strips[out_.strip_between(along[n], along[n + 1], side)];
          strip.axis = side == ColumnSide::east || side == ColumnSide::west ? Axis::i : Axis::j;
          // Round the column, east and north go from p to q.
          strip.sides[is_low ? 0 : 1] = {static_cast<std::int32_t>(c), along[is_low ? n : n + 1],
                                         along[is_low ? n + 1 : n]};
        }
      }
  }

  void make_nodes() {
    out_.rank.resize(levels_);
    std::vector<std::vector<std::int32_t>> on_pillar(out_.pillars.size());
    for (std::size_t t = 0; t < out_.touches.size(); ++t)
      on_pillar[static_cast<std::size_t>(out_.touches[t].pillar)].push_back(static_cast<std::int32_t>(t));
    out_.host_pillar.assign(out_.pillars.size(), -1);
    for (std::size_t p = 0; p < out_.pillars.size(); ++p) make_nodes_of(p, on_pillar[p]);
  }

  /// Depths of the host's nodes where a pillar is one of its own; their ids are consecutive from the result.
  VertexId read_host_nodes(std::size_t pillar) {
    host_depth_.clear();
    const LatticePoint& at = out_.pillars[pillar];
    if (at[0] % plan_.unit[0] != 0 || at[1] % plan_.unit[1] != 0) return {};
    const std::int64_t number = at[0] / plan_.unit[0] + (grid_.dimensions[0] + 1) * (at[1] / plan_.unit[1]);
    out_.host_pillar[pillar] = number;
    const auto [first, end] = host_.corners.nodes_on(static_cast<std::size_t>(number));
    for (std::int64_t v = first.value(); v < end.value(); ++v) host_depth_.push_back(host_.vertices[VertexId(v)].z());
    return first;
  }

  /// A depth within the tolerance of a host's node is that node.
  [[nodiscard]] double snapped(double depth) const {
    const auto above = std::upper_bound(host_depth_.begin(), host_depth_.end(), depth);
    if (above != host_depth_.begin() && depth - above[-1] <= pillar_merge_tolerance) return above[-1];
    if (above != host_depth_.end() && *above - depth <= pillar_merge_tolerance) return *above;
    return depth;
  }

  /// Depths of a column's levels on a pillar, rising.
  void read_levels(const PillarTouch& touch) {
    const LatticeColumn& column = out_.columns[static_cast<std::size_t>(touch.column)];
    const ColumnShape shape(grid_, host_, column.source[0], column.source[1]);
    const auto [s, t] = out_.place_in(column, out_.pillars[static_cast<std::size_t>(touch.pillar)]);
    const std::size_t begin = depth_.size();
    for (const ColumnLayers::Cell& cell : column.layers->cells)
      for (const ColumnLevel& level : {cell.upper, cell.lower}) {
        const double depth = shape.depth(s, t, level);
        depth_.push_back(depth_.size() == begin ? depth : std::max(depth, depth_.back()));
      }
    for (std::size_t n = begin; n < depth_.size(); ++n) depth_[n] = snapped(depth_[n]);
  }

  void make_nodes_of(std::size_t pillar, const std::vector<std::int32_t>& touches) {
    const VertexId first_of_host = read_host_nodes(pillar);
    depth_.clear();
    for (const std::int32_t t : touches) read_levels(out_.touches[static_cast<std::size_t>(t)]);
    sorted_ = depth_;
    sorted_.insert(sorted_.end(), host_depth_.begin(), host_depth_.end());
    std::sort(sorted_.begin(), sorted_.end());
    // Chains within the tolerance are one node, as in the host.
    merged_.clear();
    for (std::size_t n = 0; n < sorted_.size(); ++n)
      if (n == 0 || sorted_[n] - sorted_[n - 1] > pillar_merge_tolerance) merged_.push_back(sorted_[n]);
    std::size_t next = 0;
    for (const std::int32_t t : touches) {
      const std::size_t levels = out_.ranks(t).size();
      std::int32_t* rank = out_.rank.data() + out_.touches[static_cast<std::size_t>(t)].first_rank;
      for (std::size_t l = 0; l < levels; ++l)
        rank[l] = static_cast<std::int32_t>(std::upper_bound(merged_.begin(), merged_.end(), depth_[next++]) -
                                            merged_.begin() - 1);
    }
    for (const double depth : merged_) add_node(touches.front(), depth, first_of_host);
    out_.first_node.emplace_back(out_.nodes.size());
  }

  void add_node(std::int32_t touch, double depth, VertexId first_of_host) {
    const auto known = std::lower_bound(host_depth_.begin(), host_depth_.end(), depth);
    if (known != host_depth_.end() && *known == depth) {
      const VertexId vertex(first_of_host.value() + (known - host_depth_.begin()));
      out_.nodes.push_back(host_.vertices[vertex]);
      out_.host_vertex.push_back(vertex);
      return;
    }
    Vec3 point = out_.on_pillar(grid_, host_, touch, depth);
    point.z() = depth;
    out_.nodes.push_back(point);
    out_.host_vertex.push_back(VertexId{});
  }

  const CornerPointGrid& grid_;
  const HostMesh& host_;
  const RefinementPlan& plan_;
  const std::vector<std::uint8_t>& is_refined_;
  RefinementLattice out_;
  std::vector<std::int32_t> by_j_;  ///< pillars ordered by j, then i
  std::size_t levels_ = 0;
  // Of one pillar:
  std::vector<double> host_depth_;
  std::vector<double> depth_;
  std::vector<double> sorted_;
  std::vector<double> merged_;
};

}  // namespace

std::size_t RefinementLattice::strip_between(std::int32_t touch, std::int32_t next, ColumnSide side) const {
  const auto a = static_cast<std::size_t>(touches[static_cast<std::size_t>(touch)].pillar);
  const auto b = static_cast<std::size_t>(touches[static_cast<std::size_t>(next)].pillar);
  if (side == ColumnSide::east || side == ColumnSide::west) return std::min(a, b);
  return pillars.size() + static_cast<std::size_t>(std::min(along_j[a], along_j[b]));
}

std::array<double, 2> RefinementLattice::place_in(const LatticeColumn& column, const LatticePoint& point) const {
  std::array<double, 2> out{};
  for (std::size_t a = 0; a < 2; ++a)
    out[a] = static_cast<double>(point[a] - column.source[a] * unit[a]) / static_cast<double>(unit[a]);
  return out;
}

Vec3 RefinementLattice::on_pillar(const CornerPointGrid& grid, const HostMesh& host, std::int32_t touch,
                                  double depth) const {
  const PillarTouch& at = touches[static_cast<std::size_t>(touch)];
  const LatticeColumn& column = columns[static_cast<std::size_t>(at.column)];
  const auto [s, t] = place_in(column, pillars[static_cast<std::size_t>(at.pillar)]);
  return ColumnShape(grid, host, column.source[0], column.source[1]).on_line(s, t, depth);
}

RefinementLattice make_lattice(const CornerPointGrid& grid, const HostMesh& host, const RefinementPlan& plan,
                               const std::vector<std::uint8_t>& is_refined) {
  return LatticeBuilder(grid, host, plan, is_refined).build();
}

}  // namespace wellknit
