// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Multi-point fluxes that carry a linear pressure exactly (docs/algorithms/consistent_flux.md): the two-point flux of
/// each connection, corrected with the slopes of the pressure in its two cells. The slopes come from harmonic averaging
/// points (key `AgelasEymardHerbin2009`), as in averaged multi-point fluxes.
#pragma once

#include <array>
#include <vector>

#include "algorithm/radial_flow.h"
#include "model/mesh.h"

namespace wellknit {

/// What two-point fluxes leave out, as connect_cells() finds it.
struct FluxDefects {
  std::vector<Eigen::Matrix3d> permeability;  ///< of each cell, x, y, depth, m2
  /// Of each connection and its first and second cell, m: A K n / t - d, with t the half transmissibility and d the way
  /// from the centre to the face or from the face to the centre. A slope g of the pressure in the cell adds defect.g to
  /// the drop that drives the flux.
  std::vector<std::array<Vec3, 2>> of_connection;
  /// The linear transmissibility that the defects belong to, over the mesh's.
  std::vector<double> ratio;
  /// Connections through which the flow is a well's, in order.
  struct NearWell {
    ConnectionId connection;
    double radial = 0.0;  ///< how far, 0 to 1
    WellField field;
    double linear = 0.0;  ///< the linear transmissibility, m3, in rock of one permeability
  };
  std::vector<NearWell> near_wells;
};

/// `defects`: of the first connections; those after them keep their two-point flux. Transmissibilities are those of the
/// mesh, so multipliers act on the whole flux. Also of the faces of the outer boundary. The same for any number of
/// threads.
FluxStencils consistent_fluxes(const Mesh& mesh, const FluxDefects& defects);

}  // namespace wellknit
