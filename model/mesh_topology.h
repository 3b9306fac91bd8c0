// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What follows from a mesh's faces: the faces of each cell, and the geometry of all faces at once.
/// Both need a mesh whose indices are in range (check_structure() finds nothing).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/mesh.h"

namespace wellknit {

/// A face as one of its two cells sees it.
struct CellFace {
  FaceId face;
  bool outward = true;  ///< the face's right-hand normal points out of the cell: the cell is the face's first
};

struct CellFaces {
  std::vector<std::int64_t> start{0};  ///< cells + 1 offsets
  std::vector<CellFace> faces;         ///< of one cell in order of their ids

  [[nodiscard]] std::span<const CellFace> of(CellId cell) const {
    const auto begin = static_cast<std::size_t>(start[cell.index()]);
    return {faces.data() + begin, static_cast<std::size_t>(start[cell.index() + 1]) - begin};
  }
};

CellFaces faces_of_cells(const Mesh& mesh);

/// face_geometry() of every face.
IdVector<FaceId, PolygonGeometry> all_face_geometries(const Mesh& mesh);

/// The points of a face's loop, in a buffer that a loop over many faces keeps.
std::span<const Vec3> face_points(const Mesh& mesh, FaceId face, std::vector<Vec3>& buffer);

/// Six times the volume between a point and the face's fan of triangles, positive on the side that the normal leaves.
double fan_volume6(std::span<const Vec3> loop, const Vec3& mean, const Vec3& point);

}  // namespace wellknit
