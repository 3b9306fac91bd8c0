// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The comment `# head [WELL] X Y KB [m|ft]` that gives a survey its beginning.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "readers/read_trajectory.h"

namespace wellknit {

/// Heads by well; the empty name is for all wells that have none of their own.
using WellHeads = std::map<std::string, WellHead>;

/// Takes the line when it is such a comment. Throws ParseError when it begins as one and its numbers are not there.
void take_head_line(std::string_view line, const std::string& path, std::int64_t number, WellHeads& heads);

/// The head of this well, or the one for all, or an empty one.
WellHead head_for(const WellHeads& heads, const std::string& well);

}  // namespace wellknit
