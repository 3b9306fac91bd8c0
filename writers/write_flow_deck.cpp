// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The form is N x 1 x 1 cells with a box each, no transmissibility from the boxes, and every connection as an NNC. Why
/// each part is as it is, with what Flow does otherwise, stands in docs/formats/deck.md.

#include "writers/write_flow_deck.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "model/errors.h"
#include "model/mesh_topology.h"
#include "model/units.h"
#include "writers/deck_text.h"

namespace wellknit {

namespace {

constexpr double thinnest_box = 1e-4;  ///< m; Flow drops cells without thickness, and kept 1e-5 m when it was tried
constexpr double longest_row = 1e6;    ///< m, of all boxes side by side: single precision still resolves 0.06 m there
constexpr double bar_per_metre = 0.1;  ///< of depth: the initial pressure
constexpr double least_pressure = 100.0;    ///< bar, for models near the surface
constexpr double drawdown_share = 0.2;      ///< of the initial pressure, down for producers and up for injectors
constexpr double flow_smallest_nnc = 1e-6;  ///< cP rm3 / (day bar); Flow sets smaller ones to zero
constexpr double gravity_bar = 9.80665e-5;  ///< bar per metre for 1 kg/m3
constexpr double oil_density = 850.0;       ///< kg/m3 at the surface
constexpr double water_density = 1000.0;
constexpr double oil_volume_factor = 1.1;    ///< at the initial pressure
constexpr double default_bore_radius = 0.1;  ///< m, where the mesh has none

constexpr double transmissibility_unit = m3_per_transmissibility_unit(UnitSystem::metric);

/// The box that stands for each cell: the cell's own depth, volume and mean vertical thickness.
struct Boxes {
  std::vector<double> area;       ///< m2, of the cell's projection on a horizontal plane
  std::vector<double> thickness;  ///< m, volume over area
  std::vector<bool> active;       ///< has a pore volume
  std::int64_t thickened = 0;     ///< cells that are thinner than the thinnest box
};

Boxes boxes_of(const Mesh& mesh) {
  const CellFaces faces = faces_of_cells(mesh);
  Boxes out;
  std::vector<double> projected(mesh.cells.size(), 0.0);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const double area = std::abs(face_geometry(mesh, FaceId(f)).area_vector.z());
    for (const CellId cell : mesh.faces.cells[FaceId(f)])
      if (cell.is_valid()) projected[cell.index()] += 0.5 * area;  // the top and the base, each once
  }
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const double volume = mesh.cells.volume[CellId(c)];
    const double thickness = projected[c] > 0.0 ? volume / projected[c] : std::cbrt(volume);
    if (thickness < thinnest_box) ++out.thickened;
    out.thickness.push_back(std::max(thickness, thinnest_box));
    out.area.push_back(volume / out.thickness.back());
    out.active.push_back(mesh.cells.pore_volume[CellId(c)] > 0.0);
  }
  return out;
}

/// A pair of cells with the sum of its connections, in deck units.
struct Nnc {
  std::int64_t first, second;  ///< 0-based cells
  double transmissibility;
};

struct NncList {
  std::vector<Nnc> records;
  std::int64_t inactive = 0;   ///< connections left out because a cell has no pore volume
  std::int64_t too_small = 0;  ///< records that Flow sets to zero
};

NncList nnc_list(const Mesh& mesh, const Boxes& boxes) {
  std::vector<Nnc> sorted;
  NncList out;
  for (std::size_t i = 0; i < mesh.connections.size(); ++i) {
    const auto& [a, b] = mesh.connections.cells[ConnectionId(i)];
    if (!boxes.active[a.index()] || !boxes.active[b.index()]) {
      ++out.inactive;
      continue;
    }
    sorted.push_back({std::min(a, b).value(), std::max(a, b).value(),
                      mesh.connections.transmissibility[ConnectionId(i)] / transmissibility_unit});
  }
  std::stable_sort(sorted.begin(), sorted.end(), [](const Nnc& x, const Nnc& y) {
    return std::pair(x.first, x.second) < std::pair(y.first, y.second);
  });
  for (const Nnc& nnc : sorted) {
    if (!out.records.empty() && out.records.back().first == nnc.first && out.records.back().second == nnc.second)
      out.records.back().transmissibility += nnc.transmissibility;
    else
      out.records.push_back(nnc);
  }
  // Neighbours in the row are folded into TRANX, where no lower bound applies.
  const auto is_lost = [](const Nnc& nnc) {
    return nnc.second != nnc.first + 1 && nnc.transmissibility < flow_smallest_nnc;
  };
  out.too_small = std::count_if(out.records.begin(), out.records.end(), is_lost);
  return out;
}

