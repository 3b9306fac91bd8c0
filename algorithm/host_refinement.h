// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Local refinement of the host (method.md §2): some columns are split along i and j into smaller columns, 2:1 graded,
/// and may have other layers than the source.
///
/// The plan view of the grid is a lattice: source column (i, j) covers [i u_i, (i+1) u_i] x [j u_j, (j+1) u_j] of it,
/// u_i and u_j powers of two.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algorithm/column_shape.h"
#include "algorithm/host_mesh.h"
#include "model/corner_point_grid.h"

namespace wellknit {

using LatticePoint = std::array<std::int64_t, 2>;

/// The cells of a refined column, downwards: each reaches from its upper to its lower level. One that lies between the
/// horizons of one place is a part (or all) of that source cell; one over several places merges them.
struct ColumnLayers {
  struct Cell {
    ColumnLevel upper;
    ColumnLevel lower;
    friend bool operator==(const Cell&, const Cell&) = default;
  };
  std::vector<Cell> cells;
  friend bool operator==(const ColumnLayers&, const ColumnLayers&) = default;

  /// The source's own layers.
  static ColumnLayers of_source(std::int64_t places);
  /// Place of a cell from the top. Throws InvalidInput when there is none that begins and ends where it does.
  [[nodiscard]] std::int64_t place_of(const Cell& cell) const;
};

/// Columns of one size and one layering that a cavity asks for. With layers other than the source's, not all of them
/// may be needed in each column: trim_layers().
struct RefinementDemand {
  LatticePoint size{1, 1};            ///< of a column in lattice units, powers of two, at most the plan's unit
  std::vector<LatticePoint> columns;  ///< lowest corners, in lattice units, multiples of size
  ColumnLayers layers;
};

struct RefinedColumn {
  std::array<std::int64_t, 2> source{};  ///< column (i, j)
  LatticePoint low{};                    ///< lattice
  LatticePoint high{};
  std::int32_t layers = 0;  ///< into RefinementPlan::layers
  HostCellId first_cell;    ///< set by refine_host(); the cell at place p below is first_cell + p
};

struct RefinementPlan {
  LatticePoint unit{1, 1};
  std::vector<ColumnLayers> layers;    ///< without repetition; [0] is the source's own
  std::vector<RefinedColumn> columns;  ///< cover every refined source column exactly; in a fixed order

  [[nodiscard]] bool empty() const { return columns.empty(); }
};

/// The smallest set of columns that holds all that the demands ask for. Neighbours along i or j differ by at most a
/// factor of two in either direction, unrefined source columns included. Around the demanded columns of layers other
/// than the source's, columns have the source's. Demanded columns are not split further, so neighbouring demands have
/// to be graded among themselves. Throws InvalidInput where demands overlap with different sizes or layers, or columns
/// do not fit the lattice.
RefinementPlan plan_refinement(const CornerPointGrid& grid, const HostMesh& host, LatticePoint unit,
                               const std::vector<RefinementDemand>& demands);

/// Which of a demand's layers a column needs: from top to base.
struct NeededLayers {
  LatticePoint low{};  ///< the column's lowest corner
  std::vector<std::uint8_t> is_needed;
};

/// Gives columns of the plan the source's layers where the layers of their demand are not needed. Parts of a layer in
/// between, beside one that is needed, grow by a factor of two with the distance to it. Columns that are not named stay
/// as they are; a column that is named twice needs what either asks for.
void trim_layers(RefinementPlan& plan, const std::vector<NeededLayers>& needed);

/// Splits the host. Afterwards
/// - host.volume, pore_volume, exists have an element for each refined cell too, after those of the source cells;
/// - host.refined tells their parents, corners and pieces, and which source cells are refined (their `exists` stays);
/// - host.faces hold no face of a refined source cell; those of refined cells are there, and the tops and bases of
///   unrefined columns beside them carry the new vertices on their edges. Faces between the same two source cells'
///   parts have is_fault as their source faces have.
/// - plan.columns[].first_cell are set.
/// Throws InvalidInput when the plan does not cover its columns, its layers are out of order, or the host is refined
/// already.
void refine_host(const CornerPointGrid& grid, RefinementPlan& plan, HostMesh& host);

}  // namespace wellknit
