// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// read_case from any store of files: for tests and fuzzers, which read from memory.
#pragma once

#include <string>
#include <vector>

#include "model/case.h"
#include "readers/deck_stream.h"
#include "readers/file_content.h"

namespace wellknit {

/// As read_case. Throws ParseError.
Case parse_case(FileStore& files, const std::string& path, const std::vector<std::string>& grid_includes = {},
                const DeckLimits& limits = {});

}  // namespace wellknit
