// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Well indices of host cells that keep their shape.
#pragma once

#include <vector>

#include "algorithm/cell_path.h"
#include "algorithm/host_mesh.h"
#include "model/well.h"

namespace wellknit {

/// A host cell open to the bore. Each cell once; its parts add up.
struct HostWellConnection {
  HostCellId cell;
  double well_index = 0.0;  ///< m3: permeability * length, so rate = well_index * pressure / viscosity; above 0
  MeasuredDepthRange measured_depth;  ///< m, from the first entry to the last exit
};

/// Size of a cell as simulators take it for wells, m: the distances in plan of the middles of its faces across i and
/// across j, and the vertical one across k.
Vec3 well_cell_size(const CornerPointGrid& grid, HostCellId cell);

/// Radius, m, at which the pressure around a well equals that of the cell, in the plane with permeabilities k and sizes
/// d, m.
double peaceman_radius(double k_b, double k_c, double d_b, double d_c);

/// Projected indices of the existing cells along the well's open stretches, in the order of their first entry; bore
/// radius, skin and open ranges are the well's. Cells without permeability across the path are left out. `parts`: of
/// the well's trajectory, cut at refined cells (refined_path.h). Throws InvalidInput where the bore is too wide, or the
/// skin too low, for a cell.
std::vector<HostWellConnection> peaceman_indices(const CornerPointGrid& grid, const HostMesh& host, const Well& well,
                                                 const std::vector<CellPart>& parts);

/// Indices of the existing cells of a deck's open completions, in the deck's order: the connection factor as given,
/// else as a simulator computes it for the whole cell; refined cells share that of their source cell by the path's
/// lengths in them. `parts` in source cells. Throws as above.
std::vector<HostWellConnection> completion_indices(const CornerPointGrid& grid, const HostMesh& host, const Well& well,
                                                   const std::vector<CellPart>& parts);

}  // namespace wellknit
