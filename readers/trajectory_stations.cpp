// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/trajectory_stations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "model/errors.h"
#include "readers/text.h"

namespace wellknit {

namespace {

/// A micrometre: below the last digit of any survey file.
constexpr double same_point = 1e-6;  // m
/// Twice the Earth's circumference: a number beyond it is in another unit, or no coordinate.
constexpr double farthest = 1e8;  // m

/// Stations of one measured depth that differ by less are one, rounded twice (a tie-in): surveys have decimetres.
constexpr double same_station = 0.05;  // m

double distance(const Station& a, const Station& b) { return (a.point - b.point).norm(); }

/// Undefined measured depths: between two that are defined in proportion to the path, beyond the first and the last of
/// them by its length. With none defined arc length is taken.
void fill_measured_depth(StationList& list, std::vector<std::string>& notes) {
  auto& stations = list.stations;
  const auto is_defined = [](const Station& station) { return !std::isnan(station.measured_depth); };
  const auto missing = static_cast<std::size_t>(
      std::count_if(stations.begin(), stations.end(), [&](const Station& s) { return !is_defined(s); }));
  if (missing == 0) return;
  if (missing == stations.size()) {
    list.has_measured_depth = false;
    notes.push_back(fmt::format("{}:{}: well {}: its measured depth is undefined: arc length is taken", list.file,
                                list.line, list.name));
    return;
  }
  notes.push_back(
      fmt::format("{}:{}: well {}: its measured depth is undefined at {} of {} stations: filled in along the path",
                  list.file, list.line, list.name, missing, stations.size()));
  std::vector<double> arc(stations.size(), 0.0);
  for (std::size_t n = 1; n < stations.size(); ++n) arc[n] = arc[n - 1] + distance(stations[n - 1], stations[n]);
  std::optional<std::size_t> before;
  for (std::size_t n = 0; n < stations.size(); ++n) {
    if (!is_defined(stations[n])) continue;
    for (std::size_t m = before ? *before + 1 : 0; m < n; ++m) {
      double along = stations[n].measured_depth - (arc[n] - arc[m]);
      if (before) {
        const double from = stations[*before].measured_depth;
        const double length = arc[n] - arc[*before];
        const double fraction = length > 0.0 ? (arc[m] - arc[*before]) / length : 0.0;
        along = from + fraction * (stations[n].measured_depth - from);
      }
      stations[m].measured_depth = along;
    }
    before = n;
  }
  for (std::size_t m = *before + 1; m < stations.size(); ++m)
    stations[m].measured_depth = stations[*before].measured_depth + arc[m] - arc[*before];
}

void turn_if_written_from_end(StationList& list, std::vector<std::string>& notes) {
  auto& stations = list.stations;
  const bool falls = std::is_sorted(stations.rbegin(), stations.rend(),
                                    [](const auto& a, const auto& b) { return a.measured_depth < b.measured_depth; });
  if (stations.size() < 2 || !falls || stations.front().measured_depth == stations.back().measured_depth) return;
  std::reverse(stations.begin(), stations.end());
  notes.push_back(fmt::format("{}:{}: well {}: written from its end; turned", list.file, list.line, list.name));
}

void drop_repeated(StationList& list, std::vector<std::string>& notes) {
  std::vector<Station> kept;
  std::int64_t first_line = 0;
  for (const Station& station : list.stations) {
    const bool same_depth =
        !kept.empty() && list.has_measured_depth && kept.back().measured_depth == station.measured_depth;
    if (!kept.empty() && distance(kept.back(), station) <= (same_depth ? same_station : same_point)) {
      if (first_line == 0) first_line = station.line;
      kept.back().is_open = kept.back().is_open || station.is_open;
    } else {
      kept.push_back(station);
    }
  }
  if (kept.size() < list.stations.size()) {
    notes.push_back(fmt::format("{}:{}: well {}: {} repeated stations dropped", list.file, first_line, list.name,
                                list.stations.size() - kept.size()));
  }
  list.stations = std::move(kept);
}

double set_arc_length(StationList& list) {
  double length = 0.0;
  if (!list.has_measured_depth) list.stations.front().measured_depth = 0.0;
  for (std::size_t n = 1; n < list.stations.size(); ++n) {
    length += distance(list.stations[n - 1], list.stations[n]);
    if (!list.has_measured_depth) list.stations[n].measured_depth = length;
  }
  return length;
}

void require_rising(const StationList& list) {
  for (std::size_t n = 1; n < list.stations.size(); ++n) {
    const double before = list.stations[n - 1].measured_depth;
    const Station& station = list.stations[n];
    if (station.measured_depth > before) continue;
    throw ParseError(
        {list.file, station.line, "MD"},
        {fmt::format("a measured depth above {}", before), fmt::format("{}", station.measured_depth),
         fmt::format("the path of well {} goes on while its measured depth does not rise: correct the station",
                     list.name)});
  }
}

/// Measured depth and path are two accounts of one length; far apart, one of them is in another unit.
void compare_lengths(const StationList& list, double arc, std::vector<std::string>& notes) {
  static constexpr double tolerance = 0.05;  // of the path: sparse stations cut corners by less
  const double measured = list.stations.back().measured_depth - list.stations.front().measured_depth;
  if (list.has_measured_depth && std::abs(measured - arc) > tolerance * arc) {
    notes.push_back(
        fmt::format("{}:{}: well {}: measured depth advances {:.6g} m over a path of {:.6g} m; check the units",
                    list.file, list.line, list.name, measured, arc));
  }
}

/// Runs of open stations, each run reaching halfway to the shut stations beside it.
std::vector<MeasuredDepthRange> open_ranges(const std::vector<Station>& stations) {
  std::vector<MeasuredDepthRange> ranges;
  for (std::size_t n = 0; n < stations.size(); ++n) {
    if (!stations[n].is_open) continue;
    const double md = stations[n].measured_depth;
    const double from = n == 0 ? md : 0.5 * (stations[n - 1].measured_depth + md);
    const double to = n + 1 == stations.size() ? md : 0.5 * (md + stations[n + 1].measured_depth);
    if (n > 0 && stations[n - 1].is_open)
      ranges.back().to = to;
    else
      ranges.push_back({from, to});
  }
  // Stations closer than a double can halve leave a range of no length.
  std::erase_if(ranges, [](const MeasuredDepthRange& range) { return range.to <= range.from; });
  return ranges;
}

}  // namespace

double station_number(std::string_view field, const StationList& list, std::int64_t line, std::string_view column) {
  const auto value = parse_real(field);
  const auto fail = [&](const char* expected) {
    throw ParseError({list.file, line, std::string(column)},
                     {expected, field.empty() ? "nothing" : quoted_for_message(field), ""});
  };
  if (!value) fail("a number");
  if (std::abs(*value) > farthest) fail("a length in metres, below 1e8");
  return *value;
}

void add_well(TrajectoryFile& file, StationList list) {
  if (list.has_measured_depth) fill_measured_depth(list, file.notes);
  if (list.has_measured_depth) turn_if_written_from_end(list, file.notes);
  drop_repeated(list, file.notes);
  if (list.stations.size() < 2) {
    throw ParseError({list.file, list.line, ""},
                     {fmt::format("two or more different stations of well {}", list.name),
                      list.stations.empty() ? "none" : "one", "a path needs a start and an end"});
  }
  const double arc = set_arc_length(list);
  require_rising(list);
  compare_lengths(list, arc, file.notes);
  Well well;
  well.name = list.name;
  well.parent = list.parent;
  well.branch = list.branch;
  for (const Station& station : list.stations) {
    well.trajectory.points.push_back(station.point);
    well.trajectory.measured_depth.push_back(station.measured_depth);
  }
  if (list.has_perforations) {
    well.open = open_ranges(list.stations);
    if (well.open.empty())
      file.notes.push_back(
          fmt::format("{}:{}: well {}: its PERF log opens nothing; taken as open over its whole length", list.file,
                      list.line, list.name));
  }
  file.wells.push_back(std::move(well));
}

std::string well_name_from_path(const std::string& path) {
  const std::string stem = std::filesystem::path(path).stem().string();
  return stem.empty() ? "WELL" : stem;
}

}  // namespace wellknit
