// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What must hold for every host mesh, measured from its faces alone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithm/host_mesh.h"

namespace wellknit {

struct HostCheck {
  std::vector<std::string>
      faults;              ///< an edge without its twin, a face with a vertex twice, a volume that is not positive …
  std::int64_t cells = 0;  ///< existing ones
  double worst_openness = 0.0;  ///< |sum of area vectors| / sum of areas
  double worst_volume = 0.0;    ///< |fan volume / bilinear volume - 1|
};

HostCheck check_host(const CornerPointGrid& grid, const HostMesh& mesh);

std::vector<Vec3> loop_points(const HostMesh& mesh, FaceId face);

/// Largest difference between the area of a cell's side and the sum over the faces there, relative to the side's area.
double worst_side_area(const CornerPointGrid& grid, const HostMesh& mesh);

}  // namespace wellknit
