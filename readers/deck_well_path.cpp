// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/deck_well_path.h"

#include <algorithm>
#include <cmath>

namespace wellknit {

namespace {

/// Points nearer than this are one: a micrometre, far below any survey and far above rounding at map coordinates.
constexpr double same_point = 1e-6;  // m

using CellIndex = std::array<std::int64_t, 3>;

enum class Side { low, high };

Side opposite(Side side) { return side == Side::low ? Side::high : Side::low; }

Vec3 center(const std::array<Vec3, 8>& corners) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& corner : corners) sum += corner;
  return sum / 8.0;
}

/// Mean of the four corners of the face on this side along i, j or k (axis 0, 1, 2).
Vec3 face_center(const std::array<Vec3, 8>& corners, std::size_t axis, Side side) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t corner = 0; corner < 8; ++corner)
    if (((corner >> axis) & 1) == (side == Side::high ? 1u : 0u)) sum += corners[corner];
  return sum / 4.0;
}

std::size_t axis_of(const DeckCompletion& completion) { return static_cast<std::size_t>(completion.direction - 'X'); }

struct Step {
  std::size_t axis = 2;
  Side towards = Side::high;
  bool to_neighbour = false;
};

/// How the path goes from one cell to another: along the completion's own direction if it can, else along the largest
/// step.
Step step_between(const CellIndex& from, const CellIndex& to, std::size_t preferred) {
  CellIndex delta{};
  for (std::size_t axis = 0; axis < 3; ++axis) delta[axis] = to[axis] - from[axis];
  const auto smaller = [](std::int64_t a, std::int64_t b) { return std::abs(a) < std::abs(b); };
  std::size_t axis = preferred;
  if (delta[axis] == 0)
    axis = static_cast<std::size_t>(std::max_element(delta.begin(), delta.end(), smaller) - delta.begin());
  const bool neighbour = std::abs(delta[0]) + std::abs(delta[1]) + std::abs(delta[2]) == 1;
  return {axis, delta[axis] < 0 ? Side::low : Side::high, neighbour};
}

class PathBuilder {
 public:
  /// Adds a point unless it is the last one again; its measured depth.
  double add(const Vec3& point) {
    if (path_.points.empty()) {
      path_.points.push_back(point);
      path_.measured_depth.push_back(0.0);
    } else if (const double length = (point - path_.points.back()).norm(); length > same_point) {
      path_.points.push_back(point);
      path_.measured_depth.push_back(path_.measured_depth.back() + length);
    }
    return path_.measured_depth.back();
  }
  Trajectory take() { return std::move(path_); }

 private:
  Trajectory path_;
};

/// Where the stretch between two centres leaves the first cell and enters the second, as fractions of it.
struct Crossing {
  double leaves = 0.5;
  double enters = 0.5;
};

Crossing crossing(const std::array<Vec3, 8>& first, const std::array<Vec3, 8>& second, const Step& step) {
  const Vec3 origin = center(first);
  const Vec3 along = center(second) - origin;
  const double square = along.squaredNorm();
  if (square <= same_point * same_point) return {};
  const auto fraction = [&](const Vec3& point) { return std::clamp(along.dot(point - origin) / square, 0.0, 1.0); };
  Crossing out{fraction(face_center(first, step.axis, step.towards)),
               fraction(face_center(second, step.axis, opposite(step.towards)))};
  // Neighbours share the face, and no stretch between them is shut; across a fault the two centres differ a little.
  if (step.to_neighbour || out.leaves > out.enters) out.leaves = out.enters = 0.5 * (out.leaves + out.enters);
  return out;
}

void merge_open(Well& well, const std::vector<MeasuredDepthRange>& ranges) {
  well.open.clear();
  for (std::size_t n = 0; n < ranges.size(); ++n) {
    if (!well.completions[n].open || ranges[n].to <= ranges[n].from) continue;
    if (!well.open.empty() && ranges[n].from <= well.open.back().to)
      well.open.back().to = ranges[n].to;
    else
      well.open.push_back(ranges[n]);
  }
  // An empty list would mean open everywhere.
  if (well.open.empty()) well.open.push_back({0.0, 0.0});
}

void sort_single_column(const CornerPointGrid& grid, std::vector<DeckCompletion>& completions) {
  const std::int64_t layer = grid.dimensions[0] * grid.dimensions[1];
  const std::int64_t column = completions.front().cell.value() % layer;
  if (std::all_of(completions.begin(), completions.end(),
                  [&](const auto& c) { return c.cell.value() % layer == column; }))
    std::sort(completions.begin(), completions.end(),
              [](const auto& a, const auto& b) { return a.cell.value() < b.cell.value(); });
}

}  // namespace

bool set_path_through_cells(const CornerPointGrid& grid, Well& well) {
  sort_single_column(grid, well.completions);
  const auto& completions = well.completions;
  const std::size_t count = completions.size();
  const auto step_after = [&](std::size_t n, std::size_t axis) {
    return step_between(grid.ijk(completions[n].cell), grid.ijk(completions[n + 1].cell), axis);
  };
  // The side of the end cells that the path runs towards: from the next or the last step if that goes along their axis.
  const auto side_at_end = [&](std::size_t step, std::size_t axis) {
    if (count == 1) return Side::high;
    const Step found = step_after(step, axis);
    return found.axis == axis ? found.towards : Side::high;
  };

  PathBuilder path;
  std::vector<MeasuredDepthRange> ranges(count);
  auto corners = grid.corners(completions.front().cell);
  const std::size_t first_axis = axis_of(completions.front());
  path.add(face_center(corners, first_axis, opposite(side_at_end(0, first_axis))));
  for (std::size_t n = 0; n + 1 < count; ++n) {
    const auto next = grid.corners(completions[n + 1].cell);
    const Crossing cut = crossing(corners, next, step_after(n, axis_of(completions[n])));
    const double from = path.add(center(corners));
    const double to = path.add(center(next));
    ranges[n].to = from + cut.leaves * (to - from);
    ranges[n + 1].from = from + cut.enters * (to - from);
    corners = next;
  }
  const std::size_t last_axis = axis_of(completions.back());
  ranges.back().to = path.add(face_center(corners, last_axis, side_at_end(count > 1 ? count - 2 : 0, last_axis)));
  well.trajectory = path.take();
  well.approximate_path = true;
  merge_open(well, ranges);
  return well.trajectory.points.size() >= 2;
}

}  // namespace wellknit
