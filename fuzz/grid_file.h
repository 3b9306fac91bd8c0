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
#include "tests/readers/ecl_files.h"

namespace wellknit {

inline void require(bool holds) {
  if (!holds) std::abort();
}

/// Either reads as a valid grid or ends in ParseError of one line.
inline void fuzz_grid_file(const std::string& bytes) {
  DeckLimits limits;
  limits.free_values = 100'000;
  limits.free_steps = 1'000'000;
  limits.hashes_sources = false;
  // In binary: what reads text uses several threads, and they would take the fuzzer's time.
  static const std::string grid = ecl::two_boxes();
  for (const bool is_include : {false, true}) {
    MemoryFiles files({{"case.EGRID", bytes}, {"grid", grid}, {"case.INIT", bytes}});
    try {
      const Case read =
          is_include ? parse_case(files, "grid", {"case.EGRID"}, limits) : parse_case(files, "case.EGRID", {}, limits);
      validate(read.grid);
      FileDescription description;
      description.path = "f";
      description.format = "f";
      description.grid = describe(read.grid);
      description.notes = read.notes;
      (void)to_json(description);
    } catch (const ParseError& error) {
      require(std::string_view(error.what()).find('\n') == std::string_view::npos);
    }
  }
}

}  // namespace wellknit
