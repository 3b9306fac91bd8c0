// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/edit_connections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "algorithm/array_edits.h"
#include "algorithm/pinch_connections.h"

namespace wellknit {

namespace {

using SourcePair = std::pair<HostCellId, HostCellId>;  ///< the smaller first

SourcePair ordered(HostCellId a, HostCellId b) { return a < b ? SourcePair{a, b} : SourcePair{b, a}; }

class ConnectionEditor {
 public:
  ConnectionEditor(const CornerPointGrid& grid, const HostMesh& host, const HostMultipliers& multipliers,
                   Assembly& assembly)
      : grid_(grid), host_(host), multipliers_(multipliers), assembly_(assembly), mesh_(assembly.mesh) {}

  std::vector<std::string> edit() {
    edit_arrays();
    add_pinches();
    find_pairs();
    multiply_pairs();
    add_non_neighbours();
    replace_pairs();
    return std::move(notes_);
  }

 private:
  /// TRANX, TRANY, TRANZ of the EDIT section: connections between neighbours along i, j, k, by the lower cell.
  void edit_arrays() {
    static constexpr std::array arrays{ComputedArray::transmissibility_x, ComputedArray::transmissibility_y,
                                       ComputedArray::transmissibility_z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const ArrayEdits steps(grid_, arrays[axis]);
      if (!steps.exist()) continue;
      std::int64_t kept = 0;
      Connections& c = mesh_.connections;
      for (std::size_t n = 0; n < c.size(); ++n) {
        const ConnectionId connection(n);
        if (!c.face[connection].is_valid()) continue;
        const FaceInfo& info = assembly_.face_info[c.face[connection]];
        if (info.role != FaceRole::host || static_cast<std::size_t>(info.axis) != axis) continue;
        const auto [low, high] = ordered(info.host[0], info.host[1]);
        if (!are_neighbours(low, high, axis)) continue;
        double& t = c.transmissibility[connection];
        if (is_kept(low) && is_kept(high))
          t = std::max(0.0, steps.applied(low, t));
        else if (const auto factor = steps.factor(low))
          t *= *factor;
        else
          ++kept;
      }
      if (kept > 0)
        notes_.push_back(
            fmt::format("{} connections of refined cells or at the edge of the wells' meshes keep their computed "
                        "transmissibility: {} of EDIT belongs to cells that were replaced",
                        kept, keyword_of(arrays[axis])));
      note_inside(steps, arrays[axis]);
    }
  }

  [[nodiscard]] bool are_neighbours(HostCellId low, HostCellId high, std::size_t axis) const {
    const auto a = grid_.ijk(low);
    const auto b = grid_.ijk(high);
    for (std::size_t n = 0; n < 3; ++n)
      if (b[n] - a[n] != (n == axis ? 1 : 0)) return false;
    return true;
  }

  [[nodiscard]] bool is_kept(HostCellId cell) const { return assembly_.cell_of[cell].is_valid(); }
  /// Made cells took some of its volume.
  [[nodiscard]] bool is_replaced(HostCellId cell) const {
    if (host_.exists[cell] == 0 || is_kept(cell)) return false;
    const auto begin = static_cast<std::size_t>(mesh_.transfer.start[cell.index()]);
    const auto end = static_cast<std::size_t>(mesh_.transfer.start[cell.index() + 1]);
    for (std::size_t n = begin; n < end; ++n)
      if (mesh_.cells.kind[mesh_.transfer.cell[n]] >= CellKind::transition) return true;
    return false;
  }

  void note_inside(const ArrayEdits& steps, ComputedArray array) {
    std::int64_t count = 0;
    for (std::int64_t c = 0; c < grid_.cell_count(); ++c)
      if (is_replaced(HostCellId(c)) && steps.factor(HostCellId(c)) != 1.0) ++count;
    if (count > 0)
      notes_.push_back(fmt::format("{} of EDIT is not applied inside the wells' meshes: {} replaced cells have it",
                                   keyword_of(array), count));
  }

  /// The connections, by source cells, of the pairs that some keyword names.
  void find_pairs() {
    const ConnectionEdits& edits = grid_.edits;
    for (const auto* list :
         {&edits.non_neighbours, &edits.non_neighbour_multipliers, &edits.non_neighbour_transmissibilities})
      for (const CellPairValue& entry : *list) connection_of_[ordered(entry.first, entry.second)];
    if (connection_of_.empty()) return;
    const Connections& c = mesh_.connections;
    for (std::size_t n = 0; n < c.size(); ++n) {
      const auto [a, b] = c.cells[ConnectionId(n)];
      const HostCellId one = mesh_.cells.source_cell[a];
      const HostCellId other = mesh_.cells.source_cell[b];
      if (!one.is_valid() || !other.is_valid()) continue;
      if (const auto found = connection_of_.find(ordered(one, other)); found != connection_of_.end())
        found->second.emplace_back(n);
    }
  }