/// A cell open to the well, all its perforations in one: a second COMPDAT record of a cell would replace the first.
struct DeckConnection {
  std::int64_t cell = 0;                ///< 0-based
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

/// Kh of a perforation: sqrt(kx ky) times its length, shared evenly between the cells around one stretch of the bore.
/// With the factor given as well, Flow only works out an equivalent radius from it.
std::vector<double> permeability_thicknesses(const Mesh& mesh, const MeshWell& well) {
  std::map<std::pair<double, double>, int> around;
  for (const WellConnection& c : well.connections) ++around[{c.measured_depth.from, c.measured_depth.to}];
  std::vector<double> out;
  for (const WellConnection& c : well.connections) {
    const Vec3& k = mesh.cells.permeability[c.cell];
    const double length = std::abs(c.measured_depth.to - c.measured_depth.from);
    const double kh =
        std::sqrt(std::max(0.0, k.x() * k.y())) * length / around[{c.measured_depth.from, c.measured_depth.to}];
    // Without a length or a permeability: what the factor alone would say at an equivalent radius of e times the
    // bore's.
    const double from_factor = c.well_index / 6.283185307179586;
    out.push_back((kh > 0.0 ? kh : from_factor) / m2_per_millidarcy);
  }
  return out;
}

DeckWell deck_well(const Mesh& mesh, const MeshWell& well, const Boxes& boxes, std::int64_t& left_out) {
  DeckWell out;
  out.mesh_name = well.name;
  out.injector = well.type == WellType::injector;
  out.diameter = 2.0 * (well.bore_radius > 0.0 ? well.bore_radius : default_bore_radius);
  const std::vector<double> kh = permeability_thicknesses(mesh, well);
  std::map<std::int64_t, std::size_t> place;
  double shallowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < well.connections.size(); ++i) {
    const WellConnection& connection = well.connections[i];
    if (!boxes.active[connection.cell.index()]) {
      ++left_out;
      continue;
    }
    const auto [at, is_new] = place.try_emplace(connection.cell.value(), out.connections.size());
    if (is_new) out.connections.push_back({connection.cell.value(), 0.0, 0.0});
    out.connections[at->second].connection_factor += connection.well_index / transmissibility_unit;
    out.connections[at->second].permeability_thickness += kh[i];
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

Initial initial_state(const Mesh& mesh, const Boxes& boxes, FlowFluids fluids) {
  Initial out;
  double top = std::numeric_limits<double>::infinity();
  double base = -top;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const double depth = mesh.cells.depth[CellId(c)];
    out.datum += depth / static_cast<double>(mesh.cells.size());
    top = std::min(top, depth - 0.5 * boxes.thickness[c]);
    base = std::max(base, depth + 0.5 * boxes.thickness[c]);
  }
  out.pressure = std::max(least_pressure, bar_per_metre * out.datum);
  out.gradient = gravity_bar * (fluids == FlowFluids::water ? water_density : oil_density / oil_volume_factor);
  out.above_all = top - 100.0;
  out.below_all = base + 100.0;
  return out;
}

class FlowDeck {
 public:
  FlowDeck(const Mesh& mesh, const FlowDeckOptions& options, std::ostream& out)
      : mesh_(mesh),
        options_(options),
        out_(out),
        boxes_(boxes_of(mesh)),
        nnc_(nnc_list(mesh, boxes_)),
        initial_(initial_state(mesh, boxes_, options.fluids)) {
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
      DeckWell made = deck_well(mesh_, well, boxes_, connections_left_out_);
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
    const auto inactive = std::count(boxes_.active.begin(), boxes_.active.end(), false);
    if (inactive > 0)
      notes_.push_back(
          fmt::format("{} cells without pore volume are inactive in the deck, with {} connections and {} perforations",
                      inactive, nnc_.inactive, connections_left_out_));
    if (nnc_.too_small > 0)
      notes_.push_back(fmt::format("{} connections lie below {:g} cP rm3/(day bar): Flow sets them to zero",
                                   nnc_.too_small, flow_smallest_nnc));
    if (wells_.empty())
      notes_.push_back(
          "the deck has no wells: at rest, flow 2022.10 stops unless run with "
          "--time-step-control=newtoniterationcount");
    if (boxes_.thickened > 0)
      notes_.push_back(
          fmt::format("{} cells thinner than {:g} m have a box of that thickness", boxes_.thickened, thinnest_box));
  }

  void head() {
    write_deck_comment(out_, "The mesh as a connection list for OPM Flow. Cell n of the mesh file is (n+1, 1, 1).");
    write_deck_comment(out_, "The boxes carry depth, thickness and volume only; what connects is the NNC list.");
    write_deck_comment(out_,
                       "Fluids, initial pressure, well controls and times are a template: replace them by your own.");
    write_deck_comment(out_, "Run with: flow --time-step-control=newtoniterationcount THIS.DATA");
    for (const std::string& note : notes_) write_deck_comment(out_, "Note: " + note);
  }

