// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Wells as tables of cells: what formats that know a cell only once in a well need.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/mesh.h"
#include "writers/text_file.h"

namespace wellknit {

/// The well's cells in the order in which the bore first meets them, each once: well indices of several perforations
/// of one cell are added up, and the measured depths are the least and the largest of them.
std::vector<WellConnection> cells_of_well(const MeshWell& well);

/// Kh of each of the well's connections, m3: sqrt(kx ky) times the perforation's length, shared evenly between the
/// cells around one stretch of the bore. Never 0.
std::vector<double> permeability_thicknesses(const Mesh& mesh, const MeshWell& well);

/// The well's reference depth, or the depth of its shallowest cell; 0 without cells. m
double reference_depth_of(const Mesh& mesh, const MeshWell& well);

/// One line for each cell of each well, as CSV with a header: well, type, cell, its well index (m3), measured depths
/// and reference depth (m). Cells count from `first_cell`.
void write_well_table(TextFile& out, const Mesh& mesh, std::int64_t first_cell);

/// As a field of CSV: in quotes where commas, quotes or line ends are in it.
std::string csv_field(const std::string& text);

}  // namespace wellknit
