// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Finds the radius, the mode and the stretches that give a well its tubes (docs/algorithms/wells.md).
#pragma once

#include <string>
#include <vector>

#include "algorithm/well_piece.h"

namespace wellknit {

struct WellTrial {
  std::vector<Cluster> clusters;  ///< one for each tube, each meshed alone; empty: it keeps its host cells
  double share = 0.0;             ///< of the length in rock that its tubes take
  std::string reason;             ///< the first that kept a larger radius or the whole well from a mesh; may be empty
};

/// The share of a well's length in rock that its tubes should take: smaller radii are tried until they do.
inline constexpr double share_wanted = 0.9;

/// `neighbours`: tubes that are there already. `largest_radius`: what the wells beside it leave, m. Bounded: a number
/// of radii is tried in turn, each in one mode or two.
WellTrial try_well(const WellTask& task, std::size_t well, double largest_radius,
                   const std::vector<Neighbour>& neighbours);

}  // namespace wellknit
