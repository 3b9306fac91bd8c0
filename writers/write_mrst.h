// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// MATLAB file with MRST's G, rock, T, N and W, which JutulDarcy reads too (docs/formats/mrst.md). Depth down, 1-based.
#pragma once

#include <string>
#include <vector>

#include "model/mesh.h"
#include "writers/output_file.h"

namespace wellknit {

struct MrstOptions {
  /// Points that stand as G.cells.centroids, between which MRST computes: those that carry the pressure, or the
  /// volumes' own.
  bool true_centroids = false;
};

/// Writes beside the target and renames. Returns what its user must know, one sentence each. Throws WriteError. The
/// mesh's structure must be right (check_structure()).
std::vector<std::string> write_mrst(const Mesh& mesh, const std::string& path, const MrstOptions& options = {},
                                    Overwrite overwrite = Overwrite::refuse);

}  // namespace wellknit
