// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// From wells to cavities: which stretches of a well get a tube, of what radius, in which cells, and which of them
/// share a cavity (docs/algorithms/wells.md).
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "algorithm/build_mesh.h"
#include "algorithm/near_well_grid.h"
#include "algorithm/transition_mesh.h"

namespace wellknit {

/// A cavity and the grid it was made in.
struct MeshedCavity {
  std::shared_ptr<const NearWellGrid> grid;
  TransitionMesh mesh;
};

struct MeshedWells {
  std::vector<MeshedCavity> cavities;
  std::vector<WellSummary> wells;
  RefinementPlan plan;
};

/// `wells` have their effective bores; those left out, by place, keep their host cells for the reason given. Throws
/// InvalidInput when a well does not meet the grid.
MeshedWells mesh_wells(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator,
                       const std::vector<Well>& wells, const BuildOptions& options,
                       const std::map<std::size_t, std::string>& left_out = {});

}  // namespace wellknit
