// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/unapplied.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace wellknit {

namespace {

struct Unapplied {
  std::string_view keyword;
  std::string_view to;
};

/// Carried with the grid. A line goes when the mesh follows what its keyword says.
constexpr auto carried = std::to_array<Unapplied>({
    {"DEPTH", "depths"},
});

/// Applied, without effect by themselves, or refused when all is read.
constexpr auto applied = std::to_array<std::string_view>(
    {"FAULTS", "PINCH",   "PINCHOUT", "NEWTRAN",  "MULTX",   "MULTX-",   "MULTY",   "MULTY-",   "MULTZ",
     "MULTZ-", "MULTFLT", "MULTREGT", "NNC",      "OLDTRAN", "OLDTRANR", "EDITNNC", "EDITNNCR", "TRANX",
     "TRANY",  "TRANZ",   "MULTPV",   "MULTREGP", "PORV",    "MINPV",    "MINPORV", "MINPVV"});

}  // namespace

void note_not_applied(DeckStream& stream, const std::string& keyword, std::int64_t line) {
  if (std::find(applied.begin(), applied.end(), keyword) != applied.end()) return;
  const auto found =
      std::find_if(carried.begin(), carried.end(), [&](const Unapplied& entry) { return entry.keyword == keyword; });
  const std::string text = found == carried.end()
                               ? fmt::format("{} is not applied yet", keyword)
                               : fmt::format("{} is read, and not applied to {} yet", keyword, found->to);
  stream.note_once(keyword, line, text);
}

}  // namespace wellknit
