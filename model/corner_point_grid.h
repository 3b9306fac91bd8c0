// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The source grid as it was read: Eclipse corner-point geometry and per-cell properties, in SI.
/// The drawing of corners and (i,j,k) is in docs/conventions.md.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "model/connection_edits.h"
#include "model/geometry.h"
#include "model/ids.h"
#include "model/units.h"

namespace wellknit {

/// Every other per-cell keyword (SATNUM, SWAT …), in the units of the source.
using CellProperty = std::variant<std::vector<double>, std::vector<std::int32_t>>;

struct CornerPointGrid {
  std::array<std::int64_t, 3> dimensions{};  ///< nx, ny, nz, each at least 1

  /// 6 (nx+1)(ny+1): per pillar x, y, depth of its top and of its bottom point, m; pillar (i, j) at 6 (i + (nx+1) j).
  std::vector<double> coord;
  /// 8 nx ny nz: depth of every corner, m, in Eclipse's order; see zcorn_index().
  std::vector<double> zcorn;
  std::vector<std::uint8_t> active;  ///< nx ny nz, 1 active

  std::vector<double> porosity;                     ///< nx ny nz; empty: not given
  std::vector<double> net_to_gross;                 ///< nx ny nz; empty: 1 everywhere
  std::array<std::vector<double>, 3> permeability;  ///< along i, j, k; nx ny nz each, m2; empty: not given
  std::map<std::string, CellProperty> properties;   ///< every other per-cell keyword

  /// Of properties that the source gives in some active cells only: nx ny nz, 1 where it does. The property's own array
  /// has a default in the others.
  std::map<std::string, std::vector<std::uint8_t>> property_given;

  std::optional<std::array<double, 6>> mapaxes;  ///< as in the source
  UnitSystem units = UnitSystem::metric;         ///< of the source; the arrays here are SI already
  bool connects_across_pinch = false;            ///< PINCH given: cells above and below a zero-thickness cell connect
  double metre_per_map_unit = 1.0;               ///< MAPUNITS: the unit of mapaxes
  bool has_map_coordinates = false;  ///< GRIDUNIT … MAP: coord is in the map's frame, not in that of mapaxes
  ConnectionEdits edits;             ///< what the deck says about connections and pore volumes

  [[nodiscard]] std::int64_t cell_count() const { return dimensions[0] * dimensions[1] * dimensions[2]; }
  [[nodiscard]] HostCellId cell_id(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return HostCellId(i + dimensions[0] * (j + dimensions[1] * k));
  }
  [[nodiscard]] std::array<std::int64_t, 3> ijk(HostCellId cell) const {
    const std::int64_t c = cell.value();
    return {c % dimensions[0], (c / dimensions[0]) % dimensions[1], c / (dimensions[0] * dimensions[1])};
  }
  /// Place in zcorn of corner (di, dj, dk), each 0 or 1, of cell (i, j, k).
  [[nodiscard]] std::size_t zcorn_index(std::array<std::int64_t, 3> cell, int di, int dj, int dk) const {
    const auto [i, j, k] = cell;
    return static_cast<std::size_t>((2 * i + di) +
                                    2 * dimensions[0] * ((2 * j + dj) + 2 * dimensions[1] * (2 * k + dk)));
  }
  /// The point at this depth on pillar (i, j), 0 <= i <= nx, 0 <= j <= ny.
  [[nodiscard]] Vec3 pillar_point(std::int64_t i, std::int64_t j, double depth) const;
  /// The eight corners of a cell, corner (di, dj, dk) at di + 2 dj + 4 dk.
  [[nodiscard]] std::array<Vec3, 8> corners(HostCellId cell) const;
};

/// Signed volume of the hexahedron with bilinear faces; positive where i, j, k make a right-handed triple.
double bilinear_hexahedron_volume(const std::array<Vec3, 8>& corners);

/// Throws InvalidInput when array lengths do not fit the dimensions or a coordinate is not finite.
void validate(const CornerPointGrid& grid);

}  // namespace wellknit
