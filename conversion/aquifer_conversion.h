// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Analytical aquifers on the new grid: AQUANCON by cells, with explicit coefficients.
#pragma once

#include <string>

#include "conversion/conversion_report.h"
#include "conversion/deck_edits.h"
#include "conversion/source_cells.h"

namespace wellknit {

/// Rewrites the keywords of SOLUTION; returns those of GRID as text for the new GRID section. The coefficient of a
/// face is its area, or what the record states, times the record's multiplier; a cell that was replaced shares it out
/// by volume. Throws ParseError.
std::string convert_aquifers(const WholeDeck& deck, const CornerPointGrid& grid, const SourceCells& cells,
                             DeckEdits& edits, ConversionReport& report);

}  // namespace wellknit
