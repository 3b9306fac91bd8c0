// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Distributions as inline SVG: small bars that take their colours from the page's style.
#pragma once

#include <string>
#include <string_view>

#include "model/quality.h"

namespace wellknit {

/// The class of style that gives a pair of cell kinds its colour.
std::string_view style_of(FacePair pair);

/// Bars: share of the area in each class; a line over them: share of the flow, where it is known. The bars' height is
/// relative to the highest. Classes beyond the measure's reference are marked.
std::string histogram(FaceMeasure measure, const Distribution& values, FacePair pair);

/// The classes' lower ends, of the same width as histogram().
std::string histogram_axis(FaceMeasure measure);

}  // namespace wellknit
