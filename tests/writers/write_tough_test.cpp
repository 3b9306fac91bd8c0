// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// check_tough.py reads the folders of the test meshes by their columns.

#include "writers/write_tough.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/errors.h"
#include "tests/support/meshes.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

struct Written {
  explicit Written(const Mesh& mesh, const ToughOptions& options = {}) {
    notes = write_tough(mesh, folder.file("out"), options);
  }
  [[nodiscard]] std::string text(const std::string& name) const { return folder.read("out/" + name); }

  ScratchFolder folder;
  std::vector<std::string> notes;
};

TEST(WriteTough, WritesTwoBoxesByHand) {
  Mesh mesh = meshes::two_boxes();
  mesh.cells.volume.raw() = {1.0, 2.0};
  for (Vec3& k : mesh.cells.permeability) k = Vec3(1e-13, 2e-13, 3e-14);
  mesh.connections.transmissibility[ConnectionId(0)] = 1e-13 / 1.5;
  mesh.cells.pore_volume.raw() = {0.1, 0.228};
  // The rock's permeability is the cells', so both modifiers are 1. D1 + D2 = 0.5 + 1 and T = k / 1.5: an area of 1.
  EXPECT_EQ(Written(mesh).text("MESH"),
            "ELEME----1----*----2----*----3----*----4----*----5----*----6----*----7----*----8\n"
            "AAA10          HOST 1.00000000          1.000000000.500000000.50000000-0.5000000\n"
            "AAA11          HOST 2.00000000          1.000000002.000000000.50000000-0.5000000\n"
            "\n"
            "CONNE----1----*----2----*----3----*----4----*----5----*----6----*----7----*----8\n"
            "AAA10AAA11                   10.500000001.000000001.00000000        0.\n"
            "\n");
  // (0.1 + 0.228) / 3 = 0.109333
  EXPECT_EQ(Written(mesh).text("ROCKS").substr(81, 81),
            "HOST      2650.000000.109333331.0000E-132.0000E-133.0000E-142.000000001000.00000\n");
  EXPECT_EQ(Written(mesh).text("names.csv"), "cell,name,porosity\n1,AAA10,0.1\n2,AAA11,0.114\n");
}

TEST(WriteTough, HasAPositiveCosineWhenTheFirstCellIsAbove) {
  Mesh mesh = meshes::two_boxes();
  mesh.cells.center[CellId(1)] = Vec3(2.0, 0.5, 2.5);  // 1.5 across, 2 down: 0.8
  const std::string text = Written(mesh).text("MESH");
  EXPECT_EQ(text.substr(text.size() - 12, 10), "0.80000000");
  EXPECT_EQ(text.substr(text.size() - 43, 1), "3");  // ISOT: the line is closest to the vertical
}

TEST(WriteTough, MakesNamesOfFiveToEightCharacters) {
  for (const int length : {5, 6, 7, 8}) {
    const Written out(meshes::two_boxes(), {length, AreaKind::effective, ""});
    const std::string text = out.text("MESH");
    std::string name = "AAA1" + std::string(static_cast<std::size_t>(length) - 4, '0');
    EXPECT_EQ(text.substr(81, 20), name + std::string(15U - static_cast<std::size_t>(length), ' ') + "HOST ");
    EXPECT_EQ(std::count(out.notes.begin(), out.notes.end(),
                         "names of elements have " + std::to_string(length) +
                             " characters: set MOP2(2) = " + std::to_string(length) + " in MOMOP (iTOUGH2, TOUGH3)"),
              length > 5 ? 1 : 0);
  }
  EXPECT_THROW(Written(meshes::two_boxes(), {4, AreaKind::effective, ""}), InvalidInput);
  EXPECT_THROW(Written(meshes::two_boxes(), {9, AreaKind::effective, ""}), InvalidInput);
}

TEST(WriteTough, RefusesNamesThatAreTooShortForSoManyCells) {
  // Five characters: 26 x 36 x 36 letters and digits with 90 numbers of two digits, 3,032,640 names.
  Mesh mesh = meshes::two_boxes();
  mesh.cells.kind = IdVector<CellId, CellKind>(3'032'641, CellKind::host);
  try {
    const Written out(mesh, {5, AreaKind::effective, ""});
    FAIL() << "written";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "3032641 cells are more than names of 5 characters; take 6");
  }
}

TEST(WriteTough, MakesARockOfEachRegion) {
  Mesh mesh = meshes::two_boxes();
  mesh.cells.properties["SATNUM"] = std::vector<std::int32_t>{7, 2};
  const std::string text = Written(mesh, {0, AreaKind::effective, "SATNUM"}).text("ROCKS");
  EXPECT_EQ(text.substr(81, 5), "R0002");
  EXPECT_EQ(text.substr(162, 5), "R0007");
  const Written other(mesh, {0, AreaKind::effective, "FIPNUM"});
  EXPECT_EQ(other.text("ROCKS").substr(81, 5), "HOST ");
  EXPECT_NE(other.notes.front().find("FIPNUM"), std::string::npos);
}

TEST(WriteTough, ClosesConnectionsOfCellsWithoutPermeability) {
  Mesh mesh = meshes::two_boxes();
  mesh.cells.permeability[CellId(1)].setZero();
  const Written out(mesh);
  EXPECT_EQ(out.notes.front().substr(0, 13), "1 connections");
  EXPECT_NE(out.text("MESH").find("2.00000000          1.0000E-20"), std::string::npos) << out.text("MESH");
}

TEST(WriteTough, GivesTheSameBytesTwice) {
  const Written first(meshes::ring_in_boxes());
  const Written second(meshes::ring_in_boxes());
  for (const std::string_view name : tough_contents)
    EXPECT_EQ(first.text(std::string(name)), second.text(std::string(name)));
}

}  // namespace
}  // namespace wellknit
