// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// First step of the host: corners of all columns resolved to unique nodes along the pillars.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "model/corner_point_grid.h"
#include "model/ids.h"

namespace wellknit {

/// A column's horizons, each a top or a base of one of its cells, are its levels: 0 the uppermost, 2 nz - 1 the
/// deepest. Nodes of one pillar are numbered consecutively downwards, so on a pillar ids compare like depths.
struct PillarNodes {
  std::array<std::int64_t, 3> dimensions{};
  bool upside_down = false;        ///< layers are numbered upwards
  IdVector<VertexId, Vec3> nodes;  ///< pillar by pillar
  std::vector<std::int64_t>
      level;  ///< node of level l of corner di + 2 dj of column i + nx j, at 2 nz (corner + 4 column) + l
  std::vector<std::string> notes;  ///< what was mended

  [[nodiscard]] std::int64_t levels() const { return 2 * dimensions[2]; }
  /// Nodes of a column on one of its pillars, downwards; 2 nz of them.
  [[nodiscard]] const std::int64_t* on_pillar(std::int64_t column, int corner) const {
    return level.data() + levels() * (corner + 4 * column);
  }
  /// Layer whose cell lies between levels 2 place and 2 place + 1.
  [[nodiscard]] std::int64_t layer(std::int64_t place) const { return upside_down ? dimensions[2] - 1 - place : place; }
};

/// Depths within pillar_merge_tolerance (chained) are one node, at the least of them. A level that lies above the one
/// before it is moved down to it, as simulators do: a cell with corners in reverse order has no thickness there.
PillarNodes resolve_pillars(const CornerPointGrid& grid);

}  // namespace wellknit
