// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What is odd about the cells of a corner-point grid, by (i,j,k), and what the mesh makes of it
/// (docs/algorithms/host.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wellknit {

/// Each is measured on active cells, as the grid gives them; the first four on what is left of a cell where a
/// corner was moved.
enum class GridOddity : std::uint8_t {
  reversed_corners,  ///< base above the top on a pillar; m
  negative_volume,   ///< thickness, but a volume of 0 or less; m3
  self_overlapping,  ///< top or base is a bow-tie, or two of its pillars cross within it; least scaled Jacobian
  twisted,           ///< a corner's Jacobian is 0 or less, as in concave and twisted cells; least scaled Jacobian
  overlapping,       ///< the top lies above what stands over it in its column; m
  gap,               ///< a void between two cells that follow each other in a column; m
  crossing_pillars   ///< two neighbouring pillars pass each other where cells stand on them; degrees
};
inline constexpr std::size_t grid_oddity_count = 7;

/// "not a cell" in an OddPlace.
inline constexpr std::array<std::int64_t, 3> no_place{-1, -1, -1};

struct OddPlace {
  std::array<std::int64_t, 3> cell = no_place;   ///< (i,j,k) from 0; of crossing_pillars a pillar (i,j), k = -1
  std::array<std::int64_t, 3> other = no_place;  ///< the cell over it (overlapping, gap) or the other pillar
  double figure = 0.0;  ///< how much, in the unit of its kind; larger is worse, but for a Jacobian smaller
  bool operator==(const OddPlace&) const = default;
};

struct OddPlaces {
  std::int64_t count = 0;
  std::vector<OddPlace> first;  ///< up to 10, by k, then j, then i
  OddPlace worst;               ///< the first one with the worst figure
  double area = 0.0;            ///< of gaps: their extent in plan, m2; else 0
  bool operator==(const OddPlaces&) const = default;
};

struct GridValidity {
  std::array<OddPlaces, grid_oddity_count> kinds;  ///< by GridOddity
  /// Parts of fault faces with nothing on the other side: normal where a throw opens a column. Unset: not counted.
  std::optional<std::int64_t> open_fault_faces;

  [[nodiscard]] const OddPlaces& operator[](GridOddity kind) const { return kinds[static_cast<std::size_t>(kind)]; }
  [[nodiscard]] OddPlaces& operator[](GridOddity kind) { return kinds[static_cast<std::size_t>(kind)]; }
  /// Nothing is odd; open fault faces are not.
  [[nodiscard]] bool empty() const;
  bool operator==(const GridValidity&) const = default;
};

/// "reversed_corners" …
std::string_view name_of(GridOddity kind);
/// Unit of OddPlace::figure: "m", "m3", "degrees"; "" for a Jacobian.
std::string_view unit_of(GridOddity kind);
/// What the mesh makes of such cells, and what the user can do.
std::string_view treatment_of(GridOddity kind);
std::string_view advice_on(GridOddity kind);

/// One line for each kind that occurs: its count, what is done, the worst with its figure, the first ones, advice.
/// Counted from 1, without line ends.
std::vector<std::string> to_lines(const GridValidity& validity);
/// One JSON object: for each kind by its name `count`, `unit`, `done`, `advice`, `worst` and `first` (places: `cell`,
/// `other`, `figure`; counted from 1), of gaps `area`; `open_fault_faces`. What does not occur or is not known is left
/// out.
std::string to_json(const GridValidity& validity);

}  // namespace wellknit
