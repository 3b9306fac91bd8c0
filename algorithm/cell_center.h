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

/// A point near `start` from which all faces are seen: projections onto the face that hides most (the relaxation method
/// of Agmon, 1954), with as much height as can be had up to a twentieth of `size`. Empty when none is found.
std::optional<Vec3> point_that_sees_all(std::span<const OutwardFace> faces, const Vec3& start, double size);

}  // namespace wellknit
