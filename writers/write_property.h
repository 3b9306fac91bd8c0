// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// One property of a corner-point grid as GRDECL text.
#pragma once

#include <string>

#include "model/corner_point_grid.h"
#include "writers/output_file.h"

namespace wellknit {

/// `values`: one a cell in the grid's order. Each number is written in the shortest form that is read back the same;
/// equal ones in a row as n*value. `comment`: one line. Throws WriteError, and InvalidInput for a value that is not
/// finite or a keyword that is not 1 to 8 letters and digits, a letter first.
void write_property(const std::string& path, const std::string& keyword, const CellProperty& values,
                    const std::string& comment, Overwrite overwrite = Overwrite::refuse);

}  // namespace wellknit
