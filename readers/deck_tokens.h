// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The text of one deck file as tokens. It knows comments, quotes, '/' and lines, and no keyword.
#pragma once

#include <cstdint>
#include <string_view>

namespace wellknit {

struct DeckToken {
  enum class Kind : std::uint8_t {
    word,          ///< up to a blank, '/', a quote or a comment; 3*'A' is one word
    quoted,        ///< between quotes, which `text` leaves out
    unterminated,  ///< a quote without its end on the line
    slash,         ///< end of a record; the rest of its line is comment
    end            ///< end of the file
  };
  Kind kind = Kind::end;
  std::string_view text;
  std::int64_t line = 1;       ///< 1-based
  std::size_t column = 0;      ///< 0-based
  std::size_t begin = 0;       ///< 0-based byte of the text where it begins, with its quote
  bool first_on_line = false;  ///< nothing but blanks before it
};

/// Tokens in place: the text must outlive the tokens.
class DeckTokens {
 public:
  explicit DeckTokens(std::string_view text);

  DeckToken next();
  [[nodiscard]] DeckToken peek() const { return DeckTokens(*this).next(); }

  /// What is left of the line after the last token, without comment and outer blanks.
  [[nodiscard]] std::string_view rest_of_line() const;
  /// To the start of the next line.
  void skip_line();
  /// Up to and with the next line that is neither blank nor comment only: the title.
  void skip_text_line();
  /// A file name: quoted, or up to a blank with any '/' inside it. Takes the closing '/' too when it is there.
  DeckToken next_path();

  [[nodiscard]] std::string_view rest_of_file() const { return text_.substr(at_); }
  /// To the '/' that ends an array whose text from here has this length and so many ends of lines.
  void skip_array(std::size_t length, std::int64_t line_ends);

  [[nodiscard]] std::size_t bytes_left() const { return text_.size() - at_; }
  [[nodiscard]] std::int64_t line() const { return line_; }
  /// Byte after the last token; after a '/' the end of its line.
  [[nodiscard]] std::size_t offset() const { return at_; }

 private:
  void skip_blank();
  void take_line_end();
  [[nodiscard]] bool at_comment() const { return at_ + 1 < text_.size() && text_[at_] == '-' && text_[at_ + 1] == '-'; }
  DeckToken take_quoted(DeckToken token);
  DeckToken take_word(DeckToken token);
  [[nodiscard]] DeckToken start_token();

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_start_ = 0;
  std::int64_t line_ = 1;
  bool token_on_line_ = false;
};

/// True for a name such as PERMX or MULTZ-: a letter, then letters, digits, '_', '+' or '-'; at most 32 characters.
bool is_keyword_name(std::string_view text);

}  // namespace wellknit
