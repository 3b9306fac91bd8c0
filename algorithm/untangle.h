// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Moves one vertex of a tetrahedral mesh so that the tetrahedra around it are not inverted (method.md §7).
///
/// Source: T. Mouton, C. Bennis, H. Borouchaki (key Mouton), objective f(p) = sum (|V_j - beta| - (V_j - beta))^2.
#pragma once

#include <vector>

#include "model/geometry.h"

namespace wellknit {

/// The volumes around a vertex are affine in its position: value_j(p) = offset_j + gradient_j . p.
struct VertexBall {
  std::vector<double> offset;
  std::vector<Vec3> gradient;

  [[nodiscard]] double value(std::size_t j, const Vec3& p) const { return offset[j] + gradient[j].dot(p); }
  [[nodiscard]] double smallest(const Vec3& p) const;
};

/// The minimiser of sum max(0, beta - value_j)^2, convex and C1, by damped Newton from `start`.
Vec3 minimise_shortfall(const VertexBall& ball, double beta, const Vec3& start);

/// True when all values reach beta at p (to 1e-12 of `scale`).
bool reaches(const VertexBall& ball, double beta, const Vec3& p, double scale);

/// The position with the largest smallest value, found by bisection over beta up to `most`; where none makes all values
/// positive, the minimiser of the shortfall from a twentieth of `most`.
Vec3 largest_smallest_value(const VertexBall& ball, double most, const Vec3& start);

/// The paper's two steps: beta = 0, then beta from the smallest non-null value over the number of null ones plus one,
/// halved while it cannot be reached. The start where beta = 0 cannot be reached: the paper leaves such a vertex where
/// it is.
Vec3 paper_position(const VertexBall& ball, const Vec3& start);

}  // namespace wellknit
