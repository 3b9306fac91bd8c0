// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Ids have 32 bits (model/ids.h): what is to be numbered is counted first.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string_view>

#include "model/errors.h"
#include "model/ids.h"

namespace wellknit {

/// Throws InvalidInput where there are more than max_ids; `what` names them, in the plural.
inline void require_ids(std::size_t count, std::string_view what) {
  if (count > static_cast<std::size_t>(max_ids))
    throw InvalidInput(
        fmt::format("the grid has {} {}, and {} can be numbered; check ZCORN, or refine less", count, what, max_ids));
}

}  // namespace wellknit
