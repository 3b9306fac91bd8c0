// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/deck_keywords.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <unordered_map>
#include <utility>

#include "readers/text.h"

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
constexpr std::uint16_t in_runspec_or_grid = bits({DeckSection::bare, DeckSection::runspec, DeckSection::grid});
constexpr std::uint16_t in_grid_or_edit = bits({DeckSection::bare, DeckSection::grid, DeckSection::edit});
constexpr std::uint16_t with_arrays = bits({DeckSection::bare, DeckSection::grid, DeckSection::edit, DeckSection::props,
                                            DeckSection::regions, DeckSection::solution});
// A bare file may hold them too: sectors are exported with their completions.
constexpr std::uint16_t in_schedule = bits({DeckSection::bare, DeckSection::schedule});

using A = DeckAction;

struct Refusal {
  std::string_view what;
  std::string_view advice;
};

constexpr std::string_view local_refinement = "a local grid refinement";
constexpr Refusal refinement{
    local_refinement,
    "take the refinements out (their keywords up to ENDFIN), or export the global grid without "
    "them; wellknit refines around wells itself"};
constexpr Refusal dual_medium{
    "a dual medium (matrix and fractures)",
    "write the matrix or the fractures as a grid of its own, with half the layers and without "
    "DUALPORO, DUALPERM and NODPPM"};
constexpr Refusal radial_grid{"a radial grid",
                              "write the grid in Cartesian corner points; wellknit makes the radial cells itself"};
constexpr Refusal binary_import{"a grid from a binary file",
                                "write the grid as text (GRDECL) and INCLUDE it in place of this keyword"};
constexpr Refusal other_units{"the unit system PVT-M", "convert the deck to METRIC, FIELD or LAB"};
constexpr Refusal changed_depths{"corner depths changed after ZCORN",
                                 "let the simulator or the pre-processor write the grid as it is after this keyword"};
constexpr Refusal unstructured{"an unstructured grid", "export a corner-point grid (COORD and ZCORN)"};

