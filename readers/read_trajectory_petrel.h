// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Petrel well trace: comments with name, head and datum, a row of column names, then numbers
/// (docs/formats/trajectories.md).
#pragma once

#include <string>
#include <string_view>

#include "readers/read_trajectory.h"

namespace wellknit {

bool looks_like_petrel_trace(std::string_view text);

/// The well in this text; the path is for messages and for a name the text leaves out. Throws ParseError.
TrajectoryFile parse_petrel_trace(std::string_view text, const std::string& path,
                                  const TrajectoryOptions& options = {});

}  // namespace wellknit
