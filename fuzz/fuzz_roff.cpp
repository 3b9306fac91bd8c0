// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A ROFF file, binary or ASCII, of any bytes either reads as a valid grid or ends in ParseError.
#include <cstddef>
#include <cstdint>

#include "fuzz/grid_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  if (bytes.substr(0, 5) != "roff-") return -1;
  wellknit::fuzz_grid_file(bytes);
  return 0;
}
