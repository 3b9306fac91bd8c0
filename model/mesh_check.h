// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Validity of a mesh: every violation with its entity, not the first one (docs/formats/hdf5.md, "valid when").
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/mesh.h"

namespace wellknit {

struct Violation {
  std::string check;    ///< such as "cell not watertight"
  std::string entity;   ///< such as "cell 17"
  std::string detail;   ///< figures
};

struct MeshCheckOptions {
  double open_surface_limit = 1e-9;   ///< |sum of area vectors| over the sum of areas, per cell
  double volume_limit = 1e-6;         ///< relative difference of a made cell's stored volume from its faces' fan
};

/// Faces with 3 or more distinct vertices and valid cells; watertight, closed cells of positive volume; finite values; made cells
/// seen whole from their centres; one connection for each inner face; transmissibilities finite and not negative; well cells valid.
std::vector<Violation> check_mesh(const Mesh& mesh, const MeshCheckOptions& options = {});

}  // namespace wellknit
