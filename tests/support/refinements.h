// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Demands for refined columns, for tests.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "algorithm/host_refinement.h"

namespace wellknit::refinements {

/// All columns of one size in a source column.
RefinementDemand whole_column(LatticePoint source, LatticePoint unit, LatticePoint size, const ColumnLayers& layers);

/// The engine's numbers are the standard's; those of std distributions differ between libraries.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  std::int64_t number(std::int64_t end) {
    return static_cast<std::int64_t>(engine_() % static_cast<std::uint32_t>(end));
  }
  bool chance(double probability) { return static_cast<double>(engine_()) / 4294967296.0 < probability; }

 private:
  std::mt19937 engine_;
};

struct RandomDemands {
  LatticePoint unit{};
  std::vector<RefinementDemand> demands;
};

/// For some source columns some columns of one size, with layers of the source, merged ones and split ones.
RandomDemands random_demands(const CornerPointGrid& grid, Dice& dice);

}  // namespace wellknit::refinements
