// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Meshes a cluster: tubes of its pieces, their common cavity, the transition mesh.
#pragma once

#include <string>
#include <vector>

#include "algorithm/well_piece.h"

namespace wellknit {

/// Tries to mesh a cluster as it is. Without a mesh: why.
Failure mesh_once(const WellTask& task, Cluster& cluster);

/// The same for several pieces until a mesh is found: those at fault are cut where they fail, or shrink, and at last
/// give way. A cluster without pieces is left empty. `reasons`, per well: the first why a piece gave way.
void mesh_together(const WellTask& task, Cluster& cluster, std::vector<std::string>& reasons);

}  // namespace wellknit
