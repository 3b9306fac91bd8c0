// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/well_piece.h"

#include <algorithm>
#include <cmath>

namespace wellknit {

namespace {

constexpr int most_cuts = 6;       ///< times that a piece is cut where it fails
constexpr double most_lost = 0.4;  ///< of a piece, by one cut

}  // namespace

std::vector<Piece> cut(const Piece& piece, std::size_t number, const Failure& failure) {
  std::vector<Piece> out;
  if (piece.range.to <= piece.range.from || piece.cuts >= most_cuts) return out;
  // Wider each time: a fault that comes in at a low angle is near over a long way.
  const double wide = piece.radius * static_cast<double>(1 << piece.cuts);
  std::vector<MeasuredDepthRange> lost;
  for (const TubePlace& p : failure.places)
    if (p.tube == number) {
      const double margin = p.reach > 0.0 ? p.reach : wide;
      lost.push_back({p.measured_depth - margin, p.measured_depth + margin});
    }
  if (lost.empty()) return out;
  if (piece.layered) {
    // A swept tube keeps clear of top and base.
    const double room = 1.2 * piece.radius;
    lost.push_back({piece.range.from, piece.range.from + room});
    lost.push_back({piece.range.to - room, piece.range.to});
  }
  std::sort(lost.begin(), lost.end(), [](const auto& a, const auto& b) { return a.from < b.from; });
  const double least = 2.0 * piece.radius;
  double left = 0.0;
  const auto keep = [&](double from, double to) {
    if (to - from < least) return;
    Piece part = piece;
    part.range = {from, to};
    part.layered = false;
    ++part.cuts;
    out.push_back(part);
    left += to - from;
  };
  double from = piece.range.from;
  for (const MeasuredDepthRange& r : lost) {
    keep(from, r.from);
    from = std::max(from, r.to);
  }
  keep(from, piece.range.to);
  if (left < (1.0 - most_lost) * (piece.range.to - piece.range.from)) out.clear();
  return out;
}

MeasuredDepthRange range_of(const Tube& tube) {
  const auto& md = tube.real.measured_depth;
  const auto [first, last] = std::minmax_element(md.begin(), md.end());
  return {*first, *last};
}

double radius_of(const Tube& tube) {
  const Vec3 d = tube.real.point(0, tube.real.rings, 0) - tube.real.axis.front();
  return tube.layered ? std::hypot(d.x(), d.y()) : d.norm();
}

}  // namespace wellknit
