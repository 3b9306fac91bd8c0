// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// SUMMARY keywords that name cells, on the new grid.
#pragma once

#include <functional>
#include <string_view>

#include "conversion/conversion_report.h"
#include "conversion/deck_edits.h"
#include "conversion/source_cells.h"

namespace wellknit {

/// Cells that the mesh holds unchanged are renumbered, the others dropped. `is_meshed`: whether a well of this name has
/// other connections now than in the deck. Throws ParseError.
void convert_summary(const WholeDeck& deck, const CornerPointGrid& grid, const SourceCells& cells,
                     const std::function<bool(std::string_view)>& is_meshed, DeckEdits& edits,
                     ConversionReport& report);

}  // namespace wellknit
