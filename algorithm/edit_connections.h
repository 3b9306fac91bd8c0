// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The last word of a deck on its connections: the EDIT section's transmissibilities, EDITNNC, PINCH, NNC, EDITNNCR.
#pragma once

#include <string>
#include <vector>

#include "algorithm/assembly.h"
#include "algorithm/host_multipliers.h"

namespace wellknit {

/// Changes the mesh's connections and adds those without a face, in OPM Flow's order. A connection of a source cell
/// that was replaced goes to the made cells, shared by their parts of its volume. One sentence for each thing that
/// could not be carried to the cells around the wells. Needs connections and the transfer map.
std::vector<std::string> edit_connections(const CornerPointGrid& grid, const HostMesh& host,
                                          const HostMultipliers& multipliers, Assembly& assembly);

}  // namespace wellknit
