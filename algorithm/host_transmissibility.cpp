// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// NEWTRAN, the two-point transmissibility of Eclipse for corner-point cells, as OPM Flow 2022.10 computes it; the
// comparison with Flow's own numbers is in docs/algorithms/host.md. The distance goes to the middle of the cell's whole
// face even where only a part of it is shared: the simulators do so, and it is the same for all parts.

#include "algorithm/host_transmissibility.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace wellknit {

namespace {

Vec3 mean_of_corners(const std::array<Vec3, 8>& corners) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& c : corners) mean += c;
  return mean / 8.0;
}

/// Mean of the four corners whose bit `axis` is set (high side) or not.
Vec3 mean_of_face(const std::array<Vec3, 8>& corners, Axis axis, bool high_side) {
  const std::size_t bit = std::size_t{1} << static_cast<unsigned>(axis);
  Vec3 mean = Vec3::Zero();
  for (std::size_t c = 0; c < 8; ++c)
    if (((c & bit) != 0) == high_side) mean += corners[c];
  return mean / 4.0;
}

}  // namespace

Vec3 host_cell_center(const CornerPointGrid& grid, HostCellId cell) { return mean_of_corners(grid.corners(cell)); }

double host_half_transmissibility(const CornerPointGrid& grid, HostCellId cell, Axis axis, bool high_side,
                                  const Vec3& area_vector) {
  const std::vector<double>& permeability = grid.permeability[static_cast<std::size_t>(axis)];
  if (permeability.empty()) return 0.0;
  const auto corners = grid.corners(cell);
  const Vec3 d = mean_of_face(corners, axis, high_side) - mean_of_corners(corners);
  const double distance2 = d.squaredNorm();
  if (distance2 == 0.0) return 0.0;
  const bool lateral = axis != Axis::k;
  const double ntg = lateral && !grid.net_to_gross.empty() ? grid.net_to_gross[cell.index()] : 1.0;
  return permeability[cell.index()] * ntg * std::abs(area_vector.dot(d)) / distance2;
}

Vec3 host_face_area_vector(const HostMesh& mesh, FaceId face) {
  const bool lateral = mesh.faces.axis[face] != Axis::k;
  const std::span corners(&mesh.corner_vertex[8 * mesh.faces.cells[face][0].index()], 8);
  // Newell's sum: the area vector of a closed loop does not depend on how it is cut into triangles.
  Vec3 first = Vec3::Zero();
  Vec3 last = Vec3::Zero();
  Vec3 doubled = Vec3::Zero();
  bool begun = false;
  for (const VertexId v : mesh.faces.loop(face)) {
    if (!lateral && std::find(corners.begin(), corners.end(), v) == corners.end()) continue;
    if (!begun) first = last = mesh.vertices[v];
    begun = true;
    doubled += (last - first).cross(mesh.vertices[v] - first);
    last = mesh.vertices[v];
  }
  return 0.5 * doubled;
}

}  // namespace wellknit
