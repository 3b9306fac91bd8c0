// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/quantity.h"

#include <fmt/format.h>

#include <array>

#include "cli/usage_error.h"
#include "model/units.h"
#include "readers/text.h"

namespace wellknit {

namespace {

struct Unit {
  std::string_view name;
  Quantity::Kind kind;
  double si;
};

constexpr auto pressure = Quantity::Kind::pressure;
constexpr auto rate = Quantity::Kind::rate;

constexpr std::array units{
    Unit{"bar", pressure, pascal_per_bar},
    Unit{"Pa", pressure, 1.0},
    Unit{"kPa", pressure, 1e3},
    Unit{"MPa", pressure, 1e6},
    Unit{"psi", pressure, pascal_per_psi},
    Unit{"atm", pressure, 101325.0},
    Unit{"m3/d", rate, 1.0 / second_per_day},
    Unit{"m3/day", rate, 1.0 / second_per_day},
    Unit{"m3/s", rate, 1.0},
    Unit{"l/min", rate, 1e-3 / 60.0},
    Unit{"bbl/d", rate, m3_per_barrel / second_per_day},
    Unit{"bbl/day", rate, m3_per_barrel / second_per_day},
};

const Unit* unit_named(std::string_view name) {
  for (const Unit& unit : units)
    if (equal_ignoring_case(unit.name, name)) return &unit;
  return nullptr;
}

struct Parts {
  double number = 0.0;
  std::string_view unit;
};

std::optional<Parts> split(std::string_view text) {
  text = trimmed(text);
  for (std::size_t length = text.size(); length > 0; --length)
    if (const auto number = parse_real(text.substr(0, length))) return Parts{*number, trimmed(text.substr(length))};
  return std::nullopt;
}

double parse(const std::string& text, const std::string& option, Quantity::Kind kind, double si_alone,
             std::string_view expected) {
  const auto parts = split(text);
  const Unit* unit = parts ? unit_named(parts->unit) : nullptr;
  if (parts && parts->unit.empty()) return parts->number * si_alone;
  if (unit == nullptr || unit->kind != kind)
    throw UsageError(fmt::format("{}: expected a number and {}, found '{}'", option, expected, text));
  return parts->number * unit->si;
}

}  // namespace

std::optional<Quantity> parse_quantity(std::string_view text) {
  const auto parts = split(text);
  if (!parts) return std::nullopt;
  if (parts->unit.empty()) return Quantity{pressure, parts->number * pascal_per_bar};
  const Unit* unit = unit_named(parts->unit);
  if (unit == nullptr) return std::nullopt;
  return Quantity{unit->kind, parts->number * unit->si};
}

double parse_pressure(const std::string& text, const std::string& option) {
  return parse(text, option, pressure, pascal_per_bar, pressure_units);
}

double parse_rate(const std::string& text, const std::string& option) {
  return parse(text, option, rate, 1.0 / second_per_day, rate_units);
}

}  // namespace wellknit
