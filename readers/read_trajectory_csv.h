// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// CSV: a header naming the columns in any order, X Y and a depth or MD INC AZI (docs/formats/trajectories.md).
#pragma once

#include <string>
#include <string_view>

#include "readers/read_trajectory.h"

namespace wellknit {

bool looks_like_trajectory_csv(std::string_view text);

/// The wells in this text; the path is for messages and for names the text leaves out. Throws ParseError.
TrajectoryFile parse_trajectory_csv(std::string_view text, const std::string& path,
                                    const TrajectoryOptions& options = {});

}  // namespace wellknit
