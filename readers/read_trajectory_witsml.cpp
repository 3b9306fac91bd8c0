// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_trajectory_witsml.h"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <vector>

#include "model/errors.h"
#include "readers/station_table.h"
#include "readers/text.h"

namespace wellknit {

namespace {

using C = StationColumn;

/// Without the prefix of its name space.
std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const auto colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

/// The versions differ in the case of the first letter.
bool is_named(const pugi::xml_node& node, std::string_view name) { return equal_ignoring_case(local_name(node), name); }

pugi::xml_node child(const pugi::xml_node& parent, std::string_view name) {
  for (const pugi::xml_node& node : parent.children())
    if (is_named(node, name)) return node;
  return {};
}

std::string text_of(const pugi::xml_node& node) { return std::string(trimmed(node.child_value())); }

/// Lines of nodes, from where they stand in the text.
class Lines {
 public:
  explicit Lines(std::string_view text) {
    for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1))
      ends_.push_back(static_cast<std::ptrdiff_t>(at));
  }
  [[nodiscard]] std::int64_t of(const pugi::xml_node& node) const {
    return 1 + (std::lower_bound(ends_.begin(), ends_.end(), node.offset_debug()) - ends_.begin());
  }

 private:
  std::vector<std::ptrdiff_t> ends_;
};

constexpr std::array names{
    std::pair{"md", C::measured_depth}, std::pair{"incl", C::inclination},   std::pair{"azi", C::azimuth},
    std::pair{"tvd", C::tvd},           std::pair{"dispEw", C::east_offset}, std::pair{"dispNs", C::north_offset},
};

const char* element_of(C column) {
  for (const auto& [name, named] : names)
    if (named == column) return name;
  return "md";
}

/// The value of a station's element in metres or radians.
double value_of(const pugi::xml_node& station, C column, const std::string& path, const Lines& lines) {
  const pugi::xml_node node = child(station, element_of(column));
  const std::int64_t line = lines.of(node);
  const std::string name(local_name(node));
  StationList place;
  place.file = path;
  const double value = station_number(text_of(node), place, line, name);
  const std::string unit = node.attribute("uom").as_string();
  const auto factor = si_of_unit(unit, column);
  if (!factor || unit.empty()) {
    throw ParseError({path, line, name},
                     {column == C::inclination || column == C::azimuth ? "the unit dega or rad" : "the unit m or ft",
                      unit.empty() ? "no uom" : quoted_for_message(unit), ""});
  }
  return value * *factor;
}

/// The columns that every station has.
StationLayout layout_of(const std::vector<pugi::xml_node>& stations) {
  StationLayout layout;
  for (std::size_t n = 0; n < names.size(); ++n) {
    const auto& [name, column] = names[n];
    const bool everywhere =
        std::all_of(stations.begin(), stations.end(),
                    [&, key = name](const pugi::xml_node& station) { return !text_of(child(station, key)).empty(); });
    if (everywhere) layout.add(column, n);
  }
  return layout;
}

std::string name_of_trajectory(const pugi::xml_node& trajectory, const std::string& path) {
  for (const char* name : {"nameWellbore", "nameWell", "name"})
    if (const auto text = text_of(child(trajectory, name)); !text.empty()) return text;
  if (const auto text = text_of(child(child(trajectory, "Wellbore"), "Title")); !text.empty()) return text;
  if (const auto text = text_of(child(child(trajectory, "Citation"), "Title")); !text.empty()) return text;
  return well_name_from_path(path);
}

void add_trajectory(TrajectoryFile& out, const pugi::xml_node& trajectory, const Lines& lines, const std::string& path,
                    const TrajectoryOptions& options) {
  std::vector<pugi::xml_node> stations;
  for (const pugi::xml_node& node : trajectory.children())
    if (is_named(node, "trajectoryStation")) stations.push_back(node);
  StationRows rows;
  rows.well = name_of_trajectory(trajectory, path);
  rows.line = lines.of(trajectory);
  if (stations.empty())
    throw ParseError({path, rows.line, "trajectoryStation"}, {"stations with md, incl and azi", "none", ""});
  const StationLayout layout = layout_of(stations);
  if (!layout.source()) {
    throw ParseError({path, rows.line, "trajectoryStation"},
                     {"md, incl and azi, or tvd, dispNs and dispEw, in every station", "stations without them",
                      "export the whole survey"});
  }
  if (const auto reference = text_of(child(trajectory, "aziRef"));
      !reference.empty() && upper_case(reference).find("GRID") == std::string::npos) {
    out.notes.push_back(fmt::format("{}:{}: well {}: its azimuths refer to {}; they are taken as from grid north", path,
                                    rows.line, rows.well, quoted_for_message(reference)));
  }
  rows.rows.reserve(stations.size());
  for (const pugi::xml_node& station : stations) {
    const std::int64_t line = lines.of(station);
    rows.rows.push_back(make_row(layout, line, [&](C column) { return value_of(station, column, path, lines); }));
  }
  add_station_rows(out, path, layout, std::move(rows), options);
}

}  // namespace

bool looks_like_witsml(std::string_view text) {
  text = trimmed(text);
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  if (text.empty() || text.front() != '<') return false;
  const std::string start = upper_case(text.substr(0, 4000));
  return start.find("TRAJECTORY") != std::string::npos &&
         (start.find("WITSML") != std::string::npos || start.find("TRAJECTORYSTATION") != std::string::npos);
}

TrajectoryFile parse_witsml(std::string_view text, const std::string& path, const TrajectoryOptions& options) {
  pugi::xml_document document;
  const auto result = document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_auto);
  if (!result) {
    const auto at = static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0));
    const std::string_view before = text.substr(0, std::min(at, text.size()));
    throw ParseError({path, 1 + std::count(before.begin(), before.end(), '\n'), ""},
                     {"XML", result.description(), "the file is cut or damaged"});
  }
  const Lines lines(text);
  TrajectoryFile out;
  const pugi::xml_node root = document.document_element();
  if (is_named(root, "Trajectory")) {
    add_trajectory(out, root, lines, path, options);
  } else {
    for (const pugi::xml_node& node : root.children())
      if (is_named(node, "trajectory")) add_trajectory(out, node, lines, path, options);
  }
  if (out.wells.empty())
    throw ParseError({path, 0, ""},
                     {"a Trajectory of WITSML", quoted_for_message(root.name()), "export the trajectory object"});
  return out;
}

}  // namespace wellknit
