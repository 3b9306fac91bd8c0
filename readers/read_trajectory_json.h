// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// ResInsight's well paths in JSON: {name, datumElevation, path: [{east, north, tvd, md}]}, one or a list of them
/// (docs/formats/trajectories.md).
#pragma once

#include <string>
#include <string_view>

#include "readers/read_trajectory.h"

namespace wellknit {

bool looks_like_json_wells(std::string_view text);

/// The wells in this text; the path is for messages and for names the text leaves out. Throws ParseError.
TrajectoryFile parse_json_wells(std::string_view text, const std::string& path, const TrajectoryOptions& options = {});

}  // namespace wellknit
