// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Each source column that a demand or the grading reaches is the root of a binary tree: a node is halved along i or
// along j. Sizes are powers of two and columns stand at multiples of their size, so halving reaches every demanded one.

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>
#include <tuple>
#include <utility>

#include "algorithm/host_refinement.h"
#include "model/errors.h"

namespace wellknit {

namespace {

constexpr std::int32_t no_node = -1;
constexpr std::int32_t no_layers = -1;

/// A rectangle of the lattice, half open.
struct Box {
  LatticePoint low{};
  LatticePoint high{};
  friend bool operator==(const Box&, const Box&) = default;

  [[nodiscard]] std::int64_t extent(std::size_t axis) const { return high[axis] - low[axis]; }
  [[nodiscard]] bool meets(const Box& other) const {
    return low[0] < other.high[0] && other.low[0] < high[0] && low[1] < other.high[1] && other.low[1] < high[1];
  }
  [[nodiscard]] Box half(std::size_t axis, bool second) const {
    Box out = *this;
    (second ? out.low : out.high)[axis] = low[axis] + extent(axis) / 2;
    return out;
  }
};

struct DemandedColumn {
  Box box;
  std::int32_t layers = 0;
  friend bool operator==(const DemandedColumn&, const DemandedColumn&) = default;
};

struct Node {
  Box box;
  std::int32_t first_child = no_node;  ///< the second one follows it
  std::int32_t layers = no_layers;     ///< of a demanded column
};

bool is_power_of_two(std::int64_t n) { return n > 0 && (n & (n - 1)) == 0; }

class Planner {
 public:
  Planner(const CornerPointGrid& grid, LatticePoint unit) : dimensions_(grid.dimensions) {
    if (!is_power_of_two(unit[0]) || !is_power_of_two(unit[1]))
      throw InvalidInput(
          fmt::format("a lattice of {} by {} parts of a column: powers of two are needed", unit[0], unit[1]));
    plan_.unit = unit;
    plan_.layers.push_back(ColumnLayers::of_source(dimensions_[2]));
  }

  RefinementPlan plan(const std::vector<RefinementDemand>& demands) {
    std::map<std::pair<std::int64_t, std::int64_t>, std::vector<DemandedColumn>> by_root;  // by j and i
    for (const RefinementDemand& demand : demands)
      for (const DemandedColumn& column : columns_of(demand)) {
        const auto root = source_of(column.box);
        by_root[{root[1], root[0]}].push_back(column);
      }
    for (const auto& [root, columns] : by_root) split(root_node({root.second, root.first}), columns);
    grade();
    collect();
    return std::move(plan_);
  }

 private:
  [[nodiscard]] std::array<std::int64_t, 2> source_of(const Box& box) const {
    return {box.low[0] / plan_.unit[0], box.low[1] / plan_.unit[1]};
  }

  std::int32_t layers_of(const ColumnLayers& layers) {
    const auto found = std::find(plan_.layers.begin(), plan_.layers.end(), layers);
    const auto at = found - plan_.layers.begin();
    if (found == plan_.layers.end()) plan_.layers.push_back(layers);
    return static_cast<std::int32_t>(at);
  }

  std::vector<DemandedColumn> columns_of(const RefinementDemand& demand) {
    const LatticePoint size = demand.size;
    for (std::size_t a = 0; a < 2; ++a)
      if (!is_power_of_two(size[a]) || size[a] > plan_.unit[a])
        throw InvalidInput(fmt::format("refined columns of size {} in columns of {} parts", size[a], plan_.unit[a]));
    const std::int32_t layers = layers_of(demand.layers);
    std::vector<DemandedColumn> out;
    for (const LatticePoint& low : demand.columns) {
      for (std::size_t a = 0; a < 2; ++a)
        if (low[a] < 0 || low[a] % size[a] != 0 || low[a] >= dimensions_[a] * plan_.unit[a])
          throw InvalidInput(
              fmt::format("a refined column of size {} cannot begin at {} of the lattice", size[a], low[a]));
      out.push_back({{low, {low[0] + size[0], low[1] + size[1]}}, layers});
    }
    return out;
  }

  std::int32_t root_node(std::array<std::int64_t, 2> source) {
    const auto [found, is_new] = roots_.try_emplace({source[1], source[0]}, static_cast<std::int32_t>(nodes_.size()));
    if (is_new) {
      const LatticePoint low{source[0] * plan_.unit[0], source[1] * plan_.unit[1]};
      nodes_.push_back({{low, {low[0] + plan_.unit[0], low[1] + plan_.unit[1]}}, no_node, no_layers});
    }
    return found->second;
  }

  void halve(std::int32_t node, std::size_t axis) {
    const Box box = nodes_[static_cast<std::size_t>(node)].box;
    nodes_[static_cast<std::size_t>(node)].first_child = static_cast<std::int32_t>(nodes_.size());
    for (const bool second : {false, true}) nodes_.push_back({box.half(axis, second), no_node, no_layers});
  }

  /// The axis to halve a node along so that no demanded column is cut: where the node is larger than all of them, the
  /// one along which it is the larger in units of their size.
  static std::size_t axis_for(const Box& box, const std::vector<DemandedColumn>& columns) {
    std::array<std::int64_t, 2> ratio{1, 1};
    std::array<bool, 2> cuts{};
    for (const DemandedColumn& column : columns)
      for (std::size_t a = 0; a < 2; ++a) {
        ratio[a] = std::max(ratio[a], box.extent(a) / column.box.extent(a));
        cuts[a] = cuts[a] || column.box.extent(a) == box.extent(a);
      }
    if (cuts[0] && cuts[1]) throw InvalidInput("refined columns of different sizes overlap");
    if (cuts[0] || cuts[1]) return cuts[0] ? 1 : 0;
    return ratio[0] >= ratio[1] ? 0 : 1;
  }

