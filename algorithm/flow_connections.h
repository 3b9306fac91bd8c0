// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Finite-volume connections of the mesh and the open cells of the wells (method.md §12).
#pragma once

#include "algorithm/assembly.h"
#include "algorithm/cell_locator.h"
#include "algorithm/host_multipliers.h"
#include "model/well.h"

namespace wellknit {

/// One connection for each inner face: transmissibility, orthogonality, planarity. Radial cells follow the logarithm of
/// radial flow, host cells NEWTRAN, transition cells the linear two-point form with the factor of radial_flow.h. The
/// deck's multipliers act where a connection crosses the faces they belong to. Needs the cells' permeabilities.
void connect_cells(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator,
                   const HostMultipliers& multipliers, Assembly& assembly);

/// Radius of the mean pressure of a ring cell between radii inner and outer in radial flow, m:
/// ln r_0 = (r_2^2 ln r_2 - r_1^2 ln r_1) / (r_2^2 - r_1^2) - 1/2.
double mean_pressure_radius(double inner, double outer);

/// Connections of a tube's innermost cells over the open measured depths of its well: k L theta / (ln(r_0 / r_w) +
/// skin).
std::vector<WellConnection> connect_tube(const Mesh& mesh, const PlacedTube& tube, const Well& well);

/// The part of measured depths [from, to] that is open, m: of the well's open stretches, or of its path where it has
/// none.
double open_length(const Well& well, double from, double to);

}  // namespace wellknit
