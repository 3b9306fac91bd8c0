// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "conversion/source_cells.h"

#include <algorithm>

namespace wellknit {

SourceCells::SourceCells(const CornerPointGrid& grid, const Mesh& mesh, const DeckGrid& deck_grid)
    : grid_(grid), mesh_(mesh), deck_grid_(deck_grid), whole_(static_cast<std::size_t>(grid.cell_count())) {
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const CellId cell(c);
    if (mesh.cells.kind[cell] == CellKind::host && mesh.cells.source_cell[cell].is_valid() && deck_grid.is_active(cell))
      whole_[mesh.cells.source_cell[cell].index()] = cell;
  }
}

std::vector<CellShare> SourceCells::parts(HostCellId source) const {
  constexpr double least_share = 0.01;
  std::vector<CellShare> out;
  for (std::int64_t at = mesh_.transfer.start[source.index()]; at < mesh_.transfer.start[source.index() + 1]; ++at) {
    const CellId cell = mesh_.transfer.cell[static_cast<std::size_t>(at)];
    const double fraction = mesh_.transfer.fraction[static_cast<std::size_t>(at)];
    if (!deck_grid_.is_active(cell) || !(fraction > 0.0)) continue;
    out.push_back({cell, fraction});
  }
  const auto has_share = [](const CellShare& part) { return part.share >= least_share; };
  if (std::ranges::any_of(out, has_share)) std::erase_if(out, [&](const CellShare& part) { return !has_share(part); });
  double sum = 0.0;
  for (const CellShare& part : out) sum += part.share;
  for (CellShare& part : out) part.share /= sum;
  return out;
}

double SourceCells::depth(HostCellId source) const {
  double sum = 0.0;
  for (const Vec3& corner : grid_.corners(source)) sum += 0.125 * corner.z();
  return sum;
}

}  // namespace wellknit
