// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Stretches of wells that are to become tubes, and those that share a cavity (docs/algorithms/wells.md).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "algorithm/build_mesh.h"
#include "algorithm/near_well_grid.h"
#include "algorithm/radial_mesh.h"
#include "algorithm/transition_mesh.h"
#include "algorithm/well_sample.h"

namespace wellknit {

/// What all steps from wells to cavities work on.
struct WellTask {
  const CornerPointGrid& grid;
  const HostMesh& host;
  const CellLocator& locator;
  const std::vector<Well>& wells;
  const BuildOptions& options;
  std::vector<WellSample> samples;  ///< per well

  /// A tube of a smaller radius has fewer rings, which grow as those that were asked for.
  [[nodiscard]] Well with_radius(std::size_t w, double radius) const {
    Well well = wells[w];
    well.radial.drainage_radius = radius;
    well.radial.rings = rings_within(wells[w].radial, radius);
    return well;
  }
};

/// A stretch of a well that is to become one tube.
struct Piece {
  std::size_t well = 0;
  MeasuredDepthRange range;  ///< a layered tube runs from top to base: set when it was meshed
  bool layered = false;
  double radius = 0.0;
  bool has_wall = false;  ///< a fault or another obstacle is near
  int extra_levels = 0;   ///< of splitting, beyond what the radius asks for
  int shrinks = 0;        ///< since it was meshed alone
  int cuts = 0;           ///< of the piece that it comes from
};

struct Cluster {
  std::vector<Piece> pieces;
  /// Cells that it must use, since another cavity stands in the same columns; else by its radii.
  std::optional<std::pair<LatticePoint, ColumnLayers>> cells;
  int company = -1;    ///< clusters of one number use the same cells; -1: none
  bool tight = false;  ///< its cavity is not enlarged where a step fails
  std::shared_ptr<const NearWellGrid> grid;
  std::optional<TransitionMesh> mesh;
  std::set<std::array<std::int64_t, 2>> columns;  ///< source columns of the cavity and one near-well column around it
};

/// Why a cluster cannot be meshed as it is.
struct Failure {
  std::string reason;
  std::vector<std::size_t> blamed;  ///< places in the cluster's pieces
  std::vector<TubePlace> places;    ///< of the pieces: where
  bool is_early = false;            ///< before a cavity was tried
};

/// What is left of a piece without the places where it failed, as swept pieces; empty where that is too little.
/// `number`: its place in the cluster.
std::vector<Piece> cut(const Piece& piece, std::size_t number, const Failure& failure);

/// Measured depths of a tube.
MeasuredDepthRange range_of(const Tube& tube);

/// Its drainage radius, m.
double radius_of(const Tube& tube);

}  // namespace wellknit
