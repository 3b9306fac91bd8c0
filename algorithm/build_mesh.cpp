// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The steps are those of method.md §0; each one's source is named in its own file.
#include "algorithm/build_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <set>

#include "algorithm/assembly.h"
#include "algorithm/edit_connections.h"
#include "algorithm/flow_connections.h"
#include "algorithm/heal_faults.h"
#include "algorithm/host_validity.h"
#include "algorithm/metric_space.h"
#include "algorithm/path_cells.h"
#include "algorithm/property_transfer.h"
#include "algorithm/source_pore_volume.h"
#include "algorithm/split_columns.h"
#include "algorithm/well_connections.h"
#include "algorithm/well_mesher.h"
#include "algorithm/well_path.h"
#include "algorithm/well_sample.h"
#include "model/errors.h"

namespace wellknit {

namespace {

class Clock {
 public:
  explicit Clock(std::vector<StepTime>& times) : times_(times) {}
  /// Adds the time since the last call to a step.
  void lap(const std::string& step) {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    for (StepTime& t : times_)
      if (t.step == step) {
        t.seconds += seconds;
        return;
      }
    times_.push_back({step, seconds});
  }

 private:
  std::vector<StepTime>& times_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

void check_wells(const std::vector<Well>& wells) {
  std::set<std::string> names;
  for (const Well& w : wells) {
    if (!names.insert(w.name).second)
      throw InvalidInput(
          fmt::format("well {} is given twice: give each trajectory its own name with --well FILE,name=NAME", w.name));
    try {
      (void)circle_radii(w.radial);
      (void)WellPath(w.trajectory);
    } catch (const InvalidInput& e) {
      throw InvalidInput(fmt::format("well {}: {}", w.name, e.what()));
    }
  }
}

/// Everything that one run shares.
class Builder {
 public:
  Builder(const CornerPointGrid& grid, const std::vector<Well>& wells, const BuildOptions& options)
      : grid_(grid), given_(wells), wells_(wells), options_(options), clock_(result_.summary.times) {
    for (Well& w : wells_) take_effective_radius(w);
    mesh_grid_ = &grid_;
    mesh_wells_ = &wells_;
  }

  BuildResult build() {
    check_wells(wells_);
    host_ = build_host_mesh(grid_);
    result_.summary.notes = host_.notes;
    result_.summary.validity = check_host_validity(grid_, host_);
    locator_ = std::make_unique<CellLocator>(grid_);
    if (options_.metric == Metric::permeability && !wells_.empty() && options_.split == 1) move_to_metric_space();
    clock_.lap("host grid");
    Assembly assembly = knit();
    optimise(assembly);
    if (mesh_grid_ != &grid_) move_back(assembly);
    host_.faces.forget_loops();
    transfer_properties(grid_, host_, *locator_, cavities_, assembly);
    clock_.lap("properties");
    note_missing_properties();
    note_empty_cells(assembly.mesh);
    note_volumes(assembly);
    const HostMultipliers multipliers(grid_);
    FluxDefects defects;
    connect_cells({grid_, host_, *locator_, multipliers, wells_}, assembly,
                  options_.fluxes != Fluxes::two_point ? &defects : nullptr);
    for (std::string& note : edit_connections(grid_, host_, multipliers, assembly))
      result_.summary.notes.push_back(std::move(note));
    if (options_.fluxes != Fluxes::two_point) assembly.mesh.stencils = consistent_fluxes(assembly.mesh, defects);
    add_wells(assembly);
    if (options_.fluxes == Fluxes::adapted) adapt_fluxes(assembly.mesh, defects);
    number_segments(assembly);
    clock_.lap("connections");
    for (const TransitionMesh& c : cavities_) result_.summary.cavities.push_back(c.summary);
    result_.mesh = std::move(assembly.mesh);
    return std::move(result_);
  }

 private:
  /// A negative skin is flow without resistance out to r_w e^-skin: the rings start there. A first ring thinner than
  /// that could not carry it.
  static void take_effective_radius(Well& well) {
    if (!(well.skin < 0.0)) return;
    const double effective = well.radial.bore_radius * std::exp(-well.skin);
    if (!(effective < 0.9 * well.radial.drainage_radius))
      throw InvalidInput(
          fmt::format("well {}: a skin of {:g} is an effective bore radius of {:.3g} m, beyond the drainage radius of "
                      "{:g} m: choose a "
                      "larger drainage radius or check the skin",
                      well.name, well.skin, effective, well.radial.drainage_radius));
    well.radial.bore_radius = effective;
    well.skin = 0.0;
  }

