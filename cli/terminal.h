// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What a terminal can do that a log cannot: colours, and a line that is written over.
#pragma once

#include <cstdint>
#include <string>

namespace wellknit {

enum class Stream : std::uint8_t { output, error };
enum class Ink : std::uint8_t { good, watch, poor };

bool is_terminal(Stream stream);
/// On a terminal, unless NO_COLOR is set to something or TERM is "dumb" (no-color.org).
bool has_colours(Stream stream);
/// The text in this colour, or as it is where there are none.
std::string painted(const std::string& text, Ink ink, Stream stream);

}  // namespace wellknit
