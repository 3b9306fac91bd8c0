// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The XML head is looked at here; check_vtu.py has VTK read the files.

#include "writers/write_vtu.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/meshes.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

std::string written(const Mesh& mesh) {
  const ScratchFolder folder;
  write_vtu(mesh, folder.file("out.vtu"));
  return folder.read("out.vtu");
}

/// The appended array of this name, as values of type T.
template <class T>
std::vector<T> array(const std::string& file, const std::string& name) {
  const std::size_t element = file.find("Name=\"" + name + "\"");
  if (element == std::string::npos) throw std::runtime_error("no array " + name);
  const std::size_t offset = std::stoul(file.substr(file.find("offset=\"", element) + 8));
  const std::size_t start =
      file.find("<AppendedData encoding=\"raw\">\n_") + std::strlen("<AppendedData encoding=\"raw\">\n_") + offset;
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, &file[start], sizeof bytes);
  std::vector<T> values(bytes / sizeof(T));
  std::memcpy(values.data(), &file[start + sizeof bytes], bytes);
  return values;
}

TEST(WriteVtu, HasTheHeadThatEveryVtkReads) {
  const std::string file = written(meshes::two_boxes());
  EXPECT_NE(
      file.find(
          "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">"),
      std::string::npos);
  EXPECT_NE(file.find("<Piece NumberOfPoints=\"12\" NumberOfCells=\"2\">"), std::string::npos);
}

TEST(WriteVtu, TurnsDepthIntoHeight) {
  const std::vector<double> points = array<double>(written(meshes::two_boxes()), "Points");
  ASSERT_EQ(points.size(), 36U);
  for (std::size_t i = 2; i < points.size(); i += 3) {
    EXPECT_TRUE(points[i] == 0.0 || points[i] == -1.0) << points[i];
    EXPECT_FALSE(points[i] == 0.0 && std::signbit(points[i])) << "a negative zero";
  }
}

TEST(WriteVtu, WritesHostCellsAsHexahedraAndOthersAsPolyhedra) {
  const Mesh mesh = meshes::ring_in_boxes();
  const std::vector<std::uint8_t> types = array<std::uint8_t>(written(mesh), "types");
  ASSERT_EQ(types.size(), 64U);
  // In each layer of 32: 16 radial and 8 transition cells, then hosts, of which those at the corners have six quads and
  // the others two hexagons and eight sides.
  for (std::size_t c = 0; c < 64; ++c) EXPECT_EQ(types[c], c % 32 >= 24 && c % 2 == 0 ? 12 : 42) << c;
}

TEST(WriteVtu, CarriesEveryProperty) {
  const Mesh mesh = meshes::box_grid(2);
  const std::string file = written(mesh);
  EXPECT_EQ(array<std::int32_t>(file, "FIPNUM"),
            std::get<std::vector<std::int32_t>>(mesh.cells.properties.at("FIPNUM")));
  EXPECT_EQ(array<double>(file, "SWAT"), std::get<std::vector<double>>(mesh.cells.properties.at("SWAT")));
  EXPECT_EQ(array<double>(file, "pore_volume"),
            std::vector<double>(mesh.cells.pore_volume.begin(), mesh.cells.pore_volume.end()));
}

TEST(WriteVtu, GivesTheCentringOfABox) {
  // The first box is the unit cube, its centre half an edge from each face: 0.5 / cbrt(1). The second is 2 x 1 x 1: 0.5
  // / cbrt(2).
  const std::vector<double> centring = array<double>(written(meshes::two_boxes()), "centring");
  ASSERT_EQ(centring.size(), 2U);
  EXPECT_NEAR(centring[0], 0.5, 1e-14);
  EXPECT_NEAR(centring[1], 0.5 / std::cbrt(2.0), 1e-14);
}

TEST(WriteVtu, EscapesPropertyNames) {
  Mesh mesh = meshes::two_boxes();
  mesh.cells.properties["A<B&\"C"] = std::vector<std::int32_t>{1, 2};
  EXPECT_NE(written(mesh).find("Name=\"A&lt;B&amp;&quot;C\""), std::string::npos);
}

TEST(WriteVtu, GivesTheSameBytesTwice) {
  EXPECT_EQ(written(meshes::ring_in_boxes()), written(meshes::ring_in_boxes()));
}

}  // namespace
}  // namespace wellknit
