// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The steps of a deck's EDIT section on one computed array, joined to one step a cell.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "model/corner_point_grid.h"

namespace wellknit {

class ArrayEdits {
 public:
  /// Throws InvalidInput for COPY from another computed array, whose values are not at hand here.
  ArrayEdits(const CornerPointGrid& grid, ComputedArray array);

  /// False: no step concerns this array.
  [[nodiscard]] bool exist() const { return !steps_.empty(); }
  /// The value of a cell after all steps.
  [[nodiscard]] double applied(HostCellId cell, double value) const;
  /// The factor when the steps do nothing but multiply.
  [[nodiscard]] std::optional<double> factor(HostCellId cell) const;
  /// True when the value after the steps does not depend on the one before.
  [[nodiscard]] bool is_set(HostCellId cell) const { return exist() && steps_[cell.index()].factor == 0.0; }

 private:
  /// x -> factor x + shift, held between two bounds. Every chain of steps is of this form.
  struct Step {
    double factor = 1.0;
    double shift = 0.0;
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
  };

  static void append(Step& step, ArrayOperation operation, double value);

  std::vector<Step> steps_;  ///< nx ny nz, or empty
};

}  // namespace wellknit
