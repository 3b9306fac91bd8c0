// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What the keywords of a whole deck mean for its conversion: which name cells, and how (docs/formats/deck.md).
#pragma once

#include <cstdint>
#include <string_view>

#include "readers/deck_keywords.h"

namespace wellknit {

/// What the conversion does with a keyword.
enum class DeckRole : std::uint8_t {
  kept,                ///< names no cell: passes byte for byte
  refused,             ///< cannot be converted
  array,               ///< one value a cell: transferred
  operation,           ///< EQUALS, COPY …: the arrays that it changes are transferred
  box,                 ///< BOX, ENDBOX: goes with the arrays
  dimensions,          ///< DIMENS
  well_dimensions,     ///< WELLDIMS
  saturation_options,  ///< SATOPTS, ENDSCALE: refused where they ask for directions
  dropped,             ///< means nothing on a connection list, or is inside it already
  grid_carried,        ///< of GRID, into the new GRID section as it stands
  aquifer_cells,       ///< AQUANCON
  cell_summary,        ///< BPR …: records I J K
  connection_summary,  ///< COFR …: records well I J K
  neighbour_summary,   ///< WBP5 …: pressures of cells beside the well's, which a connection list does not have
  well_heads,          ///< WELSPECS
  completions,         ///< COMPDAT
  well_cells,          ///< records that choose connections of wells by their cells: WELOPEN, WPIMULT …
  segment_cells,       ///< COMPSEGS
  connection_order,    ///< COMPORD
  stations,            ///< WELTRAJ
  perforations,        ///< COMPTRAJ
  well_names,          ///< WLIST
  phase,               ///< OIL, WATER, GAS: pass, and are counted
  gas_lift,            ///< WLIFTOPT: passes, and is looked into
  cell_count_array     ///< unknown, with just as many numbers as the grid has cells
};

/// What follows a keyword.
enum class DeckForm : std::uint8_t {
  open,    ///< not read: up to whatever is the next keyword of the table
  flag,    ///< nothing
  record,  ///< one record
  list,    ///< records up to an empty one
  array    ///< numbers up to '/'
};

struct WholeDeckRule {
  std::string_view name;
  std::uint16_t sections;  ///< bits of DeckSection
  DeckForm form;
  DeckRole role;
  std::string_view reason = {};  ///< refused, dropped: why
  std::string_view advice = {};  ///< refused: what to do
};

/// The rule of a keyword (upper case) in this section, or nothing. SUMMARY is read by whole_deck_summary_role().
const WholeDeckRule* find_whole_deck_rule(std::string_view name, DeckSection section);

/// What a keyword of SUMMARY names; `kept` for every one without cells.
DeckRole whole_deck_summary_role(std::string_view name);

/// True for a keyword of SUMMARY that is followed by a record or by records.
bool takes_summary_list(std::string_view name);

}  // namespace wellknit
