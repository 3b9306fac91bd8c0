// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The transition mesh of one cavity, back in the real space (method.md §6 to §10).
///
/// Source: T. Mouton, C. Bennis, H. Borouchaki (key Mouton).
#pragma once

#include <variant>
#include <vector>

#include "algorithm/build_mesh.h"
#include "algorithm/cavity.h"
#include "algorithm/power_diagram.h"

namespace wellknit {

struct TransitionMesh {
  Cavity cavity;
  std::vector<Vec3> vertices;               ///< real; the cavity's vertices first, in their order
  std::vector<Vec3> centers;                ///< per cell: the points that carry the pressure
  std::vector<DiagramFace> faces;           ///< as in the diagram: right-hand normal away from `cell`
  std::vector<std::int32_t> boundary_face;  ///< per face: the boundary face of the cavity that it is, or -1
  CavitySummary summary;
};

/// Runs the steps for wells that share a cavity. Where a step fails, the cavity is enlarged and all is tried again,
/// twice; not if it is to stay `tight`.
std::variant<TransitionMesh, NoCavity> build_transition_mesh(const HostFrame& frame, const std::vector<Tube>& tubes,
                                                             MappingMethod method, bool tight = false);

}  // namespace wellknit
