// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_trajectory_petrel.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "model/errors.h"
#include "readers/station_table.h"
#include "readers/text.h"

namespace wellknit {

namespace {

using C = StationColumn;

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

class PetrelReader {
 public:
  PetrelReader(const std::string& path, const TrajectoryOptions& options) : path_(path), options_(options) {
    rows_.well = well_name_from_path(path);
    rows_.line = 1;
    layout_.z_is_elevation = true;
  }

  TrajectoryFile read(std::string_view text) {
    LineReader lines(text);
    while (const auto line = lines.next()) {
      const std::string_view content = trimmed(*line);
      if (content.empty()) continue;
      if (content.front() == '#')
        take_comment(content, lines.line());
      else if (fields_ == 0)
        take_titles(content, lines.line());
      else
        take_row(content, lines.line());
    }
    if (fields_ == 0) {
      throw ParseError({path_, 0, "header"}, {"a row naming the columns MD X Y Z", "none", "the file is cut"});
    }
    TrajectoryFile out;
    add_station_rows(out, path_, layout_, std::move(rows_), options_);
    return out;
  }

 private:
  void take_comment(std::string_view line, std::int64_t number);
  void take_titles(std::string_view line, std::int64_t number);
  void take_row(std::string_view line, std::int64_t number);

  const std::string& path_;
  const TrajectoryOptions& options_;
  StationRows rows_;
  StationLayout layout_;
  double metre_ = 1.0;  ///< metres in one unit of depth
  std::size_t fields_ = 0;
};

/// What follows the last colon that is not inside the value: "WELL HEAD X-COORDINATE: 461000.0 (m)".
void PetrelReader::take_comment(std::string_view line, std::int64_t number) {
  const std::string upper = upper_case(line);
  if ((contains(upper, "DEPTH") || contains(upper, "TVD")) && contains(upper, "UNITS")) {
    if (contains(upper, "FT-UNITS") || contains(upper, "FEET") || contains(upper, " FT")) metre_ = 0.3048;
    return;
  }
  const auto colon = line.find(':');
  if (colon == std::string_view::npos) return;
  const std::string key = upper.substr(0, colon);
  const std::string_view value = trimmed(line.substr(colon + 1));
  if (contains(key, "WELL NAME")) {
    if (!value.empty()) rows_.well = std::string(unquoted(value));
    rows_.line = number;
    return;
  }
  const bool is_x = contains(key, "HEAD X");
  const bool is_y = contains(key, "HEAD Y");
  const bool is_datum = contains(key, "WELL DATUM") || contains(key, "WELL KB");
  if (!is_x && !is_y && !is_datum) return;
  const auto fields = split_fields(value, ' ');
  StationList place;
  place.file = path_;
  // The datum may be named before its elevation: "KB, Kelly bushing, from MSL: 25.0 (m)".
  for (std::size_t n = 0; n < fields.size(); ++n) {
    if (!parse_real(fields[n])) continue;
    const auto unit = n + 1 < fields.size() ? si_of_unit(column_title(fields[n + 1]).unit, C::x) : 1.0;
    const double metres = station_number(fields[n], place, number, is_datum ? "KB" : "head") * unit.value_or(1.0);
    (is_x ? rows_.head.x : is_y ? rows_.head.y : rows_.head.datum) = metres;
    return;
  }
  if (is_datum) return;
  throw ParseError({path_, number, "head"}, {"a coordinate of the well's head", quoted_for_message(value), ""});
}

void PetrelReader::take_titles(std::string_view line, std::int64_t number) {
  for (const std::string_view field : split_fields(line, ' ')) {
    const ColumnTitle title = column_title(field);
    const C column = station_column(title.name);
    layout_.add(column, fields_++, column == C::azimuth && contains(title.name, "GN"));
  }
  if (!layout_.source()) {
    throw ParseError({path_, number, "header"},
                     {"a row naming the columns MD X Y Z", quoted_for_message(line), "the header is not whole"});
  }
  for (const C column : {C::measured_depth, C::tvd, C::tvdss, C::z, C::depth})
    layout_.unit[static_cast<std::size_t>(column)] = metre_;
}

void PetrelReader::take_row(std::string_view line, std::int64_t number) {
  const auto fields = split_fields(line, ' ');
  if (fields.size() != fields_) {
    throw ParseError({path_, number, "row"}, {fmt::format("{} numbers as in the row of column names", fields_),
                                              fmt::format("{}", fields.size()), "the file is cut or damaged"});
  }
  StationList place;
  place.file = path_;
  const auto get = [&](C column) {
    return station_number(fields[*layout_.at(column)], place, number, name_of(column)) *
           layout_.unit[static_cast<std::size_t>(column)];
  };
  rows_.rows.push_back(make_row(layout_, number, get));
}

}  // namespace

bool looks_like_petrel_trace(std::string_view text) {
  return upper_case(text.substr(0, 200)).find("WELL TRACE FROM PETREL") != std::string::npos;
}

TrajectoryFile parse_petrel_trace(std::string_view text, const std::string& path, const TrajectoryOptions& options) {
  return PetrelReader(path, options).read(text);
}

}  // namespace wellknit
