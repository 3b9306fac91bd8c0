// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Tiny named meshes for tests: valid, every array filled, all faces planar.
#pragma once

#include <cstdint>
#include <vector>

#include "model/mesh.h"
#include "model/provenance.h"

namespace wellknit::meshes {

/// The boxes [0,1]^3 and [1,3] x [0,1]^2 with 100 mD everywhere. Half-transmissibilities k * 1 / 0.5 and k * 1 / 1, so
/// T = k / (0.5 + 1) = 66.6667 mD m = 6.579488e-14 m3. No wells.
Mesh two_boxes();

/// n x n x n host cells of 10 x 20 x 5 m from a depth of 2000 m, n at least 2: an injector in the column i = j = 0 and
/// a producer in the column i = j = n-1, a deck's NNC from the first cell to the last, an integer and a floating
/// property, MAPAXES, and the identity as the map from the source grid.
Mesh box_grid(std::int64_t n);

/// Two layers of 5 m from a depth of 1500 m around a vertical producer at the origin: two rings of 8 sectors (radii
/// 0.5, 1.2, 3 m), 8 transition cells out to the square |x|, |y| <= 4, and 8 host cells out to |x|, |y| <= 12, four of
/// which have split faces; an injector in the first corner cell of both layers. 64 cells in all.
Mesh ring_in_boxes();

/// A hexahedral host cell of 10 x 10 x 10 m at 1000 m on a transition prism of that size; the four vertices of the face
/// between them lie 0.5 m off its plane, in turn above and below.
Mesh twisted_box();

/// Provenance with every field set and two sources.
Provenance provenance();

}  // namespace wellknit::meshes
