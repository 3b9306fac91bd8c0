// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// PFLOTRAN's explicit unstructured grid, text or HDF5, with regions, properties and wells (docs/formats/pflotran.md).
/// z up, 1-based.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/mesh.h"
#include "writers/centre_line.h"
#include "writers/output_file.h"

namespace wellknit {

enum class PflotranGrid : std::uint8_t {
  text,  ///< mesh.uge
  hdf5   ///< mesh.h5
};

struct PflotranOptions {
  PflotranGrid grid = PflotranGrid::text;
  AreaKind areas = AreaKind::effective;
};

/// What the folder may hold.
inline constexpr std::array<std::string_view, 6> pflotran_contents{"mesh.uge",  "mesh.h5",  "properties.h5",
                                                                   "wells.csv", "cards.in", "regions/"};

/// Writes the folder beside its target and renames it. Returns what its user must know, one sentence each. Throws
/// WriteError. The mesh's structure must be right (check_structure()).
std::vector<std::string> write_pflotran(const Mesh& mesh, const std::string& path, const PflotranOptions& options = {},
                                        Overwrite overwrite = Overwrite::refuse);

}  // namespace wellknit
