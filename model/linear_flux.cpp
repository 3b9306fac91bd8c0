// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/linear_flux.h"

#include <algorithm>

namespace wellknit {

std::optional<LinearFluxErrors> linear_flux_errors(const Mesh& mesh) {
  const Connections& c = mesh.connections;
  if (c.linear_flux_error.empty()) return std::nullopt;
  LinearFluxErrors out;
  double area = 0.0;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const ConnectionId id(i);
    if (!c.face[id].is_valid()) continue;
    const CellKind high = std::max(mesh.cells.kind[c.cells[id][0]], mesh.cells.kind[c.cells[id][1]]);
    if (high == CellKind::host || high == CellKind::radial) continue;
    ++out.faces;
    area += c.area[id];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double error = c.linear_flux_error[id][static_cast<Eigen::Index>(axis)];
      out.area_mean[axis] += c.area[id] * error;
      out.max[axis] = std::max(out.max[axis], error);
    }
  }
  if (out.faces == 0 || !(area > 0.0)) return std::nullopt;
  for (double& mean : out.area_mean) mean /= area;
  return out;
}

}  // namespace wellknit
