// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Static properties from the INIT file that a simulator writes (docs/formats/egrid.md).
#pragma once

#include <string>
#include <string_view>

#include "readers/grid_part.h"

namespace wellknit {

/// Content that begins with INTEHEAD: INIT, or its formatted twin FINIT.
bool looks_like_init(std::string_view bytes);

/// Units, dimensions, and every array that the reader knows, on active or on all cells. The simulator's own results
/// (pore volumes, transmissibilities, sizes of cells) are named in a note. Throws ParseError.
GridPart parse_init(std::string_view bytes, const std::string& path);

}  // namespace wellknit
