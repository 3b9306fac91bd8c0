// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "conversion/schedule_wells.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <unordered_map>

#include "algorithm/cell_locator.h"
#include "algorithm/cell_path.h"
#include "conversion/record_text.h"
#include "readers/text.h"
#include "writers/well_cells.h"

namespace wellknit {

namespace {

/// A well's name without the branch that the reader puts behind it.
const std::string& deck_name(const Well& well) { return well.parent.empty() ? well.name : well.parent; }

bool is_in(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::any_of(names, [&](const std::string& other) { return equal_ignoring_case(other, name); });
}

}  // namespace

ScheduleWells::ScheduleWells(const WholeDeck& deck, const Case& source, const std::vector<Well>& wells,
                             const Mesh& mesh, const std::vector<std::string>& meshed, const DeckGrid& grid,
                             const SourceCells& cells)
    : deck_(deck), grid_(source.grid), cells_(cells) {
  WellLists lists;
  for (const DeckTextKeyword& keyword : deck.keywords) {
    if (keyword.role == DeckRole::well_heads) read_heads(keyword);
    if (keyword.role == DeckRole::well_names) update_lists(deck, keyword, *this, lists);
    if (keyword.role == DeckRole::completions) read_completions(keyword, lists);
    if (keyword.role != DeckRole::perforations) continue;
    for (const DeckTextRecord& record : keyword.records)
      for (ScheduleWell& well : wells_)
        if (matches_pattern(well.name, trimmed(record.text(0)))) well.has_trajectory = true;
  }
  take_mesh(wells, mesh, meshed, grid);
}

const ScheduleWell* ScheduleWells::find(std::string_view name) const {
  const auto found =
      std::ranges::find_if(wells_, [&](const auto& well) { return equal_ignoring_case(well.name, name); });
  return found == wells_.end() ? nullptr : &*found;
}

ScheduleWell* ScheduleWells::find_mutable(std::string_view name) {
  const auto found =
      std::ranges::find_if(wells_, [&](const auto& well) { return equal_ignoring_case(well.name, name); });
  return found == wells_.end() ? nullptr : &*found;
}

std::vector<const ScheduleWell*> ScheduleWells::named(std::string_view pattern, const WellLists& lists) const {
  std::vector<const ScheduleWell*> out;
  pattern = trimmed(pattern);
  const auto list = lists.find(upper_case(pattern));
  for (const ScheduleWell& well : wells_)
    if (list != lists.end() ? is_in(list->second, well.name) : matches_pattern(well.name, pattern))
      out.push_back(&well);
  return out;
}

void ScheduleWells::read_heads(const DeckTextKeyword& keyword) {
  for (const DeckTextRecord& record : keyword.records) {
    const RecordItems items(deck_, keyword, record);
    const std::string name(trimmed(record.text(0)));
    if (name.empty()) items.fail({"the name of a well", "a default", ""});
    ScheduleWell* well = find_mutable(name);
    if (well == nullptr) {
      well = &wells_.emplace_back();
      well->name = name;
    }
    if (const auto i = items.cell_index(2, 0)) well->head_i = i;
    if (const auto j = items.cell_index(3, 1)) well->head_j = j;
  }
}

std::vector<HostCellId> ScheduleWells::cells_of(const DeckTextKeyword& keyword, const DeckTextRecord& record,
                                                const ScheduleWell& well) const {
  const RecordItems items(deck_, keyword, record);
  const auto i = items.cell_index(1, 0);
  const auto j = items.cell_index(2, 1);
  if ((!i && !well.head_i) || (!j && !well.head_j))
    items.fail({fmt::format("I and J of {} here or in WELSPECS", quoted_for_message(well.name)), "neither", ""});
  const std::int64_t first = items.cell_index(3, 2).value_or(0);
  const std::int64_t last = items.cell_index(4, 2).value_or(grid_.dimensions[2] - 1);
  if (last < first)
    items.fail({"a first layer above the last", fmt::format("{} to {}", first + 1, last + 1), "swap items 4 and 5"});
  std::vector<HostCellId> out;
  for (std::int64_t k = first; k <= last; ++k)
    out.push_back(grid_.cell_id(i ? *i : *well.head_i, j ? *j : *well.head_j, k));
  return out;
}

int completion_axis(const WholeDeck& deck, const DeckTextKeyword& keyword, const DeckTextRecord& record) {
  const RecordItems items(deck, keyword, record);
  const std::string direction = items.word(12, "Z");
  if (direction != "X" && direction != "Y" && direction != "Z")
    items.fail({"X, Y or Z as item 13", quoted_for_message(direction), ""});
  return direction.front() - 'X';
}

void ScheduleWells::read_completions(const DeckTextKeyword& keyword, const WellLists& lists) {
  std::set<std::string> begun;
  std::map<std::string, bool> was_empty;
  for (const DeckTextRecord& record : keyword.records) {
    const auto wells = named(record.text(0), lists);
    if (wells.empty())
      RecordItems(deck_, keyword, record)
          .fail({"a well that WELSPECS has named", quoted_for_message(record.text(0)), "check the name"});
    for (const ScheduleWell* one : wells) {
      ScheduleWell& well = *find_mutable(one->name);
      was_empty.try_emplace(well.name, well.completed.empty());
      for (const HostCellId cell : cells_of(keyword, record, well)) {
        if (grid_.active[cell.index()] == 0 || cells_.parts(cell).empty()) continue;
        if (!well.known.insert(cell.value()).second) continue;
        well.completed.push_back(cell);
        if (was_empty[well.name]) well.first.push_back(cell);
        if (begun.insert(well.name).second) ++well.compdat_keywords;
      }
    }
  }
}

/// The steps of OPM's TRACK: from the well's head to the nearest connection, and from each to the nearest of the rest,
/// by i and j first and then by depth.
std::vector<HostCellId> ScheduleWells::in_track_order(const ScheduleWell& well, std::vector<HostCellId> cells) const {
  std::int64_t i = well.head_i.value_or(0);
  std::int64_t j = well.head_j.value_or(0);
  double depth = 0.0;
  for (std::size_t at = 0; at + 1 < cells.size(); ++at) {
    std::size_t best = at;
    std::int64_t nearest = std::numeric_limits<std::int64_t>::max();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t n = at; n < cells.size(); ++n) {
      const auto ijk = grid_.ijk(cells[n]);
      const std::int64_t distance = (ijk[0] - i) * (ijk[0] - i) + (ijk[1] - j) * (ijk[1] - j);
      const double step = std::abs(cells_.depth(cells[n]) - depth);
      if (distance > nearest || (distance == nearest && step >= least)) continue;
      nearest = distance;
      least = step;
      best = n;
    }
    std::swap(cells[at], cells[best]);
    const auto ijk = grid_.ijk(cells[at]);
    i = ijk[0];
    j = ijk[1];
    depth = cells_.depth(cells[at]);
  }
  return cells;
}

