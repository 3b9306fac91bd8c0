// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// MESH, rocks and wells of TOUGH2, TOUGH3 and iTOUGH2 (docs/formats/tough.md). z up.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "model/mesh.h"
#include "writers/centre_line.h"
#include "writers/output_file.h"

namespace wellknit {

struct ToughOptions {
  /// Characters of an element's name, 5 to 8. 0: 5 where they suffice for all cells, otherwise as few as do.
  int name_length = 0;
  AreaKind areas = AreaKind::effective;
  /// A property of whole numbers, such as "SATNUM": each value is a rock. Empty, or not in the mesh: the kinds of cells
  /// are.
  std::string region;
};

/// What the folder may hold.
inline constexpr std::array<std::string_view, 4> tough_contents{"MESH", "ROCKS", "names.csv", "wells.csv"};

/// Writes the folder beside its target and renames it. Returns what its user must know, one sentence each. Throws
/// WriteError, and InvalidInput for a name length that is out of range or too short for all cells. The mesh's structure
/// must be right (check_structure()).
std::vector<std::string> write_tough(const Mesh& mesh, const std::string& path, const ToughOptions& options = {},
                                     Overwrite overwrite = Overwrite::refuse);

}  // namespace wellknit
