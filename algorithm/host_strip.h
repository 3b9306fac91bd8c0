// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Second step of the host: the strip between two neighbouring pillars, where the sides of two columns meet. First the
/// crossings of all strips are found and get their ids, then the faces are written.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "algorithm/host_face_writer.h"
#include "algorithm/host_mesh.h"

namespace wellknit {

/// The side of one column in a strip. The other side of the grid's boundary has no levels.
struct StripSide {
  std::span<const std::int32_t> p;  ///< ranks of its levels on pillar p, rising; two for each cell, or none
  std::span<const std::int32_t> q;
  HostColumn column;  ///< its cells, for the faces

  [[nodiscard]] FaceCell cell(std::int64_t place) const { return place < 0 ? FaceCell{} : column.cell(place); }
};

/// One strip: its axis, the two columns, and its pillars. p to q and then down turns right-handed about the axis, from
/// side 0 to side 1, in a grid whose i, j, depth are right-handed.
struct Strip {
  Axis axis = Axis::i;
  std::array<std::int64_t, 2> pillar_p{};
  std::array<std::int64_t, 2> pillar_q{};
  VertexId first_p;  ///< uppermost node of pillar p
  VertexId first_q;
  std::array<StripSide, 2> sides;

  [[nodiscard]] VertexId on_p(std::int64_t rank) const { return VertexId(first_p.value() + rank); }
  [[nodiscard]] VertexId on_q(std::int64_t rank) const { return VertexId(first_q.value() + rank); }
  /// Both columns have the same lines, or there is only one.
  [[nodiscard]] bool is_matched() const;
};

/// The crossings on one line of one column, from pillar p to pillar q.
struct LineCut {
  std::int32_t p;  ///< rank of the line on pillar p
  std::int32_t q;
  std::size_t begin;  ///< in StripCuts::cut_vertices
  std::size_t end;
};

/// The crossings of a row of strips. Until they are numbered their ids count from 0 in the row.
struct StripCuts {
  std::vector<Vec3> crossings;
  std::vector<LineCut> cuts;  ///< lines with crossings; downwards within a side of a strip
  std::vector<VertexId> cut_vertices;
  std::vector<std::size_t> cut_start{0};       ///< offsets into cuts: both sides of each strip in turn
  std::vector<std::int64_t> first_crossing;    ///< id, for each strip
  static constexpr std::int64_t matched = -1;  ///< instead of it: the strip has the same lines on both sides

  /// Crossings on the line between ranks p and q of side 0 or 1 of a strip of the row.
  [[nodiscard]] std::span<const VertexId> cuts_of(std::int64_t strip, int side, std::int32_t p, std::int32_t q) const;
  [[nodiscard]] bool has_cuts(std::int64_t strip, int side) const {
    const auto at = static_cast<std::size_t>(2 * strip + side);
    return cut_start[at] != cut_start[at + 1];
  }
  /// Makes the ids those of the whole mesh.
  void number_from(VertexId first);
};

/// The points of a strip's pillars p and q at a depth.
using PillarPair = std::function<std::array<Vec3, 2>(double depth)>;

/// The lines of two columns laid over each other; for strips that are not matched.
class StripOverlay {
 public:
  /// Reads the strip's lines and finds which of them cross. `first_crossing` becomes the id of the first.
  void read(const Strip& strip, std::int64_t first_crossing);
  [[nodiscard]] std::int64_t crossing_count() const { return crossing_count_; }
  void add_crossings(const PillarPair& pillars, const Strip& strip, const IdVector<VertexId, Vec3>& nodes,
                     StripCuts& out) const;
  void add_faces(const Strip& strip, HostFaceWriter& writer) const;

 private:
  /// The different lines of one side, between a line above and one below everything.
  struct Lines {
    std::vector<std::int32_t> p;  ///< rank on pillar p
    std::vector<std::int32_t> q;
    std::vector<std::int32_t> place;  ///< of the cell between lines l and l + 1; -1 where there is none
    void read(const StripSide& side);
    [[nodiscard]] std::size_t regions() const { return p.size() - 1; }
  };
  /// Lines of the other side that cross a line: [first, last), all in the same sense.
  struct Crossed {
    std::size_t first = 0;
    std::size_t last = 0;
    bool falls = false;  ///< p to q, it goes from above them to below them
  };
  /// One end, on pillar p or q, of the common part of a region of each side.
  struct End {
    bool on_pillar = true;
    std::int64_t low = 0;   ///< rank of its uppermost node, or the crossing
    std::int64_t high = 0;  ///< of its deepest node
    int upper_line = 0;     ///< whose line bounds it above: -1 side 0, 1 side 1, 0 both
    int lower_line = 0;
  };

  static Crossed crossed_by(std::int32_t p, std::int32_t q, const Lines& others);
  void add_cuts(std::size_t side, StripCuts& out) const;
  [[nodiscard]] std::int64_t crossing(std::size_t line0, std::size_t line1) const;
  [[nodiscard]] End end_of(bool at_p, std::size_t region0, std::size_t region1) const;
  void add_face(const Strip& strip, std::size_t region0, std::size_t region1, HostFaceWriter& writer) const;
  [[nodiscard]] bool covers(int side, std::size_t region0, std::size_t region1) const;

  std::array<Lines, 2> lines_;
  std::vector<Crossed> crossed_;              ///< of side 0's lines
  std::vector<std::int64_t> first_crossing_;  ///< id of each line's first one
  std::int64_t crossing_count_ = 0;
};

/// The faces of a strip whose columns have the same lines, or of one at the grid's boundary.
void add_matched_faces(const Strip& strip, HostFaceWriter& writer);

}  // namespace wellknit
