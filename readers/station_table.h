// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A table of stations, whatever file it came from: what its columns are called and hold, which of them give the path,
/// and the wells that come out of its rows.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "readers/read_trajectory.h"
#include "readers/trajectory_stations.h"

namespace wellknit {

/// What a column holds.
enum class StationColumn : std::uint8_t {
  other,
  well,
  branch,
  measured_depth,
  inclination,
  azimuth,
  x,
  y,
  east_offset,   ///< from the head
  north_offset,  ///< from the head
  tvdss,         ///< depth below the zero of the grid's depths
  tvd,           ///< depth below the datum; in the grid's frame where no datum is known
  depth,         ///< measured in a survey, else as tvd
  z,             ///< elevation or depth
  head_x,
  head_y,
  datum,
  count
};

/// The column of this name, in any case; without its unit.
StationColumn station_column(std::string_view name);

/// Metres or radians in one of this unit, for a column; nothing when the unit is none of its kind. Empty: m or degrees.
std::optional<double> si_of_unit(std::string_view unit, StationColumn column);

/// Splits "Easting [m]", "MD(ft)" or "TVD_m"'s bracketed forms into name and unit, both in upper case, quotes taken
/// off.
struct ColumnTitle {
  std::string name;
  std::string unit;  ///< empty: none given
};
ColumnTitle column_title(std::string_view field);

/// How the rows give the path.
enum class PathSource : std::uint8_t {
  positions,  ///< x, y and a depth
  offsets,    ///< offsets from the head and a depth
  survey      ///< measured depth, inclination, azimuth
};

/// Which field of a row is what.
struct StationLayout {
  std::array<std::optional<std::size_t>, static_cast<std::size_t>(StationColumn::count)> field;
  std::array<double, static_cast<std::size_t>(StationColumn::count)> unit;  ///< m or rad in one of the column's
  bool z_is_elevation = false;                                              ///< stated by the format

  StationLayout();
  [[nodiscard]] bool has(StationColumn column) const { return at(column).has_value(); }
  [[nodiscard]] const std::optional<std::size_t>& at(StationColumn column) const {
    return field[static_cast<std::size_t>(column)];
  }
  /// The first field of a kind counts, save that an azimuth from grid north goes before another.
  void add(StationColumn column, std::size_t at, bool replaces = false);
  [[nodiscard]] std::optional<PathSource> source() const;
  /// The column that depth is taken from.
  [[nodiscard]] StationColumn depth_column() const;
  [[nodiscard]] StationColumn measured_depth_column() const;
  /// The columns whose values are needed in each row.
  [[nodiscard]] std::vector<StationColumn> needed() const;
};

std::string_view name_of(StationColumn column);

/// A row in metres and radians. `place` is x, y, depth; or offsets and depth; or inclination, azimuth, nothing.
struct StationRow {
  std::int64_t line = 0;
  double measured_depth = 0.0;
  Vec3 place = Vec3::Zero();
};

/// A row from get(column), which gives the value of a needed column in metres or radians.
template <class Get>
StationRow make_row(const StationLayout& layout, std::int64_t line, Get get) {
  StationRow row;
  row.line = line;
  const StationColumn depth = layout.depth_column();
  switch (layout.source().value_or(PathSource::positions)) {
    case PathSource::positions:
      row.place.x() = get(StationColumn::x);
      row.place.y() = get(StationColumn::y);
      row.place.z() = get(depth);
      break;
    case PathSource::offsets:
      row.place.x() = get(StationColumn::east_offset);
      row.place.y() = get(StationColumn::north_offset);
      row.place.z() = get(depth);
      break;
    case PathSource::survey:
      row.place.x() = get(StationColumn::inclination);
      row.place.y() = get(StationColumn::azimuth);
      break;
  }
  if (const StationColumn md = layout.measured_depth_column(); layout.has(md)) row.measured_depth = get(md);
  return row;
}

/// The rows of one well or branch.
struct StationRows {
  std::string well;
  std::string branch;  ///< as in the source; empty: the main bore
  int order = 2;       ///< of a branch whose name is no number: 2 for the first of its well
  std::int64_t line = 0;
  WellHead head;
  std::vector<StationRow> rows;
};

/// Adds the well to the file: its path by the layout's source, its depth by the datum, the rest as add_well. Throws
/// ParseError when a survey lacks its head, turns too sharply, or has an inclination outside 0 to 180 degrees.
void add_station_rows(TrajectoryFile& file, const std::string& path, const StationLayout& layout, StationRows rows,
                      const TrajectoryOptions& options);

/// The name of a branch's well, "A:2", and its number; branch "" or "1" or "0" is the main bore.
void set_branch(StationList& list, const std::string& well, const std::string& branch, int order);

}  // namespace wellknit
