// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A deck or a bare grid file in, a Case out (docs/formats/grdecl.md).
#pragma once

#include <string>
#include <vector>

#include "model/case.h"

namespace wellknit {

/// Reads CASE (a .DATA deck or a .GRDECL file, told by content) and then each further GRDECL file in order.
/// Throws ParseError; see docs/formats/grdecl.md for what is read.
Case read_case(const std::string& path, const std::vector<std::string>& grid_includes = {});

}  // namespace wellknit
