// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Where the cells of the source grid are in the mesh.
#pragma once

#include <optional>
#include <vector>

#include "model/corner_point_grid.h"
#include "model/mesh.h"
#include "writers/deck_grid.h"

namespace wellknit {

/// A mesh cell and its share of something; shares of one thing add up to 1.
struct CellShare {
  CellId cell;
  double share = 1.0;
};

class SourceCells {
 public:
  /// References must outlive this.
  SourceCells(const CornerPointGrid& grid, const Mesh& mesh, const DeckGrid& deck_grid);

  /// The mesh's cell that the source cell is, unchanged; nothing where it is inactive or was refined or replaced.
  [[nodiscard]] std::optional<CellId> whole(HostCellId source) const { return whole_[source.index()]; }
  /// The active cells in it, by their shares of its volume; those below a hundredth are left out beside larger ones.
  /// Empty for an inactive cell.
  [[nodiscard]] std::vector<CellShare> parts(HostCellId source) const;
  /// Depth as simulators take it: the mean of the corners, m.
  [[nodiscard]] double depth(HostCellId source) const;

 private:
  const CornerPointGrid& grid_;
  const Mesh& mesh_;
  const DeckGrid& deck_grid_;
  std::vector<std::optional<CellId>> whole_;
};

}  // namespace wellknit
