// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// How well the connections carry a linear pressure: what two-point fluxes leave out (docs/commands/check.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "model/mesh.h"

namespace wellknit {

/// Over faces with a refined or transition cell on a side and no radial one: inside a tube fluxes are those of radial
/// flow, which a linear pressure is not. By the direction of the slope: x, y, depth. Of the flux of a face of the same
/// area across the slope's own flow.
struct LinearFluxErrors {
  std::int64_t faces = 0;
  std::array<double, 3> area_mean{};  ///< weighted with the faces' areas
  std::array<double, 3> max{};
};

/// Unset where the mesh does not have the errors (files of earlier versions) or no such face.
std::optional<LinearFluxErrors> linear_flux_errors(const Mesh& mesh);

}  // namespace wellknit
