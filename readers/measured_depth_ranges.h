// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Sets of measured depths as ranges in rising order that neither meet nor overlap.
#pragma once

#include <vector>

#include "model/well.h"

namespace wellknit {

using MeasuredDepthRanges = std::vector<MeasuredDepthRange>;

/// The set without this range; a range of no length changes nothing.
MeasuredDepthRanges without(const MeasuredDepthRanges& set, const MeasuredDepthRange& range);

/// The set with this range.
MeasuredDepthRanges with(const MeasuredDepthRanges& set, const MeasuredDepthRange& range);

}  // namespace wellknit
