// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/cavity_clusters.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <stdexcept>
#include <unordered_set>

#include "algorithm/cluster_mesher.h"
#include "algorithm/near_well_frame.h"

namespace wellknit {

namespace {

class CavityClusters {
 public:
  CavityClusters(const WellTask& task, std::vector<Cluster>& clusters, std::vector<std::string>& reasons,
                 int most_rounds)
      : task_(task), clusters_(clusters), reasons_(reasons), most_rounds_(most_rounds) {}

  /// Cavities that stand in the same columns get the same cells; those that touch become one. Bounded: what is still
  /// in another's way then gives way.
  RefinementPlan run() {
    for (int round = 0;; ++round) {
      if (round >= most_rounds_ && !clusters_.empty()) {
        for (const Piece& p : clusters_.back().pieces)
          if (reasons_[p.well].empty()) reasons_[p.well] = "its cavity stays in another one's way";
        clusters_.pop_back();
        round = 0;
      }
      if (unite(groups([&](const Cluster& a, const Cluster& b) { return do_conflict(a, b); }))) continue;
      if (plan_cells()) return std::move(plan_);
    }
  }

 private:
  static constexpr double whole = 0.97;  ///< of the length before: what is lost beyond that is worth another trial

  static bool have_same_cells(const Cluster& a, const Cluster& b) {
    return a.grid->parts() == b.grid->parts() && a.grid->layers() == b.grid->layers();
  }

  static bool do_touch(const Cluster& a, const Cluster& b) {
    const NearWellGrid& g = *a.grid;
    std::unordered_set<std::int64_t> of_b;
    for (const NearWellCell& c : b.mesh->cavity.removed) of_b.insert(g.index(c));
    for (const NearWellCell& c : a.mesh->cavity.removed) {
      if (of_b.contains(g.index(c))) return true;
      for (int side = 0; side < 6; ++side) {
        NearWellCell other = c;
        other[static_cast<std::size_t>(side / 2)] += side % 2 == 0 ? -1 : 1;
        if (g.is_inside(other) && of_b.contains(g.index(other)) && g.is_glued(c, side)) return true;
      }
    }
    return false;
  }

  /// Within three of the larger columns of each other: each has one around it, and one is left to grade between.
  static bool are_columns_near(const Cluster& a, const Cluster& b) {
    LatticePoint fewest{};
    for (std::size_t n = 0; n < 2; ++n) fewest[n] = std::min(a.grid->parts()[n], b.grid->parts()[n]);
    const auto columns = [&](const Cluster& c) {
      std::set<LatticePoint> out;
      for (const NearWellCell& r : c.mesh->cavity.removed)
        out.insert({r[0] * fewest[0] / c.grid->parts()[0], r[1] * fewest[1] / c.grid->parts()[1]});
      return out;
    };
    const auto of_b = columns(b);
    for (const auto& [i, j] : columns(a))
      for (std::int64_t dj = -3; dj <= 3; ++dj)
        for (std::int64_t di = -3; di <= 3; ++di)
          if (of_b.contains({i + di, j + dj})) return true;
    return false;
  }

  /// They overlap, touch across matching cells, or are too near to each other for their different columns.
  [[nodiscard]] bool do_conflict(const Cluster& a, const Cluster& b) const {
    const bool share_columns =
        std::any_of(a.columns.begin(), a.columns.end(), [&](const auto& column) { return b.columns.contains(column); });
    if (!share_columns) return false;
    return have_same_cells(a, b) ? do_touch(a, b) : are_columns_near(a, b);
  }

  /// Connected groups of clusters, each of two or more, rising.
  template <class Conflict>
  [[nodiscard]] std::vector<std::vector<std::size_t>> groups(const Conflict& conflict) const {
    std::vector<std::size_t> group(clusters_.size());
    for (std::size_t c = 0; c < group.size(); ++c) group[c] = c;
    for (std::size_t a = 0; a < clusters_.size(); ++a)
      for (std::size_t b = a + 1; b < clusters_.size(); ++b)
        if (group[a] != group[b] && conflict(clusters_[a], clusters_[b])) {
          const auto [low, high] = std::minmax(group[a], group[b]);
          std::replace(group.begin(), group.end(), high, low);
        }
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t c = 0; c < group.size(); ++c) members[group[c]].push_back(c);
    std::vector<std::vector<std::size_t>> out;
    for (auto& [first, list] : members)
      if (list.size() > 1) out.push_back(std::move(list));
    return out;
  }