  /// The permeability metric: the mesh is made in a moved grid, around moved wells.
  void move_to_metric_space() {
    // Says in real coordinates which well misses the grid.
    for (const Well& w : wells_) (void)sample_well(grid_, host_, *locator_, w);
    const AffineMap space = metric_space(grid_, host_, *locator_, wells_);
    result_.summary.metric_space = space;
    if (space.is_identity()) return;
    moved_grid_ = std::make_unique<CornerPointGrid>(moved(space, grid_));
    for (const Well& w : wells_) moved_wells_.push_back(moved(space, grid_, w));
    mesh_grid_ = moved_grid_.get();
    mesh_wells_ = &moved_wells_;
    host_ = build_host_mesh(*mesh_grid_);
    locator_ = std::make_unique<CellLocator>(*mesh_grid_);
    result_.summary.notes.push_back(fmt::format(
        "the mesh was made in a space where the permeability along the wells is the same in all directions, "
        "with depths times {:.3g}: drainage radii are horizontal ones, and distances in the notes on wells "
        "are those of that space",
        space.matrix(2, 2)));
  }

  /// Everything back in the real space; properties and transmissibilities are computed there.
  void move_back(Assembly& assembly) {
    const AffineMap& space = *result_.summary.metric_space;
    wellknit::move_back(space, grid_, host_);
    wellknit::move_back(space, assembly);
    for (TransitionMesh& c : cavities_)
      for (Tube& t : c.cavity.tubes) wellknit::move_back(moved_wells_[t.well], t);
    locator_ = std::make_unique<CellLocator>(grid_);
    moved_grid_.reset();
    clock_.lap("assembly");
  }

  /// The whole mesh. Where cells do not close, which no case is known to do, the wells beside them are left out and
  /// all is done again: a mesh that is not sound is never given.
  Assembly knit() {
    std::map<std::size_t, std::string> left_out;
    for (;;) {
      make_cavities(left_out);
      clock_.lap("near-well mesh");
      refine();
      clock_.lap("refinement");
      Assembly assembly = assemble(*mesh_grid_, host_, cavities_);
      clock_.lap("assembly");
      if (assembly.unsound_cells.empty()) return assembly;
      for (const CellId cell : assembly.unsound_cells)
        note_open_mesh(cavities_, assembly.mesh.cells.center[cell], left_out);
      host_ = build_host_mesh(*mesh_grid_);
      clock_.lap("host grid");
    }
  }

  void make_cavities(const std::map<std::size_t, std::string>& left_out) {
    cavities_.clear();
    near_well_grids_.clear();
    MeshedWells meshed = options_.split > 1
                             ? split_columns(grid_, host_, *locator_, wells_, options_.split)
                             : mesh_wells(*mesh_grid_, host_, *locator_, *mesh_wells_, options_, left_out);
    result_.summary.wells = std::move(meshed.wells);
    plan_ = std::move(meshed.plan);
    for (MeshedCavity& c : meshed.cavities) {
      near_well_grids_.push_back(std::move(c.grid));
      cavities_.push_back(std::move(c.mesh));
    }
  }

  /// Splits the columns that the cavities ask for, and gives the cavities their places in the split host.
  void refine() {
    if (!plan_.empty()) refine_host(*mesh_grid_, plan_, host_);
    for (std::size_t c = 0; c < cavities_.size(); ++c) {
      Cavity& cavity = cavities_[c].cavity;
      bind_to_host(*near_well_grids_[c], plan_, cavity);
      for (std::size_t v = 0; v < cavity.vertices.size(); ++v) cavities_[c].vertices[v] = cavity.vertices[v].real;
      cavities_[c].summary.cells_refined = refined_cells(*near_well_grids_[c], cavity);
    }
  }

  /// Source cells that the cavity's cells are parts of.
  static std::int64_t refined_cells(const NearWellGrid& grid, const Cavity& cavity) {
    if (grid.is_source()) return 0;
    std::set<HostCellId> cells;
    for (const NearWellCell& c : cavity.removed) cells.insert(grid.source_cell(c));
    return static_cast<std::int64_t>(cells.size());
  }

