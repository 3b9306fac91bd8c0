// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The source cells that a trajectory passes through.
#pragma once

#include <vector>

#include "algorithm/cell_locator.h"
#include "model/well.h"

namespace wellknit {

/// A straight part of a trajectory inside one source cell, active or not.
struct CellPart {
  HostCellId cell;
  MeasuredDepthRange measured_depth;  ///< m
  Vec3 entry;                         ///< m
  Vec3 exit;
};

/// The parts in the order of measured depth, ends exact to about 1e-6 m. A cell has several where the trajectory bends
/// inside it or comes back. Stretches outside of the grid and in gaps have none; a gap's far side is searched for in
/// steps of a quarter of the mean cell thickness, or of a 20,000th of the way through the grid where that is longer, so
/// a thinner cell between two gaps may be passed over.
std::vector<CellPart> cells_along(const CornerPointGrid& grid, const CellLocator& locator,
                                  const Trajectory& trajectory);

}  // namespace wellknit
