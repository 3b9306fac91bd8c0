// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_trajectory_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "model/errors.h"
#include "readers/station_table.h"
#include "readers/text.h"

namespace wellknit {

namespace {

using C = StationColumn;
using Json = nlohmann::json;

std::int64_t line_at(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  return 1 + std::count(before.begin(), before.end(), '\n');
}

/// A file of well paths is a list of objects with a list of objects: deeper nesting is none, and costs memory.
void require_shallow(std::string_view text, const std::string& path) {
  static constexpr int deepest = 6;
  int depth = 0;
  bool in_text = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (in_text && c == '\\') {
      ++at;
    } else if (c == '"') {
      in_text = !in_text;
    } else if (!in_text && (c == '[' || c == '{')) {
      if (++depth > deepest) {
        throw ParseError({path, line_at(text, at), ""},
                         {"well paths in JSON", "deeper nesting than they have", "is this a well path?"});
      }
    } else if (!in_text && (c == ']' || c == '}')) {
      --depth;
    }
  }
}

Json parse_json(std::string_view text, const std::string& path) {
  require_shallow(text, path);
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw ParseError({path, line_at(text, error.byte), ""},
                     {"JSON", error.byte >= text.size() ? "the end of the file too early" : "a fault in its form",
                      "check brackets, commas and quotes"});
  } catch (const Json::exception&) {
    throw ParseError({path, 0, ""}, {"JSON", "a number or text that cannot be held", ""});
  }
}

/// JSON that was parsed has no lines: the place is the path of names.
double number_of(const Json& object, const char* key, const std::string& place, const std::string& path) {
  const auto found = object.find(key);
  if (found == object.end()) throw ParseError({path, 0, place}, {fmt::format("the number '{}'", key), "none", ""});
  if (!found->is_number())
    throw ParseError({path, 0, place + "." + key},
                     {"a number", quoted_for_message(found->dump(-1, ' ', true, Json::error_handler_t::replace)), ""});
  const double value = found->get<double>();
  // The limit is that of any other format; a literal beyond the range of a double is infinite here.
  if (!(std::abs(value) <= 1e8))
    throw ParseError({path, 0, place + "." + key}, {"a length in metres, below 1e8", fmt::format("{}", value), ""});
  return value;
}

void add_path(TrajectoryFile& out, const Json& object, std::size_t order, const std::string& path,
              const TrajectoryOptions& options) {
  const auto points = object.find("path");
  if (points == object.end() || !points->is_array())
    throw ParseError({path, 0, "path"}, {"a list 'path' of {east, north, tvd, md}", "none", ""});
  StationRows rows;
  rows.line = 1;
  rows.well = well_name_from_path(path) + (order == 0 ? "" : fmt::format("_{}", order + 1));
  if (const auto name = object.find("name"); name != object.end() && name->is_string()) {
    const auto& text = name->get_ref<const std::string&>();
    if (!trimmed(text).empty()) rows.well = std::string(trimmed(text));
  }
  if (object.contains("datumElevation")) rows.head.datum = number_of(object, "datumElevation", "well", path);
  StationLayout layout;
  layout.add(C::x, 0);
  layout.add(C::y, 1);
  layout.add(C::tvd, 2);
  const auto has_md = [](const Json& point) { return point.is_object() && point.contains("md"); };
  const bool all_have_md = std::all_of(points->begin(), points->end(), has_md);
  if (all_have_md)
    layout.add(C::measured_depth, 3);
  else
    out.notes.push_back(fmt::format("{}: well {}: not every station has 'md': arc length is taken", path, rows.well));
  for (std::size_t n = 0; n < points->size(); ++n) {
    const Json& point = (*points)[n];
    const std::string place = fmt::format("path[{}]", n);
    if (!point.is_object())
      throw ParseError({path, 0, place}, {"an object {east, north, tvd, md}", "another value", ""});
    StationRow row;
    row.line = 1;
    row.place = {number_of(point, "east", place, path), number_of(point, "north", place, path),
                 number_of(point, "tvd", place, path)};
    if (all_have_md) row.measured_depth = number_of(point, "md", place, path);
    rows.rows.push_back(row);
  }
  add_station_rows(out, path, layout, std::move(rows), options);
}

}  // namespace

bool looks_like_json_wells(std::string_view text) {
  text = trimmed(text);
  return !text.empty() && (text.front() == '{' || text.front() == '[') &&
         text.substr(0, 100'000).find("\"path\"") != std::string_view::npos;
}

TrajectoryFile parse_json_wells(std::string_view text, const std::string& path, const TrajectoryOptions& options) {
  const Json json = parse_json(text, path);
  TrajectoryFile out;
  const auto add = [&](const Json& object) {
    if (!object.is_object())
      throw ParseError({path, 0, ""}, {"an object {name, datumElevation, path}", "another value", ""});
    add_path(out, object, out.wells.size(), path, options);
  };
  if (json.is_array())
    std::for_each(json.begin(), json.end(), add);
  else
    add(json);
  if (out.wells.empty()) throw ParseError({path, 0, ""}, {"a well path", "an empty list", ""});
  return out;
}

}  // namespace wellknit
