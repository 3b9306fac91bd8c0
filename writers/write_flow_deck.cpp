// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Cells in a layout (deck_layout.h), no transmissibility from their geometry, and every connection as an NNC. Why each
/// part is as it is, with what Flow does otherwise, stands in docs/formats/deck.md.

#include "writers/write_flow_deck.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "model/errors.h"
#include "model/units.h"
#include "writers/deck_grid.h"
#include "writers/deck_text.h"
#include "writers/well_cells.h"

namespace wellknit {

namespace {

constexpr double bar_per_metre = 0.1;       ///< of depth: the initial pressure
constexpr double least_pressure = 100.0;    ///< bar, for models near the surface
constexpr double drawdown_share = 0.2;      ///< of the initial pressure, down for producers and up for injectors
constexpr double gravity_bar = 9.80665e-5;  ///< bar per metre for 1 kg/m3
constexpr double oil_density = 850.0;       ///< kg/m3 at the surface
constexpr double water_density = 1000.0;
constexpr double oil_volume_factor = 1.1;    ///< at the initial pressure
constexpr double default_bore_radius = 0.1;  ///< m, where the mesh has none

constexpr double transmissibility_unit = m3_per_transmissibility_unit(UnitSystem::metric);

/// A cell open to the well, all its perforations in one: a second COMPDAT record of a cell would replace the first.
struct DeckConnection {
  CellId cell;
  double connection_factor = 0.0;       ///< cP rm3 / (day bar)
  double permeability_thickness = 0.0;  ///< mD m
};

struct DeckWell {
  std::string name;  ///< as the deck has it
  std::string mesh_name;
  bool injector = false;
  double diameter = 0.0;  ///< m
  double reference_depth = 0.0;
  std::vector<DeckConnection> connections;  ///< in order along the well
};

DeckWell deck_well(const Mesh& mesh, const MeshWell& well, const DeckGrid& grid, std::int64_t& left_out) {
  DeckWell out;
  out.mesh_name = well.name;
  out.injector = well.type == WellType::injector;
  out.diameter = 2.0 * (well.bore_radius > 0.0 ? well.bore_radius : default_bore_radius);
  const std::vector<double> kh = permeability_thicknesses(mesh, well);
  std::map<CellId, std::size_t> place;
  double shallowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < well.connections.size(); ++i) {
    const WellConnection& connection = well.connections[i];
    if (!grid.is_active(connection.cell)) {
      ++left_out;
      continue;
    }
    const auto [at, is_new] = place.try_emplace(connection.cell, out.connections.size());
    if (is_new) out.connections.push_back({connection.cell, 0.0, 0.0});
    out.connections[at->second].connection_factor += connection.well_index / transmissibility_unit;
    out.connections[at->second].permeability_thickness += kh[i] / m2_per_millidarcy;
    shallowest = std::min(shallowest, mesh.cells.depth[connection.cell]);
  }
  out.reference_depth = well.reference_depth.value_or(shallowest);
  return out;
}

/// What the template's equilibrium is made of, bar and metres.
struct Initial {
  double datum = 0.0;      ///< mean depth of the cells
  double pressure = 0.0;   ///< there
  double gradient = 0.0;   ///< bar per metre of the mobile fluid
  double above_all = 0.0;  ///< a depth above every cell
  double below_all = 0.0;

  [[nodiscard]] double at(double depth) const { return pressure + gradient * (depth - datum); }
};

Initial initial_state(const Mesh& mesh, const DeckGrid& grid, FlowFluids fluids) {
  Initial out;
  double top = std::numeric_limits<double>::infinity();
  double base = -top;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const double depth = mesh.cells.depth[CellId(c)];
    out.datum += depth / static_cast<double>(mesh.cells.size());
    top = std::min(top, depth - 0.5 * grid.thickness(CellId(c)));
    base = std::max(base, depth + 0.5 * grid.thickness(CellId(c)));
  }
  out.pressure = std::max(least_pressure, bar_per_metre * out.datum);
  out.gradient = gravity_bar * (fluids == FlowFluids::water ? water_density : oil_density / oil_volume_factor);
  out.above_all = top - 100.0;
  out.below_all = base + 100.0;
  return out;
}

