// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The permeability that flow through a cell sees. Simulators take PERMX, PERMY, PERMZ along a cell's own axes; where
/// layers dip, the permeability of made cells is turned with them.
#pragma once

#include "algorithm/assembly.h"
#include "algorithm/host_mesh.h"

namespace wellknit {

/// Axes of a corner-point cell as columns: along i within the layer, across that within the layer, normal to the layer
/// (pointing down). Orthonormal. The layer is the plane of the i and j directions, each from the middle of one face to
/// that of the opposite one. x, y and depth for a cell without extent.
Eigen::Matrix3d layer_axes(const HostMesh& host, HostCellId cell);

/// Fills assembly.rock_axes: axes of the source cells of each made cell, averaged with their volumes in it. Needs the
/// transfer map.
void set_rock_axes(const HostMesh& host, Assembly& assembly);

/// Symmetric tensor of a made cell in x, y, depth, m2, net-to-gross on the lateral directions, as NEWTRAN applies it.
/// For other cells that along x, y, depth.
Eigen::Matrix3d rock_tensor(const Assembly& assembly, CellId cell);

/// The same along the axes of a host or refined cell.
Eigen::Matrix3d rock_tensor(const Assembly& assembly, const HostMesh& host, CellId cell);

}  // namespace wellknit
