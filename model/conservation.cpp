// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/conservation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wellknit {

namespace {

double total(const std::array<double, 4>& of_kind) { return std::accumulate(of_kind.begin(), of_kind.end(), 0.0); }

double relative_error(double value, double reference) {
  if (value == reference) return 0.0;
  return std::abs(value - reference) / std::max(std::abs(value), std::abs(reference));
}

}  // namespace

double Conservation::mesh_bulk() const { return total(bulk_of_kind); }
double Conservation::mesh_pores() const { return total(pores_of_kind); }
double Conservation::bulk_error() const { return relative_error(mesh_bulk(), source_bulk); }
double Conservation::pore_error() const { return relative_error(mesh_pores(), source_pores); }

std::optional<Conservation> conservation(const Mesh& mesh) {
  const std::size_t sources = mesh.transfer.start.size() - 1;
  if (mesh.transfer.start.size() < 2 || mesh.source_volumes.bulk.size() != sources ||
      mesh.source_volumes.pores.size() != sources)
    return std::nullopt;
  Conservation out;
  for (std::size_t s = 0; s < sources; ++s) {
    const auto begin = mesh.transfer.fraction.begin() + mesh.transfer.start[s];
    const auto end = mesh.transfer.fraction.begin() + mesh.transfer.start[s + 1];
    if (begin == end) continue;  // not active
    out.source_bulk += mesh.source_volumes.bulk[s];
    out.source_pores += mesh.source_volumes.pores[s];
    out.largest_fraction_error = std::max(out.largest_fraction_error, std::abs(std::accumulate(begin, end, 0.0) - 1.0));
  }
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto kind = static_cast<std::size_t>(mesh.cells.kind[CellId(c)]);
    out.bulk_of_kind[kind] += mesh.cells.volume[CellId(c)];
    out.pores_of_kind[kind] += mesh.cells.pore_volume[CellId(c)];
  }
  return out;
}

}  // namespace wellknit
