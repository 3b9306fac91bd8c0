// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/grid_validity.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace wellknit {

namespace {

using Json = nlohmann::ordered_json;

struct Words {
  std::string_view name;
  std::string_view unit;
  std::string_view what;  ///< before ": 3"
  std::string_view done;
  std::string_view advice;
};

/// By GridOddity.
constexpr std::array<Words, grid_oddity_count> words{{
    {"reversed_corners", "m", "cells with corners in reverse order", "given no thickness there",
     "set their base to their top in ZCORN, or make them inactive"},
    {"negative_volume", "m3", "cells with thickness but no positive volume", "left out",
     "check COORD and ZCORN there, or make them inactive"},
    {"self_overlapping", "", "cells that overlap themselves",
     "kept as they are: their faces close, and pass through each other",
     "move the pillars apart in COORD, or make them inactive"},
    {"twisted", "", "twisted or concave cells", "kept as they are: their volume is that of their corners",
     "move their pillars in COORD where the volume near a corner matters"},
    {"overlapping", "m", "cells that begin above the base over them", "cut off there",
     "set their top to that base in ZCORN"},
    {"gap", "m", "cells below a gap in their column", "the gap is kept; connected across it as PINCH allows",
     "set their top to the base over it in ZCORN where no gap is meant, or item 3 of PINCH where it is a barrier"},
    {"crossing_pillars", "degrees", "pairs of pillars that cross where cells stand on them", "kept as they are",
     "move them apart in COORD, or shorten the cells there"},
}};

const Words& words_of(GridOddity kind) { return words[static_cast<std::size_t>(kind)]; }

std::string counted_from_1(const std::array<std::int64_t, 3>& at) {
  return at[2] < 0 ? fmt::format("({}, {})", at[0] + 1, at[1] + 1)
                   : fmt::format("({}, {}, {})", at[0] + 1, at[1] + 1, at[2] + 1);
}

std::string place_text(GridOddity kind, const OddPlace& place) {
  if (kind == GridOddity::crossing_pillars) return counted_from_1(place.cell) + "-" + counted_from_1(place.other);
  return counted_from_1(place.cell);
}

std::string figure_text(GridOddity kind, double figure) {
  const std::string_view unit = unit_of(kind);
  return unit.empty() ? fmt::format("scaled Jacobian {:.3g}", figure) : fmt::format("{:.3g} {}", figure, unit);
}

std::string line_of(GridOddity kind, const OddPlaces& places) {
  std::string text = fmt::format("{}: {}", words_of(kind).what, places.count);
  if (kind == GridOddity::gap) text += fmt::format(", {:.4g} m2 in plan", places.area);
  text += fmt::format(" ({}); worst {}: {}", words_of(kind).done, place_text(kind, places.worst),
                      figure_text(kind, places.worst.figure));
  if (places.count > 1) {
    // Enough to look at on a terminal line; JSON has up to 10.
    constexpr std::size_t shown = 3;
    text += "; first";
    for (std::size_t n = 0; n < std::min(shown, places.first.size()); ++n)
      text += " " + place_text(kind, places.first[n]);
  }
  return text + fmt::format("; {}", words_of(kind).advice);
}

Json place_json(const std::array<std::int64_t, 3>& at) {
  if (at == no_place) return nullptr;
  Json out = Json::array({at[0] + 1, at[1] + 1});
  if (at[2] >= 0) out.push_back(at[2] + 1);
  return out;
}

Json json_of(const OddPlace& place) {
  return {{"cell", place_json(place.cell)}, {"other", place_json(place.other)}, {"figure", place.figure}};
}

}  // namespace

bool GridValidity::empty() const {
  return std::all_of(kinds.begin(), kinds.end(), [](const OddPlaces& places) { return places.count == 0; });
}

std::string_view name_of(GridOddity kind) { return words_of(kind).name; }
std::string_view unit_of(GridOddity kind) { return words_of(kind).unit; }
std::string_view treatment_of(GridOddity kind) { return words_of(kind).done; }
std::string_view advice_on(GridOddity kind) { return words_of(kind).advice; }

std::vector<std::string> to_lines(const GridValidity& validity) {
  std::vector<std::string> lines;
  for (std::size_t n = 0; n < grid_oddity_count; ++n)
    if (validity.kinds[n].count > 0) lines.push_back(line_of(static_cast<GridOddity>(n), validity.kinds[n]));
  return lines;
}

std::string to_json(const GridValidity& validity) {
  Json out = Json::object();
  for (std::size_t n = 0; n < grid_oddity_count; ++n) {
    const auto kind = static_cast<GridOddity>(n);
    const OddPlaces& places = validity.kinds[n];
    if (places.count == 0) continue;
    Json entry{{"count", places.count},
               {"unit", unit_of(kind)},
               {"done", treatment_of(kind)},
               {"advice", advice_on(kind)},
               {"worst", json_of(places.worst)}};
    if (kind == GridOddity::gap) entry["area"] = places.area;
    entry["first"] = Json::array();
    for (const OddPlace& place : places.first) entry["first"].push_back(json_of(place));
    out[std::string(name_of(kind))] = std::move(entry);
  }
  if (validity.open_fault_faces) out["open_fault_faces"] = *validity.open_fault_faces;
  return out.dump();
}

}  // namespace wellknit
