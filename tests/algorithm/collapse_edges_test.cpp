// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/collapse_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "algorithm/assembly.h"
#include "algorithm/build_mesh.h"
#include "model/mesh_check.h"
#include "tests/support/near_well.h"
#include "tests/support/rounds.h"

namespace wellknit {
namespace {

using near_well::Path;

BuildResult built(double deformation, Path path, Optimisation optimise) {
  BuildOptions options;
  options.optimise = optimise;
  return build_mesh(near_well::deformed(deformation), {near_well::well(path, 12.0)}, options);
}

/// Length of the shortest edge over the size of each transition cell that has it; counted here from the faces alone.
double shortest_edge(const Mesh& mesh) {
  double out = 1e300;
  std::map<std::pair<VertexId, VertexId>, double> ratio;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto loop = mesh.faces.loop(FaceId(f));
    for (const CellId cell : mesh.faces.cells[FaceId(f)]) {
      if (!cell.is_valid() || mesh.cells.kind[cell] != CellKind::transition) continue;
      for (std::size_t n = 0; n < loop.size(); ++n) {
        const VertexId a = loop[n];
        const VertexId b = loop[(n + 1) % loop.size()];
        double& most = ratio[std::minmax(a, b)];
        most = std::max(most, (mesh.vertices[a] - mesh.vertices[b]).norm() / std::cbrt(mesh.cells.volume[cell]));
      }
    }
  }
  for (const auto& [edge, length] : ratio) out = std::min(out, length);
  return out;
}

std::size_t count_of(const Mesh& mesh, CellKind kind) {
  return static_cast<std::size_t>(std::count(mesh.cells.kind.raw().begin(), mesh.cells.kind.raw().end(), kind));
}

TEST(CollapseEdges, TakesOutShortEdgesAndKeepsEachCellSound) {
  for (const Path path : {Path::vertical, Path::deviated, Path::curved, Path::horizontal})
    for (const double deformation : {0.5, 1.5}) {
      if (has_few_rounds && (path != Path::curved || deformation > 1.0)) continue;
      const BuildResult before = built(deformation, path, Optimisation::off);
      const BuildResult after = built(deformation, path, Optimisation::edges);
      ASSERT_TRUE(after.summary.edge_collapse);
      EXPECT_FALSE(after.summary.optimisation);
      const EdgeCollapse& c = *after.summary.edge_collapse;
      EXPECT_GT(c.edges_removed, 0);
      EXPECT_LE(4 * c.short_after, c.short_before);
      EXPECT_NEAR(shortest_edge(before.mesh), c.shortest_before, 1e-9);
      // Volumes of the cells follow their faces: sizes are not those that the edges were measured with.
      EXPECT_NEAR(shortest_edge(after.mesh) / c.shortest_after, 1.0, 0.05);
      EXPECT_EQ(before.mesh.faces.size() - after.mesh.faces.size(), static_cast<std::size_t>(c.faces_removed));
      EXPECT_EQ(before.mesh.vertices.size() - after.mesh.vertices.size(), static_cast<std::size_t>(c.edges_removed));
      EXPECT_TRUE(check_mesh(after.mesh).empty());
      for (const CellKind kind : {CellKind::host, CellKind::refined, CellKind::transition, CellKind::radial})
        EXPECT_EQ(count_of(before.mesh, kind), count_of(after.mesh, kind));
      double volume = 0.0;
      double change = 0.0;
      for (std::size_t n = 0; n < before.mesh.cells.size(); ++n) {
        const CellId cell(n);
        EXPECT_EQ(before.mesh.cells.center[cell], after.mesh.cells.center[cell]);
        volume += before.mesh.cells.volume[cell];
        change += after.mesh.cells.volume[cell] - before.mesh.cells.volume[cell];
      }
      EXPECT_LT(std::abs(change), 1e-12 * volume);
    }
}

TEST(CollapseEdges, LeavesFewShortEdgesWhereVerticesMoveToo) {
  for (const double deformation : {0.5, 1.0}) {
    const BuildResult result = built(deformation, Path::curved, Optimisation::on);
    const EdgeCollapse& c = *result.summary.edge_collapse;
    EXPECT_GT(c.short_before, 50);
    EXPECT_LE(20 * c.short_after, c.short_before);
    EXPECT_GT(c.shortest_after, 10.0 * c.shortest_before);
    EXPECT_TRUE(check_mesh(result.mesh).empty());
  }
}

/// Limits that no edge can pass: nothing is done, and nothing changes.
TEST(CollapseEdges, DoesNothingWithoutRoom) {
  Assembly assembly;
  assembly.mesh = built(1.0, Path::curved, Optimisation::off).mesh;
  for (std::size_t f = 0; f < assembly.mesh.faces.size(); ++f) assembly.face_info.push_back({});
  const Mesh before = assembly.mesh;
  CollapseLimits limits;
  limits.length = 0.0;
  EXPECT_EQ(collapse_short_edges(assembly, {}, limits).edges_removed, 0);
  EXPECT_EQ(before.faces.vertices, assembly.mesh.faces.vertices);
  EXPECT_EQ(before.vertices.raw(), assembly.mesh.vertices.raw());
  // All transition cells kept: no vertex is free.
  std::vector<CellId> kept;
  for (std::size_t c = 0; c < before.cells.size(); ++c)
    if (before.cells.kind[CellId(c)] == CellKind::transition) kept.emplace_back(c);
  EXPECT_EQ(collapse_short_edges(assembly, kept).edges_removed, 0);
  // With room for them edges go; a second time finds none of those that can.
  const EdgeCollapse first = collapse_short_edges(assembly);
  EXPECT_GT(first.edges_removed, 0);
  EXPECT_LT(collapse_short_edges(assembly).edges_removed, first.edges_removed / 10);
}

}  // namespace
}  // namespace wellknit
