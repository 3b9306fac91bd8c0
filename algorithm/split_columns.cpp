// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/split_columns.h"

#include <fmt/format.h>

#include "algorithm/well_sample.h"
#include "model/errors.h"

namespace wellknit {

RefinementPlan uniform_refinement(const CornerPointGrid& grid, int parts) {
  const std::int64_t n = parts;
  if (grid.cell_count() > max_ids / (n * n))
    throw InvalidInput("the refined grid has too many vertices to be numbered; refine less");
  RefinementPlan plan;
  plan.unit = {n, n};
  plan.layers.push_back(ColumnLayers::of_source(grid.dimensions[2]));
  for (std::int64_t j = 0; j < grid.dimensions[1]; ++j)
    for (std::int64_t i = 0; i < grid.dimensions[0]; ++i)
      for (std::int64_t b = j * n; b < (j + 1) * n; ++b)
        for (std::int64_t a = i * n; a < (i + 1) * n; ++a)
          plan.columns.push_back({{i, j}, {a, b}, {a + 1, b + 1}, 0, {}});
  return plan;
}

MeshedWells split_columns(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator,
                          const std::vector<Well>& wells, int parts) {
  MeshedWells out;
  out.plan = uniform_refinement(grid, parts);
  for (const Well& well : wells) {
    WellSummary s;
    s.name = well.name;
    s.mode = "host cells";
    s.reason = fmt::format("--split {}: finer columns, and no mesh around wells", parts);
    s.radius_wanted = s.drainage_radius = well.radial.drainage_radius;
    s.length_in_rock = sample_well(grid, host, locator, well).length_in_rock;
    out.wells.push_back(std::move(s));
  }
  return out;
}

}  // namespace wellknit
