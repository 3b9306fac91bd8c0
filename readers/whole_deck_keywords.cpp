// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/whole_deck_keywords.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <span>
#include <unordered_map>

#include "readers/text.h"

namespace wellknit {

namespace {

constexpr std::uint16_t bits(std::initializer_list<DeckSection> sections) {
  unsigned out = 0;
  for (const DeckSection section : sections) out |= static_cast<unsigned>(section);
  return static_cast<std::uint16_t>(out);
}

using S = DeckSection;
using F = DeckForm;
using R = DeckRole;

constexpr std::uint16_t runspec = bits({S::runspec});
constexpr std::uint16_t grid = bits({S::grid, S::edit});
constexpr std::uint16_t runspec_or_grid = bits({S::runspec, S::grid, S::edit});
constexpr std::uint16_t solution = bits({S::solution});
constexpr std::uint16_t schedule = bits({S::schedule});
constexpr std::uint16_t with_arrays = bits({S::props, S::regions, S::solution});
constexpr std::uint16_t tables = bits({S::props, S::regions, S::solution, S::schedule});
constexpr std::uint16_t grid_or_solution = bits({S::grid, S::edit, S::solution});

struct Refusal {
  std::string_view reason;
  std::string_view advice;
};

constexpr Refusal dual{"a dual medium (matrix and fractures)",
                       "convert a deck of one medium, without DUALPORO and DUALPERM"};
constexpr Refusal local{"a local grid refinement", "take it out; wellknit refines around wells itself"};
constexpr Refusal heat{"the heat equation: a connection list carries no heat conduction", "convert an isothermal deck"};
constexpr Refusal diffusion{"diffusion or dispersion: a connection list carries none", "take the keyword out"};
constexpr Refusal restart{"a run that continues another one: its cells are those of the other run's grid",
                          "convert the deck from its first day on"};
constexpr Refusal in_time{
    "transmissibilities or pore volumes that change with time: they do not act on a list of "
    "connections",
    "take the keyword out of SCHEDULE, or convert the deck up to it"};
constexpr Refusal radial{"a radial grid", "write the grid in Cartesian corner points"};
constexpr Refusal compositional{"a compositional model", "convert a black-oil deck"};
constexpr Refusal mechanics{"rock mechanics", "take the keyword out"};
constexpr Refusal stencil{"connections beyond the faces of cells (nine-point, multi-point)",
                          "take the keyword out for the two-point scheme"};
constexpr Refusal coarsened{"a coarsened grid", "take the keyword out"};
constexpr Refusal numerical_aquifer{"a numerical aquifer, whose cells are cells of the old grid",
                                    "use an analytical aquifer: AQUCT or AQUFETP with AQUANCON"};
constexpr Refusal boundary{"boundary conditions on faces of the old grid", "take the keyword out"};
constexpr Refusal fault_threshold{"threshold pressures by fault: faults have no names in a list of connections",
                                  "give them by region with THPRES"};
constexpr Refusal direction{"saturation functions by direction: a list of connections has none",
                            "use saturation functions without a direction"};
constexpr Refusal by_grid{"an input by cells of the old grid that is not converted", "take the keyword out"};
constexpr Refusal script{"a script", "take the keyword out"};
constexpr Refusal flux{"a flux boundary by cells of the old grid", "convert the full-field deck"};

constexpr WholeDeckRule refused(std::string_view name, std::uint16_t sections, Refusal why) {
  return {name, sections, F::open, R::refused, why.reason, why.advice};
}

constexpr auto rules = std::to_array<WholeDeckRule>({
    {"DIMENS", runspec, F::record, R::dimensions},
    {"WELLDIMS", runspec, F::record, R::well_dimensions},
    {"OIL", runspec, F::flag, R::phase},
    {"WATER", runspec, F::flag, R::phase},
    {"GAS", runspec, F::flag, R::phase},
    {"SATOPTS", runspec, F::record, R::saturation_options, direction.reason, direction.advice},
    {"ENDSCALE", runspec, F::record, R::saturation_options, direction.reason, direction.advice},
    {"NONNC", runspec_or_grid, F::flag, R::dropped, "every connection of the new grid is a non-neighbour one"},
    refused("DUALPORO", runspec, dual),
    refused("DUALPERM", runspec, dual),
    refused("NODPPM", runspec_or_grid, dual),
    refused("LGR", runspec, local),
    refused("AUTOREF", runspec_or_grid, local),
    refused("THERMAL", runspec, heat),
    refused("TEMP", runspec, heat),
    refused("DIFFUSE", runspec, diffusion),
    refused("DISPERSE", runspec, diffusion),
    refused("RADIAL", runspec, radial),
    refused("SPIDER", runspec, radial),
    refused("COMPS", runspec, compositional),
    refused("MECH", runspec, mechanics),
    refused("GEOMECH", runspec, mechanics),
    refused("NINEPOIN", runspec_or_grid, stencil),
    refused("MPFA", runspec_or_grid, stencil),
    refused("USEFLUX", runspec_or_grid, flux),
    refused("DUMPFLUX", runspec_or_grid, flux),

    refused("CARFIN", grid, local),
    refused("RADFIN", grid, local),
    refused("RADFIN4", grid, local),
    refused("REFINE", grid, local),
    refused("AMALGAM", grid, local),
    refused("COARSEN", grid, coarsened),
    refused("COLLAPSE", grid, coarsened),
    refused("AUTOCOAR", grid, coarsened),
    refused("AQUNUM", grid, numerical_aquifer),
    refused("AQUCON", grid, numerical_aquifer),
    refused("AQUNNC", grid, numerical_aquifer),
    refused("AQUNUM", solution, numerical_aquifer),
    refused("AQUCON", solution, numerical_aquifer),
    refused("BC", grid_or_solution, boundary),
    refused("BCCON", grid_or_solution, boundary),
    refused("BCPROP", schedule, boundary),
    refused("THPRESFT", grid_or_solution, fault_threshold),
    refused("TRANGL", grid, stencil),
    refused("MPFNNC", grid, stencil),
    refused("JFUNCR", grid, by_grid),
    {"JFUNC", grid, F::record, R::grid_carried},
    {"AQUCT", grid, F::list, R::grid_carried},
    {"AQUFETP", grid, F::list, R::grid_carried},
    {"AQUFET", grid, F::list, R::grid_carried},
    {"AQUANCON", grid_or_solution, F::list, R::aquifer_cells},
    refused("AQANCONL", grid_or_solution, local),

    refused("RESTART", solution, restart),
    refused("SKIPREST", schedule, restart),
    refused("GETDATA", solution, restart),
    refused("GETGLOB", solution, restart),
    refused("FLUXTYPE", solution, flux),

    {"BOX", with_arrays, F::record, R::box},
    {"ENDBOX", with_arrays, F::flag, R::box},
    {"EQUALS", with_arrays, F::list, R::operation},
    {"COPY", with_arrays, F::list, R::operation},
    {"ADD", with_arrays, F::list, R::operation},
    {"MULTIPLY", with_arrays, F::list, R::operation},
    {"MINVALUE", with_arrays, F::list, R::operation},
    {"MAXVALUE", with_arrays, F::list, R::operation},
    {"OPERATE", with_arrays, F::list, R::operation},
    {"OPERATER", with_arrays, F::list, R::operation},
    {"EQUALREG", with_arrays, F::list, R::operation},
    {"ADDREG", with_arrays, F::list, R::operation},
    {"MULTIREG", with_arrays, F::list, R::operation},
    {"COPYREG", with_arrays, F::list, R::operation},
    refused("COPYBOX", with_arrays, by_grid),

    {"WELSPECS", schedule, F::list, R::well_heads},
    {"COMPDAT", schedule, F::list, R::completions},
    {"WELOPEN", schedule, F::list, R::well_cells},
    {"WPIMULT", schedule, F::list, R::well_cells},
    {"WINJMULT", schedule, F::list, R::well_cells},
    {"COMPLUMP", schedule, F::list, R::well_cells},
    {"CSKIN", schedule, F::list, R::well_cells},
    {"COMPSEGS", schedule, F::list, R::segment_cells},
    {"COMPORD", schedule, F::list, R::connection_order},
    {"WELTRAJ", schedule, F::list, R::stations},
    {"COMPTRAJ", schedule, F::list, R::perforations},
    {"WLIST", schedule, F::list, R::well_names},
    {"WLIFTOPT", schedule, F::list, R::gas_lift},
    refused("COMPDATL", schedule, local),
    refused("WELSPECL", schedule, local),
    refused("COMPSEGL", schedule, local),
    refused("COMPLMPL", schedule, local),
    refused("COMPLUML", schedule, local),
    refused("WELOPENL", schedule, local),
    refused("WPIMULTL", schedule, local),
    refused("LGRLOCK", schedule, local),
    refused("LGRFREE", schedule, local),
    refused("LGRON", schedule, local),
    refused("LGROFF", schedule, local),
    refused("COMPDATX", schedule, by_grid),
    refused("COMPDATM", schedule, by_grid),
    refused("COMPRP", schedule, by_grid),
    refused("COMPIMB", schedule, by_grid),
    refused("COMPRIV", schedule, by_grid),
    refused("COMPINJK", schedule, by_grid),
    refused("COMPKRI", schedule, by_grid),
    refused("COMPVE", schedule, by_grid),
    refused("COMPFRAC", schedule, by_grid),
    refused("COMPAGHG", schedule, by_grid),
    refused("COMPMOBI", schedule, by_grid),
    refused("COMPDATE", schedule, by_grid),
    refused("WINJCLN", schedule, by_grid),
    refused("WINJDAM", schedule, by_grid),
    refused("WINJFCNC", schedule, by_grid),
    refused("SOURCE", schedule, by_grid),
    refused("PYACTION", schedule, script),
    refused("BOX", schedule, in_time),
    refused("EQUALS", schedule, in_time),
    refused("MULTIPLY", schedule, in_time),
    refused("ADD", schedule, in_time),
    refused("MULTX", schedule, in_time),
    refused("MULTX-", schedule, in_time),
    refused("MULTY", schedule, in_time),
    refused("MULTY-", schedule, in_time),
    refused("MULTZ", schedule, in_time),
    refused("MULTZ-", schedule, in_time),
    refused("MULTPV", schedule, in_time),
    refused("MULTFLT", schedule, in_time),
    refused("MULTREGT", schedule, in_time),
    refused("MULTSIG", schedule, in_time),
    refused("MULTSIGV", schedule, in_time),
    refused("EDITNNC", schedule, in_time),
    refused("EDITNNCR", schedule, in_time),
});

/// Tables and options without cells, which may hold as many numbers as a small grid has cells.
constexpr auto kept_tables = std::to_array<std::string_view>(
    {"DENSITY",  "GRAVITY",  "PVTW",     "PVTO",     "PVDO",     "PVCDO",    "PVTG",     "PVDG",     "PVZG",
     "PVTWSALT", "PVTGW",    "PVTGWO",   "PVTSOL",   "RSCONST",  "RSCONSTT", "ROCK",     "ROCKTAB",  "ROCKTABH",
     "ROCKTABW", "ROCKWNOD", "ROCKOPTS", "ROCK2D",   "ROCK2DTR", "SWOF",     "SGOF",     "SLGOF",    "SWFN",
     "SGFN",     "SOF2",     "SOF3",     "SOF32D",   "SGWFN",    "SWF32D",   "SGF32D",   "SGCWMIS",  "SORWMIS",
     "STONE",    "STONE1",   "STONE2",   "STONE1EX", "STOG",     "STOW",     "STWG",     "TLMIXPAR", "PMISC",
     "MISC",     "MSFN",     "SDENSITY", "SSFN",     "EHYSTR",   "EHYSTRR",  "EPSDEBUG", "ENPTVD",   "ENKRVD",
     "ENPCVD",   "ENSPCVD",  "IMPTVD",   "IMKRVD",   "IMPCVD",   "SCALECRS", "SWATINI",  "TRACER",   "TRACERKP",
     "PLYADS",   "PLYMAX",   "PLYROCK",  "PLYSHEAR", "PLYSHLOG", "PLYVISC",  "PLYVISCS", "PLYVMH",   "PLYRRF",
     "PLYTRRF",  "PLMIXPAR", "PLYDHFLF", "PLYATEMP", "PLYCAMAX", "PLYESAL",  "FOAMADS",  "FOAMDCYO", "FOAMDCYW",
     "FOAMFRM",  "FOAMFSC",  "FOAMFSO",  "FOAMFST",  "FOAMFSW",  "FOAMMOB",  "FOAMMOBP", "FOAMMOBS", "FOAMOPTS",
     "FOAMROCK", "SALTNODE", "SALTSOL",  "SALTMF",   "PERMFACT", "BDENSITY", "BGGI",     "BOGI",     "BWGI",
     "SURFADDW", "SURFADS",  "SURFCAPD", "SURFES",   "SURFROCK", "SURFST",   "SURFSTES", "SURFVISC", "ALKALINE",
     "VAPPARS",  "WATJT",    "OILJT",    "GASJT",    "WATVISCT", "OILVISCT", "GASVISCT", "SPECROCK", "SPECHEAT",
     "VISCREF",  "RTEMP",    "RTEMPA",   "RTEMPVD",  "TEMPVD",   "EQUIL",    "RSVD",     "RVVD",     "RVWVD",
     "RSWVD",    "PBVD",     "PDVD",     "SALTVD",   "SALTPVD",  "TVDP",     "THPRES",   "DATUM",    "DATUMR",
     "DATUMRX",  "AQUCT",    "AQUFETP",  "AQUFET",   "AQUTAB",   "AQUFLUX",  "AQUCHGAS", "AQUCHWAT", "APIVD",
     "VISDATES", "RPTSOL",   "RPTRST",   "RPTPROPS", "RPTREGS",  "RPTSCHED", "RPTINIT",  "RPTSMRY",  "OPTIONS",
     "OPTIONS3", "TSTEP",    "DATES",    "TIME",     "TUNING",   "TUNINGDP", "VFPPROD",  "VFPINJ",   "DRSDT",
     "DRVDT",    "NUPCOL",   "NEXTSTEP", "WCONPROD", "WCONINJE", "WCONHIST", "WCONINJH", "WELTARG",  "WECON",
     "WTEST",    "GCONPROD", "GCONINJE", "GRUPTREE", "WEFAC",    "GEFAC",    "UDQ",      "ACTIONX",  "WELSEGS",
     "WSEGVALV", "WSEGAICD", "WSEGSICD", "WSEGITER", "DRSDTR",   "DRVDTR",   "DRSDTCON", "LIFTOPT"});

constexpr WholeDeckRule kept_rule{"", tables, F::open, R::kept};
constexpr WholeDeckRule array_rule{"", with_arrays, F::array, R::array};
constexpr WholeDeckRule directional_rule{"", with_arrays, F::open, R::refused, direction.reason, direction.advice};

/// Several rules of one name stand for different sections.
const auto& rules_by_name() {
  static const auto by_name = [] {
    std::unordered_multimap<std::string_view, const WholeDeckRule*> out;
    for (const WholeDeckRule& rule : rules) out.emplace(rule.name, &rule);
    return out;
  }();
  return by_name;
}

/// SWLX-, KRNUMZ …: arrays that act along one axis.
bool is_directional(std::string_view name) {
  if (name.starts_with("KRNUM") || (name.starts_with("IMBNUM") && name.size() > 6)) return true;
  if (name.size() < 4 || find_cell_array(name) == nullptr) return false;
  std::string_view stem = name;
  if (stem.back() == '-') stem.remove_suffix(1);
  if (std::string_view("XYZ").find(stem.back()) == std::string_view::npos) return false;
  stem.remove_suffix(1);
  // Only end points carry an axis: SWLX is one because SWL is.
  return find_cell_array(stem) != nullptr && !name.starts_with("FIP");
}

bool is_name_in(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

}  // namespace

const WholeDeckRule* find_whole_deck_rule(std::string_view name, DeckSection section) {
  const auto bit = static_cast<unsigned>(section);
  const auto [begin, end] = rules_by_name().equal_range(name);
  for (auto at = begin; at != end; ++at)
    if ((at->second->sections & bit) != 0) return at->second;
  if ((tables & bit) != 0 && is_name_in(kept_tables, name)) return &kept_rule;
  if ((with_arrays & bit) == 0) return nullptr;
  if (is_directional(name)) return &directional_rule;
  return find_cell_array(name) != nullptr ? &array_rule : nullptr;
}

DeckRole whole_deck_summary_role(std::string_view name) {
  static constexpr auto neighbours = std::to_array<std::string_view>({"WBP4", "WBP5", "WBP9"});
  if (is_name_in(neighbours, name)) return DeckRole::neighbour_summary;
  if (name.size() < 3) return DeckRole::kept;
  if (name.starts_with("LB") || name.starts_with("LC") || name.starts_with("LW")) return DeckRole::refused;
  if (name.front() == 'B') return DeckRole::cell_summary;
  if (name.front() == 'C') return DeckRole::connection_summary;
  return DeckRole::kept;
}

bool takes_summary_list(std::string_view name) {
  static constexpr auto without =
      std::to_array<std::string_view>({"ALL", "RUNSUM", "SEPARATE", "RPTONLY", "RPTONLYO", "SUMMARY", "STEPTYPE"});
  if (name.size() < 2 || is_name_in(without, name)) return false;
  // Of N only the pressures of a network's nodes; the others count the solver's iterations.
  if (name.front() == 'N') return name.starts_with("NP");
  return std::string_view("WGRSABC").find(name.front()) != std::string_view::npos;
}

}  // namespace wellknit
