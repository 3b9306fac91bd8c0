// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/deck_grid.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/errors.h"
#include "model/mesh_topology.h"
#include "model/units.h"
#include "writers/deck_text.h"

namespace wellknit {

namespace {

constexpr double thinnest_box = 1e-4;  ///< m; Flow drops cells without thickness, and kept 1e-5 m when it was tried
constexpr double flow_smallest_nnc = 1e-6;  ///< in deck units; Flow sets smaller ones to zero

std::string_view transmissibility_unit_name(UnitSystem units) {
  switch (units) {
    case UnitSystem::field: return "cP rb/(day psi)";
    case UnitSystem::lab: return "cP rcc/(hr atm)";
    case UnitSystem::metric: break;
  }
  return "cP rm3/(day bar)";
}

}  // namespace

DeckGrid::DeckGrid(const Mesh& mesh, const DeckGridOptions& options)
    : mesh_(mesh), options_(options), metre_(metre_per_length_unit(options.units)) {
  if (mesh.cells.size() == 0) throw InvalidInput("the mesh has no cells: a deck needs at least one");
  measure_boxes();
  layout_ = make_deck_layout(options.form, {mesh, boxes_, ordered_cells(mesh, options.order), options.source});
  collect_connections();
}

void DeckGrid::measure_boxes() {
  std::vector<double> projected(mesh_.cells.size(), 0.0);
  for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
    const double area = std::abs(face_geometry(mesh_, FaceId(f)).area_vector.z());
    for (const CellId cell : mesh_.faces.cells[FaceId(f)])
      if (cell.is_valid()) projected[cell.index()] += 0.5 * area;  // the top and the base, each once
  }
  boxes_.above_all = std::numeric_limits<double>::infinity();
  boxes_.below_all = -boxes_.above_all;
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
    const double volume = mesh_.cells.volume[CellId(c)];
    const double thickness = projected[c] > 0.0 ? volume / projected[c] : std::cbrt(volume);
    if (thickness < thinnest_box) ++thickened_;
    boxes_.thickness.push_back(std::max(thickness, thinnest_box));
    boxes_.area.push_back(volume / boxes_.thickness.back());
    active_.push_back(mesh_.cells.pore_volume[CellId(c)] > 0.0);
    const double depth = mesh_.cells.depth[CellId(c)];
    boxes_.above_all = std::min(boxes_.above_all, depth - 0.5 * boxes_.thickness.back());
    boxes_.below_all = std::max(boxes_.below_all, depth + 0.5 * boxes_.thickness.back());
  }
  boxes_.above_all -= 100.0;
  boxes_.below_all += 100.0;
}

void DeckGrid::collect_connections() {
  nnc_.reserve(mesh_.connections.size());
  const double unit = m3_per_transmissibility_unit(options_.units);
  for (std::size_t i = 0; i < mesh_.connections.size(); ++i) {
    const auto& [a, b] = mesh_.connections.cells[ConnectionId(i)];
    if (!active_[a.index()] || !active_[b.index()]) {
      ++inactive_connections_;
      continue;
    }
    const auto [first, second] = std::minmax({layout_->place(a), layout_->place(b)});
    nnc_.push_back({first, second, mesh_.connections.transmissibility[ConnectionId(i)] / unit});
  }
  const auto is_before = [](const Nnc& x, const Nnc& y) {
    return std::pair(x.first, x.second) < std::pair(y.first, y.second);
  };
  if (!std::is_sorted(nnc_.begin(), nnc_.end(), is_before)) std::stable_sort(nnc_.begin(), nnc_.end(), is_before);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < nnc_.size(); ++i) {
    if (kept > 0 && nnc_[kept - 1].first == nnc_[i].first && nnc_[kept - 1].second == nnc_[i].second)
      nnc_[kept - 1].transmissibility += nnc_[i].transmissibility;
    else
      nnc_[kept++] = nnc_[i];
  }
  nnc_.resize(kept);
  too_small_ = std::count_if(nnc_.begin(), nnc_.end(), [this](const Nnc& nnc) {
    return !is_exempt(nnc) && nnc.transmissibility < flow_smallest_nnc;
  });
}

/// Neighbours in i, j or k are folded into TRANX, TRANY, TRANZ, where no lower bound applies.
bool DeckGrid::is_exempt(const Nnc& nnc) const {
  const auto [nx, ny, nz] = layout_->dimensions();
  const std::int64_t apart = nnc.second - nnc.first;
  return apart == 1 || apart == nx || apart == nx * ny;
}

