// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/unfinished_outputs.h"

#include <filesystem>
#include <set>

namespace wellknit {

namespace {

struct Registry {
  std::recursive_mutex mutex;
  std::set<std::string> temporaries;
};

/// Never destroyed: a thread that ends the program may still use it while main() returns.
Registry& registry() {
  static auto* const only = new Registry;
  return *only;
}

}  // namespace

std::unique_lock<std::recursive_mutex> hold_unfinished_outputs() { return std::unique_lock(registry().mutex); }

void add_unfinished_output(const std::string& temporary) {
  const auto hold = hold_unfinished_outputs();
  registry().temporaries.insert(temporary);
}

void forget_unfinished_output(const std::string& temporary) {
  const auto hold = hold_unfinished_outputs();
  registry().temporaries.erase(temporary);
}

void remove_unfinished_outputs() noexcept {
  hold_unfinished_outputs().release();
  std::error_code ignored;  // nothing more can be done about what cannot be removed
  for (const std::string& temporary : registry().temporaries) {
    // Another thread may go on making files in a folder until the program ends.
    for (int attempt = 0; attempt < 10 && std::filesystem::exists(temporary, ignored); ++attempt)
      std::filesystem::remove_all(temporary, ignored);
  }
}

}  // namespace wellknit
