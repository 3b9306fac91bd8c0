// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "conversion/schedule_conversion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

#include "algorithm/host_mesh.h"
#include "algorithm/peaceman.h"
#include "algorithm/refined_path.h"
#include "conversion/completion_factor.h"
#include "conversion/record_text.h"
#include "model/errors.h"
#include "model/units.h"
#include "readers/text.h"

namespace wellknit {

namespace {

/// Which items of a keyword hold its cells.
struct CellItems {
  std::int64_t i, j, k;
  std::int64_t k_last;        ///< same as k where there is no range
  std::int64_t first_number;  ///< of completion numbers (two items); -1: it has none
};

CellItems cell_items(std::string_view keyword) {
  if (keyword == "COMPLUMP" || keyword == "CSKIN") return {1, 2, 3, 4, -1};
  if (keyword == "WINJMULT") return {4, 5, 6, 6, -1};
  return {2, 3, 4, 4, 5};  // WELOPEN, WPIMULT
}

/// Cells along each axis; empty: any.
struct CellFilter {
  std::optional<std::int64_t> i, j, k_first, k_last;

  [[nodiscard]] bool is_any() const { return !i && !j && !k_first && !k_last; }
  [[nodiscard]] bool fits(const std::array<std::int64_t, 3>& ijk) const {
    return (!i || ijk[0] == *i) && (!j || ijk[1] == *j) && (!k_first || ijk[2] >= *k_first) &&
           (!k_last || ijk[2] <= *k_last);
  }
};

class ScheduleConverter {
 public:
  ScheduleConverter(const WholeDeck& deck, const Case& source, const Mesh& mesh, ScheduleWells& wells,
                    const SourceCells& cells, DeckEdits& edits, ConversionReport& report)
      : deck_(deck),
        source_(source),
        grid_(source.grid),
        mesh_(mesh),
        wells_(wells),
        cells_(cells),
        edits_(edits),
        report_(report) {}

  std::int64_t convert() {
    find_numbered();
    for (const DeckTextKeyword& keyword : deck_.keywords) {
      switch (keyword.role) {
        case DeckRole::well_heads: convert_heads(keyword); break;
        case DeckRole::completions: convert_completions(keyword); break;
        case DeckRole::well_cells: convert_well_cells(keyword); break;
        case DeckRole::segment_cells: convert_segments(keyword); break;
        case DeckRole::connection_order: drop(keyword, "each well has an order of its own below WELSPECS"); break;
        case DeckRole::stations: drop(keyword, "COMPDAT has the path's cells"); break;
        case DeckRole::perforations: convert_perforations(keyword); break;
        case DeckRole::well_names: update_lists(deck_, keyword, wells_, lists_); break;
        default: break;
      }
    }
    std::size_t most = 1;
    for (const auto& [name, connected] : connected_) most = std::max(most, connected.size());
    return static_cast<std::int64_t>(most);
  }

 private:
  /// One connection of one COMPDAT record.
  struct Line {
    std::size_t record;
    HostCellId owner;
    CellId cell;
    ItemTexts items;      ///< of the record, as they change
    double factor = 0.0;  ///< m3
    double permeability_thickness = 0.0;
    bool is_stated = false;  ///< the record has both, and they are the cell's alone
    std::size_t record_of_items = record;
  };

