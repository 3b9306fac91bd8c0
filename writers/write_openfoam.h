// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// OpenFOAM case folder: constant/polyMesh, fields of permeability and porosity, and what checkMesh needs to start
/// (docs/formats/openfoam.md). Points are (x, y, -depth): z up.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "model/mesh.h"
#include "writers/output_file.h"

namespace wellknit {

/// What the folder may hold: the files that are written, and what checkMesh leaves.
inline constexpr std::array<std::string_view, 14> openfoam_contents{"case.foam",
                                                                    "0/K",
                                                                    "0/porosity",
                                                                    "constant/polyMesh/points",
                                                                    "constant/polyMesh/faces",
                                                                    "constant/polyMesh/owner",
                                                                    "constant/polyMesh/neighbour",
                                                                    "constant/polyMesh/boundary",
                                                                    "constant/polyMesh/cellZones",
                                                                    "constant/polyMesh/faceZones",
                                                                    "constant/polyMesh/sets/",
                                                                    "system/controlDict",
                                                                    "system/fvSchemes",
                                                                    "system/fvSolution"};

/// Writes the folder beside its target and renames it. Returns what its user must know, one sentence each. Throws
/// WriteError. The mesh's structure must be right (check_structure()).
std::vector<std::string> write_openfoam(const Mesh& mesh, const std::string& path,
                                        Overwrite overwrite = Overwrite::refuse);

}  // namespace wellknit
