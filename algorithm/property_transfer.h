// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Properties of made cells from the source cells that they replace (method.md §11).
#pragma once

#include "algorithm/assembly.h"
#include "algorithm/cell_locator.h"

namespace wellknit {

/// Fills the mesh's transfer map and all cell properties. Overlap volumes are sampled in the real space and balanced so
/// that each source cell gives away all of its volume and each made cell is filled: pore volume is conserved to
/// rounding in every source cell. Parallel over cells; the result does not depend on it.
void transfer_properties(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator,
                         const std::vector<TransitionMesh>& cavities, Assembly& assembly);

}  // namespace wellknit
