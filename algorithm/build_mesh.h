// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The main job: a host grid and wells in, a hybrid mesh out. The steps are those of method.md §0.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algorithm/adapted_flux.h"
#include "algorithm/collapse_edges.h"
#include "algorithm/optimise_mesh.h"
#include "model/case.h"
#include "model/grid_validity.h"
#include "model/mesh.h"

namespace wellknit {

/// How the mapping between the reference and the real space is corrected (method.md §7).
enum class MappingMethod {
  automatic,  ///< the paper's objective, then smoothing, then stronger means
  paper       ///< the objective of Mouton, Bennis and Borouchaki as written
};

/// What happens to a well at a fault.
enum class FaultPolicy {
  stop,  ///< its tube ends there and another one begins behind
  heal   ///< small throws near the wells are averaged out first (heal_faults.h); at others it stops
};

/// What the mesh has for flow between cells.
enum class Fluxes {
  two_point,   ///< transmissibilities
  consistent,  ///< multi-point fluxes too (consistent_flux.h)
  adapted      ///< transmissibilities fitted to multi-point flow towards the wells (adapted_flux.h)
};

/// Of the space that the mesh is made in (method.md §4).
enum class Metric {
  geometric,    ///< the real one
  permeability  ///< one where the permeability along the wells is isotropic (metric_space.h)
};

/// Steps of the optimisation in the real space.
enum class Optimisation {
  off,
  edges,     ///< short edges are taken out (collapse_edges.h)
  vertices,  ///< inner vertices and centres of transition cells are moved (optimise_mesh.h)
  on         ///< both, the edges first
};

struct BuildOptions {
  MappingMethod mapping = MappingMethod::automatic;
  int threads = 0;             ///< 0: as many as the machine has; the result does not depend on it
  int refinement_levels = -1;  ///< of source columns near wells, each into two along i and j; 0: none; -1: automatic
  FaultPolicy fault_policy = FaultPolicy::stop;
  std::optional<double> heal_throw;  ///< m: the largest throw to heal; unset: see heal_faults()
  Fluxes fluxes = Fluxes::two_point;
  Optimisation optimise = Optimisation::off;
  Metric metric = Metric::geometric;
  int split = 1;  ///< above 1: every column in so many parts along i and j, and no meshes around wells
};

/// A radial mesh along a stretch of a well.
struct TubeSummary {
  MeasuredDepthRange range;  ///< m
  std::string mode;          ///< "layered" or "swept"
  double drainage_radius = 0.0;
  std::int32_t cavity = -1;
};

struct WellSummary {
  std::string name;
  bool meshed = false;
  std::string mode;                ///< of its first tube: "layered" or "swept"; "host cells" when not meshed
  std::string reason;              ///< why it was not meshed and what would help; empty when meshed
  std::int32_t cavity = -1;        ///< of its first tube, 0-based; wells with the same number share one cavity
  std::vector<TubeSummary> tubes;  ///< along the well
  std::int64_t radial_cells = 0;
  std::int64_t segments = 0;
  double radius_wanted = 0.0;          ///< drainage radius asked for, m
  double drainage_radius = 0.0;        ///< the least of its tubes, m
  double length_in_rock = 0.0;         ///< m along the well inside cells of the mesh; to 1/500 of its length
  double length_meshed = 0.0;          ///< m of it that has a radial mesh
  std::int64_t connections = 0;        ///< cells open to the bore
  std::int64_t index_connections = 0;  ///< of these, host or transition cells connected by a Peaceman index
  std::vector<std::string> notes;
};

struct CavitySummary {
  std::int64_t cells_removed = 0;
  std::int64_t cells_refined = 0;
  std::int64_t transition_cells = 0;
  std::int64_t transition_faces = 0;  ///< all faces of the transition cells
  std::int64_t transition_vertices = 0;
  std::int64_t cavity_rounds = 0;  ///< until every face was admissible
  std::int64_t boundary_faces = 0;
  std::int64_t boundary_faces_found = 0;  ///< found again in the power diagram as the very same vertex set
  std::int64_t inverted_tetrahedra = 0;   ///< before the correction of the mapping
  std::int64_t loops = 0;
  std::int64_t points_inserted = 0;
  std::int64_t short_edges = 0;           ///< of the transition cells: below 0.03 drainage radii, after the adjustment
  std::int64_t short_edges_expanded = 0;  ///< that the adjustment lengthened
  std::int64_t outer_nodes_left_out =
      0;  ///< nodes of the grid's outside above or beside the cavity that the mapping does not follow
  std::int64_t cells_closed_after_mapping = 0;  ///< transition cells that no point saw whole, before they were opened
  std::int64_t vertices_moved = 0;              ///< to open them
  std::int64_t cells_merged = 0;                ///< with a neighbour, where moving vertices did not do
  std::int64_t cells_not_seen_from_centre = 0;
};

struct StepTime {
  std::string step;
  double seconds = 0.0;
};

struct BuildSummary {
  std::vector<WellSummary> wells;  ///< in the order given
  std::vector<CavitySummary> cavities;
  std::optional<EdgeCollapse> edge_collapse;     ///< unset: that step was not asked for
  std::optional<MeshOptimisation> optimisation;  ///< unset: not asked for, or there are no transition cells
  std::optional<AffineMap> metric_space;         ///< of the permeability metric; unset: the geometric one
  std::optional<FluxAdaptation> adaptation;      ///< unset: transmissibilities are the geometric ones
  GridValidity validity;                         ///< of the host
  std::vector<StepTime> times;
  std::vector<std::string> notes;
};

struct BuildResult {
  Mesh mesh;
  BuildSummary summary;
};

/// Builds the mesh. A well that cannot be meshed keeps its host cells with a Peaceman index; its summary says why.
/// Throws InvalidInput when the options or the grid make no sense (a negative radius, a well outside of the grid).
BuildResult build_mesh(const Case& source, const std::vector<Well>& wells, const BuildOptions& options);

}  // namespace wellknit
