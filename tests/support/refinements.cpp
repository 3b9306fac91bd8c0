// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "tests/support/refinements.h"

#include <algorithm>
#include <utility>

namespace wellknit::refinements {

RefinementDemand whole_column(LatticePoint source, LatticePoint unit, LatticePoint size, const ColumnLayers& layers) {
  RefinementDemand demand{size, {}, layers};
  for (std::int64_t y = source[1] * unit[1]; y < (source[1] + 1) * unit[1]; y += size[1])
    for (std::int64_t x = source[0] * unit[0]; x < (source[0] + 1) * unit[0]; x += size[0])
      demand.columns.push_back({x, y});
  return demand;
}

namespace {

/// Some layers merged, some split, some as they are.
ColumnLayers random_layers(std::int64_t places, Dice& dice) {
  ColumnLayers out;
  for (std::int64_t place = 0; place < places;) {
    if (dice.chance(0.3)) {
      const std::int64_t last = std::min(places - 1, place + dice.number(4));
      out.cells.push_back({{place, 0.0}, {last, 1.0}});
      place = last + 1;
      continue;
    }
    const std::int64_t parts = 1 + dice.number(3);
    for (std::int64_t p = 0; p < parts; ++p)
      out.cells.push_back({{place, static_cast<double>(p) / static_cast<double>(parts)},
                           {place, static_cast<double>(p + 1) / static_cast<double>(parts)}});
    ++place;
  }
  return out;
}

}  // namespace

RandomDemands random_demands(const CornerPointGrid& grid, Dice& dice) {
  RandomDemands out;
  out.unit = {std::int64_t{1} << dice.number(4), std::int64_t{1} << dice.number(4)};
  const double wanted = dice.chance(0.5) ? 0.2 : 0.7;
  for (std::int64_t j = 0; j < grid.dimensions[1]; ++j)
    for (std::int64_t i = 0; i < grid.dimensions[0]; ++i) {
      if (!dice.chance(wanted)) continue;
      LatticePoint size{};
      for (std::size_t a = 0; a < 2; ++a) {
        size[a] = out.unit[a];
        while (size[a] > 1 && dice.chance(0.6)) size[a] /= 2;
      }
      const std::int64_t places = grid.dimensions[2];
      const auto layers = dice.chance(0.4) ? ColumnLayers::of_source(places) : random_layers(places, dice);
      RefinementDemand demand = whole_column({i, j}, out.unit, size, layers);
      const double kept = dice.chance(0.5) ? 1.0 : 0.4;
      std::erase_if(demand.columns, [&](const auto&) { return !dice.chance(kept); });
      out.demands.push_back(std::move(demand));
    }
  return out;
}

}  // namespace wellknit::refinements
