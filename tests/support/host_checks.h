// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What must hold for every host mesh, measured from its faces alone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithm/host_mesh.h"

namespace wellknit {

/// Less is rounding of coordinates where pillars coincide, m3.
inline constexpr double sliver_volume = 1e-6;

struct HostCheck {
  std::vector<std::string>
      faults;              ///< an edge without its twin, a face with a vertex twice, a volume that is not positive …
  std::int64_t cells = 0;  ///< existing ones
  double worst_openness = 0.0;  ///< |sum of area vectors| / sum of areas
  double worst_volume = 0.0;    ///< |fan volume / bilinear volume - 1|
  /// The same of cells above sliver_volume whose top and base no other column's lines cut.
  double worst_uncut_volume = 0.0;
  std::int64_t uncut_cells = 0;    ///< these
  std::int64_t cut_cells = 0;      ///< the others above sliver_volume
  std::int64_t far_off_cells = 0;  ///< of both: with volumes that differ by more than 2 %
};

HostCheck check_host(const CornerPointGrid& grid, const HostMesh& mesh);

struct TopologyCheck {
  std::vector<std::string> faults;  ///< a sphere whose Euler characteristic is not 2, a face twice
  std::int64_t spheres = 0;         ///< cells whose surface is one piece, with one fan of faces at each vertex
  std::int64_t others = 0;          ///< cells that touch themselves in a vertex or are of several pieces
};

/// What needs no coordinates: each cell's surface, and that no face stands twice.
TopologyCheck check_topology(const HostMesh& mesh);

std::vector<Vec3> loop_points(const HostMesh& mesh, FaceId face);

/// Largest difference between the area of a cell's side and the sum over the faces there, relative to the side's area.
double worst_side_area(const CornerPointGrid& grid, const HostMesh& mesh);

}  // namespace wellknit
