// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/host_row.h"

#include <algorithm>

#include "algorithm/host_transmissibility.h"

namespace wellknit {

void HostRow::read(const CornerPointGrid& grid, const HostCorners& corners, const IdVector<VertexId, Vec3>& nodes,
                   const std::vector<HostCellState>& states, std::int64_t j) {
  const std::int64_t layer = grid.dimensions[0] * grid.dimensions[1];
  first_cell_ = grid.dimensions[0] * j + layer * corners.layer(0);
  cell_step_ = corners.upside_down ? -layer : layer;
  state_.read(corners, j, states);
  has_conductance_ = has_permeability(grid);
  if (has_conductance_) read_conductances(grid, corners, nodes, j);
}

void HostRow::read_conductances(const CornerPointGrid& grid, const HostCorners& corners,
                                const IdVector<VertexId, Vec3>& nodes, std::int64_t j) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!grid.permeability[axis].empty()) permeability_[axis].read(corners, j, grid.permeability[axis]);
  if (!grid.net_to_gross.empty()) net_to_gross_.read(corners, j, grid.net_to_gross);
  conductance_.resize(corners);
  for (std::int64_t i = 0; i < grid.dimensions[0]; ++i) {
    const ColumnCorners column(corners, nodes, i, j);
    std::array<Vec3, 3>* out = conductance_.column(i);
    for (std::int64_t place = 0; place < grid.dimensions[2]; ++place) {
      std::array<double, 3> k{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        k[axis] = grid.permeability[axis].empty() ? 0.0 : permeability_[axis].column(i)[place];
      const double ntg = grid.net_to_gross.empty() ? 1.0 : net_to_gross_.column(i)[place];
      out[place] = host_conductances(column.corners(place), {k[0] * ntg, k[1] * ntg, k[2]});
    }
  }
}

HostColumn HostRow::column(std::int64_t i) const {
  return {first_cell_ + i, cell_step_, state_.column(i), has_conductance_ ? conductance_.column(i) : nullptr};
}

}  // namespace wellknit
