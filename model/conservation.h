// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What the mesh kept of its source: bulk and pore volume, by the map from the source grid.
#pragma once

#include <array>
#include <optional>

#include "model/mesh.h"

namespace wellknit {

/// Volumes in m3. "Source" is the active source cells: those that the map sends somewhere.
struct Conservation {
  double source_bulk = 0.0;
  double source_pores = 0.0;
  std::array<double, 4> bulk_of_kind{};   ///< of the mesh, by CellKind
  std::array<double, 4> pores_of_kind{};  ///< the same
  double largest_fraction_error = 0.0;    ///< of a source cell's fractions from 1

  [[nodiscard]] double mesh_bulk() const;
  [[nodiscard]] double mesh_pores() const;
  /// Relative, without sign; 0 where source and mesh have none.
  [[nodiscard]] double bulk_error() const;
  [[nodiscard]] double pore_error() const;
};

/// Unset where the mesh does not know its source's volumes. The mesh's structure must be right (check_structure()).
std::optional<Conservation> conservation(const Mesh& mesh);

}  // namespace wellknit
