// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/cell_opening.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace wellknit {
namespace {

/// 4 x 1 x 1 boxes of 1 m in a row, vertex (i, j, k) at 4 i + 2 j + k: inner faces between them, boundary around.
TransitionMesh row_of_boxes() {
  TransitionMesh mesh;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k) mesh.vertices.emplace_back(i, j, k);
  const auto add = [&](std::int32_t cell, DiagramFace::Other kind, std::int32_t other, std::vector<std::int32_t> loop) {
    mesh.faces.push_back({std::move(loop), cell, kind, other});
    mesh.boundary_face.push_back(kind == DiagramFace::Other::inner ? -1 : 0);
  };
  for (std::int32_t c = 0; c < 4; ++c) {
    mesh.centers.emplace_back(c + 0.5, 0.5, 0.5);
    const std::int32_t v = 4 * c;
    if (c == 0) add(c, DiagramFace::Other::outer, 0, {v, v + 1, v + 3, v + 2});
    add(c, c < 3 ? DiagramFace::Other::inner : DiagramFace::Other::outer, c < 3 ? c + 1 : 0,
        {v + 4, v + 6, v + 7, v + 5});
    add(c, DiagramFace::Other::outer, 0, {v, v + 4, v + 5, v + 1});
    add(c, DiagramFace::Other::outer, 0, {v + 2, v + 3, v + 7, v + 6});
    add(c, DiagramFace::Other::outer, 0, {v, v + 2, v + 6, v + 4});
    add(c, DiagramFace::Other::outer, 0, {v + 1, v + 5, v + 7, v + 3});
  }
  return mesh;
}

/// The same with a spike: the face between the second and the third box is four triangles around vertex 20, which comes
/// out at x = 0.9, beyond the far wall of the second box. Where y is 0.5, x <= 2 - 2.2 y gives 0.9, so that no point at
/// x >= 1 sees them all; the box keeps a volume of 1 - 1.1/3 m3.
TransitionMesh row_with_spike() {
  TransitionMesh mesh = row_of_boxes();
  mesh.vertices.emplace_back(0.9, 0.5, 0.5);
  const auto at = std::find_if(mesh.faces.begin(), mesh.faces.end(), [](const DiagramFace& f) {
    return f.cell == 1 && f.other_kind == DiagramFace::Other::inner;
  });
  const std::vector<std::int32_t> loop = at->loop;
  at->loop = {loop[0], loop[1], 20};
  for (std::size_t i = 1; i < 4; ++i) {
    mesh.faces.push_back({{loop[i], loop[(i + 1) % 4], 20}, 1, DiagramFace::Other::inner, 2});
    mesh.boundary_face.push_back(-1);
  }
  return mesh;
}

double depth(const std::vector<OutwardFace>& faces) {
  return deepest_point(faces, faces.front().mean, cell_size(faces)).height / cell_size(faces);
}

/// Volumes 1 m3 each for the boxes as they are.
TEST(CellOpening, LeavesAMeshOfOpenCellsAlone) {
  TransitionMesh mesh = row_of_boxes();
  const auto before = mesh.vertices;
  const OpeningReport report = open_cells(mesh, std::vector<std::uint8_t>(mesh.vertices.size(), 0));
  EXPECT_EQ(report.closed_first, 0);
  EXPECT_EQ(mesh.vertices, before);
  for (const auto& faces : outward_faces(mesh)) EXPECT_NEAR(enclosed_volume(faces), 1.0, 1e-12);
}

