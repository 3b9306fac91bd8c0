// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// check_text_tables.py reads the tables of the test meshes.

#include "writers/write_csv.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/meshes.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

TEST(WriteCsv, WritesTwoBoxesByHand) {
  const ScratchFolder folder;
  Mesh mesh = meshes::two_boxes();
  mesh.cells.volume.raw() = {1.0, 2.0};
  mesh.cells.pore_volume.raw() = {0.25, 0.5};
  mesh.cells.porosity.raw() = {0.25, 0.25};
  for (Vec3& k : mesh.cells.permeability) k = Vec3(1e-13, 1e-13, 1e-14);
  mesh.cells.properties["SATNUM"] = std::vector<std::int32_t>{7, 2};
  write_csv(mesh, folder.file("out"));
  EXPECT_EQ(folder.read("out/cells.csv"),
            "cell,kind,x,y,depth,volume_m3,pore_volume_m3,porosity,net_to_gross,kx_m2,ky_m2,kz_m2,source_cell,well,"
            "segment,sector,ring,SATNUM\n"
            "0,host,0.5,0.5,0.5,1,0.25,0.25,1,1e-13,1e-13,1e-14,0,-1,-1,-1,-1,7\n"
            "1,host,2,0.5,0.5,2,0.5,0.25,0.95,1e-13,1e-13,1e-14,1,-1,-1,-1,-1,2\n");
  const std::string connections = folder.read("out/connections.csv");
  EXPECT_EQ(connections.substr(connections.find('\n') + 1, 11), "0,1,face,6.");
  EXPECT_EQ(std::count(connections.begin(), connections.end(), '\n'), 2);
}

TEST(WriteCsv, PutsNamesInQuotesThatNeedThem) {
  const ScratchFolder folder;
  Mesh mesh = meshes::ring_in_boxes();
  mesh.wells[WellId(0)].name = "P, \"old\"";
  write_csv(mesh, folder.file("out"));
  EXPECT_NE(folder.read("out/wells.csv").find("\n\"P, \"\"old\"\"\",producer,"), std::string::npos);
}

TEST(WriteCsv, GivesTheSameBytesTwice) {
  const ScratchFolder folder;
  for (const char* name : {"a", "b"}) write_csv(meshes::ring_in_boxes(), folder.file(name));
  for (const std::string_view name : csv_contents)
    EXPECT_EQ(folder.read("a/" + std::string(name)), folder.read("b/" + std::string(name)));
}

}  // namespace
}  // namespace wellknit
