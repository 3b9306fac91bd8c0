// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// WELSEGS and COMPSEGS: a multi-segment well's nodes and the measured depths at which it is open to its cells, by
/// branch.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/corner_point_grid.h"
#include "model/well.h"
#include "readers/deck_stream.h"

namespace wellknit {

/// A node of WELSEGS, in the deck's units; increments are added up already.
struct DeckSegment {
  std::int64_t branch = 1;
  std::int64_t outlet = 0;  ///< number of the segment towards the head; 0 for the top
  double measured_depth = 0.0;
  double depth = 0.0;
  double x = 0.0;
  double y = 0.0;
  bool has_xy = false;  ///< the deck gives x and y of this node
};

/// A cell of COMPSEGS.
struct DeckSegmentCell {
  std::array<std::int64_t, 3> cell{};  ///< 0-based
  std::int64_t branch = 1;
  std::optional<MeasuredDepthRange> range;  ///< in the deck's units; nothing: not given
};

struct DeckSegments {
  std::map<std::int64_t, DeckSegment> nodes;  ///< by number; 1 is the top
  std::vector<DeckSegmentCell> cells;         ///< in the deck's order
};

/// What a record may name: 0-based index of item n along an axis, or nothing for a default. Throws ParseError.
using CellIndexReader =
    std::function<std::optional<std::int64_t>(const DeckRecord& record, std::size_t item, std::size_t axis)>;

/// The records of WELSEGS; `segments_of` gives the place for the well named in its first record. Throws ParseError.
void read_welsegs(DeckStream& stream, const std::function<DeckSegments&(const DeckRecord&)>& segments_of);

/// The records of COMPSEGS. Throws ParseError.
void read_compsegs(DeckStream& stream, const std::function<DeckSegments&(const DeckRecord&)>& segments_of,
                   const CellIndexReader& cell_index);

/// One well for each branch that has completed cells, the main bore first. `well` is in SI with its active completions,
/// each of which goes to its cell's branch. The path runs through the nodes where the deck gives their x and y, else
/// through the cells' centres (approximate_path). Measured depth is that of the deck. Empty when no path comes of it.
std::vector<Well> wells_with_segments(DeckStream& stream, const Well& well, const DeckSegments& segments,
                                      const CornerPointGrid& grid);

}  // namespace wellknit
