// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Which cells of the source grid are not what a simulator's user expects of a cell (docs/algorithms/host.md).
#pragma once

#include "algorithm/host_mesh.h"
#include "model/grid_validity.h"

namespace wellknit {

/// Looks at every active cell once. Lengths are odd above pillar_merge_tolerance, as the mesh knows no shorter ones.
/// The result does not depend on the number of threads. Throws InvalidInput where validate(grid) would.
GridValidity check_host_validity(const CornerPointGrid& grid);

/// The same, with open_fault_faces, and the handedness that the mesh took where crossing pillars leave it open.
GridValidity check_host_validity(const CornerPointGrid& grid, const HostMesh& mesh);

}  // namespace wellknit
