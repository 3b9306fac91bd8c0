// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Cells as tetrahedra, pyramids, hexahedra and prisms, for simulators that take no general polyhedra.
#pragma once

#include <cstddef>
#include <vector>

#include "model/mesh.h"
#include "writers/vtk_cells.h"

namespace wellknit {

/// The angle, degrees, between a face's normal and the line between the centroids of its two cells.
struct NonOrthogonality {
  double mean = 0.0;
  double largest = 0.0;
};

/// The pieces fill the cells and meet face to face: a hexahedron, and a prism on any polygon of at most `most_sides`
/// sides, stays whole; every other cell becomes pyramids and tetrahedra around its centre, or a point beside it that
/// sees more, one on each face of three or
/// four vertices and a fan of tetrahedra around the mean of the vertices on each face of more. A prism stays whole only
/// where both of its neighbours beyond its polygons do.
struct SplitCells {
  VtkCells cells;
  std::vector<Vec3> points;         ///< the mesh's vertices, then those added; (x, y, depth)
  std::vector<CellId> mesh_cell;    ///< of each piece
  std::vector<double> volume;       ///< of each piece, m3
  std::size_t cells_split = 0;      ///< of the mesh
  std::size_t pieces = 0;           ///< of these
  std::size_t pieces_inverted = 0;  ///< with no positive volume: a base that no point was found to see
  NonOrthogonality before;          ///< of the mesh's cells, with their centroids
  NonOrthogonality after;           ///< of the pieces
};

inline constexpr std::size_t geos_most_sides = 11;

/// The mesh's structure must be right (check_structure()).
SplitCells split_cells(const Mesh& mesh, std::size_t most_sides = geos_most_sides);

}  // namespace wellknit
