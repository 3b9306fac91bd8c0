// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "conversion/convert_deck.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <set>

#include "conversion/aquifer_conversion.h"
#include "conversion/array_conversion.h"
#include "conversion/deck_edits.h"
#include "conversion/record_text.h"
#include "conversion/schedule_conversion.h"
#include "conversion/schedule_wells.h"
#include "conversion/source_cells.h"
#include "conversion/summary_conversion.h"
#include "model/errors.h"
#include "readers/deck_well_path.h"
#include "readers/text.h"
#include "writers/deck_grid.h"
#include "writers/deck_text.h"

namespace wellknit {

namespace fs = std::filesystem;

namespace {

bool is_replaced(DeckSection section) { return section == DeckSection::grid || section == DeckSection::edit; }

std::vector<std::string> meshed_names(const DeckConversion& conversion) {
  std::vector<std::string> out;
  for (std::size_t w = 0; w < conversion.wells.size(); ++w)
    if (conversion.meshed[w]) {
      const Well& well = conversion.wells[w];
      out.push_back(well.parent.empty() ? well.name : well.parent);
    }
  return out;
}

class DeckConverter {
 public:
  DeckConverter(const DeckConversion& conversion, const DeckPlace& place)
      : deck_(conversion.deck),
        source_(conversion.source),
        mesh_(conversion.mesh),
        place_(place),
        edits_(conversion.deck),
        grid_(conversion.mesh, {conversion.source.grid.units, &conversion.source.grid}),
        cells_(conversion.source.grid, conversion.mesh, grid_),
        wells_(conversion.deck, conversion.source, conversion.wells, conversion.mesh, meshed_names(conversion), grid_,
               cells_) {
    note_wells(conversion);
    note_rings(conversion);
  }

  ConversionReport convert() {
    convert_flags();
    const std::string aquifers = convert_aquifers(deck_, source_.grid, cells_, edits_, report_);
    replace_grid(aquifers);
    convert_arrays(deck_, source_.grid, mesh_, edits_, report_);
    const std::function<bool(std::string_view)> is_meshed = [this](std::string_view name) {
      const ScheduleWell* well = wells_.find(name);
      return well != nullptr && well->is_meshed;
    };
    convert_summary(deck_, source_.grid, cells_, is_meshed, edits_, report_);
    const std::int64_t connections = convert_schedule(deck_, source_, mesh_, wells_, cells_, edits_, report_);
    convert_dimensions(connections);
    write_includes();
    write_grid();
    write_file(place_.file, edits_.text_of(0));
    note_small_cells();
    note_gas_lift();
    for (std::string& note : grid_.notes()) report_.notes.push_back(std::move(note));
    return std::move(report_);
  }

 private:
  void note_wells(const DeckConversion& conversion);
  void note_rings(const DeckConversion& conversion);
  void note_small_cells();
  void note_gas_lift();
  void convert_flags();
  void replace_grid(const std::string& aquifers);
  [[nodiscard]] bool keeps_any(std::size_t file) const;
  [[nodiscard]] std::string carried_from_grid();
  void convert_dimensions(std::int64_t connections);
  void write_includes();
  void write_grid() const;
  static void write_file(const std::string& path, const std::string& text);
  [[nodiscard]] std::string include_line(const std::string& name) const {
    return fmt::format("INCLUDE\n '{}/{}' /\n", place_.folder_name, name);
  }

