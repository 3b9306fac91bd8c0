// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The tags of a ROFF file (Roxar Open File Format), binary or ASCII (docs/formats/roff.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/errors.h"

namespace wellknit {

enum class RoffType : std::uint8_t { boolean, byte, text, integer, real, double_real };

/// One key of a tag; its values are not read yet. They are known to be there.
struct RoffKey {
  std::string tag;
  std::int64_t tag_number = 0;  ///< which tag of the file, from 0: several may have one name
  std::string name;
  RoffType type = RoffType::integer;
  std::int64_t count = 1;  ///< 1 where it is no array
  std::string_view data;
  std::size_t offset = 0;  ///< bytes from the file's start
};

/// Walks the keys of a file in memory. A binary file says its byte order by filedata.byteswaptest. A count is compared
/// with the bytes that are left before anything is allocated.
class RoffTags {
 public:
  /// Throws ParseError when it begins with neither roff-bin nor roff-asc.
  RoffTags(std::string_view bytes, const std::string& path);

  /// The next key, or nothing at the end. Throws ParseError where the file is cut or damaged.
  std::optional<RoffKey> next();

  /// Values of bool, byte, int, float or double. Throws ParseError for texts and for a value that is not finite.
  [[nodiscard]] std::vector<double> reals(const RoffKey& key) const;
  /// The same, where all are whole.
  [[nodiscard]] std::vector<std::int32_t> integers(const RoffKey& key) const;
  /// The one value of a key.
  [[nodiscard]] double real(const RoffKey& key) const;
  [[nodiscard]] std::int32_t integer(const RoffKey& key) const;
  /// Of the type char.
  [[nodiscard]] std::string text(const RoffKey& key) const;

  void require_count(const RoffKey& key, std::int64_t count) const;
  /// Throws ParseError at the key: its line in an ASCII file, its byte in a binary one.
  [[noreturn]] void fail(const RoffKey& key, ParseError::What what) const;
  [[nodiscard]] ParseError::Where where(const RoffKey& key) const;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  [[noreturn]] void fail_at(std::size_t offset, const std::string& keyword, ParseError::What what) const;
  [[nodiscard]] std::int64_t line_of(std::size_t offset) const;
  std::string_view word();
  std::string_view binary_word();
  std::string_view ascii_word();
  std::optional<RoffKey> read_key(std::string_view type);
  void find_count(RoffKey& key);
  void find_binary_data(RoffKey& key);
  void find_ascii_data(RoffKey& key, bool is_array);
  void take_byte_order(const RoffKey& key);
  template <class T>
  [[nodiscard]] std::vector<T> numbers(const RoffKey& key) const;
  template <class T>
  [[nodiscard]] std::vector<T> parsed(const RoffKey& key) const;

  std::string_view bytes_;
  std::string path_;
  std::size_t at_ = 0;
  bool is_ascii_ = false;
  std::optional<bool> is_swapped_;  ///< binary: known once byteswaptest has been read
  std::string tag_;                 ///< empty between tags
  std::int64_t tag_number_ = -1;
};

}  // namespace wellknit