  /// Gives the clusters of each group the same cells where they differ, else makes those that touch one. False when
  /// there was nothing to do.
  bool unite(const std::vector<std::vector<std::size_t>>& all) {
    std::set<std::size_t> gone;
    std::set<std::size_t> done;
    for (const auto& members : all) {
      const Cluster& first = clusters_[members.front()];
      const bool is_same = std::all_of(members.begin(), members.end(),
                                       [&](std::size_t c) { return have_same_cells(first, clusters_[c]); });
      const std::vector<std::size_t> changed = is_same ? members : company_of(members);
      // What another group has changed already is looked at again in the next round.
      if (std::any_of(changed.begin(), changed.end(), [&](std::size_t c) { return done.contains(c); })) continue;
      done.insert(changed.begin(), changed.end());
      if (is_same)
        merge(members, gone);
      else
        share_cells(changed, gone);
    }
    for (auto c = gone.rbegin(); c != gone.rend(); ++c)
      clusters_.erase(clusters_.begin() + static_cast<std::ptrdiff_t>(*c));
    return !all.empty();
  }

  /// The members and all clusters that use the same cells as one of them: these keep doing so.
  [[nodiscard]] std::vector<std::size_t> company_of(const std::vector<std::size_t>& members) const {
    std::set<int> companies;
    for (const std::size_t c : members) companies.insert(clusters_[c].company);
    companies.erase(-1);
    std::vector<std::size_t> out;
    for (std::size_t c = 0; c < clusters_.size(); ++c)
      if (companies.contains(clusters_[c].company) || std::find(members.begin(), members.end(), c) != members.end())
        out.push_back(c);
    return out;
  }

  /// Length of all tubes of clusters, as a measure of what a choice of cells is worth, m.
  static double length_of(const std::vector<Cluster>& clusters) {
    double length = 0.0;
    for (const Cluster& c : clusters)
      if (c.mesh)
        for (const Tube& t : c.mesh->cavity.tubes) length += range_of(t).to - range_of(t).from;
    return length;
  }

  /// A way to resolve a conflict. Clusters without pieces are given up.
  struct Choice {
    std::vector<Cluster> clusters;
    std::vector<std::string> reasons;  ///< as CavityClusters::reasons_
    double length = -1.0;              ///< of all tubes, m
  };

  [[nodiscard]] Choice in_cells(std::vector<Cluster> clusters, const LatticePoint& parts,
                                const ColumnLayers& layers) const {
    Choice choice;
    choice.reasons = reasons_;
    for (Cluster& cluster : clusters) {
      const bool has_them = cluster.grid->parts() == parts && cluster.grid->layers() == layers;
      cluster.cells = {parts, layers};
      if (!has_them) mesh_together(task_, cluster, choice.reasons);
    }
    choice.length = length_of(clusters);
    choice.clusters = std::move(clusters);
    return choice;
  }

  /// Cells that a cluster takes about in other columns.
  static double cells_in(const Cluster& c, const LatticePoint& parts) {
    const LatticePoint& own = c.grid->parts();
    return static_cast<double>(c.mesh->cavity.removed.size()) * static_cast<double>(parts[0] * parts[1]) /
           static_cast<double>(own[0] * own[1]);
  }

  /// From a quarter of the widest cells to the finest that one asks for, then coarser ones.
  static std::vector<LatticePoint> parts_to_try(const LatticePoint& fewest, const LatticePoint& most) {
    constexpr std::int64_t first_ratio = 4;
    const LatticePoint first{std::min(most[0], first_ratio * fewest[0]), std::min(most[1], first_ratio * fewest[1])};
    std::vector<LatticePoint> out{first};
    for (LatticePoint p = first; p != most; out.push_back(p))
      p = {std::min(2 * p[0], most[0]), std::min(2 * p[1], most[1])};
    for (LatticePoint p = first; p != fewest; out.push_back(p))
      p = {std::max(p[0] / 2, fewest[0]), std::max(p[1] / 2, fewest[1])};
    return out;
  }