TEST(CellOpening, MovesVerticesUntilACellIsSeenAndItsNeighboursStaySeen) {
  TransitionMesh mesh = row_with_spike();
  EXPECT_NEAR(enclosed_volume(outward_faces(mesh)[1]), 1.0 - 1.1 / 3.0, 1e-12);
  ASSERT_LE(depth(outward_faces(mesh)[1]), 0.0);
  std::vector<std::uint8_t> is_fixed(mesh.vertices.size(), 1);
  is_fixed[20] = 0;
  const auto before = mesh.vertices;
  const OpeningReport report = open_cells(mesh, is_fixed);
  EXPECT_EQ(report.closed_first, 1);
  EXPECT_EQ(report.moved, 1);
  EXPECT_EQ(report.merged, 0);
  EXPECT_EQ(report.closed_last, 0);
  for (const auto& faces : outward_faces(mesh)) EXPECT_GT(depth(faces), 1e-6);
  for (std::size_t v = 0; v < before.size(); ++v) EXPECT_TRUE(is_fixed[v] == 0 || mesh.vertices[v] == before[v]);
}

TEST(CellOpening, MergesACellThatNoMoveOpens) {
  TransitionMesh mesh = row_with_spike();
  const OpeningReport report = open_cells(mesh, std::vector<std::uint8_t>(mesh.vertices.size(), 1));
  EXPECT_EQ(report.moved, 0);
  EXPECT_EQ(report.merged, 1);
  EXPECT_EQ(report.closed_last, 0);
  ASSERT_EQ(mesh.centers.size(), 3U);
  double volume = 0.0;
  for (const auto& faces : outward_faces(mesh)) {
    EXPECT_GT(depth(faces), 1e-6);
    volume += enclosed_volume(faces);
  }
  EXPECT_NEAR(volume, 4.0, 1e-12);
  EXPECT_EQ(mesh.faces.size(), mesh.boundary_face.size());
}

/// One box of 1 m whose side at x = 1 is four triangles to an apex; all of its vertices are on the boundary.
TransitionMesh box_with_apex(double x) {
  TransitionMesh mesh;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k) mesh.vertices.emplace_back(i, j, k);
  mesh.vertices.emplace_back(x, 0.5, 0.5);
  mesh.centers.emplace_back(0.5, 0.5, 0.5);
  const std::vector<std::vector<std::int32_t>> loops{
      {0, 1, 3, 2}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}, {4, 6, 8}, {6, 7, 8}, {7, 5, 8}, {5, 4, 8}};
  for (const auto& loop : loops) {
    mesh.faces.push_back({loop, 0, DiagramFace::Other::outer, 0});
    mesh.boundary_face.push_back(0);
  }
  return mesh;
}

std::string reason_of(TransitionMesh mesh) {
  const std::vector<std::uint8_t> is_fixed(mesh.vertices.size(), 1);
  const auto bad = choose_centers(is_fixed, mesh);
  return bad ? bad->reason : "none";
}

TEST(ChooseCenters, SaysWhichCellCannotBeUsed) {
  EXPECT_EQ(reason_of(box_with_apex(1.0)), "none");
  // Beyond the far side: the triangles are seen from behind it alone. The volume is 1 - 1.1 / 3 m3.
  EXPECT_EQ(reason_of(box_with_apex(-0.1)),
            "a transition cell near (0.5, 0.5, 0.5) is seen whole from no point after the mapping");
  EXPECT_EQ(reason_of(box_with_apex(-3.0)),  // 1 - 4 / 3 m3
            "a transition cell near (0.5, 0.5, 0.5) is inside out after the mapping");
}

TEST(OpenMesh, IsNotedForTheWellsOfTheNearestCavity) {
  std::vector<TransitionMesh> cavities(2);
  for (std::size_t c = 0; c < 2; ++c) {
    cavities[c].cavity.vertices.resize(1);
    cavities[c].cavity.vertices[0].real = Vec3(100.0 * static_cast<double>(c), 0.0, 2000.0);
    cavities[c].cavity.tubes.resize(1);
    cavities[c].cavity.tubes[0].well = 4 + c;
  }
  std::map<std::size_t, std::string> reasons;
  note_open_mesh(cavities, Vec3(80.0, 0.0, 2001.25), reasons);
  EXPECT_EQ(reasons, (std::map<std::size_t, std::string>{
                         {5,
                          "the mesh around it would not close at (80.0, 0.0, 2001.2); please send this case to the "
                          "authors"}}));
}

}  // namespace
}  // namespace wellknit
