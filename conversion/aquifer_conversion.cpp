// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "conversion/aquifer_conversion.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <utility>

#include "conversion/record_text.h"
#include "model/units.h"
#include "readers/text.h"

namespace wellknit {

namespace {

struct Face {
  std::size_t axis = 0;
  bool low = false;  ///< towards smaller i, j or k
};

std::optional<Face> face_of(const std::string& word) {
  if (word.empty() || word.size() > 2 || (word.size() == 2 && word[1] != '-' && word[1] != '+')) return std::nullopt;
  std::size_t axis = std::string_view("IJK").find(word[0]);
  if (axis == std::string_view::npos) axis = std::string_view("XYZ").find(word[0]);
  if (axis == std::string_view::npos) return std::nullopt;
  return Face{axis, word.size() == 2 && word[1] == '-'};
}

/// m2
double area_of(const CornerPointGrid& grid, HostCellId cell, const Face& face) {
  const auto corners = grid.corners(cell);
  std::array<Vec3, 4> p;
  std::size_t count = 0;
  for (std::size_t corner = 0; corner < 8; ++corner)
    if (((corner >> face.axis) & 1U) == (face.low ? 0U : 1U)) p[count++] = corners[corner];
  // The four stand as rows of a square; its diagonals give the area vector.
  return 0.5 * (p[3] - p[0]).cross(p[2] - p[1]).norm();
}

/// Nothing active lies behind the face.
bool is_outer(const CornerPointGrid& grid, HostCellId cell, const Face& face) {
  auto ijk = grid.ijk(cell);
  ijk[face.axis] += face.low ? -1 : 1;
  if (ijk[face.axis] < 0 || ijk[face.axis] >= grid.dimensions[face.axis]) return true;
  return grid.active[grid.cell_id(ijk[0], ijk[1], ijk[2]).index()] == 0;
}

/// Coefficient, deck units, by aquifer and mesh cell.
using Coefficients = std::map<std::pair<std::int64_t, CellId>, double>;

void add_record(const WholeDeck& deck, const DeckTextKeyword& keyword, const DeckTextRecord& record,
                const CornerPointGrid& grid, const SourceCells& cells, Coefficients& sum) {
  const RecordItems items(deck, keyword, record);
  const auto aquifer = items.integer(0);
  const auto face = face_of(items.word(7, ""));
  if (!aquifer || !face)
    items.fail({"the number of an aquifer as item 1 and a face (I-, I+, J- …) as item 8",
                quoted_for_message(record.text(aquifer ? 7 : 0)), ""});
  std::array<std::array<std::int64_t, 2>, 3> box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto item = static_cast<std::int64_t>(1 + 2 * axis);
    box[axis] = {items.cell_index(item, axis).value_or(0),
                 items.cell_index(item + 1, axis).value_or(grid.dimensions[axis] - 1)};
  }
  const double metre = metre_per_length_unit(grid.units);
  const double multiplier = items.real(9).value_or(1.0);
  const bool adjoins = items.word(10, "NO") == "YES";
  for (std::int64_t k = box[2][0]; k <= box[2][1]; ++k)
    for (std::int64_t j = box[1][0]; j <= box[1][1]; ++j)
      for (std::int64_t i = box[0][0]; i <= box[0][1]; ++i) {
        const HostCellId cell = grid.cell_id(i, j, k);
        if (grid.active[cell.index()] == 0 || (!adjoins && !is_outer(grid, cell, *face))) continue;
        const double value = items.real(8).value_or(area_of(grid, cell, *face) / (metre * metre)) * multiplier;
        for (const CellShare& part : cells.parts(cell)) sum[{*aquifer, part.cell}] += value * part.share;
      }
}

std::string text_of(const Coefficients& sum) {
  std::string text = "AQUANCON\n";
  // Cells of a row always have a free face across it.
  for (const auto& [key, value] : sum)
    text +=
        fmt::format(" {} {} {} 1 1 1 1 'J-' {} /\n", key.first, key.second.value() + 1, key.second.value() + 1, value);
  return text + "/";
}

}  // namespace

std::string convert_aquifers(const WholeDeck& deck, const CornerPointGrid& grid, const SourceCells& cells,
                             DeckEdits& edits, ConversionReport& report) {
  std::string of_grid;
  for (const DeckTextKeyword& keyword : deck.keywords) {
    if (keyword.role != DeckRole::aquifer_cells) continue;
    Coefficients sum;
    for (const DeckTextRecord& record : keyword.records) add_record(deck, keyword, record, grid, cells, sum);
    const std::string text = text_of(sum);
    if (keyword.section == DeckSection::solution)
      edits.replace(keyword, text);
    else
      of_grid += text + "\n";
    report.add({keyword.name, "rewritten", fmt::format("{} cells with explicit coefficients", sum.size()),
                deck.files[keyword.file].name, keyword.line, static_cast<std::int64_t>(keyword.records.size())});
  }
  return of_grid;
}

}  // namespace wellknit
