// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The reference space E_ref (method.md §4): the host near a well as a non-uniform Cartesian grid.
///
/// Source: T. Mouton, C. Bennis, H. Borouchaki (key Mouton).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algorithm/near_well_grid.h"

namespace wellknit {

/// A block of source cells, [low, high) along each axis; along k in places, downwards.
struct CellRange {
  std::array<std::int64_t, 3> low{};
  std::array<std::int64_t, 3> high{};

  [[nodiscard]] bool contains(const std::array<std::int64_t, 3>& c) const {
    return c[0] >= low[0] && c[0] < high[0] && c[1] >= low[1] && c[1] < high[1] && c[2] >= low[2] && c[2] < high[2];
  }
};

/// An axis-parallel box in E_ref.
struct Box {
  Vec3 low;
  Vec3 high;
};

/// Planes of E_ref. In a left-handed grid the second axis runs backwards, so that the mapping keeps orientation.
class ReferenceSpace {
 public:
  /// Spacings are the mean edge lengths of the existing source cells of `region` (of all cells where none exists), in
  /// the grid's parts and layers, rounded to a multiple of reference_resolution so that mirror images are exact. With
  /// `path`, source cells (i, j, place) that wells run through, a slab's mean is over those of its cells that stand at
  /// the part of the path nearest to the slab, and one around them: where layers swell and thin out along a well, each
  /// is as thick as where the well crosses it.
  ReferenceSpace(const NearWellGrid& grid, const CellRange& region,
                 const std::vector<std::array<std::int64_t, 3>>& path = {});

  /// Coordinate of plane `index` (0 … n) of an axis.
  [[nodiscard]] double plane(int axis, std::int64_t index) const {
    return planes_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(index)];
  }
  [[nodiscard]] Vec3 node(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return {plane(0, i), plane(1, j), plane(2, k)};
  }
  [[nodiscard]] Box box(const std::array<std::int64_t, 3>& cell) const;
  /// phi_0 of a located point.
  [[nodiscard]] Vec3 map(const std::array<std::int64_t, 3>& cell, const Vec3& uvw) const;
  [[nodiscard]] Vec3 map(const NearWellLocation& at) const { return map(at.cell, at.uvw); }
  /// The place among the planes of a coordinate: index of the cell (0 … n-1, the end ones also outside) and the
  /// fraction in it.
  [[nodiscard]] std::pair<std::int64_t, double> place(int axis, double coordinate) const;

 private:
  std::array<std::vector<double>, 3> planes_;
};

/// Coordinates of E_ref and of the sites are multiples of this, m: reflections in the planes are then exact in doubles
/// up to 2^14 m from the middle of a cavity, and the faces of the smallest cells (0.1 m, at a bore) are planar to
/// 1e-10.
inline constexpr double reference_resolution = 0x1p-38;

/// Nearest multiple of reference_resolution.
double on_reference_lattice(double value);

}  // namespace wellknit
