// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The files are parsed here; tests/simulators/check_openfoam.py has OpenFOAM's checkMesh judge whole models.

#include "writers/write_openfoam.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "model/errors.h"
#include "tests/support/meshes.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

/// What follows the head.
std::string body(const std::string& text) { return text.substr(text.find("}\n\n") + 3); }

/// The numbers of a file's list, after their count.
std::vector<double> numbers(const std::string& text) {
  std::string plain = body(text);
  plain = plain.substr(0, plain.rfind(")\n"));
  std::replace(plain.begin(), plain.end(), '(', ' ');
  std::replace(plain.begin(), plain.end(), ')', ' ');
  std::istringstream in(plain);
  std::size_t count = 0;
  in >> count;
  std::vector<double> out;
  for (double value = 0.0; in >> value;) out.push_back(value);
  return out;
}

/// The polyMesh as a reader sees it.
struct PolyMesh {
  std::vector<Vec3> points;
  std::vector<std::vector<std::size_t>> faces;
  std::vector<std::size_t> owner;
  std::vector<std::size_t> neighbour;
};

class Written {
 public:
  explicit Written(const Mesh& mesh) { notes = write_openfoam(mesh, folder_.file("case")); }

  [[nodiscard]] std::string text(const std::string& name) const { return folder_.read("case/" + name); }
  [[nodiscard]] std::string mesh_text(const std::string& name) const { return text("constant/polyMesh/" + name); }
  [[nodiscard]] PolyMesh mesh() const {
    PolyMesh out;
    const std::vector<double> points = numbers(mesh_text("points"));
    for (std::size_t i = 0; i < points.size(); i += 3) out.points.emplace_back(points[i], points[i + 1], points[i + 2]);
    const std::vector<double> faces = numbers(mesh_text("faces"));
    for (std::size_t i = 0; i < faces.size(); i += out.faces.back().size() + 1) {
      out.faces.emplace_back();
      for (std::size_t n = 1; n <= static_cast<std::size_t>(faces[i]); ++n)
        out.faces.back().push_back(static_cast<std::size_t>(faces[i + n]));
    }
    for (const double cell : numbers(mesh_text("owner"))) out.owner.push_back(static_cast<std::size_t>(cell));
    for (const double cell : numbers(mesh_text("neighbour"))) out.neighbour.push_back(static_cast<std::size_t>(cell));
    return out;
  }
  [[nodiscard]] std::size_t count() const { return folder_.count(); }

  std::vector<std::string> notes;

 private:
  ScratchFolder folder_;
};

Mesh with_cells_exchanged(Mesh mesh) {
  for (auto& [a, b] : mesh.faces.cells)
    if (b.is_valid()) std::swap(a, b);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (!mesh.faces.cells[FaceId(f)][1].is_valid()) continue;
    const auto begin = mesh.faces.vertices.begin() + mesh.faces.vertex_start[f];
    std::reverse(begin, mesh.faces.vertices.begin() + mesh.faces.vertex_start[f + 1]);
  }
  return mesh;
}

/// Normals of the file's own frame point from the owner to the neighbour, or out.
void expect_right_orientation(const Mesh& mesh) {
  const PolyMesh poly = Written(mesh).mesh();
  ASSERT_EQ(poly.faces.size(), mesh.faces.size());
  const auto up = [](const Vec3& p) { return Vec3(p.x(), p.y(), -p.z()); };
  for (std::size_t f = 0; f < poly.faces.size(); ++f) {
    std::vector<Vec3> loop;
    for (const std::size_t v : poly.faces[f]) loop.push_back(poly.points.at(v));
    const PolygonGeometry face = polygon_geometry(loop);
    const Vec3 from = up(mesh.cells.centroid[CellId(poly.owner[f])]);
    const bool is_inner = f < poly.neighbour.size();
    const Vec3 to = is_inner ? up(mesh.cells.centroid[CellId(poly.neighbour[f])]) : face.centroid;
    EXPECT_GT(face.area_vector.dot(to - from), 0.0) << f;
    EXPECT_TRUE(!is_inner || poly.owner[f] < poly.neighbour[f]) << f;
  }
}