/// Boxes of the other layouts are the mesh's own, whether its source is known or not.
DeckGrid grid_of(const Mesh& mesh, const FlowDeckOptions& options, const CornerPointGrid* source) {
  return {
      mesh,
      {UnitSystem::metric, options.layout == DeckLayoutKind::nested ? source : nullptr, options.layout, options.order}};
}

class FlowDeck {
 public:
  FlowDeck(const Mesh& mesh, const FlowDeckOptions& options, const CornerPointGrid* source, std::ostream& out)
      : mesh_(mesh),
        options_(options),
        out_(out),
        grid_(grid_of(mesh, options, source)),
        initial_(initial_state(mesh, grid_, options.fluids)) {
    collect_wells();
    collect_notes();
  }

  std::vector<std::string> write() {
    head();
    runspec();
    grid();
    edit();
    props();
    solution();
    summary();
    schedule();
    return notes_;
  }

 private:
  [[nodiscard]] bool has_oil() const { return options_.fluids == FlowFluids::oil_and_water; }

  template <class... Arguments>
  void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    out_ << fmt::format(format, std::forward<Arguments>(arguments)...);
  }

  void collect_wells() {
    std::vector<std::string> names;
    for (const MeshWell& well : mesh_.wells) {
      DeckWell made = deck_well(mesh_, well, grid_, connections_left_out_);
      if (made.connections.empty()) {
        notes_.push_back(
            fmt::format("well {} is not in the deck: it has no connection to a cell with pore volume", well.name));
        continue;
      }
      names.push_back(well.name);
      wells_.push_back(std::move(made));
    }
    const std::vector<std::string> deck_names = deck_well_names(names);
    for (std::size_t i = 0; i < wells_.size(); ++i) {
      wells_[i].name = deck_names[i];
      if (deck_names[i] != names[i])
        notes_.push_back(fmt::format("well {} is called {} in the deck", names[i], deck_names[i]));
    }
  }

  void collect_notes() {
    if (const auto inactive = grid_.inactive_cells(); inactive > 0)
      notes_.push_back(
          fmt::format("{} cells without pore volume are inactive in the deck, with {} connections and {} perforations",
                      inactive, grid_.inactive_connections(), connections_left_out_));
    const auto grid_notes = grid_.notes();
    notes_.insert(notes_.end(), grid_notes.begin(), grid_notes.end());
    if (wells_.empty())
      notes_.push_back(
          "the deck has no wells: at rest, flow 2022.10 stops unless run with "
          "--time-step-control=newtoniterationcount");
  }

  void head() {
    write_deck_comment(out_, "The mesh as a connection list for OPM Flow. " + place_of_cells());
    write_deck_comment(out_, options_.layout == DeckLayoutKind::nested
                                 ? "What connects is the NNC list alone, also where cells are neighbours."
                                 : "The boxes carry depth, thickness and volume only; what connects is the NNC list.");
    write_deck_comment(out_,
                       "Fluids, initial pressure, well controls and times are a template: replace them by your own.");
    write_deck_comment(out_, "Run with: flow --time-step-control=newtoniterationcount THIS.DATA");
    for (const std::string& note : notes_) write_deck_comment(out_, "Note: " + note);
  }

  [[nodiscard]] std::string place_of_cells() const {
    if (!flow_deck_side_files("", options_).empty()) return "A file beside it, _CELLS.grdecl, has the cells' numbers.";
    return options_.layout == DeckLayoutKind::row ? "Cell n of the mesh file is (n+1, 1, 1)."
                                                  : "Cell n of the mesh file is (2n+1, 1, 1).";
  }

  void runspec() {
    std::size_t most = 1;
    for (const DeckWell& well : wells_) most = std::max(most, well.connections.size());
    print("\nRUNSPEC\nTITLE\n wellknit: {} cells, {} connections, {} wells\n", mesh_.cells.size(),
          grid_.connection_count(), wells_.size());
    const auto [nx, ny, nz] = grid_.layout().dimensions();
    print("DIMENS\n {} {} {} /\n{}WATER\nMETRIC\nSTART\n 1 JAN 2026 /\n", nx, ny, nz, has_oil() ? "OIL\n" : "");
    print("EQLDIMS\n 1 /\nTABDIMS\n 1 1 20 20 /\nWELLDIMS\n {} {} 1 {} /\nUNIFOUT\n",
          std::max<std::size_t>(1, wells_.size()), most, std::max<std::size_t>(1, wells_.size()));
  }

  void grid() {
    print("\nGRID\n");
    grid_.write_grid(out_);
  }

  void edit() {
    print("\nEDIT\n");
    grid_.write_edit(out_);
  }

  void props() {
    print("\nPROPS\n");
    if (!has_oil()) {
      print("PVTW\n {:.6g} 1 1E-9 0.5 0 /\nROCK\n {:.6g} 1E-9 /\nDENSITY\n {} {} 1 /\n", initial_.pressure,
            initial_.pressure, oil_density, water_density);
      return;
    }
    print("PVTW\n {:.6g} 1 4.5E-5 0.5 0 /\nPVDO\n", initial_.pressure);
    // Compressibility 1E-4 / bar, 1 cP.
    for (const double share : {0.01, 0.5, 1.0, 2.0, 4.0}) {
      const double pressure = share * initial_.pressure;
      print(" {:.6g} {:.8g} 1 \n", pressure, oil_volume_factor * std::exp(-1e-4 * (pressure - initial_.pressure)));
    }
    print("/\nROCK\n {:.6g} 5E-5 /\nDENSITY\n {} {} 1 /\n", initial_.pressure, oil_density, water_density);
    write_deck_comment(out_, "Corey exponents 2, connate water 0.2, residual oil 0.2");
    print("SWOF\n");
    constexpr int rows = 12;
    for (int row = 0; row <= rows; ++row) {
      const double s = static_cast<double>(row) / rows;
      print(" {:.6g} {:.8g} {:.8g} 0\n", 0.2 + 0.6 * s, 0.4 * s * s, 0.9 * (1.0 - s) * (1.0 - s));
    }
    print("/\n");
  }

  void solution() {
    // One mobile fluid: the contact lies below everything (oil) or above (water).
    print("\nSOLUTION\nEQUIL\n {} {} {} 0 /\nRPTRST\n BASIC=2 /\n", initial_.datum, initial_.pressure,
          has_oil() ? initial_.below_all : initial_.above_all);
  }

  void summary() {
    print("\nSUMMARY\nFPR\nFWPR\nFWIR\nFWPT\nFWIT\n{}", has_oil() ? "FOPR\nFOPT\nFWCT\n" : "");
    if (wells_.empty()) return;
    print("WBHP\n/\nWWPR\n/\nWWIR\n/\n{}", has_oil() ? "WOPR\n/\nWWCT\n/\n" : "");
  }

  void schedule() {
    print("\nSCHEDULE\nRPTRST\n BASIC=2 /\n");
    if (!wells_.empty()) write_wells();
    print("TSTEP\n 0.1 0.9 4 5 10 10 11*30 /\nEND\n");
  }

  void write_wells() {
    print("WELSPECS\n");
    for (const DeckWell& well : wells_) {
      const auto [i, j, k] = grid_.layout().ijk(well.connections.front().cell);
      print(" '{}' 'G' {} {} {} {} /\n", well.name, i, j, well.reference_depth,
            well.injector || !has_oil() ? "WATER" : "OIL");
    }
    // The default order of a well's connections follows the boxes, which mean nothing.
    print("/\nCOMPORD\n '*' INPUT /\n/\nCOMPDAT\n");
    for (const DeckWell& well : wells_)
      for (const DeckConnection& c : well.connections) {
        const auto [i, j, k] = grid_.layout().ijk(c.cell);
        print(" '{}' {} {} {} {} OPEN 1* {} {} {} 0 1* Z /\n", well.name, i, j, k, k, c.connection_factor,
              well.diameter, c.permeability_thickness);
      }
    print("/\n");
    write_controls(true);
    write_controls(false);
  }

  void write_controls(bool injectors) {
    const auto is_wanted = [&](const DeckWell& well) { return well.injector == injectors; };
    if (std::none_of(wells_.begin(), wells_.end(), is_wanted)) return;
    print("{}\n", injectors ? "WCONINJE" : "WCONPROD");
    const double drawdown = drawdown_share * initial_.pressure;
    for (const DeckWell& well : wells_) {
      if (!is_wanted(well)) continue;
      const double initial = initial_.at(well.reference_depth);
      if (injectors)
        print(" '{}' WATER OPEN BHP 2* {:.8g} /\n", well.name, initial + drawdown);
      else
        print(" '{}' OPEN BHP 5* {:.8g} /\n", well.name, std::max(1.0, initial - drawdown));
    }
    print("/\n");
  }

  const Mesh& mesh_;
  const FlowDeckOptions& options_;
  std::ostream& out_;
  DeckGrid grid_;
  Initial initial_;
  std::vector<DeckWell> wells_;
  std::vector<std::string> notes_;
  std::int64_t connections_left_out_ = 0;
};

