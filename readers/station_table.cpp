// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/station_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <unordered_map>

#include "model/errors.h"
#include "model/units.h"
#include "readers/minimum_curvature.h"
#include "readers/text.h"

namespace wellknit {

namespace {

using C = StationColumn;

constexpr double degree = std::numbers::pi / 180.0;
/// 1200 / 3937 m: the foot of United States surveys, in coordinates before 2023.
constexpr double metre_per_survey_foot = 1200.0 / 3937.0;

struct Alias {
  std::string_view name;
  C column;
};

/// Names without '_', ' ', '-', '.' and '/'.
constexpr auto aliases = std::to_array<Alias>({
    {"MD", C::measured_depth},
    {"MDEPTH", C::measured_depth},
    {"MEASUREDDEPTH", C::measured_depth},
    {"DEPTHMD", C::measured_depth},
    {"MDDEPTH", C::measured_depth},
    {"DEPT", C::measured_depth},
    {"MDRKB", C::measured_depth},
    {"MDKB", C::measured_depth},
    {"MDRT", C::measured_depth},
    {"MDMSL", C::measured_depth},
    {"INC", C::inclination},
    {"INCL", C::inclination},
    {"INCLINATION", C::inclination},
    {"DEV", C::inclination},
    {"DEVI", C::inclination},
    {"DEVIATION", C::inclination},
    {"AZI", C::azimuth},
    {"AZIM", C::azimuth},
    {"AZIMUTH", C::azimuth},
    {"HAZI", C::azimuth},
    {"AZIMGN", C::azimuth},
    {"AZIGN", C::azimuth},
    {"AZIMTN", C::azimuth},
    {"AZITN", C::azimuth},
    {"X", C::x},
    {"EAST", C::x},
    {"EASTING", C::x},
    {"XUTME", C::x},
    {"XCOORD", C::x},
    {"UTMX", C::x},
    {"UTME", C::x},
    {"Y", C::y},
    {"NORTH", C::y},
    {"NORTHING", C::y},
    {"YUTMN", C::y},
    {"YCOORD", C::y},
    {"UTMY", C::y},
    {"UTMN", C::y},
    {"DX", C::east_offset},
    {"DISPEW", C::east_offset},
    {"XOFFSET", C::east_offset},
    {"EWOFFSET", C::east_offset},
    {"DY", C::north_offset},
    {"DISPNS", C::north_offset},
    {"YOFFSET", C::north_offset},
    {"NSOFFSET", C::north_offset},
    {"TVDSS", C::tvdss},
    {"TVDMSL", C::tvdss},
    {"ZTVDSS", C::tvdss},
    {"SSTVD", C::tvdss},
    {"TVDSUBSEA", C::tvdss},
    {"TVD", C::tvd},
    {"TVDRKB", C::tvd},
    {"TVDKB", C::tvd},
    {"TVDRT", C::tvd},
    {"TRUEVERTICALDEPTH", C::tvd},
    {"DEPTH", C::depth},
    {"Z", C::z},
    {"ELEVATION", C::z},
    {"WELL", C::well},
    {"WELLNAME", C::well},
    {"NAME", C::well},
    {"WELLBORE", C::well},
    {"BRANCH", C::branch},
    {"BRANCHNO", C::branch},
    {"LATERAL", C::branch},
    {"HEADX", C::head_x},
    {"XHEAD", C::head_x},
    {"SURFACEX", C::head_x},
    {"HEADY", C::head_y},
    {"YHEAD", C::head_y},
    {"SURFACEY", C::head_y},
    {"KB", C::datum},
    {"RKB", C::datum},
    {"DATUM", C::datum},
    {"KBELEVATION", C::datum},
    {"DATUMELEVATION", C::datum},
});

std::string reduced(std::string_view name) {
  std::string out;
  for (const char c : name)
    if (c != '_' && c != ' ' && c != '-' && c != '.' && c != '/') out += to_upper(c);
  return out;
}

bool is_one_of(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

std::size_t index_of(C column) { return static_cast<std::size_t>(column); }

/// What the file and the options say, the options first.
WellHead head_of(const StationRows& rows, const TrajectoryOptions& options) {
  WellHead head = options.head;
  if (!head.x) head.x = rows.head.x;
  if (!head.y) head.y = rows.head.y;
  if (!head.datum) head.datum = rows.head.datum;
  return head;
}

/// The head of a path that is measured from it. Throws ParseError when it is not known.
Vec3 needed_head(const StationList& list, WellHead head, bool needs_datum, const TrajectoryOptions& options,
                 std::vector<std::string>& notes) {
  const bool is_whole = head.x && head.y && (head.datum || !needs_datum);
  if (!is_whole && !options.head_may_be_missing) {
    std::string missing;
    if (!head.x || !head.y) missing = "x and y";
    if (needs_datum && !head.datum) missing += missing.empty() ? "the datum (KB)" : " and the datum (KB)";
    throw ParseError({list.file, list.line, "head"},
                     {fmt::format("the head of well {}", list.name), fmt::format("no {}", missing),
                      "add a line '# head X Y KB' (metres), or give x=, y= and kb= with --well"});
  }
  if (!is_whole)
    notes.push_back(fmt::format("{}:{}: well {}: no head is given; its path is shown from x {}, y {}, datum {}",
                                list.file, list.line, list.name, head.x.value_or(0.0), head.y.value_or(0.0),
                                head.datum.value_or(0.0)));
  return {head.x.value_or(0.0), head.y.value_or(0.0), needs_datum ? 0.0 - head.datum.value_or(0.0) : 0.0};
}

/// Z falls along the well where it is an elevation: most of a path below the sea has it negative.
bool is_elevation(const std::vector<StationRow>& rows) {
  const auto less = [](const StationRow& a, const StationRow& b) { return a.place.z() < b.place.z(); };
  const auto [least, most] = std::minmax_element(rows.begin(), rows.end(), less);
  return least->place.z() < 0.0 && -least->place.z() > most->place.z();
}

/// From what the column holds to depth in the grid's frame.
void resolve_depth(StationRows& rows, const StationLayout& layout, const WellHead& head, const StationList& list,
                   std::vector<std::string>& notes) {
  if (rows.rows.empty()) return;
  const C column = layout.depth_column();
  const auto note = [&](const std::string& text) {
    notes.push_back(fmt::format("{}:{}: well {}: {}", list.file, list.line, list.name, text));
  };
  double factor = 1.0;
  double shift = 0.0;
  if (column == C::z && (layout.z_is_elevation || is_elevation(rows.rows))) {
    factor = -1.0;
    if (!layout.z_is_elevation) note("Z falls below 0 along the well: taken as elevation and turned into depth");
  } else if ((column == C::tvd || column == C::depth) && head.datum && *head.datum != 0.0) {
    shift = -*head.datum;
    note(fmt::format("{} is measured from the datum: {} m are taken off to give depth", name_of(column), *head.datum));
  }
  for (StationRow& row : rows.rows) row.place.z() = factor * row.place.z() + shift;
}

void append_rows(StationList& list, const StationRows& rows, const Vec3& origin) {
  list.stations.reserve(rows.rows.size());
  for (const StationRow& row : rows.rows)
    list.stations.push_back({origin + row.place, row.measured_depth, false, row.line});
}

std::string note_of(const StationList& list, std::int64_t line, const std::string& text) {
  return fmt::format("{}:{}: well {}: {}", list.file, line, list.name, text);
}

/// Throws ParseError when a row does not go on from the one before it.
void require_survey_row(const StationList& list, const std::vector<StationRow>& before, const StationRow& row) {
  if (row.place.x() < 0.0 || row.place.x() > std::numbers::pi) {
    throw ParseError({list.file, row.line, "INC"},
                     {"an inclination of 0 to 180 degrees", fmt::format("{:.6g}", row.place.x() / degree), ""});
  }
  if (!before.empty() && row.measured_depth < before.back().measured_depth) {
    throw ParseError(
        {list.file, row.line, "MD"},
        {fmt::format("a measured depth above {}", before.back().measured_depth), fmt::format("{}", row.measured_depth),
         fmt::format("the measured depth of well {} falls: correct the station", list.name)});
  }
}

/// The rows of a survey in rising measured depth, repeated ones dropped, from measured depth 0 on.
std::vector<StationRow> survey_rows(std::vector<StationRow> rows, const StationList& list,
                                    std::vector<std::string>& notes) {
  const auto less = [](const StationRow& a, const StationRow& b) { return a.measured_depth < b.measured_depth; };
  if (rows.size() > 1 && less(rows.back(), rows.front()) && std::is_sorted(rows.rbegin(), rows.rend(), less)) {
    std::reverse(rows.begin(), rows.end());
    notes.push_back(note_of(list, list.line, "written from its end; turned"));
  }
  std::vector<StationRow> kept;
  std::int64_t first_repeated = 0;
  for (const StationRow& row : rows) {
    require_survey_row(list, kept, row);
    const bool is_repeated = !kept.empty() && row.measured_depth == kept.back().measured_depth;
    if (is_repeated && first_repeated == 0) first_repeated = row.line;
    if (!is_repeated) kept.push_back(row);
  }
  if (const std::size_t dropped = rows.size() - kept.size(); dropped > 0)
    notes.push_back(note_of(list, first_repeated, fmt::format("{} repeated stations dropped", dropped)));
  if (!kept.empty() && kept.front().measured_depth > 0.0) {
    StationRow top = kept.front();
    notes.push_back(
        note_of(list, top.line,
                fmt::format("its survey begins at {} m: taken to leave the head vertically", top.measured_depth)));
    top.measured_depth = 0.0;
    top.place.x() = 0.0;
    kept.insert(kept.begin(), top);
  }
  return kept;
}

/// Sharper than any drilled bore between two stations; near half a turn the arc is not defined.
constexpr double sharpest_turn = 120.0 * degree;
/// A hundred turns around: no bore has a tenth of it, and the points put into arcs stay few for rows of nonsense.
constexpr double most_turning = 36'000.0 * degree;

void append_survey(StationList& list, const StationRows& rows, const Vec3& head, std::vector<std::string>& notes) {
  const auto kept = survey_rows(rows.rows, list, notes);
  std::vector<SurveyStation> survey;
  survey.reserve(kept.size());
  double turned = 0.0;
  for (const StationRow& row : kept) {
    survey.push_back({row.measured_depth, row.place.x(), row.place.y()});
    if (survey.size() < 2) continue;
    const double turn = dogleg(survey[survey.size() - 2], survey.back());
    turned += turn;
    if (turned > most_turning) {
      throw ParseError({list.file, row.line, "INC"}, {"turns of at most 36000 degrees in all", "more up to here",
                                                      "check inclination and azimuth, and their units"});
    }
    if (turn > sharpest_turn) {
      throw ParseError({list.file, row.line, "INC"},
                       {"a turn of at most 120 degrees since the station before", fmt::format("{:.1f}", turn / degree),
                        "check inclination and azimuth, and their units"});
    }
  }
  for (const SurveyPoint& at : minimum_curvature(survey, head))
    list.stations.push_back({at.point, at.measured_depth, false, kept[at.station].line});
}

}  // namespace

StationColumn station_column(std::string_view name) {
  static const auto by_name = [] {
    std::unordered_map<std::string_view, C> out;
    for (const Alias& alias : aliases) out.emplace(alias.name, alias.column);
    return out;
  }();
  const auto found = by_name.find(reduced(name));
  return found == by_name.end() ? C::other : found->second;
}

std::optional<double> si_of_unit(std::string_view unit, StationColumn column) {
  const std::string word = upper_case(trimmed(unit));
  if (column == C::inclination || column == C::azimuth) {
    if (is_one_of(word, {"", "DEG", "DEGREE", "DEGREES", "DEGA", "D", "\xC2\xB0", "\xB0"})) return degree;
    if (is_one_of(word, {"RAD", "RADIAN", "RADIANS"})) return 1.0;
    return std::nullopt;
  }
  if (is_one_of(word, {"", "M", "METRE", "METRES", "METER", "METERS", "MSL", "MRKB", "MTVDSS", "MSS"})) return 1.0;
  if (is_one_of(word, {"FT", "FEET", "FOOT", "F", "FTUS", "FT[US]", "USFT", "FTSS"})) {
    const bool survey = word.find("US") != std::string::npos;
    return survey ? metre_per_survey_foot : metre_per_foot;
  }
  return std::nullopt;
}

ColumnTitle column_title(std::string_view field) {
  ColumnTitle out{upper_case(trimmed(unquoted(field))), ""};
  const auto bracket = out.name.find_first_of("([");
  if (bracket == std::string::npos) return out;
  const auto end = out.name.find_last_of(")]");
  const auto length = end == std::string::npos || end <= bracket ? std::string::npos : end - bracket - 1;
  out.unit = std::string(trimmed(std::string_view(out.name).substr(bracket + 1, length)));
  out.name = std::string(trimmed(std::string_view(out.name).substr(0, bracket)));
  return out;
}

StationLayout::StationLayout() {
  unit.fill(1.0);
  unit[index_of(C::inclination)] = unit[index_of(C::azimuth)] = degree;
}

void StationLayout::add(StationColumn column, std::size_t at, bool replaces) {
  auto& place = field[index_of(column)];
  if (column != C::other && (!place || replaces)) place = at;
}

std::optional<PathSource> StationLayout::source() const {
  const bool has_depth = has(C::tvdss) || has(C::tvd) || has(C::z) || has(C::depth);
  if (has(C::x) && has(C::y) && has_depth) return PathSource::positions;
  if (has(C::east_offset) && has(C::north_offset) && has_depth) return PathSource::offsets;
  const bool has_md = has(C::measured_depth) || has(C::depth);
  if (has_md && has(C::inclination) && has(C::azimuth)) return PathSource::survey;
  return std::nullopt;
}

StationColumn StationLayout::depth_column() const {
  for (const C column : {C::tvdss, C::z, C::tvd})
    if (has(column)) return column;
  return C::depth;
}

StationColumn StationLayout::measured_depth_column() const {
  if (has(C::measured_depth)) return C::measured_depth;
  return source() == PathSource::survey ? C::depth : C::measured_depth;
}

std::vector<StationColumn> StationLayout::needed() const {
  std::vector<C> out;
  const auto how = source();
  if (!how) return out;
  const C depth_at = depth_column();
  switch (*how) {
    case PathSource::positions: out = {C::x, C::y, depth_at}; break;
    case PathSource::offsets: out = {C::east_offset, C::north_offset, depth_at}; break;
    case PathSource::survey: out = {C::inclination, C::azimuth}; break;
  }
  if (const C md = measured_depth_column(); has(md)) out.push_back(md);
  for (const C column : {C::head_x, C::head_y, C::datum})
    if (has(column)) out.push_back(column);
  return out;
}

std::string_view name_of(StationColumn column) {
  switch (column) {
    case C::well: return "WELL";
    case C::branch: return "BRANCH";
    case C::measured_depth: return "MD";
    case C::inclination: return "INC";
    case C::azimuth: return "AZI";
    case C::x: return "X";
    case C::y: return "Y";
    case C::east_offset: return "DX";
    case C::north_offset: return "DY";
    case C::tvdss: return "TVDSS";
    case C::tvd: return "TVD";
    case C::depth: return "DEPTH";
    case C::z: return "Z";
    case C::head_x: return "HEAD_X";
    case C::head_y: return "HEAD_Y";
    case C::datum: return "KB";
    case C::other:
    case C::count: break;
  }
  return "column";
}

void set_branch(StationList& list, const std::string& well, const std::string& branch, int order) {
  list.name = well;
  list.parent.clear();
  list.branch = 1;
  if (branch.empty() || branch == "0" || branch == "1") return;
  const auto number = parse_integer(branch);
  list.name = fmt::format("{}:{}", well, branch);
  list.parent = well;
  list.branch = number && *number > 1 && *number < 100'000 ? static_cast<int>(*number) : order;
}

void add_station_rows(TrajectoryFile& file, const std::string& path, const StationLayout& layout, StationRows rows,
                      const TrajectoryOptions& options) {
  StationList list;
  list.file = path;
  list.line = rows.line;
  set_branch(list, rows.well, rows.branch, rows.order);
  list.has_measured_depth = layout.has(layout.measured_depth_column());
  const WellHead head = head_of(rows, options);
  switch (layout.source().value_or(PathSource::positions)) {
    case PathSource::positions:
      resolve_depth(rows, layout, head, list, file.notes);
      append_rows(list, rows, Vec3::Zero());
      break;
    case PathSource::offsets: {
      // Where offsets are from the head, TVD is from its datum.
      const bool needs_datum = layout.depth_column() == C::tvd || layout.depth_column() == C::depth;
      const Vec3 origin = needed_head(list, head, needs_datum, options, file.notes);
      resolve_depth(rows, layout, head, list, file.notes);
      append_rows(list, rows, {origin.x(), origin.y(), 0.0});
      break;
    }
    case PathSource::survey:
      append_survey(list, rows, needed_head(list, head, true, options, file.notes), file.notes);
      break;
  }
  add_well(file, std::move(list));
}

}  // namespace wellknit
