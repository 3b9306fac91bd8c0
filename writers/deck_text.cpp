// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/deck_text.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace wellknit {

namespace {

constexpr std::size_t longest_line = 128;  // the simulators' own limit
constexpr std::size_t longest_name = 8;
constexpr std::size_t piece = 1U << 20U;  // bytes to the disk at once

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

DeckArray::DeckArray(std::ostream& out, std::string_view keyword) : out_(out) {
  fmt::format_to(fmt::appender(text_), FMT_COMPILE("{}\n"), keyword);
  line_start_ = text_.size();
}

void DeckArray::put_value() {
  const std::size_t token = text_.size();
  if (count_ > 1)
    fmt::format_to(fmt::appender(text_), FMT_COMPILE(" {}*{}"), count_, value_);
  else
    fmt::format_to(fmt::appender(text_), FMT_COMPILE(" {}"), value_);
  count_ = 0;
  if (text_.size() - line_start_ > longest_line) {
    // The token goes to the next line: its blank becomes that line's.
    const std::string moved(text_.data() + token, text_.size() - token);
    text_.resize(token);
    text_.push_back('\n');
    line_start_ = text_.size();
    text_.append(moved);
  }
  if (text_.size() > piece) flush();
}

void DeckArray::flush() {
  // The line that is not full yet stays.
  out_.write(text_.data(), static_cast<std::streamsize>(line_start_));
  const std::string rest(text_.data() + line_start_, text_.size() - line_start_);
  text_.clear();
  text_.append(rest);
  line_start_ = 0;
}

void DeckArray::end() {
  if (count_ > 0) put_value();
  text_.append(std::string_view("\n/\n"));
  out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
  text_.clear();
  line_start_ = 0;
}

void write_deck_array(std::ostream& out, std::string_view keyword, std::span<const double> values) {
  DeckArray array(out, keyword);
  for (const double value : values) array.add(value);
  array.end();
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
