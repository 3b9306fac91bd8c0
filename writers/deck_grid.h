// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The mesh as the GRID and EDIT sections of a deck: cells in a layout (deck_layout.h), every connection as an NNC.
/// Why each part is as it is, with what Flow does otherwise, stands in docs/formats/deck.md.
#pragma once

#include <cstdint>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "model/corner_point_grid.h"
#include "model/mesh.h"
#include "writers/cell_order.h"
#include "writers/deck_layout.h"

namespace wellknit {

struct DeckGridOptions {
  UnitSystem units = UnitSystem::metric;  ///< of the deck
  /// The mesh's source grid, or none: the boxes of unchanged host cells then take their corners' depths, so that an
  /// equilibrium that looks inside cells finds what it found in the source.
  const CornerPointGrid* source = nullptr;
  DeckLayoutKind form = DeckLayoutKind::row;  ///< the nested one needs the source grid
  CellOrder order = CellOrder::mesh;
};

class DeckGrid {
 public:
  /// References must outlive this. Throws InvalidInput for a mesh without cells, and as make_deck_layout() does.
  DeckGrid(const Mesh& mesh, const DeckGridOptions& options);

  /// What follows the keyword GRID: INIT, GRIDFILE, boxes, rock, NNC.
  void write_grid(std::ostream& out) const;
  /// What follows the keyword EDIT: pore volumes, and no transmissibility from the boxes.
  void write_edit(std::ostream& out) const;

  /// Cells without pore volume are inactive: nothing may connect to them.
  [[nodiscard]] bool is_active(CellId cell) const { return active_[cell.index()]; }
  [[nodiscard]] std::int64_t inactive_cells() const;
  [[nodiscard]] std::int64_t inactive_connections() const { return inactive_connections_; }
  [[nodiscard]] std::size_t connection_count() const { return nnc_.size(); }
  [[nodiscard]] double thickness(CellId cell) const { return boxes_.thickness[cell.index()]; }  ///< m
  [[nodiscard]] const DeckLayout& layout() const { return *layout_; }
  /// Sentences on connections that Flow sets to zero and on boxes that are thicker than their cells.
  [[nodiscard]] std::vector<std::string> notes() const;

 private:
  struct Nnc {
    std::int64_t first, second;  ///< places in the layout, the smaller first
    double transmissibility;     ///< in deck units
  };
  void measure_boxes();
  void collect_connections();
  [[nodiscard]] bool is_exempt(const Nnc& nnc) const;
  /// A keyword with a number for each place: that of its cell, or `none` where no cell stands.
  template <class Value>
  void write_array(std::ostream& out, const char* keyword, double none, Value value) const;
  void write_coord(std::ostream& out) const;
  void write_zcorn(std::ostream& out) const;
  void write_nnc(std::ostream& out) const;

  const Mesh& mesh_;
  DeckGridOptions options_;
  double metre_;  ///< per length unit of the deck
  DeckBoxes boxes_;
  std::vector<bool> active_;  ///< has a pore volume
  std::unique_ptr<DeckLayout> layout_;
  std::vector<Nnc> nnc_;        ///< each pair once, sorted
  std::int64_t thickened_ = 0;  ///< cells that are thinner than the thinnest box
  std::int64_t inactive_connections_ = 0;
  std::int64_t too_small_ = 0;  ///< records that Flow sets to zero
};

}  // namespace wellknit