  const WholeDeck& deck_;
  const Case& source_;
  const Mesh& mesh_;
  const DeckPlace& place_;
  DeckEdits edits_;
  DeckGrid grid_;
  SourceCells cells_;
  ScheduleWells wells_;
  ConversionReport report_;
};

void DeckConverter::note_wells(const DeckConversion& conversion) {
  for (const Well& well : conversion.wells) {
    const std::string& name = well.parent.empty() ? well.name : well.parent;
    if (wells_.find(name) == nullptr)
      report_.notes.push_back(fmt::format(
          "well {} has no WELSPECS in the deck: it is not in the new deck; name it with --well FILE,name=…", name));
  }
  for (const ScheduleWell& well : wells_.all())
    if (well.is_meshed && well.completed.empty() && !well.has_trajectory)
      report_.notes.push_back(fmt::format("well {} has a mesh, but the deck completes it nowhere", well.name));
}

void DeckConverter::note_rings(const DeckConversion& conversion) {
  const DeckRings& chosen = conversion.chosen;
  std::vector<std::string> parts;
  if (chosen.sectors) parts.push_back(fmt::format("{} sectors", *chosen.sectors));
  if (chosen.rings) parts.push_back(fmt::format("{} rings", *chosen.rings));
  if (chosen.growth) parts.push_back(fmt::format("ring widths that grow by {}", *chosen.growth));
  if (parts.empty() || std::ranges::none_of(conversion.meshed, std::identity{})) return;
  report_.notes.push_back(
      fmt::format("the deck has several phases: meshes have {}, so that cells at a bore are large enough for long "
                  "steps; --sectors, "
                  "--rings and --growth take others",
                  fmt::join(parts, ", ")));
}

/// Flow's optimizer of gas lift demands the minimum from a well that comes on its tubing-head pressure with less, and
/// does not give it before (docs/validation_decks.md#gas-lift-of-model5).
void DeckConverter::note_gas_lift() {
  std::set<std::string> named;
  for (const DeckTextKeyword& keyword : deck_.keywords) {
    if (keyword.role != DeckRole::gas_lift) continue;
    for (const DeckTextRecord& record : keyword.records) {
      const RecordItems items(deck_, keyword, record);
      if (items.word(1, "NO").starts_with('Y') && items.positive(4)) named.emplace(trimmed(record.text(0)));
    }
  }
  for (const std::string& name : named)
    report_.notes.push_back(fmt::format(
        "WLIFTOPT has a minimum of lift gas for well {} (item 5): flow may stop at its assertion `alq >= min_alq` when "
        "the well comes on its tubing-head pressure limit, in the old deck as in the new one; 0 there avoids it",
        name));
}

/// Where gas comes out of solution, a cell whose pores the flow replaces many times a step makes Newton's method fail
/// (docs/validation_decks.md).
void DeckConverter::note_small_cells() {
  constexpr double small = 1e-5;
  double least = std::numeric_limits<double>::infinity();
  double host = 0.0;
  std::int64_t hosts = 0;
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
    const double pores = mesh_.cells.pore_volume[CellId(c)];
    if (mesh_.cells.kind[CellId(c)] == CellKind::radial && pores > 0.0) least = std::min(least, pores);
    if (mesh_.cells.kind[CellId(c)] != CellKind::host) continue;
    host += pores;
    ++hosts;
  }
  if (hosts == 0 || !(least < small * host / static_cast<double>(hosts))) return;
  report_.notes.push_back(fmt::format(
      "the least pore volume of a cell at a bore is {:.2g} m3, {:.1g} of the host's mean: where gas comes "
      "out of solution, steps may get very short; more even rings (--growth 1.2), fewer rings or sectors help",
      least, least * static_cast<double>(hosts) / host));
}

void DeckConverter::convert_flags() {
  for (const DeckTextKeyword& keyword : deck_.keywords) {
    if (keyword.role != DeckRole::dropped) continue;
    const WholeDeckRule* rule = find_whole_deck_rule(keyword.name, keyword.section);
    report_.add({keyword.name, "dropped", std::string(rule->reason), deck_.files[keyword.file].name, keyword.line});
    if (!is_replaced(keyword.section))
      edits_.replace(keyword, fmt::format("-- {} dropped: {}", keyword.name, rule->reason));
  }
}

/// Of GRID, what is no grid.
std::string DeckConverter::carried_from_grid() {
  std::string text;
  for (const DeckTextKeyword& keyword : deck_.keywords) {
    if (keyword.role != DeckRole::grid_carried) continue;
    text += deck_.files[keyword.file].content.text.substr(keyword.begin, keyword.end - keyword.begin);
    text += '\n';
    report_.add({keyword.name, "copied", "into the new GRID section", deck_.files[keyword.file].name, keyword.line});
  }
  return text;
}

/// True where anything of the file, or of what it includes, stays.
bool DeckConverter::keeps_any(std::size_t file) const {
  return std::ranges::any_of(deck_.parts, [&](const DeckTextPart& part) {
    if (part.file != file) return false;
    if (part.includes) return !is_replaced(part.section) || keeps_any(*part.includes);
    return !is_replaced(part.section);
  });
}

void DeckConverter::replace_grid(const std::string& aquifers) {
  const std::string text = include_line("grid.inc") + carried_from_grid() + aquifers +
                           arrays_of_grid_section(deck_, source_.grid, mesh_, report_) + "\nEDIT\n" +
                           include_line("edit.inc") + "\n";
  bool is_written = false;
  for (const DeckTextPart& part : deck_.parts) {
    if (!is_replaced(part.section)) continue;
    if (part.includes && keeps_any(*part.includes)) continue;
    std::size_t begin = part.begin;
    if (!is_written) begin = std::min(part.end, next_line(deck_.files[part.file].content.text, part.begin));
    edits_.replace(part.file, begin, part.end, is_written ? "" : text);
    is_written = true;
  }
  report_.add({"GRID", "replaced",
               fmt::format("by {} cells and {} connections", mesh_.cells.size(), grid_.connection_count()),
               deck_.files.front().name});
  report_.add({"EDIT", "replaced", "by pore volumes; what it changed is inside them and the connections"});
}

void DeckConverter::convert_dimensions(std::int64_t connections) {
  const DeckTextKeyword* dimensions = nullptr;
  bool has_wells = false;
  for (const DeckTextKeyword& keyword : deck_.keywords) {
    if (keyword.role != DeckRole::dimensions && keyword.role != DeckRole::well_dimensions) continue;
    const DeckTextRecord& record = keyword.records.front();
    const RecordItems items(deck_, keyword, record);
    ItemTexts changed{{0, fmt::format("{}", mesh_.cells.size())}, {1, "1"}, {2, "1"}};
    if (keyword.role == DeckRole::well_dimensions) {
      has_wells = true;
      changed = {{1, fmt::format("{}", std::max(connections, items.integer(1).value_or(0)))}};
    } else {
      dimensions = &keyword;
    }
    // An empty record begins and ends at its '/'.
    edits_.replace_record(keyword, record, {record_text(deck_.files[keyword.file].content.text, record, changed)}, "");
    report_.add({keyword.name, "rewritten",
                 has_wells && keyword.role == DeckRole::well_dimensions ? "room for the most connections of a well"
                                                                        : "cells in a row",
                 deck_.files[keyword.file].name, keyword.line});
  }
  if (has_wells || dimensions == nullptr) return;
  const auto wells = wells_.all().size();
  edits_.insert_below(*dimensions, fmt::format("WELLDIMS\n {} {} {} {} /\n", wells, connections, wells + 1, wells));
  report_.add({"WELLDIMS", "added", "the deck has none, and Flow asks for it"});
}

void DeckConverter::write_includes() {
  std::set<std::string> taken;
  std::map<std::string, std::string> unchanged;  ///< by path
  const fs::path folder = fs::path(place_.folder) / "files";
  std::int64_t copied = 0;
  for (std::size_t f = deck_.files.size(); f-- > 1;) {
    // Later files first: an INCLUDE inside a file changes that file.
    const DeckTextFile& file = deck_.files[f];
    if (!keeps_any(f)) continue;
    const bool is_changed = edits_.is_changed(f);
    std::string name;
    if (const auto known = unchanged.find(file.content.path); !is_changed && known != unchanged.end()) {
      name = known->second;
    } else {
      const fs::path own = fs::path(file.name).filename();
      name = own.string();
      for (int n = 2; !taken.insert(upper_case(name)).second; ++n)
        name = fmt::format("{}_{}{}", own.stem().string(), n, own.extension().string());
      fs::create_directories(folder);
      write_file((folder / name).string(), edits_.text_of(f));
      if (!is_changed) unchanged.emplace(file.content.path, name);
      ++copied;
    }
    edits_.replace(*file.parent, file.path_begin, file.path_end,
                   fmt::format("'{}/files/{}'", place_.folder_name, name));
  }
  if (copied > 0)
    report_.add(
        {"INCLUDE", "copied", "files beside the new deck; their keywords are rewritten in them", "", 0, copied});
}

void DeckConverter::write_file(const std::string& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) throw WriteError(fmt::format("{}: cannot be written; is the disk full?", path));
}

