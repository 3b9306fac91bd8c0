// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The grid of Eclipse and its successors: one set of pillars and depths (docs/formats/egrid.md).
#pragma once

#include <string>
#include <string_view>

#include "readers/grid_part.h"

namespace wellknit {

/// Content that begins with FILEHEAD: EGRID, or its formatted twin FEGRID.
bool looks_like_egrid(std::string_view bytes);

/// COORD, ZCORN, ACTNUM and the frame of a corner-point grid. Throws ParseError; local refinements, dual media, radial
/// and unstructured grids are refused.
GridPart parse_egrid(std::string_view bytes, const std::string& path);

}  // namespace wellknit
