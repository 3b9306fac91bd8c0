// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_trajectory_las.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "model/errors.h"
#include "readers/station_table.h"
#include "readers/text.h"

namespace wellknit {

namespace {

using C = StationColumn;

/// "MNEM.UNIT  DATA : DESCRIPTION".
struct HeaderLine {
  std::string name;  ///< upper case
  std::string unit;
  std::string_view data;
};

std::optional<HeaderLine> header_line(std::string_view line) {
  const auto dot = line.find('.');
  if (dot == std::string_view::npos) return std::nullopt;
  HeaderLine out;
  out.name = upper_case(trimmed(line.substr(0, dot)));
  std::string_view rest = line.substr(dot + 1);
  // Data and description may both hold a colon (a time); the one between them has a blank before it, or is the last.
  auto colon = rest.find(" :");
  if (colon == std::string_view::npos) colon = rest.find_last_of(':');
  rest = rest.substr(0, colon);
  std::size_t end = 0;
  while (end < rest.size() && !is_blank(rest[end])) ++end;
  out.unit = upper_case(rest.substr(0, end));
  out.data = trimmed(rest.substr(end));
  return out;
}

class LasReader {
 public:
  LasReader(const std::string& path, const TrajectoryOptions& options) : path_(path), options_(options) {
    rows_.well = well_name_from_path(path);
    rows_.line = 1;
  }

  TrajectoryFile read(std::string_view text) {
    LineReader lines(text);
    while (const auto line = lines.next()) {
      const std::string_view content = trimmed(*line);
      if (content.empty() || content.front() == '#') continue;
      if (content.front() == '~')
        begin_section(content, lines.line());
      else
        take_line(content, lines.line());
    }
    return finish(lines.line());
  }

 private:
  void begin_section(std::string_view line, std::int64_t number);
  void take_line(std::string_view line, std::int64_t number);
  void take_version(const HeaderLine& line);
  void take_parameter(const HeaderLine& line, std::int64_t number);
  void take_curve(const HeaderLine& line, std::int64_t number);
  void begin_data(std::int64_t number);
  void take_values(std::string_view line, std::int64_t number);
  void end_row();
  TrajectoryFile finish(std::int64_t last_line);

  const std::string& path_;
  const TrajectoryOptions& options_;
  char section_ = ' ';
  bool wraps_ = false;
  char delimiter_ = ' ';
  double null_ = -999.25;
  StationLayout layout_;
  std::vector<std::string> units_;
  std::vector<double> values_;  ///< of the row so far
  std::int64_t row_line_ = 0;
  std::size_t undefined_rows_ = 0;
  bool has_data_ = false;
  StationRows rows_;
};

void LasReader::begin_section(std::string_view line, std::int64_t number) {
  section_ = line.size() > 1 ? to_upper(line[1]) : ' ';
  if (section_ == 'A') begin_data(number);
}

void LasReader::take_line(std::string_view line, std::int64_t number) {
  if (section_ == 'A') return take_values(line, number);
  const auto header = header_line(line);
  if (!header) return;
  switch (section_) {
    case 'V': return take_version(*header);
    case 'W':
    case 'P': return take_parameter(*header, number);
    case 'C': return take_curve(*header, number);
    default: return;
  }
}

void LasReader::take_version(const HeaderLine& line) {
  if (line.name == "WRAP") wraps_ = equal_ignoring_case(line.data, "YES");
  if (line.name != "DLM") return;
  if (equal_ignoring_case(line.data, "COMMA")) delimiter_ = ',';
  if (equal_ignoring_case(line.data, "TAB")) delimiter_ = '\t';
}

void LasReader::take_parameter(const HeaderLine& line, std::int64_t number) {
  const auto is = [&](std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), line.name) != names.end();
  };
  if (line.name == "WELL" && !line.data.empty()) {
    rows_.well = std::string(line.data);
    rows_.line = number;
  }
  const auto value = parse_real(line.data);
  if (!value) return;
  if (line.name == "NULL") null_ = *value;
  const auto metres = [&] { return *value * si_of_unit(line.unit, C::x).value_or(1.0); };
  if (*value == null_ || std::abs(metres()) > 1e8) return;
  if (is({"X", "XCOORD", "XWELL", "LOCX", "EASTING", "UTMX", "XCRD", "EAST"})) rows_.head.x = metres();
  if (is({"Y", "YCOORD", "YWELL", "LOCY", "NORTHING", "UTMY", "YCRD", "NORTH"})) rows_.head.y = metres();
  if (is({"KB", "EKB", "RKB", "EREF", "DATUM", "EDF"}) && (!rows_.head.datum || line.name != "EDF"))
    rows_.head.datum = metres();
}

