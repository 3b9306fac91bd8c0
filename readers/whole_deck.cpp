// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/whole_deck.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "readers/deck_tokens.h"
#include "readers/formats.h"
#include "readers/text.h"

namespace wellknit {

namespace fs = std::filesystem;

namespace {

using Kind = DeckToken::Kind;

/// The word's items: "3*" are three defaults, "2*OPEN" two values.
DeckTextItem item_of(const DeckToken& token, std::size_t end) {
  DeckTextItem item{token.text, 1, false, token.begin, end};
  if (token.kind != Kind::word) return item;
  std::size_t digits = 0;
  while (digits < token.text.size() && is_digit(token.text[digits])) ++digits;
  if (digits == 0 || digits == token.text.size() || token.text[digits] != '*') return item;
  item.count = parse_integer(token.text.substr(0, digits)).value_or(0);
  item.text = unquoted(token.text.substr(digits + 1));
  item.is_default = digits + 1 == token.text.size();
  return item;
}

bool is_section(std::string_view name) {
  const DeckKeywordRule* rule = find_deck_keyword(name, DeckSection::runspec);
  return rule != nullptr && rule->action == DeckAction::begin_section;
}

/// A line that begins with the name of a section, by the rules of read().
bool has_section_line(std::string_view text, std::string_view section) {
  LineReader lines(text);
  while (const auto line = lines.next()) {
    if (line->size() < section.size() || !equal_ignoring_case(line->substr(0, section.size()), section)) continue;
    const std::string_view rest = trimmed(line->substr(section.size()));
    if (line->size() == section.size() ||
        (!is_letter((*line)[section.size()]) && (rest.empty() || !is_letter(rest[0]))))
      return true;
  }
  return false;
}

class WholeDeckReader {
 public:
  WholeDeckReader(FileStore& files, const DeckLimits& limits) : store_(files), limits_(limits) {}

  std::optional<WholeDeck> read(const std::string& path);

 private:
  struct Frame {
    std::size_t file;
    DeckTokens tokens;
    std::size_t part_begin = 0;
  };

  DeckTokens& tokens() { return frames_.back().tokens; }
  [[nodiscard]] std::size_t file() const { return frames_.back().file; }
  [[nodiscard]] const std::string& path() const { return deck_.files[file()].content.path; }
  [[noreturn]] void fail(std::int64_t line, const std::string& keyword, ParseError::What what) const {
    throw ParseError({path(), line, keyword}, std::move(what));
  }

  void push(FileContent content, DeckTextFile file);
  void pop();
  void end_part(std::size_t end, std::optional<std::size_t> includes = std::nullopt);
  void take(const DeckToken& token);
  void take_candidate(const DeckToken& token);
  bool take_form(const DeckToken& token, const std::string& name);
  void take_summary(const DeckToken& token, const std::string& name);
  void begin_section(const DeckToken& token, const std::string& name);
  void include(const DeckToken& token);
  void read_paths();
  std::string expanded(const DeckToken& token) const;
  std::optional<FileContent> find_include(const std::string& name);
  void skip_block(const DeckToken& opened);
  void refuse(const DeckToken& token, const std::string& name, const WholeDeckRule& rule);
  void take_rule(const DeckToken& token, const std::string& name, const WholeDeckRule& rule);
  void take_keyword(const DeckToken& token, const std::string& name, DeckForm form, DeckRole role);
  DeckTextRecord next_record(const DeckTextKeyword& keyword);
  void skip_array(const DeckTextKeyword& keyword);
  void look_for_cell_array(const DeckToken& token, const std::string& name);

