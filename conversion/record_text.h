// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Records of a deck with some of their items changed, and their items as numbers.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "readers/whole_deck.h"

namespace wellknit {

/// Item (from 0) to its new text.
using ItemTexts = std::map<std::int64_t, std::string>;

/// The record on one line without its '/': items as the file has them, but for the changed ones. Items that the record
/// leaves out before a changed one become defaults.
std::string record_text(std::string_view file_text, const DeckTextRecord& record, const ItemTexts& changed);

/// Items of a record, from 0 here and from 1 in messages. Nothing for a default.
class RecordItems {
 public:
  RecordItems(const WholeDeck& deck, const DeckTextKeyword& keyword, const DeckTextRecord& record)
      : deck_(deck), keyword_(keyword), record_(record) {}

  [[nodiscard]] std::optional<std::int64_t> integer(std::int64_t item) const;
  [[nodiscard]] std::optional<double> real(std::int64_t item) const;
  /// Above 0, else nothing: so simulators read factors.
  [[nodiscard]] std::optional<double> positive(std::int64_t item) const;
  [[nodiscard]] std::string word(std::int64_t item, const char* fallback) const;  ///< upper case
  /// A cell's index along an axis, counted from 0; nothing for a default, 0 and negative numbers. Throws where it lies
  /// outside of the grid.
  [[nodiscard]] std::optional<std::int64_t> cell_index(std::int64_t item, std::size_t axis) const;
  [[noreturn]] void fail(ParseError::What what) const;

 private:
  const WholeDeck& deck_;
  const DeckTextKeyword& keyword_;
  const DeckTextRecord& record_;
};

}  // namespace wellknit