void LasReader::take_curve(const HeaderLine& line, std::int64_t number) {
  if (units_.empty()) {
    // The first curve is the index: depth along the bore, whatever it is called.
    if (line.name == "DEPTH" || line.name == "DEPT") {
      layout_.add(C::measured_depth, 0);
      units_.push_back(line.unit);
      return;
    }
  }
  static constexpr std::size_t most = 10'000;
  if (units_.size() >= most)
    throw ParseError({path_, number, "~C"}, {fmt::format("at most {} curves", most), "one more", ""});
  layout_.add(station_column(line.name), units_.size());
  units_.push_back(line.unit);
}

void LasReader::begin_data(std::int64_t number) {
  has_data_ = true;
  if (!layout_.source()) {
    throw ParseError({path_, number, "~A"}, {"curves DEPT, DEVI and AZIM, or X, Y and TVD",
                                             fmt::format("{} curves without them", units_.size()),
                                             "export the well's deviation with the logs"});
  }
  for (const C column : layout_.needed()) {
    const std::string& unit = units_[*layout_.at(column)];
    const auto factor = si_of_unit(unit, column);
    if (!factor) {
      throw ParseError({path_, number, "~C"}, {fmt::format("metres, feet or degrees for {}", name_of(column)),
                                               fmt::format("the unit {}", quoted_for_message(unit)), ""});
    }
    layout_.unit[static_cast<std::size_t>(column)] = *factor;
  }
}

void LasReader::take_values(std::string_view line, std::int64_t number) {
  const auto fields = split_fields(line, delimiter_);
  if (!wraps_ && fields.size() != units_.size()) {
    throw ParseError({path_, number, "~A"}, {fmt::format("{} values, one for each curve", units_.size()),
                                             fmt::format("{}", fields.size()), "check WRAP in the version section"});
  }
  for (const std::string_view field : fields) {
    if (values_.empty()) row_line_ = number;
    const auto value = parse_real(field);
    // Curves of text are nobody's station; a needed one shows as not a number.
    values_.push_back(value.value_or(std::nan("")));
    if (!value) {
      for (const C column : layout_.needed())
        if (*layout_.at(column) == values_.size() - 1)
          throw ParseError({path_, number, std::string(name_of(column))}, {"a number", quoted_for_message(field), ""});
    }
    if (values_.size() == units_.size()) end_row();
  }
}

void LasReader::end_row() {
  const auto needed = layout_.needed();
  const auto at = [&](C column) { return values_[*layout_.at(column)]; };
  if (std::any_of(needed.begin(), needed.end(), [&](C column) { return at(column) == null_; })) {
    ++undefined_rows_;
  } else {
    const auto get = [&](C column) {
      const double metres = at(column) * layout_.unit[static_cast<std::size_t>(column)];
      if (std::abs(metres) > 1e8) {
        throw ParseError(
            {path_, row_line_, std::string(name_of(column))},
            {"a length in metres, below 1e8", fmt::format("{}", metres), "check NULL in the well section"});
      }
      return metres;
    };
    rows_.rows.push_back(make_row(layout_, row_line_, get));
  }
  values_.clear();
}

TrajectoryFile LasReader::finish(std::int64_t last_line) {
  if (!has_data_) throw ParseError({path_, last_line, "~A"}, {"a data section ~A", "none", "the file is cut"});
  if (!values_.empty()) {
    throw ParseError({path_, row_line_, "~A"},
                     {fmt::format("{} values, one for each curve", units_.size()),
                      fmt::format("{} and the end of the file", values_.size()), "the file is cut"});
  }
  TrajectoryFile out;
  if (undefined_rows_ > 0)
    out.notes.push_back(fmt::format("{}: well {}: {} rows with undefined values ({}) are dropped", path_, rows_.well,
                                    undefined_rows_, null_));
  add_station_rows(out, path_, layout_, std::move(rows_), options_);
  return out;
}

}  // namespace

bool looks_like_las(std::string_view text) {
  LineReader lines(text);
  while (const auto line = lines.next()) {
    const std::string_view content = trimmed(*line);
    if (content.empty() || content.front() == '#') continue;
    return content.size() > 1 && content.front() == '~' && to_upper(content[1]) == 'V';
  }
  return false;
}

TrajectoryFile parse_las(std::string_view text, const std::string& path, const TrajectoryOptions& options) {
  return LasReader(path, options).read(text);
}

}  // namespace wellknit
