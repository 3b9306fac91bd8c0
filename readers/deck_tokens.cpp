// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/deck_tokens.h"

#include <algorithm>

#include "readers/text.h"

namespace wellknit {

namespace {

constexpr bool is_quote(char c) { return c == '\'' || c == '"'; }

/// "3*": what stands before a quoted value that is repeated.
bool is_repeat_count(std::string_view word) {
  return word.size() >= 2 && word.back() == '*' && std::all_of(word.begin(), word.end() - 1, is_digit);
}

}  // namespace

DeckTokens::DeckTokens(std::string_view text) : text_(text) {
  // Editors on Windows put a byte-order mark in front; it is no part of the first keyword.
  static constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text_.substr(0, 3) == byte_order_mark) line_start_ = at_ = 3;
}

void DeckTokens::take_line_end() {
  const bool two = text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n';
  at_ += two ? 2 : 1;
  ++line_;
  line_start_ = at_;
  token_on_line_ = false;
}

void DeckTokens::skip_blank() {
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (is_blank(c)) {
      ++at_;
    } else if (is_line_end(c)) {
      take_line_end();
    } else if (at_comment()) {
      skip_line();
    } else {
      return;
    }
  }
}

void DeckTokens::skip_line() {
  while (at_ < text_.size() && !is_line_end(text_[at_])) ++at_;
  if (at_ < text_.size()) take_line_end();
}

void DeckTokens::skip_text_line() {
  skip_blank();
  skip_line();
}

DeckToken DeckTokens::start_token() {
  DeckToken token;
  token.line = line_;
  token.column = at_ - line_start_;
  token.begin = at_;
  token.first_on_line = !token_on_line_;
  token_on_line_ = true;
  return token;
}

DeckToken DeckTokens::next() {
  skip_blank();
  DeckToken token = start_token();
  if (at_ == text_.size()) return token;
  const char c = text_[at_];
  if (is_quote(c)) return take_quoted(token);
  if (c != '/') return take_word(token);
  token.kind = DeckToken::Kind::slash;
  token.text = text_.substr(at_, 1);
  while (at_ < text_.size() && !is_line_end(text_[at_])) ++at_;
  return token;
}

DeckToken DeckTokens::take_quoted(DeckToken token) {
  const char quote = text_[at_++];
  const std::size_t begin = at_;
  while (at_ < text_.size() && text_[at_] != quote && !is_line_end(text_[at_])) ++at_;
  token.text = text_.substr(begin, at_ - begin);
  const bool closed = at_ < text_.size() && text_[at_] == quote;
  token.kind = closed ? DeckToken::Kind::quoted : DeckToken::Kind::unterminated;
  if (closed) ++at_;
  return token;
}

DeckToken DeckTokens::take_word(DeckToken token) {
  token.kind = DeckToken::Kind::word;
  const std::size_t begin = at_;
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (is_blank(c) || is_line_end(c) || c == '/' || is_quote(c) || at_comment()) break;
    ++at_;
  }
  token.text = text_.substr(begin, at_ - begin);
  if (at_ < text_.size() && is_quote(text_[at_]) && is_repeat_count(token.text)) {
    if (take_quoted(token).kind == DeckToken::Kind::unterminated) token.kind = DeckToken::Kind::unterminated;
    token.text = text_.substr(begin, at_ - begin);
  }
  return token;
}

DeckToken DeckTokens::next_path() {
  skip_blank();
  if (at_ == text_.size() || is_quote(text_[at_])) {
    const DeckToken token = next();
    if (token.kind == DeckToken::Kind::quoted && peek().kind == DeckToken::Kind::slash) next();
    return token;
  }
  DeckToken token = start_token();
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_blank(text_[at_]) && !is_line_end(text_[at_])) ++at_;
  token.text = text_.substr(begin, at_ - begin);
  token.kind = token.text == "/" ? DeckToken::Kind::slash : DeckToken::Kind::word;
  if (token.text.size() > 1 && token.text.back() == '/') {
    token.text.remove_suffix(1);
  } else if (token.kind == DeckToken::Kind::word && peek().kind == DeckToken::Kind::slash) {
    next();
  }
  return token;
}

void DeckTokens::skip_array(std::size_t length, std::int64_t line_ends) {
  const std::size_t last_end = text_.substr(at_, length).find_last_of("\n\r");
  if (last_end != std::string_view::npos) line_start_ = at_ + last_end + 1;
  at_ += length - 1;
  line_ += line_ends;
  token_on_line_ = true;
}

std::string_view DeckTokens::rest_of_line() const {
  std::size_t end = at_;
  while (end < text_.size() && !is_line_end(text_[end]) && text_.substr(end, 2) != "--") ++end;
  return trimmed(text_.substr(at_, end - at_));
}

bool is_keyword_name(std::string_view text) {
  static constexpr std::size_t longest = 32;
  if (text.empty() || text.size() > longest || !is_letter(text.front())) return false;
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return is_letter(c) || is_digit(c) || c == '_' || c == '+' || c == '-'; });
}

}  // namespace wellknit
