// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// VTK unstructured grid of polyhedra with every cell and quality array (docs/formats/vtu.md).
#pragma once

#include <string>

#include "model/mesh.h"

namespace wellknit {

/// Writes beside the target and renames. Throws WriteError.
void write_vtu(const Mesh& mesh, const std::string& path);

}  // namespace wellknit