  FileStore& store_;
  DeckLimits limits_;
  WholeDeck deck_;
  std::vector<Frame> frames_;
  DeckSection section_ = DeckSection::bare;
  std::map<std::string, std::string> paths_;
  std::size_t includes_ = 0;
  bool in_list_ = false;   ///< of SUMMARY: up to the next '/'
  bool may_begin_ = true;  ///< the last token ended a record, or was a keyword
  bool ended_ = false;     ///< END was read
};

std::optional<WholeDeck> WholeDeckReader::read(const std::string& path) {
  auto content = store_.load(path);
  if (!content || recognise_binary(content->text) != nullptr) return std::nullopt;
  for (const char* section : {"RUNSPEC", "GRID", "PROPS", "SOLUTION", "SCHEDULE"})
    if (!has_section_line(content->text, section)) return std::nullopt;
  push(*std::move(content), {{}, path, std::nullopt, 0, 0});
  while (!frames_.empty() && !ended_) {
    const DeckToken token = tokens().next();
    if (token.kind == Kind::end)
      pop();
    else
      take(token);
  }
  while (!frames_.empty()) pop();
  return std::move(deck_);
}

void WholeDeckReader::push(FileContent content, DeckTextFile file) {
  const DeckTokens content_tokens(content.text);
  file.content = std::move(content);
  deck_.files.push_back(std::move(file));
  frames_.push_back({deck_.files.size() - 1, content_tokens, 0});
}

void WholeDeckReader::pop() {
  end_part(deck_.files[file()].content.text.size());
  frames_.pop_back();
  may_begin_ = true;
}

void WholeDeckReader::end_part(std::size_t end, std::optional<std::size_t> includes) {
  Frame& frame = frames_.back();
  if (end > frame.part_begin || includes)
    deck_.parts.push_back({frame.file, frame.part_begin, end, section_, includes});
  frame.part_begin = end;
}

void WholeDeckReader::take(const DeckToken& token) {
  if (token.kind == Kind::slash) {
    may_begin_ = true;
    in_list_ = false;
    return;
  }
  if (token.kind == Kind::word && token.first_on_line && !in_list_ && is_keyword_name(token.text))
    return take_candidate(token);
  may_begin_ = false;
}

/// A word that may be a keyword: it is one when we know it and its line looks like one.
void WholeDeckReader::take_candidate(const DeckToken& token) {
  const std::string name = upper_case(token.text);
  const std::string_view rest = tokens().rest_of_line();
  if (is_section(name)) {
    if (token.column == 0 && (rest.empty() || !is_letter(rest.front()))) return begin_section(token, name);
    return;
  }
  const bool has_digits_after = token.column == 0 && !rest.empty() && is_digit(rest.front());
  if (name == "INCLUDE") return include(token);
  if (!rest.empty() && !has_digits_after) {
    may_begin_ = false;
    return;
  }
  if (take_form(token, name)) return;
  if (section_ == DeckSection::summary) return take_summary(token, name);
  if (const WholeDeckRule* rule = find_whole_deck_rule(name, section_)) return take_rule(token, name, *rule);
  look_for_cell_array(token, name);
}

/// Keywords that steer the reading itself.
bool WholeDeckReader::take_form(const DeckToken& token, const std::string& name) {
  if (name == "END" && tokens().rest_of_line().empty()) {
    ended_ = true;
    return true;
  }
  if (name == "ENDINC") {
    pop();
    return true;
  }
  if (name == "TITLE" && section_ == DeckSection::runspec) {
    tokens().skip_text_line();
    return true;
  }
  if (name == "PATHS" && section_ == DeckSection::runspec) {
    read_paths();
    return true;
  }
  if (name == "SKIP" || name == "SKIP100") {
    skip_block(token);
    return true;
  }
  return false;
}

void WholeDeckReader::begin_section(const DeckToken& token, const std::string& name) {
  end_part(token.begin);
  section_ = section_of(name);
  if (tokens().line() == token.line) tokens().skip_line();
  may_begin_ = true;
  in_list_ = false;
}

void WholeDeckReader::skip_block(const DeckToken& opened) {
  while (true) {
    const DeckToken token = tokens().next();
    if (token.kind == Kind::end) fail(opened.line, "SKIP", {"ENDSKIP after it", "the end of the file", "add ENDSKIP"});
    if (token.kind == Kind::word && token.first_on_line && equal_ignoring_case(token.text, "ENDSKIP")) return;
  }
}

void WholeDeckReader::read_paths() {
  const DeckTextKeyword keyword{"PATHS", section_, DeckRole::kept, file(), 0, 0, tokens().line(), {}};
  while (true) {
    const DeckTextRecord record = next_record(keyword);
    if (record.empty()) return;
    if (record.find(1) == nullptr) fail(record.line, "PATHS", {"a name and a path", "less", ""});
    paths_[std::string(record.text(0))] = std::string(record.text(1));
  }
}

/// The name of a file with its $PATH filled in.
std::string WholeDeckReader::expanded(const DeckToken& token) const {
  std::string name(trimmed(token.text));
  if (!name.empty() && name.front() == '$') {
    const auto end = name.find_first_of("/\\");
    const auto found = paths_.find(name.substr(1, end == std::string::npos ? end : end - 1));
    if (found == paths_.end())
      fail(token.line, "INCLUDE", {"a name given by PATHS", quoted_for_message(name), "add it to PATHS in RUNSPEC"});
    name = found->second + (end == std::string::npos ? "" : name.substr(end));
  }
  if (name.empty()) fail(token.line, "INCLUDE", {"the name of a file", "an empty one", ""});
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

std::optional<FileContent> WholeDeckReader::find_include(const std::string& name) {
  const fs::path included(name);
  if (included.is_absolute()) return store_.load(name);
  auto content = store_.load((fs::path(path()).parent_path() / included).lexically_normal().string());
  const fs::path main = fs::path(deck_.files.front().content.path).parent_path();
  if (!content) content = store_.load((main / included).lexically_normal().string());
  return content;
}

void WholeDeckReader::include(const DeckToken& keyword) {
  const DeckToken token = tokens().next_path();
  if (token.kind != Kind::word && token.kind != Kind::quoted)
    fail(token.line, "INCLUDE", {"the name of a file", "none", "write it in quotes and end the record with '/'"});
  const std::string name = expanded(token);
  if (frames_.size() >= limits_.include_depth || ++includes_ > limits_.include_count)
    fail(token.line, "INCLUDE",
         {fmt::format("at most {} INCLUDEs, {} inside each other", limits_.include_count, limits_.include_depth),
          "one more", "join the files"});
  auto content = find_include(name);
  if (!content)
    fail(token.line, "INCLUDE",
         {"a file to include", fmt::format("none named {}", quoted_for_message(name)), "check the path"});
  for (const Frame& frame : frames_)
    if (deck_.files[frame.file].content.path == content->path)
      fail(token.line, "INCLUDE",
           {"an INCLUDE that ends", fmt::format("{} including itself", quoted_for_message(name)), "remove the loop"});
  if (recognise_binary(content->text) != nullptr || content->text.substr(0, 65536).find('\0') != std::string_view::npos)
    fail(token.line, "INCLUDE", {"a text file", fmt::format("{}: binary data", quoted_for_message(name)), ""});
  const std::size_t quotes = token.kind == Kind::quoted ? 2 : 0;
  const DeckTextFile included{{}, name, file(), token.begin, token.begin + token.text.size() + quotes};
  end_part(keyword.begin);
  end_part(tokens().offset(), deck_.files.size());
  may_begin_ = true;
  push(*std::move(content), included);
}

DeckTextRecord WholeDeckReader::next_record(const DeckTextKeyword& keyword) {
  DeckTextRecord record;
  while (true) {
    const DeckToken token = tokens().next();
    if (record.line == 0) {
      record.line = token.line;
      record.begin = token.begin;
    }
    if (token.kind == Kind::end)
      fail(token.line, keyword.name,
           {"a '/' that ends the data", "the end of the file", "the file is cut, or the '/' was forgotten"});
    if (token.kind == Kind::unterminated)
      fail(token.line, keyword.name, {"a closing quote", quoted_for_message(token.text), "close it on the same line"});
    if (token.kind == Kind::slash) {
      record.slash = token.begin;
      return record;
    }
    if (record.items.size() >= limits_.record_items)
      fail(token.line, keyword.name, {"a '/' that ends the record", "more items than any record has", "add the '/'"});
    const bool is_lone_word =
        token.kind == Kind::word && token.first_on_line && token.column == 0 && tokens().rest_of_line().empty();
    if (record.empty() && is_lone_word &&
        (is_section(upper_case(token.text)) || is_known_keyword(upper_case(token.text))))
      fail(token.line, keyword.name,
           {fmt::format("a '/' that ends the records of {}", keyword.name),
            fmt::format("the keyword {}", quoted_for_message(token.text)), "add the '/'"});
    record.items.push_back(item_of(token, tokens().offset()));
    if (record.items.back().count < 1 || record.items.back().count > static_cast<std::int64_t>(limits_.record_items))
      fail(token.line, keyword.name,
           {fmt::format("a count from 1 to {} before '*'", limits_.record_items), quoted_for_message(token.text), ""});
  }
}

void WholeDeckReader::skip_array(const DeckTextKeyword& keyword) {
  while (true) {
    const DeckToken token = tokens().next();
    if (token.kind == Kind::slash) return;
    if (token.kind == Kind::end)
      fail(keyword.line, keyword.name,
           {"a '/' that ends the data", "the end of the file", "the file is cut, or the '/' was forgotten"});
  }
}

void WholeDeckReader::refuse(const DeckToken& token, const std::string& name, const WholeDeckRule& rule) {
  deck_.refusals.push_back(
      ParseError({path(), token.line, name},
                 {"a deck that can be converted", std::string(rule.reason), std::string(rule.advice)}));
}

void WholeDeckReader::take_rule(const DeckToken& token, const std::string& name, const WholeDeckRule& rule) {
  // Of GRID and EDIT, which are replaced, only these few matter.
  if (rule.role == DeckRole::refused) {
    refuse(token, name, rule);
    may_begin_ = true;
    return;
  }
  if (rule.role == DeckRole::kept) {
    may_begin_ = true;
    return;
  }
  take_keyword(token, name, rule.form, rule.role);
}

void WholeDeckReader::take_keyword(const DeckToken& token, const std::string& name, DeckForm form, DeckRole role) {
  DeckTextKeyword keyword{name, section_, role, file(), token.begin, tokens().offset(), token.line, {}};
  if (form == DeckForm::record) keyword.records.push_back(next_record(keyword));
  if (form == DeckForm::array) skip_array(keyword);
  if (form == DeckForm::list) {
    while (true) {
      DeckTextRecord record = next_record(keyword);
      if (record.empty()) break;
      keyword.records.push_back(std::move(record));
    }
  }
  keyword.end = tokens().offset();
  if (role == DeckRole::saturation_options) {
    for (const DeckTextItem& item : keyword.records.front().items)
      if (const std::string option = upper_case(item.text); option == "DIRECT" || option == "IRREVERS")
        refuse(token, name, *find_whole_deck_rule(name, section_));
  }
  if (role == DeckRole::dimensions) {
    for (std::int64_t axis = 0; axis < 3; ++axis) {
      const auto count = parse_integer(keyword.records.front().text(axis));
      if (!count || *count < 1 || *count > 1'000'000'000)
        fail(keyword.line, name, {"three counts of cells, 1 or more", "another value", ""});
      deck_.dimensions[static_cast<std::size_t>(axis)] = *count;
    }
  }
  deck_.keywords.push_back(std::move(keyword));
  may_begin_ = true;
}

void WholeDeckReader::take_summary(const DeckToken& token, const std::string& name) {
  const DeckRole role = whole_deck_summary_role(name);
  if (role == DeckRole::refused) {
    deck_.refusals.push_back(ParseError({path(), token.line, name},
                                        {"a deck that can be converted", "a local grid refinement", "take it out"}));
    return;
  }
  if (role == DeckRole::kept) {
    in_list_ = takes_summary_list(name);
    return;
  }
  DeckTokens ahead = tokens();
  const DeckToken after = ahead.next();
  // Two keywords in a row: the first one has no list.
  if (after.kind == Kind::word && after.first_on_line && ahead.rest_of_line().empty()) return;
  // A group or a well that was named like a keyword has no cell behind it.
  if (role == DeckRole::cell_summary && !parse_integer(after.text)) return;
  take_keyword(token, name, role == DeckRole::neighbour_summary ? DeckForm::record : DeckForm::list, role);
}

/// A keyword without a rule: its first record is counted. As many numbers as there are cells are values of cells.
void WholeDeckReader::look_for_cell_array(const DeckToken& token, const std::string& name) {
  const bool is_looked_at = section_ == DeckSection::props || section_ == DeckSection::regions ||
                            section_ == DeckSection::solution || section_ == DeckSection::schedule;
  if (!is_looked_at || token.column != 0 || !may_begin_) return;
  const auto [nx, ny, nz] = deck_.dimensions;
  DeckTokens ahead = tokens();
  std::int64_t values = 0;
  while (true) {
    const DeckToken next = ahead.next();
    if (next.kind == Kind::slash) break;
    const DeckTextItem item = item_of(next, ahead.offset());
    if (next.kind != Kind::word || item.count < 1 || (!item.is_default && !parse_real(item.text))) return;
    if (values > nx * ny * nz || item.count > nx * ny * nz) return;
    values += item.count;
  }
  if (values != nx * ny * nz || values < 2) return;
  deck_.refusals.push_back(ParseError(
      {path(), token.line, name},
      {"a keyword whose meaning is known", fmt::format("{} numbers, one for each cell of the grid", values),
       "values of cells would be wrong on the new grid: take the keyword out, or rename it to the one you mean"}));
}

}  // namespace

const DeckTextItem* DeckTextRecord::find(std::int64_t n) const {
  for (const DeckTextItem& item : items) {
    if (n < item.count) return item.is_default ? nullptr : &item;
    n -= item.count;
  }
  return nullptr;
}

std::string_view DeckTextRecord::text(std::int64_t n) const {
  const DeckTextItem* item = find(n);
  return item == nullptr ? std::string_view() : item->text;
}

std::int64_t DeckTextRecord::size() const {
  std::int64_t count = 0;
  for (const DeckTextItem& item : items) count += item.count;
  return count;
}

std::optional<WholeDeck> read_whole_deck(FileStore& files, const std::string& path, const DeckLimits& limits) {
  return WholeDeckReader(files, limits).read(path);
}

}  // namespace wellknit
