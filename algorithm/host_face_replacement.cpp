// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/host_face_replacement.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "algorithm/host_face_writer.h"

namespace wellknit {

namespace {

/// What a source column is to the replacement; flags.
enum ColumnRole : std::uint8_t { refined = 1, beside_refined = 2, touches_new_nodes = 4 };

using CellPair = std::pair<HostCellId, HostCellId>;

class FaceReplacer {
 public:
  FaceReplacer(const RefinementLattice& lattice, FaceReplacement& replacement, HostMesh& host)
      : lattice_(lattice), new_(replacement), host_(host), corners_(host.corners), role_(replacement.is_refined) {}

  void replace() {
    name_roles();
    find_old_cuts();
    take_out();
    set_fault_flags();
    append_faces(host_.faces, changed_);
    append_faces(host_.faces, new_.faces);
  }

 private:
  /// A corner of a column, as a place in a loop.
  struct LoopCorner {
    std::size_t at;
    int corner;
  };

  [[nodiscard]] std::int64_t column_of(HostCellId cell) const {
    return cell.value() % (corners_.dimensions[0] * corners_.dimensions[1]);
  }
  [[nodiscard]] std::uint8_t role(HostCellId cell) const { return role_[static_cast<std::size_t>(column_of(cell))]; }

  void name_roles() {
    const std::int64_t nx = corners_.dimensions[0];
    const std::int64_t ny = corners_.dimensions[1];
    for (std::size_t c = 0; c < lattice_.columns.size(); ++c) {
      const auto& column = lattice_.columns[c];
      if (column.is_refined) continue;
      const std::int64_t number = column.source[0] + nx * column.source[1];
      role_[static_cast<std::size_t>(number)] |= beside_refined;
      beside_[number] = static_cast<std::int32_t>(c);
    }
    for (std::size_t p = 0; p < lattice_.pillars.size(); ++p) {
      if (lattice_.host_pillar[p] < 0 || !read_new_nodes(p)) continue;
      const std::int64_t i = lattice_.host_pillar[p] % (nx + 1);
      const std::int64_t j = lattice_.host_pillar[p] / (nx + 1);
      for (std::int64_t cj = std::max<std::int64_t>(j - 1, 0); cj <= std::min(j, ny - 1); ++cj)
        for (std::int64_t ci = std::max<std::int64_t>(i - 1, 0); ci <= std::min(i, nx - 1); ++ci)
          role_[static_cast<std::size_t>(ci + nx * cj)] |= touches_new_nodes;
    }
  }

  /// Nodes that a pillar of the host got between its own; false: none.
  bool read_new_nodes(std::size_t pillar) {
    bool found = false;
    VertexId above;
    for (VertexId n = lattice_.first_node[pillar]; n < lattice_.first_node[pillar + 1]; n = VertexId(n.value() + 1)) {
      const VertexId known = lattice_.host_vertex[n];
      if (known.is_valid()) {
        above = known;
      } else if (above.is_valid()) {
        new_below_[above.value()].push_back(new_.in_host[n]);
        found = true;
      }
    }
    return found;
  }

  /// Which corner of a column a vertex lies on the pillar of; nothing for crossings.
  [[nodiscard]] std::optional<int> corner_of(std::int64_t column, VertexId vertex) const {
    for (int c = 0; c < 4; ++c) {
      const auto [first, end] =
          corners_.nodes_on(corners_.pillar(column % corners_.dimensions[0], column / corners_.dimensions[0], c));
      if (vertex >= first && vertex < end) return c;
    }
    return std::nullopt;
  }

  [[nodiscard]] std::vector<LoopCorner> corners_in(std::int64_t column, std::span<const VertexId> loop) const {
    std::vector<LoopCorner> out;
    for (std::size_t n = 0; n < loop.size(); ++n)
      if (const auto corner = corner_of(column, loop[n])) out.push_back({n, *corner});
    return out;
  }

  /// The side from a corner to the next one round a column, south-west first, and whether it goes that way round.
  static std::pair<ColumnSide, bool> side_between(int from, int to) {
    constexpr std::array<int, 4> place{0, 1, 3, 2};  // round the column, of corner di + 2 dj
    const int a = place[static_cast<std::size_t>(from)];
    const int b = place[static_cast<std::size_t>(to)];
    const bool forward = (a + 1) % 4 == b;
    return {column_sides[static_cast<std::size_t>(forward ? a : b)], forward};
  }

  /// The crossings with refined columns that tops and bases of the columns beside them had.
  void find_old_cuts() {
    for (std::size_t f = 0; f < host_.faces.size(); ++f) {
      const FaceId face(f);
      const HostCellId cell = host_.faces.cells[face][0];
      if (host_.faces.axis[face] != Axis::k || (role(cell) & beside_refined) == 0) continue;
      const auto loop = host_.faces.loop(face);
      if (loop.size() == 4) continue;
      const std::int64_t column = column_of(cell);
      const auto at = corners_in(column, loop);
      for (std::size_t e = 0; e < at.size(); ++e) {
        const LoopCorner& next = at[(e + 1) % at.size()];
        if (lattice_.side(beside_.at(column), side_between(at[e].corner, next.corner).first).empty()) continue;
        for (std::size_t n = (at[e].at + 1) % loop.size(); n != next.at; n = (n + 1) % loop.size())
          old_cuts_.insert(loop[n].value());
      }
    }
  }

