// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// check_text_tables.py reads the files of the test meshes.

#include "writers/write_dgf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/support/meshes.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

TEST(WriteDgf, WritesTwoBoxesByHand) {
  const ScratchFolder folder;
  const std::vector<std::string> notes = write_dgf(meshes::two_boxes(), folder.file("out"));
  std::istringstream in(folder.read("out"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  // 12 points, 11 quadrilaterals, 2 cells of 6 faces that share one.
  ASSERT_EQ(lines.size(), 2U + 12 + 2 + 11 + 2 + 2 + 1);
  EXPECT_EQ(lines[0] + lines[1] + lines[2], "DGFVertex0 0 0");
  EXPECT_EQ(lines[13], "3 1 1");
  EXPECT_EQ(lines[14] + lines[15], "#Polygon");
  EXPECT_EQ(std::count(lines[16].begin(), lines[16].end(), ' '), 3);
  EXPECT_EQ(lines[27] + lines[28], "#Polyhedron");
  EXPECT_EQ(std::count(lines[29].begin(), lines[29].end(), ' '), 5);
  EXPECT_EQ(lines[31], "#");
  EXPECT_TRUE(notes.empty());
}

TEST(WriteDgf, SaysWhatIsLeftOutAndGivesTheSameBytesTwice) {
  const ScratchFolder folder;
  EXPECT_EQ(write_dgf(meshes::box_grid(2), folder.file("a")).size(), 2U);
  write_dgf(meshes::box_grid(2), folder.file("b"));
  EXPECT_EQ(folder.read("a"), folder.read("b"));
}

}  // namespace
}  // namespace wellknit
