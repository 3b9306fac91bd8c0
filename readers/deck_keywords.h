// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The keywords of a deck that the reader knows, and in which sections it looks for them.
#pragma once

#include <cstdint>
#include <string_view>

namespace wellknit {

enum class DeckSection : std::uint16_t {
  bare = 1,  ///< no section keyword yet: a GRDECL file
  runspec = 2,
  grid = 4,
  edit = 8,
  props = 16,
  regions = 32,
  solution = 64,
  summary = 128,
  schedule = 256
};

enum class DeckAction : std::uint8_t {
  begin_section,
  include,
  end,
  end_include,
  skip_block,        ///< up to ENDSKIP
  flag,              ///< known, without data and without meaning for the grid
  skip,              ///< the same, with data
  skip_record,       ///< the same, one record
  not_applied,       ///< would change pore volumes or transmissibilities: noted
  not_applied_list,  ///< the same, records up to an empty one
  refuse,            ///< changes what the grid is
  title,
  paths,
  units,
  dimensions,
  specgrid,
  coord,
  zcorn,
  spacing,  ///< DXV, DYV, DZV
  cell_array,
  box,
  end_box,
  operation,  ///< EQUALS, COPY …
  mapaxes,
  grid_unit,
  pinch,
  welspecs,
  compdat,
  injectors,  ///< WCONINJE …
  well_path   ///< WELTRAJ, COMPTRAJ, WELSEGS, COMPSEGS, WLIST
};

struct DeckKeywordRule {
  std::string_view name;
  DeckAction action;
  std::uint16_t sections;        ///< bits of DeckSection
  std::string_view detail = {};  ///< refuse: what it asks for
};

/// The rule of a keyword (upper case) in this section, or nothing.
const DeckKeywordRule* find_deck_keyword(std::string_view name, DeckSection section);

/// True for a keyword that has a rule in any section.
bool is_known_keyword(std::string_view name);

/// The section that a keyword begins.
DeckSection section_of(std::string_view name);

/// True in sections where a keyword without a rule is worth a note; in the others only keywords with a rule are looked
/// at.
constexpr bool reports_unknown(DeckSection section) {
  return section == DeckSection::bare || section == DeckSection::grid || section == DeckSection::edit ||
         section == DeckSection::regions;
}

enum class CellArrayKind : std::uint8_t { real, integer };

struct CellArrayRule {
  std::string_view name;
  CellArrayKind kind = CellArrayKind::real;
  double default_value = 0.0;
  bool has_default = true;      ///< false: every active cell needs a value of its own
  bool only_top_layer = false;  ///< may stop after one layer (TOPS)
};

/// The rule of a keyword with one value a cell (upper case), or nothing. A FIP… name is a region array.
const CellArrayRule* find_cell_array(std::string_view name);

/// True for arrays that change pore volumes or transmissibilities and are not applied yet (MULTX, TRANX, PORV …).
bool is_unapplied_array(std::string_view name);

}  // namespace wellknit
