// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// check_pflotran.py reads the folders of the test meshes as PFLOTRAN does.

#include "writers/write_pflotran.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "tests/support/meshes.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

class Written {
 public:
  explicit Written(const Mesh& mesh, const PflotranOptions& options = {}) {
    notes = write_pflotran(mesh, folder_.file("out"), options);
  }
  [[nodiscard]] std::string text(const std::string& name) const { return folder_.read("out/" + name); }
  [[nodiscard]] std::set<std::string> files() const {
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path() / "out"))
      if (entry.is_regular_file()) found.insert(entry.path().lexically_relative(folder_.path() / "out").string());
    return found;
  }

  std::vector<std::string> notes;

 private:
  ScratchFolder folder_;
};

/// Two boxes whose numbers have no rounding.
Mesh round_boxes() {
  Mesh mesh = meshes::two_boxes();
  mesh.cells.volume.raw() = {1.0, 2.0};
  for (Vec3& k : mesh.cells.permeability) k = Vec3::Constant(1.5);
  mesh.connections.transmissibility[ConnectionId(0)] = 1.0;
  return mesh;
}

TEST(WritePflotran, WritesTwoBoxesByHand) {
  // T = 1 over 1.5 m with k = 1.5: an area of 1 m2.
  const Written out(round_boxes());
  EXPECT_EQ(out.text("mesh.uge"), "CELLS 2\n1 0.5 0.5 -0.5 1\n2 2 0.5 -0.5 2\nCONNECTIONS 1\n1 2 1 0.5 -0.5 1\n");
  EXPECT_EQ(out.text("regions/i_max.ex"), "CONNECTIONS 1\n2 3 0.5 -0.5 1\n");
  EXPECT_EQ(out.text("wells.csv"), "well,type,cell,well_index_m3,md_from_m,md_to_m,reference_depth_m\n");
  EXPECT_TRUE(out.notes.empty());
}

TEST(WritePflotran, PutsMultipliersIntoTheEffectiveAreaAndNotIntoTheRawOne) {
  Mesh mesh = round_boxes();
  mesh.connections.transmissibility[ConnectionId(0)] = 0.25;
  EXPECT_NE(Written(mesh).text("mesh.uge").find("1 2 1 0.5 -0.5 0.25\n"), std::string::npos);
  const Written raw(mesh, {PflotranGrid::text, AreaKind::raw});
  EXPECT_NE(raw.text("mesh.uge").find("1 2 1 0.5 -0.5 1\n"), std::string::npos);
  EXPECT_EQ(raw.notes.size(), 1U);
}

TEST(WritePflotran, SaysWhichConnectionsItCannotHave) {
  Mesh mesh = round_boxes();
  mesh.cells.permeability[CellId(1)].setZero();
  const Written out(mesh);
  ASSERT_EQ(out.notes.size(), 1U);
  EXPECT_EQ(out.notes[0].substr(0, 13), "1 connections");
}

TEST(WritePflotran, HasAFileForEachWellAndEachSide) {
  const Written out(meshes::box_grid(2));
  EXPECT_EQ(out.files(),
            (std::set<std::string>{"cards.in", "mesh.uge", "properties.h5", "regions/i_max.ex", "regions/i_min.ex",
                                   "regions/j_max.ex", "regions/j_min.ex", "regions/k_max.ex", "regions/k_min.ex",
                                   "regions/well_INJ.vs", "regions/well_PROD.vs", "wells.csv"}));
  for (const std::string& name : out.files()) {
    if (!name.starts_with("regions/")) continue;
    EXPECT_NE(out.text("cards.in").find("FILE " + name), std::string::npos) << name;
  }
  // The injector's column i = j = 0: cells 1 and 5 of 2 x 2 x 2.
  EXPECT_EQ(out.text("regions/well_INJ.vs"), "1\n5\n");
}

TEST(WritePflotran, ReplacesAFormerOutput) {
  const ScratchFolder folder;
  write_pflotran(meshes::ring_in_boxes(), folder.file("out"));
  EXPECT_NO_THROW(write_pflotran(meshes::ring_in_boxes(), folder.file("out"), {PflotranGrid::hdf5, AreaKind::effective},
                                 Overwrite::allow));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out/mesh.uge"));
}

TEST(WritePflotran, GivesTheSameBytesTwice) {
  for (const PflotranGrid grid : {PflotranGrid::text, PflotranGrid::hdf5}) {
    const Written first(meshes::ring_in_boxes(), {grid, AreaKind::effective});
    const Written second(meshes::ring_in_boxes(), {grid, AreaKind::effective});
    for (const std::string& name : first.files()) EXPECT_EQ(first.text(name), second.text(name)) << name;
  }
}

}  // namespace
}  // namespace wellknit
