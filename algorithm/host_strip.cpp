// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// In the strip between pillars p and q every horizon is a straight line from its depth on p to its depth on q, and the
// lines of one column do not cross. So two lines of different columns cross when, and only when, their nodes stand in
// opposite order on p and on q; everything below is decided by comparing node numbers, never coordinates, and so fits
// together whatever the rounding. A region lies between two neighbouring lines of one column: a cell, or nothing. The
// common part of a region of each column is convex; going round it meets nodes of p, nodes of q, and at most four
// crossings.

#include "algorithm/host_strip.h"

#include <algorithm>
#include <limits>

namespace wellknit {

namespace {

constexpr std::int64_t above_all = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t below_all = std::numeric_limits<std::int64_t>::max();

}  // namespace

void HostFaceWriter::close(HostCellId from, HostCellId to, Axis axis, bool is_fault, bool is_pinch) {
  const auto begin = faces_.vertices.begin() + faces_.vertex_start.back();
  if (faces_.vertices.end() - begin < 3 ||
      (state(from) != HostCellState::exists && state(to) != HostCellState::exists)) {
    faces_.vertices.erase(begin, faces_.vertices.end());
    return;
  }
  bool reversed = mirrored_;
  if (state(from) != HostCellState::exists || (state(to) == HostCellState::exists && to < from)) {
    std::swap(from, to);
    reversed = !reversed;
  }
  if (reversed) std::reverse(begin, faces_.vertices.end());
  if (state(to) == HostCellState::none) to = HostCellId{};
  faces_.vertex_start.push_back(static_cast<std::int64_t>(faces_.vertices.size()));
  faces_.cells.push_back({from, to});
  faces_.axis.push_back(axis);
  faces_.is_fault.push_back(is_fault ? 1 : 0);
  faces_.is_pinch.push_back(is_pinch ? 1 : 0);
}

std::span<const VertexId> StripFaces::cuts_of(std::int64_t strip, int side, std::int64_t p, std::int64_t q) const {
  const auto at = static_cast<std::size_t>(2 * strip + side);
  const LineCut* first = cuts.data() + cut_start[at];
  const LineCut* last = cuts.data() + cut_start[at + 1];
  const LineCut* found = std::lower_bound(
      first, last, std::pair(p, q), [](const LineCut& cut, const auto& key) { return std::pair(cut.p, cut.q) < key; });
  if (found == last || found->p != p || found->q != q) return {};
  return {cut_vertices.data() + found->begin, found->end - found->begin};
}

StripCutter::StripCutter(const CornerPointGrid& grid, const IdVector<VertexId, Vec3>& nodes,
                         const std::vector<HostCellState>& states, bool mirrored, StripFaces& out)
    : grid_(grid), nodes_(nodes), out_(out), writer_(out.faces, states, mirrored) {}

void StripCutter::cut(const Strip& strip) {
  const auto& [a, b] = strip.sides;
  const bool one_sided = a.p.empty() || b.p.empty();
  if (one_sided ||
      (std::equal(a.p.begin(), a.p.end(), b.p.begin()) && std::equal(a.q.begin(), a.q.end(), b.q.begin()))) {
    matched(strip);
    out_.cut_start.push_back(out_.cuts.size());
    out_.cut_start.push_back(out_.cuts.size());
  } else {
    overlaid(strip);
  }
}

/// Both columns have the same lines, or there is only one.
void StripCutter::matched(const Strip& strip) {
  const StripSide& lines = strip.sides[strip.sides[0].p.empty() ? 1 : 0];
  for (std::size_t top = 0; top < lines.p.size(); top += 2) {
    if (lines.p[top] == lines.p[top + 1] && lines.q[top] == lines.q[top + 1]) continue;
    std::array<HostCellId, 2> cells;
    for (std::size_t side = 0; side < 2; ++side)
      if (!strip.sides[side].p.empty()) cells[side] = strip.sides[side].cell(static_cast<std::int64_t>(top / 2));
    writer_.push(lines.p[top]);
    for (std::int64_t node = lines.q[top]; node <= lines.q[top + 1]; ++node) writer_.push(node);
    for (std::int64_t node = lines.p[top + 1]; node > lines.p[top]; --node) writer_.push(node);
    writer_.close(cells[0], cells[1], strip.axis, false, false);
  }
}

void StripCutter::Lines::read(const StripSide& side) {
  p.assign(1, above_all);
  q.assign(1, above_all);
  place.assign(1, -1);
  for (std::size_t level = 0; level < side.p.size(); ++level) {
    if (side.p[level] == p.back() && side.q[level] == q.back()) {
      // The same line again: what lies below it is told by its last level.
      place.back() = level % 2 == 0 ? static_cast<std::int64_t>(level / 2) : -1;
      continue;
    }
    p.push_back(side.p[level]);
    q.push_back(side.q[level]);
    place.push_back(level % 2 == 0 ? static_cast<std::int64_t>(level / 2) : -1);
  }
  p.push_back(below_all);
  q.push_back(below_all);
}

StripCutter::Crossed StripCutter::crossed_by(std::int64_t p, std::int64_t q, const Lines& others) {
  const auto below = [](const std::vector<std::int64_t>& nodes, std::int64_t node) {
    return static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
  };
  const auto beyond = [](const std::vector<std::int64_t>& nodes, std::int64_t node) {
    return static_cast<std::size_t>(std::upper_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
  };
  const Crossed falling{beyond(others.p, p), below(others.q, q), true};  // under it on p, over it on q
  const Crossed rising{beyond(others.q, q), below(others.p, p), false};
  if (falling.first < falling.last) return falling;
  if (rising.first < rising.last) return rising;
  return {};
}

Vec3 StripCutter::crossing_point(const Strip& strip, std::size_t line0, std::size_t line1) const {
  const auto depth = [&](std::int64_t node) { return nodes_[VertexId(node)][2]; };
  const double p0 = depth(lines_[0].p[line0]);
  const double q0 = depth(lines_[0].q[line0]);
  const double at_p = std::abs(p0 - depth(lines_[1].p[line1]));
  const double at_q = std::abs(q0 - depth(lines_[1].q[line1]));
  const double s = at_p / (at_p + at_q);
  const double z = (1.0 - s) * p0 + s * q0;
  return (1.0 - s) * grid_.pillar_point(strip.pillar_p[0], strip.pillar_p[1], z) +
         s * grid_.pillar_point(strip.pillar_q[0], strip.pillar_q[1], z);
}

void StripCutter::find_crossings(const Strip& strip) {
  const std::size_t count = lines_[0].p.size();
  crossed_.assign(count, {});
  first_crossing_.assign(count, 0);
  for (std::size_t line = 1; line + 1 < count; ++line) {
    crossed_[line] = crossed_by(lines_[0].p[line], lines_[0].q[line], lines_[1]);
    first_crossing_[line] = static_cast<std::int64_t>(nodes_.size() + out_.crossings.size());
    for (std::size_t other = crossed_[line].first; other < crossed_[line].last; ++other)
      out_.crossings.push_back(crossing_point(strip, line, other));
  }
}

std::int64_t StripCutter::crossing(std::size_t line0, std::size_t line1) const {
  return first_crossing_[line0] + static_cast<std::int64_t>(line1 - crossed_[line0].first);
}

void StripCutter::write_cuts() {
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t line = 1; line + 1 < lines_[side].p.size(); ++line) {
      const std::int64_t p = lines_[side].p[line];
      const std::int64_t q = lines_[side].q[line];
      const Crossed crossed = side == 0 ? crossed_[line] : crossed_by(p, q, lines_[0]);
      if (crossed.first == crossed.last) continue;
      const std::size_t begin = out_.cut_vertices.size();
      for (std::size_t other = crossed.first; other < crossed.last; ++other)
        out_.cut_vertices.emplace_back(side == 0 ? crossing(line, other) : crossing(other, line));
      // A falling line meets the uppermost of the others first.
      if (!crossed.falls)
        std::reverse(out_.cut_vertices.begin() + static_cast<std::ptrdiff_t>(begin), out_.cut_vertices.end());
      out_.cuts.push_back({p, q, begin, out_.cut_vertices.size()});
    }
    out_.cut_start.push_back(out_.cuts.size());
  }
}

