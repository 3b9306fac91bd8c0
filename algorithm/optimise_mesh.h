// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Last step of the near-well mesh: the orthogonality that the mapping back to the real space has cost is won back by
/// moving inner vertices and the cells' centres (docs/algorithms/optimisation.md).
#pragma once

#include <cstdint>
#include <vector>

#include "model/mesh.h"

namespace wellknit {

/// Angles are between a face's normal and the line between the centres of its two cells, degrees.
struct AngleFigures {
  double mean = 0.0;
  double p99 = 0.0;  ///< 99th percentile
  double largest = 0.0;
};

struct MeshOptimisation {
  std::int64_t cells = 0;     ///< transition cells
  std::int64_t vertices = 0;  ///< that may move
  int iterations = 0;         ///< the most of any cavity
  std::int64_t restored = 0;  ///< cells that were put back, since they would not have been seen whole
  AngleFigures inner_before;  ///< of faces between two transition cells
  AngleFigures inner_after;
  AngleFigures joint_before;  ///< of faces between a transition cell and another one
  AngleFigures joint_after;
};

struct OptimisationWeights {
  double joint = 1.2;          ///< of a face between a transition cell and another one; of an inner face 1
  double large = 2.0;          ///< of the fourth power of an angle (radians), beside its square
  double keep_joint = 2000.0;  ///< of the square of what a joint's squared angle is above what it was
  double keep_inner = 300.0;   ///< the same of an inner face
  double planarity = 90.0;     ///< of an inner face's squared heights over its plane, relative to its area
  double barrier = 0.03;       ///< of a tetrahedron between centre and face that gets thin
  double edge = 0.5;           ///< of an inner edge that gets short
  double shortest = 0.04;      ///< of the size of the largest cell at an edge: from there on it is short
  int iterations = 150;
};

/// Moves vertices that belong to transition cells alone, and the centres of these cells; the mesh's other vertices,
/// cells and centres, and which faces there are, stay. Cavities with inner faces below 0.5 degrees on average are left
/// alone. Volumes, centroids and depths of the cells follow. A cell that was seen whole from its centre is so
/// afterwards. Cells that are `kept` do not change. Cavities are worked on side by side; the result does not depend on
/// how.
MeshOptimisation optimise_mesh(Mesh& mesh, std::vector<CellId> kept = {}, const OptimisationWeights& weights = {});

}  // namespace wellknit
