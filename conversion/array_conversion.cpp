// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "conversion/array_conversion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <variant>

#include "algorithm/transfer_map.h"
#include "readers/text.h"
#include "writers/deck_text.h"

namespace wellknit {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// Names that an operation changes, in upper case: item 1 of its records, of a copy item 2.
std::vector<std::string> targets_of(const DeckTextKeyword& keyword) {
  std::vector<std::string> out;
  const std::int64_t item = keyword.name == "COPY" || keyword.name == "COPYREG" ? 1 : 0;
  for (const DeckTextRecord& record : keyword.records)
    if (std::string name = upper_case(trimmed(record.text(item))); !name.empty()) out.push_back(std::move(name));
  return out;
}

/// Unchanged host cells keep their number to the last digit; the others have what the mesh carries.
std::vector<double> values_on(const Mesh& mesh, const CornerPointGrid& grid, const std::string& name) {
  std::vector<double> source;
  const CellProperty& given = grid.properties.at(name);
  std::visit([&](const auto& values) { source.assign(values.begin(), values.end()); }, given);
  std::vector<double> out;
  std::visit([&](const auto& values) { out.assign(values.begin(), values.end()); }, mesh.cells.properties.at(name));
  if (const auto partly = grid.property_given.find(name); partly != grid.property_given.end()) {
    for (std::size_t c = 0; c < source.size(); ++c)
      if (partly->second[c] == 0) source[c] = no_value;
    out = mean_forward(mesh, source, PartWeight::volume, no_value);
  }
  for (std::size_t c = 0; c < out.size(); ++c) {
    const HostCellId cell = mesh.cells.source_cell[CellId(c)];
    if (mesh.cells.kind[CellId(c)] == CellKind::host && cell.is_valid()) out[c] = source[cell.index()];
  }
  return out;
}

/// Like write_deck_array(), with 1* where there is no value.
void write_partial_array(std::ostream& out, const std::string& name, const std::vector<double>& values) {
  out << name << '\n';
  int on_line = 0;
  for (std::size_t at = 0; at < values.size();) {
    std::size_t end = at + 1;
    while (end < values.size() && (values[end] == values[at] || (std::isnan(values[end]) && std::isnan(values[at]))))
      ++end;
    if (std::isnan(values[at]))
      out << fmt::format(" {}*", end - at);
    else
      out << fmt::format(" {}*{}", end - at, values[at]);
    if (++on_line % 4 == 0) out << '\n';
    at = end;
  }
  out << " /\n";
}

std::string array_text(const Mesh& mesh, const CornerPointGrid& grid, const std::string& name) {
  const std::vector<double> values = values_on(mesh, grid, name);
  std::ostringstream out;
  if (grid.property_given.contains(name))
    write_partial_array(out, name, values);
  else
    write_deck_array(out, name, values);
  return out.str();
}

std::string how_transferred(const CornerPointGrid& grid, const std::string& name) {
  return std::holds_alternative<std::vector<double>>(grid.properties.at(name))
             ? "made cells have the mean by volume, unchanged cells their own value"
             : "made cells have the value with the largest part, unchanged cells their own";
}

bool has_array(const Mesh& mesh, const CornerPointGrid& grid, const std::string& name) {
  return grid.properties.contains(name) && mesh.cells.properties.contains(name);
}

/// For each array the keyword that stands last.
std::map<std::string, std::size_t> last_keywords(const WholeDeck& deck) {
  std::map<std::string, std::size_t> out;
  for (std::size_t n = 0; n < deck.keywords.size(); ++n) {
    const DeckTextKeyword& keyword = deck.keywords[n];
    if (keyword.role == DeckRole::array) out[keyword.name] = n;
    if (keyword.role != DeckRole::operation) continue;
    for (const std::string& name : targets_of(keyword)) out[name] = n;
  }
  return out;
}

}  // namespace

void convert_arrays(const WholeDeck& deck, const CornerPointGrid& grid, const Mesh& mesh, DeckEdits& edits,
                    ConversionReport& report) {
  std::map<std::size_t, std::vector<std::string>> arrays_of;
  for (const auto& [name, keyword] : last_keywords(deck)) arrays_of[keyword].push_back(name);
  for (std::size_t n = 0; n < deck.keywords.size(); ++n) {
    const DeckTextKeyword& keyword = deck.keywords[n];
    if (keyword.role != DeckRole::array && keyword.role != DeckRole::operation && keyword.role != DeckRole::box)
      continue;
    const std::string& file = deck.files[keyword.file].name;
    std::string text;
    for (const std::string& name : arrays_of[n]) {
      if (!has_array(mesh, grid, name)) {
        report.add({name, "dropped", "an array that only served others", file, keyword.line});
        continue;
      }
      text += array_text(mesh, grid, name);
      report.add({name, "transferred", how_transferred(grid, name), file, keyword.line});
    }
    if (!text.empty()) text.pop_back();  // the line's end stands in the file
    if (text.empty() || keyword.role != DeckRole::array)
      report.add({keyword.name, "replaced", "by the arrays that it changes, in full", file, keyword.line});
    edits.replace(keyword, text);
  }
}

std::string arrays_of_grid_section(const WholeDeck& deck, const CornerPointGrid& grid, const Mesh& mesh,
                                   ConversionReport& report) {
  static constexpr std::array inside_the_list{"MULTNUM", "FLUXNUM", "OPERNUM", "PINCHNUM", "ISOLNUM", "FLUXREG"};
  const auto last = last_keywords(deck);
  std::string text;
  for (const auto& [name, values] : grid.properties) {
    if (last.contains(name) || !has_array(mesh, grid, name)) continue;
    if (std::ranges::find(inside_the_list, name) != inside_the_list.end()) {
      report.add({name, "dropped", "what it does is inside the connections and pore volumes"});
      continue;
    }
    text += array_text(mesh, grid, name);
    report.add({name, "transferred", how_transferred(grid, name)});
  }
  return text;
}

}  // namespace wellknit
