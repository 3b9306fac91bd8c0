// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The result: a watertight polyhedral mesh with its finite-volume connections and wells.
/// The arrays are those of the mesh file (docs/formats/hdf5.md), SI throughout.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/corner_point_grid.h"
#include "model/geometry.h"
#include "model/ids.h"
#include "model/well.h"

namespace wellknit {

enum class CellKind : std::uint8_t {
  host = 0,        ///< an unchanged corner-point cell
  refined = 1,     ///< part of one
  transition = 2,  ///< of the power diagram
  radial = 3
};

enum class ConnectionKind : std::uint8_t { face = 0, fault = 1, deck_nnc = 2, pinch_out = 3 };

/// Place of a radial cell in its well's mesh, each 0-based; -1 for other kinds.
struct RadialIndex {
  std::int32_t segment = -1;  ///< along the well
  std::int32_t sector = -1;   ///< around it
  std::int32_t ring = -1;     ///< outwards
};

/// Vertices and faces. A face's right-hand normal points from its first cell to its second.
struct Faces {
  std::vector<std::int64_t> vertex_start{0};      ///< size()+1 offsets into vertices
  std::vector<VertexId> vertices;                 ///< 3 or more distinct a face, in order around it
  IdVector<FaceId, std::array<CellId, 2>> cells;  ///< the second is no_cell on the outer boundary, the first never is

  [[nodiscard]] std::size_t size() const { return cells.size(); }
  [[nodiscard]] std::span<const VertexId> loop(FaceId face) const {
    const auto begin = static_cast<std::size_t>(vertex_start[face.index()]);
    return {vertices.data() + begin, static_cast<std::size_t>(vertex_start[face.index() + 1]) - begin};
  }
  FaceId add(std::span<const VertexId> loop, CellId from, CellId to) {
    vertices.insert(vertices.end(), loop.begin(), loop.end());
    vertex_start.push_back(static_cast<std::int64_t>(vertices.size()));
    return cells.push_back({from, to});
  }
};

/// One entry per active cell in every array.
struct Cells {
  IdVector<CellId, CellKind> kind;
  IdVector<CellId, Vec3> center;  ///< the point that carries the cell's pressure
  IdVector<CellId, Vec3> centroid;
  IdVector<CellId, double> volume;           ///< m3, bulk
  IdVector<CellId, double> depth;            ///< m, of the cell's pressure
  IdVector<CellId, HostCellId> source_cell;  ///< kinds host and refined; invalid for the others
  IdVector<CellId, WellId> well;             ///< kind radial; invalid for the others
  IdVector<CellId, RadialIndex> radial_index;
  IdVector<CellId, double> pore_volume;  ///< m3
  IdVector<CellId, double> porosity;
  IdVector<CellId, double> net_to_gross;
  /// m2, along the cell's i, j and k; of a made cell along those of its source cells. In a level grid x, y, depth.
  IdVector<CellId, Vec3> permeability;
  std::map<std::string, CellProperty> properties;  ///< carried over, in the units of the source; one value a cell

  [[nodiscard]] std::size_t size() const { return kind.size(); }
};

struct Connections {
  IdVector<ConnectionId, std::array<CellId, 2>> cells;          ///< the smaller id first, each pair once
  IdVector<ConnectionId, FaceId> face;                          ///< invalid for a connection without one
  IdVector<ConnectionId, double> transmissibility;              ///< m3: permeability * area / length
  IdVector<ConnectionId, double> area;                          ///< m2
  IdVector<ConnectionId, Vec3> normal;                          ///< unit, from the first cell to the second
  IdVector<ConnectionId, std::array<double, 2>> half_distance;  ///< m, from each centre to the face's centroid
  IdVector<ConnectionId, double> non_orthogonality;             ///< degrees, face normal to line of centres
  IdVector<ConnectionId, double> k_non_orthogonality;           ///< degrees, the worse of the two sides
  IdVector<ConnectionId, double> planarity;
  IdVector<ConnectionId, ConnectionKind> kind;
  IdVector<ConnectionId, double> multiplier;  ///< already inside the transmissibility
  /// Error of the flux of a linear pressure with a slope along x, y, depth, without multiplier, over the flux |K n| A;
  /// 0 without a face. Empty: not known (a mesh file without it).
  IdVector<ConnectionId, Vec3> linear_flux_error;

  [[nodiscard]] std::size_t size() const { return cells.size(); }
};

/// A cell open to the bore.
struct WellConnection {
  CellId cell;
  double well_index = 0.0;            ///< m3
  MeasuredDepthRange measured_depth;  ///< m
};

struct MeshWell {
  std::string name;
  Trajectory trajectory;
  double bore_radius = 0.0;      ///< m
  double drainage_radius = 0.0;  ///< m; 0 when the well was not meshed
  WellType type = WellType::producer;
  std::optional<double> reference_depth;  ///< m
  std::vector<WellConnection> connections;
};

/// Where each source cell's bulk volume went.
struct Transfer {
  std::vector<std::int64_t> start;  ///< nx ny nz + 1 offsets
  std::vector<CellId> cell;
  std::vector<double> fraction;  ///< of the source cell's bulk volume; an active cell's add up to 1
};

/// Volumes of the source cells, m3, nx ny nz each. Empty: not known (a mesh file without them).
struct SourceVolumes {
  std::vector<double> bulk;
  std::vector<double> pores;  ///< 0 where the cell is not active
};

/// Multi-point fluxes: viscosity times flow, as coefficients, m3, of the cells' potentials. They add up to zero on a
/// connection, and to the transmissibility on a face of the outer boundary.
struct FluxStencils {
  std::vector<std::int64_t> start;  ///< connections + 1 offsets
  std::vector<CellId> cells;        ///< the connection's own two first
  std::vector<double> coefficients;
  std::vector<FaceId> boundary_face;              ///< all faces of the outer boundary, in order
  std::vector<double> boundary_transmissibility;  ///< m3: the coefficient of a potential held at the face, turned round
  std::vector<std::int64_t> boundary_start;       ///< boundary_face.size() + 1 offsets
  std::vector<CellId> boundary_cells;             ///< the face's cell first
  std::vector<double> boundary_coefficients;
};

/// Steady flow through the mesh, as `wellknit solve` computes it.
struct FlowSolution {
  IdVector<CellId, double> pressure;         ///< Pa; not a number in parts of the mesh where nothing holds a pressure
  IdVector<ConnectionId, double> flux;       ///< m3/s, positive from the first cell to the second
  IdVector<WellId, double> well_pressure;    ///< Pa, in the bore at its reference depth; not a number where shut
  IdVector<WellId, double> well_rate;        ///< m3/s, positive out of the rock
  std::vector<double> well_connection_rate;  ///< m3/s, positive into the bore; the wells' connections one after another
  std::string command;                       ///< what was asked for
};

struct Mesh {
  IdVector<VertexId, Vec3> vertices;
  Faces faces;
  Cells cells;
  Connections connections;
  IdVector<WellId, MeshWell> wells;
  Transfer transfer;
  SourceVolumes source_volumes;
  std::optional<FlowSolution> flow;
  std::optional<FluxStencils> stencils;
  std::array<std::int64_t, 3> source_dimensions{};
  std::optional<std::array<double, 6>> mapaxes;
  UnitSystem source_units = UnitSystem::metric;
};

/// Geometry of a face of the mesh.
PolygonGeometry face_geometry(const Mesh& mesh, FaceId face);

}  // namespace wellknit