  /// Cells that all can use: the first in which no tube is lost, else those that keep the greatest length.
  void share_cells(const std::vector<std::size_t>& members, std::set<std::size_t>& gone) {
    constexpr double most_cells = 40000.0;
    LatticePoint most{1, 1};
    LatticePoint fewest = clusters_[members.front()].grid->parts();
    std::vector<Piece> pieces;
    std::vector<Cluster> before;
    for (const std::size_t c : members) {
      for (std::size_t a = 0; a < 2; ++a) {
        most[a] = std::max(most[a], clusters_[c].grid->parts()[a]);
        fewest[a] = std::min(fewest[a], clusters_[c].grid->parts()[a]);
      }
      pieces.insert(pieces.end(), clusters_[c].pieces.begin(), clusters_[c].pieces.end());
      before.push_back(std::move(clusters_[c]));
    }
    const auto is_too_many = [&](const LatticePoint& parts) {
      return std::any_of(before.begin(), before.end(), [&](const Cluster& c) {
        return cells_in(c, parts) > std::max(most_cells, cells_in(c, c.grid->parts()));
      });
    };
    const ColumnLayers layers = layers_of(task_, pieces);
    Choice best;
    for (const LatticePoint& parts : parts_to_try(fewest, most)) {
      if (best.length >= whole * length_of(before)) break;
      if (parts != fewest && is_too_many(parts)) continue;
      if (Choice choice = in_cells(before, parts, layers); choice.length > best.length) best = std::move(choice);
    }
    for (Cluster& c : best.clusters) c.company = companies_;
    ++companies_;
    take(members, std::move(best), gone);
  }

  /// One cluster of several. Where tubes are lost so: each alone with smaller radii, if they are then clear of each
  /// other and more is kept.
  void merge(const std::vector<std::size_t>& members, std::set<std::size_t>& gone) {
    constexpr std::array scales{0.75, 0.5, 0.35};
    std::vector<Cluster> before;
    for (const std::size_t c : members) before.push_back(std::move(clusters_[c]));
    Choice best = united(before);
    for (const double scale : scales) {
      if (best.length >= whole * length_of(before)) break;
      if (Choice choice = apart(before, scale); choice.length > best.length) best = std::move(choice);
    }
    take(members, std::move(best), gone);
  }

  [[nodiscard]] Choice united(const std::vector<Cluster>& members) const {
    Choice choice;
    choice.reasons = reasons_;
    choice.clusters.resize(members.size());
    Cluster& all = choice.clusters.front();
    all.cells = {members.front().grid->parts(), members.front().grid->layers()};
    for (const Cluster& c : members) all.company = std::max(all.company, c.company);
    for (const Cluster& c : members) all.pieces.insert(all.pieces.end(), c.pieces.begin(), c.pieces.end());
    mesh_together(task_, all, choice.reasons);
    choice.length = length_of(choice.clusters);
    return choice;
  }

  /// Of length -1 where some still touch.
  [[nodiscard]] Choice apart(std::vector<Cluster> members, double scale) const {
    Choice choice;
    choice.reasons = reasons_;
    for (Cluster& c : members) {
      c.cells = {c.grid->parts(), c.grid->layers()};
      c.tight = true;
      for (Piece& p : c.pieces)
        p.radius = std::max(scale * p.radius, smallest_radius(task_.wells[p.well], task_.samples[p.well]));
      mesh_together(task_, c, choice.reasons);
    }
    choice.clusters = std::move(members);
    for (std::size_t m = 0; m < choice.clusters.size(); ++m)
      for (std::size_t n = m + 1; n < choice.clusters.size(); ++n)
        if (choice.clusters[m].mesh && choice.clusters[n].mesh && do_touch(choice.clusters[m], choice.clusters[n]))
          return choice;
    choice.length = length_of(choice.clusters);
    return choice;
  }

  void take(const std::vector<std::size_t>& members, Choice choice, std::set<std::size_t>& gone) {
    reasons_ = std::move(choice.reasons);
    for (std::size_t n = 0; n < members.size(); ++n) {
      clusters_[members[n]] = std::move(choice.clusters[n]);
      if (clusters_[members[n]].pieces.empty()) gone.insert(members[n]);
    }
  }

