// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/deck_keywords.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <unordered_map>

namespace wellknit {

namespace {

constexpr std::uint16_t bits(std::initializer_list<DeckSection> sections) {
  unsigned out = 0;
  for (const DeckSection section : sections) out |= static_cast<unsigned>(section);
  return static_cast<std::uint16_t>(out);
}

constexpr std::uint16_t any = 0xFFFF;
// SUMMARY lists are vectors and well names; nothing of them is followed, not even their files.
constexpr std::uint16_t but_summary = any & ~static_cast<unsigned>(DeckSection::summary);
constexpr std::uint16_t in_runspec = bits({DeckSection::bare, DeckSection::runspec});
constexpr std::uint16_t in_grid = bits({DeckSection::bare, DeckSection::grid});
constexpr std::uint16_t in_grid_or_edit = bits({DeckSection::bare, DeckSection::grid, DeckSection::edit});
constexpr std::uint16_t with_arrays = bits({DeckSection::bare, DeckSection::grid, DeckSection::edit, DeckSection::props,
                                            DeckSection::regions, DeckSection::solution});
// A bare file may hold them too: sectors are exported with their completions.
constexpr std::uint16_t in_schedule = bits({DeckSection::bare, DeckSection::schedule});

using A = DeckAction;

constexpr std::string_view local_refinement = "a local grid refinement";
constexpr std::string_view dual_medium = "a dual medium (matrix and fractures)";
constexpr std::string_view radial_grid = "a radial grid";
constexpr std::string_view binary_import = "a grid from a binary file";

constexpr auto keyword_rules = std::to_array<DeckKeywordRule>({
    {"RUNSPEC", A::begin_section, any},
    {"GRID", A::begin_section, any},
    {"EDIT", A::begin_section, any},
    {"PROPS", A::begin_section, any},
    {"REGIONS", A::begin_section, any},
    {"SOLUTION", A::begin_section, any},
    {"SUMMARY", A::begin_section, any},
    {"SCHEDULE", A::begin_section, any},
    {"INCLUDE", A::include, but_summary},
    {"END", A::end, any},
    {"ENDINC", A::end_include, any},
    {"SKIP", A::skip_block, any},
    {"SKIP100", A::skip_block, any},
    {"ENDSKIP", A::flag, any},
    // The deck is read as ECLIPSE 100 reads it.
    {"SKIP300", A::flag, any},

    {"TITLE", A::title, in_runspec},
    {"PATHS", A::paths, in_runspec},
    {"METRIC", A::units, in_runspec},
    {"FIELD", A::units, in_runspec},
    {"LAB", A::units, in_runspec},
    {"PVT-M", A::refuse, in_runspec, "the unit system PVT-M"},
    {"DIMENS", A::dimensions, in_runspec},
    {"DUALPORO", A::refuse, in_runspec, dual_medium},
    {"DUALPERM", A::refuse, in_runspec, dual_medium},
    {"RADIAL", A::refuse, in_runspec, radial_grid},
    {"SPIDER", A::refuse, in_runspec, radial_grid},

    {"SPECGRID", A::specgrid, in_grid},
    {"COORD", A::coord, in_grid},
    {"ZCORN", A::zcorn, in_grid},
    {"DXV", A::spacing, in_grid},
    {"DYV", A::spacing, in_grid},
    {"DZV", A::spacing, in_grid},
    {"MAPAXES", A::mapaxes, in_grid},
    {"GRIDUNIT", A::grid_unit, in_grid},
    {"PINCH", A::pinch, in_grid},
    {"INRAD", A::refuse, in_grid, radial_grid},
    {"OUTRAD", A::refuse, in_grid, radial_grid},
    {"DR", A::refuse, in_grid, radial_grid},
    {"DRV", A::refuse, in_grid, radial_grid},
    {"DTHETA", A::refuse, in_grid, radial_grid},
    {"DTHETAV", A::refuse, in_grid, radial_grid},
    {"CARFIN", A::refuse, in_grid_or_edit, local_refinement},
    {"RADFIN", A::refuse, in_grid_or_edit, local_refinement},
    {"RADFIN4", A::refuse, in_grid_or_edit, local_refinement},
    {"REFINE", A::refuse, in_grid_or_edit, local_refinement},
    {"AUTOREF", A::refuse, bits({DeckSection::bare, DeckSection::runspec, DeckSection::grid}), local_refinement},
    {"IMPORT", A::refuse, in_grid, binary_import},
    {"GDFILE", A::refuse, in_grid, binary_import},

    {"BOX", A::box, with_arrays},
    {"ENDBOX", A::end_box, with_arrays},
    {"EQUALS", A::operation, with_arrays},
    {"COPY", A::operation, with_arrays},
    {"ADD", A::operation, with_arrays},
    {"MULTIPLY", A::operation, with_arrays},
    {"MINVALUE", A::operation, with_arrays},
    {"MAXVALUE", A::operation, with_arrays},
    {"OPERATE", A::not_applied_list, with_arrays},
    {"OPERATER", A::not_applied_list, with_arrays},
    {"EQUALREG", A::not_applied_list, with_arrays},
    {"ADDREG", A::not_applied_list, with_arrays},
    {"MULTIREG", A::not_applied_list, with_arrays},
    {"COPYREG", A::not_applied_list, with_arrays},
    {"COARSEN", A::not_applied_list, in_grid},

    {"FAULTS", A::not_applied_list, in_grid},
    {"MULTFLT", A::not_applied_list, in_grid_or_edit},
    {"MULTREGT", A::not_applied_list, in_grid_or_edit},
    {"MULTREGP", A::not_applied_list, in_grid_or_edit},
    {"NNC", A::not_applied_list, in_grid_or_edit},
    {"EDITNNC", A::not_applied_list, in_grid_or_edit},
    {"EDITNNCR", A::not_applied_list, in_grid_or_edit},
    {"MINPV", A::not_applied, in_grid_or_edit},
    {"MINPVV", A::not_applied, in_grid_or_edit},
    {"MINPORV", A::not_applied, in_grid_or_edit},
    {"PINCHREG", A::not_applied, in_grid},
    {"AQUNUM", A::not_applied_list, in_grid},
    {"AQUCON", A::not_applied_list, in_grid},

    {"INIT", A::flag, in_grid_or_edit},
    {"ECHO", A::flag, any},
    {"NOECHO", A::flag, any},
    {"NEWTRAN", A::flag, in_grid},
    {"OLDTRAN", A::flag, in_grid},
    {"OLDTRANR", A::flag, in_grid},
    {"GRIDFILE", A::skip, in_grid},
    {"GDORIENT", A::skip, in_grid},
    {"MAPUNITS", A::skip, in_grid},
    {"GRIDOPTS", A::skip, in_grid},
    {"COORDSYS", A::skip, in_grid},
    {"FAULTDIM", A::skip, in_grid},
    {"NONNC", A::flag, in_grid},
    {"NOGGF", A::flag, in_grid},
    {"PINCHOUT", A::flag, in_grid},
    {"JFUNC", A::skip, in_grid},
    {"FILEUNIT", A::skip, any},
    {"MESSAGES", A::skip, any},
    {"DEBUG", A::skip_record, any},
    {"COLUMNS", A::skip, any},
    {"FIPOWG", A::flag, bits({DeckSection::regions})},
    {"RPTGRID", A::skip_record, any},
    {"RPTGRIDL", A::skip_record, any},
    {"RPTINIT", A::skip_record, any},
    {"RPTPROPS", A::skip_record, any},
    {"RPTREGS", A::skip_record, any},
    {"RPTSOL", A::skip_record, any},
    {"RPTSCHED", A::skip_record, any},
    {"RPTRST", A::skip_record, any},

    {"WELSPECS", A::welspecs, in_schedule},
    {"COMPDAT", A::compdat, in_schedule},
    {"WCONINJE", A::injectors, in_schedule},
    {"WCONINJH", A::injectors, in_schedule},
    {"WCONINJP", A::injectors, in_schedule},
    {"WELSPECL", A::refuse, in_schedule, local_refinement},
    {"COMPDATL", A::refuse, in_schedule, local_refinement},
    {"WELTRAJ", A::well_path, in_schedule},
    {"COMPTRAJ", A::well_path, in_schedule},
    {"WELSEGS", A::well_path, in_schedule},
    {"COMPSEGS", A::well_path, in_schedule},
    {"WLIST", A::well_path, in_schedule},
});

constexpr CellArrayRule needed(std::string_view name) { return {name, CellArrayKind::real, 0.0, false, false}; }
constexpr CellArrayRule real(std::string_view name, double value = 0.0) { return {name, CellArrayKind::real, value}; }
constexpr CellArrayRule integer(std::string_view name, double value = 1.0) {
  return {name, CellArrayKind::integer, value};
}

constexpr CellArrayRule tops = {"TOPS", CellArrayKind::real, 0.0, false, true};

constexpr auto cell_array_rules = std::to_array<CellArrayRule>({
    needed("PORO"),
    needed("PERMX"),
    needed("PERMY"),
    needed("PERMZ"),
    real("NTG", 1.0),
    integer("ACTNUM"),
    needed("DX"),
    needed("DY"),
    needed("DZ"),
    tops,
    // Regions
    integer("SATNUM"),
    integer("IMBNUM"),
    integer("PVTNUM"),
    integer("EQLNUM"),
    integer("FIPNUM"),
    integer("ROCKNUM"),
    integer("ENDNUM"),
    integer("MISCNUM"),
    integer("MULTNUM"),
    integer("PINCHNUM"),
    integer("FLUXNUM", 0),
    integer("OPERNUM", 0),
    integer("THCONSF", 0),
    integer("WITNUM"),
    integer("SURFNUM"),
    integer("LSNUM"),
    // Saturation end points
    real("SWL"),
    real("SWCR"),
    real("SWU", 1.0),
    real("SGL"),
    real("SGCR"),
    real("SGU", 1.0),
    real("SOWCR"),
    real("SOGCR"),
    real("SWLPC"),
    real("SGLPC"),
    real("ISWL"),
    real("ISWCR"),
    real("ISWU", 1.0),
    real("ISGL"),
    real("ISGCR"),
    real("ISGU", 1.0),
    real("ISOWCR"),
    real("ISOGCR"),
    real("KRW", 1.0),
    real("KRWR", 1.0),
    real("KRG", 1.0),
    real("KRGR", 1.0),
    real("KRO", 1.0),
    real("KRORW", 1.0),
    real("KRORG", 1.0),
    real("PCW"),
    real("PCG"),
    real("SWATINIT"),
    // Initial state
    real("PRESSURE"),
    real("SWAT"),
    real("SGAS"),
    real("SOIL"),
    real("RS"),
    real("RV"),
    real("PBUB"),
    real("PDEW"),
    real("TEMPI"),
    real("SALT"),
    real("SPOLY"),
    real("SSOL"),
});

constexpr auto unapplied_arrays = std::to_array<std::string_view>(
    {"MULTX",  "MULTX-", "MULTY",  "MULTY-", "MULTZ",  "MULTZ-", "MULTPV", "PORV",   "TRANX",
     "TRANY",  "TRANZ",  "DEPTH",  "DIFFX",  "DIFFY",  "DIFFZ",  "PERMXX", "PERMYY", "PERMZZ",
     "PERMXY", "PERMYZ", "PERMZX", "PERMXZ", "PERMYX", "PERMZY", "MPFANUM"});

template <class Rules>
auto by_name(const Rules& rules) {
  std::unordered_map<std::string_view, const typename Rules::value_type*> out;
  for (const auto& rule : rules) out.emplace(rule.name, &rule);
  return out;
}

const auto& rules_by_name() {
  static const auto rules = by_name(keyword_rules);
  return rules;
}

}  // namespace

const DeckKeywordRule* find_deck_keyword(std::string_view name, DeckSection section) {
  static constexpr DeckKeywordRule cell_array{"", DeckAction::cell_array, with_arrays};
  static constexpr DeckKeywordRule unapplied{"", DeckAction::not_applied, with_arrays};
  const auto in_section = [section](const DeckKeywordRule& rule) {
    return (rule.sections & static_cast<unsigned>(section)) != 0 ? &rule : nullptr;
  };
  if (const auto found = rules_by_name().find(name); found != rules_by_name().end()) return in_section(*found->second);
  if (find_cell_array(name) != nullptr) return in_section(cell_array);
  if (is_unapplied_array(name)) return in_section(unapplied);
  return nullptr;
}

bool is_known_keyword(std::string_view name) {
  return rules_by_name().contains(name) || find_cell_array(name) != nullptr || is_unapplied_array(name);
}

DeckSection section_of(std::string_view name) {
  if (name == "RUNSPEC") return DeckSection::runspec;
  if (name == "GRID") return DeckSection::grid;
  if (name == "EDIT") return DeckSection::edit;
  if (name == "PROPS") return DeckSection::props;
  if (name == "REGIONS") return DeckSection::regions;
  if (name == "SOLUTION") return DeckSection::solution;
  if (name == "SUMMARY") return DeckSection::summary;
  return DeckSection::schedule;
}

const CellArrayRule* find_cell_array(std::string_view name) {
  static const auto rules = by_name(cell_array_rules);
  static constexpr CellArrayRule region{"FIP", CellArrayKind::integer, 1.0};
  if (const auto found = rules.find(name); found != rules.end()) return found->second;
  // FIPZON, FIPGL …: a user's own set of fluid-in-place regions.
  return name.size() > 3 && name.size() <= 8 && name.substr(0, 3) == "FIP" && name != "FIPOWG" ? &region : nullptr;
}

bool is_unapplied_array(std::string_view name) {
  return std::find(unapplied_arrays.begin(), unapplied_arrays.end(), name) != unapplied_arrays.end();
}

}  // namespace wellknit
