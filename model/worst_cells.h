// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The cells that a user should look at first.
#pragma once

#include <cstddef>
#include <vector>

#include "model/quality.h"

namespace wellknit {

/// From where on a face is called bad: 70 and 90 degrees, 0.1, 4.
double reference_of(FaceMeasure measure);

/// At its worst face.
double value_of(const CellQuality& quality, CellId cell, FaceMeasure measure);

/// At most `count` cells for which `include` holds, the worst in this measure first; equal ones by their ids. Cells at
/// 0 are left out.
std::vector<CellId> worst_cells(const Mesh& mesh, const CellQuality& quality, FaceMeasure measure, std::size_t count,
                                bool (*include)(CellKind kind));

}  // namespace wellknit