/// A keyword with a whole number for each place of the layout.
template <class Value>
void write_map(std::ostream& out, const DeckLayout& layout, const char* keyword, Value value) {
  DeckArray array(out, keyword);
  for (std::size_t at = 0; at < layout.cell_at().size(); ++at)
    array.add(static_cast<double>(value(static_cast<std::int64_t>(at), layout.cell_at()[at])));
  array.end();
}

/// Level of refinement: 1 of the source grid, 2 of what was made in the place of its cells.
void write_refine(std::ostream& out, const DeckLayout& layout, const CornerPointGrid& source) {
  write_deck_comment(out, "1: a cell of the source grid; 2: made in the place of one");
  const std::int64_t nx = layout.dimensions()[0];
  write_map(out, layout, "REFINE",
            [&](std::int64_t at, CellId cell) { return at % nx >= source.dimensions[0] && cell.is_valid() ? 2 : 1; });
}

/// The source cell of every place, which is its own in the source grid; 0 where nothing stands.
void write_old_ijk(std::ostream& out, const DeckLayout& layout, const Mesh& mesh, const CornerPointGrid& source) {
  write_deck_comment(out, "the cell of the source grid that most of a cell lies in; 0: no cell stands here");
  const auto [nx, ny, nz] = layout.dimensions();
  const IdVector<CellId, HostCellId> parent = main_source_cells(mesh);
  for (std::size_t axis = 0; axis < 3; ++axis)
    write_map(out, layout, std::array{"OLDI", "OLDJ", "OLDK"}[axis],
              [&, nx = nx, ny = ny](std::int64_t at, CellId cell) -> std::int64_t {
                if (at % nx < source.dimensions[0]) return std::array{at % nx, at / nx % ny, at / (nx * ny)}[axis] + 1;
                if (!cell.is_valid() || !parent[cell].is_valid()) return 0;
                return source.ijk(parent[cell])[axis] + 1;
              });
}

}  // namespace