constexpr DeckKeywordRule refused(std::string_view name, std::uint16_t sections, Refusal why) {
  return {name, DeckAction::refuse, sections, why.what, why.advice};
}

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
    refused("PVT-M", in_runspec, other_units),
    {"DIMENS", A::dimensions, in_runspec},
    refused("DUALPORO", in_runspec, dual_medium),
    refused("DUALPERM", in_runspec, dual_medium),
    refused("NODPPM", in_runspec_or_grid, dual_medium),
    refused("DPGRID", in_grid, dual_medium),
    refused("DPNUM", in_grid, dual_medium),
    refused("SIGMA", in_grid, dual_medium),
    refused("SIGMAV", in_grid, dual_medium),
    refused("DZMTRX", in_grid, dual_medium),
    refused("DZMTRXV", in_grid, dual_medium),
    refused("RADIAL", in_runspec, radial_grid),
    refused("SPIDER", in_runspec, radial_grid),

    {"SPECGRID", A::specgrid, in_grid},
    {"COORD", A::coord, in_grid},
    {"ZCORN", A::zcorn, in_grid},
    {"DXV", A::spacing, in_grid},
    {"DYV", A::spacing, in_grid},
    {"DZV", A::spacing, in_grid},
    {"MAPAXES", A::mapaxes, in_grid},
    {"GRIDUNIT", A::grid_unit, in_grid},
    {"GDORIENT", A::grid_orientation, in_grid},
    {"MAPUNITS", A::map_units, in_grid},
    {"GRIDOPTS", A::grid_options, in_runspec_or_grid},
    refused("INRAD", in_grid, radial_grid),
    refused("OUTRAD", in_grid, radial_grid),
    refused("DR", in_grid, radial_grid),
    refused("DRV", in_grid, radial_grid),
    refused("DTHETA", in_grid, radial_grid),
    refused("DTHETAV", in_grid, radial_grid),
    refused("CARFIN", in_grid_or_edit, refinement),
    refused("RADFIN", in_grid_or_edit, refinement),
    refused("RADFIN4", in_grid_or_edit, refinement),
    refused("REFINE", in_grid_or_edit, refinement),
    refused("AUTOREF", in_runspec_or_grid, refinement),
    refused("IMPORT", in_grid, binary_import),
    refused("GDFILE", in_grid, binary_import),

    {"BOX", A::box, with_arrays},
    {"ENDBOX", A::end_box, with_arrays},
    {"EQUALS", A::operation, with_arrays},
    {"COPY", A::operation, with_arrays},
    {"ADD", A::operation, with_arrays},
    {"MULTIPLY", A::operation, with_arrays},
    {"MINVALUE", A::operation, with_arrays},
    {"MAXVALUE", A::operation, with_arrays},
    {"OPERATE", A::operation, with_arrays},
    {"OPERATER", A::operation, with_arrays},
    {"EQUALREG", A::operation, with_arrays},
    {"ADDREG", A::operation, with_arrays},
    {"MULTIREG", A::operation, with_arrays},
    {"COPYREG", A::operation, with_arrays},
    {"COPYBOX", A::not_applied_list, with_arrays},

    {"FAULTS", A::connections, in_grid},
    {"MULTFLT", A::connections, in_grid_or_edit},
    {"MULTREGT", A::connections, in_grid_or_edit},
    {"MULTREGP", A::connections, in_grid_or_edit},
    {"NNC", A::connections, in_grid_or_edit},
    {"EDITNNC", A::connections, in_grid_or_edit},
    {"EDITNNCR", A::connections, in_grid_or_edit},
    {"PINCH", A::connections, in_grid},
    {"PINCHOUT", A::connections, in_grid},
    {"MINPV", A::connections, in_grid_or_edit},
    {"MINPORV", A::connections, in_grid_or_edit},
    {"NEWTRAN", A::connections, in_grid},
    {"OLDTRAN", A::connections, in_grid},
    {"OLDTRANR", A::connections, in_grid},
    {"PINCHREG", A::not_applied_list, in_grid},
    {"PINCHXY", A::not_applied_record, in_grid},
    {"PERMAVE", A::not_applied_record, in_grid},
    {"MINNNCT", A::not_applied_record, in_grid},
    {"HALFTRAN", A::not_applied_flag, in_grid},
    {"USEFLUX", A::not_applied_flag, in_runspec_or_grid},
    {"TRANGL", A::not_applied_list, in_grid_or_edit},
    {"MPFNNC", A::not_applied_list, in_grid},
    {"AQUNUM", A::not_applied_list, in_grid},
    {"AQUCON", A::not_applied_list, in_grid},
    {"AQUNNC", A::not_applied_list, in_grid},
    {"COARSEN", A::not_applied, in_grid},
    {"COLLAPSE", A::not_applied_list, in_grid},
    {"AUTOCOAR", A::not_applied_list, in_grid},
    {"RESVNUM", A::not_applied_record, in_grid},
    refused("AMALGAM", in_grid, refinement),
    refused("ADDZCORN", in_grid, changed_depths),
    refused("EQLZCORN", in_grid, changed_depths),
    refused("PETGRID", in_grid, binary_import),
    refused("GETDATA", in_runspec_or_grid, binary_import),
    refused("PEBI", in_grid, unstructured),

    {"INIT", A::flag, in_grid_or_edit},
    {"ECHO", A::flag, any},
    {"NOECHO", A::flag, any},
    {"WARN", A::flag, any},
    {"NOWARN", A::flag, any},
    {"FORMFEED", A::skip_record, any},
    {"GRIDFILE", A::skip_record, in_grid},
    {"COORDSYS", A::skip, in_grid},
    {"FAULTDIM", A::skip_record, in_runspec_or_grid},
    {"NONNC", A::flag, in_runspec_or_grid},
    {"NOGGF", A::flag, in_grid},
    {"DUMPFLUX", A::flag, in_grid},
    {"USENOFLO", A::flag, in_grid},
    {"RPTISOL", A::flag, in_grid},
    {"JFUNC", A::skip_record, in_grid},
    {"JFUNCR", A::skip, in_grid},
    {"QMOBIL", A::skip_record, in_grid_or_edit},
    {"CRITPERM", A::skip_record, in_grid},
    {"FLUXTYPE", A::skip_record, in_grid},
    {"SOLVDIRS", A::skip_record, in_grid},
    {"NMATOPTS", A::skip_record, in_grid},
    {"PARAOPTS", A::skip_record, in_grid},
    {"THPRESFT", A::skip_list, in_grid},
    {"MULTREGD", A::skip_list, in_grid_or_edit},
    {"MULTREGH", A::skip_list, in_grid_or_edit},
    {"AQUCT", A::skip_list, in_grid},
    {"AQUANCON", A::skip_list, in_grid},
    {"FILEUNIT", A::skip_record, any},
    {"MESSAGES", A::skip_record, any},
    {"DEBUG", A::skip_record, any},
    {"COLUMNS", A::skip_record, any},
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
    // Multipliers and thresholds: they end in the connection edits
    real("MULTX", 1.0),
    real("MULTX-", 1.0),
    real("MULTY", 1.0),
    real("MULTY-", 1.0),
    real("MULTZ", 1.0),
    real("MULTZ-", 1.0),
    real("MULTPV", 1.0),
    real("MINPVV"),
    // Rock of the heat, diffusion and mechanics options
    real("THCONR"),
    real("THCONSF"),
    real("THCROCK"),
    real("THCOIL"),
    real("THCGAS"),
    real("THCWATER"),
    real("HEATCR"),
    real("HEATCRT"),
    real("DIFFMX", 1.0),
    real("DIFFMX-", 1.0),
    real("DIFFMY", 1.0),
    real("DIFFMY-", 1.0),
    real("DIFFMZ", 1.0),
    real("DIFFMZ-", 1.0),
    real("DISPERC"),
    real("DZNET"),
    real("YMODULE"),
    real("SMODULUS"),
    real("LAME"),
    real("CSTRESS"),
    real("PRATIO"),
    real("BIOTCOEF"),
    real("POELCOEF"),
    real("THERMEXR"),
    real("THELCOEF"),
    real("ROCKFRAC"),
    real("PLYRMDEN"),
    real("SOLVCONC"),
    integer("COALNUM"),
    integer("ISOLNUM"),
    integer("FLUXREG", 0),
    integer("SOLVNUM"),
    integer("NINENUM"),
    // Regions
    integer("SATNUM"),
    integer("IMBNUM"),
    integer("IMBNUMX"),
    integer("IMBNUMY"),
    integer("IMBNUMZ"),
    integer("KRNUMX"),
    integer("KRNUMX-"),
    integer("KRNUMY"),
    integer("KRNUMY-"),
    integer("KRNUMZ"),
    integer("KRNUMZ-"),
    integer("PVTNUM"),
    integer("EQLNUM"),
    integer("EOSNUM"),
    integer("FIPNUM"),
    integer("ROCKNUM"),
    integer("ENDNUM"),
    integer("MISCNUM"),
    integer("MULTNUM"),
    integer("PINCHNUM"),
    integer("FLUXNUM", 0),
    integer("OPERNUM", 0),
    integer("WITNUM"),
    integer("SURFNUM"),
    integer("SURFWNUM"),
    integer("LSNUM"),
    integer("LWSNUM"),
    integer("LSLTWNUM"),
    integer("LWSLTNUM"),
    integer("HBNUM"),
    integer("PENUM"),
    integer("PLMIXNUM"),
    integer("RESIDNUM"),
    integer("STRESSEQUILNUM"),
    integer("WH2NUM"),
    integer("WH3NUM"),
    // Saturation end points without directions; directional_arrays has the others
    real("SWLPC"),
    real("SGLPC"),
    real("ISWLPC"),
    real("ISGLPC"),
    real("PCW"),
    real("PCG"),
    real("IPCW"),
    real("IPCG"),
    real("SWATINIT"),
    real("LANGMPL", 1.0),
    // Initial state
    real("PRESSURE"),
    real("SWAT"),
    real("SGAS"),
    real("SOIL"),
    real("RS"),
    real("RV"),
    real("RSW"),
    real("RVW"),
    real("PBUB"),
    real("PDEW"),
    real("TEMPI"),
    real("SALT"),
    real("SALTP"),
    real("SPOLY"),
    real("SPOLYMW"),
    real("SSOL"),
    real("SFOAM"),
    real("SURF"),
    real("SMICR"),
    real("SOXYG"),
    real("SUREA"),
    real("SBIOF"),
    real("SCALC"),
    real("GASCONC"),
    real("GASSATC"),
    real("SOLVFRAC"),
    real("GI"),
    real("OILAPI"),
});

