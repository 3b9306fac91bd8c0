// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The permeability metric (docs/algorithms/metric.md): the mesh is made in a linear image of the real space where the
/// permeability along the wells is the same in all directions, and its points are moved back. What is orthogonal there
/// is K-orthogonal in the real space; circles around a well are the ellipses that its isobars are.
///
/// Source: method.md §4, which scales depth by sqrt(k_h / k_v); for layers that dip, and three different
/// permeabilities, our own. T. Mouton, C. Bennis, H. Borouchaki (key Mouton) for meshing in another space at all.
#pragma once

#include <vector>

#include "algorithm/assembly.h"
#include "algorithm/cell_locator.h"
#include "algorithm/host_mesh.h"
#include "model/well.h"

namespace wellknit {

/// A map S with S K S^T the same in all directions for the mean permeability K along the wells: the mean of the
/// logarithms of the rock tensors of the existing cells that the wells run through, each weighted with the wells'
/// length in it. Vertical lines stay vertical, areas in plan stay the same. Permeabilities below 10^-4 of a cell's
/// largest count as that. Throws InvalidInput without PERMX, PERMY or PERMZ, or where all those cells lack one of them.
AffineMap metric_space(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator,
                       const std::vector<Well>& wells);

/// The grid in that space; pore volumes stay as they are, permeabilities are those given.
CornerPointGrid moved(const AffineMap& space, const CornerPointGrid& grid);

/// A well in that space: measured depths follow the moved path; the bore has the mean radius of the ellipse that it is
/// there, the largest along the part of the path at the grid's depths. `grid`: the real one.
Well moved(const AffineMap& space, const CornerPointGrid& grid, Well well);

/// Mean of the semi-axes, m, of what a round bore along `axis` (real, any length) is in the space.
double moved_bore_radius(const AffineMap& space, const Vec3& axis, double bore_radius);

/// Permeability and area as they are in the space, so that flows stay the same: S K S^T / det S, det S S^-T A.
Eigen::Matrix3d moved_permeability(const AffineMap& space, const Eigen::Matrix3d& k);
Vec3 moved_area(const AffineMap& space, const Vec3& area_vector);

/// Back to the real space. The host's transmissibilities are computed anew; `grid`: the real one.
void move_back(const AffineMap& space, const CornerPointGrid& grid, HostMesh& host);
void move_back(const AffineMap& space, Assembly& assembly);
/// Measured depths only: a tube's points stay in the space that it was made in (Tube::space).
void move_back(const Well& moved_well, Tube& tube);

}  // namespace wellknit
