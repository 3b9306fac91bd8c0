// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_trajectory_rms.h"

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

constexpr double undefined = -999.0;
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
                     {"the name and kind of a log", "an empty line", "check the number of logs in line 4"});
  const std::string name = upper_case(fields.front());
  if (name == "MDEPTH" || name == "M_MDEPTH" || name == "MD") header.measured_depth = header.columns;
  if (name == "PERF") header.perforation = header.columns;
  ++header.columns;
}

Header read_header(LineReader& lines, const std::string& path) {
  const std::string_view version = header_line(lines, path, "the version, 1.0");
  if (!parse_real(version))
    throw ParseError({path, 1, "header"}, {"the version, 1.0", quoted_for_message(version), "is this an RMS well?"});
  (void)header_line(lines, path, "the type of the well");
  Header header;
  const auto fields = split_fields(header_line(lines, path, "the name and head of the well"), ' ');
  if (fields.size() < 3)
    throw ParseError({path, lines.line(), "header"},
                     {"the well's name, X and Y", fmt::format("{} fields", fields.size()), ""});
  header.name = std::string(unquoted(fields.front()));
  const std::string_view count_line = header_line(lines, path, "the number of logs");
  const std::int64_t count = log_count(count_line, path, lines.line());
  header.columns = coordinates;
  for (std::int64_t n = 0; n < count; ++n)
    take_log(header, header_line(lines, path, "one more log"), path, lines.line());
  return header;
}

Station read_row(const std::vector<std::string_view>& fields, const Header& header, StationList& list,
                 std::int64_t line) {
  if (fields.size() != header.columns) {
    throw ParseError({list.file, line, "row"},
                     {fmt::format("{} numbers: X Y depth and {} logs", header.columns, header.columns - coordinates),
                      fmt::format("{}", fields.size()), "check the number of logs in line 4"});
  }
  Station station;
  station.line = line;
  station.point = {station_number(fields[0], list, line, "X"), station_number(fields[1], list, line, "Y"),
                   station_number(fields[2], list, line, "depth")};
  if (header.measured_depth) {
    station.measured_depth = station_number(fields[*header.measured_depth], list, line, "MD");
    if (station.measured_depth == undefined) list.has_measured_depth = false;
  }
  if (header.perforation) {
    const double code = station_number(fields[*header.perforation], list, line, "PERF");
    station.is_open = code != undefined && code != 0.0;
  }
  return station;
}

}  // namespace

bool looks_like_rms_well(std::string_view text) {
  LineReader lines(text);
  std::array<std::string_view, 4> first{};
  for (auto& line : first) line = trimmed(lines.next().value_or(std::string_view()));
  // A version such as 1.0 alone on the first line, and a count alone on the fourth.
  return parse_real(first[0]) && first[0].find('.') != std::string_view::npos && parse_integer(first[3]).has_value() &&
         split_fields(first[2], ' ').size() >= 3;
}

TrajectoryFile parse_rms_well(std::string_view text, const std::string& path) {
  LineReader lines(text);
  const Header header = read_header(lines, path);
  StationList list;
  list.file = path;
  list.name = header.name;
  list.line = 3;
  list.has_measured_depth = header.measured_depth.has_value();
  list.has_perforations = header.perforation.has_value();
  while (const auto line = lines.next()) {
    const auto fields = split_fields(*line, ' ');
    if (!fields.empty()) list.stations.push_back(read_row(fields, header, list, lines.line()));
  }
  TrajectoryFile out;
  if (header.measured_depth && !list.has_measured_depth)
    out.notes.push_back(fmt::format("{}:{}: well {}: its measured-depth log has undefined values: arc length is taken",
                                    path, list.line, list.name));
  add_well(out, std::move(list));
  return out;
}

}  // namespace wellknit
