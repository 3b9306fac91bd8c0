// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What the writers for GEOS, of the wells' lines and of the source grid refuse and say; check_vtu.py has VTK read
/// their files.

#include "writers/write_geos.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/errors.h"
#include "tests/support/grids.h"
#include "tests/support/meshes.h"
#include "tests/support/scratch_folder.h"
#include "writers/write_vtkhdf.h"
#include "writers/write_vtp.h"

namespace wellknit {
namespace {

TEST(WriteGeos, SaysWhatWasSplitAndWhatThatCosts) {
  const ScratchFolder folder;
  EXPECT_TRUE(write_geos(meshes::ring_in_boxes(), folder.file("whole.vtu")).empty());
  GeosOptions options;
  options.most_sides = 4;
  const auto notes = write_geos(meshes::ring_in_boxes(), folder.file("split.vtu"), options);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("16 of 64 cells are split"), std::string::npos) << notes[0];
}

TEST(WriteGeos, SaysThatPiecesHaveNoVolume) {
  const ScratchFolder folder;
  Mesh mesh = meshes::ring_in_boxes();
  // One corner of the square, at the top, goes through the cell's base 5 m below it.
  const auto corner = std::find_if(mesh.vertices.raw().begin(), mesh.vertices.raw().end(),
                                   [](const Vec3& p) { return p == Vec3(4.0, 4.0, 1500.0); });
  ASSERT_NE(corner, mesh.vertices.raw().end());
  corner->z() = 1520.0;
  GeosOptions options;
  options.most_sides = 4;
  const auto notes = write_geos(mesh, folder.file("split.vtu"), options);
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_NE(notes[1].find("have no positive volume, since no point was found that sees all of its cell's faces; GEOS "
                          "refuses them: mend the grid there, or leave the cells out"),
            std::string::npos)
      << notes[1];
}

TEST(WriteGeos, RefusesRegionsThatAreNotWholeNumbers) {
  const ScratchFolder folder;
  Mesh mesh = meshes::box_grid(2);
  mesh.cells.properties["FIPNUM"] = std::vector<double>(mesh.cells.size(), 1.0);
  EXPECT_THROW(write_geos(mesh, folder.file("out.vtu")), InvalidInput);
  mesh.cells.properties["FIPNUM"] = std::vector<std::int32_t>(mesh.cells.size(), -1);
  EXPECT_THROW(write_geos(mesh, folder.file("out.vtu")), InvalidInput);
  EXPECT_EQ(folder.count(), 0U);
}

TEST(WriteVtp, SaysThatThereAreNoWells) {
  const ScratchFolder folder;
  EXPECT_EQ(write_vtp(meshes::two_boxes(), folder.file("none.vtp")).size(), 1U);
  EXPECT_TRUE(write_vtp(meshes::ring_in_boxes(), folder.file("wells.vtp")).empty());
}

TEST(WriteVtkhdf, RefusesAnotherSourceThanTheMeshs) {
  const ScratchFolder folder;
  const Mesh mesh = meshes::box_grid(3);
  const CornerPointGrid other = grids::box({3, 3, 2});
  EXPECT_THROW(write_vtkhdf(mesh, nullptr, folder.file("out.vtkhdf")), InvalidInput);
  EXPECT_THROW(write_vtkhdf(mesh, &other, folder.file("out.vtkhdf")), InvalidInput);
  EXPECT_EQ(folder.count(), 0U);
}

}  // namespace
}  // namespace wellknit
