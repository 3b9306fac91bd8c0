// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The wells of a deck's schedule: WELSPECS, COMPDAT and the injection controls, over all time steps.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "model/corner_point_grid.h"
#include "model/well.h"
#include "readers/cell_arrays.h"
#include "readers/deck_stream.h"

namespace wellknit {

class DeckWells {
 public:
  DeckWells(DeckStream& stream, const CellArrays& cells) : stream_(stream), cells_(cells) {}

  // Each reads the records of the current keyword.
  void read_welspecs();
  void read_compdat();
  /// WCONINJE and its kin: the wells named are injectors from then on.
  void read_injectors();

  /// Wells with a path, in the deck's order, in SI. A well without completions in active cells is left out with a note.
  std::vector<Well> finish(const CornerPointGrid& grid);

 private:
  /// As the deck gives them, in its units.
  struct Specification {
    Well well;
    std::optional<std::int64_t> i;  ///< 0-based
    std::optional<std::int64_t> j;
    std::int64_t line = 0;
    std::unordered_map<std::int64_t, std::size_t> completion_of_cell;
  };

  std::optional<std::int64_t> cell_index(const DeckRecord& record, std::size_t item, std::size_t axis) const;
  std::vector<Specification*> named(const DeckRecord& record);
  DeckCompletion read_completion(const DeckRecord& record) const;
  void complete(Specification& specification, const DeckRecord& record, const DeckCompletion& completion);
  std::optional<Well> finish_well(const Specification& specification, const CornerPointGrid& grid);

  DeckStream& stream_;
  const CellArrays& cells_;
  std::vector<Specification> specifications_;
};

}  // namespace wellknit
