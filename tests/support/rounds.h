// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// How many cases a test tries. Sanitizers make this code some fifty times slower: under them a tenth is tried.
#pragma once

namespace wellknit {

#ifdef WELLKNIT_FEW_ROUNDS
inline constexpr bool has_few_rounds = true;
#else
inline constexpr bool has_few_rounds = false;
#endif

template <class Count>
constexpr Count rounds(Count all) {
  return has_few_rounds ? all / 10 : all;
}

}  // namespace wellknit
