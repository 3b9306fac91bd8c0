// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/well_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "algorithm/cluster_mesher.h"
#include "algorithm/near_well_frame.h"
#include "algorithm/well_path.h"

namespace wellknit {

namespace {

/// Radii that are tried in turn, as parts of the one given, until the share that is asked for is meshed; at last the
/// smallest one that is allowed.
constexpr std::array radius_schedule{1.0, 0.75, 0.55, 0.4, 0.3, 0.2, 0.14, 0.1, 0.07, 0.05, 0.035, 0.025};
constexpr int most_trials = 6;  ///< radii and modes of one well that are meshed
constexpr double steepest_layered = 80.0 * 3.14159265358979323846 / 180.0;  ///< from the layers' normal
constexpr double most_drift = 6.0;          ///< radii that a slanted well in a layered tube may wander
constexpr int slanted_trials = 4;           ///< radii at which that is tried: where it fails it mostly does so at all
constexpr Gaps narrow_gaps{0.1, 0.8, 0.6};  ///< where the usual ones leave too little

class Trials {
 public:
  Trials(const WellTask& task, double largest_radius, const std::vector<Neighbour>& neighbours)
      : task_(task), limit_(largest_radius), neighbours_(neighbours) {}

  WellTrial run(std::size_t w) {
    const auto modes = modes_of(w);
    std::optional<Trial> best;
    std::vector<Plan> left;
    int trials = 0;
    int slanted = 0;
    for (const double radius : radii_of(w)) {
      for (const bool layered : modes) {
        const bool is_slanted = layered && !modes.front();
        if (is_slanted && ++slanted > slanted_trials) continue;
        Plan plan = layered ? plan_layered(w, radius) : plan_swept(w, radius, {});
        if (!layered && plan.share < share_wanted)
          if (Plan narrow = plan_swept(w, radius, narrow_gaps); narrow.share >= share_wanted) plan = std::move(narrow);
        if (reason_.empty() && !plan.reason.empty()) reason_ = plan.reason;
        if (plan.share < share_wanted) {
          if (!plan.pieces.empty()) left.push_back(std::move(plan));
          continue;
        }
        if (trials >= most_trials) break;
        Trial trial = mesh_plan(w, plan);
        trials += trial.is_cheap || is_slanted ? 0 : 1;
        if (reason_.empty()) reason_ = trial.reason;
        if (!best || trial.share > best->share + 0.02) best = std::move(trial);
        if (best->share >= share_wanted) break;
      }
      if (best && best->share >= share_wanted) break;
    }
    if (!best || best->share < share_wanted) try_rest(w, left, best);
    WellTrial out;
    out.reason = std::move(reason_);
    if (best) {
      out.clusters = std::move(best->clusters);
      out.share = best->share;
    }
    return out;
  }

 private:
  /// What a radius gives.
  struct Trial {
    double radius = 0.0;
    std::vector<Cluster> clusters;
    double share = 0.0;
    std::string reason;
    bool is_cheap = true;  ///< no cavity was tried
  };

  /// The pieces that a radius allows in a mode, and the share of the well that they cover.
  struct Plan {
    std::vector<Piece> pieces;
    double share = 0.0;
    std::string reason;  ///< what keeps the rest
  };

  [[nodiscard]] double share_of(std::size_t w, const std::vector<Cluster>& clusters) const {
    std::vector<MeasuredDepthRange> ranges;
    for (const Cluster& c : clusters)
      for (const Tube& t : c.mesh->cavity.tubes)
        if (t.well == w) ranges.push_back(range_of(t));
    return task_.samples[w].share(ranges);
  }

  [[nodiscard]] Plan plan_layered(std::size_t w, double radius) const {
    Plan plan;
    Piece piece{w, {}, true, radius};
    plan.pieces.push_back(piece);
    plan.share = 1.0;
    return plan;
  }

  [[nodiscard]] Plan plan_swept(std::size_t w, double radius, const Gaps& gaps) const {
    Plan plan;
    const Well well = task_.with_radius(w, radius);
    // Over its whole path: a piece's own frame is made when it is meshed.
    const WellPath path(well.trajectory);
    const NearWellFrame frame = near_well_frame(task_, {{w, {path.first_depth(), path.last_depth()}, false, radius}});
    const auto samples_in = path_in_reference(frame.host(), well);
    const auto ranges =
        apart(clear_stretches(frame.host(), well, samples_in, *frame.obstacles, neighbours_, gaps), radius);
    for (const MeasuredDepthRange& r : ranges) plan.pieces.push_back({w, r, false, radius, !frame.obstacles->empty()});
    plan.share = task_.samples[w].share(ranges);
    if (plan.pieces.empty())
      plan.reason = fmt::format(
          "no stretch of one drainage radius ({:.3g} m) keeps clear of faults, other tubes, and "
          "the top, base and sides of the grid",
          radius);
    return plan;
  }

