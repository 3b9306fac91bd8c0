// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Well trajectory files of every format in the table (docs/formats/trajectories.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/well.h"

namespace wellknit {

/// Where a survey begins: measured depth is 0 here.
struct WellHead {
  std::optional<double> x;      ///< m
  std::optional<double> y;      ///< m
  std::optional<double> datum;  ///< m above the zero of the grid's depths (mean sea level): KB, RKB
};

struct TrajectoryOptions {
  WellHead head;                     ///< goes before what the file says
  bool head_may_be_missing = false;  ///< a survey without a head then begins at (0, 0, 0), with a note
};

struct TrajectoryFile {
  std::vector<Well> wells;         ///< name, branch, trajectory and open intervals set; the rest at defaults
  std::vector<std::string> notes;  ///< what was mended or assumed: repeated stations, a datum …
};

/// Reads a trajectory file; its format is told by content, then by extension. Throws ParseError.
TrajectoryFile read_trajectory(const std::string& path, const TrajectoryOptions& options = {});

}  // namespace wellknit
