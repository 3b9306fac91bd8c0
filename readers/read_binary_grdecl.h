// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// GRDECL keywords in binary records, as geomodellers export them (docs/formats/egrid.md).
#pragma once

#include <string>
#include <string_view>

#include "readers/grid_part.h"

namespace wellknit {

/// Content that begins with the header of any array, in either byte order or formatted.
bool looks_like_binary_grdecl(std::string_view bytes);

/// SPECGRID or DIMENS, COORD, ZCORN, the frame, and arrays of cells. Throws ParseError.
GridPart parse_binary_grdecl(std::string_view bytes, const std::string& path);

}  // namespace wellknit
