// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The cells of the finished mesh that a well is open to: radial cells along its tube, host cells by Peaceman's index,
/// transition cells where the well runs through the cavity beyond its tube's ends.
#pragma once

#include <memory>
#include <vector>

#include "algorithm/assembly.h"
#include "algorithm/cell_locator.h"
#include "model/well.h"

namespace wellknit {

struct WellConnections {
  std::vector<WellConnection> all;  ///< each cell once, in the order of measured depth within each kind
  std::int64_t by_index = 0;        ///< of these, host and transition cells
};

/// Connects one well after the other. Where it `computes_all`, factors that a deck gives for whole cells do not count:
/// the cells are parts of them.
/// Needs the mesh's permeabilities and transfer map; all references must outlive it.
class WellConnector {
 public:
  WellConnector(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator, const Assembly& assembly,
                bool computes_all = false);
  ~WellConnector();
  WellConnector(const WellConnector&) = delete;
  WellConnector& operator=(const WellConnector&) = delete;

  /// Throws InvalidInput where the bore is too wide, or the skin too low, for a cell.
  [[nodiscard]] WellConnections connect(std::size_t well_index, const Well& well);

 private:
  class MadeCells;
  const CornerPointGrid& grid_;
  const HostMesh& host_;
  const CellLocator& locator_;
  const Assembly& assembly_;
  bool computes_all_;
  std::unique_ptr<MadeCells> made_cells_;
};

}  // namespace wellknit
