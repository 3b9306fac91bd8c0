// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/mesh_topology.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace wellknit {
namespace {

TEST(MeshTopology, GivesEachCellItsFacesOnce) {
  const Mesh mesh = meshes::two_boxes();
  const CellFaces faces = faces_of_cells(mesh);
  int shared = 0;
  for (const CellId cell : {CellId(0), CellId(1)}) {
    ASSERT_EQ(faces.of(cell).size(), 6U);
    for (const CellFace& side : faces.of(cell)) {
      EXPECT_EQ(mesh.faces.cells[side.face][side.outward ? 0 : 1], cell);
      if (mesh.faces.cells[side.face][1].is_valid()) ++shared;
    }
  }
  EXPECT_EQ(shared, 2);  // the one face between them, from both sides
}

TEST(MeshTopology, OutwardFacesPointAwayFromTheCentre) {
  const Mesh mesh = meshes::ring_in_boxes();
  const CellFaces faces = faces_of_cells(mesh);
  const auto geometry = all_face_geometries(mesh);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (const CellFace& side : faces.of(CellId(c))) {
      const double outward =
          geometry[side.face].area_vector.dot(geometry[side.face].centroid - mesh.cells.center[CellId(c)]);
      EXPECT_GT(side.outward ? outward : -outward, 0.0) << "cell " << c;
    }
}

TEST(MeshTopology, FanVolumesAddUpToTheCell) {
  const Mesh mesh = meshes::two_boxes();
  const CellFaces faces = faces_of_cells(mesh);
  std::vector<Vec3> buffer;
  // The second box is 2 x 1 x 1, seen from a point far outside: signed pyramids still add up to its volume.
  const Vec3 far(-7.0, 11.0, 5.0);
  double volume = 0.0;
  for (const CellFace& side : faces.of(CellId(1))) {
    const auto loop = face_points(mesh, side.face, buffer);
    volume += (side.outward ? 1.0 : -1.0) * fan_volume6(loop, polygon_geometry(loop).mean, far) / 6.0;
  }
  EXPECT_NEAR(volume, 2.0, 1e-13);
}

}  // namespace
}  // namespace wellknit