TEST(WriteOpenFoam, WritesTwoBoxesByHand) {
  // Points 0-5 at depth 0 and 6-11 at depth 1: (0,0), (1,0), (1,1), (0,1), (3,0), (3,1) each. One inner face, at x = 1,
  // then a face of each box for every side, the first box first.
  const Written out(meshes::two_boxes());
  EXPECT_EQ(body(out.mesh_text("owner")), "11\n(\n0\n0\n1\n0\n1\n0\n1\n0\n1\n0\n1\n)\n");
  EXPECT_EQ(body(out.mesh_text("neighbour")), "1\n(\n1\n)\n");
  EXPECT_EQ(numbers(out.mesh_text("points")).size(), 36U);
  EXPECT_EQ(body(out.mesh_text("points")).substr(0, 28), "12\n(\n(0 0 0)\n(1 0 0)\n(1 1 0)");
  EXPECT_NE(out.mesh_text("points").find("(3 1 -1)"), std::string::npos);

  std::vector<std::size_t> inner = out.mesh().faces[0];
  std::rotate(inner.begin(), std::find(inner.begin(), inner.end(), 1U), inner.end());
  // Seen from the second box, with z up: (1,0,0), (1,0,-1), (1,1,-1), (1,1,0) turns against the clock.
  EXPECT_EQ(inner, (std::vector<std::size_t>{1, 7, 8, 2}));

  std::string boundary = "6\n(\n";
  int start = 1;
  for (const auto& [name, count] :
       {std::pair("i_min", 1), {"i_max", 1}, {"j_min", 2}, {"j_max", 2}, {"k_min", 2}, {"k_max", 2}}) {
    boundary +=
        fmt::format("    {}\n    {{\n        type            patch;\n        nFaces          {};\n", name, count);
    boundary += fmt::format("        startFace       {};\n    }}\n", start);
    start += count;
  }
  EXPECT_EQ(body(out.mesh_text("boundary")), boundary + ")\n");
}

TEST(WriteOpenFoam, TurnsEveryFaceFromOwnerToNeighbourWithHeightUp) {
  for (const Mesh& mesh : {meshes::two_boxes(), meshes::box_grid(3), meshes::ring_in_boxes(), meshes::twisted_box()}) {
    expect_right_orientation(mesh);
    expect_right_orientation(with_cells_exchanged(mesh));  // the second cell is the owner
  }
}

TEST(WriteOpenFoam, OrdersInnerFacesByOwnerAndNeighbour) {
  for (const Mesh& mesh : {meshes::box_grid(4), meshes::ring_in_boxes()}) {
    const PolyMesh poly = Written(mesh).mesh();
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t f = 0; f < poly.neighbour.size(); ++f) pairs.emplace_back(poly.owner[f], poly.neighbour[f]);
    EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
    EXPECT_EQ(poly.neighbour.size(),
              mesh.connections.size() -
                  static_cast<std::size_t>(std::count_if(mesh.connections.face.begin(), mesh.connections.face.end(),
                                                         [](FaceId face) { return !face.is_valid(); })));
  }
}

TEST(WriteOpenFoam, KeepsEveryDigitAndWritesNoNegativeZero) {
  Mesh mesh = meshes::two_boxes();
  mesh.vertices[VertexId(0)] = Vec3(0.1, 1.0 / 3.0, 0.0);
  mesh.vertices[VertexId(1)] = Vec3(464213.123456789, -5931000.7, 1e-300);
  const Written out(mesh);
  EXPECT_EQ(out.mesh_text("points").find("-0)"), std::string::npos);
  const PolyMesh poly = out.mesh();
  EXPECT_EQ(poly.points[0], Vec3(0.1, 1.0 / 3.0, 0.0));
  EXPECT_EQ(poly.points[1], Vec3(464213.123456789, -5931000.7, -1e-300));
}

TEST(WriteOpenFoam, CountsInTheOwnersNote) {
  EXPECT_NE(Written(meshes::two_boxes()).mesh_text("owner").find("nPoints: 12 nCells: 2 nFaces: 11 nInternalFaces: 1"),
            std::string::npos);
}

