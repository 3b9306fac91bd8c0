// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Geometric coefficients, coordinates and properties of FEHM (docs/formats/fehm.md). z up, 1-based.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "model/mesh.h"
#include "writers/centre_line.h"
#include "writers/output_file.h"

namespace wellknit {

struct FehmOptions {
  AreaKind areas = AreaKind::effective;
};

/// What the folder may hold.
inline constexpr std::array<std::string_view, 5> fehm_contents{"mesh.stor", "mesh.fehmn", "perm.macro", "rock.macro",
                                                               "wells.csv"};

/// Writes the folder beside its target and renames it. Returns what its user must know, one sentence each. Throws
/// WriteError. The mesh's structure must be right (check_structure()).
std::vector<std::string> write_fehm(const Mesh& mesh, const std::string& path, const FehmOptions& options = {},
                                    Overwrite overwrite = Overwrite::refuse);

}  // namespace wellknit
