// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// RMS well: version, type, name and head, logs, then rows X Y depth logs; several wells may stand one after another
/// (docs/formats/trajectories.md).
#pragma once

#include <string>
#include <string_view>

#include "readers/read_trajectory.h"

namespace wellknit {

bool looks_like_rms_well(std::string_view text);

/// The wells in this text; the path is for messages and for names the text leaves out. Throws ParseError.
TrajectoryFile parse_rms_well(std::string_view text, const std::string& path, const TrajectoryOptions& options = {});

}  // namespace wellknit
