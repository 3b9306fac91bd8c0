// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Where the cells of the mesh stand in a deck's (i,j,k) and what geometry they get there. What OPM Flow makes of each
/// layout: docs/formats/deck.md.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "model/corner_point_grid.h"
#include "model/mesh.h"

namespace wellknit {

enum class DeckLayoutKind : std::uint8_t {
  row,       ///< N x 1 x 1, boxes side by side; x and y mean nothing
  portable,  ///< (2N-1) x 1 x 1, boxes at their true x and y, with an inactive cell between every two
  nested     ///< the source grid, its replaced cells inactive, and made cells in columns beyond the last I
};

/// A box for each cell, of its volume, depth and horizontal projection.
struct DeckBoxes {
  std::vector<double> area;       ///< m2, of the projection
  std::vector<double> thickness;  ///< m
  double above_all = 0.0;         ///< a depth above every box, m
  double below_all = 0.0;
};

class DeckLayout {
 public:
  virtual ~DeckLayout() = default;

  [[nodiscard]] const std::array<std::int64_t, 3>& dimensions() const { return dimensions_; }
  /// nx ny nz, the mesh's cell that stands there; no_cell for one that the deck has for its form alone.
  [[nodiscard]] const std::vector<CellId>& cell_at() const { return cell_at_; }
  /// Number of the mesh's cell among nx ny nz.
  [[nodiscard]] std::int64_t place(CellId cell) const { return place_[cell]; }
  /// The same as (i,j,k), from 1.
  [[nodiscard]] std::array<std::int64_t, 3> ijk(CellId cell) const;
  /// x, y, depth of a pillar's top and bottom, m.
  [[nodiscard]] virtual std::array<double, 6> pillar(std::int64_t i, std::int64_t j) const = 0;
  /// Depths of the eight corners, corner (di,dj,dk) at di + 2 dj + 4 dk, m.
  [[nodiscard]] virtual std::array<double, 8> depths(std::int64_t place) const = 0;
  /// True where the form connects cells of the mesh by their geometry, so that this has to be taken back.
  [[nodiscard]] virtual bool connects_boxes() const = 0;

 protected:
  explicit DeckLayout(std::size_t cells) : place_(cells) {}
  void set_dimensions(const std::array<std::int64_t, 3>& dimensions);
  void set_place(CellId cell, std::int64_t place);

 private:
  std::array<std::int64_t, 3> dimensions_{};
  std::vector<CellId> cell_at_;
  IdVector<CellId, std::int64_t> place_;
};

/// What a layout is made of; everything must outlive it.
struct DeckLayoutInput {
  const Mesh& mesh;
  const DeckBoxes& boxes;
  std::vector<CellId> order;                ///< of the cells (of the made ones in the nested form)
  const CornerPointGrid* source = nullptr;  ///< needed by the nested form; else unchanged cells take its depths
};

/// Throws InvalidInput: the nested form without a source grid, with one that is not the mesh's, or with more cells than
/// a deck should have.
std::unique_ptr<DeckLayout> make_deck_layout(DeckLayoutKind form, const DeckLayoutInput& input);

}  // namespace wellknit