  /// Whether a lateral face of a column beside refined ones, with nothing on its other side, is on a side towards them.
  [[nodiscard]] bool faces_refined(FaceId face) const {
    const std::int64_t column = column_of(host_.faces.cells[face][0]);
    const bool along_i = host_.faces.axis[face] == Axis::i;
    for (const VertexId v : host_.faces.loop(face)) {
      if (old_cuts_.contains(v.value())) return true;
      const auto corner = corner_of(column, v);
      if (!corner) continue;
      const ColumnSide side = along_i ? ((*corner & 1) != 0 ? ColumnSide::east : ColumnSide::west)
                                      : (*corner >= 2 ? ColumnSide::north : ColumnSide::south);
      return !lattice_.side(beside_.at(column), side).empty();
    }
    return false;
  }

  [[nodiscard]] bool goes(FaceId face) const {
    const auto [first, second] = host_.faces.cells[face];
    if ((role(first) & refined) != 0 || (second.is_valid() && (role(second) & refined) != 0)) return true;
    return host_.faces.axis[face] != Axis::k && !second.is_valid() && (role(first) & beside_refined) != 0 &&
           faces_refined(face);
  }

  /// Vertices on a side at a level, without the corners, going round the column.
  void push_along(std::int32_t column, ColumnSide side, std::size_t level, std::vector<VertexId>& out) const {
    const auto along = lattice_.side(column, side);
    const bool is_low = side == ColumnSide::east || side == ColumnSide::north;
    for (std::size_t n = 0; n + 1 < along.size(); ++n) {
      if (n > 0) out.push_back(new_.in_host[lattice_.node(along[n], level)]);
      const auto strip = static_cast<std::int64_t>(lattice_.strip_between(along[n], along[n + 1], side));
      const std::int32_t p = lattice_.ranks(along[is_low ? n : n + 1])[level];
      const std::int32_t q = lattice_.ranks(along[is_low ? n + 1 : n])[level];
      const auto cuts = new_.cuts.cuts_of(strip, is_low ? 0 : 1, p, q);
      for (std::size_t c = 0; c < cuts.size(); ++c) out.push_back(new_.in_host[cuts[is_low ? c : cuts.size() - 1 - c]]);
    }
  }

  /// The level of a column that joins two vertices of the host at the ends of a side.
  [[nodiscard]] std::size_t level_between(std::span<const std::int32_t> along, VertexId first, VertexId last) const {
    const auto key = [&](std::size_t level) {
      return std::pair(lattice_.host_vertex[lattice_.node(along.front(), level)],
                       lattice_.host_vertex[lattice_.node(along.back(), level)]);
    };
    std::size_t low = 0;
    std::size_t high = lattice_.ranks(along.front()).size();
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      if (key(middle) < std::pair(first, last))
        low = middle + 1;
      else
        high = middle;
    }
    return low;
  }

  /// The loop of a top or base of a column beside refined ones, with the new vertices on the sides towards them.
  [[nodiscard]] std::vector<VertexId> with_new_sides(std::int64_t column, std::span<const VertexId> loop) const {
    const std::int32_t number = beside_.at(column);
    const auto at = corners_in(column, loop);
    std::vector<VertexId> out;
    for (std::size_t e = 0; e < at.size(); ++e) {
      const LoopCorner& next = at[(e + 1) % at.size()];
      const auto [side, forward] = side_between(at[e].corner, next.corner);
      const auto along = lattice_.side(number, side);
      out.push_back(loop[at[e].at]);
      if (along.empty()) {
        for (std::size_t n = (at[e].at + 1) % loop.size(); n != next.at; n = (n + 1) % loop.size())
          out.push_back(loop[n]);
        continue;
      }
      const VertexId first = loop[forward ? at[e].at : next.at];
      const VertexId last = loop[forward ? next.at : at[e].at];
      const auto begin = static_cast<std::ptrdiff_t>(out.size());
      push_along(number, side, level_between(along, first, last), out);
      if (!forward) std::reverse(out.begin() + begin, out.end());
    }
    return out;
  }

  /// The loop of a lateral face with the new nodes on the pillars.
  [[nodiscard]] std::vector<VertexId> with_new_nodes(std::span<const VertexId> loop) const {
    std::vector<VertexId> out;
    for (std::size_t n = 0; n < loop.size(); ++n) {
      const std::int64_t a = loop[n].value();
      const std::int64_t b = loop[n + 1 == loop.size() ? 0 : n + 1].value();
      out.push_back(loop[n]);
      if (a - b != 1 && b - a != 1) continue;
      const auto found = new_below_.find(std::min(a, b));
      if (found == new_below_.end()) continue;
      const auto& nodes = found->second;
      if (a < b)
        out.insert(out.end(), nodes.begin(), nodes.end());
      else
        out.insert(out.end(), nodes.rbegin(), nodes.rend());
    }
    return out;
  }

