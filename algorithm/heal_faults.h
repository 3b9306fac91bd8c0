// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The fault policy `heal`: small throws near the wells are averaged out of the source grid before the host is built
/// (docs/algorithms/fault_policy.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/corner_point_grid.h"
#include "model/well.h"

namespace wellknit {

/// A level of a pillar is what its up to four columns have there of one horizon: a base and the top below it count as
/// one where they coincide.
struct HealedFaults {
  /// The source with moved corners. MULTPV is scaled so that every cell has its source's pore volume, and the property
  /// healed_keyword is 1 for the cells that changed; absent when none did.
  CornerPointGrid grid;
  double limit = 0.0;                ///< m: throws up to here were healed
  double largest_throw = 0.0;        ///< healed, m
  std::int64_t levels_healed = 0;    ///< of pillars
  std::int64_t pillars_healed = 0;   ///< with one such level or more
  std::int64_t levels_beyond = 0;    ///< left: thrown by more than the limit
  std::int64_t levels_kept = 0;      ///< left: healing them would have opened, closed or crossed a layer
  std::int64_t cells_changed = 0;    ///< active cells with a moved corner
  double changed_bulk_volume = 0.0;  ///< of these in the source, m3
  double bulk_volume_change = 0.0;   ///< of these by healing, m3

  /// What was done, one sentence each.
  [[nodiscard]] std::vector<std::string> notes() const;
};

/// The per-cell property that marks healed cells.
inline constexpr const char* healed_keyword = "HEALED";

/// Heals throws up to `limit`, m; unset: a tenth of the mean layer thickness around the wells. Around are the columns
/// that a path crosses, two more on all sides, and those within three drainage radii of it in plan. Throws InvalidInput
/// where validate(grid) would.
HealedFaults heal_faults(const CornerPointGrid& grid, const std::vector<Well>& wells, std::optional<double> limit);

}  // namespace wellknit
