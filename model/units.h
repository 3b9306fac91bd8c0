// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Conversion factors to SI. Inside the library everything is SI; only readers and writers use these.
#pragma once

#include <string_view>

namespace wellknit {

inline constexpr double metre_per_foot = 0.3048;               ///< exact
inline constexpr double m2_per_darcy = 9.869232667160130e-13;  ///< 1 cP cm2 / (s atm), atm = 101325 Pa
inline constexpr double m2_per_millidarcy = m2_per_darcy * 1e-3;
inline constexpr double pascal_per_bar = 1e5;                 ///< exact
inline constexpr double pascal_per_psi = 6894.757293168361;   ///< 0.45359237 kg * 9.80665 m/s2 / (0.0254 m)^2
inline constexpr double pascal_second_per_centipoise = 1e-3;  ///< exact
inline constexpr double second_per_day = 86400.0;             ///< exact
inline constexpr double m3_per_barrel = 0.158987294928;       ///< 42 * 231 in3, exact

/// Unit system of an Eclipse deck.
enum class UnitSystem { metric, field, lab };

/// Length of one deck unit in metres (metric 1, field 0.3048, lab 0.01).
constexpr double metre_per_length_unit(UnitSystem units) {
  switch (units) {
    case UnitSystem::field: return metre_per_foot;
    case UnitSystem::lab: return 0.01;
    case UnitSystem::metric: break;
  }
  return 1.0;
}

/// Transmissibility: m3 (permeability * area / length) in one deck unit:
/// metric cP rm3 / (day bar), field cP rb / (day psi), lab cP rcc / (hr atm).
constexpr double m3_per_transmissibility_unit(UnitSystem units) {
  constexpr double cp = pascal_second_per_centipoise;
  switch (units) {
    case UnitSystem::field: return cp * m3_per_barrel / (second_per_day * pascal_per_psi);
    case UnitSystem::lab: return cp * 1e-6 / (3600.0 * 101325.0);
    case UnitSystem::metric: break;
  }
  return cp / (second_per_day * pascal_per_bar);
}

/// Reservoir volume: m3 in one deck unit (metric rm3, field rb, lab rcc).
constexpr double m3_per_reservoir_volume_unit(UnitSystem units) {
  switch (units) {
    case UnitSystem::field: return m3_per_barrel;
    case UnitSystem::lab: return 1e-6;
    case UnitSystem::metric: break;
  }
  return 1.0;
}

constexpr std::string_view name_of(UnitSystem units) {
  switch (units) {
    case UnitSystem::field: return "FIELD";
    case UnitSystem::lab: return "LAB";
    case UnitSystem::metric: break;
  }
  return "METRIC";
}

}  // namespace wellknit
