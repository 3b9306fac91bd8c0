// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/transition_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "algorithm/cavity_mapping.h"
#include "algorithm/cell_center.h"
#include "algorithm/short_edges.h"

namespace wellknit {

namespace {

constexpr int most_dilations = 2;

/// Of several wells the last one gives way, and the others try again.
NoCavity failed(const Cavity& cavity, std::string reason) { return {std::move(reason), {cavity.tubes.back().well}}; }

/// Faces of each cell, outward.
std::vector<std::vector<OutwardFace>> faces_by_cell(const TransitionMesh& mesh) {
  std::vector<std::vector<OutwardFace>> out(mesh.centers.size());
  std::vector<Vec3> points;
  for (const DiagramFace& f : mesh.faces) {
    points.clear();
    for (const auto v : f.loop) points.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
    const PolygonGeometry g = polygon_geometry(points);
    out[static_cast<std::size_t>(f.cell)].push_back({g.mean, g.area_vector});
    if (f.other_kind == DiagramFace::Other::inner)
      out[static_cast<std::size_t>(f.other)].push_back({g.mean, -g.area_vector});
  }
  return out;
}

double volume_of(const std::vector<OutwardFace>& faces) {
  double volume = 0.0;
  for (const OutwardFace& f : faces) volume += (f.mean - faces.front().mean).dot(f.area_vector) / 3.0;
  return volume;
}

/// Mapped sites see their cells where phi is gentle; elsewhere the nearest point that does is taken.
std::optional<std::string> choose_centers(TransitionMesh& mesh) {
  const auto faces = faces_by_cell(mesh);
  for (std::size_t c = 0; c < mesh.centers.size(); ++c) {
    const double volume = volume_of(faces[c]);
    if (!(volume > 0.0))
      return fmt::format("a transition cell near ({:.1f}, {:.1f}, {:.1f}) is inside out after the mapping",
                         mesh.centers[c].x(), mesh.centers[c].y(), mesh.centers[c].z());
    const double size = std::cbrt(volume);
    // The site stays wherever it sees its cell: moving it costs orthogonality.
    if (smallest_height(faces[c], mesh.centers[c]) > 1e-6 * size) continue;
    if (const auto p = point_that_sees_all(faces[c], mesh.centers[c], size))
      mesh.centers[c] = *p;
    else
      ++mesh.summary.cells_not_seen_from_centre;
  }
  return std::nullopt;
}

/// Boundary vertices have their exact real positions; the others and the sites go through phi.
void map_back(const CavityMapping& mapping, const Sites& sites, const PowerDiagram& diagram, TransitionMesh& mesh) {
  for (const CavityVertex& v : mesh.cavity.vertices) mesh.vertices.push_back(v.real);
  for (std::size_t v = mesh.vertices.size(); v < diagram.vertices.size(); ++v)
    mesh.vertices.push_back(mapping.to_real(diagram.vertices[v]));
  for (const Site& s : sites.inner) mesh.centers.push_back(mapping.to_real(s.center));
}

void count(const PowerDiagram& diagram, TransitionMesh& mesh) {
  std::set<std::int32_t> used;
  for (const DiagramFace& f : diagram.faces) used.insert(f.loop.begin(), f.loop.end());
  mesh.summary.transition_vertices = static_cast<std::int64_t>(used.size());
  mesh.summary.transition_faces = static_cast<std::int64_t>(diagram.faces.size());
  mesh.summary.transition_cells = static_cast<std::int64_t>(mesh.centers.size());
}

std::variant<TransitionMesh, NoCavity> try_once(const HostFrame& frame, const std::vector<Tube>& tubes,
                                                MappingMethod method, int dilation) {
  CavityOptions options;
  options.dilation = dilation;
  auto cavity = build_cavity(frame, tubes, options);
  if (auto* none = std::get_if<NoCavity>(&cavity)) return std::move(*none);
  TransitionMesh mesh;
  mesh.cavity = std::move(std::get<Cavity>(cavity));
  DiagramTrial trial = try_diagram(mesh.cavity, {});
  // The sites of a layered cavity stand in columns: moving one of a column would tilt the faces between its layers.
  const bool is_layered =
      std::all_of(mesh.cavity.tubes.begin(), mesh.cavity.tubes.end(), [](const Tube& t) { return t.layered; });
  if (!is_layered && trial.is_sound(mesh.cavity)) {
    AdjustmentReport adjustment;
    trial = expand_short_edges(mesh.cavity, std::move(trial), adjustment);
    mesh.summary.short_edges = adjustment.short_after;
    mesh.summary.short_edges_expanded = adjustment.short_before - adjustment.short_after;
  }
  const Sites& sites = trial.sites;
  PowerDiagram& diagram = trial.diagram;
  BoundaryMatch& match = trial.match;
  if (sites.not_centred > 0)
    return failed(mesh.cavity, fmt::format("{} sites do not lie in their own cells", sites.not_centred));
  if (!diagram.failure.empty()) return failed(mesh.cavity, "the power diagram is not sound: " + diagram.failure);
  mesh.summary.boundary_faces = static_cast<std::int64_t>(mesh.cavity.faces.size());
  mesh.summary.boundary_faces_found = match.found;
  // Asserted in every run: each boundary face is found as the very same vertex set and nothing else touches the
  // boundary.
  if (match.found != mesh.summary.boundary_faces || match.foreign != 0 || match.volume_error > 1e-8)
    return failed(mesh.cavity,
                  fmt::format("the power diagram gives back {} of {} boundary faces ({} foreign, volume error {:.1e})",
                              match.found, mesh.summary.boundary_faces, match.foreign, match.volume_error));
  const CavityMapping mapping(mesh.cavity, method);
  const MappingReport& report = mapping.report();
  mesh.summary.inverted_tetrahedra = report.inverted_first;
  mesh.summary.loops = report.loops;
  mesh.summary.points_inserted = report.points_inserted;
  mesh.summary.outer_nodes_left_out = report.plane_nodes_left_out;
  if (!report.failure.empty()) {
    NoCavity none = failed(mesh.cavity,
                           report.failure + ": the grid is deformed too much around the tube; choose a smaller radius");
    if (!report.tubes_at_fault.empty()) {
      none.wells.clear();
      for (const std::size_t t : report.tubes_at_fault) none.wells.push_back(mesh.cavity.tubes[t].well);
    }
    return none;
  }
  map_back(mapping, sites, diagram, mesh);
  count(diagram, mesh);
  mesh.faces = std::move(diagram.faces);
  mesh.boundary_face = std::move(match.boundary_face);
  mesh.summary.cells_removed = static_cast<std::int64_t>(mesh.cavity.removed.size());
  mesh.summary.cavity_rounds = mesh.cavity.rounds;
  if (auto reason = choose_centers(mesh)) return failed(mesh.cavity, *reason);
  return mesh;
}

}  // namespace

std::variant<TransitionMesh, NoCavity> build_transition_mesh(const HostFrame& frame, const std::vector<Tube>& tubes,
                                                             MappingMethod method) {
  auto result = try_once(frame, tubes, method, 0);
  for (int dilation = 1; dilation <= most_dilations && std::holds_alternative<NoCavity>(result); ++dilation) {
    auto next = try_once(frame, tubes, method, dilation);
    // The first reason is the plainest; later ones speak of a larger cavity.
    if (std::holds_alternative<TransitionMesh>(next)) return next;
  }
  return result;
}

}  // namespace wellknit