  void split(std::int32_t node, std::vector<DemandedColumn> columns) {
    if (columns.empty()) return;
    const Box box = nodes_[static_cast<std::size_t>(node)].box;
    const bool are_one = std::all_of(columns.begin(), columns.end(), [&](const auto& c) { return c == columns[0]; });
    if (are_one && columns[0].box == box) {
      nodes_[static_cast<std::size_t>(node)].layers = columns[0].layers;
      return;
    }
    if (std::all_of(columns.begin(), columns.end(), [&](const auto& c) { return c.box == box; }))
      throw InvalidInput("refined columns of different layers overlap");
    halve(node, axis_for(box, columns));
    const std::int32_t first = nodes_[static_cast<std::size_t>(node)].first_child;
    for (const std::int32_t child : {first, first + 1}) {
      std::vector<DemandedColumn> inside;
      for (const DemandedColumn& column : columns)
        if (column.box.meets(nodes_[static_cast<std::size_t>(child)].box)) inside.push_back(column);
      split(child, std::move(inside));
    }
  }

  /// Calls visit(leaf) for each leaf below a node.
  template <class Visit>
  void for_each_leaf(std::int32_t node, const Visit& visit) const {
    const Node& at = nodes_[static_cast<std::size_t>(node)];
    if (at.first_child == no_node) return visit(node);
    for_each_leaf(at.first_child, visit);
    for_each_leaf(at.first_child + 1, visit);
  }

  /// Leaves that meet a box, which lies in one source column.
  void leaves_in(std::int32_t node, const Box& box, std::vector<std::int32_t>& out) const {
    const Node& at = nodes_[static_cast<std::size_t>(node)];
    if (!at.box.meets(box)) return;
    if (at.first_child == no_node) return out.push_back(node);
    leaves_in(at.first_child, box, out);
    leaves_in(at.first_child + 1, box, out);
  }

  /// The leaves beside a leaf, unrefined source columns among them.
  void neighbors(std::int32_t leaf, std::vector<std::int32_t>& out) {
    out.clear();
    const Box box = nodes_[static_cast<std::size_t>(leaf)].box;
    for (std::size_t axis = 0; axis < 2; ++axis)
      for (const bool beyond : {false, true}) {
        Box strip = box;  // one part wide, beyond the side
        strip.low[axis] = beyond ? box.high[axis] : box.low[axis] - 1;
        strip.high[axis] = strip.low[axis] + 1;
        if (strip.low[axis] < 0 || strip.high[axis] > dimensions_[axis] * plan_.unit[axis]) continue;
        leaves_in(root_node(source_of(strip)), strip, out);
      }
  }

  /// Halves what is more than twice as large as a leaf beside it. Demanded columns stay as they are.
  void grade() {
    std::deque<std::int32_t> open;
    std::vector<std::int32_t> roots;
    for (const auto& [source, root] : roots_) roots.push_back(root);
    for (const std::int32_t root : roots) for_each_leaf(root, [&](std::int32_t leaf) { open.push_back(leaf); });
    std::vector<std::int32_t> beside;
    while (!open.empty()) {
      const std::int32_t leaf = open.front();
      open.pop_front();
      if (nodes_[static_cast<std::size_t>(leaf)].first_child != no_node) continue;
      neighbors(leaf, beside);
      bool again = false;
      for (const std::int32_t other : beside) again = halve_if_large(leaf, other, open) || again;
      if (again) open.push_back(leaf);
    }
  }

  bool halve_if_large(std::int32_t leaf, std::int32_t other, std::deque<std::int32_t>& open) {
    const Node& at = nodes_[static_cast<std::size_t>(other)];
    if (at.first_child != no_node || at.layers != no_layers) return false;
    const Box& small = nodes_[static_cast<std::size_t>(leaf)].box;
    for (std::size_t axis = 0; axis < 2; ++axis)
      if (at.box.extent(axis) > 2 * small.extent(axis)) {
        halve(other, axis);
        const std::int32_t first = nodes_[static_cast<std::size_t>(other)].first_child;
        open.push_back(first);
        open.push_back(first + 1);
        return true;
      }
    return false;
  }

  void collect() {
    for (const auto& [source, root] : roots_) {
      const Node& top = nodes_[static_cast<std::size_t>(root)];
      if (top.first_child == no_node && top.layers <= 0) continue;
      const std::size_t begin = plan_.columns.size();
      for_each_leaf(root, [&](std::int32_t leaf) {
        const Node& node = nodes_[static_cast<std::size_t>(leaf)];
        plan_.columns.push_back({source_of(node.box), node.box.low, node.box.high, std::max(node.layers, 0), {}});
      });
      std::sort(plan_.columns.begin() + static_cast<std::ptrdiff_t>(begin), plan_.columns.end(),
                [](const RefinedColumn& a, const RefinedColumn& b) {
                  return std::tie(a.low[1], a.low[0]) < std::tie(b.low[1], b.low[0]);
                });
    }
  }

  std::array<std::int64_t, 3> dimensions_;
  RefinementPlan plan_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::int32_t> roots_;  ///< by source column j and i
  std::vector<Node> nodes_;
};

}  // namespace

ColumnLayers ColumnLayers::of_source(std::int64_t places) {
  ColumnLayers out;
  out.cells.reserve(static_cast<std::size_t>(places));
  for (std::int64_t place = 0; place < places; ++place) out.cells.push_back({{place, 0.0}, {place, 1.0}});
  return out;
}

RefinementPlan plan_refinement(const CornerPointGrid& grid, const HostMesh& /*host*/, LatticePoint unit,
                               const std::vector<RefinementDemand>& demands) {
  return Planner(grid, unit).plan(demands);
}

}  // namespace wellknit
