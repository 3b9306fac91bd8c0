// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The reverse Cuthill-McKee order is that of E. Cuthill and J. McKee, Reducing the bandwidth of sparse symmetric
/// matrices (1969), turned round as A. George, Computer implementation of the finite element method (1971), found
/// better.

#include "writers/cell_order.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace wellknit {

namespace {

/// Neighbours of every cell, from the connections.
struct Neighbours {
  std::vector<std::size_t> start;
  std::vector<CellId> cells;

  explicit Neighbours(const Mesh& mesh) : start(mesh.cells.size() + 1, 0) {
    for (const auto& [a, b] : mesh.connections.cells) {
      ++start[a.index() + 1];
      ++start[b.index() + 1];
    }
    std::partial_sum(start.begin(), start.end(), start.begin());
    cells.resize(start.back());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for (const auto& [a, b] : mesh.connections.cells) {
      cells[next[a.index()]++] = b;
      cells[next[b.index()]++] = a;
    }
  }
  [[nodiscard]] std::span<const CellId> of(CellId cell) const {
    return std::span(cells).subspan(start[cell.index()], degree(cell));
  }
  [[nodiscard]] std::size_t degree(CellId cell) const { return start[cell.index() + 1] - start[cell.index()]; }
};

/// Breadth first from `root` through cells that are not `seen`; neighbours with fewer neighbours first.
void append_component(const Neighbours& neighbours, CellId root, std::vector<bool>& seen, std::vector<CellId>& out) {
  std::size_t at = out.size();
  out.push_back(root);
  seen[root.index()] = true;
  for (; at < out.size(); ++at) {
    const std::size_t first = out.size();
    for (const CellId next : neighbours.of(out[at]))
      if (!seen[next.index()]) {
        seen[next.index()] = true;
        out.push_back(next);
      }
    std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(), [&](CellId a, CellId b) {
      return std::pair(neighbours.degree(a), a.value()) < std::pair(neighbours.degree(b), b.value());
    });
  }
}

std::vector<CellId> reverse_cuthill_mckee(const Mesh& mesh) {
  const Neighbours neighbours(mesh);
  std::vector<CellId> roots(mesh.cells.size());
  for (std::size_t c = 0; c < roots.size(); ++c) roots[c] = CellId(c);
  std::stable_sort(roots.begin(), roots.end(),
                   [&](CellId a, CellId b) { return neighbours.degree(a) < neighbours.degree(b); });
  std::vector<bool> seen(roots.size(), false);
  std::vector<CellId> out;
  out.reserve(roots.size());
  for (const CellId root : roots) {
    if (seen[root.index()]) continue;
    // The last cell of a first walk lies at an end of its part of the mesh: a better place to start from.
    const std::size_t first = out.size();
    append_component(neighbours, root, seen, out);
    const CellId end = out.back();
    for (std::size_t i = first; i < out.size(); ++i) seen[out[i].index()] = false;
    out.resize(first);
    append_component(neighbours, end, seen, out);
  }
  std::reverse(out.begin(), out.end());
  return out;
}

std::vector<CellId> by_layer(const Mesh& mesh) {
  const IdVector<CellId, HostCellId> source = main_source_cells(mesh);
  std::vector<CellId> out(mesh.cells.size());
  for (std::size_t c = 0; c < out.size(); ++c) out[c] = CellId(c);
  // Numbers of source cells run by layer, row, column. Cells without one come last, by depth.
  const auto key = [&](CellId cell) {
    const HostCellId parent = source[cell];
    return std::tuple(!parent.is_valid(), parent.is_valid() ? parent.value() : 0,
                      parent.is_valid() ? 0.0 : mesh.cells.depth[cell]);
  };
  std::stable_sort(out.begin(), out.end(), [&](CellId a, CellId b) { return key(a) < key(b); });
  return out;
}

}  // namespace

IdVector<CellId, HostCellId> main_source_cells(const Mesh& mesh) {
  IdVector<CellId, HostCellId> out = mesh.cells.source_cell;
  IdVector<CellId, double> most(mesh.cells.size(), 0.0);
  const Transfer& transfer = mesh.transfer;
  for (std::size_t source = 0; source + 1 < transfer.start.size(); ++source) {
    const double bulk = mesh.source_volumes.bulk.empty() ? 1.0 : mesh.source_volumes.bulk[source];
    for (auto at = static_cast<std::size_t>(transfer.start[source]);
         at < static_cast<std::size_t>(transfer.start[source + 1]); ++at) {
      const CellId cell = transfer.cell[at];
      if (mesh.cells.source_cell[cell].is_valid() || transfer.fraction[at] * bulk <= most[cell]) continue;
      most[cell] = transfer.fraction[at] * bulk;
      out[cell] = HostCellId(source);
    }
  }
  return out;
}

std::vector<CellId> ordered_cells(const Mesh& mesh, CellOrder order) {
  if (order == CellOrder::rcm) return reverse_cuthill_mckee(mesh);
  if (order == CellOrder::layer) return by_layer(mesh);
  std::vector<CellId> out(mesh.cells.size());
  for (std::size_t c = 0; c < out.size(); ++c) out[c] = CellId(c);
  return out;
}

}  // namespace wellknit
