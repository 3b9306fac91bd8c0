// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A path for a well of which only the completed cells are known.
#pragma once

#include "model/corner_point_grid.h"
#include "model/well.h"

namespace wellknit {

/// Sets the trajectory and the open ranges from the well's completions (one or more, in flow order; those of a single
/// column are put in order of k). The path goes through the cells' centres (mean of eight corners), from the face where
/// it enters the first cell to the face where it leaves the last, along those completions' directions; one cell is
/// crossed straight from face to face. Measured depth is arc length. With no open completion `open` holds one range of
/// no length. False when the path has no length.
bool set_path_through_cells(const CornerPointGrid& grid, Well& well);

}  // namespace wellknit
