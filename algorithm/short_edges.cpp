// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/short_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace wellknit {

namespace {

constexpr double short_part = 0.03;  ///< of the drainage radius: method.md §9
constexpr int most_rounds = 6;       ///< each costs one diagram, some hundredths of a second

double short_limit(const Cavity& cavity) {
  double radius = std::numeric_limits<double>::infinity();
  for (const Tube& t : cavity.tubes) radius = std::min(radius, t.reference_radius);
  return short_part * radius;
}

/// Cells at each vertex of the given edges.
std::map<std::int32_t, std::set<std::int32_t>> cells_at(const PowerDiagram& diagram,
                                                        const std::vector<std::array<std::int32_t, 2>>& edges) {
  std::map<std::int32_t, std::set<std::int32_t>> out;
  for (const auto& e : edges) {
    out[e[0]];
    out[e[1]];
  }
  for (const DiagramFace& f : diagram.faces)
    for (const auto v : f.loop)
      if (const auto at = out.find(v); at != out.end()) {
        at->second.insert(f.cell);
        if (f.other_kind == DiagramFace::Other::inner) at->second.insert(f.other);
      }
  return out;
}

/// The cells that end at one of an edge's vertices: moving such a site moves that vertex along the edge.
std::vector<std::int32_t> end_cells(const std::map<std::int32_t, std::set<std::int32_t>>& cells,
                                    const std::array<std::int32_t, 2>& edge) {
  std::vector<std::int32_t> out;
  const auto& a = cells.at(edge[0]);
  const auto& b = cells.at(edge[1]);
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

}  // namespace

bool DiagramTrial::is_sound(const Cavity& cavity) const {
  return sites.not_centred == 0 && diagram.failure.empty() &&
         match.found == static_cast<std::int64_t>(cavity.faces.size()) && match.foreign == 0 &&
         match.volume_error <= 1e-8;
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
  std::set<std::array<std::int32_t, 2>> edges;
  for (const DiagramFace& f : diagram.faces)
    for (std::size_t i = 0; i < f.loop.size(); ++i) {
      const std::int32_t a = f.loop[i];
      const std::int32_t b = f.loop[(i + 1) % f.loop.size()];
      if (a < boundary && b < boundary) continue;
      if ((diagram.vertices[static_cast<std::size_t>(a)] - diagram.vertices[static_cast<std::size_t>(b)]).norm() <
          limit)
        edges.insert({std::min(a, b), std::max(a, b)});
    }
  return {edges.begin(), edges.end()};
}

DiagramTrial expand_short_edges(const Cavity& cavity, DiagramTrial trial, AdjustmentReport& report) {
  const double limit = short_limit(cavity);
  auto edges = short_edges(cavity, trial.diagram, limit);
  report.short_before = static_cast<std::int64_t>(edges.size());
  std::vector<double> part(cavity.faces.size(), 1.0);
  double step = 0.9;
  for (int round = 0; round < most_rounds && !edges.empty(); ++round) {
    const auto cells = cells_at(trial.diagram, edges);
    std::set<std::int32_t> moved;
    for (const auto& e : edges) {
      // One end cell for each edge, and not one that another edge moves already: two moves may cancel.
      for (const auto c : end_cells(cells, e))
        if (moved.insert(c).second) break;
    }
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
    if (next_edges.size() >= edges.size()) {
      step = 0.5 * (1.0 + step);
      continue;
    }
    part = std::move(next_part);
    trial = std::move(next);
    edges = std::move(next_edges);
  }
  report.short_after = static_cast<std::int64_t>(edges.size());
  return trial;
}

}  // namespace wellknit
