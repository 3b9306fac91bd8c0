// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A whole deck as its author wrote it: its files byte for byte, and where in them the keywords stand that name cells.
/// For the conversion of decks, which replaces these places and copies the rest.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/errors.h"
#include "readers/deck_stream.h"
#include "readers/file_content.h"
#include "readers/whole_deck_keywords.h"

namespace wellknit {

/// A token of a record; `n*v` and `n*` stand for several items.
struct DeckTextItem {
  std::string_view text;    ///< without quotes and without the count
  std::int64_t count = 1;   ///< items that it stands for
  bool is_default = false;  ///< from n*
  std::size_t begin = 0;    ///< bytes of its file, quotes and count with it
  std::size_t end = 0;
};

struct DeckTextRecord {
  std::vector<DeckTextItem> items;
  std::size_t begin = 0;  ///< of its first token
  std::size_t slash = 0;  ///< of its '/'
  std::int64_t line = 0;

  [[nodiscard]] bool empty() const { return items.empty(); }
  /// The token that holds item n, counted from 0; nothing where the record ends before or leaves it to its default.
  [[nodiscard]] const DeckTextItem* find(std::int64_t n) const;
  [[nodiscard]] std::string_view text(std::int64_t n) const;  ///< empty for a default
  [[nodiscard]] std::int64_t size() const;
};

struct DeckTextKeyword {
  std::string name;  ///< upper case
  DeckSection section = DeckSection::bare;
  DeckRole role = DeckRole::kept;
  std::size_t file = 0;   ///< index of WholeDeck::files
  std::size_t begin = 0;  ///< bytes of the file: from its first letter …
  std::size_t end = 0;    ///< … to the end of the line of its last '/', without the line's end
  std::int64_t line = 0;
  std::vector<DeckTextRecord> records;  ///< of forms `record` and `list`, without the empty one that ends a list
};

/// A file each time it is read: one that is included twice stands here twice.
struct DeckTextFile {
  FileContent content;
  std::string name;  ///< as the INCLUDE has it
  std::optional<std::size_t> parent;
  std::size_t path_begin = 0;  ///< bytes of the parent: the file's name in its INCLUDE, quotes with it
  std::size_t path_end = 0;
};

/// A stretch of a file that lies in one section; all of them, in the order of reading, are the deck.
struct DeckTextPart {
  std::size_t file = 0;
  std::size_t begin = 0;
  std::size_t end = 0;
  DeckSection section = DeckSection::bare;
  std::optional<std::size_t> includes;  ///< the part is an INCLUDE of this file
};

struct WholeDeck {
  std::vector<DeckTextFile> files;  ///< the first is the main file
  std::vector<DeckTextKeyword> keywords;
  std::vector<DeckTextPart> parts;
  std::array<std::int64_t, 3> dimensions{};
  std::vector<ParseError> refusals;  ///< what cannot be converted, in the deck's order
};

/// Nothing where the main file is not a whole deck: it lacks one of RUNSPEC, GRID, PROPS, SOLUTION and SCHEDULE. Throws
/// ParseError.
std::optional<WholeDeck> read_whole_deck(FileStore& files, const std::string& path, const DeckLimits& limits = {});

}  // namespace wellknit