/// Saturation end points: each may carry X, X-, Y, Y-, Z or Z- at its end, and I (imbibition) before it.
constexpr auto directional_arrays = std::to_array<CellArrayRule>({
    real("SWL"),
    real("SWCR"),
    real("SWU", 1.0),
    real("SGL"),
    real("SGCR"),
    real("SGU", 1.0),
    real("SOWCR"),
    real("SOGCR"),
    real("KRW", 1.0),
    real("KRWR", 1.0),
    real("KRG", 1.0),
    real("KRGR", 1.0),
    real("KRO", 1.0),
    real("KRORW", 1.0),
    real("KRORG", 1.0),
});

constexpr auto unapplied_arrays =
    std::to_array<std::string_view>({"DIFFX",   "DIFFY",    "DIFFZ",   "ROCKV",    "PERMXX",  "PERMYY",   "PERMZZ",
                                     "PERMXY",  "PERMYZ",   "PERMZX",  "PERMXZ",   "PERMYX",  "PERMZY",   "MPFANUM",
                                     "HMMULTX", "HMMULTX-", "HMMULTY", "HMMULTY-", "HMMULTZ", "HMMULTZ-", "HMMULTPV"});

constexpr auto computed_arrays =
    std::to_array<std::pair<std::string_view, ComputedArray>>({{"TRANX", ComputedArray::transmissibility_x},
                                                               {"TRANY", ComputedArray::transmissibility_y},
                                                               {"TRANZ", ComputedArray::transmissibility_z},
                                                               {"PORV", ComputedArray::pore_volume},
                                                               {"DEPTH", ComputedArray::depth}});

