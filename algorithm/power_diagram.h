// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The power diagram of the sites, with vertices snapped combinatorially to the cavity's boundary (method.md §9).
///
/// Source: J. Flandrin, H. Borouchaki, C. Bennis (key Flandrin); the snapping is our own (method.md §9).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithm/sites.h"

namespace wellknit {

/// A polygon between an inner site's cell and what is on its other side.
struct DiagramFace {
  enum class Other : std::uint8_t { inner, outer, plane };
  std::vector<std::int32_t> loop;  ///< vertices; the right-hand normal points away from `cell`
  std::int32_t cell = -1;          ///< inner site
  Other other_kind = Other::inner;
  std::int32_t other = -1;  ///< inner or outer site, or mirror plane
};

struct PowerDiagram {
  std::vector<Vec3> vertices;        ///< the cavity's vertices first, in their order, then the new ones
  std::vector<std::uint8_t> planes;  ///< per vertex: bit p set when it lies on mirror plane p by construction
  std::vector<DiagramFace> faces;
  std::int64_t absorbed_flat = 0;  ///< flat tetrahedra whose dual was taken from a neighbour
  std::string failure;             ///< why the diagram is not usable; empty when it is
};

/// Regular triangulation of inner and outer sites and the images of the inner ones in the planes, and its dual
/// polygons.
PowerDiagram build_power_diagram(const Cavity& cavity, const Sites& sites);

/// What comparing the diagram with the cavity's boundary says.
struct BoundaryMatch {
  std::int64_t found = 0;                   ///< boundary faces with the very same vertex set between their two sites
  std::int64_t foreign = 0;                 ///< polygons between an inner and an outer site that are no boundary face
  double volume_error = 0.0;                ///< relative difference of the cells' volume from the cavity's
  std::vector<std::int32_t> boundary_face;  ///< per diagram face: the boundary face that it is, or -1
};

BoundaryMatch match_boundary(const Cavity& cavity, const Sites& sites, const PowerDiagram& diagram);

}  // namespace wellknit
