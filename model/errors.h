// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The two errors that the library throws. It never prints, exits or asserts on what a file holds.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace wellknit {

/// Something is wrong in a file. `what()` is one line: `file:line: keyword: expected …, found …; advice`.
class ParseError : public std::runtime_error {
 public:
  struct Where {
    std::string file;
    std::int64_t line = 0;  ///< 1-based; 0 when the fault is not on a line (missing or binary file)
    std::string keyword;    ///< empty when outside any keyword
  };
  struct What {
    std::string expected;
    std::string found;
    std::string advice;  ///< what the user should do; may be empty
  };
  ParseError(Where where, What what);

  [[nodiscard]] const Where& where() const { return where_; }
  [[nodiscard]] const What& problem() const { return what_; }

 private:
  Where where_;
  What what_;
};

/// A precondition of a function does not hold (a negative radius, a well outside the grid …).
/// The message is one sentence for the user: what is wrong, and what to do.
class InvalidInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file cannot be written: no such folder, no permission, it exists already, or the disk is full.
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace wellknit
