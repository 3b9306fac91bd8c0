// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// tests/cli has the program describe what it has written itself.

#include "readers/exported_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "readers/describe.h"
#include "readers/formats.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

struct Sample {
  const char* format;
  std::string text;
  std::array<std::int64_t, 4> counts;  ///< cells, faces, vertices, connections; -1: not known
};

/// Two boxes, as far as a format's head goes.
std::vector<Sample> samples() {
  return {{"OPM grid text", "3 2 11 12 44 12\n0 1\n2 1 1\n0 0 0\n", {2, 11, 12, -1}},
          {"MATLAB file", "MATLAB 5.0 MAT-file, created by", {-1, -1, -1, -1}},
          {"PFLOTRAN grid", "CELLS 2\n1 0 0 0 1\n2 1 0 0 1\nCONNECTIONS 1\n1 2 0 0 0 1\n", {2, -1, -1, 1}},
          {"TOUGH mesh", "ELEME----1\nAAA10\nAAA11\n\nCONNE----1\nAAA10AAA11\n\n", {2, -1, -1, 1}},
          {"open-DARTS arrays",
           std::string("PK\x03\x04") + std::string(26, '\0') + "block_m.npy....{'shape': (7,), }",
           {-1, -1, -1, 7}},
          {"AD-GPRS connections", "TPFACONNSN\n1\n0 1 2 3\n/\n", {-1, -1, -1, 1}},
          {"cell table", "cell,kind,x,y,depth,volume\n0,host\n1,host\n", {2, -1, -1, -1}},
          {"connection table", "first,second,kind,t\n0,1,face,2\n", {-1, -1, -1, 1}},
          {"VTU",
           "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\">\n<Piece NumberOfPoints=\"12\" "
           "NumberOfCells=\"2\">",
           {2, -1, 12, -1}},
          {"VTP",
           "<VTKFile type=\"PolyData\">\n<Piece NumberOfPoints=\"5\" NumberOfVerts=\"0\" NumberOfLines=\"1\">",
           {1, -1, 5, -1}},
          {"OpenFOAM labels",
           "FoamFile\n{\n class labelList;\n note \"nPoints: 12 nCells: 2 nFaces: 11 nInternalFaces: 1\";\n}\n",
           {2, 11, 12, -1}},
          {"FEHM coefficients", "fehmstor ascir8i4 x\n01/01/1980\n 2 2 7 1 2\n", {2, -1, -1, 1}},
          {"DGF", "DGF\nVertex\n0 0 0\n1 0 0\n1 1 0\n#\nPolygon\n0 1 2\n#\nPolyhedron\n0\n0\n#\n", {2, 1, 3, -1}}};
}

TEST(ExportedMesh, IsRecognisedByContentAndCounted) {
  for (const Sample& sample : samples()) {
    const ReaderFormat* format = recognise("x", sample.text);
    ASSERT_NE(format, nullptr) << sample.format;
    EXPECT_EQ(format->name, sample.format);
    EXPECT_FALSE(format->is_read);
    const ExportedCounts counts = count_exported_mesh(sample.text);
    EXPECT_EQ(counts.cells.value_or(-1), sample.counts[0]) << sample.format;
    EXPECT_EQ(counts.faces.value_or(-1), sample.counts[1]) << sample.format;
    EXPECT_EQ(counts.vertices.value_or(-1), sample.counts[2]) << sample.format;
    EXPECT_EQ(counts.connections.value_or(-1), sample.counts[3]) << sample.format;
  }
}

TEST(ExportedMesh, IsDescribedThoughItIsNotRead) {
  const ScratchFolder folder;
  folder.write("a", samples()[2].text);
  const FileDescription file = describe_file(folder.file("a"));
  EXPECT_EQ(file.format, "PFLOTRAN grid");
  EXPECT_NE(to_text(file).find("cells         2\nconnections   1\n"), std::string::npos) << to_text(file);
  EXPECT_NE(to_json(file).find("\"exported\""), std::string::npos);
  EXPECT_THROW((void)recognise_file(folder.file("a")), std::exception);
}

TEST(ExportedMesh, TakesEveryTruncationAndDamagedCounts) {
  for (const Sample& sample : samples()) {
    for (std::size_t size = 0; size <= sample.text.size(); ++size)
      EXPECT_NO_THROW((void)count_exported_mesh(std::string_view(sample.text).substr(0, size))) << sample.format;
    std::string damaged = sample.text;
    for (char& c : damaged) {
      const char before = c;
      for (const char other : {'x', '-', '9', '\n', '\0'}) {
        c = other;
        EXPECT_NO_THROW((void)count_exported_mesh(damaged)) << sample.format;
      }
      c = before;
    }
  }
  EXPECT_FALSE(count_exported_mesh("CELLS 99999999999999999999\n").cells);
}

}  // namespace
}  // namespace wellknit
