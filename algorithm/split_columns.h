// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The whole grid in finer columns, without meshes around wells: what a hybrid mesh is compared with
/// (docs/algorithms/refinement.md).
#pragma once

#include "algorithm/well_mesher.h"

namespace wellknit {

/// Every column in parts x parts; layers stay. Throws InvalidInput where that makes too many cells to be numbered.
RefinementPlan uniform_refinement(const CornerPointGrid& grid, int parts);

/// That plan, and wells without tubes: they are connected by Peaceman's index in the parts that they run through.
/// Throws InvalidInput when a well does not meet the grid.
MeshedWells split_columns(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator,
                          const std::vector<Well>& wells, int parts);

}  // namespace wellknit
