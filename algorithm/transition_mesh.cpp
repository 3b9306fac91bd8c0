// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/transition_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithm/cavity_mapping.h"
#include "algorithm/cell_center.h"
#include "algorithm/cell_opening.h"
#include "algorithm/short_edges.h"

namespace wellknit {

namespace {

constexpr int most_dilations = 2;

/// Of several wells the last one gives way, and the others try again.
NoCavity failed(const Cavity& cavity, std::string reason) {
  return {std::move(reason), {cavity.tubes.size() - 1}, true};
}

/// Vertices that must stay: those of the boundary, and those on the grid's own outside.
std::vector<std::uint8_t> fixed_vertices(const Cavity& cavity, const PowerDiagram& diagram) {
  std::vector<std::uint8_t> is_fixed(diagram.vertices.size(), 0);
  for (std::size_t v = 0; v < is_fixed.size(); ++v)
    is_fixed[v] = v < cavity.vertices.size() || diagram.planes[v] != 0 ? 1 : 0;
  return is_fixed;
}

/// Boundary vertices have their exact real positions; the others and the sites go through phi.
void map_back(const CavityMapping& mapping, const Sites& sites, const PowerDiagram& diagram, TransitionMesh& mesh) {
  for (const CavityVertex& v : mesh.cavity.vertices) mesh.vertices.push_back(v.real);
  const auto inner = mapping.to_real(std::span(diagram.vertices).subspan(mesh.vertices.size()));
  mesh.vertices.insert(mesh.vertices.end(), inner.begin(), inner.end());
  std::vector<Vec3> centers;
  centers.reserve(sites.inner.size());
  for (const Site& s : sites.inner) centers.push_back(s.center);
  mesh.centers = mapping.to_real(centers);
}

void count(TransitionMesh& mesh) {
  std::vector<std::uint8_t> is_used(mesh.vertices.size(), 0);
  for (const DiagramFace& f : mesh.faces)
    for (const auto v : f.loop) is_used[static_cast<std::size_t>(v)] = 1;
  mesh.summary.transition_vertices = std::count(is_used.begin(), is_used.end(), 1);
  mesh.summary.transition_faces = static_cast<std::int64_t>(mesh.faces.size());
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
  // First, since it is what fails most often.
  const CavityMapping mapping(mesh.cavity, method);
  const MappingReport& report = mapping.report();
  mesh.summary.inverted_tetrahedra = report.inverted_first;
  mesh.summary.loops = report.loops;
  mesh.summary.points_inserted = report.points_inserted;
  mesh.summary.outer_nodes_left_out = report.plane_nodes_left_out;
  if (!report.failure.empty()) {
    NoCavity none = failed(mesh.cavity, report.failure + ": the grid is deformed too much around the tube");
    if (!report.tubes_at_fault.empty()) none.tubes = report.tubes_at_fault;
    none.places = report.places_at_fault;
    return none;
  }
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
  // Asserted in every run: each boundary face is found as the very same vertex set and nothing else touches the
  // boundary.
  if (std::string fault = trial.fault(mesh.cavity); !fault.empty()) return failed(mesh.cavity, std::move(fault));
  mesh.summary.boundary_faces = static_cast<std::int64_t>(mesh.cavity.faces.size());
  mesh.summary.boundary_faces_found = match.found;
  map_back(mapping, sites, diagram, mesh);
  const auto is_fixed = fixed_vertices(mesh.cavity, diagram);
  mesh.faces = std::move(diagram.faces);
  mesh.boundary_face = std::move(match.boundary_face);
  mesh.summary.cells_removed = static_cast<std::int64_t>(mesh.cavity.removed.size());
  mesh.summary.cavity_rounds = mesh.cavity.rounds;
  if (const auto bad = choose_centers(is_fixed, mesh)) {
    NoCavity none = failed(mesh.cavity, bad->reason);
    none.places = {nearest_place(mesh.cavity.tubes, bad->center, &Tube::real)};
    none.tubes = {none.places[0].tube};
    return none;
  }
  count(mesh);
  return mesh;
}

}  // namespace

namespace {

bool may_be_larger(const std::variant<TransitionMesh, NoCavity>& result) {
  const auto* none = std::get_if<NoCavity>(&result);
  return none != nullptr && none->may_be_larger;
}

}  // namespace

std::optional<BadCell> choose_centers(const std::vector<std::uint8_t>& is_fixed, TransitionMesh& mesh) {
  auto faces = outward_faces(mesh);
  const auto is_seen = [&](std::size_t c) {
    return smallest_height(faces[c], mesh.centers[c]) > 1e-6 * cell_size(faces[c]);
  };
  bool are_seen = true;
  for (std::size_t c = 0; c < mesh.centers.size() && are_seen; ++c) are_seen = is_seen(c);
  if (are_seen) return std::nullopt;
  const OpeningReport opening = open_cells(mesh, is_fixed);
  mesh.summary.cells_closed_after_mapping = opening.closed_first;
  mesh.summary.vertices_moved = opening.moved;
  mesh.summary.cells_merged = opening.merged;
  if (opening.moved > 0 || opening.merged > 0) faces = outward_faces(mesh);
  const auto bad = [&](const Vec3& at, const char* what) {
    const Vec3 p = mesh.cavity.tubes.empty() ? at : mesh.cavity.tubes.front().space.from(at);
    return BadCell{fmt::format("a transition cell near ({:.1f}, {:.1f}, {:.1f}) {}", p.x(), p.y(), p.z(), what), at};
  };
  for (std::size_t c = 0; c < mesh.centers.size(); ++c) {
    if (!(enclosed_volume(faces[c]) > 0.0)) return bad(mesh.centers[c], "is inside out after the mapping");
    // The site stays wherever it sees its cell: moving it costs orthogonality.
    if (is_seen(c)) continue;
    const auto p = point_that_sees_all(faces[c], mesh.centers[c], cell_size(faces[c]));
    if (!p) return bad(mesh.centers[c], "is seen whole from no point after the mapping");
    mesh.centers[c] = *p;
  }
  return std::nullopt;
}

void note_open_mesh(const std::vector<TransitionMesh>& cavities, const Vec3& point,
                    std::map<std::size_t, std::string>& reasons) {
  const TransitionMesh* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const TransitionMesh& c : cavities)
    for (const CavityVertex& v : c.cavity.vertices)
      if (const double d = (v.real - point).squaredNorm(); d < least) {
        least = d;
        nearest = &c;
      }
  for (const Tube& t : nearest->cavity.tubes) {
    const Vec3 p = t.space.from(point);
    reasons.emplace(t.well, fmt::format("the mesh around it would not close at ({:.1f}, {:.1f}, {:.1f}); please send "
                                        "this case to the authors",
                                        p.x(), p.y(), p.z()));
  }
}

std::variant<TransitionMesh, NoCavity> build_transition_mesh(const HostFrame& frame, const std::vector<Tube>& tubes,
                                                             MappingMethod method, bool tight) {
  auto result = try_once(frame, tubes, method, 0);
  if (tight || std::holds_alternative<TransitionMesh>(result)) return result;
  for (int dilation = 1; dilation <= most_dilations && may_be_larger(result); ++dilation) {
    auto next = try_once(frame, tubes, method, dilation);
    // The first reason is the plainest; later ones speak of a larger cavity.
    if (std::holds_alternative<TransitionMesh>(next)) return next;
  }
  return result;
}

}  // namespace wellknit
