// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/centre_line.h"

#include <algorithm>
#include <cmath>

#include "model/mesh_topology.h"

namespace wellknit {

namespace {

/// face_geometry() without an allocation a face.
PolygonGeometry geometry_of(const Mesh& mesh, FaceId face) {
  thread_local std::vector<Vec3> buffer;
  return polygon_geometry(face_points(mesh, face, buffer));
}

/// A side shorter than this part of the line would make the other side's permeability mean nothing.
constexpr double least_share = 1e-3;

bool is_inside(double share) { return share >= least_share && share <= 1.0 - least_share; }

double first_share(const Mesh& mesh, ConnectionId connection, const Vec3& from, const Vec3& line) {
  const FaceId face = mesh.connections.face[connection];
  if (face.is_valid()) {
    const PolygonGeometry geometry = geometry_of(mesh, face);
    const double across = line.dot(geometry.area_vector);
    const double share = (geometry.centroid - from).dot(geometry.area_vector) / across;
    if (across != 0.0 && is_inside(share)) return share;
  }
  const auto& [first, second] = mesh.connections.half_distance[connection];
  const double share = first / (first + second);
  return std::isfinite(share) ? std::clamp(share, least_share, 1.0 - least_share) : 0.5;
}

}  // namespace

CentreLine centre_line(const Mesh& mesh, ConnectionId connection) {
  const auto& [a, b] = mesh.connections.cells[connection];
  const Vec3& from = mesh.cells.center[a];
  const Vec3 line = mesh.cells.center[b] - from;
  CentreLine out;
  out.length = line.norm();
  out.first_share = first_share(mesh, connection, from, line);
  out.crossing = from + out.first_share * line;
  if (out.length > 0.0) out.direction = line / out.length;
  return out;
}

double permeability_along(const Vec3& permeability, const Vec3& direction) {
  double resistance = 0.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) continue;
    if (!(permeability[axis] > 0.0)) return 0.0;
    resistance += direction[axis] * direction[axis] / permeability[axis];
  }
  return resistance > 0.0 ? 1.0 / resistance : 0.0;
}

double effective_area(double transmissibility, const CentreLine& line, double first, double second) {
  if (!(first > 0.0) || !(second > 0.0)) return 0.0;
  return transmissibility * line.length * (line.first_share / first + (1.0 - line.first_share) / second);
}

double geometric_factor(const Mesh& mesh, ConnectionId connection) {
  const auto& [a, b] = mesh.connections.cells[connection];
  const Vec3 line = mesh.cells.center[b] - mesh.cells.center[a];
  const double across = mesh.connections.area[connection] * std::abs(mesh.connections.normal[connection].dot(line));
  return across > 0.0 ? across / line.squaredNorm() : 0.0;
}

double boundary_area(const Mesh& mesh, FaceId face, AreaKind kind) {
  const PolygonGeometry geometry = geometry_of(mesh, face);
  if (kind == AreaKind::raw) return geometry.area;
  const Vec3 to_face = geometry.centroid - mesh.cells.center[mesh.faces.cells[face][0]];
  const double length = to_face.norm();
  return length > 0.0 ? std::max(0.0, geometry.area_vector.dot(to_face) / length) : geometry.area;
}

}  // namespace wellknit
