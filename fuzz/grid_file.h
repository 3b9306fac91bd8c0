// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// For fuzzers of grid files: bytes as CASE, and as a further file beside a grid of two cells.
#pragma once

#include <cstdlib>
#include <string>
#include <string_view>

#include "model/errors.h"
#include "readers/describe.h"
#include "readers/parse_case.h"

namespace wellknit {

inline void require(bool holds) {
  if (!holds) std::abort();
}

/// Two boxes of 1 m, both active.
inline constexpr std::string_view two_boxes =
    "SPECGRID\n 2 1 1 1 F /\nCOORD\n 0 0 0 0 0 1 1 0 0 1 0 1 2 0 0 2 0 1\n 0 1 0 0 1 1 1 1 0 1 1 1 2 1 0 2 1 1 /\n"
    "ZCORN\n 8*0 8*1 /\nACTNUM\n 1 1 /\n";

/// Either reads as a valid grid or ends in ParseError of one line.
inline void fuzz_grid_file(const std::string& bytes) {
  DeckLimits limits;
  limits.free_values = 100'000;
  limits.free_steps = 1'000'000;
  for (const bool is_include : {false, true}) {
    MemoryFiles files({{"case.EGRID", bytes}, {"grid", std::string(two_boxes)}, {"case.INIT", bytes}});
    try {
      const Case read =
          is_include ? parse_case(files, "grid", {"case.EGRID"}, limits) : parse_case(files, "case.EGRID", {}, limits);
      validate(read.grid);
      (void)to_json({"f", "f", describe(read.grid), {}, {}, {}, read.notes});
    } catch (const ParseError& error) {
      require(std::string_view(error.what()).find('\n') == std::string_view::npos);
    }
  }
}

}  // namespace wellknit
