// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// VTK unstructured grid with every cell and quality array (docs/formats/vtu.md). Points are (x, y, -depth): z up.
#pragma once

#include <string>

#include "model/mesh.h"
#include "writers/output_file.h"

namespace wellknit {

/// Writes beside the target and renames. Throws WriteError. The mesh's structure must be right (check_structure()).
void write_vtu(const Mesh& mesh, const std::string& path, Overwrite overwrite = Overwrite::refuse);

}  // namespace wellknit
