// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What the conversion of a deck did, keyword by keyword.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace wellknit {

/// One kind of change; those of one keyword, action and reason are counted together.
struct ConversionEntry {
  std::string keyword;
  std::string action;     ///< "replaced", "rewritten", "transferred", "dropped", "added", "copied"
  std::string detail;     ///< what, and why
  std::string file = {};  ///< of the first one; empty for what the deck did not have
  std::int64_t line = 0;
  std::int64_t count = 1;  ///< records, or keywords
};

struct ConversionReport {
  std::vector<ConversionEntry> entries;  ///< in the deck's order
  std::vector<std::string> notes;        ///< what the deck's user must know, a sentence each

  void add(ConversionEntry entry) {
    for (ConversionEntry& known : entries) {
      if (known.keyword != entry.keyword || known.action != entry.action || known.detail != entry.detail) continue;
      known.count += entry.count;
      return;
    }
    entries.push_back(std::move(entry));
  }
};

}  // namespace wellknit
