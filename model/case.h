// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// All that was read for one run.
#pragma once

#include <string>
#include <vector>

#include "model/corner_point_grid.h"
#include "model/well.h"

namespace wellknit {

/// An input file and what identifies its content.
struct SourceFile {
  std::string path;    ///< as the user or the INCLUDE gave it
  std::string sha256;  ///< 64 hexadecimal digits
};

struct Case {
  CornerPointGrid grid;
  std::vector<Well> deck_wells;     ///< WELSPECS and COMPDAT, in the deck's order
  std::vector<SourceFile> sources;  ///< in the order of reading, each once
  std::vector<std::string>
      notes;  ///< one sentence each: what was mended, ignored or not understood, with file and line
};

}  // namespace wellknit
