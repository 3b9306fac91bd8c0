// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// WITSML trajectories: Trajectory of 2.x, trajectorys of 1.4.1.1 (docs/formats/trajectories.md).
#pragma once

#include <string>
#include <string_view>

#include "readers/read_trajectory.h"

namespace wellknit {

bool looks_like_witsml(std::string_view text);

/// The wells in this text; the path is for messages and for a name the text leaves out. Throws ParseError.
TrajectoryFile parse_witsml(std::string_view text, const std::string& path, const TrajectoryOptions& options = {});

}  // namespace wellknit
