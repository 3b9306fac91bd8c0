// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "conversion/summary_conversion.h"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "conversion/record_text.h"
#include "readers/text.h"

namespace wellknit {

namespace {

constexpr const char* is_made = "the cell is no longer one cell of the grid";

class SummaryConverter {
 public:
  SummaryConverter(const WholeDeck& deck, const CornerPointGrid& grid, const SourceCells& cells,
                   const std::function<bool(std::string_view)>& is_meshed, DeckEdits& edits, ConversionReport& report)
      : deck_(deck), grid_(grid), cells_(cells), is_meshed_(is_meshed), edits_(edits), report_(report) {}

  void convert(const DeckTextKeyword& keyword) {
    if (keyword.role == DeckRole::neighbour_summary) {
      drop(keyword, "pressures of cells beside the well's, which a list of connections does not have");
      return;
    }
    const std::int64_t first_item = keyword.role == DeckRole::cell_summary ? 0 : 1;
    std::vector<std::optional<std::string>> texts;
    bool keeps_any = keyword.records.empty();
    for (const DeckTextRecord& record : keyword.records) {
      texts.push_back(converted(keyword, record, first_item));
      keeps_any = keeps_any || texts.back();
    }
    if (!keeps_any) {
      drop(keyword, is_made);
      return;
    }
    for (std::size_t n = 0; n < texts.size(); ++n) {
      const DeckTextRecord& record = keyword.records[n];
      if (texts[n])
        edits_.replace_record(keyword, record, {*texts[n]}, "");
      else
        edits_.replace_record(keyword, record, {}, fmt::format("dropped: {}", is_made));
      add(keyword, texts[n] ? "rewritten" : "dropped", texts[n] ? "cells have their new numbers" : is_made);
    }
  }

 private:
  void add(const DeckTextKeyword& keyword, const char* action, const char* detail) {
    report_.add({keyword.name, action, detail, deck_.files[keyword.file].name, keyword.line});
  }

  void drop(const DeckTextKeyword& keyword, const char* why) {
    edits_.replace(keyword, fmt::format("-- {} dropped: {}", keyword.name, why));
    add(keyword, "dropped", why);
  }

  std::optional<std::string> converted(const DeckTextKeyword& keyword, const DeckTextRecord& record,
                                       std::int64_t first_item) {
    const std::string_view text = deck_.files[keyword.file].content.text;
    const RecordItems items(deck_, keyword, record);
    std::array<std::optional<std::int64_t>, 3> ijk;
    for (std::size_t axis = 0; axis < 3; ++axis)
      ijk[axis] = items.cell_index(first_item + static_cast<std::int64_t>(axis), axis);
    // All connections of the well.
    if (first_item == 1 && !ijk[0] && !ijk[1] && !ijk[2]) return record_text(text, record, {});
    if (!ijk[0] || !ijk[1] || !ijk[2]) items.fail({"I, J and K of a cell", "less", ""});
    if (first_item == 1 && is_meshed_(trimmed(record.text(0)))) return std::nullopt;
    const auto cell = cells_.whole(grid_.cell_id(*ijk[0], *ijk[1], *ijk[2]));
    if (!cell) return std::nullopt;
    return record_text(
        text, record,
        {{first_item, fmt::format("{}", cell->value() + 1)}, {first_item + 1, "1"}, {first_item + 2, "1"}});
  }

  const WholeDeck& deck_;
  const CornerPointGrid& grid_;
  const SourceCells& cells_;
  const std::function<bool(std::string_view)>& is_meshed_;
  DeckEdits& edits_;
  ConversionReport& report_;
};

}  // namespace

void convert_summary(const WholeDeck& deck, const CornerPointGrid& grid, const SourceCells& cells,
                     const std::function<bool(std::string_view)>& is_meshed, DeckEdits& edits,
                     ConversionReport& report) {
  SummaryConverter converter(deck, grid, cells, is_meshed, edits, report);
  for (const DeckTextKeyword& keyword : deck.keywords)
    if (keyword.role == DeckRole::cell_summary || keyword.role == DeckRole::connection_summary ||
        keyword.role == DeckRole::neighbour_summary)
      converter.convert(keyword);
}

}  // namespace wellknit
