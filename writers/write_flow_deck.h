// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A self-contained deck that OPM Flow runs: the mesh as a connection list, the wells on bottom-hole pressure
/// (docs/formats/deck.md).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/corner_point_grid.h"
#include "model/mesh.h"
#include "writers/cell_order.h"
#include "writers/deck_layout.h"
#include "writers/output_file.h"

namespace wellknit {

/// The fluids of the deck's template.
enum class FlowFluids : std::uint8_t {
  oil_and_water,  ///< dead oil at connate water, compressible; injectors bring water
  water           ///< one phase, next to incompressible: reaches its steady state at once
};

struct FlowDeckOptions {
  FlowFluids fluids = FlowFluids::oil_and_water;
  DeckLayoutKind layout = DeckLayoutKind::row;
  CellOrder order = CellOrder::mesh;
};

/// Writes beside the target and renames. Returns what a user of the deck must know, one sentence each: cells left out,
/// connections that Flow will not see, wells renamed. `source` is the mesh's source grid, which the nested layout
/// needs. Throws WriteError, and InvalidInput for a mesh without cells, and as make_deck_layout() does. The mesh's
/// structure must be right (check_structure()).
std::vector<std::string> write_flow_deck(const Mesh& mesh, const std::string& path, const FlowDeckOptions& options = {},
                                         Overwrite overwrite = Overwrite::refuse,
                                         const CornerPointGrid* source = nullptr);

/// Files beside a deck that say which cell stands where; beside OUT.DATA, with the base name that Flow gives its own
/// output (upper case): OUT_CELLS.grdecl where the deck's cells are not in the mesh's order, and OUT_REFINE.grdecl and
/// OUT_OLDIJK.grdecl, which ResInsight reads, of the nested layout.
std::vector<std::string> flow_deck_side_files(const std::string& path, const FlowDeckOptions& options);

/// Writes these files, in that order, to `paths`. Throws as write_flow_deck() does.
void write_flow_deck_side_files(const Mesh& mesh, const std::vector<std::string>& paths, const FlowDeckOptions& options,
                                Overwrite overwrite, const CornerPointGrid* source);

}  // namespace wellknit
