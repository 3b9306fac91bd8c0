// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A self-contained deck that OPM Flow runs: the mesh as a connection list, the wells on bottom-hole pressure
/// (docs/formats/deck.md).
#pragma once

#include <string>

#include "model/mesh.h"

namespace wellknit {

/// Writes beside the target and renames. Throws WriteError.
void write_flow_deck(const Mesh& mesh, const std::string& path);

}  // namespace wellknit
