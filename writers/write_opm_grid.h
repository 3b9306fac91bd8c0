// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// UnstructuredGrid of OPM as text, for its read_grid() (docs/formats/opm_grid.md). Depth down, 0-based.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/mesh.h"
#include "writers/output_file.h"

namespace wellknit {

/// What stands in the place of the cells' centroids: discretisations take it for the place of a cell's values.
enum class CellPoint : std::uint8_t {
  center,   ///< the point that carries the cell's pressure
  centroid  ///< of its volume
};

struct OpmGridOptions {
  CellPoint cell_point = CellPoint::center;
};

/// Writes beside the target and renames. Returns what its user must know, one sentence each. Throws WriteError. The
/// mesh's structure must be right (check_structure()).
std::vector<std::string> write_opm_grid(const Mesh& mesh, const std::string& path, const OpmGridOptions& options = {},
                                        Overwrite overwrite = Overwrite::refuse);

}  // namespace wellknit
