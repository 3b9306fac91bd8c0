// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The wells of a deck's schedule and where their completions are in the mesh, before any text is changed.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "algorithm/cell_locator.h"
#include "conversion/source_cells.h"
#include "model/case.h"
#include "model/mesh.h"
#include "readers/whole_deck.h"

namespace wellknit {

/// An open cell of a well with a radial mesh.
struct MeshedConnection {
  CellId cell;
  double factor = 0.0;                  ///< m3, with the build's skin
  double permeability_thickness = 0.0;  ///< m3
  MeasuredDepthRange measured_depth;    ///< m
  HostCellId owner;                     ///< the completed source cell that it belongs to; invalid: none is completed
};

struct ScheduleWell {
  std::string name;
  std::optional<std::int64_t> head_i;  ///< of its last WELSPECS, from 0
  std::optional<std::int64_t> head_j;
  std::vector<HostCellId> completed;          ///< active cells that COMPDAT ever names, in the order of the deck
  std::unordered_set<std::int64_t> known;     ///< the same
  std::vector<HostCellId> first;              ///< those of its first COMPDAT keyword
  int compdat_keywords = 0;                   ///< that name new cells of it
  bool has_trajectory = false;                ///< COMPTRAJ
  bool is_meshed = false;                     ///< its connections are those of the mesh
  double bore_radius = 0.0;                   ///< m, of the mesh
  double skin = 0.0;                          ///< of the mesh's factors
  std::vector<MeshedConnection> connections;  ///< where meshed: along the bore
};

/// Lists of WLIST, by "*NAME" in upper case.
using WellLists = std::map<std::string, std::vector<std::string>>;

class ScheduleWells {
 public:
  /// Reads WELSPECS and COMPDAT of the whole schedule; `meshed` are the names of wells with a radial mesh, `wells` what
  /// they were built from. Throws ParseError.
  ScheduleWells(const WholeDeck& deck, const Case& source, const std::vector<Well>& wells, const Mesh& mesh,
                const std::vector<std::string>& meshed, const DeckGrid& grid, const SourceCells& cells);

  [[nodiscard]] const std::vector<ScheduleWell>& all() const { return wells_; }
  [[nodiscard]] const ScheduleWell* find(std::string_view name) const;
  /// Wells whose name fits a name, a pattern or a list.
  [[nodiscard]] std::vector<const ScheduleWell*> named(std::string_view pattern, const WellLists& lists) const;
  /// Cells of a COMPDAT record for this well, active or not.
  [[nodiscard]] std::vector<HostCellId> cells_of(const DeckTextKeyword& keyword, const DeckTextRecord& record,
                                                 const ScheduleWell& well) const;
  /// Cells in the order in which the simulator goes through a well by default (TRACK).
  [[nodiscard]] std::vector<HostCellId> in_track_order(const ScheduleWell& well, std::vector<HostCellId> cells) const;
  /// m: the depth of the first connection, where WELSPECS leaves the reference depth out. Nothing without connections.
  [[nodiscard]] std::optional<double> default_reference_depth(const ScheduleWell& well) const;
  /// The mesh's cell where the well begins.
  [[nodiscard]] CellId head_cell(const ScheduleWell& well) const;

 private:
  ScheduleWell* find_mutable(std::string_view name);
  void read_heads(const DeckTextKeyword& keyword);
  void read_completions(const DeckTextKeyword& keyword, const WellLists& lists);
  void take_mesh(const std::vector<Well>& wells, const Mesh& mesh, const std::vector<std::string>& meshed,
                 const DeckGrid& grid);
  void set_owners(ScheduleWell& well, const Trajectory& path, std::size_t first, const Mesh& mesh);

  const WholeDeck& deck_;
  const CornerPointGrid& grid_;
  const SourceCells& cells_;
  std::vector<ScheduleWell> wells_;
  std::unique_ptr<CellLocator> locator_;  ///< made when first needed
};

/// NEW, ADD, DEL or MOV of WLIST.
void update_lists(const WholeDeck& deck, const DeckTextKeyword& keyword, const ScheduleWells& wells, WellLists& lists);

/// 0, 1 or 2 for X, Y or Z. Throws ParseError.
int completion_axis(const WholeDeck& deck, const DeckTextKeyword& keyword, const DeckTextRecord& record);

}  // namespace wellknit