/// Names that keywords of the SCHEDULE section share with the grid's: they change it from some time on.
constexpr auto changed_in_time = std::to_array<std::string_view>(
    {"MULTX", "MULTX-", "MULTY", "MULTY-", "MULTZ", "MULTZ-", "MULTPV", "MULTFLT", "MULTREGT"});

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

/// SWLX-, IKRWR, …
const CellArrayRule* find_end_point(std::string_view name) {
  static const auto rules = by_name(directional_arrays);
  const auto stem = [](std::string_view text) {
    if (text.size() > 2 && text.back() == '-' && std::string_view("XYZ").find(text[text.size() - 2]) != text.npos)
      return text.substr(0, text.size() - 2);
    if (text.size() > 1 && std::string_view("XYZ").find(text.back()) != text.npos)
      return text.substr(0, text.size() - 1);
    return text;
  };
  if (!name.empty() && name.front() == 'I') name.remove_prefix(1);
  const auto found = rules.find(stem(name));
  return found == rules.end() ? nullptr : found->second;
}

}  // namespace

const DeckKeywordRule* find_deck_keyword(std::string_view name, DeckSection section) {
  static constexpr DeckKeywordRule cell_array{"", DeckAction::cell_array, with_arrays};
  static constexpr DeckKeywordRule unapplied{"", DeckAction::not_applied_array, with_arrays};
  static constexpr DeckKeywordRule computed{"", DeckAction::computed_array, in_grid_or_edit};
  static constexpr DeckKeywordRule in_time{"", DeckAction::changed_in_time, bits({DeckSection::schedule})};
  const auto in_section = [section](const DeckKeywordRule& rule) {
    return (rule.sections & static_cast<unsigned>(section)) != 0 ? &rule : nullptr;
  };
  if (section == DeckSection::schedule && std::ranges::find(changed_in_time, name) != changed_in_time.end())
    return &in_time;
  if (const auto found = rules_by_name().find(name); found != rules_by_name().end()) return in_section(*found->second);
  if (find_cell_array(name) != nullptr) return in_section(cell_array);
  if (find_computed_array(name)) return in_section(computed);
  if (is_unapplied_array(name)) return in_section(unapplied);
  return nullptr;
}

bool is_known_keyword(std::string_view name) {
  return rules_by_name().contains(name) || find_cell_array(name) != nullptr || find_computed_array(name) ||
         is_unapplied_array(name);
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
  static constexpr CellArrayRule work{"WORK", CellArrayKind::real, 0.0};
  if (const auto found = rules.find(name); found != rules.end()) return found->second;
  if (const CellArrayRule* end_point = find_end_point(name)) return end_point;
  if (is_work_array(name)) return &work;
  // FIPZON, FIPGL …: a user's own set of fluid-in-place regions.
  return name.size() > 3 && name.size() <= 8 && name.substr(0, 3) == "FIP" && name != "FIPOWG" ? &region : nullptr;
}

bool is_work_array(std::string_view name) {
  static constexpr std::string_view stem = "WORK";
  return name.size() > stem.size() && name.size() <= 8 && name.substr(0, stem.size()) == stem &&
         std::all_of(name.begin() + stem.size(), name.end(), is_digit);
}

std::optional<ComputedArray> find_computed_array(std::string_view name) {
  for (const auto& [keyword, array] : computed_arrays)
    if (keyword == name) return array;
  return std::nullopt;
}

bool is_multiplier_array(std::string_view name) {
  return name.substr(0, 4) == "MULT" && name != "MULTNUM" && find_cell_array(name) != nullptr;
}

bool is_unapplied_array(std::string_view name) {
  return std::find(unapplied_arrays.begin(), unapplied_arrays.end(), name) != unapplied_arrays.end();
}

}  // namespace wellknit
