// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/short_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <unordered_set>

namespace wellknit {

namespace {

constexpr double short_part = 0.03;  ///< of the drainage radius: method.md §9
constexpr int most_rounds = 6;       ///< each costs one diagram
constexpr double least_gain = 0.05;  ///< of the short edges: what a round must gain for another to be worth a diagram
/// Of the sites: where more would have to move, the short edges come from the regularity of the grid and the tube, and
/// moved sites only change their places.
constexpr double most_moved = 0.5;

double short_limit(const Cavity& cavity) {
  double radius = std::numeric_limits<double>::infinity();
  for (const Tube& t : cavity.tubes) radius = std::min(radius, t.reference_radius);
  return short_part * radius;
}

/// Cells at each vertex of the given edges.
class CellsAtVertices {
 public:
  CellsAtVertices(const PowerDiagram& diagram, const std::vector<std::array<std::int32_t, 2>>& edges)
      : place_(diagram.vertices.size(), -1) {
    for (const auto& e : edges)
      for (const auto v : e)
        if (auto& place = place_[static_cast<std::size_t>(v)]; place < 0) {
          place = static_cast<std::int32_t>(cells_.size());
          cells_.emplace_back();
        }
    for (const DiagramFace& f : diagram.faces)
      for (const auto v : f.loop) {
        const std::int32_t place = place_[static_cast<std::size_t>(v)];
        if (place < 0) continue;
        auto& cells = cells_[static_cast<std::size_t>(place)];
        add(cells, f.cell);
        if (f.other_kind == DiagramFace::Other::inner) add(cells, f.other);
      }
    for (auto& cells : cells_) std::sort(cells.begin(), cells.end());
  }

  /// Rising.
  [[nodiscard]] const std::vector<std::int32_t>& at(std::int32_t vertex) const {
    return cells_[static_cast<std::size_t>(place_[static_cast<std::size_t>(vertex)])];
  }

 private:
  static void add(std::vector<std::int32_t>& cells, std::int32_t cell) {
    if (std::find(cells.begin(), cells.end(), cell) == cells.end()) cells.push_back(cell);
  }

  std::vector<std::int32_t> place_;               ///< per vertex, in cells_; -1: at no edge
  std::vector<std::vector<std::int32_t>> cells_;  ///< a handful each
};

/// The cells that end at one of an edge's vertices: moving such a site moves that vertex along the edge.
std::vector<std::int32_t> end_cells(const CellsAtVertices& cells, const std::array<std::int32_t, 2>& edge) {
  std::vector<std::int32_t> out;
  const auto& a = cells.at(edge[0]);
  const auto& b = cells.at(edge[1]);
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

}  // namespace

std::string DiagramTrial::fault(const Cavity& cavity) const {
  if (sites.not_centred > 0) return fmt::format("{} sites do not lie in their own cells", sites.not_centred);
  if (!diagram.failure.empty()) return "the power diagram is not sound: " + diagram.failure;
  const auto boundary_faces = static_cast<std::int64_t>(cavity.faces.size());
  if (match.found == boundary_faces && match.foreign == 0 && match.volume_error <= 1e-8) return {};
  return fmt::format("the power diagram gives back {} of {} boundary faces ({} foreign, volume error {:.1e})",
                     match.found, boundary_faces, match.foreign, match.volume_error);
}

DiagramTrial try_diagram(const Cavity& cavity, const std::vector<double>& part) {
  DiagramTrial trial;
  trial.sites = place_sites(cavity, part);
  if (trial.sites.not_centred > 0) return trial;
  trial.diagram = build_power_diagram(cavity, trial.sites);
  if (trial.diagram.failure.empty()) trial.match = match_boundary(cavity, trial.sites, trial.diagram);
  return trial;
}

std::vector<std::array<std::int32_t, 2>> short_edges(const Cavity& cavity, const PowerDiagram& diagram, double limit) {
  const auto boundary = static_cast<std::int32_t>(cavity.vertices.size());
  std::vector<std::array<std::int32_t, 2>> edges;
  for (const DiagramFace& f : diagram.faces)
    for (std::size_t i = 0; i < f.loop.size(); ++i) {
      const std::int32_t a = f.loop[i];
      const std::int32_t b = f.loop[(i + 1) % f.loop.size()];
      if (a < boundary && b < boundary) continue;
      if ((diagram.vertices[static_cast<std::size_t>(a)] - diagram.vertices[static_cast<std::size_t>(b)]).norm() <
          limit)
        edges.push_back({std::min(a, b), std::max(a, b)});
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

DiagramTrial expand_short_edges(const Cavity& cavity, DiagramTrial trial, AdjustmentReport& report) {
  const double limit = short_limit(cavity);
  auto edges = short_edges(cavity, trial.diagram, limit);
  report.short_before = static_cast<std::int64_t>(edges.size());
  std::vector<double> part(cavity.faces.size(), 1.0);
  double step = 0.9;
  for (int round = 0; round < most_rounds && !edges.empty(); ++round) {
    const CellsAtVertices cells(trial.diagram, edges);
    std::unordered_set<std::int32_t> moved;
    for (const auto& e : edges) {
      // One end cell for each edge, and not one that another edge moves already: two moves may cancel.
      for (const auto c : end_cells(cells, e))
        if (moved.insert(c).second) break;
    }
    if (static_cast<double>(moved.size()) > most_moved * static_cast<double>(trial.sites.inner.size())) break;
    auto next_part = part;
    for (std::size_t f = 0; f < part.size(); ++f)
      if (cavity.faces[f].kind != BoundaryFaceKind::cap && moved.contains(trial.sites.inner_of[f]))
        next_part[f] *= step;
    DiagramTrial next = try_diagram(cavity, next_part);
    if (!next.is_sound(cavity)) {
      step = 0.5 * (1.0 + step);
      continue;
    }
    auto next_edges = short_edges(cavity, next.diagram, limit);
    if (next_edges.size() >= edges.size()) break;
    const bool is_worth_more =
        static_cast<double>(next_edges.size()) <= (1.0 - least_gain) * static_cast<double>(edges.size());
    part = std::move(next_part);
    trial = std::move(next);
    edges = std::move(next_edges);
    if (!is_worth_more) break;
  }
  report.short_after = static_cast<std::int64_t>(edges.size());
  return trial;
}

}  // namespace wellknit
