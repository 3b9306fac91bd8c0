// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/split_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "model/mesh_topology.h"
#include "tests/support/meshes.h"

namespace wellknit {
namespace {

using Ring = std::vector<std::int64_t>;

/// The faces of a piece: rings of points, as VTK numbers a cell's corners.
std::vector<Ring> faces_of_piece(const VtkCells& cells, std::size_t piece) {
  const auto begin = static_cast<std::size_t>(piece == 0 ? 0 : cells.offsets[piece - 1]);
  const auto p = [&](std::size_t corner) { return cells.connectivity[begin + corner]; };
  switch (cells.types[piece]) {
    case vtk_tetrahedron: return {{p(0), p(1), p(3)}, {p(1), p(2), p(3)}, {p(2), p(0), p(3)}, {p(0), p(2), p(1)}};
    case vtk_pyramid:
      return {{p(0), p(3), p(2), p(1)}, {p(0), p(1), p(4)}, {p(1), p(2), p(4)}, {p(2), p(3), p(4)}, {p(3), p(0), p(4)}};
    case vtk_hexahedron:
      return {{p(0), p(4), p(7), p(3)}, {p(1), p(2), p(6), p(5)}, {p(0), p(1), p(5), p(4)},
              {p(3), p(7), p(6), p(2)}, {p(0), p(3), p(2), p(1)}, {p(4), p(5), p(6), p(7)}};
    default: {
      const std::int64_t end = cells.face_offsets[piece];
      std::int64_t at = 0;
      for (std::size_t n = 0; n < piece; ++n) at = std::max(at, cells.face_offsets[n]);
      std::vector<Ring> rings(static_cast<std::size_t>(cells.faces[static_cast<std::size_t>(at++)]));
      for (Ring& ring : rings) {
        ring.resize(static_cast<std::size_t>(cells.faces[static_cast<std::size_t>(at++)]));
        for (std::int64_t& point : ring) point = cells.faces[static_cast<std::size_t>(at++)];
      }
      EXPECT_EQ(at, end);
      return rings;
    }
  }
}

/// Area, outward in the frame with z up, of a face of a piece.
Vec3 area_of(const SplitCells& split, const Ring& ring) {
  std::vector<Vec3> points;
  for (const std::int64_t p : ring) {
    const Vec3& point = split.points[static_cast<std::size_t>(p)];
    points.emplace_back(point.x(), point.y(), -point.z());
  }
  return polygon_geometry(points).area_vector;
}

double outer_area(const Mesh& mesh) {
  double sum = 0.0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (!mesh.faces.cells[FaceId(f)][1].is_valid()) sum += face_geometry(mesh, FaceId(f)).area;
  return sum;
}

/// Pieces fill the cells, turn outwards, and meet face to face.
void expect_sound(const Mesh& mesh, const SplitCells& split) {
  std::vector<double> sum(mesh.cells.size(), 0.0);
  std::map<Ring, std::vector<Vec3>> faces;
  for (std::size_t n = 0; n < split.volume.size(); ++n) {
    EXPECT_GT(split.volume[n], 0.0);
    sum[split.mesh_cell[n].index()] += split.volume[n];
    double volume = 0.0;
    for (Ring ring : faces_of_piece(split.cells, n)) {
      const Vec3 area = area_of(split, ring);
      const Vec3& point = split.points[static_cast<std::size_t>(ring.front())];
      volume += Vec3(point.x(), point.y(), -point.z()).dot(area) / 3.0;  // all faces here are planar
      std::sort(ring.begin(), ring.end());
      faces[ring].push_back(area);
    }
    EXPECT_NEAR(volume, split.volume[n], 1e-9 * mesh.cells.volume[split.mesh_cell[n]] + 1e-12 * 1500.0);
  }
  for (std::size_t c = 0; c < sum.size(); ++c)
    EXPECT_NEAR(sum[c], mesh.cells.volume[CellId(c)], 1e-9 * mesh.cells.volume[CellId(c)]);
  double outer = 0.0;
  for (const auto& [ring, areas] : faces) {
    ASSERT_LE(areas.size(), 2U);
    if (areas.size() == 2)
      EXPECT_LE((areas[0] + areas[1]).norm(), 1e-9 * areas[0].norm());
    else
      outer += areas[0].norm();
  }
  EXPECT_NEAR(outer, outer_area(mesh), 1e-9 * outer);
}

TEST(SplitCells, LeavesBoxesWhole) {
  const Mesh mesh = meshes::box_grid(4);
  const SplitCells split = split_cells(mesh);
  EXPECT_EQ(split.cells_split, 0U);
  EXPECT_EQ(split.volume.size(), mesh.cells.size());
  EXPECT_EQ(split.points.size(), mesh.vertices.size());
  EXPECT_EQ(split.after.largest, split.before.largest);
  expect_sound(mesh, split);
}

/// In both layers the four transition cells in the square's corners are prisms on five sides, and the four host cells
/// beside the square, whose side is three faces, on six.
TEST(SplitCells, MakesPyramidsOfCellsWithSplitFaces) {
  const Mesh mesh = meshes::ring_in_boxes();
  EXPECT_EQ(split_cells(mesh).cells_split, 0U);
  const SplitCells split = split_cells(mesh, 4);
  EXPECT_EQ(split.cells_split, 16U);
  EXPECT_EQ(split.pieces_inverted, 0U);
  EXPECT_EQ(split.volume.size(), mesh.cells.size() - split.cells_split + split.pieces);
  EXPECT_GT(split.after.mean, split.before.mean);
  expect_sound(mesh, split);
}

/// A hexagonal prism of height 1, its faces turned outwards.
Mesh hexagonal_prism(bool with_box_below) {
  Mesh mesh;
  const auto add_ring = [&](double depth) {
    for (int i = 0; i < 6; ++i)
      mesh.vertices.push_back(Vec3(std::cos(i * M_PI / 3.0), std::sin(i * M_PI / 3.0), depth));
  };
  const auto id = [](std::size_t n) { return VertexId(n); };
  add_ring(0.0);
  add_ring(1.0);
  if (with_box_below) mesh.vertices.push_back(Vec3(0.0, 0.0, 2.0));  // a pyramid on six sides
  const CellId below = with_box_below ? CellId(1) : no_cell;
  std::vector<VertexId> top;
  std::vector<VertexId> base;
  for (std::size_t i = 0; i < 6; ++i) {
    top.push_back(id(5 - i));
    base.push_back(id(6 + i));
  }
  mesh.faces.add(top, CellId(0), no_cell);
  mesh.faces.add(base, CellId(0), below);
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t next = (i + 1) % 6;
    mesh.faces.add(std::array{id(i), id(next), id(6 + next), id(6 + i)}, CellId(0), no_cell);
    if (with_box_below) mesh.faces.add(std::array{id(6 + i), id(6 + next), id(12)}, below, no_cell);
  }
  const double area = 1.5 * std::sqrt(3.0);
  const auto add_cell = [&](double depth, double volume) {
    mesh.cells.kind.push_back(CellKind::transition);
    mesh.cells.center.push_back(Vec3(0.0, 0.0, depth));
    mesh.cells.centroid.push_back(Vec3(0.0, 0.0, depth));
    mesh.cells.volume.push_back(volume);
  };
  add_cell(0.5, area);
  if (with_box_below) add_cell(1.25, area / 3.0);
  return mesh;
}

TEST(SplitCells, LeavesPrismsWholeUpToTheMostSides) {
  const Mesh mesh = hexagonal_prism(false);
  const SplitCells whole = split_cells(mesh, 6);
  EXPECT_EQ(whole.cells_split, 0U);
  expect_sound(mesh, whole);
  const SplitCells split = split_cells(mesh, 5);
  EXPECT_EQ(split.cells_split, 1U);
  EXPECT_EQ(split.pieces, 6U + 2U * 6U);  // pyramids on the sides, a fan on each polygon
  expect_sound(mesh, split);
}

TEST(SplitCells, SplitsAPrismWhoseNeighbourIsSplit) {
  const Mesh mesh = hexagonal_prism(true);
  const SplitCells split = split_cells(mesh);
  EXPECT_EQ(split.cells_split, 2U);
  EXPECT_EQ(split.points.size(), mesh.vertices.size() + 2 + 2);  // two centres and the middles of two polygons
  expect_sound(mesh, split);
}

}  // namespace
}  // namespace wellknit
