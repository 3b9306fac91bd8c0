// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Pore volumes of the source cells as the simulator takes them, and which cells are too small to keep.
#pragma once

#include "model/corner_point_grid.h"

namespace wellknit {

/// Pore volume of every source cell, m3: volume * porosity * net-to-gross * MULTPV * MULTREGP, then the EDIT section's
/// steps on PORV. `volume`: bulk, m3, one a source cell. Throws InvalidInput when MULTREGP names a region set that the
/// grid does not have.
IdVector<HostCellId, double> source_pore_volumes(const CornerPointGrid& grid,
                                                 const IdVector<HostCellId, double>& volume);

/// What MINPV or MINPVV asks of a cell, m3; 0 where nothing does.
double least_pore_volume(const CornerPointGrid& grid, HostCellId cell);

/// True when the grid says anything of pore volumes: porosity, or PORV for every cell it concerns.
bool has_pore_volumes(const CornerPointGrid& grid);

}  // namespace wellknit
