// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The numbers of a large array in a deck, as fast as the text can be read: plain numbers only, split over threads.
/// What is not plain is left to the token by token reading, which also finds the words for what is wrong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace wellknit {

template <class T>
struct NumberArray {
  std::vector<T> values;
  std::size_t length = 0;      ///< of its text, with the '/'
  std::int64_t line_ends = 0;  ///< in this text
};

/// The array that starts here and ends with a '/': numbers, n*value and n* with blanks between, and comments; T is
/// double or std::int32_t. A default (n*) becomes `unset`. Nothing when there is anything else in it, a number out of
/// range, more values than `most`, or no '/'. Every value is the nearest double to the decimal number. The result does
/// not depend on the number of threads.
template <class T>
std::optional<NumberArray<T>> parse_number_array(std::string_view text, std::int64_t most, T unset);

extern template std::optional<NumberArray<double>> parse_number_array(std::string_view, std::int64_t, double);
extern template std::optional<NumberArray<std::int32_t>> parse_number_array(std::string_view, std::int64_t,
                                                                            std::int32_t);

/// Ends of lines: LF, CRLF and CR.
std::int64_t count_line_ends(std::string_view text);

}  // namespace wellknit
