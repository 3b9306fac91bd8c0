// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The first seed of tests with random cases. The same at every run, so that a change is judged by what it changes;
/// WELLKNIT_SEED sets another one, and WELLKNIT_SEED=fresh takes a new one each time. It is printed.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string_view>

namespace wellknit {

inline std::uint32_t random_seed() {
  const char* const asked = std::getenv("WELLKNIT_SEED");
  std::uint32_t seed = 20'000'001;
  if (asked != nullptr)
    seed = std::string_view(asked) == "fresh" ? std::random_device{}()
                                              : static_cast<std::uint32_t>(std::strtoul(asked, nullptr, 10));
  std::cout << "seed " << seed << '\n';
  return seed;
}

}  // namespace wellknit