  /// A new loop for a face that stays; empty: it keeps its own.
  [[nodiscard]] std::vector<VertexId> changed_loop(FaceId face) const {
    const HostCellId cell = host_.faces.cells[face][0];
    const auto loop = host_.faces.loop(face);
    std::vector<VertexId> out;
    if (host_.faces.axis[face] == Axis::k) {
      if ((role(cell) & beside_refined) != 0) out = with_new_sides(column_of(cell), loop);
    } else if ((role(cell) & touches_new_nodes) != 0) {
      out = with_new_nodes(loop);
    }
    if (std::equal(out.begin(), out.end(), loop.begin(), loop.end())) out.clear();
    return out;
  }

  /// Remembers which parts of the refined cells' faces along faults are whole.
  void note_whole(FaceId face) {
    const auto [first, second] = host_.faces.cells[face];
    if (host_.faces.axis[face] != Axis::k && second.is_valid() && host_.faces.is_fault[face] == 0)
      whole_.insert(std::minmax(first, second));
  }

  void take_out() {
    HostFaces& faces = host_.faces;
    const bool conducts = !faces.transmissibility.empty();
    std::size_t kept = 0;
    std::size_t end = 0;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const FaceId face(f);
      if (goes(face)) {
        note_whole(face);
        continue;
      }
      if (const auto loop = changed_loop(face); !loop.empty()) {
        changed_.vertices.insert(changed_.vertices.end(), loop.begin(), loop.end());
        changed_.vertex_start.push_back(static_cast<std::int64_t>(changed_.vertices.size()));
        copy_to(changed_, face, conducts);
        continue;
      }
      const auto loop = faces.loop(face);
      std::copy(loop.begin(), loop.end(), faces.vertices.begin() + static_cast<std::ptrdiff_t>(end));
      end += loop.size();
      faces.vertex_start[kept] = static_cast<std::int64_t>(end - loop.size());
      move_down(face, FaceId(kept), conducts);
      ++kept;
    }
    faces.vertices.resize(end);
    faces.vertex_start[kept] = static_cast<std::int64_t>(end);
    faces.vertex_start.resize(kept + 1);
    faces.cells.resize(kept);
    faces.axis.resize(kept);
    faces.is_fault.resize(kept);
    faces.is_pinch.resize(kept);
    if (conducts) faces.transmissibility.resize(kept);
  }

  void copy_to(HostFaces& out, FaceId face, bool conducts) const {
    const HostFaces& faces = host_.faces;
    out.cells.push_back(faces.cells[face]);
    out.axis.push_back(faces.axis[face]);
    out.is_fault.push_back(faces.is_fault[face]);
    out.is_pinch.push_back(faces.is_pinch[face]);
    if (conducts) out.transmissibility.push_back(faces.transmissibility[face]);
  }

  void move_down(FaceId from, FaceId to, bool conducts) {
    HostFaces& faces = host_.faces;
    faces.cells[to] = faces.cells[from];
    faces.axis[to] = faces.axis[from];
    faces.is_fault[to] = faces.is_fault[from];
    faces.is_pinch[to] = faces.is_pinch[from];
    if (conducts) faces.transmissibility[to] = faces.transmissibility[from];
  }

  void set_fault_flags() {
    HostFaces& faces = new_.faces;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const FaceId face(f);
      if (faces.axis[face] == Axis::k) continue;
      const auto [first, second] = faces.cells[face];
      if (new_.is_beside_split[f] == 0) {
        faces.is_fault[face] = 0;
      } else if (second.is_valid()) {
        const CellPair pair = std::minmax(host_.source_of(first), host_.source_of(second));
        faces.is_fault[face] = whole_.contains(pair) ? 0 : 1;
      }
    }
  }

  const RefinementLattice& lattice_;
  FaceReplacement& new_;
  HostMesh& host_;
  const HostCorners& corners_;
  std::vector<std::uint8_t> role_;                                     ///< ColumnRole flags of each source column
  std::unordered_map<std::int64_t, std::int32_t> beside_;              ///< lattice column of an unrefined source column
  std::unordered_map<std::int64_t, std::vector<VertexId>> new_below_;  ///< new nodes below a node of a host's pillar
  std::unordered_set<std::int64_t> old_cuts_;
  std::set<CellPair> whole_;
  HostFaces changed_;
};

}  // namespace

void replace_faces(const RefinementLattice& lattice, FaceReplacement& replacement, HostMesh& host) {
  FaceReplacer(lattice, replacement, host).replace();
}

}  // namespace wellknit
