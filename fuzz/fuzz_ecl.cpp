// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// An Eclipse file of arrays (EGRID, GRID, INIT, binary GRDECL) in any of its forms of any bytes either reads as a
/// valid grid or ends in ParseError.
#include <cstddef>
#include <cstdint>

#include "fuzz/grid_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  wellknit::fuzz_grid_file(bytes);
  return 0;
}
