// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The transition mesh of one cavity, back in the real space (method.md §6 to §10).
///
/// Source: T. Mouton, C. Bennis, H. Borouchaki (key Mouton).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
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

/// A cell that cannot be used.
struct BadCell {
  std::string reason;
  Vec3 center = Vec3::Zero();
};

/// Mapped sites see their cells where phi is gentle; elsewhere the nearest point that does is taken. Cells that no
/// point sees are opened first; `is_fixed`, per vertex: it stays. Returns the first that stays unseen.
std::optional<BadCell> choose_centers(const std::vector<std::uint8_t>& is_fixed, TransitionMesh& mesh);

/// Notes why the wells of the cavity nearest to a point of the finished mesh get no tubes: it does not close there.
/// `cavities` has one or more; `reasons` is by well, and keeps what it has.
void note_open_mesh(const std::vector<TransitionMesh>& cavities, const Vec3& point,
                    std::map<std::size_t, std::string>& reasons);

/// Runs the steps for wells that share a cavity. Where a step fails, the cavity is enlarged and all is tried again,
/// twice; not if it is to stay `tight`.
std::variant<TransitionMesh, NoCavity> build_transition_mesh(const HostFrame& frame, const std::vector<Tube>& tubes,
                                                             MappingMethod method, bool tight = false);

}  // namespace wellknit
