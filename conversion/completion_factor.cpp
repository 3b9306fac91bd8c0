// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// CF = 2 pi Kh / (ln(r_o / r_w) + skin), with Peaceman's equivalent radius r_o (key Peaceman1983). The cell is as wide
// as simulators take it; net-to-gross shortens it along k.

#include "conversion/completion_factor.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "algorithm/peaceman.h"
#include "model/errors.h"
#include "model/units.h"

namespace wellknit {

namespace {

/// What a COMPDAT record without a diameter means.
constexpr double default_diameter = metre_per_foot;

}  // namespace

CompletionFactor completion_factor(const CornerPointGrid& grid, HostCellId cell, const CompletionData& data) {
  Vec3 size = well_cell_size(grid, cell);
  if (!grid.net_to_gross.empty()) size.z() *= grid.net_to_gross[cell.index()];
  Vec3 k = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const auto& values = grid.permeability[static_cast<std::size_t>(axis)];
    if (!values.empty()) k[axis] = values[cell.index()];
  }
  const int b = (data.axis + 1) % 3;
  const int c = (data.axis + 2) % 3;
  const double radius = 0.5 * (data.diameter > 0.0 ? data.diameter : default_diameter);
  const double across = std::sqrt(k[b] * k[c]);
  CompletionFactor out;
  out.permeability_thickness = data.permeability_thickness.value_or(across * size[data.axis]);
  if (data.factor && (data.permeability_thickness || !(across > 0.0))) {
    out.factor = *data.factor;
    if (!(out.permeability_thickness > 0.0)) out.permeability_thickness = *data.factor / (2.0 * std::numbers::pi);
    return out;
  }
  if (!(across > 0.0)) return {};
  const double equivalent = data.equivalent_radius.value_or(peaceman_radius(k[b], k[c], size[b], size[c]));
  const double resistance = std::log(equivalent / radius) + data.skin;
  if (!(resistance > 0.0)) {
    const auto [i, j, layer] = grid.ijk(cell);
    throw InvalidInput(fmt::format(
        "the bore of radius {} m with skin {} is too wide for cell ({}, {}, {}), whose equivalent radius is {:.4g} m; "
        "use a smaller radius or a higher skin",
        radius, data.skin, i + 1, j + 1, layer + 1, equivalent));
  }
  if (data.factor) {
    out.factor = *data.factor;
    out.permeability_thickness = *data.factor * resistance / (2.0 * std::numbers::pi);
  } else {
    out.factor = 2.0 * std::numbers::pi * out.permeability_thickness / resistance;
  }
  return out;
}

}  // namespace wellknit