TEST(WriteOpenFoam, WritesPermeabilityAsATensorAndThePoreVolumesPorosity) {
  const Mesh mesh = meshes::box_grid(2);
  const Written out(mesh);
  const std::vector<double> k = numbers(out.text("0/K").replace(0, out.text("0/K").find("<tensor>") + 8, "}\n\n"));
  const std::vector<double> porosity =
      numbers(out.text("0/porosity").replace(0, out.text("0/porosity").find("<scalar>") + 8, "}\n\n"));
  ASSERT_EQ(k.size(), 9 * mesh.cells.size());
  ASSERT_EQ(porosity.size(), mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_EQ(k[9 * c + 4 * axis], mesh.cells.permeability[CellId(c)][static_cast<Eigen::Index>(axis)]);
    EXPECT_EQ(k[9 * c + 1], 0.0);
    EXPECT_EQ(porosity[c], mesh.cells.pore_volume[CellId(c)] / mesh.cells.volume[CellId(c)]);
  }
}

TEST(WriteOpenFoam, HasZonesForTheKindsOfCellsAndForFaults) {
  Mesh mesh = meshes::ring_in_boxes();
  mesh.connections.kind[ConnectionId(0)] = ConnectionKind::fault;
  const Written out(mesh);
  const std::string zones = body(out.mesh_text("cellZones"));
  // 8 host, 8 transition and 16 radial cells in each of two layers.
  EXPECT_EQ(zones.substr(0, 4), "3\n(\n");
  EXPECT_NE(zones.find("host\n{\n    type cellZone;\n    cellLabels List<label>\n16\n(\n24\n"), std::string::npos);
  EXPECT_NE(zones.find("transition\n{\n    type cellZone;\n    cellLabels List<label>\n16\n(\n16\n"),
            std::string::npos);
  EXPECT_NE(zones.find("radial_P\n{\n    type cellZone;\n    cellLabels List<label>\n32\n(\n0\n"), std::string::npos);
  const std::string fault = body(out.mesh_text("faceZones"));
  EXPECT_NE(fault.find("faceLabels List<label>\n1\n(\n"), std::string::npos);
  EXPECT_NE(fault.find("flipMap List<bool> 1{0};"), std::string::npos);
}

TEST(WriteOpenFoam, SaysWhatIsLeftOut) {
  // The NNC of box_grid, with a multiplier of one half.
  EXPECT_EQ(Written(meshes::box_grid(2)).notes,
            (std::vector<std::string>{"1 connections without a face (NNC, pinch-outs) are not in the polyMesh",
                                      "multipliers of 1 connections are not in the OpenFOAM case"}));
  EXPECT_TRUE(Written(meshes::two_boxes()).notes.empty());
}

TEST(WriteOpenFoam, WritesOnlyWhatTheListOfContentsNames) {
  const ScratchFolder folder;
  Mesh mesh = meshes::ring_in_boxes();
  mesh.connections.kind[ConnectionId(0)] = ConnectionKind::fault;
  write_openfoam(mesh, folder.file("case"));
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.file("case")))
    if (entry.is_regular_file()) found.insert(entry.path().lexically_relative(folder.file("case")).string());
  std::set<std::string> expected(openfoam_contents.begin(), openfoam_contents.end());
  expected.erase("constant/polyMesh/sets/");  // checkMesh's
  EXPECT_EQ(found, expected);
  EXPECT_NO_THROW(write_openfoam(mesh, folder.file("case"), Overwrite::allow));
}

TEST(WriteOpenFoam, GivesTheSameBytesTwice) {
  const Written first(meshes::ring_in_boxes());
  const Written second(meshes::ring_in_boxes());
  for (const std::string_view name : openfoam_contents) {
    if (name.back() == '/' || name == "constant/polyMesh/faceZones") continue;
    EXPECT_EQ(first.text(std::string(name)), second.text(std::string(name))) << name;
  }
}

}  // namespace
}  // namespace wellknit
