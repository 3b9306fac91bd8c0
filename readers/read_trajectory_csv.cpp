// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_trajectory_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "model/errors.h"
#include "readers/text.h"
#include "readers/trajectory_stations.h"

namespace wellknit {

namespace {

struct Columns {
  char separator = ',';
  std::vector<std::string> names;  ///< upper case, without units
  std::optional<std::size_t> measured_depth, x, y, depth, well;
  bool depth_may_be_elevation = false;  ///< the column is called Z
  std::string bad_unit;                 ///< a unit that is not metres; empty: none
};

/// Upper case, quotes and the unit in brackets taken off: "Easting [m]" is EASTING.
std::string column_name(std::string_view field, std::string& unit) {
  std::string name = upper_case(trimmed(unquoted(field)));
  const auto bracket = name.find_first_of("([");
  if (bracket != std::string::npos) {
    unit = name.substr(bracket + 1, name.find_first_of(")]") - bracket - 1);
    name = std::string(trimmed(std::string_view(name).substr(0, bracket)));
  }
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

bool is_one_of(const std::string& name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void assign(Columns& columns, const std::string& name, std::size_t at) {
  const auto set = [&](std::optional<std::size_t>& column) {
    if (!column) column = at;
  };
  if (is_one_of(name, {"MD", "MEASURED_DEPTH", "MDEPTH", "MDRKB", "MDMSL"}))
    set(columns.measured_depth);
  else if (is_one_of(name, {"X", "EASTING", "EAST", "X_UTME", "X_COORD"}))
    set(columns.x);
  else if (is_one_of(name, {"Y", "NORTHING", "NORTH", "Y_UTMN", "Y_COORD"}))
    set(columns.y);
  else if (is_one_of(name, {"TVD", "TVDSS", "TVDMSL", "DEPTH", "Z", "Z_TVDSS"})) {
    if (!columns.depth) columns.depth_may_be_elevation = name == "Z";
    set(columns.depth);
  } else if (is_one_of(name, {"WELL", "WELLNAME", "WELL_NAME", "NAME"}))
    set(columns.well);
}

char separator_of(std::string_view line) {
  for (const char separator : {';', '\t', ','})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

/// The columns when the line is a header: X, Y and a depth are there.
std::optional<Columns> parse_header(std::string_view line) {
  line = trimmed(line);
  if (line.substr(0, 3) == "\xEF\xBB\xBF") line.remove_prefix(3);
  Columns columns;
  columns.separator = separator_of(line);
  if (line.substr(0, 1) == "#") {
    // "#MD,X,Y,TVD" is a header; "# X Y TVD MD" is a comment that other formats open with.
    if (columns.separator == ' ' || columns.separator == '\t') return std::nullopt;
    line.remove_prefix(line.find_first_not_of("# \t"));
  } else if (line.substr(0, 2) == "--") {
    return std::nullopt;
  }
  for (const std::string_view field : split_fields(line, columns.separator)) {
    std::string unit;
    const std::string name = column_name(field, unit);
    assign(columns, name, columns.names.size());
    if (!is_one_of(unit, {"", "M", "METRE", "METRES", "METER", "METERS"})) columns.bad_unit = unit;
    columns.names.push_back(name);
  }
  if (!columns.x || !columns.y || !columns.depth) return std::nullopt;
  return columns;
}

bool is_comment(std::string_view line) { return line.empty() || line.front() == '#' || line.substr(0, 2) == "--"; }

/// The header, which comments may precede. Throws ParseError when the first line of content is none.
Columns read_header(LineReader& lines, const std::string& path) {
  while (const auto line = lines.next()) {
    if (auto columns = parse_header(*line)) {
      if (!columns->bad_unit.empty())
        throw ParseError({path, lines.line(), "header"},
                         {"metres", fmt::format("the unit {}", quoted_for_message(columns->bad_unit)),
                          "convert the columns to metres"});
      return *std::move(columns);
    }
    if (!is_comment(trimmed(*line)))
      throw ParseError({path, lines.line(), "header"},
                       {"a header naming the columns MD, X, Y, TVD", quoted_for_message(trimmed(*line)),
                        "add it as the first line"});
  }
  throw ParseError({path, 0, "header"}, {"a header naming the columns MD, X, Y, TVD", "an empty file", ""});
}

/// A row of the table into its well's list; a well is a run of rows with one name.
Station read_row(const std::vector<std::string_view>& fields, const Columns& columns, const StationList& list,
                 std::int64_t line) {
  const auto number = [&](std::size_t column, std::string_view name) {
    return station_number(unquoted(fields[column]), list, line, name);
  };
  Station station;
  station.line = line;
  station.point = {number(*columns.x, "X"), number(*columns.y, "Y"),
                   number(*columns.depth, columns.depth_may_be_elevation ? "Z" : "TVD")};
  if (columns.measured_depth) station.measured_depth = number(*columns.measured_depth, "MD");
  return station;
}

/// Z that is never positive is an elevation.
void turn_elevation(StationList& list, const Columns& columns, std::vector<std::string>& notes) {
  const bool is_elevation =
      columns.depth_may_be_elevation &&
      std::all_of(list.stations.begin(), list.stations.end(), [](const auto& s) { return s.point.z() <= 0.0; });
  if (!is_elevation) return;
  for (Station& station : list.stations) station.point.z() = -station.point.z();
  notes.push_back(fmt::format("{}:{}: well {}: Z is never positive: taken as elevation and turned into depth",
                              list.file, list.line, list.name));
}

}  // namespace

bool looks_like_trajectory_csv(std::string_view text) {
  LineReader lines(text);
  while (const auto line = lines.next()) {
    if (parse_header(*line)) return true;
    if (!is_comment(trimmed(*line))) return false;
  }
  return false;
}

TrajectoryFile parse_trajectory_csv(std::string_view text, const std::string& path) {
  LineReader lines(text);
  const Columns columns = read_header(lines, path);
  TrajectoryFile out;
  StationList list;
  list.file = path;
  list.name = well_name_from_path(path);
  list.has_measured_depth = columns.measured_depth.has_value();
  const auto finish = [&] {
    turn_elevation(list, columns, out.notes);
    add_well(out, std::move(list));
  };
  list.line = lines.line();
  while (const auto line = lines.next()) {
    if (is_comment(trimmed(*line))) continue;
    const auto fields = split_fields(*line, columns.separator);
    if (fields.size() != columns.names.size())
      throw ParseError({path, lines.line(), "row"}, {fmt::format("{} fields as in the header", columns.names.size()),
                                                     fmt::format("{}", fields.size()), ""});
    const std::string name = columns.well ? std::string(unquoted(fields[*columns.well])) : list.name;
    if (name != list.name) {
      const StationList next{path, name, lines.line(), list.has_measured_depth, false, {}};
      if (!list.stations.empty()) finish();
      list = next;
    }
    list.stations.push_back(read_row(fields, columns, list, lines.line()));
  }
  if (!columns.measured_depth) out.notes.push_back(fmt::format("{}: no column MD: arc length is taken", path));
  finish();
  return out;
}

}  // namespace wellknit
