// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Second step of the host: the faces in the strip between two neighbouring pillars, where the sides of two columns
/// meet.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithm/host_mesh.h"

namespace wellknit {

/// What a source cell is to the faces.
enum class HostCellState : std::uint8_t { none = 0, exists = 1, inactive = 2 };

/// Closes loops that were pushed to faces.vertices: turns them, orders the two cells, and fills the other arrays.
class HostFaceWriter {
 public:
  /// `mirrored`: i, j, depth make a left-handed triple.
  HostFaceWriter(HostFaces& faces, const std::vector<HostCellState>& states, bool mirrored)
      : faces_(faces), states_(states), mirrored_(mirrored) {}

  void push(std::int64_t vertex) { faces_.vertices.push_back(VertexId(vertex)); }
  /// The vertices pushed since the last close() are a face with its normal, where not mirrored, from `from` to `to`.
  /// One that no existing cell has or with fewer than three vertices is dropped.
  void close(HostCellId from, HostCellId to, Axis axis, bool is_fault, bool is_pinch);
  [[nodiscard]] HostCellState state(HostCellId cell) const {
    return cell.is_valid() ? states_[cell.index()] : HostCellState::none;
  }

 private:
  HostFaces& faces_;
  const std::vector<HostCellState>& states_;
  bool mirrored_;
};

/// The side of one column in a strip. The other side of the grid's boundary has no nodes.
struct StripSide {
  std::span<const std::int64_t> p;  ///< nodes of its levels on pillar p, downwards; 2 nz or none
  std::span<const std::int64_t> q;
  std::int64_t first_cell = 0;  ///< id of the uppermost cell
  std::int64_t cell_step = 0;   ///< to the id of the cell below

  [[nodiscard]] HostCellId cell(std::int64_t place) const {
    return place < 0 ? HostCellId{} : HostCellId(first_cell + place * cell_step);
  }
};

/// The crossings on one line of one column, from pillar p to pillar q.
struct LineCut {
  std::int64_t p;  ///< node of the line on pillar p
  std::int64_t q;
  std::size_t begin;  ///< in StripFaces::cut_vertices
  std::size_t end;
};

/// What a row of strips gives. A crossing is named first_crossing plus its place in `crossings`.
struct StripFaces {
  HostFaces faces;
  std::vector<Vec3> crossings;
  std::vector<LineCut> cuts;  ///< lines with crossings; downwards within a side of a strip
  std::vector<VertexId> cut_vertices;
  std::vector<std::size_t> cut_start{0};  ///< offsets into cuts: both sides of each strip in turn

  /// Crossings on the line between nodes p and q of side 0 or 1 of a strip of the row.
  [[nodiscard]] std::span<const VertexId> cuts_of(std::int64_t strip, int side, std::int64_t p, std::int64_t q) const;
  [[nodiscard]] bool has_cuts(std::int64_t strip, int side) const {
    const auto at = static_cast<std::size_t>(2 * strip + side);
    return cut_start[at] != cut_start[at + 1];
  }
};

/// One strip: its axis, the two columns, and where the pillars' nodes are. p to q and then down turns right-handed
/// about the axis, from side 0 to side 1, in a grid whose i, j, depth are right-handed.
struct Strip {
  Axis axis = Axis::i;
  std::array<std::int64_t, 2> pillar_p{};
  std::array<std::int64_t, 2> pillar_q{};
  std::array<StripSide, 2> sides;
};

/// Writes the strip's faces, its crossings and its cuts (also when there are none) to `out`.
class StripCutter {
 public:
  StripCutter(const CornerPointGrid& grid, const IdVector<VertexId, Vec3>& nodes,
              const std::vector<HostCellState>& states, bool mirrored, StripFaces& out);
  void cut(const Strip& strip);

 private:
  /// The different lines of one side, between a line above and one below everything.
  struct Lines {
    std::vector<std::int64_t> p;  ///< node on pillar p
    std::vector<std::int64_t> q;
    std::vector<std::int64_t> place;  ///< of the cell between lines l and l + 1; -1 where there is none
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
    std::int64_t low = 0;   ///< its uppermost node, or the crossing
    std::int64_t high = 0;  ///< its deepest node
    int upper_line = 0;     ///< whose line bounds it above: -1 side 0, 1 side 1, 0 both
    int lower_line = 0;
  };

  void matched(const Strip& strip);
  void overlaid(const Strip& strip);
  void find_crossings(const Strip& strip);
  static Crossed crossed_by(std::int64_t p, std::int64_t q, const Lines& others);
  [[nodiscard]] Vec3 crossing_point(const Strip& strip, std::size_t line0, std::size_t line1) const;
  [[nodiscard]] std::int64_t crossing(std::size_t line0, std::size_t line1) const;
  void write_cuts();
  [[nodiscard]] End end_of(bool at_p, std::size_t region0, std::size_t region1) const;
  void polygon(const Strip& strip, std::size_t region0, std::size_t region1);
  [[nodiscard]] bool covers(int side, std::size_t region0, std::size_t region1) const;

  const CornerPointGrid& grid_;
  const IdVector<VertexId, Vec3>& nodes_;
  StripFaces& out_;
  HostFaceWriter writer_;
  std::array<Lines, 2> lines_;
  std::vector<Crossed> crossed_;              ///< of side 0's lines
  std::vector<std::int64_t> first_crossing_;  ///< id of each line's first one
};

}  // namespace wellknit
