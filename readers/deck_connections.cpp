// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/deck_connections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "readers/text.h"
#include "readers/unapplied.h"

namespace wellknit {

namespace {

/// Defaults of PINCH and MINPV, in the deck's units.
constexpr double default_pinch_threshold = 0.001;
constexpr double default_largest_gap = 1e20;
constexpr double default_least_pore_volume = 1e-6;

/// Simulators tell names of faults apart by so many characters.
constexpr std::size_t fault_name_length = 8;

std::string fault_key(std::string_view name) { return upper_case(name.substr(0, fault_name_length)); }

std::optional<FaceDirection> face_of(std::string_view word) {
  if (word.empty() || word.size() > 2) return std::nullopt;
  if (word.size() == 2 && word[1] != '-' && word[1] != '+') return std::nullopt;
  std::size_t axis = std::string_view("XYZ").find(word[0]);
  if (axis == std::string_view::npos) axis = std::string_view("IJK").find(word[0]);
  if (axis == std::string_view::npos) return std::nullopt;
  const bool minus = word.size() == 2 && word[1] == '-';
  return static_cast<FaceDirection>(2 * axis + (minus ? 0 : 1));
}

void scale(std::vector<CellPairValue>& pairs, double unit) {
  for (CellPairValue& pair : pairs) pair.value *= unit;
}

double unit_of(ComputedArray array, UnitSystem units) {
  if (array == ComputedArray::depth) return metre_per_length_unit(units);
  if (array == ComputedArray::pore_volume) return m3_per_reservoir_volume_unit(units);
  return m3_per_transmissibility_unit(units);
}

}  // namespace

void DeckConnections::read() {
  const DeckKeyword& keyword = stream_.keyword();
  arrays_.require_dimensions();
  note_not_applied(stream_, keyword.name, keyword.line);
  if (keyword.name == "FAULTS") return read_faults();
  if (keyword.name == "MULTFLT") return read_fault_multipliers();
  if (keyword.name == "MULTREGT") return read_region_multipliers();
  if (keyword.name == "MULTREGP") return read_region_pore_volumes();
  if (keyword.name == "NNC") return read_pairs(edits_.non_neighbours, 0.0);
  if (keyword.name == "EDITNNC") return read_pairs(edits_.non_neighbour_multipliers, 1.0);
  if (keyword.name == "EDITNNCR") return read_pairs(edits_.non_neighbour_transmissibilities, 0.0);
  if (keyword.name == "PINCH") return read_pinch();
  if (keyword.name == "MINPV" || keyword.name == "MINPORV") return read_least_pore_volume();
  if (keyword.name == "PINCHOUT") edits_.pinchout = true;
  if (keyword.name == "NEWTRAN") ask_for(TransmissibilityMethod::newtran);
  if (keyword.name == "OLDTRAN") ask_for(TransmissibilityMethod::oldtran);
  if (keyword.name == "OLDTRANR") ask_for(TransmissibilityMethod::oldtranr);
}

void DeckConnections::ask_for(TransmissibilityMethod method) {
  edits_.method = method;
  method_where_ = {stream_.keyword().file, stream_.keyword().line, stream_.keyword().name};
}

/// The last one counts.
void DeckConnections::refuse_block_centred_method() const {
  if (edits_.method != TransmissibilityMethod::oldtran && edits_.method != TransmissibilityMethod::oldtranr) return;
  throw ParseError(method_where_, {"NEWTRAN, or no keyword for it", method_where_.keyword,
                                   "transmissibilities of block centres are not available: take the keyword out for "
                                   "those of corner points, as OPM Flow has them"});
}

Fault& DeckConnections::fault_named(const std::string& name, std::int64_t line) {
  const auto [found, is_new] = fault_of_name_.try_emplace(fault_key(name), edits_.faults.size());
  if (is_new) {
    edits_.faults.emplace_back().name = name;
  } else if (const std::string& first = edits_.faults[found->second].name; !equal_ignoring_case(first, name)) {
    stream_.note_once(
        "fault names", line,
        fmt::format("FAULTS {} and {} are one fault: their first {} characters are the same, and only these count",
                    quoted_for_message(first), quoted_for_message(name), fault_name_length));
  }
  return edits_.faults[found->second];
}

void DeckConnections::read_faults() {
  while (true) {
    const DeckRecord record = stream_.next_record(8);
    if (record.empty()) return;
    for (std::size_t item = 0; item < 8; ++item)
      if (!record.has(item))
        stream_.fail(record.line, {"a fault's name, I1 I2 J1 J2 K1 K2 and a face", fmt::format("no item {}", item + 1),
                                   "faults have no defaults"});
    FaultFaces faces;
    faces.cells = arrays_.read_box_items(record, 1, {});
    const auto face = face_of(*stream_.word(record, 7));
    if (!face)
      stream_.fail(record.line, {"a face as item 8: X, Y, Z, X-, Y-, Z-, I, J, K, I-, J- or K-",
                                 quoted_for_message(record.items[7].text), ""});
    faces.face = *face;
    fault_named(std::string(trimmed(record.items[0].text)), record.line).faces.push_back(faces);
  }
}

double DeckConnections::read_multiplier(const DeckRecord& record, std::size_t item) const {
  const auto value = stream_.real(record, item);
  if (!value || *value < 0.0)
    stream_.fail(record.line, {fmt::format("a multiplier of 0 or more as item {}", item + 1),
                               value ? quoted_for_message(record.items[item].text) : "none", ""});
  return *value;
}

void DeckConnections::read_fault_multipliers() {
  while (true) {
    const DeckRecord record = stream_.next_record(2);
    if (record.empty()) return;
    if (!record.has(0)) stream_.fail(record.line, {"the name of a fault as item 1", "none", ""});
    fault_multipliers_.push_back({std::string(trimmed(record.items[0].text)),
                                  read_multiplier(record, 1),
                                  arrays_.section() == DeckSection::edit,
                                  {stream_.keyword().file, record.line, stream_.keyword().name}});
  }
}

RegionSet DeckConnections::read_region_set(const DeckRecord& record, std::size_t item, RegionSet fallback) const {
  static constexpr std::array sets{RegionSet::multnum, RegionSet::fluxnum, RegionSet::opernum};
  return sets[read_option(record, item, {"M", "F", "O"}, static_cast<std::size_t>(fallback))];
}

/// Defaults and negative numbers mean every region.
std::optional<std::int32_t> DeckConnections::read_region(const DeckRecord& record, std::size_t item) const {
  const auto value = stream_.integer(record, item);
  if (!value || *value < 0) return std::nullopt;
  if (*value > std::numeric_limits<std::int32_t>::max())
    stream_.fail(record.line, {fmt::format("the number of a region as item {}", item + 1),
                               quoted_for_message(record.items[item].text), ""});
  return static_cast<std::int32_t>(*value);
}

std::size_t DeckConnections::read_option(const DeckRecord& record, std::size_t item,
                                         const std::vector<std::string>& options, std::size_t fallback) const {
  const auto word = stream_.word(record, item);
  if (!word) return fallback;
  const auto found = std::find(options.begin(), options.end(), *word);
  if (found != options.end()) return static_cast<std::size_t>(found - options.begin());
  std::string list;
  for (std::size_t n = 0; n < options.size(); ++n)
    list += (n == 0 ? "" : n + 1 == options.size() ? " or " : ", ") + options[n];
  stream_.fail(record.line,
               {fmt::format("{} as item {}", list, item + 1), quoted_for_message(record.items[item].text), ""});
}

void DeckConnections::read_region_multipliers() {
  while (true) {
    const DeckRecord record = stream_.next_record(6);
    if (record.empty()) return;
    RegionMultiplier entry;
    entry.from = read_region(record, 0);
    entry.to = read_region(record, 1);
    entry.multiplier = read_multiplier(record, 2);
    if (const auto directions = stream_.word(record, 3)) {
      entry.directions = {};
      for (const char letter : *directions) {
        const std::size_t axis = std::string_view("XYZ").find(letter);
        if (axis == std::string_view::npos || entry.directions[axis])
          stream_.fail(record.line, {"X, Y, Z, XY, XZ, YZ or XYZ as item 4", quoted_for_message(*directions), ""});
        entry.directions[axis] = true;
      }
    }
    entry.connections = static_cast<RegionConnections>(read_option(record, 4, {"ALL", "NNC", "NONNC", "NOAQUNNC"}, 0));
    // Left out, the regions are those of the record before.
    const RegionSet before =
        edits_.region_multipliers.empty() ? RegionSet::multnum : edits_.region_multipliers.back().regions;
    entry.regions = read_region_set(record, 5, before);
    edits_.region_multipliers.push_back(entry);
  }
}

void DeckConnections::read_region_pore_volumes() {
  while (true) {
    const DeckRecord record = stream_.next_record(3);
    if (record.empty()) return;
    const auto region = read_region(record, 0);
    if (!region) {
      if (!record.has(0)) stream_.fail(record.line, {"the number of a region as item 1", "none", ""});
      continue;  // a negative one has no effect
    }
    edits_.region_pore_volumes.push_back(
        {*region, read_multiplier(record, 1), read_region_set(record, 2, RegionSet::multnum)});
  }
}

HostCellId DeckConnections::read_cell(const DeckRecord& record, std::size_t first_item) const {
  const auto& dimensions = arrays_.dimensions();
  std::array<std::int64_t, 3> cell{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto index = stream_.integer(record, first_item + axis);
    if (!index || *index < 1 || *index > dimensions[axis])
      stream_.fail(record.line, {fmt::format("{} of a cell within 1 and {} as item {}", "IJK"[axis], dimensions[axis],
                                             first_item + axis + 1),
                                 index ? quoted_for_message(record.items[first_item + axis].text) : "none", ""});
    cell[axis] = *index - 1;
  }
  return HostCellId(cell[0] + dimensions[0] * (cell[1] + dimensions[1] * cell[2]));
}

void DeckConnections::read_pairs(std::vector<CellPairValue>& pairs, double default_value) {
  while (true) {
    const DeckRecord record = stream_.next_record(20);
    if (record.empty()) return;
    CellPairValue pair{read_cell(record, 0), read_cell(record, 3), default_value};
    if (pair.first == pair.second)
      stream_.fail(record.line, {"two different cells", "the same cell twice", "take the record out"});
    if (record.has(6)) pair.value = read_multiplier(record, 6);
    for (std::size_t item = 7; item < record.items.size(); ++item) {
      if (record.has(item) && parse_real(record.items[item].text) != 0.0)
        stream_.note_once(
            stream_.keyword().name + " items", record.line,
            fmt::format("{}: items 8 and on (tables, faces, diffusivity) are not carried", stream_.keyword().name));
    }
    pairs.push_back(pair);
  }
}

void DeckConnections::read_pinch() {
  const DeckRecord record = stream_.next_record(5);
  const auto length = [&](std::size_t item, double fallback) {
    const double value = stream_.real(record, item).value_or(fallback);
    if (value < 0.0)
      stream_.fail(record.line, {fmt::format("a thickness of 0 or more as item {}", item + 1),
                                 quoted_for_message(record.items[item].text), ""});
    return value;
  };
  PinchOptions pinch;
  pinch.threshold = length(0, default_pinch_threshold);
  pinch.across_gaps = read_option(record, 1, {"GAP", "NOGAP"}, 0) == 0;
  pinch.largest_gap = length(2, default_largest_gap);
  pinch.transmissibility = static_cast<PinchTransmissibility>(read_option(record, 3, {"TOPBOT", "ALL"}, 0));
  pinch.multiplier = static_cast<PinchMultiplier>(read_option(record, 4, {"TOP", "ALL"}, 0));
  edits_.pinch = pinch;
}

void DeckConnections::read_least_pore_volume() {
  const DeckRecord record = stream_.next_record(1);
  const double value = stream_.real(record, 0).value_or(default_least_pore_volume);
  if (value < 0.0)
    stream_.fail(record.line, {"a pore volume of 0 or more", quoted_for_message(record.items[0].text), ""});
  edits_.least_pore_volume = value;
}

/// Of GRID the last record for a fault counts; the last one of EDIT multiplies it.
void DeckConnections::apply_fault_multipliers() {
  std::vector<double> edit(edits_.faults.size(), 1.0);
  for (const FaultMultiplier& record : fault_multipliers_) {
    bool found = false;
    const auto set = [&](std::size_t fault) {
      found = true;
      (record.in_edit ? edit[fault] : edits_.faults[fault].multiplier) = record.multiplier;
    };
    if (record.pattern.find('*') == std::string::npos) {
      if (const auto at = fault_of_name_.find(fault_key(record.pattern)); at != fault_of_name_.end()) set(at->second);
    } else {
      stream_.charge_steps(static_cast<std::int64_t>(edits_.faults.size()));
      for (std::size_t fault = 0; fault < edits_.faults.size(); ++fault)
        if (matches_pattern(edits_.faults[fault].name, record.pattern)) set(fault);
    }
    if (!found)
      stream_.notes.push_back(fmt::format("{}:{}: MULTFLT names {}, which FAULTS does not; the record has no effect",
                                          record.where.file, record.where.line, quoted_for_message(record.pattern)));
  }
  for (std::size_t fault = 0; fault < edit.size(); ++fault) edits_.faults[fault].multiplier *= edit[fault];
}

std::vector<double> DeckConnections::take_array(const std::string& name, double unset_value) {
  const auto found = arrays_.arrays.find(name);
  if (found == arrays_.arrays.end()) return {};
  auto values = std::get<std::vector<double>>(std::move(found->second.values));
  for (std::size_t cell = 0; cell < values.size(); ++cell) {
    if (!is_given(values[cell])) values[cell] = unset_value;
    if (values[cell] < 0.0 || !std::isfinite(values[cell]))
      throw ParseError(found->second.last_set, {"values of 0 or more", fmt::format("{}", values[cell]), ""});
  }
  arrays_.arrays.erase(found);
  return values;
}

void DeckConnections::take_arrays() {
  for (std::size_t face = 0; face < edits_.face_multiplier.size(); ++face) {
    const std::string name = multiplier_keyword(static_cast<FaceDirection>(face));
    std::vector<double>& product = edits_.face_multiplier[face];
    product = take_array(name, 1.0);
    std::vector<double> edit = take_array(CellArrays::edit_name(name), 1.0);
    if (product.empty()) {
      product = std::move(edit);
    } else if (!edit.empty()) {
      for (std::size_t cell = 0; cell < product.size(); ++cell) product[cell] *= edit[cell];
    }
  }
  edits_.pore_volume_multiplier = take_array("MULTPV", 1.0);
  edits_.pore_volume_multiplier_edit = take_array(CellArrays::edit_name("MULTPV"), 1.0);
  const double threshold = edits_.least_pore_volume.value_or(default_least_pore_volume);
  edits_.least_pore_volume_by_cell = take_array("MINPVV", threshold);
  edits_.array_edits = std::move(arrays_.edits);
}

ConnectionEdits DeckConnections::finish(UnitSystem units) {
  refuse_block_centred_method();
  apply_fault_multipliers();
  take_arrays();
  const double volume = m3_per_reservoir_volume_unit(units);
  const double transmissibility = m3_per_transmissibility_unit(units);
  const double length = metre_per_length_unit(units);
  scale(edits_.non_neighbours, transmissibility);
  scale(edits_.non_neighbour_transmissibilities, transmissibility);
  if (edits_.pinch) edits_.pinch->threshold *= length;
  if (edits_.pinch) edits_.pinch->largest_gap *= length;
  if (edits_.least_pore_volume) *edits_.least_pore_volume *= volume;
  for (double& least : edits_.least_pore_volume_by_cell) least *= volume;
  for (ArrayEdit& edit : edits_.array_edits) {
    const double unit = unit_of(edit.array, units);
    if (edit.operation != ArrayOperation::multiply) edit.value *= unit;
    for (double& value : edit.values) value *= unit;
  }
  return std::move(edits_);
}

}  // namespace wellknit
