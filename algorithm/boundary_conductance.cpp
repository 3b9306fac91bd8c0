// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/boundary_conductance.h"

namespace wellknit {

double boundary_conductance(const Mesh& mesh, FaceId face) {
  const CellId cell = mesh.faces.cells[face][0];
  const double net = mesh.cells.net_to_gross[cell];
  const Vec3 k = mesh.cells.permeability[cell].cwiseProduct(Vec3(net, net, 1.0));
  const PolygonGeometry geometry = face_geometry(mesh, face);
  const Vec3 d = geometry.centroid - mesh.cells.center[cell];
  const double conductance = geometry.area_vector.dot(k.cwiseProduct(d)) / d.squaredNorm();
  return conductance > 0.0 ? conductance : 0.0;
}

}  // namespace wellknit