  [[nodiscard]] std::string_view text_of(const DeckTextKeyword& keyword) const {
    return deck_.files[keyword.file].content.text;
  }
  void add(const DeckTextKeyword& keyword, const char* action, std::string detail, std::int64_t count = 1) {
    report_.add({keyword.name, action, std::move(detail), deck_.files[keyword.file].name, keyword.line, count});
  }
  void drop(const DeckTextKeyword& keyword, const char* why) {
    edits_.replace(keyword, fmt::format("-- {} dropped: {}", keyword.name, why));
    add(keyword, "dropped", why);
  }
  [[nodiscard]] double metre() const { return metre_per_length_unit(grid_.units); }
  [[nodiscard]] std::string factor_text(double factor) const {
    return fmt::format("{}", factor / m3_per_transmissibility_unit(grid_.units));
  }
  [[nodiscard]] std::string thickness_text(double kh) const {
    return fmt::format("{}", kh / (m2_per_millidarcy * metre()));
  }
  [[nodiscard]] std::vector<const ScheduleWell*> need_named(const DeckTextKeyword& keyword,
                                                            const DeckTextRecord& record) const;
  void find_numbered();
  void convert_heads(const DeckTextKeyword& keyword);
  [[nodiscard]] bool is_in_depth_order(const ScheduleWell& well) const;
  void convert_completions(const DeckTextKeyword& keyword);
  std::vector<Line> lines_of(const DeckTextKeyword& keyword, std::size_t record, const ScheduleWell& well);
  std::vector<Line> meshed_lines(const DeckTextKeyword& keyword, std::size_t record, const ScheduleWell& well);
  static double factor_with_skin(const RecordItems& items, const ScheduleWell& well, const MeshedConnection& connection,
                                 double skin, int item);
  std::vector<Line> host_lines(const DeckTextKeyword& keyword, std::size_t record, const ScheduleWell& well);
  void sort_lines(const ScheduleWell& well, std::vector<Line>& lines) const;
  std::string line_text(const DeckTextKeyword& keyword, const ScheduleWell& well, const Line& line);
  void remember(const ScheduleWell& well, const std::vector<Line>& lines);
  void add_numbers(const DeckTextKeyword& keyword, const std::set<const ScheduleWell*>& wells);
  void convert_well_cells(const DeckTextKeyword& keyword);
  [[nodiscard]] CellFilter filter_of(const RecordItems& items, const CellItems& at) const;
  void convert_segments(const DeckTextKeyword& keyword);
  void convert_perforations(const DeckTextKeyword& keyword);
  std::vector<std::string> perforation_lines(const DeckTextKeyword& keyword, const DeckTextRecord& record,
                                             const ScheduleWell& well);
  std::vector<HostWellConnection> host_perforations(const Well& well);
  /// The mesh's cells that the well has in a source cell so far.
  [[nodiscard]] std::vector<CellId> cells_in(const ScheduleWell& well, HostCellId source) const;

