// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Arrays with one value a cell, of PROPS, REGIONS and SOLUTION, on the new grid.
#pragma once

#include <string>

#include "conversion/conversion_report.h"
#include "conversion/deck_edits.h"
#include "model/corner_point_grid.h"
#include "model/mesh.h"

namespace wellknit {

/// Each array goes where its last keyword stood; its earlier keywords, the operations on it and the boxes go.
void convert_arrays(const WholeDeck& deck, const CornerPointGrid& grid, const Mesh& mesh, DeckEdits& edits,
                    ConversionReport& report);

/// As text for the new GRID section: the arrays that stand in GRID or EDIT and serve later sections.
std::string arrays_of_grid_section(const WholeDeck& deck, const CornerPointGrid& grid, const Mesh& mesh,
                                   ConversionReport& report);

}  // namespace wellknit
