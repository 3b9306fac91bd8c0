// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Wells as sampled paths: which cells they run through, how much of them lies in rock, and what radii there is room
/// for (docs/algorithms/wells.md).
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "algorithm/cell_locator.h"
#include "algorithm/host_mesh.h"
#include "model/well.h"

namespace wellknit {

/// A cell on a well's path.
struct PathCell {
  double measured_depth = 0.0;
  double depth = 0.0;                  ///< m
  std::array<std::int64_t, 3> cell{};  ///< source (i, j, place)
  bool exists = false;
  double weight = 1.0;  ///< length before the path was moved over that after
};

struct WellSample {
  std::vector<PathCell> cells;  ///< inside the grid, evenly spaced along the well
  double length_in_rock = 0.0;  ///< m

  /// Of the length in rock: the part in the given ranges of measured depth.
  [[nodiscard]] double share(const std::vector<MeasuredDepthRange>& ranges) const;
};

/// Throws InvalidInput when the well does not meet the grid.
WellSample sample_well(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator, const Well& well);

/// What the wells beside a well leave for its drainage radius.
struct RadiusLimit {
  double most = std::numeric_limits<double>::infinity();  ///< m
  std::string reason;                                     ///< names the other well; empty without a limit
};

/// Two wells that run beside each other over more than a tenth of either share the room between them.
std::vector<RadiusLimit> radius_limits(const std::vector<Well>& wells, const std::vector<WellSample>& samples);

/// The least drainage radius that is worth a mesh, m; never above the one that is asked for.
double smallest_radius(const Well& well, const WellSample& sample);

}  // namespace wellknit
