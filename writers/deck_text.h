// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Text of an Eclipse deck: arrays with repeat counts, lines of at most 128 characters, names that fit.
#pragma once

#include <fmt/format.h>

#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wellknit {

/// An array keyword under construction: the numbers with the digits that give the very same doubles back, equal
/// neighbours as n*v. Only what is not on the disk yet is kept.
class DeckArray {
 public:
  DeckArray(std::ostream& out, std::string_view keyword);
  void add(double value) {
    if (count_ > 0 && value != value_) put_value();
    value_ = value;
    ++count_;
  }
  /// The slash.
  void end();

 private:
  void put_value();
  void flush();

  std::ostream& out_;
  fmt::memory_buffer text_;
  std::size_t line_start_ = 0;
  double value_ = 0.0;
  std::size_t count_ = 0;  ///< how often the value came in a row
};

/// All of an array keyword.
void write_deck_array(std::ostream& out, std::string_view keyword, std::span<const double> values);

/// `-- text`, cut so that the line fits; control characters become '?'.
void write_deck_comment(std::ostream& out, std::string_view text);

/// Well names that a deck can have, one for each given: letters, digits, '-' and '_', a letter first, at most 8
/// characters, no two equal even without regard to case. A name that fits already stays as it is.
std::vector<std::string> deck_well_names(const std::vector<std::string>& names);

}  // namespace wellknit