void DeckConverter::write_grid() const {
  for (const bool is_grid : {true, false}) {
    const std::string path = (fs::path(place_.folder) / (is_grid ? "grid.inc" : "edit.inc")).string();
    std::ofstream out(path, std::ios::binary);
    if (is_grid) {
      write_deck_comment(out, "The mesh as a connection list. Cell n of the mesh file is (n+1, 1, 1).");
      write_deck_comment(out, "The boxes carry depth, thickness and volume only; what connects is the NNC list.");
      grid_.write_grid(out);
    } else {
      grid_.write_edit(out);
    }
    out.close();
    if (!out) throw WriteError(fmt::format("{}: cannot be written; is the disk full?", path));
  }
}

}  // namespace

std::string deck_folder_of(const std::string& path) {
  const fs::path deck(path);
  return (deck.parent_path() / (deck.stem().string() + "_parts")).string();
}

void refuse_what_cannot_be_converted(const WholeDeck& deck) {
  if (deck.refusals.empty()) return;
  const ParseError& first = deck.refusals.front();
  throw ParseError(first.where(), first.problem());
}

DeckRings rings_for(const WholeDeck& deck) {
  if (std::ranges::count(deck.keywords, DeckRole::phase, &DeckTextKeyword::role) < 2) return {};
  // In 15 m the first ring is 4 m wide, where 5 rings with radii in geometric progression leave 0.2 m; gas that comes
  // out of solution goes to and fro between the wedges of many sectors.
  return {6, 3, 1.2};
}

void open_all_completions(const CornerPointGrid& grid, Well& well) {
  if (!well.perforations.empty()) {
    std::vector<MeasuredDepthRange> ranges;
    for (Perforation& perforation : well.perforations) {
      perforation.open = true;
      ranges.push_back(perforation.range);
    }
    std::ranges::sort(ranges, {}, &MeasuredDepthRange::from);
    well.open.clear();
    for (const MeasuredDepthRange& range : ranges) {
      if (!well.open.empty() && range.from <= well.open.back().to)
        well.open.back().to = std::max(well.open.back().to, range.to);
      else
        well.open.push_back(range);
    }
    return;
  }
  if (!well.approximate_path || std::ranges::all_of(well.completions, &DeckCompletion::open)) return;
  for (DeckCompletion& completion : well.completions) completion.open = true;
  set_path_through_cells(grid, well);
}

ConversionReport convert_deck(const DeckConversion& conversion, const DeckPlace& place) {
  return DeckConverter(conversion, place).convert();
}

}  // namespace wellknit
