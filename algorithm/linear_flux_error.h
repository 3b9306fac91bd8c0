// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What a two-point flux leaves out of the flux of a linear pressure.
#pragma once

#include <Eigen/Core>
#include <array>

#include "model/geometry.h"

namespace wellknit {

/// A face between two cells; its area vector points from the first to the second.
struct FaceBetween {
  Vec3 centroid;
  Vec3 area_vector;  ///< m2
  std::array<Vec3, 2> centers;
  std::array<Eigen::Matrix3d, 2> permeability;  ///< m2
};

/// |T (p_i - p_j) - K grad p.n A| / (|K n| A) for slopes of 1 along x, y, depth. K is the mean of the two cells', times
/// what makes its part along n that of both in series: a jump of permeability is no error. 0 where that is no number.
Vec3 linear_flux_error(const FaceBetween& face, double transmissibility);

}  // namespace wellknit
