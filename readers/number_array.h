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

/// Offset of the '/' that ends the data at the start of this text, comments passed over; npos when there is none.
std::size_t find_array_end(std::string_view text);

/// Ends of lines in it: LF, CRLF and CR.
std::int64_t count_line_ends(std::string_view text);

/// The values of a text that holds numbers, n*value and n* with blanks between, and comments, and ends with a blank or
/// with the '/'; T is double or std::int32_t. A default (n*) becomes `unset`. Nothing when there is anything else in
/// it, a number out of range or more values than `most`. Every value is the nearest double to the decimal number. The
/// result does not depend on the number of threads.
template <class T>
std::optional<std::vector<T>> parse_number_array(std::string_view text, std::int64_t most, T unset);

extern template std::optional<std::vector<double>> parse_number_array(std::string_view, std::int64_t, double);
extern template std::optional<std::vector<std::int32_t>> parse_number_array(std::string_view, std::int64_t,
                                                                            std::int32_t);

}  // namespace wellknit
