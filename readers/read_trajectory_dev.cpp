// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_trajectory_dev.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "model/errors.h"
#include "readers/station_table.h"
#include "readers/text.h"
#include "readers/trajectory_stations.h"

namespace wellknit {

namespace {

constexpr double end_of_well = -999.0;

std::string_view without_comment(std::string_view line) {
  const auto dashes = line.find("--");
  const auto hash = line.find('#');
  return trimmed(line.substr(0, std::min(dashes, hash)));
}

/// What follows this word at the start of the line, any case, with a colon or blank between.
std::optional<std::string_view> after_word(std::string_view line, std::string_view word) {
  if (!equal_ignoring_case(line.substr(0, word.size()), word)) return std::nullopt;
  std::string_view rest = line.substr(word.size());
  if (!rest.empty() && rest.front() != ':' && !is_blank(rest.front())) return std::nullopt;
  rest = trimmed(rest);
  if (!rest.empty() && rest.front() == ':') rest = trimmed(rest.substr(1));
  return rest;
}

/// Without the quotes around it; typographic ones and accents serve as quotes too.
std::string without_quotes(std::string_view text) {
  text = trimmed(text);
  for (const std::string_view quote : {"\xE2\x80\x98", "\xE2\x80\x99", "\xC2\xB4", "`", "\xB4", "'", "\""}) {
    if (text.size() > quote.size() && text.substr(0, quote.size()) == quote) text.remove_prefix(quote.size());
    if (text.size() > quote.size() && text.substr(text.size() - quote.size()) == quote)
      text.remove_suffix(quote.size());
  }
  return std::string(trimmed(text));
}

/// "X Y TVD MD": a heading that says what the columns are.
bool is_heading(const std::vector<std::string_view>& fields) {
  return fields.size() == 4 && std::all_of(fields.begin(), fields.end(), [](std::string_view field) {
           return station_column(column_title(field).name) != StationColumn::other;
         });
}

/// The well's name when the line is a name line: `name X`, `WELLNAME: 'X'`, or the bare name.
std::optional<std::string> name_line(std::string_view line) {
  for (const std::string_view word : {"wellname", "name"})
    if (const auto rest = after_word(line, word)) return without_quotes(*rest);
  const auto fields = split_fields(line, ' ');
  const auto numbers =
      std::count_if(fields.begin(), fields.end(), [](auto field) { return parse_real(field).has_value(); });
  // "abc 4630.6 4133.5 0" is a row with a fault, not the name of a well; so is anything that starts like a number.
  if (numbers >= 2 || is_digit(line.front()) || line.front() == '-' || line.front() == '.') return std::nullopt;
  return without_quotes(line);
}

Station read_row(const std::vector<std::string_view>& fields, const StationList& list, std::int64_t line) {
  if (fields.size() != 4)
    throw ParseError({list.file, line, "row"}, {"4 numbers: X Y TVD MD", fmt::format("{}", fields.size()), ""});
  Station station;
  station.line = line;
  station.point = {station_number(fields[0], list, line, "X"), station_number(fields[1], list, line, "Y"),
                   station_number(fields[2], list, line, "TVD")};
  station.measured_depth = station_number(fields[3], list, line, "MD");
  return station;
}

class DevReader {
 public:
  explicit DevReader(const std::string& path) : path_(path) {}

  void take_line(std::string_view line, std::int64_t number) {
    const auto fields = split_fields(line, ' ');
    if (is_heading(fields)) return require_order(fields, number);
    const auto first = parse_real(fields.front());
    if (first && *first == end_of_well && (fields.size() == 1 || fields.size() < 4)) return finish_well(number);
    if (!first) {
      if (const auto name = name_line(line)) {
        if (is_open_) finish_well(number);
        return begin_well(*name, number);
      }
    }
    if (!is_open_) begin_well("", number);
    list_.stations.push_back(read_row(fields, list_, number));
  }

  TrajectoryFile finish(std::int64_t line) {
    if (is_open_) finish_well(line);
    if (out_.wells.empty()) throw ParseError({path_, 0, ""}, {"rows X Y TVD MD", "none", "the file is empty or cut"});
    return std::move(out_);
  }

 private:
  /// Rows are X Y TVD MD whatever the heading says, so it had better say that.
  void require_order(const std::vector<std::string_view>& fields, std::int64_t line) const {
    using C = StationColumn;
    const auto column = [&](std::size_t n) { return station_column(column_title(fields[n]).name); };
    const C depth = column(2);
    const bool is_depth = depth == C::tvd || depth == C::tvdss || depth == C::depth || depth == C::z;
    if (column(0) == C::x && column(1) == C::y && is_depth && column(3) == C::measured_depth) return;
    throw ParseError({path_, line, "header"},
                     {"the columns X Y TVD MD", "another order", "reorder the columns, or write the file as CSV"});
  }
  void begin_well(const std::string& name, std::int64_t line) {
    list_ = {};
    list_.file = path_;
    list_.line = line;
    list_.name = name;
    if (name.empty()) {
      list_.name = well_name_from_path(path_);
      if (!out_.wells.empty()) list_.name += fmt::format("_{}", out_.wells.size() + 1);
    }
    is_open_ = true;
  }
  void finish_well(std::int64_t line) {
    if (!is_open_)
      throw ParseError({path_, line, "-999"}, {"rows X Y TVD MD before the end of a well", "none", "remove the line"});
    add_well(out_, std::move(list_));
    is_open_ = false;
  }

  std::string path_;
  TrajectoryFile out_;
  StationList list_;
  bool is_open_ = false;
};

}  // namespace

bool looks_like_dev_wells(std::string_view text) {
  LineReader lines(text);
  while (const auto line = lines.next()) {
    const std::string_view content = without_comment(*line);
    if (content.empty()) continue;
    if (after_word(content, "wellname") || after_word(content, "name")) return true;
    const auto fields = split_fields(content, ' ');
    if (is_heading(fields)) continue;
    return fields.size() == 4 &&
           std::all_of(fields.begin(), fields.end(), [](auto field) { return parse_real(field).has_value(); });
  }
  return false;
}

TrajectoryFile parse_dev_wells(std::string_view text, const std::string& path, const TrajectoryOptions&) {
  DevReader reader(path);
  LineReader lines(text);
  while (const auto line = lines.next()) {
    const std::string_view content = without_comment(*line);
    if (!content.empty()) reader.take_line(content, lines.line());
  }
  return reader.finish(lines.line());
}

}  // namespace wellknit
