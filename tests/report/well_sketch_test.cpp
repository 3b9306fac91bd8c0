// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/well_sketch.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace wellknit {
namespace {

/// The first cell of a kind.
CellId cell_of(const Mesh& mesh, CellKind kind) {
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (mesh.cells.kind[CellId(c)] == kind) return CellId(c);
  return {};
}

TEST(WellSketch, JoinsNeighboursOfOneKind) {
  Mesh mesh = meshes::ring_in_boxes();
  const CellId radial = cell_of(mesh, CellKind::radial);
  const CellId host = cell_of(mesh, CellKind::host);
  ASSERT_EQ(mesh.cells.well[radial], WellId(0));
  mesh.wells[WellId(0)].connections = {{radial, 2.0, {10, 20}},
                                       {radial, 3.0, {10, 20}},
                                       {radial, 4.0, {20, 30}},
                                       {host, 1.0, {35, 40}},
                                       {radial, 5.0, {40, 50}}};
  const std::vector<WellStretch> stretches = stretches_of(mesh, WellId(0));
  ASSERT_EQ(stretches.size(), 3);
  EXPECT_DOUBLE_EQ(stretches[0].range.to, 30.0);
  EXPECT_EQ(stretches[0].cells, 3);
  EXPECT_DOUBLE_EQ(stretches[0].well_index, 9.0);
  EXPECT_EQ(stretches[1].kind, CellKind::host);
  EXPECT_DOUBLE_EQ(stretches[2].range.from, 40.0);
  EXPECT_TRUE(stretches[0].own);
  EXPECT_FALSE(stretches[1].own);
  mesh.cells.well[radial] = WellId(1);  // in another well's tube
  EXPECT_FALSE(stretches_of(mesh, WellId(0))[0].own);
}

TEST(WellSketch, DrawsEveryStretch) {
  MeshWell well;
  well.trajectory = {{0, 100}, {Vec3(0, 0, 1000), Vec3(0, 0, 1100)}};  // vertical: no width in plan
  const std::string svg =
      well_sketch(well, {{{10, 50}, CellKind::radial, true, 1, 1.0}, {{50, 90}, CellKind::host, false, 1, 1.0}});
  EXPECT_NE(svg.find("well-radial"), std::string::npos);
  EXPECT_NE(svg.find("well-index"), std::string::npos);
  EXPECT_NE(svg.find("0 m wide, 100 m high"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(well_sketch(MeshWell{}, {}), "");
}

}  // namespace
}  // namespace wellknit
