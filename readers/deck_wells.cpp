// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/deck_wells.h"

#include <fmt/format.h>

#include <algorithm>

#include "model/units.h"
#include "readers/deck_well_path.h"
#include "readers/text.h"

namespace wellknit {

namespace {

/// Items of COMPDAT, from 0.
namespace compdat {
constexpr std::size_t i = 1, j = 2, k_first = 3, k_last = 4, state = 5, factor = 7, diameter = 8, kh = 9, skin = 10,
                      direction = 12, most_items = 14;
}

bool is_in(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::optional<double> positive(std::optional<double> value) { return value && *value > 0.0 ? value : std::nullopt; }

}  // namespace

/// 0-based; nothing for a default, which 0 is too.
std::optional<std::int64_t> DeckWells::cell_index(const DeckRecord& record, std::size_t item, std::size_t axis) const {
  const auto value = stream_.integer(record, item);
  if (!value || *value == 0) return std::nullopt;
  if (*value < 1 || *value > cells_.dimensions()[axis]) {
    stream_.fail(record.line,
                 {fmt::format("{} between 1 and {} as item {}", "IJK"[axis], cells_.dimensions()[axis], item + 1),
                  fmt::format("{}", *value), "the well is outside the grid"});
  }
  return *value - 1;
}

void DeckWells::read_welspecs() {
  cells_.require_dimensions();
  while (true) {
    const DeckRecord record = stream_.next_record(17);
    if (record.empty()) return;
    if (!record.has(0)) stream_.fail(record.line, {"the name of a well", "a default", ""});
    const std::string name(trimmed(record.items[0].text));
    const auto same = [&](const Specification& s) { return equal_ignoring_case(s.well.name, name); };
    auto found = std::find_if(specifications_.begin(), specifications_.end(), same);
    if (found == specifications_.end()) {
      found = specifications_.emplace(specifications_.end());
      found->well.name = name;
    }
    found->line = record.line;
    if (const auto i = cell_index(record, 2, 0)) found->i = i;
    if (const auto j = cell_index(record, 3, 1)) found->j = j;
    if (const auto depth = stream_.real(record, 4)) found->well.reference_depth = depth;
  }
}

/// Wells whose name fits item 1, which may be a list of WLIST or hold `*` and `?`.
std::vector<DeckWells::Specification*> DeckWells::named(const DeckRecord& record) {
  std::vector<Specification*> out;
  if (!record.has(0)) return out;
  const std::string_view pattern = trimmed(record.items[0].text);
  stream_.charge_steps(static_cast<std::int64_t>(specifications_.size()));
  if (const auto list = lists_.find(upper_case(pattern)); list != lists_.end()) {
    stream_.charge_steps(static_cast<std::int64_t>(specifications_.size() * list->second.size()));
    for (Specification& specification : specifications_)
      if (is_in(list->second, specification.well.name)) out.push_back(&specification);
    return out;
  }
  for (Specification& specification : specifications_)
    if (matches_pattern(specification.well.name, pattern)) out.push_back(&specification);
  return out;
}

std::vector<DeckWells::Specification*> DeckWells::need_named(const DeckRecord& record) {
  auto wells = named(record);
  if (wells.empty()) {
    stream_.fail(record.line,
                 {"a well that WELSPECS has named",
                  record.has(0) ? quoted_for_message(record.items[0].text) : "a default", "check the name"});
  }
  return wells;
}

void DeckWells::read_path(std::string_view keyword) {
  if (keyword == "WLIST") return read_well_list();
  if (keyword == "WELTRAJ" || keyword == "COMPTRAJ") return read_trajectories(keyword);
  cells_.require_dimensions();
  const auto segments_of = [this](const DeckRecord& record) -> DeckSegments& {
    return need_named(record).front()->segments;
  };
  const auto index = [this](const DeckRecord& record, std::size_t item, std::size_t axis) {
    return cell_index(record, item, axis);
  };
  if (keyword == "WELSEGS")
    read_welsegs(stream_, segments_of);
  else
    read_compsegs(stream_, segments_of, index);
}

void DeckWells::read_trajectories(std::string_view keyword) {
  static constexpr std::size_t most_items = 14;
  ++trajectory_keywords_;
  while (true) {
    const DeckRecord record = stream_.next_record(most_items);
    if (record.empty()) return;
    for (Specification* well : need_named(record)) {
      if (keyword == "WELTRAJ")
        add_station(stream_, record, trajectory_keywords_, well->branches);
      else
        add_perforation(stream_, record, well->branches);
    }
  }
}

/// `*LIST NEW A B /`: NEW, ADD, DEL or MOV.
void DeckWells::read_well_list() {
  while (true) {
    const DeckRecord record = stream_.next_record(10'000);
    if (record.empty()) return;
    const std::string name = stream_.word(record, 0).value_or("");
    const std::string action = stream_.word(record, 1).value_or("");
    if (name.size() < 2 || name.front() != '*')
      stream_.fail(record.line, {"the name of a list, *NAME, as item 1", quoted_for_message(name), ""});
    if (action != "NEW" && action != "ADD" && action != "DEL" && action != "MOV")
      stream_.fail(record.line, {"NEW, ADD, DEL or MOV as item 2", quoted_for_message(action), ""});
    std::vector<std::string> wells;
    for (std::size_t item = 2; item < record.items.size(); ++item) {
      DeckRecord one;
      one.items = {record.items[item]};
      one.line = record.line;
      for (const Specification* well : named(one)) wells.push_back(well->well.name);
    }
    std::vector<std::string>& list = lists_[name];
    if (action == "NEW") list.clear();
    const auto leaves = [&](std::vector<std::string>& from) {
      stream_.charge_steps(static_cast<std::int64_t>(from.size() * wells.size()));
      std::erase_if(from, [&](const std::string& well) { return is_in(wells, well); });
    };
    if (action == "MOV")
      for (auto& [other, members] : lists_) leaves(members);
    if (action == "DEL")
      leaves(list);
    else
      list.insert(list.end(), wells.begin(), wells.end());
    stream_.charge_values(static_cast<std::int64_t>(4 * wells.size()));
  }
}

void DeckWells::read_injectors() {
  while (true) {
    const DeckRecord record = stream_.next_record(20);
    if (record.empty()) return;
    for (Specification* specification : named(record)) specification->well.type = WellType::injector;
  }
}

void DeckWells::read_compdat() {
  cells_.require_dimensions();
  while (true) {
    const DeckRecord record = stream_.next_record(compdat::most_items);
    if (record.empty()) return;
    const auto wells = need_named(record);
    const DeckCompletion completion = read_completion(record);
    for (Specification* well : wells) complete(*well, record, completion);
  }
}

/// All but the cell.
DeckCompletion DeckWells::read_completion(const DeckRecord& record) const {
  DeckCompletion out;
  const std::string state = stream_.word(record, compdat::state).value_or("OPEN");
  if (state != "OPEN" && state != "SHUT" && state != "AUTO")
    stream_.fail(record.line, {"OPEN, SHUT or AUTO as item 6", quoted_for_message(state), ""});
  out.open = state != "SHUT";
  const std::string direction = stream_.word(record, compdat::direction).value_or("Z");
  if (direction != "X" && direction != "Y" && direction != "Z")
    stream_.fail(record.line, {"X, Y or Z as item 13", quoted_for_message(direction), ""});
  out.direction = direction.front();
  out.diameter = stream_.real(record, compdat::diameter).value_or(0.0);
  if (out.diameter < 0.0)
    stream_.fail(record.line, {"a bore diameter of 0 or more as item 9", fmt::format("{}", out.diameter), ""});
  out.skin = stream_.real(record, compdat::skin).value_or(0.0);
  // Simulators take a value of 0 or less as "calculate it", like a default.
  out.connection_factor = positive(stream_.real(record, compdat::factor));
  out.permeability_thickness = positive(stream_.real(record, compdat::kh));
  return out;
}

void DeckWells::complete(Specification& specification, const DeckRecord& record, const DeckCompletion& completion) {
  const auto i = cell_index(record, compdat::i, 0);
  const auto j = cell_index(record, compdat::j, 1);
  if ((!i && !specification.i) || (!j && !specification.j)) {
    stream_.fail(
        record.line,
        {fmt::format("I and J of {} here or in WELSPECS", quoted_for_message(specification.well.name)), "neither", ""});
  }
  const auto& n = cells_.dimensions();
  const std::int64_t first = cell_index(record, compdat::k_first, 2).value_or(0);
  const std::int64_t last = cell_index(record, compdat::k_last, 2).value_or(n[2] - 1);
  if (last < first)
    stream_.fail(record.line,
                 {"a first layer above the last", fmt::format("{} to {}", first + 1, last + 1), "swap items 4 and 5"});
  stream_.charge_steps(last - first + 1);
  const std::int64_t column = i.value_or(specification.i.value_or(0)) + n[0] * j.value_or(specification.j.value_or(0));
  for (std::int64_t k = first; k <= last; ++k) {
    DeckCompletion in_cell = completion;
    in_cell.cell = HostCellId(column + n[0] * n[1] * k);
    auto& completions = specification.well.completions;
    const auto [place, is_new] = specification.completion_of_cell.emplace(in_cell.cell.value(), completions.size());
    // A completion takes about as much memory as ten values.
    if (is_new) stream_.charge_values(10);
    if (is_new)
      completions.push_back(in_cell);
    else
      completions[place->second] = in_cell;
  }
}

namespace {

void convert(Well& well, UnitSystem units) {
  const double metre = metre_per_length_unit(units);
  if (well.reference_depth) *well.reference_depth *= metre;
  for (DeckCompletion& completion : well.completions) {
    completion.diameter *= metre;
    if (completion.connection_factor) *completion.connection_factor *= m3_per_transmissibility_unit(units);
    if (completion.permeability_thickness) *completion.permeability_thickness *= m2_per_millidarcy * metre;
  }
}

/// Bore radius and skin of the well, where its completions state them.
void set_bore(Well& well) {
  const auto given =
      std::find_if(well.completions.begin(), well.completions.end(), [](const auto& c) { return c.diameter > 0.0; });
  if (given != well.completions.end()) well.radial.bore_radius = given->diameter / 2.0;
  const double skin = well.completions.front().skin;
  const bool one_skin =
      std::all_of(well.completions.begin(), well.completions.end(), [&](const auto& c) { return c.skin == skin; });
  if (one_skin) well.skin = skin;
}

}  // namespace

std::vector<Well> DeckWells::finish_well(const Specification& specification, const CornerPointGrid& grid) {
  Well well = specification.well;
  const auto note = [&](const std::string& text) {
    stream_.notes.push_back(fmt::format("{}: well {}{}", stream_.main_file(), well.name, text));
  };
  const auto leave_out = [&](const char* reason) {
    note(fmt::format(" is left out: {}", reason));
    return std::vector<Well>();
  };
  const std::size_t given = well.completions.size();
  std::erase_if(well.completions, [&](const auto& completion) { return grid.active[completion.cell.index()] == 0; });
  const bool has_trajectory = !specification.branches.empty();
  if (given == 0 && !has_trajectory) return leave_out("COMPDAT completes it in no cell");
  if (well.completions.empty() && !has_trajectory) return leave_out("all its completions are in inactive cells");
  if (well.completions.size() < given) {
    note(fmt::format(": {} of its {} completions are in inactive cells and are dropped",
                     given - well.completions.size(), given));
  }
  convert(well, grid.units);
  if (!well.completions.empty()) set_bore(well);
  if (has_trajectory) return wells_with_trajectories(stream_, well, specification.branches, grid);
  if (!specification.segments.cells.empty()) {
    auto wells = wells_with_segments(stream_, well, specification.segments, grid);
    if (!wells.empty()) return wells;
    note(": no path comes of its segments; it is taken through its completed cells");
  }
  if (!set_path_through_cells(grid, well)) return leave_out("its completed cells have no thickness along it");
  if (std::none_of(well.completions.begin(), well.completions.end(), [](const auto& c) { return c.open; }))
    note(": all its completions are shut");
  return {std::move(well)};
}

std::vector<Well> DeckWells::finish(const CornerPointGrid& grid) {
  std::vector<Well> wells;
  for (const Specification& specification : specifications_)
    for (Well& well : finish_well(specification, grid)) wells.push_back(std::move(well));
  return wells;
}

}  // namespace wellknit
