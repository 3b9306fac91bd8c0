// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/deck_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

namespace wellknit {

namespace {

constexpr std::size_t longest_line = 128;  // the simulators' own limit
constexpr std::size_t longest_name = 8;

// The locale must not decide what a letter is.
bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
bool is_name_character(char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '-' || c == '_'; }

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return text;
}

std::string plain_name(const std::string& name) {
  std::string out;
  for (const char c : name) out += is_name_character(c) ? c : '_';
  if (out.empty() || !is_letter(out.front())) out.insert(out.begin(), 'W');
  return out.substr(0, longest_name);
}

}  // namespace

void write_deck_array(std::ostream& out, std::string_view keyword, std::span<const double> values) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "{}\n", keyword);
  std::size_t line_start = text.size();
  for (std::size_t i = 0; i < values.size();) {
    std::size_t end = i + 1;
    while (end < values.size() && values[end] == values[i]) ++end;
    const std::string token = end - i > 1 ? fmt::format(" {}*{}", end - i, values[i]) : fmt::format(" {}", values[i]);
    if (text.size() - line_start + token.size() > longest_line) {
      text.push_back('\n');
      line_start = text.size();
    }
    text.append(token);
    i = end;
  }
  text.append(std::string_view("\n/\n"));
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

void write_deck_comment(std::ostream& out, std::string_view text) {
  std::string line = "-- " + std::string(text.substr(0, longest_line - 3));
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ') c = '?';
  out << line << '\n';
}

std::vector<std::string> deck_well_names(const std::vector<std::string>& names) {
  std::vector<std::string> out(names.size());
  std::set<std::string> taken;
  // Names that fit keep their place before any shortened one can take it.
  for (std::size_t i = 0; i < names.size(); ++i)
    if (plain_name(names[i]) == names[i] && taken.insert(upper(names[i])).second) out[i] = names[i];
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!out[i].empty()) continue;
    out[i] = plain_name(names[i]);
    for (int n = 2; !taken.insert(upper(out[i])).second; ++n) {
      const std::string suffix = fmt::format("_{}", n);
      out[i] = plain_name(names[i]).substr(0, longest_name - suffix.size()) + suffix;
    }
  }
  return out;
}

}  // namespace wellknit
