// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The wells' trajectories as VTK polylines (docs/formats/vtp.md). Points are (x, y, -depth): z up.
#pragma once

#include <string>
#include <vector>

#include "model/mesh.h"
#include "writers/output_file.h"

namespace wellknit {

/// Writes beside the target and renames. Returns what its user must know, one sentence each. Throws WriteError.
std::vector<std::string> write_vtp(const Mesh& mesh, const std::string& path, Overwrite overwrite = Overwrite::refuse);

}  // namespace wellknit
