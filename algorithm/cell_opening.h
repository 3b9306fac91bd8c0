// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Transition cells that no point sees whole are opened: their inner vertices move until one does, or they join a
/// neighbour.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithm/cell_center.h"
#include "algorithm/transition_mesh.h"

namespace wellknit {

/// Faces of each cell, outward.
std::vector<std::vector<OutwardFace>> outward_faces(const TransitionMesh& mesh);

/// The volume that a cell's faces enclose, m3; faces as fans around their means.
double enclosed_volume(std::span<const OutwardFace> faces);

/// Cube root of the volume, m; of a cell that is inside out, the edge of the cube with its surface.
double cell_size(std::span<const OutwardFace> faces);

struct OpeningReport {
  std::int64_t closed_first = 0;  ///< cells that no point saw whole
  std::int64_t moved = 0;         ///< vertices
  std::int64_t merged = 0;        ///< cells that joined a neighbour
  std::int64_t closed_last = 0;   ///< cells that no point sees whole
};

/// Moves free vertices (`is_fixed` 0, one entry for each vertex) of cells that no point sees whole, one at a time and
/// never so that another cell is seen worse than a hundredth of its size, or worse than before. What stays closed joins
/// the neighbour with which it shares the most area among those where the union is seen whole. The number of trials is
/// bounded.
OpeningReport open_cells(TransitionMesh& mesh, std::span<const std::uint8_t> is_fixed);

}  // namespace wellknit
