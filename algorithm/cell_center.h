// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The point of a polyhedral cell that carries its pressure.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "model/geometry.h"

namespace wellknit {

/// The fan of a face of a cell, its right-hand normal pointing out of the cell.
struct OutwardFace {
  Vec3 mean;
  Vec3 area_vector;
};

/// Smallest signed height of `point` under the faces' fans, m: 3 V_f / A_f, where V_f is the volume of the fan's cone
/// to the point. A cell is seen whole from a point when this is positive.
double smallest_height(std::span<const OutwardFace> faces, const Vec3& point);

/// The point from which the faces are seen best, and how well.
struct DeepestPoint {
  Vec3 point = Vec3::Zero();
  double height = 0.0;  ///< smallest_height() there, m; not positive: no point sees all faces
};

/// The point with the largest smallest height: a linear programme in its coordinates and the height, solved exactly
/// (but for rounding) by Seidel's method. Looked for within 100 times `size` (m, the cell's) of `start`.
DeepestPoint deepest_point(std::span<const OutwardFace> faces, const Vec3& start, double size);

/// A point near `start` from which all faces are seen, with a height of a twentieth of `size`, or half of the largest
/// height where that is less: by relaxation, else on the way from `start` to the deepest point. Empty when no point
/// sees all, to 1e-9 of `size`.
std::optional<Vec3> point_that_sees_all(std::span<const OutwardFace> faces, const Vec3& start, double size);

}  // namespace wellknit
