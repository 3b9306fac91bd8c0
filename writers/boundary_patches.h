// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The faces of the outer boundary by what lies behind them: a side of the source grid, a bore, a fault, inactive rock.
#pragma once

#include <string>
#include <vector>

#include "model/mesh.h"

namespace wellknit {

struct BoundaryPatch {
  /// i_min, i_max, j_min, j_max, k_min, k_max: a side of the source grid (k_min is its top as a rule);
  /// fault: the source cell behind is in the mesh too, but not against this face;
  /// inactive: no cell behind; gap: a layer was left out above or below, and nothing connects across it or a connection
  /// without a face;
  /// bore_<well>: a well's wall and the ends of its bore; other: what the mesh says nothing about.
  std::string name;
  std::vector<FaceId> faces;  ///< in order of their ids; never empty
};

/// Every face with one cell is in one patch. The patches stand in the order above, the bores in that of the wells;
/// those without a face are left out. Sides are told by normals: those of the faces to the neighbours in the source
/// grid, else of the rows of centroids. The mesh's structure must be right (check_structure()).
std::vector<BoundaryPatch> boundary_patches(const Mesh& mesh);

/// Names of letters, digits, '_', '-' and '.', a letter first and no two equal, one for each given: what simulators
/// take for patches, zones and regions.
std::vector<std::string> plain_words(const std::vector<std::string>& names);

}  // namespace wellknit
