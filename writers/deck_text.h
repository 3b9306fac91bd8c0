// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Text of an Eclipse deck: arrays with repeat counts, lines of at most 128 characters, names that fit.
#pragma once

#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wellknit {

/// The keyword, the numbers with the digits that give the very same doubles back, equal neighbours as n*v, and the
/// slash.
void write_deck_array(std::ostream& out, std::string_view keyword, std::span<const double> values);

/// `-- text`, cut so that the line fits; control characters become '?'.
void write_deck_comment(std::ostream& out, std::string_view text);

/// Well names that a deck can have, one for each given: letters, digits, '-' and '_', a letter first, at most 8
/// characters, no two equal even without regard to case. A name that fits already stays as it is.
std::vector<std::string> deck_well_names(const std::vector<std::string>& names);

}  // namespace wellknit
