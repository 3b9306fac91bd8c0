// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A mesh file (docs/formats/hdf5.md) back into memory.
#pragma once

#include <string>

#include "model/mesh.h"
#include "model/provenance.h"

namespace wellknit {

struct MeshFile {
  Mesh mesh;
  Provenance provenance;
};

/// Throws ParseError when the file is not a mesh file, is cut, or its arrays do not fit each other.
MeshFile read_mesh(const std::string& path);

}  // namespace wellknit
