// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// In the strip between pillars p and q every horizon is a straight line from its depth on p to its depth on q, and the
// lines of one column do not cross. So two lines of different columns cross when, and only when, their nodes stand in
// opposite order on p and on q; everything below is decided by comparing ranks, never coordinates, and so fits together
// whatever the rounding. A region lies between two neighbouring lines of one column: a cell, or nothing. The common
// part of a region of each column is convex; going round it meets nodes of p, nodes of q, and at most four crossings.

#include "algorithm/host_strip.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wellknit {

namespace {

constexpr std::int32_t above_all = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t below_all = std::numeric_limits<std::int32_t>::max();

}  // namespace

bool Strip::is_matched() const {
  const auto& [a, b] = sides;
  return a.p.empty() || b.p.empty() ||
         (std::equal(a.p.begin(), a.p.end(), b.p.begin(), b.p.end()) &&
          std::equal(a.q.begin(), a.q.end(), b.q.begin(), b.q.end()));
}

std::span<const VertexId> StripCuts::cuts_of(std::int64_t strip, int side, std::int32_t p, std::int32_t q) const {
  const auto at = static_cast<std::size_t>(2 * strip + side);
  const LineCut* first = cuts.data() + cut_start[at];
  const LineCut* last = cuts.data() + cut_start[at + 1];
  const LineCut* found = std::lower_bound(
      first, last, std::pair(p, q), [](const LineCut& cut, const auto& key) { return std::pair(cut.p, cut.q) < key; });
  if (found == last || found->p != p || found->q != q) return {};
  return {cut_vertices.data() + found->begin, found->end - found->begin};
}

void StripCuts::number_from(VertexId first) {
  for (VertexId& v : cut_vertices) v = VertexId(v.value() + first.value());
  for (std::int64_t& crossing : first_crossing)
    if (crossing != matched) crossing += first.value();
}

void add_matched_faces(const Strip& strip, HostFaceWriter& writer) {
  const StripSide& lines = strip.sides[strip.sides[0].p.empty() ? 1 : 0];
  const bool has_low = !strip.sides[0].p.empty();
  const bool has_high = !strip.sides[1].p.empty();
  for (std::size_t top = 0; top < lines.p.size(); top += 2) {
    const std::int32_t p0 = lines.p[top];
    const std::int32_t p1 = lines.p[top + 1];
    const std::int32_t q0 = lines.q[top];
    const std::int32_t q1 = lines.q[top + 1];
    if (p0 == p1 && q0 == q1) continue;
    const auto place = static_cast<std::int64_t>(top / 2);
    const FaceCell from = has_low ? strip.sides[0].column.cell(place) : FaceCell{};
    const FaceCell to = has_high ? strip.sides[1].column.cell(place) : FaceCell{};
    if (from.state != HostCellState::exists && to.state != HostCellState::exists) continue;
    writer.push(strip.on_p(p0));
    for (std::int32_t rank = q0; rank <= q1; ++rank) writer.push(strip.on_q(rank));
    for (std::int32_t rank = p1; rank > p0; --rank) writer.push(strip.on_p(rank));
    writer.close(from, to, strip.axis, false, false);
  }
}

void StripOverlay::Lines::read(const StripSide& side) {
  p.assign(1, above_all);
  q.assign(1, above_all);
  place.assign(1, -1);
  for (std::size_t level = 0; level < side.p.size(); ++level) {
    const std::int32_t below = level % 2 == 0 ? static_cast<std::int32_t>(level / 2) : -1;
    if (side.p[level] == p.back() && side.q[level] == q.back()) {
      // The same line again: what lies below it is told by its last level.
      place.back() = below;
      continue;
    }
    p.push_back(side.p[level]);
    q.push_back(side.q[level]);
    place.push_back(below);
  }
  p.push_back(below_all);
  q.push_back(below_all);
}

