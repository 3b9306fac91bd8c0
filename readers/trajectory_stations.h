// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// From the stations of a trajectory file, whatever its format, to a well with a valid path.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/well.h"
#include "readers/read_trajectory.h"

namespace wellknit {

struct Station {
  Vec3 point = Vec3::Zero();    ///< (x, y, depth), m
  double measured_depth = 0.0;  ///< m; not a number: undefined there, and filled in along the path
  bool is_open = false;         ///< a perforation log says so
  std::int64_t line = 0;
};

struct StationList {
  std::string file;
  std::string name;
  std::string parent;  ///< of a branch, as Well::parent
  int branch = 1;
  std::int64_t line = 0;           ///< where the well begins
  bool has_measured_depth = true;  ///< false: arc length is taken
  bool has_perforations = false;   ///< true: `open` of the well follows the stations' is_open
  std::vector<Station> stations;
};

/// The number of a field. Throws ParseError naming the column when it is none, or so large that it is no place on
/// Earth.
double station_number(std::string_view field, const StationList& list, std::int64_t line, std::string_view column);

/// Adds the well to the file's wells. Repeated stations are dropped, undefined measured depths are filled in and a path
/// written from its end is turned, each with a note; measured depth that does not rise between different points, and
/// fewer than two different points, throw ParseError.
void add_well(TrajectoryFile& file, StationList list);

/// Name of a well after its file: no folder, no extension.
std::string well_name_from_path(const std::string& path);

}  // namespace wellknit
