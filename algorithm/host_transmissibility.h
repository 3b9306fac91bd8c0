// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Half-transmissibilities of corner-point cells as simulators compute them (NEWTRAN).
#pragma once

#include "algorithm/host_mesh.h"

namespace wellknit {

/// Centre of a corner-point cell as simulators take it: the mean of its eight corners.
Vec3 host_cell_center(const CornerPointGrid& grid, HostCellId cell);

/// Half-transmissibility, m3, of `cell` through a face (or part of one) normal to `axis`:
/// k_axis * ntg (lateral faces only) * |A . d| / d^2, with d from the cell's centre to the mean of the four corners of
/// the cell's own whole face on that side (high_side: the face towards larger i, j or k), and A the area vector of the
/// part. 0 where the cell has no permeability.
double host_half_transmissibility(const CornerPointGrid& grid, HostCellId cell, Axis axis, bool high_side,
                                  const Vec3& area_vector);

/// Area vector, m2, of a host face as simulators take it, for the function above: of its whole loop for lateral faces;
/// for tops and bases of the four corners alone, since crossings on their edges lie off the straight line where pillars
/// are skew.
Vec3 host_face_area_vector(const HostMesh& mesh, FaceId face);

}  // namespace wellknit
