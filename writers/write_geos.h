// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// VTK unstructured grid of the shapes that GEOS takes (docs/formats/vtu.md). Points are (x, y, -depth): z up.
#pragma once

#include <string>
#include <vector>

#include "model/mesh.h"
#include "writers/output_file.h"
#include "writers/split_cells.h"

namespace wellknit {

struct GeosOptions {
  std::size_t most_sides = geos_most_sides;  ///< of a prism that stays whole
  std::string region = "FIPNUM";  ///< property of whole numbers that becomes `attribute`; not in the mesh: 1 everywhere
};

/// Writes beside the target and renames. Returns what its user must know, one sentence each. Throws WriteError, and
/// InvalidInput for a negative region. The mesh's structure must be right (check_structure()).
std::vector<std::string> write_geos(const Mesh& mesh, const std::string& path, const GeosOptions& options = {},
                                    Overwrite overwrite = Overwrite::refuse);

}  // namespace wellknit