  /// The segments of a well's tubes are counted on from tube to tube.
  void number_segments(Assembly& assembly) {
    std::vector<std::int32_t> before(wells_.size(), 0);
    for (const PlacedTube& t : assembly.tubes) {
      const RadialMesh& m = t.tube->real;
      std::int32_t& first = before[t.tube->well];
      const std::int64_t count = static_cast<std::int64_t>(m.segments) * m.sectors * m.rings;
      for (std::int64_t c = 0; first > 0 && c < count; ++c)
        assembly.mesh.cells.radial_index[CellId(t.first_cell.value() + c)].segment += first;
      first += m.segments;
    }
  }

  void optimise(Assembly& assembly) {
    if (options_.optimise == Optimisation::off || cavities_.empty()) return;
    const std::vector<CellId> kept = transition_cells_on_paths(assembly, *mesh_wells_);
    if (options_.optimise != Optimisation::vertices)
      result_.summary.edge_collapse = collapse_short_edges(assembly, kept);
    if (options_.optimise != Optimisation::edges) result_.summary.optimisation = optimise_mesh(assembly.mesh, kept);
    if (options_.optimise == Optimisation::on) {
      // What stood in the way of some edges has moved. Faces are plane now and are to stay so.
      constexpr double length = 0.025;
      constexpr double planarity = 0.03;
      const EdgeCollapse again = collapse_short_edges(assembly, kept, {.length = length, .planarity = planarity});
      EdgeCollapse& edges = *result_.summary.edge_collapse;
      edges.short_after = again.short_after;
      edges.shortest_after = again.shortest_after;
      edges.edges_removed += again.edges_removed;
      edges.faces_removed += again.faces_removed;
    }
    clock_.lap("optimisation");
  }

  /// Where the mapping cannot follow the grid's outside the rock in a cavity gains or loses bulk volume. Its pore
  /// volume is kept.
  void note_volumes(const Assembly& assembly) {
    std::vector<double> made(cavities_.size(), 0.0);
    const Cells& cells = assembly.mesh.cells;
    if (const VolumeMismatch& found = assembly.volume_mismatch; found.count > 0) {
      const auto [i, j, k] = grid_.ijk(cells.source_cell[found.cell]);
      result_.summary.notes.push_back(
          fmt::format("The faces of {} host cells beside faults enclose a volume more than {:g} % off that of their "
                      "corners, at worst "
                      "{:.0f} % in cell ({}, {}, {}), since pillars lean there; volumes, pore volumes and "
                      "transmissibilities are those of "
                      "the corners.",
                      found.count, 100.0 * VolumeMismatch::limit, 100.0 * found.worst, i + 1, j + 1, k + 1));
    }
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const CellId cell(c);
      if (cells.kind[cell] != CellKind::transition && cells.kind[cell] != CellKind::radial) continue;
      made[cavity_of(assembly, cell)] += cells.volume[cell];
    }
    for (std::size_t c = 0; c < cavities_.size(); ++c) {
      double removed = 0.0;
      for (const HostCellId r : cavities_[c].cavity.removed_cells) removed += host_.volume[r];
      // A thousandth: the chords of curved horizons and the bore stay below it.
      if (const double change = made[c] / removed - 1.0; std::abs(change) > 1e-3)
        result_.summary.notes.push_back(
            fmt::format("the bulk volume of cavity {} changes by {:+.2f} %: the top, base or sides of the grid are "
                        "curved there and "
                        "its cells follow them in chords; its pore volume is kept",
                        c + 1, 100.0 * change));
    }
  }

  static std::size_t cavity_of(const Assembly& assembly, CellId made) {
    const auto last_at_or_before = [](const auto& starts, std::int64_t at) {
      return static_cast<std::size_t>(
                 std::distance(starts.begin(), std::upper_bound(starts.begin(), starts.end(), at))) -
             1;
    };
    if (assembly.mesh.cells.kind[made] == CellKind::transition)
      return last_at_or_before(assembly.first_transition_cell, made.value());
    std::vector<std::int64_t> tubes;
    for (const PlacedTube& t : assembly.tubes) tubes.push_back(t.first_cell.value());
    return last_at_or_before(assembly.first_tube, static_cast<std::int64_t>(last_at_or_before(tubes, made.value())));
  }

