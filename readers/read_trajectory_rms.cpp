// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_trajectory_rms.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "model/errors.h"
#include "readers/text.h"
#include "readers/trajectory_stations.h"

namespace wellknit {

namespace {

constexpr double undefined = -999.0;
bool is_undefined(double value) { return value == undefined; }
constexpr std::size_t coordinates = 3;  // columns before the logs

struct Header {
  std::string name;
  std::size_t columns = 0;                    ///< of a row
  std::optional<std::size_t> measured_depth;  ///< column of the log
  std::optional<std::size_t> perforation;
};

/// A line of the header. Throws ParseError when the file ends before it.
std::string_view header_line(LineReader& lines, const std::string& path, const char* expected) {
  const auto line = lines.next();
  if (!line) throw ParseError({path, lines.line() + 1, "header"}, {expected, "the end of the file", "the file is cut"});
  return trimmed(*line);
}

std::int64_t log_count(std::string_view line, const std::string& path, std::int64_t number) {
  static constexpr std::int64_t most = 10'000;
  const auto count = parse_integer(line);
  if (!count || *count < 0 || *count > most)
    throw ParseError({path, number, "header"},
                     {fmt::format("the number of logs, 0 to {}", most), quoted_for_message(line), ""});
  return *count;
}

void take_log(Header& header, std::string_view line, const std::string& path, std::int64_t number) {
  const auto fields = split_fields(line, ' ');
  if (fields.empty())
    throw ParseError({path, number, "header"},
                     {"the name and kind of a log", "an empty line", "check the number of logs in the header"});
  const std::string name = upper_case(fields.front());
  if (name == "MDEPTH" || name == "M_MDEPTH" || name == "MD") header.measured_depth = header.columns;
  if (name == "PERF") header.perforation = header.columns;
  ++header.columns;
}

/// The name in "name X Y [RKB]": all before the numbers, so that it may hold blanks.
std::string head_name(std::string_view line, const std::string& path, std::int64_t number) {
  const auto fields = split_fields(line, ' ');
  std::size_t numbers = 0;
  while (numbers < 3 && numbers + 1 < fields.size() && parse_real(fields[fields.size() - 1 - numbers])) ++numbers;
  // "5 461000 5932000": a name that is a number leaves two.
  if (numbers < 2)
    throw ParseError({path, number, "header"},
                     {"the well's name, X and Y", fmt::format("{} fields", fields.size()), ""});
  const std::string_view last = fields[fields.size() - 1 - numbers];
  return std::string(
      unquoted(trimmed(line.substr(0, static_cast<std::size_t>(last.data() + last.size() - line.data())))));
}

/// Without the escape sequence that a terminal may have left before the version.
std::string_view without_escape(std::string_view line) {
  line = trimmed(line);
  if (line.empty() || line.front() != '\x1B') return line;
  std::size_t at = 1;
  while (at < line.size() && !is_letter(line[at])) ++at;
  return at < line.size() ? trimmed(line.substr(at + 1)) : std::string_view();
}

bool is_version(std::string_view line) {
  line = without_escape(line);
  return line.find('.') != std::string_view::npos && line.find(' ') == std::string_view::npos && parse_real(line);
}

/// All of the header after its version.
Header read_header(LineReader& lines, const std::string& path) {
  (void)header_line(lines, path, "the type of the well");
  Header header;
  const std::string_view head = header_line(lines, path, "the name and head of the well");
  header.name = head_name(head, path, lines.line());
  const std::string_view count_line = header_line(lines, path, "the number of logs");
  const std::int64_t count = log_count(count_line, path, lines.line());
  header.columns = coordinates;
  for (std::int64_t n = 0; n < count; ++n)
    take_log(header, header_line(lines, path, "one more log"), path, lines.line());
  return header;
}

Station read_row(const std::vector<std::string_view>& fields, const Header& header, const StationList& list,
                 std::int64_t line) {
  if (fields.size() != header.columns) {
    throw ParseError({list.file, line, "row"},
                     {fmt::format("{} numbers: X Y depth and {} logs", header.columns, header.columns - coordinates),
                      fmt::format("{}", fields.size()), "check the number of logs in the header"});
  }
  Station station;
  station.line = line;
  station.point = {station_number(fields[0], list, line, "X"), station_number(fields[1], list, line, "Y"),
                   station_number(fields[2], list, line, "depth")};
  if (header.measured_depth) {
    station.measured_depth = station_number(fields[*header.measured_depth], list, line, "MD");
    if (is_undefined(station.measured_depth)) station.measured_depth = std::nan("");
  }
  if (header.perforation) {
    const double code = station_number(fields[*header.perforation], list, line, "PERF");
    station.is_open = !is_undefined(code) && code != 0.0;
  }
  return station;
}

/// A well after its version line; true when another version line followed it.
bool read_well(LineReader& lines, const std::string& path, TrajectoryFile& out) {
  StationList list;
  list.file = path;
  list.line = lines.line() + 2;
  const Header header = read_header(lines, path);
  list.name = header.name;
  list.has_measured_depth = header.measured_depth.has_value();
  list.has_perforations = header.perforation.has_value();
  bool more = false;
  std::size_t without_place = 0;
  while (const auto line = lines.next()) {
    const auto fields = split_fields(*line, ' ');
    if (fields.empty()) continue;
    more = is_version(*line);
    if (more) break;
    const Station station = read_row(fields, header, list, lines.line());
    if (is_undefined(station.point.x()) && is_undefined(station.point.y()))
      ++without_place;
    else
      list.stations.push_back(station);
  }
  if (without_place > 0)
    out.notes.push_back(fmt::format("{}:{}: well {}: {} stations have no place (-999) and are dropped", path, list.line,
                                    list.name, without_place));
  add_well(out, std::move(list));
  return more;
}

}  // namespace

bool looks_like_rms_well(std::string_view text) {
  LineReader lines(text);
  std::array<std::string_view, 4> first{};
  for (auto& line : first) line = trimmed(lines.next().value_or(std::string_view()));
  // A version such as 1.0 alone on the first line, and a count alone on the fourth.
  return is_version(first[0]) && parse_integer(first[3]).has_value() && split_fields(first[2], ' ').size() >= 3;
}

TrajectoryFile parse_rms_well(std::string_view text, const std::string& path, const TrajectoryOptions&) {
  LineReader lines(text);
  const std::string_view version = header_line(lines, path, "the version, 1.0");
  if (!parse_real(without_escape(version)))
    throw ParseError({path, 1, "header"}, {"the version, 1.0", quoted_for_message(version), "is this an RMS well?"});
  TrajectoryFile out;
  for (bool more = true; more;) more = read_well(lines, path, out);
  return out;
}

}  // namespace wellknit