StripOverlay::Crossed StripOverlay::crossed_by(std::int32_t p, std::int32_t q, const Lines& others) {
  const auto below = [](const std::vector<std::int32_t>& ranks, std::int32_t rank) {
    return static_cast<std::size_t>(std::lower_bound(ranks.begin(), ranks.end(), rank) - ranks.begin());
  };
  const auto beyond = [](const std::vector<std::int32_t>& ranks, std::int32_t rank) {
    return static_cast<std::size_t>(std::upper_bound(ranks.begin(), ranks.end(), rank) - ranks.begin());
  };
  const Crossed falling{beyond(others.p, p), below(others.q, q), true};  // under it on p, over it on q
  const Crossed rising{beyond(others.q, q), below(others.p, p), false};
  if (falling.first < falling.last) return falling;
  if (rising.first < rising.last) return rising;
  return {};
}

void StripOverlay::read(const Strip& strip, std::int64_t first_crossing) {
  for (std::size_t side = 0; side < 2; ++side) lines_[side].read(strip.sides[side]);
  const std::size_t count = lines_[0].p.size();
  crossed_.assign(count, {});
  first_crossing_.assign(count, 0);
  crossing_count_ = 0;
  for (std::size_t line = 1; line + 1 < count; ++line) {
    crossed_[line] = crossed_by(lines_[0].p[line], lines_[0].q[line], lines_[1]);
    first_crossing_[line] = first_crossing + crossing_count_;
    crossing_count_ += static_cast<std::int64_t>(crossed_[line].last - crossed_[line].first);
  }
}

std::int64_t StripOverlay::crossing(std::size_t line0, std::size_t line1) const {
  return first_crossing_[line0] + static_cast<std::int64_t>(line1 - crossed_[line0].first);
}

void StripOverlay::add_crossings(const PillarPair& pillars, const Strip& strip, const IdVector<VertexId, Vec3>& nodes,
                                 StripCuts& out) const {
  const auto depth_p = [&](std::int32_t rank) { return nodes[strip.on_p(rank)][2]; };
  const auto depth_q = [&](std::int32_t rank) { return nodes[strip.on_q(rank)][2]; };
  for (std::size_t line = 1; line + 1 < lines_[0].p.size(); ++line) {
    const double p0 = depth_p(lines_[0].p[line]);
    const double q0 = depth_q(lines_[0].q[line]);
    for (std::size_t other = crossed_[line].first; other < crossed_[line].last; ++other) {
      const double at_p = std::abs(p0 - depth_p(lines_[1].p[other]));
      const double at_q = std::abs(q0 - depth_q(lines_[1].q[other]));
      const double s = at_p / (at_p + at_q);
      const double z = (1.0 - s) * p0 + s * q0;
      const auto [on_p, on_q] = pillars(z);
      out.crossings.emplace_back((1.0 - s) * on_p + s * on_q);
    }
  }
  for (std::size_t side = 0; side < 2; ++side) {
    add_cuts(side, out);
    out.cut_start.push_back(out.cuts.size());
  }
}

void StripOverlay::add_cuts(std::size_t side, StripCuts& out) const {
  for (std::size_t line = 1; line + 1 < lines_[side].p.size(); ++line) {
    const std::int32_t p = lines_[side].p[line];
    const std::int32_t q = lines_[side].q[line];
    const Crossed crossed = side == 0 ? crossed_[line] : crossed_by(p, q, lines_[0]);
    if (crossed.first == crossed.last) continue;
    const std::size_t begin = out.cut_vertices.size();
    for (std::size_t other = crossed.first; other < crossed.last; ++other)
      out.cut_vertices.emplace_back(side == 0 ? crossing(line, other) : crossing(other, line));
    // A falling line meets the uppermost of the others first.
    if (!crossed.falls)
      std::reverse(out.cut_vertices.begin() + static_cast<std::ptrdiff_t>(begin), out.cut_vertices.end());
    out.cuts.push_back({p, q, begin, out.cut_vertices.size()});
  }
}

