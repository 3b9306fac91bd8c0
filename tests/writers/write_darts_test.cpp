// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// check_darts.py has numpy and h5py load the test meshes by the shipped loader.

#include "writers/write_darts.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

TEST(WriteDarts, WritesTwoBoxesAsAdgprsByHand) {
  const ScratchFolder folder;
  Mesh mesh = meshes::two_boxes();
  mesh.cells.volume.raw() = {1.0, 2.0};
  write_adgprs(mesh, folder.file("out"));
  const std::string text = folder.read("out/connections.txt");
  ASSERT_EQ(text.substr(0, 17), "TPFACONNSN\n1\n0 1 ");
  double transmissibility = 0.0;
  double geometric = 0.0;
  ASSERT_EQ(std::sscanf(text.c_str() + 17, "%lf %lf", &transmissibility, &geometric), 2);
  // 100 mD m2 / 1.5 m = 66.6667 mD m, times 0.0085267146719160105; 1 m2 / 1.5 m.
  EXPECT_NEAR(transmissibility, 5.6844764479e-01, 1e-10);
  EXPECT_NEAR(geometric, 2.0 / 3.0, 1e-15);
  EXPECT_EQ(text.substr(text.size() - 3), "\n/\n");
  EXPECT_EQ(folder.read("out/dimens.txt"), "DIMENS\n2 1 1\n/\n");
  EXPECT_EQ(folder.read("out/volume.txt"), "VOLUME\n1\n2\n/\n");
  EXPECT_EQ(folder.read("out/depth.txt"), "DEPTH\n0.5\n0.5\n/\n");
}

TEST(WriteDarts, BeginsWithAStoredArrayOfNumpy) {
  const ScratchFolder folder;
  write_darts(meshes::two_boxes(), folder.file("out"));
  const std::string bytes = folder.read("out");
  EXPECT_EQ(bytes.substr(0, 4), "PK\x03\x04");
  EXPECT_EQ(bytes.substr(8, 2), std::string(2, '\0'));        // stored
  EXPECT_EQ(bytes.substr(10, 4), std::string("\0\0!\0", 4));  // midnight, 1980-01-01
  EXPECT_EQ(bytes.substr(30, 11), "block_m.npy");
  const std::size_t magic = bytes.find("\x93NUMPY");
  ASSERT_NE(magic, std::string::npos);
  EXPECT_EQ(bytes.find("{'descr': '<i4', 'fortran_order': False, 'shape': (1,), }"), magic + 10);
}

TEST(WriteDarts, SaysWhenTheLastCellWouldBeLost) {
  const ScratchFolder folder;
  Mesh mesh = meshes::two_boxes();
  EXPECT_TRUE(write_darts(mesh, folder.file("a")).empty());
  mesh.connections = {};
  EXPECT_EQ(write_darts(mesh, folder.file("b")).size(), 1U);
  EXPECT_EQ(write_darts_hdf5(mesh, folder.file("c")).size(), 1U);
}

TEST(WriteDarts, GivesTheSameBytesTwice) {
  const ScratchFolder folder;
  const Mesh mesh = meshes::ring_in_boxes();
  for (const char* name : {"a", "b"}) {
    write_darts(mesh, folder.file(name + std::string(".npz")));
    write_darts_hdf5(mesh, folder.file(name + std::string(".h5")));
    write_adgprs(mesh, folder.file(name));
  }
  EXPECT_EQ(folder.read("a.npz"), folder.read("b.npz"));
  EXPECT_EQ(folder.read("a.h5"), folder.read("b.h5"));
  for (const std::string_view name : adgprs_contents)
    EXPECT_EQ(folder.read("a/" + std::string(name)), folder.read("b/" + std::string(name)));
}

}  // namespace
}  // namespace wellknit
