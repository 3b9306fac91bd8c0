// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Last step of the host: tops and bases with cut edges keep the volume of their four corners.
#pragma once

#include "algorithm/host_mesh.h"

namespace wellknit {

/// A face is the fan of triangles around the mean of its vertices. On a twisted top the crossings with a fault's other
/// side pull that mean towards one corner and change the volume of the cells; more points on the same edges pull it
/// back. Only tops and bases where the change is above a thousandth of a cell's volume get them, and with them the
/// faces beside that edge. Returns the number of points.
std::int64_t balance_cut_tops(HostMesh& mesh);

}  // namespace wellknit
