// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A text file of an OpenFOAM case: its head, and numbers in a buffer that goes to the disk in large pieces.
#pragma once

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

namespace wellknit {

class FoamFile {
 public:
  /// `name` is relative to the case's folder, where its own folder must be. `shown_path` stands in messages. Throws
  /// WriteError.
  FoamFile(const std::string& folder, const std::string& name, std::string_view foam_class, std::string shown_path,
           std::string_view note = {});

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
