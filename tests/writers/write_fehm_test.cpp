// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// check_text_tables.py reads the folders of the test meshes.

#include "writers/write_fehm.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

struct Written {
  explicit Written(const Mesh& mesh, const FehmOptions& options = {}) {
    notes = write_fehm(mesh, folder.file("out"), options);
  }
  [[nodiscard]] std::string text(const std::string& name) const { return folder.read("out/" + name); }

  ScratchFolder folder;
  std::vector<std::string> notes;
};

Mesh round_boxes() {
  Mesh mesh = meshes::two_boxes();
  mesh.cells.volume.raw() = {1.0, 2.0};
  mesh.cells.pore_volume.raw() = {0.25, 0.25};
  for (Vec3& k : mesh.cells.permeability) k = Vec3(1e-13, 1e-13, 1e-14);
  mesh.connections.transmissibility[ConnectionId(0)] = 1e-13 / 1.5;
  return mesh;
}

TEST(WriteFehm, WritesTwoBoxesByHand) {
  // Rows begin after the 2 + 1 pointers: 3, 5, 7. Both cells have columns 1 and 2; the coefficient is 1 m2 over 1.5 m,
  // the diagonals have the second one, 0; they stand at places 4 and 7.
  const Written out(round_boxes());
  EXPECT_EQ(out.text("mesh.stor"),
            "fehmstor ascir8i4 wellknit sparse matrix of connections\n01/01/1980\n"
            "         2         2         7         1         2\n"
            "  1.000000000000E+00  2.000000000000E+00\n"
            "         3         5         7         1         2\n         1         2\n"
            "         2         1         1         2         0\n         0         0         4         7\n"
            " -6.666666666667E-01  0.000000000000E+00\n");
  EXPECT_EQ(out.text("mesh.fehmn"), "coor\n2\n1 0.5 0.5 -0.5\n2 2 0.5 -0.5\n\nelem\n4 0\n\nstop\n");
  EXPECT_EQ(out.text("perm.macro"), "perm\n1 1 1 1e-13 1e-13 1e-14\n2 2 1 1e-13 1e-13 1e-14\n\nstop\n");
  EXPECT_EQ(out.text("rock.macro"), "rock\n1 1 1 2650 1000 0.25\n2 2 1 2650 1000 0.125\n\nstop\n");
  EXPECT_TRUE(out.notes.empty());
}

TEST(WriteFehm, TakesTheHarmonicMeanOfPermeabilities) {
  Mesh mesh = round_boxes();
  mesh.cells.permeability[CellId(1)] = Vec3::Constant(3e-13);  // mean 2 * 1 * 3 / 4 = 1.5
  EXPECT_NE(Written(mesh).text("mesh.stor").find("-4.444444444444E-01"), std::string::npos);
  const Written raw(mesh, {AreaKind::raw});
  EXPECT_NE(raw.text("mesh.stor").find("-6.666666666667E-01"), std::string::npos);
  EXPECT_EQ(raw.notes.size(), 1U);
  mesh.cells.permeability[CellId(1)].setZero();
  EXPECT_EQ(Written(mesh).notes.size(), 1U);
}

TEST(WriteFehm, GivesTheSameBytesTwice) {
  const Written first(meshes::ring_in_boxes());
  const Written second(meshes::ring_in_boxes());
  for (const std::string_view name : fehm_contents)
    EXPECT_EQ(first.text(std::string(name)), second.text(std::string(name)));
}

}  // namespace
}  // namespace wellknit
