// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The steps are those of method.md §0; each one's source is named in its own file.
#include "algorithm/build_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <set>

#include "algorithm/assembly.h"
#include "algorithm/edit_connections.h"
#include "algorithm/flow_connections.h"
#include "algorithm/host_validity.h"
#include "algorithm/property_transfer.h"
#include "algorithm/source_pore_volume.h"
#include "algorithm/well_connections.h"
#include "algorithm/well_path.h"
#include "algorithm/well_tube.h"
#include "model/errors.h"

namespace wellknit {

namespace {

/// Wells that share a cavity, and what came of them.
struct Cluster {
  std::vector<std::size_t> wells;
  std::vector<std::int64_t> removed;  ///< cells, rising, of the first cavity tried
};

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

/// Everything that one run shares.
class Builder {
 public:
  Builder(const Case& source, const std::vector<Well>& wells, const BuildOptions& options)
      : grid_(source.grid), given_(wells), wells_(wells), options_(options), clock_(result_.summary.times) {
    for (Well& w : wells_) take_effective_radius(w);
  }

  BuildResult build() {
    check_wells();
    host_ = build_host_mesh(grid_);
    result_.summary.notes = host_.notes;
    locator_ = std::make_unique<CellLocator>(grid_);
    clock_.lap("host grid");
    start_wells();
    cluster_wells();
    mesh_clusters();
    clock_.lap("near-well mesh");
    Assembly assembly = assemble(grid_, host_, cavities_);
    clock_.lap("assembly");
    transfer_properties(grid_, host_, *locator_, cavities_, assembly);
    clock_.lap("properties");
    note_missing_properties();
    note_empty_cells(assembly.mesh);
    note_volumes(assembly);
    const HostMultipliers multipliers(grid_);
    connect_cells(grid_, host_, *locator_, multipliers, assembly);
    for (std::string& note : edit_connections(grid_, host_, multipliers, assembly))
      result_.summary.notes.push_back(std::move(note));
    add_wells(assembly);
    clock_.lap("connections");
    for (const TransitionMesh& c : cavities_) result_.summary.cavities.push_back(c.summary);
    result_.summary.validity = check_host_validity(grid_, host_);
    clock_.lap("validity");
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

  void check_wells() const {
    std::set<std::string> names;
    for (const Well& w : wells_) {
      if (!names.insert(w.name).second)
        throw InvalidInput(fmt::format(
            "well {} is given twice: give each trajectory its own name with --well FILE,name=NAME", w.name));
      try {
        (void)circle_radii(w.radial);
        (void)WellPath(w.trajectory);
      } catch (const InvalidInput& e) {
        throw InvalidInput(fmt::format("well {}: {}", w.name, e.what()));
      }
    }
  }

  /// The block of cells whose spacing makes E_ref: where the well runs, and some cells around it.
  [[nodiscard]] CellRange region_of(const std::vector<std::size_t>& wells) const {
    constexpr std::int64_t around = 3;
    CellRange region{grid_.dimensions, {0, 0, 0}};
    for (const std::size_t w : wells)
      for (const auto& c : cells_on_path_[w])
        for (std::size_t a = 0; a < 3; ++a) {
          region.low[a] = std::min(region.low[a], std::max<std::int64_t>(0, c[a] - around));
          region.high[a] = std::max(region.high[a], std::min(grid_.dimensions[a], c[a] + 1 + around));
        }
    return region;
  }

  void start_wells() {
    result_.summary.wells.resize(wells_.size());
    cells_on_path_.resize(wells_.size());
    depths_in_rock_.resize(wells_.size());
    modes_.resize(wells_.size(), MeshMode::automatic);
    is_steep_.resize(wells_.size(), 0);
    has_changed_mode_.resize(wells_.size(), 0);
    first_reason_.resize(wells_.size());
    for (std::size_t w = 0; w < wells_.size(); ++w) {
      WellSummary& s = result_.summary.wells[w];
      s.name = wells_[w].name;
      s.mode = "host cells";
      s.drainage_radius = wells_[w].radial.drainage_radius;
      const WellPath path(wells_[w].trajectory);
      constexpr int samples = 500;
      const double step = (path.last_depth() - path.first_depth()) / samples;
      HostCellId hint;
      for (int i = 0; i <= samples; ++i) {
        const double md = path.first_depth() + step * i;
        const auto location = locator_->locate(path.point(md), hint);
        if (!location) continue;
        hint = location->cell;
        cells_on_path_[w].push_back(grid_.ijk(hint));
        if (host_.exists[hint] != 0) depths_in_rock_[w].push_back(md);
      }
      s.length_in_rock = std::min(step * samples, step * static_cast<double>(depths_in_rock_[w].size()));
      if (cells_on_path_[w].empty())
        throw InvalidInput(fmt::format(
            "well {} does not meet the grid: its path runs from ({:.1f}, {:.1f}, {:.1f}) to ({:.1f}, {:.1f}, {:.1f}); "
            "check its coordinates, units and depth sign",
            wells_[w].name, wells_[w].trajectory.points.front().x(), wells_[w].trajectory.points.front().y(),
            wells_[w].trajectory.points.front().z(), wells_[w].trajectory.points.back().x(),
            wells_[w].trajectory.points.back().y(), wells_[w].trajectory.points.back().z()));
    }
  }

  void leave_out(std::size_t well, const std::string& reason) {
    WellSummary& s = result_.summary.wells[well];
    s.meshed = false;
    s.reason = reason;
  }

  /// The tube of a well in the space of its cluster. The mode is chosen once, alone, and kept.
  TubeOrReason tube_of(const HostFrame& frame, std::size_t well) {
    const auto path = path_in_reference(frame, wells_[well]);
    if (path.size() < 2)
      return NoTube{"its path inside the grid is shorter than one part in two thousand of its length"};
    TubeOrReason tube = NoTube{};
    const Vec3 chord = path.back().reference - path.front().reference;
    is_steep_[well] = std::abs(chord.z()) > std::hypot(chord.x(), chord.y()) ? 1 : 0;
    if (modes_[well] == MeshMode::automatic)
      modes_[well] = wells_[well].radial.mode == MeshMode::automatic
                         ? choose_mode(path, wells_[well].radial.drainage_radius)
                         : wells_[well].radial.mode;
    tube = modes_[well] == MeshMode::layered ? build_layered_tube(frame, wells_[well], path)
                                             : build_swept_tube(frame, wells_[well], path);
    if (auto* t = std::get_if<Tube>(&tube)) t->well = well;
    return tube;
  }

  struct Attempt {
    std::unique_ptr<ReferenceSpace> space;
    std::vector<Tube> tubes;
  };

  /// Tubes of a cluster's wells; wells without one leave the cluster.
  Attempt prepare(Cluster& cluster) {
    Attempt attempt;
    attempt.space = std::make_unique<ReferenceSpace>(grid_, host_, region_of(cluster.wells));
    const HostFrame frame{grid_, host_, *locator_, *attempt.space};
    std::vector<std::size_t> kept;
    for (const std::size_t w : cluster.wells) {
      auto tube = tube_of(frame, w);
      if (const auto* none = std::get_if<NoTube>(&tube)) {
        Cluster alone{{w}, {}};
        drop(alone, {none->reason, {w}});
        if (!alone.wells.empty()) tube = tube_of(frame, w);
        if (const auto* still_none = std::get_if<NoTube>(&tube)) {
          if (!alone.wells.empty()) drop(alone, {still_none->reason, {w}});
          continue;
        }
      }
      kept.push_back(w);
      attempt.tubes.push_back(std::move(std::get<Tube>(tube)));
    }
    cluster.wells = kept;
    return attempt;
  }

  /// Takes wells out of a cluster; one whose mode was chosen automatically first gets a trial in the other mode.
  void drop(Cluster& cluster, const NoCavity& none) {
    for (const std::size_t w : none.wells) {
      const bool may_change = wells_[w].radial.mode == MeshMode::automatic && has_changed_mode_[w] == 0;
      if (may_change && (modes_[w] == MeshMode::layered || is_steep_[w] != 0)) {
        modes_[w] = modes_[w] == MeshMode::layered ? MeshMode::swept : MeshMode::layered;
        has_changed_mode_[w] = 1;
        first_reason_[w] = none.reason;
        continue;
      }
      // The reason of the mode that fits the well better is the one that helps.
      leave_out(w, has_changed_mode_[w] != 0 ? first_reason_[w] : none.reason);
      std::erase(cluster.wells, w);
    }
  }

  /// Finds the cells that a cluster's cavity takes; wells that cannot have one leave it.
  void find_cells(Cluster& cluster) {
    cluster.removed.clear();
    while (!cluster.wells.empty()) {
      const Attempt attempt = prepare(cluster);
      if (cluster.wells.empty()) return;
      const auto cavity = build_cavity({grid_, host_, *locator_, *attempt.space}, attempt.tubes, {});
      if (const auto* none = std::get_if<NoCavity>(&cavity)) {
        drop(cluster, *none);
        continue;
      }
      for (const auto& c : std::get<Cavity>(cavity).removed)
        cluster.removed.push_back(grid_.cell_id(c[0], c[1], c[2]).value());
      return;
    }
  }

  /// True when two sets of cells overlap or have a face in common.
  [[nodiscard]] bool do_touch(const Cluster& a, const Cluster& b) const {
    const auto has = [](const std::vector<std::int64_t>& list, std::int64_t c) {
      return std::binary_search(list.begin(), list.end(), c);
    };
    for (const std::int64_t c : a.removed) {
      if (has(b.removed, c)) return true;
      const auto at = grid_.ijk(HostCellId(c));
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (const std::int64_t step : {-1, 1}) {
          auto n = at;
          n[axis] += step;
          if (n[axis] >= 0 && n[axis] < grid_.dimensions[axis] &&
              has(b.removed, grid_.cell_id(n[0], n[1], n[2]).value()))
            return true;
        }
    }
    return false;
  }

  /// Wells whose cavities touch share one: their vertices all count for each other's faces.
  void cluster_wells() {
    for (std::size_t w = 0; w < wells_.size(); ++w) {
      Cluster c{{w}, {}};
      find_cells(c);
      if (!c.wells.empty()) clusters_.push_back(std::move(c));
    }
    for (bool merged = true; merged;) merged = merge_touching();
  }

  /// One pass of merging; true when something was merged.
  bool merge_touching() {
    std::vector<Cluster> next;
    std::vector<std::uint8_t> is_changed;
    bool merged = false;
    for (Cluster& c : clusters_) {
      std::optional<std::size_t> into;
      for (std::size_t n = 0; n < next.size(); ++n) {
        if (!do_touch(c, next[n])) continue;
        if (!into) {
          into = n;
          join(next[n], c);
          is_changed[n] = 1;
        } else {
          join(next[*into], next[n]);
          next[n] = {};
        }
        merged = true;
      }
      if (!into) {
        next.push_back(std::move(c));
        is_changed.push_back(0);
      }
    }
    clusters_.clear();
    for (std::size_t n = 0; n < next.size(); ++n) {
      if (next[n].wells.empty()) continue;
      std::sort(next[n].wells.begin(), next[n].wells.end());
      if (is_changed[n] != 0) find_cells(next[n]);
      if (!next[n].wells.empty()) clusters_.push_back(std::move(next[n]));
    }
    return merged;
  }

  static void join(Cluster& into, Cluster& from) {
    into.wells.insert(into.wells.end(), from.wells.begin(), from.wells.end());
    std::vector<std::int64_t> all;
    std::set_union(into.removed.begin(), into.removed.end(), from.removed.begin(), from.removed.end(),
                   std::back_inserter(all));
    into.removed = std::move(all);
  }

  /// Meshes the clusters. One whose cavity had to grow into another's is merged with it and both are done again.
  void mesh_clusters() {
    std::vector<std::optional<TransitionMesh>> meshes(clusters_.size());
    for (std::size_t c = 0; c < clusters_.size(); ++c) meshes[c] = mesh_cluster(clusters_[c]);
    while (const auto pair = touching_meshes(meshes)) {
      const auto [a, b] = *pair;
      join(clusters_[a], clusters_[b]);
      clusters_[b] = {};
      meshes[b].reset();
      meshes[a] = mesh_cluster(clusters_[a]);
    }
    for (std::size_t c = 0; c < clusters_.size(); ++c) {
      if (!meshes[c]) continue;
      for (const Tube& t : meshes[c]->cavity.tubes) note_meshed(t, cavities_.size(), meshes[c]->summary);
      cavities_.push_back(std::move(*meshes[c]));
    }
  }

  /// The first two meshed clusters whose cavities touch. Each merge leaves one cluster less, so that looking again
  /// ends.
  [[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> touching_meshes(
      const std::vector<std::optional<TransitionMesh>>& meshes) const {
    for (std::size_t a = 0; a < meshes.size(); ++a)
      for (std::size_t b = a + 1; b < meshes.size(); ++b)
        if (meshes[a] && meshes[b] && do_touch(clusters_[a], clusters_[b])) return std::pair(a, b);
    return std::nullopt;
  }

  std::optional<TransitionMesh> mesh_cluster(Cluster& cluster) {
    while (!cluster.wells.empty()) {
      const Attempt attempt = prepare(cluster);
      if (cluster.wells.empty()) break;
      auto mesh = build_transition_mesh({grid_, host_, *locator_, *attempt.space}, attempt.tubes, options_.mapping);
      if (const auto* none = std::get_if<NoCavity>(&mesh)) {
        drop(cluster, *none);
        continue;
      }
      auto& done = std::get<TransitionMesh>(mesh);
      cluster.removed.clear();
      for (const auto& c : done.cavity.removed) cluster.removed.push_back(grid_.cell_id(c[0], c[1], c[2]).value());
      return std::move(done);
    }
    return std::nullopt;
  }

  void note_meshed(const Tube& tube, std::size_t cavity, const CavitySummary& cavity_summary) {
    WellSummary& s = result_.summary.wells[tube.well];
    s.meshed = true;
    s.reason.clear();
    s.mode = tube.layered ? "layered" : "swept";
    s.cavity = static_cast<std::int32_t>(cavity);
    s.segments = tube.real.segments;
    s.radial_cells = static_cast<std::int64_t>(tube.real.segments) * tube.real.sectors * tube.real.rings;
    const auto& md = tube.real.measured_depth;
    const auto [first, last] = std::minmax_element(md.begin(), md.end());
    const auto& depths = depths_in_rock_[tube.well];
    const auto meshed = std::count_if(depths.begin(), depths.end(),
                                      [&, low = *first, high = *last](double d) { return d >= low && d <= high; });
    s.length_meshed =
        s.length_in_rock * static_cast<double>(meshed) / static_cast<double>(std::max<std::size_t>(1, depths.size()));
    s.notes = tube.notes;
    if (const auto count = cavity_summary.outer_nodes_left_out; count > 0)
      s.notes.push_back(
          fmt::format("{} nodes of the grid's top, base or sides within its cavity are not followed: they would "
                      "contradict the tube there",
                      count));
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
      const std::int32_t cavity = cells.well[cell].is_valid() ? result_.summary.wells[cells.well[cell].index()].cavity
                                                              : cavity_of(assembly, cell);
      made[static_cast<std::size_t>(cavity)] += cells.volume[cell];
    }
    for (std::size_t c = 0; c < cavities_.size(); ++c) {
      double removed = 0.0;
      for (const auto& r : cavities_[c].cavity.removed) removed += host_.volume[grid_.cell_id(r[0], r[1], r[2])];
      // A thousandth: the chords of curved horizons and the bore stay below it.
      if (const double change = made[c] / removed - 1.0; std::abs(change) > 1e-3)
        result_.summary.notes.push_back(
            fmt::format("the bulk volume of cavity {} changes by {:+.2f} %: the top, base or sides of the grid are "
                        "curved there and "
                        "its cells follow them in chords; its pore volume is kept",
                        c + 1, 100.0 * change));
    }
  }

  static std::int32_t cavity_of(const Assembly& assembly, CellId transition) {
    const auto& starts = assembly.first_transition_cell;
    return static_cast<std::int32_t>(
               std::distance(starts.begin(), std::upper_bound(starts.begin(), starts.end(), transition.value()))) -
           1;
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

  void add_wells(Assembly& assembly) {
    WellConnector connector(grid_, host_, *locator_, assembly);
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
      out.drainage_radius = summary.meshed ? well.radial.drainage_radius : 0.0;
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
  BuildOptions options_;
  BuildResult result_;
  Clock clock_;
  HostMesh host_;
  std::unique_ptr<CellLocator> locator_;
  std::vector<std::vector<std::array<std::int64_t, 3>>> cells_on_path_;  ///< per well, along its path
  std::vector<std::vector<double>> depths_in_rock_;                      ///< measured, of samples along the path, m
  std::vector<MeshMode> modes_;                                          ///< per well; automatic: not chosen yet
  std::vector<std::uint8_t> is_steep_;          ///< per well: within 45 degrees of the layers' normal in E_ref
  std::vector<std::uint8_t> has_changed_mode_;  ///< per well
  std::vector<std::string> first_reason_;       ///< per well: why the mode chosen first did not do
  std::vector<Cluster> clusters_;
  std::vector<TransitionMesh> cavities_;
};

}  // namespace

BuildResult build_mesh(const Case& source, const std::vector<Well>& wells, const BuildOptions& options) {
  validate(source.grid);
  return Builder(source, wells, options).build();
}

}  // namespace wellknit
