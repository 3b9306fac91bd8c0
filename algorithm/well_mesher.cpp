// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A well is cut into stretches that are clear of faults, of the grid's outside and of other tubes. Each stretch is
// meshed alone first; where less of the well than asked for gets a mesh, smaller radii are tried in turn (well_trials).
// Stretches whose cavities meet then share one (cavity_clusters); wells that lose too much by that are tried once more
// with smaller radii. Every step is bounded, and what fails leaves its
// reason.
#include "algorithm/well_mesher.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "algorithm/cavity_clusters.h"
#include "algorithm/well_path.h"
#include "algorithm/well_piece.h"
#include "algorithm/well_trials.h"

namespace wellknit {

namespace {

class WellMesher {
 public:
  WellMesher(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator,
             const std::vector<Well>& wells, const BuildOptions& options,
             const std::map<std::size_t, std::string>& left_out)
      : task_{grid, host, locator, wells, options, {}}, left_out_(left_out) {}

  MeshedWells run() {
    for (const Well& well : task_.wells)
      task_.samples.push_back(sample_well(task_.grid, task_.host, task_.locator, well));
    limits_ = radius_limits(task_.wells, task_.samples);
    trials_.resize(task_.wells.size());
    for (std::size_t w = 0; w < task_.wells.size(); ++w) start(w);
    Outcome outcome = resolve();
    if (outcome.cells_removed() <= most_cells_again && try_losers(outcome))
      if (Outcome next = resolve(); next.is_better_than(outcome)) outcome = std::move(next);
    MeshedWells out;
    out.plan = std::move(outcome.plan);
    reasons_ = std::move(outcome.reasons);
    for (Cluster& c : outcome.clusters) out.cavities.push_back({c.grid, std::move(*c.mesh)});
    for (const MeshedCavity& c : out.cavities) note_tubes(c, static_cast<std::int32_t>(&c - out.cavities.data()));
    for (std::size_t w = 0; w < task_.wells.size(); ++w) finish(w);
    out.wells = std::move(summaries_);
    return out;
  }

 private:
  /// In all cavities: larger models are not worth a second round, which costs as much as the first.
  static constexpr std::size_t most_cells_again = 60000;

  /// What comes of the wells' trials when all have made room for each other.
  struct Outcome {
    std::vector<Cluster> clusters;
    std::vector<std::string> reasons;
    RefinementPlan plan;
    std::vector<double> shares;  ///< per well

    [[nodiscard]] std::size_t cells_removed() const {
      return std::accumulate(clusters.begin(), clusters.end(), std::size_t{0},
                             [](std::size_t sum, const Cluster& c) { return sum + c.mesh->cavity.removed.size(); });
    }

    [[nodiscard]] bool is_better_than(const Outcome& other) const {
      const auto worth = [](const Outcome& o) {
        const auto good = std::count_if(o.shares.begin(), o.shares.end(), [](double s) { return s >= share_wanted; });
        return std::pair(good, std::accumulate(o.shares.begin(), o.shares.end(), 0.0));
      };
      return worth(*this) > worth(other);
    }
  };

  void start(std::size_t w) {
    WellSummary s;
    s.name = task_.wells[w].name;
    s.mode = "host cells";
    s.drainage_radius = task_.wells[w].radial.drainage_radius;
    s.radius_wanted = s.drainage_radius;
    s.length_in_rock = task_.samples[w].length_in_rock;
    summaries_.push_back(std::move(s));
    if (const auto out = left_out_.find(w); out != left_out_.end())
      trials_[w].reason = out->second;
    else
      trials_[w] = try_well(task_, w, limits_[w].most, tubes_of_others(w));
  }

  [[nodiscard]] Outcome resolve() const {
    Outcome out;
    for (const WellTrial& t : trials_) {
      out.reasons.push_back(t.reason);
      out.clusters.insert(out.clusters.end(), t.clusters.begin(), t.clusters.end());
    }
    out.plan = resolve_conflicts(task_, out.clusters, out.reasons);
    std::vector<std::vector<MeasuredDepthRange>> ranges(task_.wells.size());
    for (const Cluster& c : out.clusters)
      for (const Tube& t : c.mesh->cavity.tubes) ranges[t.well].push_back(range_of(t));
    for (std::size_t w = 0; w < ranges.size(); ++w) out.shares.push_back(task_.samples[w].share(ranges[w]));
    return out;
  }

