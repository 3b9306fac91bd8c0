// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// In which order cells are written where a format leaves it open: neighbours with near numbers make a simulator's
/// matrix narrow.
#pragma once

#include <cstdint>
#include <vector>

#include "model/mesh.h"

namespace wellknit {

enum class CellOrder : std::uint8_t {
  mesh,   ///< as in the mesh file
  layer,  ///< by the layer, then the row and the column of the source grid that most of the cell lies in
  rcm     ///< reverse Cuthill-McKee on the connection list
};

/// All cells of the mesh, each once.
std::vector<CellId> ordered_cells(const Mesh& mesh, CellOrder order);

/// The source cell that holds most of each cell's volume; invalid where the mesh does not say.
IdVector<CellId, HostCellId> main_source_cells(const Mesh& mesh);

}  // namespace wellknit
