// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_value_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "model/errors.h"
#include "readers/file_content.h"
#include "readers/text.h"

namespace wellknit {

namespace {

constexpr const char* form = "give a header `cell,NAME` or `face,NAME` and a row for each, or one number a line";

char separator_of(std::string_view line) {
  for (const char separator : {';', '\t', ','})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

class ValueTableParser {
 public:
  explicit ValueTableParser(const std::string& path) : path_(path) {}

  ValueTable parse(std::string_view text) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
    LineReader lines(text);
    while (const auto next = lines.next()) {
      const std::string_view line = trimmed(*next);
      line_ = lines.line();
      if (line.empty() || line.front() == '#' || line.substr(0, 2) == "--") continue;
      if (is_first_)
        read_first(line);
      else
        read_row(line);
    }
    if (out_.value.empty()) fail("rows with values", "none", form);
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(std::string expected, std::string found, std::string advice = "") const {
    throw ParseError({path_, line_, out_.value_title}, {std::move(expected), std::move(found), std::move(advice)});
  }

  void read_first(std::string_view line) {
    is_first_ = false;
    separator_ = separator_of(line);
    const auto fields = split_fields(line, separator_);
    if (fields.size() == 1 && parse_real(fields[0])) return read_row(line);
    std::string title = fields.empty() ? "" : std::string(unquoted(fields[0]));
    std::transform(title.begin(), title.end(), title.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    if (fields.size() != 2 || (title != "cell" && title != "face"))
      fail("a header `cell,NAME` or `face,NAME`", quoted_for_message(line), form);
    out_.index_title = title;
    out_.value_title = unquoted(fields[1]);
  }

  void read_row(std::string_view line) {
    const auto fields = split_fields(line, separator_);
    const std::size_t wanted = out_.index_title.empty() ? 1 : 2;
    if (fields.size() != wanted) fail(fmt::format("{} fields", wanted), quoted_for_message(line), form);
    std::int64_t index = static_cast<std::int64_t>(out_.value.size());
    if (wanted == 2) {
      const auto parsed = parse_integer(fields[0]);
      if (!parsed || *parsed < 0)
        fail(fmt::format("the number of a {}, from 0", out_.index_title), quoted_for_message(fields[0]));
      index = *parsed;
    }
    const auto value = parse_real(fields.back());
    if (!value) fail("a number", quoted_for_message(fields.back()));
    out_.index.push_back(index);
    out_.value.push_back(*value);
  }

  const std::string& path_;
  std::int64_t line_ = 0;
  bool is_first_ = true;
  char separator_ = ',';
  ValueTable out_;
};

}  // namespace

ValueTable parse_value_table(std::string_view text, const std::string& path) {
  return ValueTableParser(path).parse(text);
}

ValueTable read_value_table(const std::string& path) {
  const FileContent file = load_file(path);
  ValueTable out = parse_value_table(file.text, path);
  out.source = {path, sha256_hex(file.text)};
  return out;
}

}  // namespace wellknit
