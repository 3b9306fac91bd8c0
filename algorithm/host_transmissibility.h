// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Half-transmissibilities of corner-point cells as simulators compute them (NEWTRAN).
#pragma once

#include "algorithm/host_mesh.h"

namespace wellknit {

/// Centre of a corner-point cell as simulators take it: the mean of its eight corners, where the host put
/// them.
Vec3 host_cell_center(const HostMesh& mesh, HostCellId cell);

/// False: no transmissibility can be computed.
bool has_permeability(const CornerPointGrid& grid);

/// Rock of a host cell.
struct HostRock {
  std::array<double, 3> permeability{};  ///< of net rock along i, j, k, m2; 0 where not given
  double net_to_gross = 1.0;
  /// As the faces take it: net to gross along i and j.
  [[nodiscard]] std::array<double, 3> effective() const {
    return {permeability[0] * net_to_gross, permeability[1] * net_to_gross, permeability[2]};
  }
};

/// Of a refined cell over several layers: of its existing parts, weighted with their volumes, the arithmetic mean along
/// i and j, the harmonic one along k.
HostRock host_rock(const CornerPointGrid& grid, const HostMesh& mesh, HostCellId cell);

/// By axis: k d / d^2, m, with d from the cell's centre to the middle of its own whole face on the high side; its
/// product with a part's area vector is the half-transmissibility through the part, on either side (the sign apart,
/// since the centre is the middle of two opposite faces' middles). Corners as everywhere, di + 2 dj + 4 dk; exchanging
/// tops and bases changes signs only. 0 where d is 0.
std::array<Vec3, 3> host_conductances(const std::array<Vec3, 8>& corners, const std::array<double, 3>& permeability);

/// Half-transmissibility, m3, of `cell` through a face (or part of one) normal to `axis`:
/// k_axis * ntg (lateral faces only) * |A . d| / d^2, with d from the cell's centre to the mean of the four corners of
/// the cell's own whole face on that side, and A the area vector of the part. 0 where the cell has no permeability.
double host_half_transmissibility(const CornerPointGrid& grid, const HostMesh& mesh, HostCellId cell, Axis axis,
                                  const Vec3& area_vector);

/// Area vector, m2, of a host face as simulators take it, for the function above: of its whole loop for lateral faces;
/// for tops and bases of the four corners alone, since crossings on their edges lie off the straight line where pillars
/// are skew.
Vec3 host_face_area_vector(const HostMesh& mesh, FaceId face);

}  // namespace wellknit