  /// Two tubes of one well need room between their ends; a gap that is next to nothing is closed instead.
  static std::vector<MeasuredDepthRange> apart(const std::vector<MeasuredDepthRange>& ranges, double radius) {
    std::vector<MeasuredDepthRange> out;
    for (MeasuredDepthRange r : ranges) {
      if (!out.empty() && r.from - out.back().to < 0.1 * radius) {
        out.back().to = r.to;
        continue;
      }
      if (!out.empty()) r.from = std::max(r.from, out.back().to + 2.0 * radius);
      if (r.to - r.from >= radius) out.push_back(r);
    }
    return out;
  }

  /// Meshes the pieces of a plan, each alone; those that fail are cut where they do, and at last leave their reason.
  Trial mesh_plan(std::size_t w, const Plan& plan) {
    Trial trial;
    trial.reason = plan.reason;
    std::vector<Piece> left(plan.pieces.rbegin(), plan.pieces.rend());
    while (!left.empty()) {
      const Piece piece = left.back();
      left.pop_back();
      trial.radius = piece.radius;
      Cluster cluster;
      cluster.pieces.push_back(piece);
      const Failure failure = mesh_once(task_, cluster);
      trial.is_cheap = trial.is_cheap && failure.is_early;
      if (cluster.mesh) {
        trial.clusters.push_back(std::move(cluster));
        continue;
      }
      if (trial.reason.empty()) trial.reason = failure.reason;
      const std::vector<Piece> parts = cut(piece, 0, failure);
      left.insert(left.end(), parts.rbegin(), parts.rend());
      if (parts.empty() && !failure.is_early && mesh_finer(cluster)) trial.clusters.push_back(std::move(cluster));
    }
    trial.share = share_of(w, trial.clusters);
    return trial;
  }

  /// A piece alone once more, in columns half as wide.
  bool mesh_finer(Cluster& cluster) {
    Piece& piece = cluster.pieces.front();
    if (task_.options.refinement_levels >= 0) return false;
    ++piece.extra_levels;
    mesh_once(task_, cluster);
    return cluster.mesh.has_value();
  }

  /// The modes to try, the likelier first.
  [[nodiscard]] std::vector<bool> modes_of(std::size_t w) const {
    if (task_.wells[w].radial.mode != MeshMode::automatic) return {task_.wells[w].radial.mode == MeshMode::layered};
    const NearWellFrame frame = near_well_frame(task_, {{w, {}, true, task_.wells[w].radial.drainage_radius}});
    const auto path = path_in_reference(frame.host(), task_.wells[w]);
    if (path.size() < 2) return {false};
    const Vec3 chord = path.back().reference - path.front().reference;
    const double angle = std::atan2(std::hypot(chord.x(), chord.y()), std::abs(chord.z()));
    const bool first = choose_mode(path, task_.wells[w].radial.drainage_radius) == MeshMode::layered;
    if (first) return {true, false};
    // A layered tube of a slanted well leans with the mapping; it must cross the layers, not run in one.
    const bool crosses = std::abs(chord.z()) >
                         0.5 * std::abs(frame.space->plane(2, frame.grid->dimensions()[2]) - frame.space->plane(2, 0));
    const bool drifts = std::hypot(chord.x(), chord.y()) > most_drift * task_.wells[w].radial.drainage_radius;
    return angle < steepest_layered && crosses && !drifts ? std::vector<bool>{false, true} : std::vector<bool>{false};
  }

  /// Falling.
  [[nodiscard]] std::vector<double> radii_of(std::size_t w) const {
    const double largest = std::min(task_.wells[w].radial.drainage_radius, limit_);
    const double smallest = std::min(largest, smallest_radius(task_.wells[w], task_.samples[w]));
    std::vector<double> out;
    for (const double part : radius_schedule)
      if (part * largest >= smallest * (1.0 - 1e-9)) out.push_back(part * largest);
    if (out.back() > 1.1 * smallest) out.push_back(smallest);
    return out;
  }

  /// Plans that cannot cover all that is asked for: of those that come near the best the three of the largest radii.
  void try_rest(std::size_t w, const std::vector<Plan>& left, std::optional<Trial>& best) {
    constexpr double near = 0.07;
    double most = best ? best->share : 0.0;
    for (const Plan& plan : left) most = std::max(most, plan.share);
    int trials = 0;
    for (const Plan& plan : left) {
      if (trials == 3) break;
      if (plan.share < most - near || (best && plan.share < best->share + 0.02)) continue;
      ++trials;
      Trial trial = mesh_plan(w, plan);
      if (reason_.empty()) reason_ = trial.reason;
      if (!best || trial.share > best->share + 0.02) best = std::move(trial);
    }
  }

  const WellTask& task_;
  double limit_;
  const std::vector<Neighbour>& neighbours_;
  std::string reason_;
};

}  // namespace

WellTrial try_well(const WellTask& task, std::size_t well, double largest_radius,
                   const std::vector<Neighbour>& neighbours) {
  return Trials(task, largest_radius, neighbours).run(well);
}

}  // namespace wellknit
