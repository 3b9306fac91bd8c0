// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What formats of geometry alone leave out of a mesh.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/mesh.h"

namespace wellknit {

/// One sentence for connections without a face, and one for multipliers of transmissibility, where there are any.
/// `faces` and `whole` name what they are not in: "the polyMesh", "the OpenFOAM case".
std::vector<std::string> notes_of_geometry(const Mesh& mesh, std::string_view faces, std::string_view whole);

}  // namespace wellknit
