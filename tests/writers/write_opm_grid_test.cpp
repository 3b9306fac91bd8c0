// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// check_opm_grid.py has OPM's own read_grid() read the test meshes.

#include "writers/write_opm_grid.h"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/meshes.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

std::string written(const Mesh& mesh, const OpmGridOptions& options = {}) {
  const ScratchFolder folder;
  write_opm_grid(mesh, folder.file("out"), options);
  return folder.read("out");
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(WriteOpmGrid, WritesTwoBoxesByHand) {
  Mesh mesh = meshes::two_boxes();
  mesh.cells.volume.raw() = {1.0, 2.0};  // without the rounding of their sums
  const std::vector<std::string> lines = lines_of(written(mesh));
  // 11 quadrilaterals, 6 faces a cell. Lines: 3 of sizes, 12 points, 12 starts, 11 loops, 11 pairs, 11 areas, 11
  // centroids, 11 normals, 3 starts, 2 lists of faces, 2 global cells, 2 volumes, 2 centres.
  ASSERT_EQ(lines.size(), 93U);
  EXPECT_EQ(lines[0], "3 2 11 12 44 12");
  EXPECT_EQ(lines[1], "0 1");
  EXPECT_EQ(lines[2], "2 1 1");
  EXPECT_EQ(lines[3], "0 0 0");
  EXPECT_EQ(lines[14], "3 1 1");  // depth down, as it is
  EXPECT_EQ(lines[15], "0");
  EXPECT_EQ(lines[26], "44");
  EXPECT_EQ(lines[87], "0");
  EXPECT_EQ(lines[88], "1");
  EXPECT_EQ(lines[89], "1");
  EXPECT_EQ(lines[90], "2");
  EXPECT_EQ(lines[91], "0.5 0.5 0.5");
  EXPECT_EQ(lines[92], "2 0.5 0.5");
  for (std::size_t face = 0; face < 11; ++face) {
    if (lines[38 + face] != "0 1") continue;  // the inner one, at x = 1
    EXPECT_EQ(lines[49 + face], "1");
    EXPECT_EQ(lines[60 + face], "1 0.5 0.5");
    EXPECT_EQ(lines[71 + face], "1 0 0");
    return;
  }
  FAIL() << "no face between the boxes";
}

TEST(WriteOpmGrid, HasPressurePointsOrCentroids) {
  Mesh mesh = meshes::two_boxes();
  mesh.cells.center[CellId(1)] = Vec3(1.75, 0.5, 0.25);
  EXPECT_EQ(lines_of(written(mesh)).back(), "1.75 0.5 0.25");
  EXPECT_EQ(lines_of(written(mesh, {CellPoint::centroid})).back(), "2 0.5 0.5");
}

TEST(WriteOpmGrid, SaysWhatIsLeftOut) {
  const ScratchFolder folder;
  EXPECT_TRUE(write_opm_grid(meshes::two_boxes(), folder.file("a")).empty());
  EXPECT_EQ(write_opm_grid(meshes::box_grid(2), folder.file("b")),
            (std::vector<std::string>{"1 connections without a face (NNC, pinch-outs) are not in the OPM grid",
                                      "multipliers of 1 connections are not in the OPM grid"}));
}

TEST(WriteOpmGrid, GivesTheSameBytesTwice) {
  EXPECT_EQ(written(meshes::ring_in_boxes()), written(meshes::ring_in_boxes()));
}

}  // namespace
}  // namespace wellknit
