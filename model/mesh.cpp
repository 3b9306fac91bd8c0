// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/mesh.h"

namespace wellknit {

PolygonGeometry face_geometry(const Mesh& mesh, FaceId face) {
  std::vector<Vec3> points;
  for (const VertexId v : mesh.faces.loop(face)) points.push_back(mesh.vertices[v]);
  return polygon_geometry(points);
}

}  // namespace wellknit
