// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The connection factor of a COMPDAT record in a cell of the source grid, as the simulator would compute it.
#pragma once

#include <optional>

#include "model/corner_point_grid.h"

namespace wellknit {

/// What the record states; empty: to be computed. SI.
struct CompletionData {
  int axis = 2;           ///< the bore runs along i, j or k
  double diameter = 0.0;  ///< m; 0: not given
  double skin = 0.0;
  std::optional<double> factor;                  ///< m3
  std::optional<double> permeability_thickness;  ///< m3
  std::optional<double> equivalent_radius;       ///< m
};

struct CompletionFactor {
  double factor = 0.0;                  ///< m3; 0 in a cell without permeability
  double permeability_thickness = 0.0;  ///< m3
};

/// Throws InvalidInput where the bore is too wide, or the skin too low, for the cell.
CompletionFactor completion_factor(const CornerPointGrid& grid, HostCellId cell, const CompletionData& data);

}  // namespace wellknit
