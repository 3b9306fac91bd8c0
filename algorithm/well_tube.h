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

#include "algorithm/obstacles.h"
#include "algorithm/radial_mesh.h"
#include "algorithm/reference_space.h"
#include "model/well.h"

namespace wellknit {

/// Both meshes have one connectivity. Layered: segment k is layer k of the grid, stations lie on its horizons.
struct Tube {
  std::size_t well = 0;  ///< place in the list of wells of the run
  bool layered = false;
  RadialMesh real;  ///< in the space that the mesh is made in
  RadialMesh reference;
  double reference_radius = 0.0;  ///< of the outermost circle in E_ref, m
  AffineMap space{};              ///< from the real space to that of `real` (metric_space.h)
  std::vector<std::string> notes;
};

/// Why there is no tube: one sentence that says what would help.
struct NoTube {
  std::string reason;
  std::optional<double> measured_depth{};  ///< where a swept one fails, if it is known
};

using TubeOrReason = std::variant<Tube, NoTube>;

/// What the tubes are built in.
struct HostFrame {
  const NearWellGrid& grid;
  const ReferenceSpace& space;

  /// phi_0 of a point of the grid.
  [[nodiscard]] std::optional<Vec3> map(const Vec3& point, HostCellId& hint) const {
    const auto at = grid.locate(point, hint);
    if (!at) return std::nullopt;
    hint = at->source;
    return space.map(*at);
  }
};

/// A sample of the path inside the grid.
struct PathSample {
  double measured_depth = 0.0;
  Vec3 reference = Vec3::Zero();
  NearWellLocation location;
};

/// The path in E_ref: samples inside the grid in order of measured depth; empty when the well misses the grid.
std::vector<PathSample> path_in_reference(const HostFrame& frame, const Well& well);

/// The mode that fits: layered where the path runs within 30 degrees of the layers' normal and drifts, over its length
/// in the grid, by less than the drainage radius (method.md §3).
MeshMode choose_mode(const std::vector<PathSample>& path, double drainage_radius);

/// A tube that is there already, which another one must not touch.
struct Neighbour {
  const RadialMesh* mesh = nullptr;  ///< real
  double radius = 0.0;               ///< m
};

/// How far a swept tube stays away from what it may not cross, in drainage radii.
struct Gaps {
  double outside = 0.2;   ///< top, base and sides of the grid, where the cavity is mirrored
  double obstacle = 1.2;  ///< faults and places without thickness, where the cavity has a wall
  double tube = 0.6;      ///< between two tubes, in the smaller of the two radii
};

/// The parts of the path that a tube may follow, in measured depth, each at least one drainage radius long: inside the
/// grid, in one fault block, clear of its outside and of other tubes, in what is open and one drainage radius beyond.
std::vector<MeasuredDepthRange> clear_stretches(const HostFrame& frame, const Well& well,
                                                const std::vector<PathSample>& path, const Obstacles& obstacles,
                                                const std::vector<Neighbour>& neighbours, const Gaps& gaps);

/// Rings on the grid's horizons from top to base.
TubeOrReason build_layered_tube(const HostFrame& frame, const Well& well, const std::vector<PathSample>& path,
                                const Obstacles& obstacles);

/// Rings normal to the path over a stretch of it. Fewer rings than asked for where they would be too thin.
TubeOrReason build_swept_tube(const HostFrame& frame, const Well& well, const MeasuredDepthRange& stretch);

}  // namespace wellknit
