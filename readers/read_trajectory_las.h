// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// LAS 1.2, 2.0 and simple 3.0 files that hold a deviation: DEPT with DEVI and AZIM, or X, Y and TVD
/// (docs/formats/trajectories.md).
#pragma once

#include <string>
#include <string_view>

#include "readers/read_trajectory.h"

namespace wellknit {

bool looks_like_las(std::string_view text);

/// The well in this text; the path is for messages and for a name the text leaves out. Throws ParseError.
TrajectoryFile parse_las(std::string_view text, const std::string& path, const TrajectoryOptions& options = {});

}  // namespace wellknit
