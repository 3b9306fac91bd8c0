// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Changes to the text of a deck's files. What no change touches stays byte for byte.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "readers/whole_deck.h"

namespace wellknit {

class DeckEdits {
 public:
  explicit DeckEdits(const WholeDeck& deck) : deck_(deck), edits_(deck.files.size()) {}

  /// Bytes [begin, end) of the file become `text`. Two changes must not overlap.
  void replace(std::size_t file, std::size_t begin, std::size_t end, std::string text);
  /// Before byte `at`; after what was inserted there before.
  void insert(std::size_t file, std::size_t at, std::string text) { replace(file, at, at, std::move(text)); }
  /// A whole keyword with its records.
  void replace(const DeckTextKeyword& keyword, std::string text) {
    replace(keyword.file, keyword.begin, keyword.end, std::move(text));
  }
  /// A record becomes these, each without its '/'; what follows the old '/' on its line follows the last one. With
  /// none, the record becomes a comment that says why.
  void replace_record(const DeckTextKeyword& keyword, const DeckTextRecord& record,
                      const std::vector<std::string>& records, const std::string& why_none);
  /// As lines of their own below a keyword, before its next line.
  void insert_below(const DeckTextKeyword& keyword, const std::string& lines);

  [[nodiscard]] bool is_changed(std::size_t file) const { return !edits_[file].empty(); }
  /// The file's new text.
  [[nodiscard]] std::string text_of(std::size_t file) const;

 private:
  struct Edit {
    std::size_t begin;
    std::size_t end;
    std::string text;
  };
  const WholeDeck& deck_;
  std::vector<std::vector<Edit>> edits_;
};

/// Byte after the end of the line that holds byte `at`.
std::size_t next_line(std::string_view text, std::size_t at);

}  // namespace wellknit
