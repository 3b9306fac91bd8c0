// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Values carried along a mesh's transfer map, from the source grid's cells to the mesh's and back.
///
/// A part of a source cell s in a mesh cell c has the fraction f of s: the volume f V_s and the pores f P_s. Sums are
/// conserved to rounding wherever every cell with a value has parts; means conserve the sum of value * weight.
#pragma once

#include <cstdint>
#include <vector>

#include "model/mesh.h"

namespace wellknit {

enum class PartWeight : std::uint8_t {
  volume,
  pore_volume  ///< where a cell has no pores at all, its parts' volumes
};

/// Values that are not numbers are left out; a cell of the target without any value gets `unset`. All functions throw
/// InvalidInput when the mesh has no map, when it lacks the volumes of the source cells, or when the number of values
/// is not that of the source grid's (forward) or of the mesh's cells (back).

/// Intensive: the mean over a mesh cell's parts.
std::vector<double> mean_forward(const Mesh& mesh, const std::vector<double>& values, PartWeight weight, double unset);
/// Extensive: each source cell's amount is shared out as its fractions say. `unset` where there is no part.
std::vector<double> sum_forward(const Mesh& mesh, const std::vector<double>& values, double unset);
/// Integers: the value with the largest part in the mesh cell; the smallest of equal ones.
std::vector<std::int32_t> largest_forward(const Mesh& mesh, const std::vector<std::int32_t>& values, PartWeight weight,
                                          std::int32_t unset);

/// Intensive: the mean over a source cell's parts; its porosity is one, so volumes and pores weigh alike.
std::vector<double> mean_back(const Mesh& mesh, const std::vector<double>& values, double unset);
/// Extensive: each mesh cell's amount is shared out over its parts by their weights.
std::vector<double> sum_back(const Mesh& mesh, const std::vector<double>& values, PartWeight weight, double unset);
std::vector<std::int32_t> largest_back(const Mesh& mesh, const std::vector<std::int32_t>& values, std::int32_t unset);

}  // namespace wellknit