void StripOverlay::add_faces(const Strip& strip, HostFaceWriter& writer) const {
  const auto& [a, b] = lines_;
  std::size_t first = 0;
  for (std::size_t ra = 0; ra < a.regions(); ++ra) {
    while (b.p[first + 1] <= a.p[ra] && b.q[first + 1] <= a.q[ra]) ++first;
    for (std::size_t rb = first; rb < b.regions() && (b.p[rb] < a.p[ra + 1] || b.q[rb] < a.q[ra + 1]); ++rb)
      add_face(strip, ra, rb, writer);
  }
}

StripOverlay::End StripOverlay::end_of(bool at_p, std::size_t region0, std::size_t region1) const {
  const auto& a = at_p ? lines_[0].p : lines_[0].q;
  const auto& b = at_p ? lines_[1].p : lines_[1].q;
  const auto deeper = [](std::int32_t one, std::int32_t other) { return one > other ? -1 : one < other ? 1 : 0; };
  End end;
  if (a[region0] > b[region1 + 1]) {  // the common part ends before the pillar, where these two lines cross
    end.on_pillar = false;
    end.low = crossing(region0, region1 + 1);
    end.upper_line = -1;
    end.lower_line = 1;
  } else if (b[region1] > a[region0 + 1]) {
    end.on_pillar = false;
    end.low = crossing(region0 + 1, region1);
    end.upper_line = 1;
    end.lower_line = -1;
  } else {
    end.low = std::max(a[region0], b[region1]);
    end.high = std::min(a[region0 + 1], b[region1 + 1]);
    end.upper_line = deeper(a[region0], b[region1]);
    end.lower_line = -deeper(a[region0 + 1], b[region1 + 1]);
  }
  return end;
}

/// Whether the other side's region covers the whole of this side's.
bool StripOverlay::covers(int side, std::size_t region0, std::size_t region1) const {
  const Lines& inner = lines_[side == 0 ? 0 : 1];
  const Lines& outer = lines_[side == 0 ? 1 : 0];
  const std::size_t in = side == 0 ? region0 : region1;
  const std::size_t out = side == 0 ? region1 : region0;
  return outer.p[out] <= inner.p[in] && outer.q[out] <= inner.q[in] && inner.p[in + 1] <= outer.p[out + 1] &&
         inner.q[in + 1] <= outer.q[out + 1];
}

void StripOverlay::add_face(const Strip& strip, std::size_t region0, std::size_t region1,
                            HostFaceWriter& writer) const {
  const FaceCell from = strip.sides[0].cell(lines_[0].place[region0]);
  const FaceCell to = strip.sides[1].cell(lines_[1].place[region1]);
  const bool from_exists = from.state == HostCellState::exists;
  const bool to_exists = to.state == HostCellState::exists;
  if (!from_exists && !to_exists) return;

  const End left = end_of(true, region0, region1);
  const End right = end_of(false, region0, region1);
  const auto push_crossing = [&](std::size_t line0, std::size_t line1) {
    writer.push(VertexId(crossing(line0, line1)));
  };
  writer.push(left.on_pillar ? strip.on_p(left.low) : VertexId(left.low));
  if (left.upper_line * right.upper_line < 0) push_crossing(region0, region1);
  writer.push(right.on_pillar ? strip.on_q(right.low) : VertexId(right.low));
  if (right.on_pillar)
    for (std::int64_t rank = right.low + 1; rank <= right.high; ++rank) writer.push(strip.on_q(rank));
  if (left.lower_line * right.lower_line < 0) push_crossing(region0 + 1, region1 + 1);
  if (left.on_pillar)
    for (std::int64_t rank = left.high; rank > left.low; --rank) writer.push(strip.on_p(rank));

  const bool whole = (!from_exists || covers(0, region0, region1)) && (!to_exists || covers(1, region0, region1));
  writer.close(from, to, strip.axis, !whole, false);
}

}  // namespace wellknit
