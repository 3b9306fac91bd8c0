// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// From cell to cell: the point just behind the last exit tells the next cell, bisection its exit. Cells are not convex,
// so the exit is first enclosed by samples along the line's way through the cell's box.

#include "algorithm/cell_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wellknit {

namespace {

/// How far behind an exit the next cell is looked for, m: above the locator's slack at a face (1e-9 of a cell's length
/// and the rounding of the coordinates), below the accuracy promised.
constexpr double nudge = 5e-7;
/// The same as a share of the segment's length, where that is more.
constexpr double least_step_of_segment = 1e-12;
/// Parts shorter than this many steps are short; after so many of them in a row the step doubles.
constexpr double short_part = 10.0;
constexpr int most_short_parts = 200;
/// Bisection stops here, m.
constexpr double bisection_accuracy = 1e-8;
/// Looks for the next cell along a line's way through the grid's box.
constexpr double most_probes = 20000.0;
/// Samples along a line's way through a cell's box.
constexpr int samples_in_cell = 16;

/// Where, in [0, 1], the line from a to b is inside the box; empty when first > second.
std::pair<double, double> inside_box(const Vec3& a, const Vec3& b, const Vec3& low, const Vec3& high) {
  double first = 0.0;
  double last = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = b[axis] - a[axis];
    if (d == 0.0) {
      if (a[axis] < low[axis] || a[axis] > high[axis]) return {1.0, 0.0};
      continue;
    }
    const double t0 = (low[axis] - a[axis]) / d;
    const double t1 = (high[axis] - a[axis]) / d;
    first = std::max(first, std::min(t0, t1));
    last = std::min(last, std::max(t0, t1));
  }
  return {first, last};
}

/// One straight segment; positions on it are t in [0, 1].
class Segment {
 public:
  Segment(const CornerPointGrid& grid, const CellLocator& locator, const Vec3& a, const Vec3& b, double probe)
      : grid_(grid), locator_(locator), a_(a), b_(b), length_((b - a).norm()), probe_(probe) {}

  [[nodiscard]] Vec3 at(double t) const { return a_ + t * (b_ - a_); }

  /// Calls visit(cell, from, to) for each part in turn.
  void walk(const auto& visit) const {
    if (length_ <= nudge) return;
    // Of a segment of thousands of kilometres, which pillars that nearly lie flat can make, positions have no
    // micrometres.
    const double least_step = std::max(nudge / length_, least_step_of_segment);
    double step = least_step;
    int short_parts = 0;  // one after another
    for (double t = 0.0; t + step < 1.0;) {
      const auto found = locator_.locate(at(t + step));
      const double end = std::max(t + step, found ? exit_of(found->cell, t + step) : next_entry(t + step));
      if (found) visit(found->cell, t, end);
      // Along a face that two cells take in turn for theirs there is no end of short parts: steps grow there.
      short_parts = end - t < short_part * step ? short_parts + 1 : 0;
      if (short_parts == 0)
        step = least_step;
      else if (short_parts % most_short_parts == 0)
        step *= 2.0;
      t = end;
    }
  }

 private:
  [[nodiscard]] bool is_in(HostCellId cell, double t) const {
    const auto found = locator_.locate(at(t), cell);
    return found && found->cell == cell;
  }

  /// Boundary between `inside` (the predicate holds) and `outside` (it does not).
  [[nodiscard]] double bisect(double inside, double outside, const auto& predicate) const {
    while (std::abs(outside - inside) * length_ > bisection_accuracy) {
      const double middle = 0.5 * (inside + outside);
      if (middle == inside || middle == outside) break;
      (predicate(middle) ? inside : outside) = middle;
    }
    return std::max(inside, outside);
  }

  [[nodiscard]] double exit_of(HostCellId cell, double t) const {
    const auto corners = grid_.corners(cell);
    Vec3 low = corners[0];
    Vec3 high = corners[0];
    for (const Vec3& c : corners) {
      low = low.cwiseMin(c);
      high = high.cwiseMax(c);
    }
    const Vec3 margin = Vec3::Constant(2.0 * nudge);
    const double last = std::max(t, inside_box(a_, b_, low - margin, high + margin).second);
    const auto in_cell = [&](double s) { return is_in(cell, s); };
    double inside = t;
    for (int sample = 1; sample <= samples_in_cell; ++sample) {
      const double next = t + (last - t) * sample / samples_in_cell;
      if (!in_cell(next)) return bisect(inside, next, in_cell);
      inside = next;
    }
    return last;
  }

  [[nodiscard]] double next_entry(double t) const {
    const auto bounds = locator_.bounds();
    const auto [first, last] = inside_box(a_, b_, bounds[0], bounds[1]);
    const auto anywhere = [&](double s) { return locator_.locate(at(s)).has_value(); };
    double outside = std::max(t, first);
    if (outside > last) return 1.0;
    // Bounded: pillars that nearly lie flat make grids, and wells in them, of any length.
    const double step = std::max(probe_ / length_, (last - first) / most_probes);
    for (double next = outside; outside < last; outside = next) {
      next = std::min(outside + step, last);
      if (anywhere(next)) return bisect(next, outside, anywhere);
    }
    return 1.0;
  }

  const CornerPointGrid& grid_;
  const CellLocator& locator_;
  Vec3 a_;
  Vec3 b_;
  double length_;
  double probe_;  ///< step of the search for the next cell, m
};

double mean_thickness(const CornerPointGrid& grid) {
  const std::int64_t layer = 4 * grid.dimensions[0] * grid.dimensions[1];
  double sum = 0.0;
  for (std::int64_t k = 0; k < grid.dimensions[2]; ++k) {
    const double* top = grid.zcorn.data() + 2 * k * layer;
    for (std::int64_t c = 0; c < layer; ++c) sum += std::abs(top[c + layer] - top[c]);
  }
  return sum / static_cast<double>(layer * grid.dimensions[2]);
}

}  // namespace

std::vector<CellPart> cells_along(const CornerPointGrid& grid, const CellLocator& locator,
                                  const Trajectory& trajectory) {
  std::vector<CellPart> parts;
  constexpr double least_probe = 1e-3;  // m
  const double probe = std::max(least_probe, 0.25 * mean_thickness(grid));
  for (std::size_t s = 0; s + 1 < trajectory.points.size(); ++s) {
    const Segment segment(grid, locator, trajectory.points[s], trajectory.points[s + 1], probe);
    const double md = trajectory.measured_depth[s];
    const double span = trajectory.measured_depth[s + 1] - md;
    segment.walk([&](HostCellId cell, double from, double to) {
      parts.push_back({cell, {md + from * span, md + to * span}, segment.at(from), segment.at(to)});
    });
  }
  return parts;
}

}  // namespace wellknit
