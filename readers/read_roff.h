// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// ROFF, the grid and parameter files of RMS (docs/formats/roff.md).
#pragma once

#include <string>
#include <string_view>

#include "readers/grid_part.h"

namespace wellknit {

/// Content that begins with roff-bin or roff-asc.
bool looks_like_roff(std::string_view bytes);

/// Grid, parameters, or both. Layers are turned over, so that k runs down. Throws ParseError.
GridPart parse_roff(std::string_view bytes, const std::string& path);

}  // namespace wellknit
