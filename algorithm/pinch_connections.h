// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Connections between cells of a column that share no face: across a gap, and by the PINCH keyword across cells that
/// are left out or thin.
#pragma once

#include <vector>

#include "algorithm/host_mesh.h"
#include "algorithm/host_multipliers.h"

namespace wellknit {

struct PinchConnection {
  HostCellId upper;
  HostCellId lower;
  double transmissibility = 0.0;  ///< m3, multiplied
  double multiplier = 1.0;
};

/// Existing cells of a column that follow each other, with PINCH also those with nothing between them but cells that
/// MINPV leaves out (with NOGAP: only those thinner than the threshold), inactive cells no thicker than the threshold,
/// and cells without thickness (with PINCHOUT alone: only these). Not those that share a face already, nor, with PINCH,
/// those with more void between them than its item 3. Empty without permeability along k.
std::vector<PinchConnection> pinch_connections(const CornerPointGrid& grid, const HostMesh& host,
                                               const HostMultipliers& multipliers);

}  // namespace wellknit
