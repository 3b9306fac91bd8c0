// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// WELTRAJ and COMPTRAJ: paths and perforations of a deck's wells, by branch.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "model/corner_point_grid.h"
#include "model/well.h"
#include "readers/deck_stream.h"

namespace wellknit {

/// One branch as the deck gives it, in its units.
struct DeckBranch {
  struct Station {
    Vec3 point = Vec3::Zero();  ///< (x, y, depth)
    double measured_depth = 0.0;
  };
  struct PerforationRecord {
    Perforation perforation;  ///< range in measured depth or depth
    bool is_by_depth = false;
    std::int64_t line = 0;
  };
  std::vector<Station> stations;
  std::vector<PerforationRecord> perforations;
  std::int64_t keyword = 0;  ///< running number of the WELTRAJ that the stations came from
};

/// The branches of one well, by number; 1 is the main bore.
using DeckBranches = std::map<std::int64_t, DeckBranch>;

/// Item 2 of WELTRAJ and COMPTRAJ: 1 for a default.
std::int64_t branch_number(const DeckStream& stream, const DeckRecord& record);

/// A record of WELTRAJ after its well's name: a station. A later WELTRAJ that begins at or above the last measured
/// depth replaces the path, with a note. Throws ParseError when a number is missing or measured depth falls within one.
void add_station(DeckStream& stream, const DeckRecord& record, std::int64_t keyword, DeckBranches& branches);

/// A record of COMPTRAJ after its well's name. Throws ParseError.
void add_perforation(DeckStream& stream, const DeckRecord& record, DeckBranches& branches);

/// One well for each branch with a path, the main bore first, in SI: trajectory, open ranges, perforations, bore radius
/// and skin on top of what `well` has. Without COMPTRAJ the completions of `well` open it where its path crosses the
/// boxes of their cells. What is left out is noted.
std::vector<Well> wells_with_trajectories(DeckStream& stream, const Well& well, const DeckBranches& branches,
                                          const CornerPointGrid& grid);

}  // namespace wellknit