  /// Which columns the host must be split into. False when cavities asked for different cells too near to each other:
  /// these are then one cluster.
  bool plan_cells() {
    LatticePoint unit{1, 1};
    for (const Cluster& c : clusters_)
      for (std::size_t a = 0; a < 2; ++a) unit[a] = std::max(unit[a], c.grid->parts()[a]);
    std::vector<RefinementDemand> demands;
    for (const Cluster& c : clusters_) demands.push_back(demand_of(c, unit));
    plan_ = plan_refinement(task_.grid, task_.host, unit, demands);
    std::map<LatticePoint, const RefinedColumn*> columns;
    std::set<std::array<std::int64_t, 2>> split;
    for (const RefinedColumn& c : plan_.columns) {
      columns.emplace(c.low, &c);
      split.insert(c.source);
    }
    for (std::size_t n = 0; n < clusters_.size(); ++n)
      for (const LatticePoint& low : demands[n].columns) {
        const std::array<std::int64_t, 2> source{low[0] / unit[0], low[1] / unit[1]};
        const auto at = columns.find(low);
        const bool is_there =
            at != columns.end()
                ? at->second->high == LatticePoint{low[0] + demands[n].size[0], low[1] + demands[n].size[1]} &&
                      plan_.layers[static_cast<std::size_t>(at->second->layers)] == demands[n].layers
                : !split.contains(source) && clusters_[n].grid->is_source();
        if (is_there) continue;
        const std::size_t other = nearest_cluster(n, source);
        if (other == n) throw std::logic_error("a refinement does not hold the columns that it was asked for");
        unite({{std::min(n, other), std::max(n, other)}});
        return false;
      }
    std::vector<NeededLayers> needed;
    for (const Cluster& c : clusters_) add_needed(c, unit, needed);
    trim_layers(plan_, needed);
    return true;
  }

  [[nodiscard]] std::size_t nearest_cluster(std::size_t n, const std::array<std::int64_t, 2>& column) const {
    std::size_t best = n;
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (std::size_t m = 0; m < clusters_.size(); ++m) {
      if (m == n || have_same_cells(clusters_[m], clusters_[n])) continue;
      for (const auto& c : clusters_[m].columns)
        if (const std::int64_t d = std::abs(c[0] - column[0]) + std::abs(c[1] - column[1]); d < least) {
          least = d;
          best = m;
        }
    }
    return best;
  }

  /// The cavity's columns and one around them.
  [[nodiscard]] RefinementDemand demand_of(const Cluster& c, const LatticePoint& unit) const {
    RefinementDemand demand;
    demand.size = {unit[0] / c.grid->parts()[0], unit[1] / c.grid->parts()[1]};
    demand.layers = c.grid->layers();
    std::set<std::array<std::int64_t, 2>> columns;
    for (const NearWellCell& r : c.mesh->cavity.removed)
      for (std::int64_t dj = -1; dj <= 1; ++dj)
        for (std::int64_t di = -1; di <= 1; ++di)
          if (c.grid->is_inside({r[0] + di, r[1] + dj, 0})) columns.insert({r[1] + dj, r[0] + di});
    for (const auto& [j, i] : columns) demand.columns.push_back({i * demand.size[0], j * demand.size[1]});
    return demand;
  }

  /// The layers of the cavity's cells and of those around them.
  static void add_needed(const Cluster& c, const LatticePoint& unit, std::vector<NeededLayers>& out) {
    const NearWellGrid& grid = *c.grid;
    const LatticePoint size{unit[0] / grid.parts()[0], unit[1] / grid.parts()[1]};
    const std::int64_t layers = grid.dimensions()[2];
    std::map<LatticePoint, std::vector<std::uint8_t>> of_column;
    for (const NearWellCell& r : c.mesh->cavity.removed)
      for (std::int64_t dj = -1; dj <= 1; ++dj)
        for (std::int64_t di = -1; di <= 1; ++di) {
          if (!grid.is_inside({r[0] + di, r[1] + dj, 0})) continue;
          auto& is_needed = of_column[{(r[0] + di) * size[0], (r[1] + dj) * size[1]}];
          is_needed.resize(static_cast<std::size_t>(layers), 0);
          for (std::int64_t k = std::max<std::int64_t>(r[2] - 1, 0); k <= std::min(r[2] + 1, layers - 1); ++k)
            is_needed[static_cast<std::size_t>(k)] = 1;
        }
    for (auto& [low, is_needed] : of_column) out.push_back({low, std::move(is_needed)});
  }

  const WellTask& task_;
  std::vector<Cluster>& clusters_;
  std::vector<std::string>& reasons_;
  int most_rounds_;
  RefinementPlan plan_;
  int companies_ = 0;
};

}  // namespace

RefinementPlan resolve_conflicts(const WellTask& task, std::vector<Cluster>& clusters,
                                 std::vector<std::string>& reasons, int most_rounds) {
  return CavityClusters(task, clusters, reasons, most_rounds).run();
}

}  // namespace wellknit