  /// A grid alone is enough for a mesh, but not for flow.
  void note_missing_properties() {
    std::string missing;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (grid_.permeability[axis].empty())
        missing += fmt::format("{}PERM{}", missing.empty() ? "" : ", ", "XYZ"[axis]);
    if (!missing.empty())
      result_.summary.notes.push_back(
          fmt::format("no {}: transmissibilities and well indices along it are 0; give it with the grid", missing));
    if (!has_pore_volumes(grid_)) result_.summary.notes.push_back("no PORO: pore volumes are 0; give it with the grid");
  }

  /// Made cells without pores stand in inactive rock: right, but the user should know.
  void note_empty_cells(const Mesh& mesh) {
    if (grid_.porosity.empty()) return;
    std::int64_t count = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      count += mesh.cells.kind[CellId(c)] >= CellKind::transition && !(mesh.cells.pore_volume[CellId(c)] > 0.0) ? 1 : 0;
    if (count > 0)
      result_.summary.notes.push_back(
          fmt::format("{} made cells lie wholly in inactive rock or rock without pores", count));
  }

  void adapt_fluxes(Mesh& mesh, const FluxDefects& defects) {
    result_.summary.adaptation = adapt_transmissibilities(mesh, defects);
    mesh.stencils.reset();
  }

  void add_wells(Assembly& assembly) {
    WellConnector connector(grid_, host_, *locator_, assembly, options_.split > 1);
    for (std::size_t w = 0; w < wells_.size(); ++w) {
      const Well& well = wells_[w];
      WellSummary& summary = result_.summary.wells[w];
      MeshWell out;
      out.name = well.name;
      out.trajectory = well.trajectory;
      out.bore_radius = given_[w].radial.bore_radius;
      if (given_[w].skin < 0.0)
        summary.notes.push_back(fmt::format("its skin of {:g} is taken as an effective bore radius of {:.3g} m",
                                            given_[w].skin, well.radial.bore_radius));
      out.drainage_radius = summary.meshed ? summary.drainage_radius : 0.0;
      out.type = well.type;
      out.reference_depth = well.reference_depth;
      try {
        WellConnections connections = connector.connect(w, well);
        summary.index_connections = connections.by_index;
        out.connections = std::move(connections.all);
      } catch (const InvalidInput& e) {
        summary.notes.push_back(fmt::format("it has no connections: {}", e.what()));
      }
      summary.connections = static_cast<std::int64_t>(out.connections.size());
      if (out.connections.empty()) summary.notes.push_back("no cell with permeability is open to it");
      assembly.mesh.wells.push_back(std::move(out));
    }
  }

  const CornerPointGrid& grid_;
  const std::vector<Well>& given_;
  std::vector<Well> wells_;  ///< as given; stimulated ones with their effective bores
  // What the mesh is made in: the two above, or these.
  std::unique_ptr<CornerPointGrid> moved_grid_;
  std::vector<Well> moved_wells_;
  const CornerPointGrid* mesh_grid_ = nullptr;
  const std::vector<Well>* mesh_wells_ = nullptr;
  BuildOptions options_;
  BuildResult result_;
  Clock clock_;
  HostMesh host_;
  std::unique_ptr<CellLocator> locator_;
  RefinementPlan plan_;
  std::vector<std::shared_ptr<const NearWellGrid>> near_well_grids_;  ///< per cavity
  std::vector<TransitionMesh> cavities_;
};

/// On a copy of the grid without the small throws near the wells.
BuildResult build_healed(const CornerPointGrid& grid, const std::vector<Well>& wells, const BuildOptions& options) {
  if (options.heal_throw && !(*options.heal_throw > 0.0 && std::isfinite(*options.heal_throw)))
    throw InvalidInput(fmt::format("the largest throw to heal is {:g} m; give a length above 0", *options.heal_throw));
  check_wells(wells);
  std::vector<StepTime> times;
  Clock clock(times);
  const HealedFaults healed = heal_faults(grid, wells, options.heal_throw);
  clock.lap("fault healing");
  BuildResult result = Builder(healed.grid, wells, options).build();
  BuildSummary& summary = result.summary;
  summary.times.insert(summary.times.begin(), times.begin(), times.end());
  const std::vector<std::string> notes = healed.notes();
  summary.notes.insert(summary.notes.begin(), notes.begin(), notes.end());
  return result;
}

}  // namespace

BuildResult build_mesh(const Case& source, const std::vector<Well>& wells, const BuildOptions& options) {
  validate(source.grid);
  if (options.fault_policy == FaultPolicy::stop) return Builder(source.grid, wells, options).build();
  return build_healed(source.grid, wells, options);
}

}  // namespace wellknit
