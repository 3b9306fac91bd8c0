// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A grid through OPM Flow and its transmissibilities back, for comparisons.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "model/corner_point_grid.h"

namespace wellknit {

/// Whether a program named flow is on the path.
bool has_flow();

/// Transmissibility, m3, of each pair of source cells (the smaller first) that Flow connects with more than nothing.
/// The grid is written as a deck (METRIC, single phase) into `folder`, which must exist, and Flow is started without
/// simulating. Throws std::runtime_error when Flow fails.
std::map<std::pair<HostCellId, HostCellId>, double> flow_transmissibilities(const CornerPointGrid& grid,
                                                                            const std::string& folder);

}  // namespace wellknit
