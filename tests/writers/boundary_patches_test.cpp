// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/boundary_patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/support/meshes.h"

namespace wellknit {
namespace {

std::map<std::string, std::size_t> sizes(const Mesh& mesh) {
  std::map<std::string, std::size_t> out;
  for (const BoundaryPatch& patch : boundary_patches(mesh)) out[patch.name] = patch.faces.size();
  return out;
}

using Sizes = std::map<std::string, std::size_t>;

/// The mesh's only boundary patch with the right-hand normal of its faces along one direction.
void expect_normals(const Mesh& mesh, const std::string& name, const Vec3& normal) {
  for (const BoundaryPatch& patch : boundary_patches(mesh)) {
    if (patch.name != name) continue;
    for (const FaceId face : patch.faces)
      EXPECT_GT(face_geometry(mesh, face).area_vector.normalized().dot(normal), 0.99) << name;
  }
}

TEST(BoundaryPatches, AreTheSixSidesOfABoxInTheirOrder) {
  // 3 x 3 x 3 cells: nine faces a side.
  const Mesh mesh = meshes::box_grid(3);
  EXPECT_EQ(sizes(mesh), (Sizes{{"i_min", 9}, {"i_max", 9}, {"j_min", 9}, {"j_max", 9}, {"k_min", 9}, {"k_max", 9}}));
  std::string names;
  for (const BoundaryPatch& patch : boundary_patches(mesh)) names += patch.name + " ";
  EXPECT_EQ(names, "i_min i_max j_min j_max k_min k_max ");
  expect_normals(mesh, "i_min", -Vec3::UnitX());
  expect_normals(mesh, "j_max", Vec3::UnitY());
  expect_normals(mesh, "k_min", -Vec3::UnitZ());  // depth points down
}

TEST(BoundaryPatches, AreToldInAGridOfOneCellInADirection) {
  EXPECT_EQ(sizes(meshes::two_boxes()),
            (Sizes{{"i_min", 1}, {"i_max", 1}, {"j_min", 2}, {"j_max", 2}, {"k_min", 2}, {"k_max", 2}}));
}

TEST(BoundaryPatches, FollowTheGridsOwnDirections) {
  // i along -y and j along x: a quarter turn in the plane.
  Mesh mesh = meshes::box_grid(3);
  for (Vec3& p : mesh.vertices) p = Vec3(p.y(), -p.x(), p.z());
  for (Vec3& p : mesh.cells.centroid) p = Vec3(p.y(), -p.x(), p.z());
  expect_normals(mesh, "i_min", Vec3::UnitY());
  expect_normals(mesh, "j_max", Vec3::UnitX());
  EXPECT_EQ(sizes(mesh).at("i_min"), 9U);
}

TEST(BoundaryPatches, HaveTheSidesOfAGridWithSteepLayers) {
  // Sheared to a dip of 63 degrees, z += 2 x: tops stay tops, though their normals are nearer to x than to z.
  Mesh mesh = meshes::box_grid(3);
  for (Vec3& p : mesh.vertices) p.z() += 2.0 * p.x();
  for (Vec3& p : mesh.cells.centroid) p.z() += 2.0 * p.x();
  for (const auto& [name, count] : sizes(mesh)) EXPECT_EQ(count, 9U) << name;
  expect_normals(mesh, "i_max", Vec3::UnitX());
  expect_normals(mesh, "k_max", Vec3(-2.0, 0.0, 1.0).normalized());
}

TEST(BoundaryPatches, TellInactiveRockAndFaults) {
  // The second box is followed by source cell 2: not in the mesh, then in it (as part of a made cell) but apart.
  Mesh mesh = meshes::two_boxes();
  mesh.source_dimensions = {3, 1, 1};
  mesh.transfer.start = {0, 1, 2, 2};
  EXPECT_EQ(sizes(mesh).at("inactive"), 1U);
  EXPECT_EQ(sizes(mesh).count("i_max"), 0U);
  mesh.transfer.start = {0, 1, 2, 3};
  mesh.transfer.cell.push_back(CellId(0));
  mesh.transfer.fraction.push_back(1.0);
  EXPECT_EQ(sizes(mesh).at("fault"), 1U);
}

TEST(BoundaryPatches, TellAGapThatAConnectionBridges) {
  // A layer below that is not in the mesh: inactive rock under the second box, a pinch-out under the first.
  Mesh mesh = meshes::two_boxes();
  mesh.source_dimensions = {2, 1, 2};
  mesh.transfer = {};
  Connections& c = mesh.connections;
  c.cells.push_back({CellId(0), CellId(1)});
  c.face.push_back(FaceId());
  c.kind.push_back(ConnectionKind::pinch_out);
  c.kind[ConnectionId(0)] = ConnectionKind::face;
  EXPECT_EQ(sizes(mesh).at("gap"), 2U);  // both cells of the connection
  c.kind[ConnectionId(1)] = ConnectionKind::deck_nnc;
  EXPECT_EQ(sizes(mesh).at("inactive"), 2U);
}

TEST(BoundaryPatches, TellAGapWhereCellsTouchAndAreNotConnected) {
  // Two cells, one on the other, of which the one below is source cell (1,1,3): a layer without thickness between them.
  Mesh mesh = meshes::twisted_box();
  mesh.source_dimensions = {1, 1, 3};
  mesh.cells.kind[CellId(1)] = CellKind::host;
  mesh.cells.source_cell[CellId(1)] = HostCellId(2);
  mesh.transfer = {};
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    auto& [a, b] = mesh.faces.cells[FaceId(f)];
    if (!b.is_valid()) continue;
    const auto loop = mesh.faces.loop(FaceId(f));
    const std::vector<VertexId> turned(loop.rbegin(), loop.rend());
    const CellId below = b;
    b = no_cell;
    mesh.faces.add(turned, below, no_cell);
    break;
  }
  mesh.connections = {};
  const Sizes expected{{"gap", 2}, {"i_min", 2}, {"i_max", 2}, {"j_min", 2}, {"j_max", 2}, {"k_min", 1}, {"k_max", 1}};
  EXPECT_EQ(sizes(mesh), expected);
}

TEST(BoundaryPatches, HaveABoreAWellAndSidesForMadeCells) {
  // 8 sectors x 2 layers of bore wall; the tops and bases of 24 made and 8 host cells; 3 columns x 2 layers a side.
  Mesh mesh = meshes::ring_in_boxes();
  const Sizes around{{"i_min", 6}, {"i_max", 6}, {"j_min", 6}, {"j_max", 6}, {"bore_P", 16}};
  Sizes expected = around;
  expected.insert({{"k_min", 8}, {"k_max", 8}, {"other", 48}});  // the mesh does not say what the made cells replaced
  EXPECT_EQ(sizes(mesh), expected);

  // Now it does: the column (1,1), cells 4 and 13.
  mesh.transfer.start.assign(19, 0);
  for (std::size_t s = 0; s < 18; ++s) {
    mesh.transfer.start[s + 1] = mesh.transfer.start[s];
    if (s != 4 && s != 13) continue;
    for (std::size_t c = 0; c < 24; ++c) mesh.transfer.cell.emplace_back(c + (s == 13 ? 32 : 0));
    mesh.transfer.start[s + 1] += 24;
  }
  expected = around;
  expected.insert({{"k_min", 32}, {"k_max", 32}});
  EXPECT_EQ(sizes(mesh), expected);
}

TEST(BoundaryPatches, CountTheEndOfABoreAsTheBore) {
  // A face with the wall's vertices alone: as if a cell below closed the bore.
  Mesh mesh = meshes::ring_in_boxes();
  std::vector<VertexId> end;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3& p = mesh.vertices[VertexId(v)];
    if (p.z() == 1510.0 && std::hypot(p.x(), p.y()) < 0.51) end.emplace_back(v);
  }
  ASSERT_EQ(end.size(), 8U);
  mesh.faces.add(end, CellId(60), no_cell);
  EXPECT_EQ(sizes(mesh).at("bore_P"), 17U);
}

TEST(PlainWords, KeepWhatFitsAndMakeNoTwoEqual) {
  EXPECT_EQ(plain_words({"bore_A-1.x", "a b", "a/b", "1", "", "a_b"}),
            (std::vector<std::string>{"bore_A-1.x", "a_b", "a_b_2", "W1", "W", "a_b_3"}));
}

}  // namespace
}  // namespace wellknit
