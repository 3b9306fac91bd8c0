// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_trajectory_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "model/errors.h"
#include "readers/station_table.h"
#include "readers/text.h"
#include "readers/well_head_line.h"

namespace wellknit {

namespace {

using C = StationColumn;

constexpr std::string_view wanted = "a header naming the columns MD,X,Y,TVD or MD,INC,AZI";

struct Header {
  char separator = ',';
  std::size_t fields = 0;
  std::vector<C> columns;          ///< of each field
  std::vector<std::string> units;  ///< of each field, upper case; empty: not given
  StationLayout layout;
};

char separator_of(std::string_view line) {
  for (const char separator : {';', '\t', ','})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

std::string_view without_byte_order_mark(std::string_view text) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  return text;
}

/// "MD (m)" in a line without separators is one title in two fields.
std::vector<std::string> titles_of(std::string_view line, char separator) {
  std::vector<std::string> out;
  for (const std::string_view field : split_fields(line, separator)) {
    if (separator == ' ' && !out.empty() && (field.front() == '(' || field.front() == '['))
      out.back() += field;
    else
      out.emplace_back(field);
  }
  return out;
}

/// The columns when the line is a header: a path can be made from them.
std::optional<Header> parse_header(std::string_view line) {
  line = trimmed(line);
  Header header;
  header.separator = separator_of(line);
  if (line.substr(0, 1) == "#") {
    // "#MD,X,Y,TVD" is a header; "# X Y TVD MD" is a comment that other formats open with.
    if (header.separator == ' ' || header.separator == '\t') return std::nullopt;
    line.remove_prefix(std::min(line.size(), line.find_first_not_of("# \t")));
  } else if (line.substr(0, 2) == "--") {
    return std::nullopt;
  }
  for (const std::string& field : titles_of(line, header.separator)) {
    const ColumnTitle title = column_title(field);
    const C column = station_column(title.name);
    // Of two azimuths the one from grid north.
    const bool replaces = column == C::azimuth && title.name.find("GN") != std::string::npos;
    header.layout.add(column, header.columns.size(), replaces);
    header.columns.push_back(column);
    header.units.push_back(title.unit);
  }
  header.fields = header.columns.size();
  if (!header.layout.source()) return std::nullopt;
  return header;
}

bool is_comment(std::string_view line) { return line.empty() || line.front() == '#' || line.substr(0, 2) == "--"; }

/// A line of units below the header: "m;m;m;m" or "(ft),deg,deg".
bool is_units_row(const std::vector<std::string_view>& fields, const Header& header) {
  if (fields.size() != header.fields) return false;
  bool any = false;
  for (std::size_t n = 0; n < fields.size(); ++n) {
    if (parse_real(fields[n])) return false;
    const ColumnTitle title = column_title(fields[n]);
    const std::string& unit = title.name.empty() ? title.unit : title.name;
    const C column = header.columns[n];
    if (column == C::other || column == C::well || column == C::branch || unit.empty() || unit == "-") continue;
    if (!si_of_unit(unit, column)) return false;
    any = true;
  }
  return any;
}

bool is_length(C column) {
  return column != C::other && column != C::well && column != C::branch && column != C::inclination &&
         column != C::azimuth;
}

class CsvReader {
 public:
  CsvReader(std::string_view text, const std::string& path, const TrajectoryOptions& options)
      : lines_(without_byte_order_mark(text)), path_(path), options_(options) {}

  TrajectoryFile read() {
    read_header();
    find_decimal_comma();
    while (const auto line = lines_.next()) {
      const std::string_view content = trimmed(*line);
      if (is_comment(content))
        take_head_line(content, path_, lines_.line(), heads_);
      else
        take_row(*line, lines_.line());
    }
    return finish();
  }

 private:
  void read_header();
  void set_units();
  void find_decimal_comma();
  void require_decimal(std::string_view field, std::int64_t line) const;
  void take_row(std::string_view line, std::int64_t number);
  [[nodiscard]] double value(const std::vector<std::string_view>& fields, C column, std::int64_t line) const;
  StationRows& rows_of(const std::vector<std::string_view>& fields, std::int64_t line);
  TrajectoryFile finish();

