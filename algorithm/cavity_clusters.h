// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Cavities that stand in each other's way: those in the same columns get the same cells, those that touch become one
/// (docs/algorithms/wells.md).
#pragma once

#include <string>
#include <vector>

#include "algorithm/host_refinement.h"
#include "algorithm/well_piece.h"

namespace wellknit {

/// Changes the clusters until none is in another's way, and returns how the host must be refined for them. After
/// `most_rounds` the last cluster gives way, and the count begins anew. `reasons`, per well: the first why a piece gave
/// way.
RefinementPlan resolve_conflicts(const WellTask& task, std::vector<Cluster>& clusters,
                                 std::vector<std::string>& reasons, int most_rounds = 12);

}  // namespace wellknit
