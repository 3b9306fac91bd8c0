// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The tube of a well: its radial mesh in the real space and the ideal one in the reference space (method.md §3, §5).
///
/// Source: T. Mouton, C. Bennis, H. Borouchaki (key Mouton), with the layered mode of method.md §3.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "algorithm/cell_locator.h"
#include "algorithm/radial_mesh.h"
#include "algorithm/reference_space.h"
#include "model/well.h"

namespace wellknit {

/// Both meshes have one connectivity. Layered: segment k is layer k of the grid, stations lie on its horizons.
struct Tube {
  std::size_t well = 0;  ///< place in the list of wells of the run
  bool layered = false;
  RadialMesh real;
  RadialMesh reference;
  double reference_radius = 0.0;  ///< of the outermost circle in E_ref, m
  std::vector<std::string> notes;
};

/// Why there is no tube: one sentence that says what would help.
struct NoTube {
  std::string reason;
};

using TubeOrReason = std::variant<Tube, NoTube>;

/// What the tubes are built in.
struct HostFrame {
  const CornerPointGrid& grid;
  const HostMesh& host;
  const CellLocator& locator;
  const ReferenceSpace& space;
};

/// A sample of the path inside the grid.
struct PathSample {
  double measured_depth = 0.0;
  Vec3 reference = Vec3::Zero();
  Location location;
};

/// The path in E_ref: samples inside the grid in order of measured depth; empty when the well misses the grid.
std::vector<PathSample> path_in_reference(const HostFrame& frame, const Well& well);

/// The mode that fits: layered where the path runs within 30 degrees of the layers' normal and drifts, over its length
/// in the grid, by less than the drainage radius (method.md §3).
MeshMode choose_mode(const std::vector<PathSample>& path, double drainage_radius);

/// Rings on the host's horizons from top to base.
TubeOrReason build_layered_tube(const HostFrame& frame, const Well& well, const std::vector<PathSample>& path);

/// Rings normal to the path over the longest stretch that keeps clear of the grid's outside.
TubeOrReason build_swept_tube(const HostFrame& frame, const Well& well, const std::vector<PathSample>& path);

}  // namespace wellknit