  LineReader lines_;
  const std::string& path_;
  const TrajectoryOptions& options_;
  Header header_;
  std::int64_t header_line_ = 0;
  bool has_decimal_comma_ = false;
  bool is_first_row_ = true;
  std::vector<C> needed_;
  WellHeads heads_;
  std::vector<StationRows> wells_;
  std::map<std::pair<std::string, std::string>, std::size_t> place_;
  std::map<std::string, int> branches_of_;  ///< so far, by well
  TrajectoryFile out_;
};

/// The header, which comments may precede. Throws ParseError when the first line of content is none.
void CsvReader::read_header() {
  while (const auto line = lines_.next()) {
    if (auto header = parse_header(*line)) {
      header_ = *std::move(header);
      header_line_ = lines_.line();
      needed_ = header_.layout.needed();
      return set_units();
    }
    const std::string_view content = trimmed(*line);
    if (!is_comment(content)) {
      throw ParseError({path_, lines_.line(), "header"},
                       {std::string(wanted), quoted_for_message(content), "add it as the first line"});
    }
    take_head_line(content, path_, lines_.line(), heads_);
  }
  throw ParseError({path_, 0, "header"}, {std::string(wanted), "an empty file", ""});
}

/// Lengths without a unit are in the one unit that other lengths have, else in metres.
void CsvReader::set_units() {
  std::set<std::string> given;
  for (std::size_t n = 0; n < header_.fields; ++n)
    if (is_length(header_.columns[n]) && !header_.units[n].empty()) given.insert(header_.units[n]);
  bool assumes = false;
  for (const C column : needed_) {
    const std::size_t at = *header_.layout.at(column);
    std::string unit = header_.units[at];
    if (unit.empty() && is_length(column) && given.size() == 1) {
      unit = *given.begin();
      assumes = assumes || si_of_unit(unit, column).value_or(1.0) != 1.0;
    }
    const auto factor = si_of_unit(unit, column);
    if (!factor) {
      throw ParseError({path_, header_line_, "header"},
                       {column == C::inclination || column == C::azimuth ? "degrees or radians" : "metres or feet",
                        fmt::format("the unit {}", quoted_for_message(unit)), "convert the column"});
    }
    header_.layout.unit[static_cast<std::size_t>(column)] = *factor;
  }
  if (assumes)
    out_.notes.push_back(fmt::format("{}:{}: columns without a unit are taken in {}, as the others", path_,
                                     header_line_, *given.begin()));
}

/// Between semicolons 1,5 may be one and a half. It is where some number can mean nothing else, and none has a point.
void CsvReader::find_decimal_comma() {
  if (header_.separator != ';') return;
  LineReader ahead = lines_;
  std::int64_t first_comma = 0;
  std::int64_t first_point = 0;
  bool is_certain = false;
  while (const auto line = ahead.next()) {
    if (is_comment(trimmed(*line))) continue;
    const auto fields = split_fields(*line, ';');
    for (const C column : needed_) {
      const std::size_t at = *header_.layout.at(column);
      if (at >= fields.size()) continue;
      const std::string_view field = unquoted(fields[at]);
      const auto comma = field.find(',');
      if (field.find('.') != std::string_view::npos && first_point == 0) first_point = ahead.line();
      if (comma == std::string_view::npos) continue;
      if (first_comma == 0) first_comma = ahead.line();
      // A comma between thousands has three digits after it and one to three before.
      const std::string_view before = field.substr(0, comma);
      const auto digits_before = std::count_if(before.begin(), before.end(), is_digit);
      const bool is_below_one = before == "0" || before == "-0" || digits_before == 0;
      is_certain = is_certain || field.size() - comma - 1 != 3 || digits_before > 3 || is_below_one;
    }
  }
  if (first_comma == 0) return;
  if (first_point != 0 || !is_certain) {
    throw ParseError({path_, first_comma, "row"},
                     {"numbers with a decimal point", "a comma in a number that may be decimal or between thousands",
                      "write the numbers with a point and without commas"});
  }
  has_decimal_comma_ = true;
  out_.notes.push_back(fmt::format("{}:{}: the comma in its numbers is taken as decimal", path_, first_comma));
}

double CsvReader::value(const std::vector<std::string_view>& fields, C column, std::int64_t line) const {
  const std::size_t at = *header_.layout.at(column);
  std::string text(unquoted(fields[at]));
  if (has_decimal_comma_) std::replace(text.begin(), text.end(), ',', '.');
  StationList place;
  place.file = path_;
  return station_number(text, place, line, name_of(column)) * header_.layout.unit[static_cast<std::size_t>(column)];
}

StationRows& CsvReader::rows_of(const std::vector<std::string_view>& fields, std::int64_t line) {
  const auto text = [&](C column) {
    return header_.layout.has(column) ? std::string(trimmed(unquoted(fields[*header_.layout.at(column)])))
                                      : std::string();
  };
  std::string well = header_.layout.has(C::well) ? text(C::well) : well_name_from_path(path_);
  if (well.empty()) throw ParseError({path_, line, "WELL"}, {"the name of a well", "nothing", ""});
  std::string branch = text(C::branch);
  if (branch == "0" || branch == "1") branch.clear();
  const auto [found, is_new] = place_.emplace(std::pair(well, branch), wells_.size());
  if (is_new) {
    const int order = branch.empty() ? 1 : 2 + branches_of_[well]++;
    wells_.push_back({std::move(well), std::move(branch), order, line, {}, {}});
  }
  return wells_[found->second];
}

void CsvReader::take_row(std::string_view line, std::int64_t number) {
  const auto fields = split_fields(line, header_.separator);
  if (is_first_row_ && is_units_row(fields, header_)) {
    for (std::size_t n = 0; n < header_.fields; ++n) {
      const ColumnTitle title = column_title(fields[n]);
      header_.units[n] = title.name.empty() ? title.unit : title.name == "-" ? "" : title.name;
    }
    is_first_row_ = false;
    return set_units();
  }
  is_first_row_ = false;
  if (fields.size() != header_.fields) {
    throw ParseError({path_, number, "row"},
                     {fmt::format("{} fields as in the header", header_.fields), fmt::format("{}", fields.size()), ""});
  }
  const auto get = [&](C column) { return value(fields, column, number); };
  const StationRow row = make_row(header_.layout, number, get);
  StationRows& well = rows_of(fields, number);
  if (well.rows.empty()) {
    if (header_.layout.has(C::head_x)) well.head.x = get(C::head_x);
    if (header_.layout.has(C::head_y)) well.head.y = get(C::head_y);
    if (header_.layout.has(C::datum)) well.head.datum = get(C::datum);
  }
  well.rows.push_back(row);
}

TrajectoryFile CsvReader::finish() {
  if (wells_.empty()) wells_.push_back({well_name_from_path(path_), "", 1, header_line_, {}, {}});
  if (!header_.layout.has(header_.layout.measured_depth_column()))
    out_.notes.push_back(fmt::format("{}: no column MD: arc length is taken", path_));
  if (header_.layout.has(C::z) && header_.layout.has(C::tvd) && header_.layout.depth_column() == C::z)
    out_.notes.push_back(fmt::format("{}:{}: of the columns Z and TVD, Z is taken", path_, header_line_));
  for (StationRows& rows : wells_) {
    const WellHead given = head_for(heads_, rows.well);
    if (!rows.head.x) rows.head.x = given.x;
    if (!rows.head.y) rows.head.y = given.y;
    if (!rows.head.datum) rows.head.datum = given.datum;
    if (!header_.layout.has(C::well)) rows.line = header_line_;
    add_station_rows(out_, path_, header_.layout, std::move(rows), options_);
  }
  return std::move(out_);
}

/// True for "name X" and the like: what follows a heading "X Y TVD MD" in a ResInsight file.
bool is_name_line(std::string_view line) {
  return equal_ignoring_case(line.substr(0, 5), "name ") || equal_ignoring_case(line.substr(0, 8), "wellname");
}

}  // namespace

bool looks_like_trajectory_csv(std::string_view text) {
  LineReader lines(without_byte_order_mark(text));
  while (const auto line = lines.next()) {
    if (const auto header = parse_header(*line)) {
      if (header->separator != ' ') return true;
      auto next = lines.next();
      while (next && is_comment(trimmed(*next))) next = lines.next();
      return !next || !is_name_line(trimmed(*next));
    }
    if (!is_comment(trimmed(*line))) return false;
  }
  return false;
}

TrajectoryFile parse_trajectory_csv(std::string_view text, const std::string& path, const TrajectoryOptions& options) {
  return CsvReader(text, path, options).read();
}

}  // namespace wellknit
