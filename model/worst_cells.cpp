// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/worst_cells.h"

#include <algorithm>
#include <array>

namespace wellknit {

double value_of(const CellQuality& quality, CellId cell, FaceMeasure measure) {
  switch (measure) {
    case FaceMeasure::k_non_orthogonality: return quality.max_k_non_orthogonality[cell];
    case FaceMeasure::planarity: return quality.max_planarity[cell];
    case FaceMeasure::skewness: return quality.max_skewness[cell];
    default: return quality.max_non_orthogonality[cell];
  }
}

double reference_of(FaceMeasure measure) {
  constexpr std::array references{quality_limit::severe_non_orthogonality, quality_limit::reversed_face, 0.1,
                                  quality_limit::skewness};
  return references[static_cast<std::size_t>(measure)];
}

std::vector<CellId> worst_cells(const Mesh& mesh, const CellQuality& quality, FaceMeasure measure, std::size_t count,
                                bool (*include)(CellKind kind)) {
  std::vector<CellId> all;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (include(mesh.cells.kind[CellId(c)]) && value_of(quality, CellId(c), measure) > 0.0) all.push_back(CellId(c));
  const auto worse = [&](CellId a, CellId b) {
    const double at_a = value_of(quality, a, measure);
    const double at_b = value_of(quality, b, measure);
    return at_a != at_b ? at_a > at_b : a < b;
  };
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(count, all.size()));
  std::partial_sort(all.begin(), end, all.end(), worse);
  all.erase(end, all.end());
  return all;
}

}  // namespace wellknit