std::int64_t DeckGrid::inactive_cells() const { return std::count(active_.begin(), active_.end(), false); }

std::vector<std::string> DeckGrid::notes() const {
  std::vector<std::string> out;
  if (too_small_ > 0)
    out.push_back(fmt::format("{} connections lie below {:g} {}: Flow sets them to zero", too_small_, flow_smallest_nnc,
                              transmissibility_unit_name(options_.units)));
  if (thickened_ > 0)
    out.push_back(fmt::format("{} cells thinner than {:g} m have a box of that thickness", thickened_, thinnest_box));
  return out;
}

template <class Value>
void DeckGrid::write_array(std::ostream& out, const char* keyword, double none, Value value) const {
  DeckArray array(out, keyword);
  for (const CellId cell : layout_->cell_at()) array.add(cell.is_valid() ? value(cell) : none);
  array.end();
}

void DeckGrid::write_grid(std::ostream& out) const {
  out << "INIT\nGRIDFILE\n 0 1 /\n";
  write_coord(out);
  write_zcorn(out);
  if (inactive_cells() > 0 || layout_->cell_at().size() > mesh_.cells.size())
    write_array(out, "ACTNUM", 0.0, [this](CellId cell) { return is_active(cell) ? 1.0 : 0.0; });
  write_array(out, "PORO", 0.0, [this](CellId cell) { return mesh_.cells.porosity[cell]; });
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    write_array(out, std::array{"PERMX", "PERMY", "PERMZ"}[static_cast<std::size_t>(axis)], 0.0,
                [&](CellId cell) { return mesh_.cells.permeability[cell][axis] / m2_per_millidarcy; });
  if (options_.form == DeckLayoutKind::nested) {
    write_deck_comment(out, "nothing connects by its geometry, across faults neither; the NNC list is added to it");
    out << "EQUALS\n MULTX 0 /\n MULTY 0 /\n MULTZ 0 /\n/\n";
  }
  write_nnc(out);
}

void DeckGrid::write_coord(std::ostream& out) const {
  const auto [nx, ny, nz] = layout_->dimensions();
  DeckArray coord(out, "COORD");
  for (std::int64_t j = 0; j <= ny; ++j)
    for (std::int64_t i = 0; i <= nx; ++i)
      for (const double value : layout_->pillar(i, j)) coord.add(value / metre_);
  coord.end();
}

void DeckGrid::write_zcorn(std::ostream& out) const {
  const auto [nx, ny, nz] = layout_->dimensions();
  DeckArray zcorn(out, "ZCORN");
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::size_t side = 0; side < 2; ++side)
      for (std::int64_t j = 0; j < ny; ++j)
        for (std::size_t row = 0; row < 2; ++row)
          for (std::int64_t i = 0; i < nx; ++i) {
            const auto depths = layout_->depths(i + nx * (j + ny * k));
            for (std::size_t end = 0; end < 2; ++end) zcorn.add(depths[end + 2 * row + 4 * side] / metre_);
          }
  zcorn.end();
}

void DeckGrid::write_nnc(std::ostream& out) const {
  if (nnc_.empty()) return;
  out << "NNC\n";
  const auto [nx, ny, nz] = layout_->dimensions();
  fmt::memory_buffer text;
  for (const Nnc& nnc : nnc_) {
    for (const std::int64_t at : {nnc.first, nnc.second})
      fmt::format_to(fmt::appender(text), FMT_COMPILE(" {} {} {}"), at % nx + 1, at / nx % ny + 1, at / (nx * ny) + 1);
    fmt::format_to(fmt::appender(text), FMT_COMPILE(" {} /\n"), nnc.transmissibility);
    if (text.size() < (1U << 20U)) continue;
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    text.clear();
  }
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out << "/\n";
}

void DeckGrid::write_edit(std::ostream& out) const {
  const double unit = m3_per_reservoir_volume_unit(options_.units);
  write_array(out, "PORV", 0.0, [&](CellId cell) { return mesh_.cells.pore_volume[cell] / unit; });
  if (options_.form != DeckLayoutKind::row) return;
  write_deck_comment(out, "what the boxes would connect; the NNC list is added to it");
  out << "EQUALS\n TRANX 0 /\n/\n";
}

}  // namespace wellknit
