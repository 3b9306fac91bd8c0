// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/terminal.h"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <string_view>

namespace wellknit {

namespace {

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

}  // namespace

bool is_terminal(Stream stream) { return ::isatty(stream == Stream::output ? STDOUT_FILENO : STDERR_FILENO) == 1; }

bool has_colours(Stream stream) {
  return is_terminal(stream) && environment("NO_COLOR").empty() && environment("TERM") != "dumb";
}

std::string painted(const std::string& text, Ink ink, Stream stream) {
  static constexpr std::array<const char*, 3> codes{"\033[32m", "\033[33m", "\033[31m"};
  if (!has_colours(stream)) return text;
  return codes[static_cast<std::size_t>(ink)] + text + "\033[0m";
}

}  // namespace wellknit
