// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// First step of a refinement: the refined columns, the unrefined ones beside them, the pillars at all their corners,
/// and the nodes on these pillars. Where a smaller column's corner lies on the side of a larger one, the larger one's
/// levels have nodes there too.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithm/column_shape.h"
#include "algorithm/host_refinement.h"

namespace wellknit {

/// Sides of a column, round it from south-west: low j, high i, high j, low i.
enum class ColumnSide : std::uint8_t { south = 0, east = 1, north = 2, west = 3 };
inline constexpr std::array<ColumnSide, 4> column_sides{ColumnSide::south, ColumnSide::east, ColumnSide::north,
                                                        ColumnSide::west};
/// Step to the neighbour beyond a side.
constexpr std::array<std::int64_t, 2> step_over(ColumnSide side) {
  constexpr std::array<std::array<std::int64_t, 2>, 4> steps{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
  return steps[static_cast<std::size_t>(side)];
}

/// The levels of one column on one pillar.
struct PillarTouch {
  std::int32_t column = 0;
  std::int32_t pillar = 0;
  std::size_t first_rank = 0;  ///< in RefinementLattice::rank
};

struct LatticeColumn {
  std::array<std::int64_t, 2> source{};
  LatticePoint low{};
  LatticePoint high{};
  const ColumnLayers* layers = nullptr;
  bool is_refined = false;
  /// Touches along each side from corner to corner, going round as ColumnSide does: [begin, end) in side_touches.
  /// Sides of an unrefined column that no refined one is beside have none.
  std::array<std::size_t, 4> side_begin{};
  std::array<std::size_t, 4> side_end{};
};

/// The strip between two pillars that follow each other along a side. Like Strip: p to q and then down turns
/// right-handed about the axis from side 0 to side 1, where i, j, depth are right-handed.
struct LatticeStrip {
  struct Side {
    std::int32_t column = -1;  ///< none: the grid ends here
    std::int32_t touch_p = 0;
    std::int32_t touch_q = 0;
  };
  Axis axis = Axis::i;
  std::array<Side, 2> sides;

  [[nodiscard]] bool exists() const { return sides[0].column >= 0 || sides[1].column >= 0; }
};

struct RefinementLattice {
  std::vector<LatticeColumn> columns;  ///< the plan's, then unrefined ones
  std::vector<LatticePoint> pillars;   ///< rising
  std::vector<PillarTouch> touches;
  std::vector<std::int32_t> side_touches;
  std::vector<LatticeStrip> strips;
  std::vector<std::int32_t> rank;                 ///< of a column's levels, counted from a pillar's uppermost node
  std::vector<VertexId> first_node{VertexId(0)};  ///< of each pillar, and the end
  IdVector<VertexId, Vec3> nodes;                 ///< pillar by pillar, downwards
  /// For each node the host's vertex at its place; none: it is new.
  IdVector<VertexId, VertexId> host_vertex;
  /// The pillar's number in the host (HostCorners::first), for each pillar; -1: it has none.
  std::vector<std::int64_t> host_pillar;

  [[nodiscard]] std::span<const std::int32_t> side(std::int32_t column, ColumnSide side) const {
    const LatticeColumn& at = columns[static_cast<std::size_t>(column)];
    const auto s = static_cast<std::size_t>(side);
    return {side_touches.data() + at.side_begin[s], at.side_end[s] - at.side_begin[s]};
  }
  /// Ranks of a column's levels, two a cell.
  [[nodiscard]] std::span<const std::int32_t> ranks(std::int32_t touch) const {
    const PillarTouch& at = touches[static_cast<std::size_t>(touch)];
    return {rank.data() + at.first_rank, 2 * columns[static_cast<std::size_t>(at.column)].layers->cells.size()};
  }
  [[nodiscard]] VertexId node(std::int32_t touch, std::size_t level) const {
    const auto pillar = static_cast<std::size_t>(touches[static_cast<std::size_t>(touch)].pillar);
    return VertexId(first_node[pillar].value() + ranks(touch)[level]);
  }
  /// The strip between two touches of a side that follow each other.
  [[nodiscard]] std::size_t strip_between(std::int32_t touch, std::int32_t next, ColumnSide side) const;
  /// The point at a depth on a pillar.
  [[nodiscard]] Vec3 on_pillar(const CornerPointGrid& grid, const HostMesh& host, std::int32_t touch,
                               double depth) const;
  /// Place of a lattice point in a column's source column, each in [0, 1].
  [[nodiscard]] std::array<double, 2> place_in(const LatticeColumn& column, const LatticePoint& point) const;

  LatticePoint unit{1, 1};
  std::vector<std::int32_t> along_j;  ///< place of each pillar when they are ordered by j first
};

/// `is_refined` has an element i + nx j for each source column. Throws InvalidInput when the plan's columns do not
/// cover their source columns.
RefinementLattice make_lattice(const CornerPointGrid& grid, const HostMesh& host, const RefinementPlan& plan,
                               const std::vector<std::uint8_t>& is_refined);

}  // namespace wellknit
