// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Polyhedra in the Dune grid format, for opm-grid's PolyhedralGrid (docs/formats/dgf.md). Depth down, 0-based.
#pragma once

#include <string>
#include <vector>

#include "model/mesh.h"
#include "writers/output_file.h"

namespace wellknit {

/// Writes beside the target and renames. Returns what its user must know, one sentence each. Throws WriteError. The
/// mesh's structure must be right (check_structure()).
std::vector<std::string> write_dgf(const Mesh& mesh, const std::string& path, Overwrite overwrite = Overwrite::refuse);

}  // namespace wellknit
