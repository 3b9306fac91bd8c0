// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The rules are those of the ECLIPSE keywords as OPM Flow applies them; where Flow 2022.10 differs from the manual, the
// manual is followed (docs/algorithms/host.md).

#include "algorithm/host_multipliers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "model/errors.h"

namespace wellknit {

namespace {

std::size_t index_of(FaceDirection face) { return static_cast<std::size_t>(face); }

FaceDirection high_face(Axis axis) { return static_cast<FaceDirection>(2 * static_cast<int>(axis) + 1); }
FaceDirection low_face(Axis axis) { return static_cast<FaceDirection>(2 * static_cast<int>(axis)); }

template <class Visit>
void for_each_cell(const CornerPointGrid& grid, const CellBox& box, Visit visit) {
  for (std::int64_t k = box.first[2]; k <= box.last[2]; ++k)
    for (std::int64_t j = box.first[1]; j <= box.last[1]; ++j)
      for (std::int64_t i = box.first[0]; i <= box.last[0]; ++i) visit(grid.cell_id(i, j, k));
}

}  // namespace

HostMultipliers::HostMultipliers(const CornerPointGrid& grid) : grid_(grid) {
  const ConnectionEdits& edits = grid.edits;
  exist_ = std::any_of(edits.face_multiplier.begin(), edits.face_multiplier.end(),
                       [](const auto& array) { return !array.empty(); });
  add_faults();
  add_regions();
}

void HostMultipliers::add_faults() {
  for (const Fault& fault : grid_.edits.faults) {
    if (fault.multiplier == 1.0) continue;
    exist_ = true;
    for (const FaultFaces& faces : fault.faces) {
      auto& array = with_faults_[index_of(faces.face)];
      const auto& given = grid_.edits.face_multiplier[index_of(faces.face)];
      if (array.empty() && given.empty()) array.assign(static_cast<std::size_t>(grid_.cell_count()), 1.0);
      if (array.empty()) array = given;
      for_each_cell(grid_, faces.cells, [&](HostCellId cell) { array[cell.index()] *= fault.multiplier; });
    }
  }
}

const std::vector<std::int32_t>* HostMultipliers::numbers_of(RegionSet set) const {
  const std::string keyword = keyword_of(set);
  const auto found = grid_.properties.find(keyword);
  if (found != grid_.properties.end()) return &std::get<std::vector<std::int32_t>>(found->second);
  if (set == RegionSet::multnum) return nullptr;
  throw InvalidInput(fmt::format("MULTREGT refers to the regions of {}, which the deck does not give", keyword));
}

/// One pair of regions has one record, the last; it stands with the set that this record names.
void HostMultipliers::add_regions() {
  std::map<Regions, const RegionMultiplier*> last;
  std::array<std::set<std::int32_t>, 3> all;
  for (const RegionMultiplier& record : grid_.edits.region_multipliers) {
    exist_ = true;
    const auto set = static_cast<std::size_t>(record.regions);
    regions_[set].numbers = numbers_of(record.regions);
    if (all[set].empty()) {
      if (regions_[set].numbers == nullptr)
        all[set] = {1};
      else
        all[set].insert(regions_[set].numbers->begin(), regions_[set].numbers->end());
    }
    const auto some = [&](const std::optional<std::int32_t>& number) {
      return number ? std::set<std::int32_t>{*number} : all[set];
    };
    const bool within = record.from && record.from == record.to;
    for (const std::int32_t from : some(record.from))
      for (const std::int32_t to : within ? all[set] : some(record.to)) {
        if (from == to && !within) continue;
        last[{from, to}] = last[{to, from}] = &record;
      }
  }
  for (const auto& [pair, record] : last) regions_[static_cast<std::size_t>(record->regions)].of_pair[pair] = record;
}

double HostMultipliers::of_face(HostCellId cell, FaceDirection face) const {
  const auto& array = with_faults_[index_of(face)];
  if (!array.empty()) return array[cell.index()];
  const auto& given = grid_.edits.face_multiplier[index_of(face)];
  return given.empty() ? 1.0 : given[cell.index()];
}

double HostMultipliers::of_regions(HostCellId one, HostCellId other, std::optional<Axis> axis) const {
  double multiplier = 1.0;
  for (const RegionRules& rules : regions_) {
    if (rules.of_pair.empty()) continue;
    const auto found = rules.of_pair.find({region(rules, one), region(rules, other)});
    if (found == rules.of_pair.end()) continue;
    const RegionMultiplier& record = *found->second;
    if (axis && !record.directions[static_cast<std::size_t>(*axis)]) continue;
    const auto a = grid_.ijk(one);
    const auto b = grid_.ijk(other);
    const bool are_neighbours = axis && std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]) == 1;
    if (record.connections == RegionConnections::only_neighbours && !are_neighbours) continue;
    if (record.connections == RegionConnections::only_non_neighbours && are_neighbours) continue;
    multiplier *= record.multiplier;
  }
  return multiplier;
}

double HostMultipliers::across(HostCellId one, HostCellId other, Axis axis) const {
  if (!exist_ || one == other) return 1.0;
  const auto a = static_cast<std::size_t>(axis);
  const bool is_low = grid_.ijk(one)[a] <= grid_.ijk(other)[a];
  const HostCellId low = is_low ? one : other;
  const HostCellId high = is_low ? other : one;
  return of_face(low, high_face(axis)) * of_face(high, low_face(axis)) * of_regions(low, high, axis);
}

}  // namespace wellknit