/// The columns have different lines.
void StripCutter::overlaid(const Strip& strip) {
  for (std::size_t side = 0; side < 2; ++side) lines_[side].read(strip.sides[side]);
  find_crossings(strip);
  write_cuts();
  const auto& [a, b] = lines_;
  std::size_t first = 0;
  for (std::size_t ra = 0; ra < a.regions(); ++ra) {
    while (b.p[first + 1] <= a.p[ra] && b.q[first + 1] <= a.q[ra]) ++first;
    for (std::size_t rb = first; rb < b.regions() && (b.p[rb] < a.p[ra + 1] || b.q[rb] < a.q[ra + 1]); ++rb)
      polygon(strip, ra, rb);
  }
}

StripCutter::End StripCutter::end_of(bool at_p, std::size_t region0, std::size_t region1) const {
  const auto& a = at_p ? lines_[0].p : lines_[0].q;
  const auto& b = at_p ? lines_[1].p : lines_[1].q;
  const auto deeper = [](std::int64_t one, std::int64_t other) { return one > other ? -1 : one < other ? 1 : 0; };
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
bool StripCutter::covers(int side, std::size_t region0, std::size_t region1) const {
  const Lines& inner = lines_[side == 0 ? 0 : 1];
  const Lines& outer = lines_[side == 0 ? 1 : 0];
  const std::size_t in = side == 0 ? region0 : region1;
  const std::size_t out = side == 0 ? region1 : region0;
  return outer.p[out] <= inner.p[in] && outer.q[out] <= inner.q[in] && inner.p[in + 1] <= outer.p[out + 1] &&
         inner.q[in + 1] <= outer.q[out + 1];
}

void StripCutter::polygon(const Strip& strip, std::size_t region0, std::size_t region1) {
  const HostCellId from = strip.sides[0].cell(lines_[0].place[region0]);
  const HostCellId to = strip.sides[1].cell(lines_[1].place[region1]);
  const bool from_exists = writer_.state(from) == HostCellState::exists;
  const bool to_exists = writer_.state(to) == HostCellState::exists;
  if (!from_exists && !to_exists) return;

  const End left = end_of(true, region0, region1);
  const End right = end_of(false, region0, region1);
  writer_.push(left.low);
  if (left.upper_line * right.upper_line < 0) writer_.push(crossing(region0, region1));
  writer_.push(right.low);
  if (right.on_pillar)
    for (std::int64_t node = right.low + 1; node <= right.high; ++node) writer_.push(node);
  if (left.lower_line * right.lower_line < 0) writer_.push(crossing(region0 + 1, region1 + 1));
  if (left.on_pillar)
    for (std::int64_t node = left.high; node > left.low; --node) writer_.push(node);

  const bool whole = (!from_exists || covers(0, region0, region1)) && (!to_exists || covers(1, region0, region1));
  writer_.close(from, to, strip.axis, !whole, false);
}

}  // namespace wellknit
