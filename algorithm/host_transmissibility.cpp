// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// NEWTRAN, the two-point transmissibility of Eclipse for corner-point cells, as OPM Flow 2022.10 computes it; the
// comparison with Flow's own numbers is in docs/algorithms/host.md. The distance goes to the middle of the cell's whole
// face even where only a part of it is shared: the simulators do so, and it is the same for all parts.

#include "algorithm/host_transmissibility.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wellknit {

namespace {

std::array<Vec3, 8> corner_points(const HostMesh& mesh, HostCellId cell) {
  const auto vertices = mesh.corners_of(cell);
  std::array<Vec3, 8> points;
  for (std::size_t c = 0; c < 8; ++c) points[c] = mesh.vertices[vertices[c]];
  return points;
}

HostRock source_rock(const CornerPointGrid& grid, HostCellId cell) {
  HostRock out;
  for (std::size_t a = 0; a < 3; ++a)
    if (!grid.permeability[a].empty()) out.permeability[a] = grid.permeability[a][cell.index()];
  if (!grid.net_to_gross.empty()) out.net_to_gross = grid.net_to_gross[cell.index()];
  return out;
}

Vec3 scaled(const Vec3& d, double permeability) {
  const double square = d.squaredNorm();
  return square > 0.0 ? Vec3(permeability / square * d) : Vec3::Zero();
}

}  // namespace

bool has_permeability(const CornerPointGrid& grid) {
  return std::any_of(grid.permeability.begin(), grid.permeability.end(), [](const auto& k) { return !k.empty(); });
}

Vec3 host_cell_center(const HostMesh& mesh, HostCellId cell) {
  const auto corners = corner_points(mesh, cell);
  return std::accumulate(corners.begin(), corners.end(), Vec3(Vec3::Zero())) / 8.0;
}

HostRock host_rock(const CornerPointGrid& grid, const HostMesh& mesh, HostCellId cell) {
  if (cell.index() < mesh.source_count()) return source_rock(grid, cell);
  const RefinedCells& refined = mesh.refined;
  const std::size_t number = cell.index() - mesh.source_count();
  const auto begin = static_cast<std::size_t>(refined.piece_start[number]);
  const auto end = static_cast<std::size_t>(refined.piece_start[number + 1]);
  if (end == begin + 1) return source_rock(grid, refined.piece_source[begin]);
  HostRock out;
  out.net_to_gross = 0.0;
  double total = 0.0;
  std::array<double, 3> gross{};
  for (std::size_t p = begin; p < end; ++p) {
    const HostCellId source = refined.piece_source[p];
    if (mesh.exists[source] == 0) continue;
    const double volume = refined.piece_fraction[p] * mesh.volume[source];
    const HostRock rock = source_rock(grid, source);
    total += volume;
    out.net_to_gross += volume * rock.net_to_gross;
    for (std::size_t a = 0; a < 2; ++a) {
      out.permeability[a] += volume * rock.net_to_gross * rock.permeability[a];
      gross[a] += volume * rock.permeability[a];
    }
    out.permeability[2] += volume / rock.permeability[2];  // infinite without permeability: none remains
  }
  if (!(total > 0.0)) return {};
  for (std::size_t a = 0; a < 2; ++a)
    out.permeability[a] = out.net_to_gross > 0.0 ? out.permeability[a] / out.net_to_gross : gross[a] / total;
  out.permeability[2] = total / out.permeability[2];
  out.net_to_gross /= total;
  return out;
}

std::array<Vec3, 3> host_conductances(const std::array<Vec3, 8>& x, const std::array<double, 3>& permeability) {
  // Edges along i, j, k; a mean of four is twice the way from the centre to a face's middle.
  const Vec3 i = (x[1] - x[0]) + (x[3] - x[2]) + (x[5] - x[4]) + (x[7] - x[6]);
  const Vec3 j = (x[2] - x[0]) + (x[3] - x[1]) + (x[6] - x[4]) + (x[7] - x[5]);
  const Vec3 k = (x[4] - x[0]) + (x[5] - x[1]) + (x[6] - x[2]) + (x[7] - x[3]);
  return {scaled(0.125 * i, permeability[0]), scaled(0.125 * j, permeability[1]), scaled(0.125 * k, permeability[2])};
}

double host_half_transmissibility(const CornerPointGrid& grid, const HostMesh& mesh, HostCellId cell, Axis axis,
                                  const Vec3& area_vector) {
  const auto k = host_rock(grid, mesh, cell).effective();
  return std::abs(area_vector.dot(host_conductances(corner_points(mesh, cell), k)[static_cast<std::size_t>(axis)]));
}

Vec3 host_face_area_vector(const HostMesh& mesh, FaceId face) {
  const bool lateral = mesh.faces.axis[face] != Axis::k;
  const auto corners = mesh.corners_of(mesh.faces.cells[face][0]);
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
