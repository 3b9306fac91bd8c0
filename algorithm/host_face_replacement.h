// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Last step of a refinement: the faces of refined columns take the places of the source's.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithm/host_strip.h"
#include "algorithm/refinement_lattice.h"

namespace wellknit {

/// What the host's faces are replaced with.
struct FaceReplacement {
  HostFaces faces;  ///< in vertices of the host
  /// For each of them: 1 in a strip between source columns whose layers do not match.
  std::vector<std::uint8_t> is_beside_split;
  StripCuts cuts;                        ///< of the lattice's strips, in vertices of the lattice
  IdVector<VertexId, VertexId> in_host;  ///< the lattice's vertices, nodes and then crossings, in the host
  std::vector<std::uint8_t> is_refined;  ///< i + nx j for each source column
};

/// Drops the faces of refined source columns, gives those that stay the new vertices on their edges, and adds the new
/// faces.
void replace_faces(const RefinementLattice& lattice, FaceReplacement& replacement, HostMesh& host);

}  // namespace wellknit
