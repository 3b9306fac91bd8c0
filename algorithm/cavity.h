// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The cavity: which host cells go, and the boundary of the space between them and the tubes (method.md §6).
///
/// Source: T. Mouton, C. Bennis, H. Borouchaki (key Mouton); the admissibility bounds are derived in method.md §6.
/// Notation of method.md: f a boundary face, o_f and rho_f centre and radius of its circle, n_f its unit normal into
/// the cavity, c(t) = o_f + t n_f the centres of the spheres through its vertices.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "algorithm/reference_space.h"
#include "algorithm/well_tube.h"

namespace wellknit {

/// What a vertex of the cavity's boundary is.
struct CavityVertex {
  Vec3 reference = Vec3::Zero();  ///< in E_ref
  Vec3 real = Vec3::Zero();
  bool is_host = false;        ///< a node of the grid; else a point of a tube
  VertexId host;               ///< of the host mesh, host vertices
  NearWellCell node{};         ///< of the near-well grid, host vertices
  std::size_t tube = 0;        ///< place in the cavity's tubes, tube vertices
  std::size_t tube_point = 0;  ///< RadialMesh::point_index
};

enum class BoundaryFaceKind : std::uint8_t { host, lateral, cap };

/// A face of the cavity's boundary; planar in E_ref, its vertices on one circle.
struct BoundaryFace {
  BoundaryFaceKind kind = BoundaryFaceKind::host;
  std::vector<std::int32_t> loop;  ///< into vertices; the right-hand normal points into the cavity
  Vec3 center = Vec3::Zero();      ///< o_f
  double radius = 0.0;             ///< rho_f
  Vec3 normal = Vec3::Zero();      ///< n_f
  double natural = 0.0;            ///< t of the site that makes a cell of natural size, m
  double natural_outside = 0.0;    ///< the same for the outside site, negative
  double t_low = -std::numeric_limits<double>::infinity();
  double t_high = std::numeric_limits<double>::infinity();
  std::int32_t low_vertex = -1;   ///< what sets t_low; -1: nothing
  std::int32_t high_vertex = -1;  ///< what sets t_high; -1: nothing or a plane
  NearWellCell outside{};         ///< kind host: the kept cell behind it, active or not
  NearWellCell removed{};         ///< kind host: the removed cell before it
  HostCellId outside_cell;        ///< kind host: the same in the host, set by bind_to_host()
  HostCellId removed_cell;
  std::size_t tube = 0;  ///< kinds lateral, cap: place in the cavity's tubes
  RadialIndex radial;    ///< kinds lateral, cap: the radial cell behind it; ring -1: the bore
};

/// A plane of the grid's own outside that the cavity meets.
struct MirrorPlane {
  int axis = 0;
  double coordinate = 0.0;
  double inward = 1.0;  ///< sign of the axis' direction into the grid
};

/// A host node on a mirror plane inside the cavity's footprint: no site needs it, the mapping does.
struct PlaneNode {
  Vec3 reference = Vec3::Zero();
  Vec3 real = Vec3::Zero();
};

struct Cavity {
  std::vector<Tube> tubes;
  std::vector<NearWellCell> removed;      ///< in order of their indices
  std::vector<HostCellId> removed_cells;  ///< the same in the host, refined ones too; set by bind_to_host()
  std::vector<CavityVertex> vertices;
  std::vector<BoundaryFace> faces;
  std::vector<MirrorPlane> planes;
  std::vector<PlaneNode> plane_nodes;
  double reference_volume = 0.0;  ///< of the removed boxes less the tubes, m3
  std::int64_t rounds = 0;
};

/// A place on a tube.
struct TubePlace {
  std::size_t tube = 0;  ///< place in the list of tubes
  double measured_depth = 0.0;
  double reach = 0.0;  ///< m on either side that a tube should leave out; 0: one drainage radius
};

/// Why there is no cavity. `tubes` are those to leave out, by place in the list given.
struct NoCavity {
  std::string reason;
  std::vector<std::size_t> tubes;
  bool may_be_larger = false;       ///< a larger cavity may do
  std::vector<TubePlace> places{};  ///< where it fails, as far as is known: a tube that leaves these out may do
};

struct CavityOptions {
  double least_host_clearance = 0.5;  ///< tau of method.md §6: least t_high of a host face over half its removed cell
  double least_radial_clearance =
      0.5;  ///< least t_high of a tube's face over the smaller of its natural t and its radius
  double least_plane_clearance = 0.2;  ///< the same where a plane of the grid's outside sets it
  /// Widths of a shell around each tube of which cells are removed beyond what admissibility asks for, where nothing
  /// keeps them; a width is the larger of half the radius and a cell.
  int dilation = 0;
  std::int64_t most_cells = 120000;  ///< removed; beyond it the well needs a refined host
  std::int64_t most_rounds = 60;     ///< of removing; each takes a cell or more, and few need ten
};

/// Removes cells until every boundary face is admissible and can hold its site.
std::variant<Cavity, NoCavity> build_cavity(const HostFrame& frame, std::vector<Tube> tubes,
                                            const CavityOptions& options);

/// The place on one of the tubes whose axis comes nearest to a point; `mesh`: in E_ref or in the real space.
TubePlace nearest_place(const std::vector<Tube>& tubes, const Vec3& point, RadialMesh Tube::*mesh = &Tube::reference);

/// Gives the cavity's cells, walls and vertices their ids in the host, after refine_host() with a plan that holds the
/// columns of the cavity.
void bind_to_host(const NearWellGrid& grid, const RefinementPlan& plan, Cavity& cavity);

/// Sets t_low and t_high of all faces against all vertices and planes; both end at four times the larger of the face's
/// radius and natural distance, with no vertex named. Parallel over faces; the result does not depend on it.
void set_sphere_bounds(std::vector<BoundaryFace>& faces, const std::vector<CavityVertex>& vertices,
                       const std::vector<MirrorPlane>& planes);

}  // namespace wellknit