  /// Gives the connections between the parts of two source cells a total, in their present proportions.
  void set_total(const std::vector<ConnectionId>& connections, double total) {
    auto& t = mesh_.connections.transmissibility;
    double sum = 0.0;
    for (const ConnectionId c : connections) sum += t[c];
    for (const ConnectionId c : connections)
      t[c] = connections.size() == 1 ? total
             : sum > 0.0             ? total * (t[c] / sum)
                                     : total / static_cast<double>(connections.size());
  }
  [[nodiscard]] double total_of(const std::vector<ConnectionId>& connections) const {
    double sum = 0.0;
    for (const ConnectionId c : connections) sum += mesh_.connections.transmissibility[c];
    return sum;
  }

  void multiply_pairs() {
    std::int64_t missing = 0;
    for (const CellPairValue& entry : grid_.edits.non_neighbour_multipliers) {
      const auto& found = connection_of_[ordered(entry.first, entry.second)];
      for (const ConnectionId c : found) mesh_.connections.transmissibility[c] *= entry.value;
      missing += found.empty() ? 1 : 0;
    }
    if (missing > 0)
      notes_.push_back(fmt::format("{} records of EDITNNC name cells that the grid does not connect", missing));
  }

  void replace_pairs() {
    std::map<SourcePair, double> last;
    for (const CellPairValue& entry : grid_.edits.non_neighbour_transmissibilities)
      last[ordered(entry.first, entry.second)] = entry.value;
    std::int64_t missing = 0;
    for (const auto& [pair, value] : last) {
      const auto& found = connection_of_[pair];
      set_total(found, value);
      missing += found.empty() ? 1 : 0;
    }
    if (missing > 0)
      notes_.push_back(fmt::format("{} records of EDITNNCR name cells that the grid does not connect", missing));
  }

  void add_pinches() {
    const ArrayEdits steps(grid_, ComputedArray::transmissibility_z);
    std::int64_t beside_wells = 0;
    for (const PinchConnection& pinch : pinch_connections(grid_, host_, multipliers_)) {
      double t = pinch.transmissibility;
      if (steps.exist() && are_neighbours(pinch.upper, pinch.lower, 2))
        t = std::max(0.0, steps.applied(pinch.upper, t));
      if (is_kept(pinch.upper) && is_kept(pinch.lower))
        add(assembly_.cell_of[pinch.upper], assembly_.cell_of[pinch.lower], t, pinch.multiplier,
            ConnectionKind::pinch_out);
      else if (!host_.is_refined(pinch.upper) || !add_between_parts(pinch, t))
        ++beside_wells;
    }
    if (beside_wells > 0)
      notes_.push_back(
          fmt::format("{} connections across gaps and pinch-outs lead to cells that the wells' meshes replace; they "
                      "are left out",
                      beside_wells));
  }

  /// Shares a connection of refined cells between those of the same column, by their sizes in plan. False: none is
  /// left.
  bool add_between_parts(const PinchConnection& pinch, double transmissibility) {
    if (parts_of_.empty()) collect_parts();
    bool found = false;
    for (const Part& upper : parts_of_[pinch.upper])
      for (const Part& lower : parts_of_[pinch.lower]) {
        if (upper.cell == lower.cell || !meets(upper.box, lower.box)) continue;
        const double share = (upper.box.high[0] - upper.box.low[0]) * (upper.box.high[1] - upper.box.low[1]);
        add(assembly_.cell_of[upper.cell], assembly_.cell_of[lower.cell], share * transmissibility, pinch.multiplier,
            ConnectionKind::pinch_out);
        found = true;
      }
    return found;
  }

  /// The upper part is at the high side of its cell, the lower one at the low side of its own, in the same column.
  static bool meets(const PieceBox& upper, const PieceBox& lower) {
    return upper.low[0] == lower.low[0] && upper.low[1] == lower.low[1] && upper.high[0] == lower.high[0] &&
           upper.high[1] == lower.high[1] && upper.high[2] == 1.0 && lower.low[2] == 0.0;
  }

  void collect_parts() {
    const RefinedCells& refined = host_.refined;
    for (std::size_t c = 0; c < refined.size(); ++c) {
      const HostCellId cell(c + host_.source_count());
      if (!is_kept(cell)) continue;
      for (auto p = static_cast<std::size_t>(refined.piece_start[c]);
           p < static_cast<std::size_t>(refined.piece_start[c + 1]); ++p)
        parts_of_[refined.piece_source[p]].push_back({cell, refined.piece_box[p]});
    }
  }

