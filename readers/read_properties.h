// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Properties on a grid that is known already: one value a cell, without geometry (docs/commands/map.md).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "model/case.h"

namespace wellknit {

struct PropertyFile {
  std::map<std::string, CellProperty> properties;  ///< `cells` values each, in the units of the file; NaN: defaulted
  SourceFile source;
  std::vector<std::string> notes;  ///< what was passed over
};

/// GRDECL text, or a file of any binary grid format. Keywords of regions give integers, all others real numbers, known
/// or not. Throws ParseError when the file cannot be read, when a keyword for cells has another number of values than
/// `cells`, for INCLUDE, and when there is no property in it at all.
PropertyFile read_properties(const std::string& path, std::int64_t cells);

}  // namespace wellknit
