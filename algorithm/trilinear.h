// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The trilinear map of a hexahedron: (u, v, w) in the unit cube to a point, and back.
#pragma once

#include <array>
#include <optional>

#include "model/geometry.h"

namespace wellknit {

/// The point at (u, v, w) of the hexahedron whose corner (di, dj, dk) stands at di + 2 dj + 4 dk.
Vec3 trilinear(const std::array<Vec3, 8>& corners, const Vec3& uvw);

/// (u, v, w) of a point, each in [0, 1] when the hexahedron contains it. Outside it the extrapolated value where
/// Newton's iteration finds one within [-3, 4], else nothing. Where the map folds over, a preimage within [0, 1] comes
/// first. Accurate to rounding of the coordinates: about 1e-15 |coordinate| + 1e-13 times the cell's diameter, in
/// metres.
std::optional<Vec3> inverse_trilinear(const std::array<Vec3, 8>& corners, const Vec3& point);

}  // namespace wellknit
