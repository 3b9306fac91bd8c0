// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Validity of a mesh: every violation with its entity, not the first one (docs/formats/hdf5.md, "valid when").
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/mesh.h"

namespace wellknit {

struct Violation {
  std::string check;   ///< such as "cell not watertight"
  std::string entity;  ///< such as "cell 17"
  std::string detail;  ///< figures
};

struct MeshCheckOptions {
  double open_surface_limit = 1e-9;  ///< |sum of area vectors| over the sum of areas, per cell
  double volume_limit = 1e-6;        ///< relative difference of a made cell's stored volume from its faces' fan
  double host_volume_limit = 0.05;   ///< the same for host cells, whose twisted faces may be cut at a fault
  double angle_limit = 1e-3;         ///< degrees, stored non-orthogonality against the faces'
  double transfer_limit = 1e-9;      ///< of the sum of a source cell's fractions from 1
};

/// The one check that a strongly deformed grid may not satisfy although the mesh can be computed with.
inline constexpr std::string_view not_seen_from_centre = "made cell not seen from its centre";

/// Array lengths that fit each other, offsets that rise, indices in range: what every loop over the mesh relies on.
std::vector<Violation> check_structure(const Mesh& mesh);

/// Faces with 3 or more distinct vertices and valid cells; watertight, closed cells of positive volume; finite values;
/// made cells seen whole from their centres; one connection for each inner face; transmissibilities finite and not
/// negative; well cells valid. When the structure is not right, its violations alone: nothing else could be computed.
/// Linear in the size of the mesh, but for sorting.
std::vector<Violation> check_mesh(const Mesh& mesh, const MeshCheckOptions& options = {});

}  // namespace wellknit
