// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Characters, numbers and lines of text files, without regard to the locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wellknit {

constexpr bool is_line_end(char c) { return c == '\n' || c == '\r'; }
constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr char to_upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
constexpr bool is_letter(char c) { return to_upper(c) >= 'A' && to_upper(c) <= 'Z'; }

std::string upper_case(std::string_view text);
bool equal_ignoring_case(std::string_view a, std::string_view b);
std::string_view trimmed(std::string_view text);
/// Without one pair of quotes around it.
std::string_view unquoted(std::string_view text);

/// A finite number: optional sign, Fortran exponents (1.0D+3) too. Nothing when any character is left over.
std::optional<double> parse_real(std::string_view text);
/// An integer; a real number without fraction (3.0) counts as one.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// True when the text matches a pattern in which `*` stands for any characters and `?` for one; letters in
/// any case.
bool matches_pattern(std::string_view text, std::string_view pattern);

/// For messages: at most 40 characters of it in quotes, anything but printable ASCII as '?'.
std::string quoted_for_message(std::string_view text);

/// Line after line of a text; LF, CRLF and CR end a line.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}
  /// The next line without its end; nothing after the last.
  std::optional<std::string_view> next();
  [[nodiscard]] std::int64_t line() const { return line_; }  ///< of the line last given, 1-based

 private:
  std::string_view rest_;
  std::int64_t line_ = 0;
};

/// Fields of a line: separated by this character, or by blanks when it is ' '. Fields are trimmed.
std::vector<std::string_view> split_fields(std::string_view line, char separator);

}  // namespace wellknit
