// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/mesh_check.h"

#include <gtest/gtest.h>

#include <ctime>
#include <limits>
#include <set>

#include "tests/support/meshes.h"

namespace wellknit {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::string text_of(const std::vector<Violation>& violations) {
  std::string out;
  for (const Violation& v : violations) out += v.entity + ": " + v.check + " (" + v.detail + ")\n";
  return out;
}

bool has(const std::vector<Violation>& violations, const std::string& check, const std::string& entity) {
  for (const Violation& v : violations)
    if (v.check == check && v.entity == entity) return true;
  return false;
}

/// First face with this pair of cells; no_cell for the boundary.
FaceId face_between(const Mesh& mesh, CellId a, CellId b) {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (mesh.faces.cells[FaceId(f)] == std::array{a, b}) return FaceId(f);
  throw std::runtime_error("no such face");
}

void swap_vertices(Mesh& mesh, FaceId face) {
  const auto begin = static_cast<std::size_t>(mesh.faces.vertex_start[face.index()]);
  std::swap(mesh.faces.vertices[begin], mesh.faces.vertices[begin + 1]);
}

void reverse_loop(Mesh& mesh, FaceId face) {
  const auto begin = mesh.faces.vertices.begin() + mesh.faces.vertex_start[face.index()];
  std::reverse(begin, mesh.faces.vertices.begin() + mesh.faces.vertex_start[face.index() + 1]);
}

TEST(MeshCheck, FindsNothingInGoodMeshes) {
  for (const Mesh& mesh : {meshes::two_boxes(), meshes::box_grid(2), meshes::box_grid(5), meshes::ring_in_boxes(),
                           meshes::twisted_box(), Mesh()})
    EXPECT_EQ(text_of(check_mesh(mesh)), "");
}

struct Damage {
  const char* name;
  void (*make)(Mesh& mesh);
  const char* check;
  const char* entity;
};

/// Both damage ring_in_boxes(): cells 0-15 and 32-47 are radial, 16-23 and 48-55 transition, the others host; the
/// injector I is in 24 and 56.
void PrintTo(const Damage& damage, std::ostream* out) { *out << damage.name; }

class StructureDamages : public testing::TestWithParam<Damage> {};
class GeometryDamages : public testing::TestWithParam<Damage> {};

std::string name_of_damage(const testing::TestParamInfo<Damage>& tested) { return tested.param.name; }

TEST_P(StructureDamages, AreNamedAndNothingElseIsComputed) {
  Mesh mesh = meshes::ring_in_boxes();
  GetParam().make(mesh);
  const std::vector<Violation> found = check_structure(mesh);
  EXPECT_TRUE(has(found, GetParam().check, GetParam().entity)) << text_of(found);
  EXPECT_EQ(text_of(check_mesh(mesh)), text_of(found));
}

TEST_P(GeometryDamages, AreNamed) {
  Mesh mesh = meshes::ring_in_boxes();
  GetParam().make(mesh);
  EXPECT_TRUE(check_structure(mesh).empty());
  const std::vector<Violation> found = check_mesh(mesh);
  EXPECT_TRUE(has(found, GetParam().check, GetParam().entity)) << text_of(found);
}

INSTANTIATE_TEST_SUITE_P(
    MeshCheck, StructureDamages,
    testing::Values(Damage{"ShortCellArray", [](Mesh& m) { m.cells.volume.raw().pop_back(); },
                           "array of a wrong length", "cells/volume"},
                    Damage{"LongCellArray", [](Mesh& m) { m.cells.permeability.push_back(Vec3::Zero()); },
                           "array of a wrong length", "cells/permeability"},
                    Damage{"ShortConnectionArray", [](Mesh& m) { m.connections.multiplier.raw().pop_back(); },
                           "array of a wrong length", "connections/multiplier"},
                    Damage{"ShortProperty", [](Mesh& m) { m.cells.properties["SWAT"] = std::vector<double>(3); },
                           "array of a wrong length", "cells/properties/SWAT"},
                    Damage{"FacesWithoutOffsets", [](Mesh& m) { m.faces.vertex_start.pop_back(); },
                           "array of a wrong length", "faces/vertex_start"},
                    Damage{"NoOffsetsAtAll", [](Mesh& m) { m.faces.vertex_start.clear(); }, "array of a wrong length",
                           "faces/vertex_start"},
                    Damage{"OffsetsThatDoNotStartAtZero", [](Mesh& m) { m.faces.vertex_start[0] = 1; },
                           "offsets do not start at 0", "faces/vertex_start"},
                    Damage{"OffsetsThatFall", [](Mesh& m) { m.faces.vertex_start[2] = 1; }, "offsets fall",
                           "faces/vertex_start[2]"},
                    Damage{"OffsetsPastTheEnd", [](Mesh& m) { m.faces.vertex_start.back() += 1; },
                           "offsets do not end at the size of their array", "faces/vertex_start"},
                    Damage{"VertexOutOfRange", [](Mesh& m) { m.faces.vertices[7] = VertexId(m.vertices.size()); },
                           "index out of range", "faces/vertices[7]"},
                    Damage{"FaceWithoutAFirstCell", [](Mesh& m) { m.faces.cells[FaceId(3)][0] = no_cell; },
                           "index out of range", "faces/cells[3]"},
                    Damage{"FaceOfACellThatIsNotThere", [](Mesh& m) { m.faces.cells[FaceId(3)][1] = CellId(64); },
                           "index out of range", "faces/cells[3]"},
                    Damage{"UnknownCellKind", [](Mesh& m) { m.cells.kind[CellId(5)] = CellKind(4); },
                           "kind out of range", "cells/kind[5]"},
                    Damage{"UnknownConnectionKind",
                           [](Mesh& m) { m.connections.kind[ConnectionId(5)] = ConnectionKind(9); },
                           "kind out of range", "connections/kind[5]"},
                    Damage{"SourceCellOutOfRange", [](Mesh& m) { m.cells.source_cell[CellId(24)] = HostCellId(18); },
                           "index out of range", "cells/source_cell[24]"},
                    Damage{"WellOutOfRange", [](Mesh& m) { m.cells.well[CellId(0)] = WellId(2); }, "index out of range",
                           "cells/well[0]"},
                    Damage{"ConnectionOutOfRange", [](Mesh& m) { m.connections.cells[ConnectionId(2)][1] = no_cell; },
                           "index out of range", "connections/cells[2]"},
                    Damage{"ConnectionFaceOutOfRange",
                           [](Mesh& m) { m.connections.face[ConnectionId(2)] = FaceId(m.faces.size()); },
                           "index out of range", "connections/face[2]"},
                    Damage{"WellCellOutOfRange", [](Mesh& m) { m.wells[WellId(1)].connections[0].cell = CellId(64); },
                           "index out of range", "cells of well I[0]"},
                    Damage{"StationWithoutAMeasuredDepth",
                           [](Mesh& m) { m.wells[WellId(1)].trajectory.measured_depth.pop_back(); },
                           "array of a wrong length", "measured depths of well I"},
                    Damage{"TransferWithoutOffsets", [](Mesh& m) { m.transfer.cell.push_back(CellId(0)); },
                           "array of a wrong length", "transfer/start"},
                    Damage{"TransferToACellThatIsNotThere",
                           [](Mesh& m) {
                             m.transfer.start.assign(19, 1);
                             m.transfer.start[0] = 0;
                             m.transfer.cell = {CellId(64)};
                             m.transfer.fraction = {1.0};
                           },
                           "index out of range", "transfer/cell[0]"}),
    name_of_damage);

INSTANTIATE_TEST_SUITE_P(
    MeshCheck, GeometryDamages,
    testing::Values(
        Damage{"VertexNotFinite", [](Mesh& m) { m.vertices[VertexId(3)].y() = not_a_number; }, "value not finite",
               "vertex 3"},
        Damage{"CellValueNotFinite", [](Mesh& m) { m.cells.porosity[CellId(9)] = not_a_number; }, "value not finite",
               "cell 9"},
        Damage{"ConnectionValueNotFinite",
               [](Mesh& m) { m.connections.half_distance[ConnectionId(4)][1] = not_a_number; }, "value not finite",
               "connection 4"},
        Damage{"VertexOfNoFace", [](Mesh& m) { m.vertices.push_back(Vec3::Zero()); }, "vertex of no face",
               "vertex 144"},
        Damage{"RepeatedVertex", [](Mesh& m) { m.faces.vertices[1] = m.faces.vertices[0]; },
               "vertex repeated in a face", "face 0"},
        Damage{"TwoDistinctVertices",
               [](Mesh& m) {
                 m.faces.vertices[2] = m.faces.vertices[0];
                 m.faces.vertices[3] = m.faces.vertices[1];
               },
               "face with fewer than 3 distinct vertices", "face 0"},
        Damage{"OneCellOnBothSides", [](Mesh& m) { m.faces.cells[FaceId(0)][1] = m.faces.cells[FaceId(0)][0]; },
               "face with one cell on both sides", "face 0"},
        Damage{"FaceGivenToAnotherCell", [](Mesh& m) { m.faces.cells[FaceId(0)][0] = CellId(63); },
               "cell not watertight", "cell 63"},
        Damage{"FaceTakenFromACell", [](Mesh& m) { m.faces.cells[FaceId(0)][0] = CellId(63); }, "cell not watertight",
               "cell 0"},
        Damage{"FaceTurnedRound", [](Mesh& m) { reverse_loop(m, face_between(m, CellId(0), CellId(32))); },
               "cell not watertight", "cell 32"},
        Damage{"LoopCrossed", [](Mesh& m) { swap_vertices(m, face_between(m, CellId(0), CellId(32))); },
               "cell not watertight", "cell 0"},
        Damage{"SurfaceOpen", [](Mesh& m) { reverse_loop(m, face_between(m, CellId(0), CellId(32))); }, "open surface",
               "cell 0"},
        Damage{"CellWithoutFaces",
               [](Mesh& m) {
                 for (auto& pair : m.faces.cells)
                   for (CellId& cell : pair)
                     if (cell == CellId(63)) cell = CellId(62);
               },
               "cell without faces", "cell 63"},
        Damage{"CellInsideOut",
               [](Mesh& m) {
                 for (std::size_t f = 0; f < m.faces.size(); ++f)
                   if (m.faces.cells[FaceId(f)][0] == CellId(63) || m.faces.cells[FaceId(f)][1] == CellId(63))
                     reverse_loop(m, FaceId(f));
               },
               "volume not positive", "cell 63"},
        Damage{"StoredVolumeZero", [](Mesh& m) { m.cells.volume[CellId(2)] = 0.0; }, "stored volume not positive",
               "cell 2"},
        Damage{"StoredVolumeOffInAMadeCell", [](Mesh& m) { m.cells.volume[CellId(2)] *= 1.00001; },
               "stored volume differs from the faces'", "cell 2"},
        Damage{"StoredVolumeOffInAHostCell", [](Mesh& m) { m.cells.volume[CellId(30)] *= 1.06; },
               "stored volume differs from the faces'", "cell 30"},
        Damage{"CentreOutside", [](Mesh& m) { m.cells.center[CellId(16)].z() += 3.0; },
               "made cell not seen from its centre", "cell 16"},
        Damage{"ConnectionToItself",
               [](Mesh& m) { m.connections.cells[ConnectionId(0)][1] = m.connections.cells[ConnectionId(0)][0]; },
               "connection of a cell to itself", "connection 0"},
        Damage{"LargerCellFirst",
               [](Mesh& m) {
                 std::swap(m.connections.cells[ConnectionId(0)][0], m.connections.cells[ConnectionId(0)][1]);
               },
               "connection with the larger cell first", "connection 0"},
        Damage{"NegativeTransmissibility", [](Mesh& m) { m.connections.transmissibility[ConnectionId(1)] = -1e-20; },
               "transmissibility negative or not finite", "connection 1"},
        Damage{
            "InfiniteTransmissibility",
            [](Mesh& m) { m.connections.transmissibility[ConnectionId(1)] = std::numeric_limits<double>::infinity(); },
            "transmissibility negative or not finite", "connection 1"},
        Damage{"ConnectionWithoutItsFace", [](Mesh& m) { m.connections.face[ConnectionId(1)] = FaceId(); },
               "connection without its face", "connection 1"},
        Damage{"PairConnectedTwice",
               [](Mesh& m) {
                 for (const int i : {0, 1}) {
                   m.connections.face[ConnectionId(i)] = FaceId();
                   m.connections.cells[ConnectionId(i)] = {CellId(3), CellId(40)};
                 }
               },
               "pair connected twice without a face", "cells 3 and 40"},
        Damage{"ConnectionOfOtherCells", [](Mesh& m) { m.connections.cells[ConnectionId(1)][1] = CellId(63); },
               "connection and face of different cells", "connection 1"},
        Damage{"InnerFaceWithoutAConnection",
               [](Mesh& m) { m.connections.face[ConnectionId(0)] = m.connections.face[ConnectionId(1)]; },
               "inner face without a connection", "face 32"},
        Damage{"FaceConnectedTwice",
               [](Mesh& m) { m.connections.face[ConnectionId(0)] = m.connections.face[ConnectionId(1)]; },
               "face with several connections", "face 33"},
        Damage{"StoredAngleOff", [](Mesh& m) { m.connections.non_orthogonality[ConnectionId(0)] += 0.01; },
               "stored non-orthogonality differs from the face's", "connection 0"},
        Damage{"WellWithoutConnections", [](Mesh& m) { m.wells[WellId(0)].connections.clear(); },
               "well without connections", "well P"},
        Damage{"WellIndexZero", [](Mesh& m) { m.wells[WellId(1)].connections[1].well_index = 0.0; },
               "well index not positive and finite", "well I"},
        Damage{"WellIndexNotFinite", [](Mesh& m) { m.wells[WellId(1)].connections[1].well_index = not_a_number; },
               "well index not positive and finite", "well I"},
        Damage{"FractionsThatDoNotAddUp",
               [](Mesh& m) {
                 m.transfer.start.assign(19, 2);
                 m.transfer.start[0] = 0;
                 m.transfer.cell = {CellId(24), CellId(25)};
                 m.transfer.fraction = {0.5, 0.499};
               },
               "fractions of a source cell do not add up to 1", "source cell 0"}),
    name_of_damage);

TEST(MeshCheck, ListsEveryViolationOfAKind) {
  Mesh mesh = meshes::ring_in_boxes();
  for (double& t : mesh.connections.transmissibility) t = -t;
  EXPECT_EQ(check_mesh(mesh).size(), mesh.connections.size());
}

TEST(MeshCheck, AllowsWhatTheOptionsAllow) {
  Mesh mesh = meshes::ring_in_boxes();
  mesh.cells.volume[CellId(2)] *= 1.00001;
  MeshCheckOptions options;
  options.volume_limit = 1e-4;
  EXPECT_EQ(text_of(check_mesh(mesh, options)), "");
}

TEST(MeshCheck, FindsAnEdgeThatIsUsedTwice) {
  // Two boxes that touch along one edge only, given to one cell: closed, each direction balanced, but not a manifold.
  Mesh mesh = meshes::box_grid(2);
  for (auto& pair : mesh.faces.cells)
    for (CellId& cell : pair)
      if (cell == CellId(3)) cell = CellId(0);
  const std::vector<Violation> found = check_mesh(mesh);
  EXPECT_TRUE(has(found, "edge used more than once in a cell", "cell 0")) << text_of(found);
  EXPECT_FALSE(has(found, "cell not watertight", "cell 0"));
}

TEST(MeshCheck, TakesTimeInProportionToTheCells) {
  // The processor's time: other programs run on the machine.
  const auto ticks = [](const Mesh& mesh) {
    std::clock_t best = std::numeric_limits<std::clock_t>::max();
    for (int repeat = 0; repeat < 3; ++repeat) {
      const std::clock_t start = std::clock();
      EXPECT_TRUE(check_mesh(mesh).empty());
      best = std::min(best, std::clock() - start);
    }
    return best;
  };
  // 27 times the cells, so 27 times the time, up to 5 for caches and noise; a quadratic step would make it 729.
  const std::clock_t small = ticks(meshes::box_grid(8));
  const std::clock_t large = ticks(meshes::box_grid(24));
  EXPECT_LT(large, 27 * 5 * small);
}

}  // namespace
}  // namespace wellknit
