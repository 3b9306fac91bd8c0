// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Deformed grids and wells for tests of the near-well mesh.
#pragma once

#include "model/case.h"
#include "model/well.h"

namespace wellknit::near_well {

/// 20 x 20 x 12 cells of 40 x 40 x 15 m from 2000 m on: a dome with waves, layers of uneven thickness and slanted
/// pillars, all times `deformation`; 0 gives a box grid. Porosity 0.2, permeability 1e-13 m2 laterally and 1e-14 m2
/// vertically.
Case deformed(double deformation);

/// Permeability and porosity that vary from cell to cell, from a generator with this seed.
void randomise(CornerPointGrid& grid, std::uint32_t seed);

enum class Path { vertical, deviated, curved, horizontal };

/// A well through the middle of deformed(deformation); vertical from above the top to below the base.
Well well(Path path, double drainage_radius);

/// A straight well between two points, 51 stations.
Well straight(const std::string& name, const Vec3& from, const Vec3& to);

}  // namespace wellknit::near_well
