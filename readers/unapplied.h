// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What is read and carried, or only recognised, and has no effect on the mesh yet.
#pragma once

#include <cstdint>
#include <string>

#include "readers/deck_stream.h"

namespace wellknit {

/// One note for this keyword: that it is read and not applied to what it changes. Nothing for a keyword that is
/// applied.
void note_not_applied(DeckStream& stream, const std::string& keyword, std::int64_t line);

}  // namespace wellknit
