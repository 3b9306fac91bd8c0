// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Short edges of the transition mesh are taken out: their two ends become one vertex
/// (docs/algorithms/optimisation.md). A power diagram has them wherever five or more sites are nearly on one sphere;
/// after the mapping to the real space they carry small, badly turned faces and keep the optimisation from moving.
#pragma once

#include <cstdint>
#include <vector>

#include "model/mesh.h"

namespace wellknit {

struct Assembly;

/// Lengths are over the size (cube root of the volume) of the smallest cell at an edge.
struct EdgeCollapse {
  static constexpr double short_edge = 0.02;
  std::int64_t short_before = 0;  ///< edges of transition cells below it
  std::int64_t short_after = 0;
  std::int64_t edges_removed = 0;
  std::int64_t faces_removed = 0;  ///< triangles on such an edge
  double shortest_before = 0.0;
  double shortest_after = 0.0;
};

struct CollapseLimits {
  double length = 0.05;      ///< of the size of the largest cell at an edge: shorter ones are taken out
  double angle = 45.0;       ///< degrees; no face may come beyond it that was below
  double height = 0.02;      ///< of the cell's size: as far as a cell's centre is to be behind each face, or
  double kept_height = 0.5;  ///< this part of how far it was, where that is less
  double planarity = 0.1;    ///< height of vertices over a face's plane, over the root of its area; the same
};

/// Takes out edges with an end that belongs to transition cells alone, shortest first. The other end may lie on a face
/// of the host or of a radial cell; then it stays where it is. An edge stays where a cell would no longer be closed,
/// would not be seen whole from its centre, or would get a face beyond the limits. Cells and which of them share a face
/// stay but for the triangles that go. Cells that are `kept` do not change.
EdgeCollapse collapse_short_edges(Assembly& assembly, const std::vector<CellId>& kept = {},
                                  const CollapseLimits& limits = {});

}  // namespace wellknit
