// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// read_trajectory from text in memory: for tests and fuzzers.
#pragma once

#include <string>
#include <string_view>

#include "readers/read_trajectory.h"

namespace wellknit {

/// As read_trajectory; the path is for messages, the extension and names that the text leaves out. Throws ParseError.
TrajectoryFile parse_trajectory(std::string_view text, const std::string& path, const TrajectoryOptions& options = {});

}  // namespace wellknit
