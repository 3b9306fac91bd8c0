// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Values of numbered cells or faces of a mesh file, as text (docs/commands/solve.md, docs/commands/map.md).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/case.h"

namespace wellknit {

struct ValueTable {
  std::string index_title;  ///< lower case: "cell" or "face"; empty: no header, one value a line in the mesh's order
  std::string value_title;  ///< as the header has it; empty without one
  std::vector<std::int64_t> index;  ///< 0 or more
  std::vector<double> value;        ///< finite
  SourceFile source;
};

/// A header `cell,NAME` or `face,NAME` and rows of an index and a number; or numbers alone, one a line. Separators are
/// ',', ';', a tab or blanks; empty lines, and lines that begin with '#' or "--", are passed over. Throws ParseError.
ValueTable read_value_table(const std::string& path);
/// The same from a text in memory.
ValueTable parse_value_table(std::string_view text, const std::string& path);

}  // namespace wellknit