  /// Wells that had their share alone and lost it to others get a smaller radius. False when there is none.
  bool try_losers(const Outcome& outcome) {
    constexpr double smaller = 0.6;
    bool changed = false;
    for (std::size_t w = 0; w < trials_.size(); ++w) {
      if (trials_[w].share < share_wanted || outcome.shares[w] >= share_wanted) continue;
      double radius = limits_[w].most;
      for (const Cluster& c : trials_[w].clusters)
        for (const Piece& p : c.pieces) radius = std::min(radius, p.radius);
      const double least = smallest_radius(task_.wells[w], task_.samples[w]);
      if (least > 0.9 * radius) continue;
      WellTrial trial = try_well(task_, w, std::max(least, smaller * radius), tubes_of_others(w));
      if (trial.share < share_wanted) continue;
      if (!trials_[w].reason.empty()) trial.reason = trials_[w].reason;
      trials_[w] = std::move(trial);
      changed = true;
    }
    return changed;
  }

  [[nodiscard]] std::vector<Neighbour> tubes_of_others(std::size_t w) const {
    std::vector<Neighbour> out;
    for (const WellTrial& trial : trials_)
      if (&trial != &trials_[w])
        for (const Cluster& c : trial.clusters)
          for (const Tube& t : c.mesh->cavity.tubes) out.push_back({&t.real, radius_of(t)});
    return out;
  }

  void note_tubes(const MeshedCavity& cavity, std::int32_t number) {
    for (const Tube& t : cavity.mesh.cavity.tubes) {
      WellSummary& s = summaries_[t.well];
      s.meshed = true;
      const std::string mode = t.layered ? "layered" : "swept";
      s.mode = mode;
      if (s.cavity < 0) s.cavity = number;
      s.segments += t.real.segments;
      s.radial_cells += static_cast<std::int64_t>(t.real.segments) * t.real.sectors * t.real.rings;
      const double radius = radius_of(t);
      s.drainage_radius = s.tubes.empty() ? radius : std::min(s.drainage_radius, radius);
      s.tubes.push_back({range_of(t), mode, radius, number});
      for (const std::string& note : t.notes)
        if (std::find(s.notes.begin(), s.notes.end(), note) == s.notes.end()) s.notes.push_back(note);
      if (const auto count = cavity.mesh.summary.outer_nodes_left_out; count > 0)
        s.notes.push_back(
            fmt::format("{} nodes of the grid's top, base or sides within its cavity are not followed: they would "
                        "contradict the tube there",
                        count));
    }
  }

  void finish(std::size_t w) {
    WellSummary& s = summaries_[w];
    s.reason = reasons_[w];
    std::sort(s.tubes.begin(), s.tubes.end(),
              [](const TubeSummary& a, const TubeSummary& b) { return a.range.from < b.range.from; });
    std::vector<MeasuredDepthRange> ranges;
    for (const TubeSummary& t : s.tubes) ranges.push_back(t.range);
    const double share = task_.samples[w].share(ranges);
    s.length_meshed = s.length_in_rock * share;
    const WellPath path(task_.wells[w].trajectory);
    for (TubeSummary& t : s.tubes) t.range = {path.original(t.range.from), path.original(t.range.to)};
    if (!s.meshed) {
      if (s.reason.empty()) s.reason = "no tube of any radius was found";
      return;
    }
    if (const double wanted = task_.wells[w].radial.drainage_radius; s.drainage_radius < 0.999 * wanted) {
      const std::string& why = limits_[w].reason.empty() ? s.reason : limits_[w].reason;
      s.notes.push_back(fmt::format("its drainage radius is {:.3g} m instead of {:.3g} m{}{}", s.drainage_radius,
                                    wanted, why.empty() ? "" : ", since with that ", why));
    }
    if (share < 0.995)
      s.notes.push_back(
          fmt::format("{:.0f} % of its length in rock ({:.0f} of {:.0f} m) lies in {}; the rest is "
                      "connected by index{}{}",
                      100.0 * share, s.length_meshed, s.length_in_rock,
                      s.tubes.size() == 1 ? "one tube" : fmt::format("{} tubes", s.tubes.size()),
                      s.reason.empty() ? "" : ": ", s.reason));
    s.reason.clear();
  }

  WellTask task_;
  std::vector<RadiusLimit> limits_;   ///< per well
  std::vector<std::string> reasons_;  ///< per well: the first
  const std::map<std::size_t, std::string>& left_out_;
  std::vector<WellTrial> trials_;  ///< per well, alone
  std::vector<WellSummary> summaries_;
};

}  // namespace

MeshedWells mesh_wells(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator,
                       const std::vector<Well>& wells, const BuildOptions& options,
                       const std::map<std::size_t, std::string>& left_out) {
  return WellMesher(grid, host, locator, wells, options, left_out).run();
}

}  // namespace wellknit