std::optional<double> ScheduleWells::default_reference_depth(const ScheduleWell& well) const {
  if (well.first.empty()) return std::nullopt;
  return cells_.depth(in_track_order(well, well.first).front());
}

CellId ScheduleWells::head_cell(const ScheduleWell& well) const {
  if (!well.connections.empty()) return well.connections.front().cell;
  if (well.completed.empty()) return CellId(0);
  return cells_.parts(well.completed.front()).front().cell;
}

void ScheduleWells::take_mesh(const std::vector<Well>& wells, const Mesh& mesh, const std::vector<std::string>& meshed,
                              const DeckGrid& grid) {
  for (std::size_t w = 0; w < mesh.wells.size(); ++w) {
    const MeshWell& from = mesh.wells[WellId(w)];
    const auto built = std::ranges::find_if(wells, [&](const Well& well) { return well.name == from.name; });
    if (built == wells.end() || !is_in(meshed, deck_name(*built))) continue;
    ScheduleWell* well = find_mutable(deck_name(*built));
    if (well == nullptr) continue;
    well->is_meshed = true;
    well->bore_radius = from.bore_radius;
    well->skin = built->skin;
    const std::size_t first = well->connections.size();
    const std::vector<double> kh = permeability_thicknesses(mesh, from);
    std::unordered_map<std::int64_t, std::size_t> place;
    for (std::size_t n = 0; n < from.connections.size(); ++n) {
      const WellConnection& c = from.connections[n];
      if (!grid.is_active(c.cell)) continue;
      const auto [at, is_new] = place.try_emplace(c.cell.value(), well->connections.size());
      if (is_new) well->connections.push_back({c.cell, 0.0, 0.0, c.measured_depth, {}});
      MeshedConnection& sum = well->connections[at->second];
      sum.factor += c.well_index;
      sum.permeability_thickness += kh[n];
      sum.measured_depth.from = std::min(sum.measured_depth.from, c.measured_depth.from);
      sum.measured_depth.to = std::max(sum.measured_depth.to, c.measured_depth.to);
    }
    std::stable_sort(well->connections.begin() + static_cast<std::ptrdiff_t>(first), well->connections.end(),
                     [](const auto& a, const auto& b) { return a.measured_depth.from < b.measured_depth.from; });
    set_owners(*well, from.trajectory, first, mesh);
  }
}

