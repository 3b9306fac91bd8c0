// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/deck_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "readers/deck_keywords.h"
#include "readers/formats.h"
#include "readers/text.h"

namespace wellknit {

namespace fs = std::filesystem;

void DeckStream::open(const std::string& path) {
  auto content = files_.load(path);
  if (!content) throw ParseError({path, 0, ""}, {"a file", "none of this name", "check the path"});
  main_file_ = content->path;
  push(*std::move(content), path);
}

void DeckStream::add_file(const FileContent& content, const std::string& name) {
  if (main_file_.empty()) main_file_ = content.path;
  add_source(content, name);
}

void DeckStream::add_source(const FileContent& content, const std::string& name) {
  if (known_sources_.insert(content.path).second) {
    sources_.push_back({name, ""});
    // The digest of a large file takes as long as its numbers: it goes on beside them.
    static constexpr std::size_t large = std::size_t{1} << 22;
    const auto policy = content.text.size() >= large ? std::launch::async : std::launch::deferred;
    if (limits_.hashes_sources) digests_.push_back(std::async(policy, [content] { return sha256_hex(content.text); }));
  }
  bytes_read_ += static_cast<std::int64_t>(content.text.size());
}

void DeckStream::push(FileContent content, const std::string& name) {
  if (const auto* format = recognise_binary(content.text))
    throw ParseError({content.path, 0, keyword_.name},
                     {"a deck or a GRDECL file (text)", fmt::format("a file in the format {}", format->name),
                      not_read_advice(*format)});
  // A zero further on is no text either, and is met where it stands.
  static constexpr std::size_t looked_at = std::size_t{1} << 16;
  if (content.text.substr(0, looked_at).find('\0') != std::string::npos)
    throw ParseError({content.path, 0, keyword_.name},
                     {"a deck or a GRDECL file (text)", "binary data", "write the grid as GRDECL text"});
  add_source(content, name);
  const DeckTokens content_tokens(content.text);
  frames_.push_back({std::move(content), content_tokens});
}

std::vector<SourceFile> DeckStream::take_sources() {
  for (std::size_t n = 0; n < digests_.size(); ++n) sources_[n].sha256 = digests_[n].get();
  digests_.clear();
  return std::move(sources_);
}

std::optional<FileContent> DeckStream::find_include(const std::string& name) {
  const fs::path path(name);
  if (path.is_absolute()) return files_.load(name);
  auto content = files_.load((fs::path(current_file()).parent_path() / path).lexically_normal().string());
  if (!content) content = files_.load((fs::path(main_file_).parent_path() / path).lexically_normal().string());
  return content;
}

void DeckStream::include(std::string name, std::int64_t line) {
  std::replace(name.begin(), name.end(), '\\', '/');
  if (frames_.size() >= limits_.include_depth)
    fail(line, {fmt::format("at most {} files inside each other", limits_.include_depth), "one more",
                "flatten the INCLUDEs"});
  if (++includes_ > limits_.include_count)
    fail(line, {fmt::format("at most {} INCLUDEs", limits_.include_count), "one more", "join the files"});
  auto content = find_include(name);
  if (!content)
    fail(line, {"a file to include", fmt::format("none named {}", quoted_for_message(name)),
                "names are relative to the including file or to the deck; check the path"});
  for (const Frame& frame : frames_) {
    if (frame.content.path == content->path)
      fail(line,
           {"an INCLUDE that ends", fmt::format("{} including itself", quoted_for_message(name)), "remove the loop"});
  }
  push(*std::move(content), name);
}

std::optional<DeckKeyword> DeckStream::next_keyword() {
  while (!frames_.empty()) {
    const DeckToken token = tokens().next();
    line_ = token.line;
    if (token.kind == DeckToken::Kind::slash) continue;
    if (token.kind == DeckToken::Kind::end) {
      frames_.pop_back();
      continue;
    }
    if (token.kind != DeckToken::Kind::word || !is_keyword_name(token.text)) {
      fail(token.line, {"a keyword", quoted_for_message(token.text),
                        "is there a '/' too many before it, or is this not a GRDECL file?"});
    }
    keyword_ = {upper_case(token.text), current_file(), token.line};
    return keyword_;
  }
  return std::nullopt;
}

bool DeckStream::skip_lines_until(const std::function<bool(const Line&)>& accepts) {
  bool after_record = false;
  bool after_keyword = true;
  while (true) {
    const DeckTokens before = tokens();
    const DeckToken token = tokens().next();
    if (token.kind == DeckToken::Kind::end) {
      frames_.pop_back();
      return false;
    }
    const std::string_view rest = tokens().rest_of_line();
    if (token.kind == DeckToken::Kind::word && token.first_on_line && is_keyword_name(token.text) &&
        accepts({upper_case(token.text), rest, token.column, after_record, after_keyword, token.line})) {
      tokens() = before;
      return true;
    }
    after_record = token.kind == DeckToken::Kind::slash || rest.find('/') != std::string_view::npos;
    after_keyword = false;
    if (tokens().line() == token.line) tokens().skip_line();
  }
}

DeckToken DeckStream::next_data_token() {
  const DeckToken token = tokens().next();
  line_ = token.line;
  if (token.kind == DeckToken::Kind::end)
    fail(token.line, {"a '/' that ends the data", "the end of the file", "the file is cut, or the '/' was forgotten"});
  if (token.kind == DeckToken::Kind::unterminated)
    fail(token.line, {"a closing quote", quoted_for_message(token.text), "close it on the same line"});
  return token;
}

DeckRecord DeckStream::next_record(std::size_t most_items) {
  DeckRecord record;
  while (true) {
    const DeckToken token = next_data_token();
    if (record.line == 0) record.line = token.line;
    if (token.kind == DeckToken::Kind::slash) return record;
    if (record.empty()) refuse_keyword_in_list(token);
    append_items(record, token, most_items);
  }
}

void DeckStream::skip_record() {
  while (next_data_token().kind != DeckToken::Kind::slash) continue;
}

/// A list whose closing '/' was forgotten would swallow the next keyword as a record.
void DeckStream::refuse_keyword_in_list(const DeckToken& token) {
  if (token.kind != DeckToken::Kind::word || !token.first_on_line || token.column != 0 ||
      !tokens().rest_of_line().empty() || !is_known_keyword(upper_case(token.text)))
    return;
  fail(token.line, {fmt::format("a '/' that ends the records of {}", keyword_.name),
                    fmt::format("the keyword {}", quoted_for_message(token.text)), "add the '/'"});
}

namespace {

/// Splits "12*3.5" at its star; nothing for any other word. The count is 0 when it does not fit 18 digits.
std::optional<RepeatedToken> split_repeat(std::string_view text) {
  std::size_t digits = 0;
  std::int64_t count = 0;
  while (digits < text.size() && is_digit(text[digits])) {
    if (digits < 18) count = 10 * count + (text[digits] - '0');
    ++digits;
  }
  if (digits == 0 || digits == text.size() || text[digits] != '*') return std::nullopt;
  return RepeatedToken{digits > 18 ? 0 : count, text.substr(digits + 1)};
}

}  // namespace

void DeckStream::append_items(DeckRecord& record, const DeckToken& token, std::size_t most_items) const {
  DeckRecord::Item item{token.text, false};
  std::int64_t count = 1;
  const auto repeat = token.kind == DeckToken::Kind::word ? split_repeat(token.text) : std::nullopt;
  if (repeat) {
    item = {unquoted(repeat->value), repeat->value.empty()};
    count = repeat->count;
  }
  const auto room = static_cast<std::int64_t>(std::min(most_items, limits_.record_items) - record.items.size());
  if (count < 1) fail(token.line, {"a repeat count of 1 or more", quoted_for_message(token.text), ""});
  if (count > room && !(item.is_default && repeat)) {
    fail(token.line, {fmt::format("at most {} items in the record", std::min(most_items, limits_.record_items)),
                      fmt::format("one more, {}", quoted_for_message(token.text)), "end the record with '/'"});
  }
  // Trailing defaults beyond the last item say nothing.
  record.items.insert(record.items.end(), static_cast<std::size_t>(std::min(count, room)), item);
}

std::optional<RepeatedToken> DeckStream::next_value() {
  const DeckToken token = next_data_token();
  if (token.kind == DeckToken::Kind::slash) return std::nullopt;
  if (token.kind != DeckToken::Kind::word)
    fail(token.line, {"a number", fmt::format("the text {}", quoted_for_message(token.text)), ""});
  const auto repeat = split_repeat(token.text);
  if (!repeat) return RepeatedToken{1, token.text};
  if (repeat->count < 1) fail(token.line, {"a repeat count of 1 or more", quoted_for_message(token.text), ""});
  return repeat;
}

ParseError::What DeckStream::bad_item(const DeckRecord& record, std::size_t item, const std::string& expected) const {
  return {fmt::format("{} as item {}", expected, item + 1), quoted_for_message(record.items[item].text), ""};
}

std::optional<std::int64_t> DeckStream::integer(const DeckRecord& record, std::size_t item) const {
  if (!record.has(item)) return std::nullopt;
  const auto value = parse_integer(record.items[item].text);
  if (!value) fail(record.line, bad_item(record, item, "an integer"));
  return value;
}

std::optional<double> DeckStream::real(const DeckRecord& record, std::size_t item) const {
  if (!record.has(item)) return std::nullopt;
  const auto value = parse_real(record.items[item].text);
  if (!value) fail(record.line, bad_item(record, item, "a number"));
  return value;
}

std::optional<std::string> DeckStream::word(const DeckRecord& record, std::size_t item) const {
  if (!record.has(item)) return std::nullopt;
  return upper_case(trimmed(record.items[item].text));
}

void DeckStream::fail(std::int64_t line, ParseError::What what) const {
  throw ParseError({current_file(), line, keyword_.name}, std::move(what));
}

void DeckStream::note(std::int64_t line, const std::string& text) {
  notes.push_back(fmt::format("{}:{}: {}", current_file(), line, text));
}

void DeckStream::note_once(const std::string& key, std::int64_t line, const std::string& text) {
  if (noted_.insert(key).second) note(line, text);
}

void DeckStream::charge_values(std::int64_t count) {
  const std::int64_t most = limits_.free_values + bytes_read_;
  if (count < 0 || count > most - values_) {
    fail(line_, {fmt::format("arrays of at most {} values in all for files of this size", most),
                 fmt::format("{} values more after {}", count, values_), "check the dimensions of the grid"});
  }
  values_ += count;
}

void DeckStream::charge_steps(std::int64_t count) {
  const std::int64_t most = limits_.free_steps;
  if (count < 0 || count > most - steps_)
    fail(line_, {"operations in proportion to the deck", "more than a run can do",
                 "check the boxes and the dimensions of the grid"});
  steps_ += count;
}

}  // namespace wellknit
