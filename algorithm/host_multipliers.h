// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What a deck's multipliers make of the connections between source cells: MULTX …, MULTFLT and MULTREGT.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "algorithm/host_mesh.h"

namespace wellknit {

class HostMultipliers {
 public:
  /// The grid must outlive it. Throws InvalidInput when MULTREGT names a region set that the grid does not have.
  explicit HostMultipliers(const CornerPointGrid& grid);

  /// False: every multiplier is 1.
  [[nodiscard]] bool exist() const { return exist_; }

  /// Of the connection between two cells across a face normal to `axis`: the multiplier of the cell with the smaller
  /// index on its high side, times that of the other on its low side, times that of their regions. 1 between parts of
  /// one cell.
  [[nodiscard]] double across(HostCellId one, HostCellId other, Axis axis) const;

  /// The one of the cell's own face: MULTX … and MULTFLT.
  [[nodiscard]] double of_face(HostCellId cell, FaceDirection face) const;

  /// MULTREGT between two cells; across a face normal to `axis`, or a non-neighbour connection (nothing).
  [[nodiscard]] double of_regions(HostCellId one, HostCellId other, std::optional<Axis> axis) const;

 private:
  using Regions = std::pair<std::int32_t, std::int32_t>;
  struct RegionRules {
    const std::vector<std::int32_t>* numbers = nullptr;  ///< a cell's region; null: 1 everywhere
    std::map<Regions, const RegionMultiplier*> of_pair;  ///< both orders
  };

  void add_faults();
  void add_regions();
  [[nodiscard]] const std::vector<std::int32_t>* numbers_of(RegionSet set) const;
  static std::int32_t region(const RegionRules& rules, HostCellId cell) {
    return rules.numbers == nullptr ? 1 : (*rules.numbers)[cell.index()];
  }

  const CornerPointGrid& grid_;
  bool exist_ = false;
  /// nx ny nz each, with the faults' multipliers; empty: those of the deck as they are
  std::array<std::vector<double>, 6> with_faults_;
  std::array<RegionRules, 3> regions_;  ///< by RegionSet
};

}  // namespace wellknit
