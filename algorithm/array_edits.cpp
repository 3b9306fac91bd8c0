// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/array_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/errors.h"

namespace wellknit {

ArrayEdits::ArrayEdits(const CornerPointGrid& grid, ComputedArray array) {
  for (const ArrayEdit& edit : grid.edits.array_edits) {
    if (edit.array != array) continue;
    if (edit.operation == ArrayOperation::copy && edit.source != array)
      throw InvalidInput(fmt::format("EDIT: COPY of {} to {} is not handled: give the values instead",
                                     keyword_of(edit.source), keyword_of(array)));
    if (steps_.empty()) steps_.resize(static_cast<std::size_t>(grid.cell_count()));
    std::size_t n = 0;
    for (std::int64_t k = edit.cells.first[2]; k <= edit.cells.last[2]; ++k)
      for (std::int64_t j = edit.cells.first[1]; j <= edit.cells.last[1]; ++j)
        for (std::int64_t i = edit.cells.first[0]; i <= edit.cells.last[0]; ++i, ++n) {
          const double value = edit.values.empty() ? edit.value : edit.values[n];
          if (!std::isnan(value)) append(steps_[grid.cell_id(i, j, k).index()], edit.operation, value);
        }
  }
}

void ArrayEdits::append(Step& step, ArrayOperation operation, double value) {
  switch (operation) {
    case ArrayOperation::set: step = {0.0, value}; return;
    case ArrayOperation::add:
      step.shift += value;
      step.least += value;
      step.most += value;
      return;
    case ArrayOperation::multiply: {
      step.factor *= value;
      step.shift *= value;
      // Infinite bounds stay infinite, also times zero; a negative factor turns them.
      const auto scaled = [value](double bound) { return std::isinf(bound) && value == 0.0 ? bound : bound * value; };
      step.least = scaled(step.least);
      step.most = scaled(step.most);
      if (value < 0.0) std::swap(step.least, step.most);
      return;
    }
    case ArrayOperation::at_least:
      step.least = std::max(step.least, value);
      step.most = std::max(step.most, value);
      return;
    case ArrayOperation::at_most:
      step.least = std::min(step.least, value);
      step.most = std::min(step.most, value);
      return;
    case ArrayOperation::copy: return;
  }
}

double ArrayEdits::applied(HostCellId cell, double value) const {
  if (steps_.empty()) return value;
  const Step& step = steps_[cell.index()];
  return std::clamp(step.factor * value + step.shift, step.least, step.most);
}

std::optional<double> ArrayEdits::factor(HostCellId cell) const {
  if (steps_.empty()) return 1.0;
  const Step& step = steps_[cell.index()];
  const bool is_factor = step.shift == 0.0 && std::isinf(step.least) && std::isinf(step.most);
  return is_factor ? std::optional(step.factor) : std::nullopt;
}

}  // namespace wellknit
