// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Numbers with units on the command line.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace wellknit {

struct Quantity {
  enum class Kind { pressure, rate };
  Kind kind = Kind::pressure;
  double value = 0.0;  ///< Pa or m3/s
};

/// "200bar", "3000psi", "-500m3/d"; a number alone is a pressure in bar. Nothing when it is neither.
std::optional<Quantity> parse_quantity(std::string_view text);

/// As above, of this kind; a number alone is in bar or m3/d. Throws UsageError that names the option.
double parse_pressure(const std::string& text, const std::string& option);
double parse_rate(const std::string& text, const std::string& option);

/// Units that are taken, for messages.
inline constexpr std::string_view pressure_units = "bar, Pa, kPa, MPa, psi or atm";
inline constexpr std::string_view rate_units = "m3/d, m3/s, l/min or bbl/d";

}  // namespace wellknit
