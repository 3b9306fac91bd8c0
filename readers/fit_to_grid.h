// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A well in map coordinates beside a grid in its own: MAPAXES says how the two lie.
#pragma once

#include <optional>
#include <string>

#include "model/corner_point_grid.h"
#include "model/well.h"

namespace wellknit {

/// Puts the well's path in the grid's frame when it only fits so: as it is, it misses the box around the grid's pillars
/// in plan altogether, and turned by the inverse of MAPAXES it meets it. Depth and measured depth stay. Returns what
/// was done; or, when the path misses the box either way, that it does; or nothing.
std::optional<std::string> fit_to_grid(Well& well, const CornerPointGrid& grid);

}  // namespace wellknit
