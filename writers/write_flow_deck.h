// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A self-contained deck that OPM Flow runs: the mesh as a connection list, the wells on bottom-hole pressure
/// (docs/formats/deck.md).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/mesh.h"
#include "writers/output_file.h"

namespace wellknit {

/// The fluids of the deck's template.
enum class FlowFluids : std::uint8_t {
  oil_and_water,  ///< dead oil at connate water, compressible; injectors bring water
  water           ///< one phase, next to incompressible: reaches its steady state at once
};

struct FlowDeckOptions {
  FlowFluids fluids = FlowFluids::oil_and_water;
};

/// Writes beside the target and renames. Returns what a user of the deck must know, one sentence each: cells left out,
/// connections that Flow will not see, wells renamed. Throws WriteError, and InvalidInput for a mesh without cells. The
/// mesh's structure must be right (check_structure()).
std::vector<std::string> write_flow_deck(const Mesh& mesh, const std::string& path, const FlowDeckOptions& options = {},
                                         Overwrite overwrite = Overwrite::refuse);

}  // namespace wellknit
