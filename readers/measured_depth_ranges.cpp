// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/measured_depth_ranges.h"

#include <algorithm>

namespace wellknit {

MeasuredDepthRanges without(const MeasuredDepthRanges& set, const MeasuredDepthRange& range) {
  if (range.to <= range.from) return set;
  MeasuredDepthRanges out;
  for (const MeasuredDepthRange& part : set) {
    if (part.from < std::min(part.to, range.from)) out.push_back({part.from, std::min(part.to, range.from)});
    if (std::max(part.from, range.to) < part.to) out.push_back({std::max(part.from, range.to), part.to});
  }
  return out;
}

MeasuredDepthRanges with(const MeasuredDepthRanges& set, const MeasuredDepthRange& range) {
  if (range.to <= range.from) return set;
  MeasuredDepthRange joined = range;
  MeasuredDepthRanges out;
  for (const MeasuredDepthRange& part : set) {
    if (part.to < range.from || part.from > range.to)
      out.push_back(part);
    else
      joined = {std::min(joined.from, part.from), std::max(joined.to, part.to)};
  }
  const auto place = std::find_if(out.begin(), out.end(), [&](const auto& part) { return part.from > joined.to; });
  out.insert(place, joined);
  return out;
}

}  // namespace wellknit
