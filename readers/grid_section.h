// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The keywords of a deck that make the grid: dimensions, geometry, units and arrays; at the end the grid in SI.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/corner_point_grid.h"
#include "readers/cell_arrays.h"
#include "readers/deck_connections.h"
#include "readers/deck_stream.h"
#include "readers/grid_part.h"

namespace wellknit {

/// Widths of columns and layers as DXV, DYV and DZV give them, in deck units; empty: not given.
using CellSpacing = std::array<std::vector<double>, 3>;

class GridSection {
 public:
  explicit GridSection(DeckStream& stream) : stream_(stream), arrays_(stream), connections_(stream, arrays_) {}

  // Each reads the records of the current keyword.
  void read_dimensions();
  void read_specgrid();
  void read_coord();
  void read_zcorn();
  void read_spacing();
  void read_mapaxes();
  void read_grid_unit();
  void read_map_units();
  void read_grid_orientation();
  void read_grid_options();

  /// What a binary, formatted or ROFF file holds: as if its keywords stood here. Throws ParseError when it does not fit
  /// what was read before. Defined in grid_part.cpp.
  void take(GridPart part, const std::string& file);

  void set_units(UnitSystem units) { units_ = units; }
  [[nodiscard]] UnitSystem units() const { return units_; }
  [[nodiscard]] CellArrays& arrays() { return arrays_; }
  [[nodiscard]] const CellArrays& arrays() const { return arrays_; }
  [[nodiscard]] DeckConnections& connections() { return connections_; }

  /// The grid, when everything is read. Throws ParseError when geometry is missing or a value cannot be.
  CornerPointGrid finish();

 private:
  void set_dimensions(const DeckRecord& record);
  void take_frame(const GridPart& part, bool is_first);
  void take_array(GridPartArray array);
  void make_geometry(CornerPointGrid& grid);
  void make_block_centred(CornerPointGrid& grid);
  void scale_lengths(CornerPointGrid& grid, double metre_per_unit) const;
  void fill_down(std::vector<double>& values, const std::string& name) const;
  void take_active(CornerPointGrid& grid);
  std::vector<double> take_rock_array(const std::string& name, const CornerPointGrid& grid);
  void take_properties(CornerPointGrid& grid);
  [[nodiscard]] std::optional<double> read_length_unit(const DeckRecord& record) const;
  [[noreturn]] void fail_missing(const std::string& keyword, ParseError::What what) const;

  DeckStream& stream_;
  CellArrays arrays_;
  DeckConnections connections_;
  UnitSystem units_ = UnitSystem::metric;
  std::optional<double> metre_per_grid_unit_;
  std::vector<double> coord_;
  std::vector<double> zcorn_;
  CellSpacing spacing_;
  std::optional<std::array<double, 6>> mapaxes_;
  double metre_per_map_unit_ = 1.0;
  bool has_map_coordinates_ = false;
};

}  // namespace wellknit
