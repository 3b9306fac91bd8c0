// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A cavity has one list of layers for all its columns. A column needs them beside the cavity only: elsewhere it has the
// source's layers again.

#include <algorithm>

#include <map>
#include <tuple>
#include <utility>

#include "algorithm/host_refinement.h"
#include "model/errors.h"

namespace wellknit {

namespace {

/// A part of one layer of the source: all of it, or between two fractions of its height.
struct LayerPart {
  std::int64_t place = 0;
  double upper = 0.0;
  double lower = 1.0;
};

/// What a cell has of each layer of the source that has some room between its levels.
void append_parts(const ColumnLayers::Cell& cell, std::vector<LayerPart>& out) {
  for (std::int64_t place = cell.upper.place; place <= cell.lower.place; ++place) {
    const double upper = place == cell.upper.place ? cell.upper.fraction : 0.0;
    const double lower = place == cell.lower.place ? cell.lower.fraction : 1.0;
    if (upper < lower) out.push_back({place, upper, lower});
  }
}

/// Joins parts of one layer: two, then four, then eight of those that follow a needed cell.
std::vector<LayerPart> joined(const std::vector<LayerPart>& parts) {
  std::vector<LayerPart> out;
  std::size_t most = 2;
  for (std::size_t n = 0; n < parts.size(); most *= 2) {
    std::size_t end = n + 1;
    while (end < parts.size() && end - n < most && parts[end].place == parts[n].place) ++end;
    LayerPart all = parts[n];
    all.upper = std::min(all.upper, parts[end - 1].upper);
    all.lower = std::max(all.lower, parts[end - 1].lower);
    out.push_back(all);
    n = end;
  }
  return out;
}

/// All parts of each layer as one.
std::vector<LayerPart> as_layers(const std::vector<LayerPart>& parts) {
  std::vector<LayerPart> out;
  for (const LayerPart& part : parts) {
    if (!out.empty() && out.back().place == part.place)
      out.back().lower = part.lower;
    else
      out.push_back(part);
  }
  return out;
}

ColumnLayers trimmed(const ColumnLayers& all, const std::vector<std::uint8_t>& is_needed) {
  ColumnLayers out;
  const auto append = [&](const std::vector<LayerPart>& parts) {
    for (const LayerPart& p : parts) out.cells.push_back({{p.place, p.upper}, {p.place, p.lower}});
  };
  for (std::size_t k = 0; k < all.cells.size();) {
    if (is_needed[k] != 0) {
      out.cells.push_back(all.cells[k++]);
      continue;
    }
    const bool is_below_needed = k > 0;
    std::vector<LayerPart> parts;
    for (; k < all.cells.size() && is_needed[k] == 0; ++k) append_parts(all.cells[k], parts);
    const bool is_above_needed = k < all.cells.size();
    // Beside two needed cells the upper half goes with the upper one.
    std::size_t middle = is_below_needed ? parts.size() : 0;
    if (is_below_needed && is_above_needed) middle = (parts.size() + 1) / 2;
    const auto at = parts.begin() + static_cast<std::ptrdiff_t>(middle);
    if (is_below_needed) append(joined({parts.begin(), at}));
    if (is_above_needed) {
      std::vector<LayerPart> upwards = joined({parts.rbegin(), parts.rend() - static_cast<std::ptrdiff_t>(middle)});
      std::reverse(upwards.begin(), upwards.end());
      append(upwards);
    }
    if (!is_below_needed && !is_above_needed) append(as_layers(parts));
  }
  return out;
}

}  // namespace

std::int64_t ColumnLayers::place_of(const Cell& cell) const {
  const auto key = [](const Cell& c) { return std::tie(c.upper.place, c.upper.fraction); };
  const auto at =
      std::lower_bound(cells.begin(), cells.end(), cell, [&](const Cell& a, const Cell& b) { return key(a) < key(b); });
  if (at == cells.end() || *at != cell) throw InvalidInput("a column does not have a layer that a cavity lies in");
  return at - cells.begin();
}

void trim_layers(RefinementPlan& plan, const std::vector<NeededLayers>& needed) {
  std::map<LatticePoint, std::vector<std::uint8_t>> of_column;
  for (const NeededLayers& n : needed) {
    auto& all = of_column[n.low];
    if (all.empty()) all.assign(n.is_needed.size(), 0);
    if (all.size() != n.is_needed.size()) throw InvalidInput("a column is asked for two numbers of layers");
    std::transform(all.begin(), all.end(), n.is_needed.begin(), all.begin(), std::bit_or<>());
  }
  std::map<std::pair<std::int32_t, std::vector<std::uint8_t>>, std::int32_t> known;
  for (RefinedColumn& column : plan.columns) {
    const auto found = of_column.find(column.low);
    if (found == of_column.end() || column.layers == 0) continue;
    const auto [at, is_new] =
        known.try_emplace({column.layers, found->second}, static_cast<std::int32_t>(plan.layers.size()));
    if (is_new) {
      const ColumnLayers& all = plan.layers[static_cast<std::size_t>(column.layers)];
      if (all.cells.size() != found->second.size())
        throw InvalidInput("a column is asked for layers of another demand");
      plan.layers.push_back(trimmed(all, found->second));
    }
    column.layers = at->second;
  }
}

}  // namespace wellknit