  void add_non_neighbours() {
    std::map<SourcePair, double> sums;
    std::int64_t inactive = 0;
    for (const CellPairValue& entry : grid_.edits.non_neighbours) {
      if (host_.exists[entry.first] == 0 || host_.exists[entry.second] == 0)
        ++inactive;
      else
        sums[ordered(entry.first, entry.second)] += entry.value;
    }
    std::map<std::pair<CellId, CellId>, double> fresh;
    for (const auto& [pair, value] : sums) {
      if (const auto& found = connection_of_[pair]; !found.empty())
        set_total(found, total_of(found) + value);
      else
        share(pair, value, fresh);
    }
    add_to_present(fresh);
    for (const auto& [cells, value] : fresh) {
      const ConnectionId added = add(cells.first, cells.second, value, 1.0, ConnectionKind::deck_nnc);
      const HostCellId one = mesh_.cells.source_cell[cells.first];
      const HostCellId other = mesh_.cells.source_cell[cells.second];
      if (one.is_valid() && other.is_valid()) connection_of_[ordered(one, other)].push_back(added);
    }
    if (inactive > 0)
      notes_.push_back(fmt::format("{} records of NNC name an inactive cell and are left out", inactive));
  }

  /// Both cells give the connection to the cells of the mesh that hold their volume, by their shares.
  void share(const SourcePair& pair, double value, std::map<std::pair<CellId, CellId>, double>& fresh) const {
    const Transfer& transfer = mesh_.transfer;
    const auto range = [&](HostCellId cell) {
      return std::pair{static_cast<std::size_t>(transfer.start[cell.index()]),
                       static_cast<std::size_t>(transfer.start[cell.index() + 1])};
    };
    const auto [a0, a1] = range(pair.first);
    const auto [b0, b1] = range(pair.second);
    for (std::size_t a = a0; a < a1; ++a)
      for (std::size_t b = b0; b < b1; ++b) {
        const CellId one = std::min(transfer.cell[a], transfer.cell[b]);
        const CellId other = std::max(transfer.cell[a], transfer.cell[b]);
        if (one != other) fresh[{one, other}] += value * transfer.fraction[a] * transfer.fraction[b];
      }
  }

  /// Made cells that a face connects already take the value there.
  void add_to_present(std::map<std::pair<CellId, CellId>, double>& fresh) {
    Connections& c = mesh_.connections;
    for (std::size_t n = 0; n < c.size() && !fresh.empty(); ++n) {
      const auto [a, b] = c.cells[ConnectionId(n)];
      const auto found = fresh.find({a, b});
      if (found == fresh.end()) continue;
      c.transmissibility[ConnectionId(n)] += found->second;
      fresh.erase(found);
    }
  }

  /// A connection without a face, from centre to centre.
  ConnectionId add(CellId a, CellId b, double transmissibility, double multiplier, ConnectionKind kind) {
    Connections& c = mesh_.connections;
    if (b < a) std::swap(a, b);
    const Vec3 between = mesh_.cells.center[b] - mesh_.cells.center[a];
    const double length = between.norm();
    c.face.push_back(FaceId{});
    c.transmissibility.push_back(transmissibility);
    c.area.push_back(0.0);
    c.normal.push_back(length > 0.0 ? Vec3(between / length) : Vec3::Zero());
    c.half_distance.push_back({0.5 * length, 0.5 * length});
    c.non_orthogonality.push_back(0.0);
    c.k_non_orthogonality.push_back(0.0);
    c.planarity.push_back(0.0);
    c.kind.push_back(kind);
    c.multiplier.push_back(multiplier);
    c.linear_flux_error.push_back(Vec3::Zero());
    return c.cells.push_back({a, b});
  }

  const CornerPointGrid& grid_;
  const HostMesh& host_;
  const HostMultipliers& multipliers_;
  Assembly& assembly_;
  Mesh& mesh_;
  std::map<SourcePair, std::vector<ConnectionId>> connection_of_;  ///< of the pairs that the deck names
  struct Part {
    HostCellId cell;
    PieceBox box;
  };
  std::map<HostCellId, std::vector<Part>> parts_of_;  ///< kept refined cells in each source cell
  std::vector<std::string> notes_;
};

}  // namespace

std::vector<std::string> edit_connections(const CornerPointGrid& grid, const HostMesh& host,
                                          const HostMultipliers& multipliers, Assembly& assembly) {
  return ConnectionEditor(grid, host, multipliers, assembly).edit();
}

}  // namespace wellknit
