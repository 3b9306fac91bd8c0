// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Connections as formats have them that know lengths along the line between two centres and an area across it, and
/// no angles: the area is chosen such that their transmissibility is ours.
#pragma once

#include <cstdint>
#include <vector>

#include "model/mesh.h"

namespace wellknit {

/// The areas that such a format gets.
enum class AreaKind : std::uint8_t {
  effective,  ///< our transmissibility follows from them, with the angles, multipliers and fault parts in it
  raw         ///< the faces' own
};

/// The line from a connection's first centre to its second.
struct CentreLine {
  double length = 0.0;            ///< m
  double first_share = 0.5;       ///< of the length, on the first cell's side of the face; inside (0, 1)
  Vec3 crossing = Vec3::Zero();   ///< where it meets the face's plane, (x, y, depth)
  Vec3 direction = Vec3::Zero();  ///< unit; zero when the centres coincide
};

/// Where the line does not meet the face's plane between the centres, or there is no face, the distances of the
/// centres from the face's centroid share it.
CentreLine centre_line(const Mesh& mesh, ConnectionId connection);

/// Permeability that a tensor has for a gradient of potential in this direction: 1 / sum(n_i^2 / k_i); 0 where one that
/// counts is 0. m2
double permeability_along(const Vec3& permeability, const Vec3& direction);

/// What gives `transmissibility` with the two sides' permeabilities along the line. 0 when nothing can: a permeability
/// or the length is 0. m2
double effective_area(double transmissibility, const CentreLine& line, double first, double second);

/// Area over distance along the line between the centres; 0 for a connection without a face. m
double geometric_factor(const Mesh& mesh, ConnectionId connection);

/// The area against a boundary face: across the line from the cell's centre to the face's centroid. m2
double boundary_area(const Mesh& mesh, FaceId face, AreaKind kind);

}  // namespace wellknit
