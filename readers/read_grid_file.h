// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The older grid file of Eclipse: eight corners for every cell (docs/formats/egrid.md).
#pragma once

#include <string>
#include <string_view>

#include "readers/grid_part.h"

namespace wellknit {

/// Content that begins with DIMENS: GRID, or its formatted twin FGRID.
bool looks_like_grid_file(std::string_view bytes);

/// Pillars and depths are made of the cells' corners. Throws ParseError when the corners at a pillar do not lie on one
/// line, when local refinements are there, and for radial grids. Cells that are not in the file become inactive.
GridPart parse_grid_file(std::string_view bytes, const std::string& path);

}  // namespace wellknit
