// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Steady single-phase flow on a mesh's connection list, for tests: viscosity 1, no gravity.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "model/mesh.h"

namespace wellknit::steady_flow {

/// Pressures of all cells. `fixed` gives a cell's pressure or nothing; every well's bore is at `bore_pressure`.
std::vector<double> pressures(const Mesh& mesh, double bore_pressure,
                              const std::function<std::optional<double>(CellId)>& fixed);

/// Flow into the bore of a well.
double well_rate(const Mesh& mesh, WellId well, double bore_pressure, const std::vector<double>& pressure);

}  // namespace wellknit::steady_flow