  const WholeDeck& deck_;
  const Case& source_;
  const CornerPointGrid& grid_;
  const Mesh& mesh_;
  ScheduleWells& wells_;
  const SourceCells& cells_;
  DeckEdits& edits_;
  ConversionReport& report_;
  WellLists lists_;
  std::set<std::string> known_;  ///< wells that WELSPECS has named so far
  /// By well: what it is connected to so far, in the new deck's order.
  struct Connected {
    HostCellId owner;
    CellId cell;
  };
  std::map<std::string, std::vector<Connected>> connected_;
  /// By well, mesh cell and completed cell: factor and Kh.
  std::map<std::string, std::map<CellId, std::map<HostCellId, std::array<double, 2>>>> shares_;
  std::map<std::string, std::vector<HostCellId>> numbered_;  ///< completed cells in the original's order
  bool uses_numbers_ = false;                                ///< of completions, without COMPLUMP
  std::unique_ptr<HostMesh> host_;                           ///< made when a trajectory needs it
  std::unique_ptr<CellLocator> locator_;
};

std::vector<const ScheduleWell*> ScheduleConverter::need_named(const DeckTextKeyword& keyword,
                                                               const DeckTextRecord& record) const {
  std::vector<const ScheduleWell*> out = wells_.named(record.text(0), lists_);
  if (out.empty())
    RecordItems(deck_, keyword, record)
        .fail({"a well that WELSPECS has named", quoted_for_message(record.text(0)), "check the name"});
  return out;
}

void ScheduleConverter::find_numbered() {
  for (const DeckTextKeyword& keyword : deck_.keywords) {
    if (keyword.role != DeckRole::well_cells) continue;
    const std::int64_t item = cell_items(keyword.name).first_number;
    for (const DeckTextRecord& record : keyword.records)
      if (item >= 0 && (record.find(item) != nullptr || record.find(item + 1) != nullptr)) uses_numbers_ = true;
  }
}

/// Head, and a reference depth where the deck has none: the simulator would take both from the boxes.
void ScheduleConverter::convert_heads(const DeckTextKeyword& keyword) {
  std::string order;
  for (const DeckTextRecord& record : keyword.records) {
    const ScheduleWell* well = wells_.find(trimmed(record.text(0)));
    if (well == nullptr) continue;
    ItemTexts changed{{2, fmt::format("{}", wells_.head_cell(*well).value() + 1)}, {3, "1"}};
    const RecordItems items(deck_, keyword, record);
    if (!items.real(4)) {
      auto depth = wells_.default_reference_depth(*well);
      if (!depth && !well->connections.empty()) depth = mesh_.cells.depth[well->connections.front().cell];
      if (depth) changed[4] = fmt::format("{}", *depth / metre());
    }
    edits_.replace_record(keyword, record, {record_text(text_of(keyword), record, changed)}, "");
    if (!known_.insert(well->name).second) continue;
    order += fmt::format(" '{}' {} /\n", well->name, is_in_depth_order(*well) ? "DEPTH" : "INPUT");
  }
  add(keyword, "rewritten", "heads are cells of the new grid; a reference depth that was left out is written",
      static_cast<std::int64_t>(keyword.records.size()));
  if (order.empty()) return;
  edits_.insert_below(keyword, "COMPORD\n" + order + "/\n");
  report_.add({"COMPORD", "added", "connections in the order of the original, which the boxes do not have"});
}

/// Wells that later keywords complete further, and that run down: their order of depth is the simulator's own.
bool ScheduleConverter::is_in_depth_order(const ScheduleWell& well) const {
  if (well.is_meshed || well.compdat_keywords < 2) return false;
  const auto order = wells_.in_track_order(well, well.completed);
  return std::ranges::is_sorted(order, [&](HostCellId a, HostCellId b) { return cells_.depth(a) < cells_.depth(b); });
}

void ScheduleConverter::convert_completions(const DeckTextKeyword& keyword) {
  std::map<std::string, std::vector<Line>> lines;  // by well
  std::vector<std::vector<const ScheduleWell*>> wells_of_record;
  std::set<const ScheduleWell*> concerned;
  for (std::size_t r = 0; r < keyword.records.size(); ++r) {
    wells_of_record.push_back(need_named(keyword, keyword.records[r]));
    for (const ScheduleWell* well : wells_of_record.back()) {
      concerned.insert(well);
      std::vector<Line> more = lines_of(keyword, r, *well);
      std::ranges::move(more, std::back_inserter(lines[well->name]));
    }
  }
  for (const ScheduleWell* well : concerned) {
    sort_lines(*well, lines[well->name]);
    remember(*well, lines[well->name]);
  }
  for (std::size_t r = 0; r < keyword.records.size(); ++r) {
    std::vector<std::string> texts;
    for (const ScheduleWell* well : wells_of_record[r])
      for (const Line& line : lines[well->name])
        if (line.record == r) texts.push_back(line_text(keyword, *well, line));
    edits_.replace_record(keyword, keyword.records[r], texts, "dropped: no open cell of the new grid belongs to it");
    if (texts.empty()) add(keyword, "dropped", "no active cell of the new grid belongs to the record");
  }
  if (uses_numbers_) add_numbers(keyword, concerned);
}

std::vector<ScheduleConverter::Line> ScheduleConverter::lines_of(const DeckTextKeyword& keyword, std::size_t record,
                                                                 const ScheduleWell& well) {
  for (const HostCellId cell : wells_.cells_of(keyword, keyword.records[record], well)) {
    if (grid_.active[cell.index()] == 0) continue;
    auto& numbered = numbered_[well.name];
    if (std::ranges::find(numbered, cell) == numbered.end()) numbered.push_back(cell);
  }
  return well.is_meshed ? meshed_lines(keyword, record, well) : host_lines(keyword, record, well);
}

/// 2 pi Kh / CF is what the mesh's factor has as ln(r_o / r_w) + skin.
double ScheduleConverter::factor_with_skin(const RecordItems& items, const ScheduleWell& well,
                                           const MeshedConnection& connection, double skin, int item) {
  if (skin == well.skin) return connection.factor;
  const double circle = 2.0 * std::numbers::pi * connection.permeability_thickness;
  const double resistance = circle / connection.factor + skin - well.skin;
  if (!(resistance > 0.0))
    items.fail({fmt::format("a skin that leaves a resistance to flow as item {}", item), fmt::format("{}", skin),
                "the cells at the bore are too small for a skin this low: use a larger bore radius or fewer rings"});
  return circle / resistance;
}

std::vector<ScheduleConverter::Line> ScheduleConverter::meshed_lines(const DeckTextKeyword& keyword, std::size_t record,
                                                                     const ScheduleWell& well) {
  const DeckTextRecord& text = keyword.records[record];
  const RecordItems items(deck_, keyword, text);
  const auto cells = wells_.cells_of(keyword, text, well);
  const std::set<HostCellId> chosen(cells.begin(), cells.end());
  const double skin = items.real(10).value_or(0.0);
  if (items.positive(7) || items.positive(9))
    add(keyword, "replaced", fmt::format("factor or Kh of well {}: those of its mesh stand there", well.name));
  std::vector<Line> out;
  for (const MeshedConnection& c : well.connections) {
    if (!chosen.contains(c.owner)) continue;
    const ItemTexts changed{{0, fmt::format("'{}'", well.name)},
                            {1, fmt::format("{}", c.cell.value() + 1)},
                            {2, "1"},
                            {3, "1"},
                            {4, "1"},
                            {8, fmt::format("{}", 2.0 * well.bore_radius / metre())},
                            {13, "1*"}};
    out.push_back(
        {record, c.owner, c.cell, changed, factor_with_skin(items, well, c, skin, 11), c.permeability_thickness});
  }
  add(keyword, "rewritten", "wells with a mesh: a record for each cell at the bore, with factor and Kh");
  return out;
}

std::vector<ScheduleConverter::Line> ScheduleConverter::host_lines(const DeckTextKeyword& keyword, std::size_t record,
                                                                   const ScheduleWell& well) {
  const DeckTextRecord& text = keyword.records[record];
  const RecordItems items(deck_, keyword, text);
  CompletionData data;
  data.axis = completion_axis(deck_, keyword, text);
  data.diameter = items.positive(8).value_or(0.0) * metre();
  data.skin = items.real(10).value_or(0.0);
  if (const auto factor = items.positive(7)) data.factor = *factor * m3_per_transmissibility_unit(grid_.units);
  if (const auto kh = items.positive(9)) data.permeability_thickness = *kh * m2_per_millidarcy * metre();
  if (const auto radius = items.positive(13)) data.equivalent_radius = *radius * metre();
  std::vector<Line> out;
  for (const HostCellId cell : wells_.cells_of(keyword, text, well)) {
    if (grid_.active[cell.index()] == 0) continue;
    const auto shares = cells_.parts(cell);
    if (shares.empty()) continue;
    const CompletionFactor factor = completion_factor(grid_, cell, data);
    if (!(factor.factor > 0.0)) {
      add(keyword, "dropped", "a completion in a cell without permeability");
      continue;
    }
    // Shared out by volume, the well sees the mean pressure of what was one cell, as its factor supposes.
    if (!cells_.whole(cell))
      add(keyword, "rewritten", "completions in cells that were refined or replaced: shared between the cells there");
    for (const CellShare& part : shares) {
      ItemTexts changed{{0, fmt::format("'{}'", well.name)},
                        {1, fmt::format("{}", part.cell.value() + 1)},
                        {2, "1"},
                        {3, "1"},
                        {4, "1"}};
      if (data.equivalent_radius) changed[13] = "1*";
      out.push_back({record, cell, part.cell, changed, factor.factor * part.share,
                     factor.permeability_thickness * part.share,
                     data.factor && data.permeability_thickness && shares.size() == 1});
    }
  }
  add(keyword, "rewritten",
      "wells without a mesh: a record for each cell, with factor and Kh as the simulator computes them");
  return out;
}

/// Into the simulator's order for the original. Lines that leave their record's place go to the well's first one.
void ScheduleConverter::sort_lines(const ScheduleWell& well, std::vector<Line>& lines) const {
  if (lines.empty()) return;
  const std::size_t first = lines.front().record;
  std::map<HostCellId, std::size_t> rank;
  if (!well.is_meshed)
    for (const HostCellId cell : wells_.in_track_order(well, well.completed)) rank.emplace(cell, rank.size());
  std::map<CellId, std::size_t> mesh_rank;
  for (const MeshedConnection& c : well.connections) mesh_rank.emplace(c.cell, mesh_rank.size());
  const auto before = [&](const Line& a, const Line& b) {
    return well.is_meshed ? mesh_rank[a.cell] < mesh_rank[b.cell] : rank[a.owner] < rank[b.owner];
  };
  if (std::ranges::is_sorted(lines, before)) return;
  std::stable_sort(lines.begin(), lines.end(), before);
  for (Line& line : lines) line.record = first;
}

/// A cell that several completed cells share has the sum of what they give it: a later record replaces an earlier one.
std::string ScheduleConverter::line_text(const DeckTextKeyword& keyword, const ScheduleWell& well, const Line& line) {
  ItemTexts changed = line.items;
  const auto& shares = shares_[well.name][line.cell];
  if (!line.is_stated || shares.size() > 1) {
    double factor = 0.0;
    double kh = 0.0;
    for (const auto& [owner, share] : shares) {
      factor += share[0];
      kh += share[1];
    }
    changed[7] = factor_text(factor);
    changed[9] = thickness_text(kh);
  }
  return record_text(text_of(keyword), keyword.records[line.record_of_items], changed);
}

void ScheduleConverter::remember(const ScheduleWell& well, const std::vector<Line>& lines) {
  auto& connected = connected_[well.name];
  for (const Line& line : lines) {
    shares_[well.name][line.cell][line.owner] = {line.factor, line.permeability_thickness};
    const auto same = [&](const Connected& known) { return known.owner == line.owner && known.cell == line.cell; };
    if (std::ranges::none_of(connected, same)) connected.push_back({line.owner, line.cell});
  }
}

/// Completions keep their numbers where the deck calls them by number.
void ScheduleConverter::add_numbers(const DeckTextKeyword& keyword, const std::set<const ScheduleWell*>& wells) {
  std::string text;
  for (const ScheduleWell& well : wells_.all()) {
    if (!wells.contains(&well)) continue;
    const auto& numbered = numbered_[well.name];
    for (const Connected& c : connected_[well.name]) {
      const auto number = std::ranges::find(numbered, c.owner) - numbered.begin() + 1;
      text += fmt::format(" '{}' {} 1 1 1 {} /\n", well.name, c.cell.value() + 1, number);
    }
  }
  if (text.empty()) return;
  edits_.insert_below(keyword, "COMPLUMP\n" + text + "/\n");
  report_.add({"COMPLUMP", "added", "completions keep the numbers that the deck calls them by"});
}

std::vector<CellId> ScheduleConverter::cells_in(const ScheduleWell& well, HostCellId source) const {
  std::vector<CellId> out;
  const auto connected = connected_.find(well.name);
  if (connected == connected_.end()) return out;
  for (const Connected& c : connected->second)
    if (c.owner == source) out.push_back(c.cell);
  return out;
}

CellFilter ScheduleConverter::filter_of(const RecordItems& items, const CellItems& at) const {
  return {items.cell_index(at.i, 0), items.cell_index(at.j, 1), items.cell_index(at.k, 2),
          items.cell_index(at.k_last, 2)};
}

void ScheduleConverter::convert_well_cells(const DeckTextKeyword& keyword) {
  const CellItems at = cell_items(keyword.name);
  for (const DeckTextRecord& record : keyword.records) {
    const RecordItems items(deck_, keyword, record);
    const CellFilter filter = filter_of(items, at);
    if (filter.is_any()) continue;
    std::vector<std::string> texts;
    for (const ScheduleWell* well : need_named(keyword, record)) {
      if (well->has_trajectory)
        items.fail({"connections of a well with COMPTRAJ without their cells", "a cell",
                    "choose the whole well, or complete it with COMPDAT"});
      std::set<CellId> done;
      for (const Connected& c : connected_[well->name]) {
        if (!filter.fits(grid_.ijk(c.owner)) || !done.insert(c.cell).second) continue;
        ItemTexts changed{{0, fmt::format("'{}'", well->name)},
                          {at.i, fmt::format("{}", c.cell.value() + 1)},
                          {at.j, "1"},
                          {at.k, "1"},
                          {at.k_last, "1"}};
        texts.push_back(record_text(text_of(keyword), record, changed));
      }
    }
    edits_.replace_record(keyword, record, texts, "dropped: the well has no open cell there");
    add(keyword, texts.empty() ? "dropped" : "rewritten",
        texts.empty() ? "the well has no open cell there" : "a record for each cell of the new grid");
  }
}

void ScheduleConverter::convert_segments(const DeckTextKeyword& keyword) {
  if (keyword.records.empty()) return;
  const auto named = need_named(keyword, keyword.records.front());
  const ScheduleWell& well = *named.front();
  for (std::size_t r = 1; r < keyword.records.size(); ++r) {
    const DeckTextRecord& record = keyword.records[r];
    const RecordItems items(deck_, keyword, record);
    std::array<std::int64_t, 3> ijk{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto index = items.cell_index(static_cast<std::int64_t>(axis), axis);
      if (!index) items.fail({"I, J and K of a cell", "less", ""});
      ijk[axis] = *index;
    }
    if (items.integer(7))
      items.fail({"one cell a record", "a range of cells (item 8)", "write a record for each cell of the range"});
    std::vector<std::string> texts;
    for (const CellId cell : cells_in(well, grid_.cell_id(ijk[0], ijk[1], ijk[2])))
      texts.push_back(
          record_text(text_of(keyword), record, {{0, fmt::format("{}", cell.value() + 1)}, {1, "1"}, {2, "1"}}));
    edits_.replace_record(keyword, record, texts, "dropped: the well has no open cell there");
    add(keyword, texts.empty() ? "dropped" : "rewritten",
        texts.empty() ? "the well has no open cell there" : "a record for each cell of the new grid");
  }
}

std::vector<HostWellConnection> ScheduleConverter::host_perforations(const Well& well) {
  if (!host_) host_ = std::make_unique<HostMesh>(build_host_mesh(grid_));
  if (!locator_) locator_ = std::make_unique<CellLocator>(grid_);
  return peaceman_indices(grid_, *host_, well, cells_along(grid_, *locator_, well.trajectory));
}

std::vector<std::string> ScheduleConverter::perforation_lines(const DeckTextKeyword& keyword,
                                                              const DeckTextRecord& record, const ScheduleWell& well) {
  const RecordItems items(deck_, keyword, record);
  const auto from = items.real(2);
  const auto to = items.real(3);
  if (!from || !to || !(*from < *to)) throw std::logic_error("COMPTRAJ without a stretch passed the reader");
  if (items.word(4, "MD") != "MD")
    items.fail({"MD as item 5", quoted_for_message(record.text(4)), "state the stretch in measured depth"});
  if (items.positive(8))
    items.fail(
        {"a default as item 9", "a factor of the whole stretch", "leave it out: wellknit computes factors by cell"});
  const MeasuredDepthRange range{*from * metre(), *to * metre()};
  const double skin = items.real(11).value_or(0.0);
  const std::string state = items.word(6, "OPEN");
  const std::string table = record.find(7) == nullptr ? "1*" : std::string(record.text(7));
  std::vector<std::string> out;
  const auto line = [&](CellId cell, double factor, double kh, double radius) {
    out.push_back(fmt::format("'{}' {} 1 1 1 {} {} {} {} {} {} 1* Z", well.name, cell.value() + 1, state, table,
                              factor_text(factor), 2.0 * radius / metre(), thickness_text(kh), skin));
    connected_[well.name].push_back({HostCellId(), cell});
  };
  if (well.is_meshed) {
    for (const MeshedConnection& c : well.connections) {
      const double middle = 0.5 * (c.measured_depth.from + c.measured_depth.to);
      if (middle >= range.from && middle < range.to)
        line(c.cell, factor_with_skin(items, well, c, skin, 12), c.permeability_thickness, well.bore_radius);
    }
    return out;
  }
  for (Well path : source_.deck_wells) {
    if (!equal_ignoring_case(path.parent.empty() ? path.name : path.parent, well.name)) continue;
    if (path.branch != items.integer(1).value_or(1)) continue;
    path.open = {range};
    path.skin = skin;
    if (const auto diameter = items.positive(9)) path.radial.bore_radius = 0.5 * *diameter * metre();
    for (const HostWellConnection& c : host_perforations(path))
      for (const CellShare& part : cells_.parts(c.cell))
        line(part.cell, c.well_index * part.share, c.well_index * part.share / (2.0 * std::numbers::pi),
             path.radial.bore_radius);
  }
  return out;
}

/// COMPTRAJ becomes the COMPDAT of the path's cells.
void ScheduleConverter::convert_perforations(const DeckTextKeyword& keyword) {
  std::string text = "COMPDAT\n";
  for (const DeckTextRecord& record : keyword.records)
    for (const ScheduleWell* well : need_named(keyword, record))
      for (const std::string& line : perforation_lines(keyword, record, *well)) text += " " + line + " /\n";
  edits_.replace(keyword, text + "/");
  add(keyword, "replaced", "by COMPDAT of the cells along the path", static_cast<std::int64_t>(keyword.records.size()));
}

}  // namespace

std::int64_t convert_schedule(const WholeDeck& deck, const Case& source, const Mesh& mesh, ScheduleWells& wells,
                              const SourceCells& cells, DeckEdits& edits, ConversionReport& report) {
  return ScheduleConverter(deck, source, mesh, wells, cells, edits, report).convert();
}

}  // namespace wellknit
