// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// First step of the host: corners of all columns resolved to unique nodes along the pillars.
#pragma once

#include <string>
#include <vector>

#include "algorithm/host_mesh.h"
#include "model/corner_point_grid.h"

namespace wellknit {

struct PillarNodes {
  HostCorners corners;
  IdVector<VertexId, Vec3> nodes;  ///< pillar by pillar, downwards
  std::vector<std::string> notes;  ///< what was mended
};

/// Layers are numbered upwards: more corners have their cell's base above its top than below.
bool is_upside_down(const CornerPointGrid& grid);

/// Depths within pillar_merge_tolerance (chained) are one node, at the least of them. A level that lies above the one
/// before it is moved down to it, as simulators do: a cell with corners in reverse order has no thickness there.
PillarNodes resolve_pillars(const CornerPointGrid& grid);

}  // namespace wellknit
