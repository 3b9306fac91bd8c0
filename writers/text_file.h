// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A text file under construction: numbers go into a buffer, and the buffer to the disk in large pieces.
#pragma once

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <string>
#include <string_view>

#include "model/geometry.h"

namespace wellknit {

class TextFile {
 public:
  /// `file` is where the text goes; `shown_path` stands in messages. Throws WriteError.
  TextFile(const std::string& file, std::string shown_path);

  void text(std::string_view text) { buffer_.append(text); }
  template <class... Arguments>
  void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Arguments>(arguments)...);
  }
  void integer(std::int64_t value) {
    const fmt::format_int digits(value);
    buffer_.append(digits.data(), digits.data() + digits.size());
  }
  /// The fewest digits that give the very same double back; 0 for both zeros and for what is not finite.
  void number(double value) {
    if (value == 0.0 || !std::isfinite(value))
      buffer_.push_back('0');
    else
      fmt::format_to(fmt::appender(buffer_), FMT_COMPILE("{}"), value);
  }
  /// Numbers with a space between.
  void numbers(std::initializer_list<double> values) {
    std::string_view gap;
    for (const double value : values) {
      text(gap);
      number(value);
      gap = " ";
    }
  }
  void point(const Vec3& p) { numbers({p.x(), p.y(), p.z()}); }
  /// Ends an entry of a list: a line of its own.
  void end_line() {
    buffer_.push_back('\n');
    if (buffer_.size() > piece) flush();
  }
  /// Throws WriteError when anything could not be written.
  void close();

 private:
  static constexpr std::size_t piece = 1U << 20U;  ///< bytes
  void flush();

  std::string shown_path_;
  std::ofstream out_;
  fmt::memory_buffer buffer_;
};

}  // namespace wellknit
