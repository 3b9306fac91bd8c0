// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A well's path as it was connected: the stretches along it, and two small drawings of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/mesh.h"

namespace wellknit {

/// Part of a well whose cells are of one kind and one owner.
struct WellStretch {
  MeasuredDepthRange range;  ///< m
  CellKind kind = CellKind::host;
  bool own = false;  ///< radial cells of this very well; all others are connected by an index
  std::int64_t cells = 0;
  double well_index = 0.0;  ///< m3, the sum
};

/// Along the well. Neighbours of one kind are one stretch; cells around the bore share a measured depth.
std::vector<WellStretch> stretches_of(const Mesh& mesh, WellId well);

/// The path in a vertical section along itself and in plan, the stretches in their kinds' colours.
std::string well_sketch(const MeshWell& well, const std::vector<WellStretch>& stretches);

}  // namespace wellknit
