// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/fixed_field.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace wellknit {

namespace {

constexpr std::string_view blanks = "                        ";

using Field = std::array<char, 32>;

std::string_view as_text(const Field& field, const std::to_chars_result& end) {
  return {field.data(), static_cast<std::size_t>(end.ptr - field.data())};
}

/// Without what a reader does not need: E+05 as E5, E-07 as E-7.
std::string_view short_exponent(Field& field, std::string_view text) {
  const std::size_t e = text.find('e');
  field[e] = 'E';
  std::size_t to = e + 1;
  std::size_t from = e + 1;
  if (text[from] == '-') field[to++] = '-';
  ++from;
  while (from + 1 < text.size() && text[from] == '0') ++from;
  while (from < text.size()) field[to++] = text[from++];
  return {field.data(), to};
}

/// Digits after the point: what the width leaves beside the sign, the leading digits and the point.
std::string_view plain(Field& field, double value, int width, int exponent) {
  const int before = (value < 0.0 ? 1 : 0) + (exponent >= 0 ? exponent + 1 : 1) + 1;
  const int digits = std::max(0, width - before);
  std::string_view text =
      as_text(field, std::to_chars(field.data(), field.data() + field.size(), value, std::chars_format::fixed, digits));
  if (digits > 0) return text;
  field[text.size()] = '.';
  return {field.data(), text.size() + 1};
}

std::string_view scientific(Field& field, double value, int width, int exponent) {
  // Sign, first digit, point, E, exponent with its sign.
  const int size = std::abs(exponent);
  const int other = (value < 0.0 ? 1 : 0) + 3 + (exponent < 0 ? 1 : 0) + (size >= 100 ? 3 : size >= 10 ? 2 : 1);
  const int digits = std::max(1, width - other);
  return short_exponent(field, as_text(field, std::to_chars(field.data(), field.data() + field.size(), value,
                                                            std::chars_format::scientific, digits)));
}

int decimal_exponent(double value) { return static_cast<int>(std::floor(std::log10(std::abs(value)))); }

}  // namespace

void fixed_number(TextFile& out, double value, int width) {
  Field field{};
  std::string_view text = "0.";
  if (value != 0.0 && std::isfinite(value)) {
    const int exponent = decimal_exponent(value);
    // Plain numbers lose a place to every leading zero, and scientific ones two or more to the exponent.
    const bool is_plain = exponent >= -2 && exponent <= width - (value < 0.0 ? 3 : 2);
    const auto fits = [&] { return text.size() <= static_cast<std::size_t>(width); };
    // Rounding up may make one digit more (9.9999… to 10.000): then once more, for one less.
    text = is_plain ? plain(field, value, width, exponent) : scientific(field, value, width, exponent);
    if (!fits() && is_plain) text = plain(field, value, width - 1, exponent);
    if (!fits()) text = scientific(field, value, width - 1, exponent);
  }
  out.text(blanks.substr(0, static_cast<std::size_t>(width) - text.size()));
  out.text(text);
}

void exponential_number(TextFile& out, double value) {
  constexpr int width = 20;
  constexpr int digits = 12;
  Field field{};
  const std::string_view text =
      as_text(field, std::to_chars(field.data(), field.data() + field.size(), std::isfinite(value) ? value + 0.0 : 0.0,
                                   std::chars_format::scientific, digits));
  std::replace(field.begin(), field.end(), 'e', 'E');
  out.text(blanks.substr(0, width - text.size()));
  out.text(text);
}

void fixed_integer(TextFile& out, std::int64_t value) {
  constexpr std::size_t width = 10;
  const fmt::format_int digits(value);
  out.text(blanks.substr(0, width - std::min(width, digits.size())));
  out.text({digits.data(), digits.size()});
}

void fixed_text(TextFile& out, std::string_view text, std::size_t width) {
  out.text(text.substr(0, width));
  for (std::size_t i = text.size(); i < width; ++i) out.text(" ");
}

}  // namespace wellknit
