// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Tables of cells, connections and wells (docs/formats/csv.md). Depth down, 0-based, SI.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "model/mesh.h"
#include "writers/output_file.h"

namespace wellknit {

/// What the folder may hold.
inline constexpr std::array<std::string_view, 3> csv_contents{"cells.csv", "connections.csv", "wells.csv"};

/// Writes the folder beside its target and renames it. Returns no notes: nothing of the three is left out. Throws
/// WriteError. The mesh's structure must be right (check_structure()).
std::vector<std::string> write_csv(const Mesh& mesh, const std::string& path, Overwrite overwrite = Overwrite::refuse);

}  // namespace wellknit
