// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The named arrays that Eclipse output files are made of, binary or formatted (docs/formats/egrid.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/errors.h"

namespace wellknit {

enum class EclType : std::uint8_t { integer, real, double_real, logical, text };

/// One array as it stands in the file; its values are not read yet. Every block of it is known to be there.
struct EclArray {
  std::string name;  ///< without trailing blanks
  EclType type = EclType::integer;
  std::int64_t count = 0;
  std::size_t width = 4;   ///< bytes of a value in a binary file; characters of a text
  std::string_view data;   ///< framed blocks, or the text between two headers
  std::size_t offset = 0;  ///< of the header, bytes from the file's start
};

/// True when the file begins with a header of this form. Any name where none is given.
bool begins_with_ecl_header(std::string_view bytes, std::initializer_list<std::string_view> names);

/// Walks the arrays of a file in memory. Binary files may be of either byte order, told by the length of the first
/// header; formatted ones are text. A count is compared with the bytes that are left before anything is allocated.
class EclRecords {
 public:
  EclRecords(std::string_view bytes, const std::string& path);

  /// The next array, or nothing at the end. Throws ParseError where the file is cut or damaged.
  std::optional<EclArray> next();

  /// Values of INTE, REAL or DOUB. Throws ParseError for another type, a value that is not finite, or, in a
  /// formatted file, text that is no number.
  [[nodiscard]] std::vector<double> reals(const EclArray& array) const;
  /// Values of INTE; of REAL or DOUB where all are whole. Throws ParseError as above.
  [[nodiscard]] std::vector<std::int32_t> integers(const EclArray& array) const;
  /// Strings of CHAR or C0nn, without blanks around them. Throws ParseError for another type.
  [[nodiscard]] std::vector<std::string> strings(const EclArray& array) const;

  /// Throws ParseError unless the array has this many values.
  void require_count(const EclArray& array, std::int64_t count) const;
  void require_at_least(const EclArray& array, std::int64_t count) const;

  /// Throws ParseError at the array's header: its line in a formatted file, its byte in a binary one.
  [[noreturn]] void fail(const EclArray& array, ParseError::What what) const;
  /// The array's place for a ParseError that is thrown later.
  [[nodiscard]] ParseError::Where where(const EclArray& array) const;

  [[nodiscard]] bool is_formatted() const { return is_formatted_; }
  /// Binary, and the other way round than simulators write.
  [[nodiscard]] bool is_little_endian() const { return is_little_endian_; }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  struct Header {
    std::string name;
    std::int64_t count = 0;
    std::string type;
  };

  [[noreturn]] void fail_at(std::size_t offset, const std::string& keyword, ParseError::What what) const;
  [[nodiscard]] std::int64_t line_of(std::size_t offset) const;
  [[nodiscard]] std::int32_t int_at(std::size_t offset) const;
  [[nodiscard]] std::optional<EclArray> next_binary();
  [[nodiscard]] std::optional<EclArray> next_formatted();
  Header read_header();
  Header read_formatted_header();
  void set_type(EclArray& array, const std::string& type) const;
  void skip_blocks(EclArray& array);
  void skip_strings(EclArray& array);
  template <class T>
  [[nodiscard]] std::vector<T> numbers(const EclArray& array) const;
  template <class Raw, class T>
  void append_raw(const EclArray& array, std::vector<T>& out) const;
  template <class T>
  void append_parsed(const EclArray& array, std::vector<T>& out) const;

  std::string_view bytes_;
  std::string path_;
  std::size_t at_ = 0;
  bool is_formatted_ = false;
  bool is_little_endian_ = false;
};

}  // namespace wellknit