  void runspec() {
    std::size_t most = 1;
    for (const DeckWell& well : wells_) most = std::max(most, well.connections.size());
    print("\nRUNSPEC\nTITLE\n wellknit: {} cells, {} connections, {} wells\n", mesh_.cells.size(), nnc_.records.size(),
          wells_.size());
    print("DIMENS\n {} 1 1 /\n{}WATER\nMETRIC\nSTART\n 1 JAN 2026 /\n", mesh_.cells.size(), has_oil() ? "OIL\n" : "");
    print("EQLDIMS\n 1 /\nTABDIMS\n 1 1 20 20 /\nWELLDIMS\n {} {} 1 {} /\nUNIFOUT\n",
          std::max<std::size_t>(1, wells_.size()), most, std::max<std::size_t>(1, wells_.size()));
  }

  void grid() {
    print("\nGRID\nINIT\nGRIDFILE\n 0 1 /\n");
    write_coord();
    write_zcorn();
    if (std::count(boxes_.active.begin(), boxes_.active.end(), false) > 0)
      write_deck_array(out_, "ACTNUM", std::vector<double>(boxes_.active.begin(), boxes_.active.end()));
    write_deck_array(out_, "PORO", mesh_.cells.porosity.raw());
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      std::vector<double> millidarcy;
      for (const Vec3& k : mesh_.cells.permeability) millidarcy.push_back(k[axis] / m2_per_millidarcy);
      write_deck_array(out_, std::array{"PERMX", "PERMY", "PERMZ"}[static_cast<std::size_t>(axis)], millidarcy);
    }
    write_nnc();
  }

  /// Vertical pillars, two rows, as far apart as makes the boxes about as wide as long, or the row short enough.
  void write_coord() {
    double total = 0.0;
    for (const double area : boxes_.area) total += area;
    const double width = std::max(std::sqrt(total / static_cast<double>(boxes_.area.size())), total / longest_row);
    std::vector<double> coord;
    for (const double y : {0.0, width}) {
      double x = 0.0;
      for (std::size_t i = 0; i <= boxes_.area.size(); ++i) {
        coord.insert(coord.end(), {x, y, initial_.above_all, x, y, initial_.below_all});
        if (i < boxes_.area.size()) x += boxes_.area[i] / width;
      }
    }
    write_deck_array(out_, "COORD", coord);
  }

  void write_zcorn() {
    std::vector<double> zcorn;
    zcorn.reserve(8 * mesh_.cells.size());
    for (const double side : {-0.5, 0.5})
      for (int row = 0; row < 2; ++row)
        for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
          zcorn.insert(zcorn.end(), 2, mesh_.cells.depth[CellId(c)] + side * boxes_.thickness[c]);
    write_deck_array(out_, "ZCORN", zcorn);
  }

  void write_nnc() {
    if (nnc_.records.empty()) return;
    print("NNC\n");
    for (const Nnc& nnc : nnc_.records)
      print(" {} 1 1 {} 1 1 {} /\n", nnc.first + 1, nnc.second + 1, nnc.transmissibility);
    print("/\n");
  }

  void edit() {
    print("\nEDIT\n");
    write_deck_array(out_, "PORV", mesh_.cells.pore_volume.raw());
    write_deck_comment(out_, "what the boxes would connect; the NNC list is added to it");
    print("EQUALS\n TRANX 0 /\n/\n");
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
    for (const DeckWell& well : wells_)
      print(" '{}' 'G' {} 1 {} {} /\n", well.name, well.connections.front().cell + 1, well.reference_depth,
            well.injector || !has_oil() ? "WATER" : "OIL");
    // The default order of a well's connections follows the boxes, which mean nothing.
    print("/\nCOMPORD\n '*' INPUT /\n/\nCOMPDAT\n");
    for (const DeckWell& well : wells_)
      for (const DeckConnection& c : well.connections)
        print(" '{}' {} 1 1 1 OPEN 1* {} {} {} 0 1* Z /\n", well.name, c.cell + 1, c.connection_factor, well.diameter,
              c.permeability_thickness);
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
  Boxes boxes_;
  NncList nnc_;
  Initial initial_;
  std::vector<DeckWell> wells_;
  std::vector<std::string> notes_;
  std::int64_t connections_left_out_ = 0;
};

}  // namespace

std::vector<std::string> write_flow_deck(const Mesh& mesh, const std::string& path, const FlowDeckOptions& options,
                                         Overwrite overwrite) {
  if (mesh.cells.size() == 0) throw InvalidInput("the mesh has no cells: a deck needs at least one");
  OutputStream out(path, overwrite);
  std::vector<std::string> notes = FlowDeck(mesh, options, out.stream()).write();
  out.commit();
  return notes;
}

}  // namespace wellknit
