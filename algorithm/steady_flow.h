// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Steady single-phase flow on a mesh's connection list: the pressures that balance every cell
/// (docs/algorithms/steady_flow.md). SI; rates are reservoir volumes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "algorithm/pressure_solver.h"
#include "model/mesh.h"

namespace wellknit {

struct WellControl {
  enum class Kind : std::uint8_t {
    pressure,  ///< in the bore at the reference depth, Pa
    rate,      ///< m3/s, positive out of the rock; the bore has one potential, so cells may flow into each other
    shut       ///< no flow between bore and rock
  };
  Kind kind = Kind::shut;
  double value = 0.0;
};

/// A face of the outer boundary with a pressure behind it.
struct HeldFace {
  FaceId face;
  double pressure = 0.0;  ///< Pa, at the face's centroid
};

struct HeldCell {
  CellId cell;
  double pressure = 0.0;  ///< Pa, at the cell's depth
};

struct SteadyFlowProblem {
  double viscosity = 1e-3;              ///< Pa s
  double density = 0.0;                 ///< kg/m3; 0: no gravity
  IdVector<WellId, WellControl> wells;  ///< one for each of the mesh
  std::vector<HeldFace> faces;          ///< each face once, of the outer boundary; nothing flows through the others
  std::vector<HeldCell> cells;          ///< each cell once
  /// m3/s that the rock gives off, spread over the held parts by pore volume (bulk volume where there is none at all):
  /// with it the flow is that of a reservoir whose pressure falls everywhere alike.
  double expansion = 0.0;
  bool consistent = false;  ///< fluxes of the mesh's stencils instead of its transmissibilities
  PressureSolverOptions solver;
};

struct WellFlow {
  double rate = 0.0;                    ///< m3/s, positive out of the rock
  double pressure = 0.0;                ///< Pa, in the bore at the reference depth; not a number where shut or isolated
  double reference_depth = 0.0;         ///< m
  double mean_pressure = 0.0;           ///< Pa, by pore volume, of the part of the mesh that it stands in
  double productivity_index = 0.0;      ///< m3/(s Pa): rate over (mean pressure - bore's); not a number without a drop
  double crossflow = 0.0;               ///< m3/s through connections that flow against the rate
  std::vector<double> connection_rate;  ///< m3/s, positive into the bore; in the order of the mesh
};

/// A connected part of the mesh where nothing holds a pressure and nothing flows.
struct IsolatedPart {
  CellId first_cell;
  std::int64_t cells = 0;
};

struct FlowBalance {
  double in = 0.0;            ///< m3/s into the rock: wells, faces, held cells, expansion
  double out = 0.0;           ///< m3/s
  double error = 0.0;         ///< |in - out| over the larger
  double largest_cell = 0.0;  ///< the largest surplus of a cell over the larger of the two
};

struct SteadyFlow {
  FlowSolution solution;  ///< as the mesh file keeps it, without the command
  IdVector<WellId, WellFlow> wells;
  std::vector<double> face_rate;         ///< m3/s out of the mesh, one for each of the problem's faces
  std::vector<double> cell_rate;         ///< the same for its held cells
  std::vector<IsolatedPart> isolated;    ///< in the order of their first cells; single cells too
  std::int64_t closed_connections = 0;   ///< without transmissibility
  std::int64_t refused_connections = 0;  ///< of negative transmissibility, or not a number: taken as closed
  std::int64_t closed_faces = 0;         ///< held ones that conduct nothing
  std::int64_t unknowns = 0;
  PressureMethod method = PressureMethod::direct;
  int iterations = 0;
  double residual = 0.0;  ///< norm of the equation's residual over that of its right-hand side
  FlowBalance balance;
};

/// Throws InvalidInput: lengths that do not fit the mesh, a viscosity that is not positive, values that are not finite,
/// a held face that is not of the outer boundary, consistent fluxes of a mesh without stencils, anything held twice, a
/// well that is to flow where nothing holds a pressure (the message names the part), and what solve_pressure() throws.
SteadyFlow solve_steady_flow(const Mesh& mesh, const SteadyFlowProblem& problem);

}  // namespace wellknit
