// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The keywords of a deck that the reader knows, and in which sections it looks for them.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "model/connection_edits.h"

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
  skip_block,   ///< up to ENDSKIP
  flag,         ///< known, without data and without meaning for the grid
  skip,         ///< the same, with data of any form: up to the next keyword
  skip_record,  ///< the same, one record
  skip_list,    ///< the same, records up to an empty one
  not_applied,  ///< would change the grid, its connections or its rock: noted, skipped as above
  not_applied_flag,
  not_applied_record,
  not_applied_list,
  not_applied_array,  ///< one record of numbers
  changed_in_time,    ///< a multiplier of the SCHEDULE section: noted
  refuse,             ///< changes what the grid is
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
  operation,       ///< EQUALS, COPY, OPERATE, EQUALREG …
  computed_array,  ///< TRANX, PORV …: an edit of what is computed later
  connections,     ///< FAULTS, MULTREGT, NNC, PINCH …
  mapaxes,
  map_units,
  grid_unit,
  grid_orientation,
  grid_options,
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
  std::string_view advice = {};  ///< refuse: what to do
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

/// True for WORK1, WORK2 …: scratch arrays of a section.
bool is_work_array(std::string_view name);

/// The array that a simulator computes and EDIT changes (TRANX, PORV …), or nothing.
std::optional<ComputedArray> find_computed_array(std::string_view name);

/// True for MULTX, MULTX- … MULTZ-, MULTPV: EDIT multiplies what GRID gave.
bool is_multiplier_array(std::string_view name);

/// True for the arrays that the grid carries in its edits: the multipliers and MINPVV.
inline bool ends_in_edits(std::string_view name) { return is_multiplier_array(name) || name == "MINPVV"; }

/// True for arrays that are neither carried nor applied (tensor permeabilities, DIFFX …).
bool is_unapplied_array(std::string_view name);

}  // namespace wellknit
