// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A deck as keywords and records, over the stack of its included files. It knows the form of a deck and
/// the place of every token; what a keyword means is decided elsewhere.
#pragma once

#include <cstdint>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/case.h"
#include "model/errors.h"
#include "readers/deck_tokens.h"
#include "readers/file_content.h"
#include "readers/number_array.h"

namespace wellknit {

/// What a deck may make the program do, so that a hostile file ends in an error and not in a hang.
struct DeckLimits {
  std::int64_t free_values = 400'000'000;    ///< array values held at once, beyond one for each byte read
  std::int64_t free_steps = 20'000'000'000;  ///< values visited by EQUALS, COPY …, COMPDAT layers
  std::size_t include_depth = 32;
  std::size_t include_count = 10'000;
  std::size_t record_items = 10'000;
  bool hashes_sources = true;  ///< false: SourceFile::sha256 stays empty
};

struct DeckKeyword {
  std::string name;  ///< upper case
  std::string file;
  std::int64_t line = 0;
};

/// The items of a record, `n*` expanded. The texts live as long as the file is open.
struct DeckRecord {
  struct Item {
    std::string_view text;    ///< without quotes
    bool is_default = false;  ///< from n*
  };
  std::vector<Item> items;
  std::int64_t line = 0;

  [[nodiscard]] bool empty() const { return items.empty(); }
  [[nodiscard]] bool has(std::size_t item) const { return item < items.size() && !items[item].is_default; }
};

/// A value of an array, or a run of equal ones.
struct RepeatedToken {
  std::int64_t count = 1;
  std::string_view value;  ///< empty for a default (n*)
};

class DeckStream {
 public:
  DeckStream(FileStore& files, const DeckLimits& limits) : files_(files), limits_(limits) {}

  /// Opens a file that stands at the top. Throws ParseError when it is missing or binary.
  void open(const std::string& path);
  /// Takes note of a file at the top that is not a deck: as a source, and for messages.
  void add_file(const FileContent& content, const std::string& name);
  /// Opens a file from inside another: relative to the including file's folder, else to the main file's.
  void include(std::string name, std::int64_t line);
  /// Leaves all open files.
  void close() { frames_.clear(); }
  /// Leaves the innermost file.
  void close_one() { frames_.pop_back(); }

  /// The next keyword, or nothing at the end of the last file. A lone '/' before it is passed over.
  std::optional<DeckKeyword> next_keyword();
  /// A line while skipping: its first word in upper case, what follows it, and whether a record has just ended.
  struct Line {
    std::string first;
    std::string_view rest;
    std::size_t column = 0;
    bool after_record = false;   ///< the line before it ended a record
    bool after_keyword = false;  ///< nothing was passed over yet
    std::int64_t line = 0;
  };
  /// Passes over lines until one is accepted: that line is then the next keyword. False when the file ended before;
  /// reading goes on in the file that included it.
  bool skip_lines_until(const std::function<bool(const Line&)>& accepts);
  void skip_text_line() { tokens().skip_text_line(); }
  /// What is left of the last token's line.
  void skip_rest_of_line() {
    if (tokens().line() == line_) tokens().skip_line();
  }
  DeckToken next_path() { return tokens().next_path(); }

  /// The record up to '/'. Throws ParseError at the file's end, at a keyword in its place, and for more items than
  /// this.
  DeckRecord next_record(std::size_t most_items);
  /// Passes over a record of any words, names of keywords among them.
  void skip_record();
  /// The numbers before the '/' of the current array when they are plain ones, at most this many; what follows is then
  /// the '/'. Nothing, and nothing read, otherwise.
  template <class T>
  std::optional<std::vector<T>> plain_array(std::int64_t most, T unset) {
    auto array = parse_number_array<T>(tokens().rest_of_file(), most, unset);
    if (!array) return std::nullopt;
    tokens().skip_array(array->length, array->line_ends);
    return std::move(array->values);
  }
  /// One value of an array, or nothing at its '/'.
  std::optional<RepeatedToken> next_value();

  /// Items of a record, numbered from 0 here and from 1 in messages. Nothing for a default.
  [[nodiscard]] std::optional<std::int64_t> integer(const DeckRecord& record, std::size_t item) const;
  [[nodiscard]] std::optional<double> real(const DeckRecord& record, std::size_t item) const;
  /// Upper case.
  [[nodiscard]] std::optional<std::string> word(const DeckRecord& record, std::size_t item) const;

  /// Throws ParseError at the current keyword.
  [[noreturn]] void fail(std::int64_t line, ParseError::What what) const;
  /// Line of the last token.
  [[nodiscard]] std::int64_t line() const { return line_; }
  [[nodiscard]] const DeckKeyword& keyword() const { return keyword_; }
  [[nodiscard]] const std::string& main_file() const { return main_file_; }
  [[nodiscard]] bool is_open() const { return !frames_.empty(); }
  [[nodiscard]] std::size_t bytes_left() const { return frames_.empty() ? 0 : frames_.back().tokens.bytes_left(); }

  /// "file:line: text" into the notes.
  void note(std::int64_t line, const std::string& text);
  /// The same, once for this key.
  void note_once(const std::string& key, std::int64_t line, const std::string& text);

  /// Throws ParseError when the arrays would become larger than a deck of this size can mean.
  void charge_values(std::int64_t count);
  /// Throws ParseError when the work asked for is out of proportion.
  void charge_steps(std::int64_t count);

  /// The files read, in their order; waits until their digests are there.
  std::vector<SourceFile> take_sources();

  std::vector<std::string> notes;

 private:
  struct Frame {
    FileContent content;
    DeckTokens tokens;
  };

  [[nodiscard]] DeckTokens& tokens() { return frames_.back().tokens; }
  void push(FileContent content, const std::string& name);
  void add_source(const FileContent& content, const std::string& name);
  [[nodiscard]] std::optional<FileContent> find_include(const std::string& name);
  [[nodiscard]] std::string current_file() const { return frames_.empty() ? main_file_ : frames_.back().content.path; }
  DeckToken next_data_token();
  void refuse_keyword_in_list(const DeckToken& token);
  void append_items(DeckRecord& record, const DeckToken& token, std::size_t most_items) const;
  [[nodiscard]] ParseError::What bad_item(const DeckRecord& record, std::size_t item,
                                          const std::string& expected) const;

  FileStore& files_;
  DeckLimits limits_;
  std::vector<Frame> frames_;
  std::string main_file_;
  std::vector<SourceFile> sources_;
  std::vector<std::future<std::string>> digests_;  ///< of sources_
  std::set<std::string> known_sources_;
  std::set<std::string> noted_;
  DeckKeyword keyword_;
  std::int64_t line_ = 1;
  std::int64_t bytes_read_ = 0;
  std::int64_t values_ = 0;
  std::int64_t steps_ = 0;
  std::size_t includes_ = 0;
};

}  // namespace wellknit
