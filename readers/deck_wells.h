// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The wells of a deck's schedule over all time steps: WELSPECS, WLIST, COMPDAT, the injection controls, and the paths
/// by WELTRAJ and COMPTRAJ, by WELSEGS and COMPSEGS, or through the completed cells, in this order of preference.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "model/corner_point_grid.h"
#include "model/well.h"
#include "readers/cell_arrays.h"
#include "readers/deck_segments.h"
#include "readers/deck_stream.h"
#include "readers/deck_trajectories.h"

namespace wellknit {

class DeckWells {
 public:
  DeckWells(DeckStream& stream, const CellArrays& cells) : stream_(stream), cells_(cells) {}

  // Each reads the records of the current keyword.
  void read_welspecs();
  void read_compdat();
  /// WCONINJE and its kin: the wells named are injectors from then on.
  void read_injectors();
  /// WELTRAJ, COMPTRAJ, WELSEGS, COMPSEGS or WLIST.
  void read_path(std::string_view keyword);

  /// Wells with a path, in the deck's order, each branch a well of its own after its main bore, in SI. A well without a
  /// trajectory and without completions in active cells is left out with a note.
  std::vector<Well> finish(const CornerPointGrid& grid);

 private:
  /// As the deck gives them, in its units.
  struct Specification {
    Well well;
    std::optional<std::int64_t> i;  ///< 0-based
    std::optional<std::int64_t> j;
    std::int64_t line = 0;
    std::unordered_map<std::int64_t, std::size_t> completion_of_cell;
    DeckBranches branches;
    DeckSegments segments;
  };

  std::optional<std::int64_t> cell_index(const DeckRecord& record, std::size_t item, std::size_t axis) const;
  std::vector<Specification*> named(const DeckRecord& record);
  /// As named, and one at least. Throws ParseError.
  std::vector<Specification*> need_named(const DeckRecord& record);
  void read_trajectories(std::string_view keyword);
  void read_well_list();
  DeckCompletion read_completion(const DeckRecord& record) const;
  void complete(Specification& specification, const DeckRecord& record, const DeckCompletion& completion);
  std::vector<Well> finish_well(const Specification& specification, const CornerPointGrid& grid);

  DeckStream& stream_;
  const CellArrays& cells_;
  std::vector<Specification> specifications_;
  std::map<std::string, std::vector<std::string>> lists_;  ///< of WLIST: names of wells, by "*NAME" in upper case
  std::int64_t trajectory_keywords_ = 0;
};

}  // namespace wellknit
