// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The source grid's active cells as hexahedra in VTKHDF (docs/formats/vtkhdf.md). Points are (x, y, -depth): z up.
#pragma once

#include <string>
#include <vector>

#include "model/corner_point_grid.h"
#include "model/mesh.h"
#include "writers/output_file.h"

namespace wellknit {

/// Writes beside the target and renames. Returns what its user must know, one sentence each. Throws WriteError, and
/// InvalidInput where the source is not known (null) or is not the mesh's.
std::vector<std::string> write_vtkhdf(const Mesh& mesh, const CornerPointGrid* source, const std::string& path,
                                      Overwrite overwrite = Overwrite::refuse);

}  // namespace wellknit
