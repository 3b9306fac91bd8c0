// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/mesh_topology.h"

namespace wellknit {

CellFaces faces_of_cells(const Mesh& mesh) {
  CellFaces out;
  out.start.assign(mesh.cells.size() + 1, 0);
  for (const auto& pair : mesh.faces.cells)
    for (const CellId cell : pair)
      if (cell.is_valid()) ++out.start[cell.index() + 1];
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) out.start[c + 1] += out.start[c];

  out.faces.resize(static_cast<std::size_t>(out.start.back()));
  std::vector<std::int64_t> next(out.start.begin(), out.start.end() - 1);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& pair = mesh.faces.cells[FaceId(f)];
    for (std::size_t side = 0; side < 2; ++side)
      if (pair[side].is_valid())
        out.faces[static_cast<std::size_t>(next[pair[side].index()]++)] = {FaceId(f), side == 0};
  }
  return out;
}

std::span<const Vec3> face_points(const Mesh& mesh, FaceId face, std::vector<Vec3>& buffer) {
  buffer.clear();
  for (const VertexId v : mesh.faces.loop(face)) buffer.push_back(mesh.vertices[v]);
  return buffer;
}

IdVector<FaceId, PolygonGeometry> all_face_geometries(const Mesh& mesh) {
  IdVector<FaceId, PolygonGeometry> out(mesh.faces.size());
  std::vector<Vec3> buffer;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    out[FaceId(f)] = polygon_geometry(face_points(mesh, FaceId(f), buffer));
  return out;
}

double fan_volume6(std::span<const Vec3> loop, const Vec3& mean, const Vec3& point) {
  double sum = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3& p = loop[i];
    const Vec3& q = loop[(i + 1) % loop.size()];
    sum += (mean - point).dot((p - point).cross(q - point));
  }
  return sum;
}

}  // namespace wellknit
