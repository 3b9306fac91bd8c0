// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_properties.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "model/errors.h"
#include "readers/deck_keywords.h"
#include "readers/file_content.h"
#include "readers/formats.h"
#include "readers/number_array.h"
#include "readers/text.h"

namespace wellknit {

namespace {

constexpr std::int32_t unset_integer = std::numeric_limits<std::int32_t>::min();
constexpr std::array<std::string_view, 3> geometry{"SPECGRID", "COORD", "ZCORN"};

class PropertyText {
 public:
  PropertyText(const std::string& path, std::string_view text, std::int64_t cells)
      : path_(path), rest_(text), cells_(cells) {}

  void read(PropertyFile& out) {
    while (const auto keyword = next_keyword()) {
      if (*keyword == "INCLUDE")
        fail(*keyword, "properties in this very file", "INCLUDE", "name the other file instead");
      const bool done = is_integer(*keyword) ? take<std::int32_t>(*keyword, unset_integer, out)
                                             : take<double>(*keyword, std::numeric_limits<double>::quiet_NaN(), out);
      if (!done) pass_over(*keyword, out);
    }
  }

 private:
  [[noreturn]] void fail(const std::string& keyword, std::string expected, std::string found,
                         std::string advice) const {
    throw ParseError({path_, line_, keyword}, {std::move(expected), std::move(found), std::move(advice)});
  }

  static bool is_integer(const std::string& keyword) {
    const CellArrayRule* rule = find_cell_array(keyword);
    return rule != nullptr && rule->kind == CellArrayKind::integer;
  }

  void advance(std::size_t count) {
    line_ += count_line_ends(rest_.substr(0, count));
    rest_.remove_prefix(count);
  }

  /// The next word that begins a line with a letter, in upper case; what follows it is left.
  std::optional<std::string> next_keyword() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
      const std::string_view line = trimmed(rest_.substr(0, end));
      if (!line.empty() && is_letter(line.front())) {
        const std::size_t blank = std::min(line.find_first_of(" \t/"), line.size());
        std::string keyword = upper_case(line.substr(0, blank));
        advance(static_cast<std::size_t>(line.data() - rest_.data()) + blank);
        return keyword;
      }
      advance(std::min(end + 1, rest_.size()));
    }
    return std::nullopt;
  }

  /// The values of a keyword, when they are plain numbers up to a '/'.
  template <class T>
  bool take(const std::string& keyword, T unset, PropertyFile& out) {
    const bool is_cell_array = find_cell_array(keyword) != nullptr;
    const auto array = parse_number_array<T>(rest_, is_cell_array ? cells_ : 8 * cells_ + 1, unset);
    if (!array || (!is_cell_array && static_cast<std::int64_t>(array->values.size()) != cells_)) {
      if (is_cell_array) fail(keyword, fmt::format("{} numbers and a '/'", cells_), "something else, or more", "");
      return false;
    }
    if (static_cast<std::int64_t>(array->values.size()) != cells_)
      fail(keyword, fmt::format("{} values", cells_), fmt::format("{}", array->values.size()),
           "the properties must be those of the mesh's source grid");
    if (std::is_same_v<T, std::int32_t> && std::count(array->values.begin(), array->values.end(), unset) > 0)
      fail(keyword, "a value for every cell", "defaults", "");
    out.properties[keyword] = array->values;
    advance(array->length);
    return true;
  }

  /// Up to the record's '/', or to the next line where the keyword stands alone.
  void pass_over(const std::string& keyword, PropertyFile& out) {
    if (std::find(geometry.begin(), geometry.end(), keyword) == geometry.end())
      out.notes.push_back(fmt::format("{}:{}: {} is not a list of {} plain numbers; passed over", path_, line_,
                                      quoted_for_message(keyword), cells_));
    const std::size_t end = rest_.find('/');
    const std::size_t next_line = std::min(rest_.find_first_of("\r\n"), rest_.size());
    advance(end == std::string_view::npos ? next_line : end + 1);
  }

  const std::string& path_;
  std::string_view rest_;
  std::int64_t cells_;
  std::int64_t line_ = 1;
};

void take_binary(const ReaderFormat& format, std::string_view bytes, const std::string& path, std::int64_t cells,
                 PropertyFile& out) {
  const GridPart part = format.read_grid(bytes, path);
  for (const GridPartArray& array : part.arrays) {
    const std::size_t count = std::visit([](const auto& values) { return values.size(); }, array.values);
    if (static_cast<std::int64_t>(count) == cells)
      out.properties[array.name] = array.values;
    else
      out.notes.push_back(fmt::format("{}: {} has {} values, not {}; passed over", path, array.name, count, cells));
  }
}

}  // namespace

PropertyFile read_properties(const std::string& path, std::int64_t cells) {
  const FileContent file = load_file(path);
  PropertyFile out;
  out.source = {path, sha256_hex(file.text)};
  const ReaderFormat* format = recognise_binary(file.text);
  if (format != nullptr && format->read_grid != nullptr)
    take_binary(*format, file.text, path, cells, out);
  else
    PropertyText(path, file.text, cells).read(out);
  if (out.properties.empty())
    throw ParseError({path, 0, ""},
                     {fmt::format("a keyword with {} values, one for each cell of the source grid", cells), "none",
                      "give a GRDECL file with properties"});
  return out;
}

}  // namespace wellknit
