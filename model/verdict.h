// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The five figures that decide whether a mesh is good enough: the four finite-volume conditions at the faces of made
/// cells (of host cells where nothing was made) and the conservation of pore volume. What each threshold is taken from:
/// docs/commands/check.md.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/quality.h"

namespace wellknit {

enum class Grade : std::uint8_t { good, watch, poor };
std::string_view name_of(Grade grade);

struct KeyFigure {
  std::string figure;  ///< its name among figures()
  std::string title;   ///< for a heading
  std::string unit;    ///< "°" or empty
  double value = 0.0;
  double watch = 0.0;  ///< above it: look at the worst cells
  double poor = 0.0;   ///< above it: do not compute with it unseen
  Grade grade = Grade::good;
  std::string meaning;  ///< one sentence
  std::string advice;   ///< what to do about it; empty when it is good
};

/// In the order of the conditions. A limit on one of these figures takes the place of its `poor`.
/// Pore volume is left out where the source's is not known.
std::vector<KeyFigure> key_figures(const QualityReport& report, const std::vector<Limit>& limits);

/// The figure that lies farthest beyond its thresholds; null when all are good.
const KeyFigure* worst_of(const std::vector<KeyFigure>& figures);

}  // namespace wellknit