std::vector<std::string> write_flow_deck(const Mesh& mesh, const std::string& path, const FlowDeckOptions& options,
                                         Overwrite overwrite, const CornerPointGrid* source) {
  OutputStream out(path, overwrite);
  std::vector<std::string> notes = FlowDeck(mesh, options, source, out.stream()).write();
  out.commit();
  return notes;
}

std::vector<std::string> flow_deck_side_files(const std::string& path, const FlowDeckOptions& options) {
  const std::filesystem::path deck(path);
  std::string stem = deck.stem().string();
  std::transform(stem.begin(), stem.end(), stem.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  const bool is_nested = options.layout == DeckLayoutKind::nested;
  std::vector<std::string> out;
  const auto add = [&](const char* end) { out.push_back((deck.parent_path() / (stem + end)).string()); };
  if (is_nested || options.order != CellOrder::mesh) add("_CELLS.grdecl");
  if (is_nested) add("_REFINE.grdecl");
  if (is_nested) add("_OLDIJK.grdecl");
  return out;
}

void write_flow_deck_side_files(const Mesh& mesh, const std::vector<std::string>& paths, const FlowDeckOptions& options,
                                Overwrite overwrite, const CornerPointGrid* source) {
  if (paths.empty()) return;
  const DeckGrid grid = grid_of(mesh, options, source);
  const DeckLayout& layout = grid.layout();
  for (std::size_t n = 0; n < paths.size(); ++n) {
    OutputStream out(paths[n], overwrite);
    if (n == 0) {
      write_deck_comment(out.stream(), "number of the cell in the mesh file, from 1; 0: none stands here");
      write_map(out.stream(), layout, "MESHCELL",
                [](std::int64_t, CellId cell) { return cell.is_valid() ? cell.value() + 1 : 0; });
    } else if (n == 1) {
      write_refine(out.stream(), layout, *source);
    } else {
      write_old_ijk(out.stream(), layout, mesh, *source);
    }
    out.commit();
  }
}

}  // namespace wellknit
