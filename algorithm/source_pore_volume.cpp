// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/source_pore_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "algorithm/array_edits.h"
#include "model/errors.h"

namespace wellknit {

namespace {

double value_or(const std::vector<double>& values, std::size_t cell, double otherwise) {
  return values.empty() ? otherwise : values[cell];
}

/// MULTREGP: for one region number the last record counts, whatever its set.
void multiply_regions(const CornerPointGrid& grid, IdVector<HostCellId, double>& pore_volume) {
  std::map<std::int32_t, const RegionPoreVolume*> last;
  for (const RegionPoreVolume& record : grid.edits.region_pore_volumes) last[record.region] = &record;
  for (const auto& [region, record] : last) {
    const std::string keyword = keyword_of(record->regions);
    const auto found = grid.properties.find(keyword);
    if (found == grid.properties.end() && record->regions != RegionSet::multnum)
      throw InvalidInput(fmt::format("MULTREGP refers to the regions of {}, which the deck does not give", keyword));
    const auto* numbers =
        found == grid.properties.end() ? nullptr : &std::get<std::vector<std::int32_t>>(found->second);
    for (std::size_t c = 0; c < pore_volume.size(); ++c)
      if ((numbers == nullptr ? 1 : (*numbers)[c]) == region) pore_volume[HostCellId(c)] *= record->multiplier;
  }
}

}  // namespace

IdVector<HostCellId, double> source_pore_volumes(const CornerPointGrid& grid,
                                                 const IdVector<HostCellId, double>& volume) {
  const ConnectionEdits& edits = grid.edits;
  IdVector<HostCellId, double> out(volume.size());
  for (std::size_t c = 0; c < volume.size(); ++c)
    out[HostCellId(c)] = volume[HostCellId(c)] * value_or(grid.porosity, c, 0.0) * value_or(grid.net_to_gross, c, 1.0) *
                         value_or(edits.pore_volume_multiplier, c, 1.0) *
                         value_or(edits.pore_volume_multiplier_edit, c, 1.0);
  multiply_regions(grid, out);
  const ArrayEdits steps(grid, ComputedArray::pore_volume);
  if (!steps.exist()) return out;
  for (std::size_t c = 0; c < volume.size(); ++c) {
    const HostCellId cell(c);
    const double after_set = steps.is_set(cell) ? value_or(edits.pore_volume_multiplier_edit, c, 1.0) : 1.0;
    out[cell] = std::max(0.0, steps.applied(cell, out[cell]) * after_set);
  }
  return out;
}

double least_pore_volume(const CornerPointGrid& grid, HostCellId cell) {
  const ConnectionEdits& edits = grid.edits;
  if (!edits.least_pore_volume_by_cell.empty()) return edits.least_pore_volume_by_cell[cell.index()];
  return edits.least_pore_volume.value_or(0.0);
}

bool has_pore_volumes(const CornerPointGrid& grid) {
  const auto is_pore_volume = [](const ArrayEdit& edit) { return edit.array == ComputedArray::pore_volume; };
  return !grid.porosity.empty() ||
         std::any_of(grid.edits.array_edits.begin(), grid.edits.array_edits.end(), is_pore_volume);
}

}  // namespace wellknit
