// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The page's style and scripts (report/assets), as the build put them into the program.
#pragma once

#include <string_view>

namespace wellknit {

/// Empty for a name that there is not.
std::string_view report_asset(std::string_view name);

}  // namespace wellknit
