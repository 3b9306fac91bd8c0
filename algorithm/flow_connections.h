// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Finite-volume connections of the mesh (method.md §12).
#pragma once

#include "algorithm/assembly.h"
#include "algorithm/cell_locator.h"
#include "algorithm/consistent_flux.h"
#include "algorithm/host_multipliers.h"
#include "model/well.h"

namespace wellknit {

/// What connections are made from.
struct FlowInput {
  const CornerPointGrid& grid;
  const HostMesh& host;
  const CellLocator& locator;
  const HostMultipliers& multipliers;
  const std::vector<Well>& wells;  ///< of the run
};

/// One connection for each inner face: transmissibility, orthogonality, planarity. Radial cells follow a line sink
/// (tube_flow.h), host cells NEWTRAN, transition cells the linear two-point form; where one of the cells was made,
/// with the factor of radial_flow.h. The deck's multipliers act where a connection crosses the faces they belong to.
/// Needs the cells' permeabilities. `defects`, where it is given, takes what the two-point fluxes leave out; nothing
/// where a face carries the radial flow of a well.
void connect_cells(const FlowInput& input, Assembly& assembly, FluxDefects* defects = nullptr);

}  // namespace wellknit
