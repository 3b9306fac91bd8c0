// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Two-point transmissibilities fitted to multi-point flow on the same mesh (docs/algorithms/adapted_flux.md): for
/// simulators that take one number a connection. Transmissibilities from a computed flow towards the wells are those of
/// near-well upscaling (key `Ding`, `DurlofskyMillikenBernath`).
#pragma once

#include <cstdint>

#include "model/mesh.h"

namespace wellknit {

struct FluxDefects;

/// What fitting did.
struct FluxAdaptation {
  std::int64_t fields = 0;        ///< flows that were fitted to; 0: nothing was changed
  std::int64_t not_solved = 0;    ///< flows that were left out, since their equations were not solved
  std::int64_t connections = 0;   ///< that could change
  std::int64_t changed = 0;       ///< of these, by more than a hundredth
  std::int64_t at_limit = 0;      ///< of these, by as much as is allowed
  double imbalance_before = 0.0;  ///< of the cells, when two-point fluxes take the fields' pressures: over their flow
  double imbalance_after = 0.0;
};

/// Changes transmissibility and linear_flux_error of the connections of a mesh with wells and stencils; `defects`:
/// those that the stencils were made from. Where no well is open to a cell that conducts nothing changes. Connections
/// without a face and those inside of tubes stay; no other becomes more than 10 times as large or as small. The same
/// bytes for any number of threads.
FluxAdaptation adapt_transmissibilities(Mesh& mesh, const FluxDefects& defects);

}  // namespace wellknit
