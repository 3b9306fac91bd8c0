// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Transition cells that wells are connected to by index: beyond the ends of their tubes. An index holds for a cell as
/// the mapping makes it, with its centre beside the path; moving that costs more than orthogonality there gives.
#pragma once

#include <vector>

#include "algorithm/assembly.h"
#include "model/well.h"

namespace wellknit {

/// Those whose bounding box a path passes outside of its well's tubes, in steps of a tenth of the drainage radius:
/// these and some beside them. Rising. Before the transfer map is there.
std::vector<CellId> transition_cells_on_paths(const Assembly& assembly, const std::vector<Well>& wells);

}  // namespace wellknit
