// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A deck or a grid file in, a Case out (docs/formats/grdecl.md, and a page for each binary format).
#pragma once

#include <string>
#include <vector>

#include "model/case.h"

namespace wellknit {

/// Reads CASE (a deck or a grid file of any format, told by content) and then each further grid file in order. The
/// INIT file beside an EGRID or GRID file is read after it, unless an INIT file is among the further ones; a note says
/// so. Throws ParseError; see docs/formats for what is read.
Case read_case(const std::string& path, const std::vector<std::string>& grid_includes = {});

}  // namespace wellknit