/// A connection belongs to the completed cell that most of its stretch of the path lies in; where the path runs through
/// none, to the nearest one.
void ScheduleWells::set_owners(ScheduleWell& well, const Trajectory& path, std::size_t first, const Mesh& mesh) {
  if (well.completed.empty()) return;
  if (!locator_) locator_ = std::make_unique<CellLocator>(grid_);
  const auto parts = cells_along(grid_, *locator_, path);
  const std::set<HostCellId> completed(well.completed.begin(), well.completed.end());
  for (std::size_t n = first; n < well.connections.size(); ++n) {
    MeshedConnection& connection = well.connections[n];
    double most = 0.0;
    for (const CellPart& part : parts) {
      if (!completed.contains(part.cell)) continue;
      const double length = std::min(part.measured_depth.to, connection.measured_depth.to) -
                            std::max(part.measured_depth.from, connection.measured_depth.from);
      if (length <= most) continue;
      most = length;
      connection.owner = part.cell;
    }
    if (connection.owner.is_valid()) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (const HostCellId cell : well.completed) {
      Vec3 centre = Vec3::Zero();
      for (const Vec3& corner : grid_.corners(cell)) centre += 0.125 * corner;
      const double distance = (centre - mesh.cells.center[connection.cell]).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      connection.owner = cell;
    }
  }
}

void update_lists(const WholeDeck& deck, const DeckTextKeyword& keyword, const ScheduleWells& wells, WellLists& lists) {
  for (const DeckTextRecord& record : keyword.records) {
    const RecordItems items(deck, keyword, record);
    const std::string name = items.word(0, "");
    const std::string action = items.word(1, "");
    if (name.size() < 2 || name.front() != '*')
      items.fail({"the name of a list, *NAME, as item 1", quoted_for_message(name), ""});
    std::vector<std::string> given;
    for (std::int64_t item = 2; item < record.size(); ++item)
      for (const ScheduleWell* well : wells.named(record.text(item), lists)) given.push_back(well->name);
    const auto leave = [&](std::vector<std::string>& from) {
      std::erase_if(from, [&](const std::string& well) { return is_in(given, well); });
    };
    if (action == "NEW") lists[name].clear();
    if (action == "MOV")
      for (auto& [other, members] : lists) leave(members);
    leave(lists[name]);
    if (action != "DEL") lists[name].insert(lists[name].end(), given.begin(), given.end());
  }
}

}  // namespace wellknit
