// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Source: R. Seidel, Small-dimensional linear programming and convex hulls made easy, Discrete & Computational Geometry
// 6 (1991) (key Seidel).
#include "algorithm/cell_center.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace wellknit {

namespace {

double height(const OutwardFace& face, const Vec3& point) {
  const double area = face.area_vector.norm();
  return area > 0.0 ? (face.mean - point).dot(face.area_vector) / area : std::numeric_limits<double>::infinity();
}

/// normal . x <= bound, in N unknowns.
template <std::size_t N>
struct HalfSpace {
  std::array<double, N> normal{};
  double bound = 0.0;

  [[nodiscard]] double excess(const std::array<double, N>& x) const {
    double sum = -bound;
    for (std::size_t i = 0; i < N; ++i) sum += normal[i] * x[i];
    return sum;
  }
};

/// Coordinates of the programme are of order 1: the cell's size is its unit.
constexpr double tolerance = 1e-12;
constexpr double box = 100.0;  ///< all unknowns stay within it, so that every programme has a solution

template <std::size_t N>
using Point = std::array<double, N>;

/// Largest objective . x under the half-spaces, in the order given. A half-space that the solution so far violates
/// holds with equality in the next one: one unknown less. Empty when there is no solution.
template <std::size_t N>
std::optional<Point<N>> solve(std::span<const HalfSpace<N>> spaces, const Point<N>& objective);

/// The unknown `out` removed from a half-space by the equation of another.
template <std::size_t N>
HalfSpace<N - 1> without(const HalfSpace<N>& space, const HalfSpace<N>& equation, std::size_t out) {
  HalfSpace<N - 1> reduced;
  const double factor = space.normal[out] / equation.normal[out];
  for (std::size_t i = 0, n = 0; i < N; ++i)
    if (i != out) reduced.normal[n++] = space.normal[i] - factor * equation.normal[i];
  reduced.bound = space.bound - factor * equation.bound;
  return reduced;
}

template <std::size_t N>
std::optional<Point<N>> solve_on(std::span<const HalfSpace<N>> earlier, const HalfSpace<N>& equation,
                                 const Point<N>& objective) {
  std::size_t out = 0;
  for (std::size_t i = 1; i < N; ++i)
    if (std::abs(equation.normal[i]) > std::abs(equation.normal[out])) out = i;
  if (std::abs(equation.normal[out]) <= tolerance) return std::nullopt;
  std::vector<HalfSpace<N - 1>> reduced;
  reduced.reserve(earlier.size() + 2);
  for (const double side : {-1.0, 1.0}) {
    HalfSpace<N> wall;
    wall.normal[out] = side;
    wall.bound = box;
    reduced.push_back(without(wall, equation, out));
  }
  for (const HalfSpace<N>& space : earlier) reduced.push_back(without(space, equation, out));
  HalfSpace<N> goal;
  goal.normal = objective;
  const auto found = solve<N - 1>(reduced, without(goal, equation, out).normal);
  if (!found) return std::nullopt;
  Point<N> x{};
  double rest = equation.bound;
  for (std::size_t i = 0, n = 0; i < N; ++i)
    if (i != out) {
      x[i] = (*found)[n++];
      rest -= equation.normal[i] * x[i];
    }
  x[out] = rest / equation.normal[out];
  return x;
}

template <std::size_t N>
std::optional<Point<N>> solve(std::span<const HalfSpace<N>> spaces, const Point<N>& objective) {
  if constexpr (N == 1) {
    double low = -box;
    double high = box;
    for (const HalfSpace<1>& s : spaces) {
      if (std::abs(s.normal[0]) <= tolerance) {
        if (s.bound < -tolerance * 10.0) return std::nullopt;
        continue;
      }
      const double end = s.bound / s.normal[0];
      (s.normal[0] > 0.0 ? high : low) = s.normal[0] > 0.0 ? std::min(high, end) : std::max(low, end);
    }
    if (low > high + tolerance * box) return std::nullopt;
    return Point<1>{objective[0] > 0.0 ? high : low};
  } else {
    Point<N> x{};
    for (std::size_t i = 0; i < N; ++i) x[i] = objective[i] > 0.0 ? box : -box;
    for (std::size_t s = 0; s < spaces.size(); ++s) {
      if (spaces[s].excess(x) <= tolerance) continue;
      const auto next = solve_on<N>(spaces.first(s), spaces[s], objective);
      if (!next) return std::nullopt;
      x = *next;
    }
    return x;
  }
}

/// Projections onto the face that hides most, until none hides more than the margin: a point near the first one. Empty
/// when the steps do not do.
std::optional<Vec3> relax(std::span<const OutwardFace> faces, Vec3 point, double margin) {
  constexpr int most_steps = 300;  // a step costs as much as one test of the cell
  for (int step = 0; step < most_steps; ++step) {
    double worst = margin;
    const OutwardFace* hidden = nullptr;
    for (const OutwardFace& face : faces) {
      const double h = height(face, point);
      if (h < worst) {
        worst = h;
        hidden = &face;
      }
    }
    if (hidden == nullptr) return point;
    point -= 1.05 * (margin - worst) * hidden->area_vector.normalized();
  }
  return std::nullopt;
}

}  // namespace

double smallest_height(std::span<const OutwardFace> faces, const Vec3& point) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const OutwardFace& face : faces) smallest = std::min(smallest, height(face, point));
  return smallest;
}

DeepestPoint deepest_point(std::span<const OutwardFace> faces, const Vec3& start, double size) {
  std::vector<HalfSpace<4>> spaces;
  for (const OutwardFace& face : faces) {
    const double area = face.area_vector.norm();
    if (!(area > 0.0)) continue;
    const Vec3 n = face.area_vector / area;
    spaces.push_back({{n.x(), n.y(), n.z(), 1.0}, n.dot(face.mean - start) / size});
  }
  // A random order makes the expected time linear; always the same one, so that the result is.
  std::minstd_rand generator(1);
  for (std::size_t i = spaces.size(); i > 1; --i) std::swap(spaces[i - 1], spaces[generator() % i]);
  const auto x = solve<4>(spaces, {0.0, 0.0, 0.0, 1.0});
  const Vec3 point = x ? Vec3(start + size * Vec3((*x)[0], (*x)[1], (*x)[2])) : start;
  return {point, smallest_height(faces, point)};
}

std::optional<Vec3> point_that_sees_all(std::span<const OutwardFace> faces, const Vec3& start, double size) {
  const DeepestPoint deepest = deepest_point(faces, start, size);
  if (!(deepest.height > 1e-9 * size)) return std::nullopt;
  const double wanted = std::min(0.05 * size, 0.5 * deepest.height);
  if (const auto near = relax(faces, start, wanted)) return near;
  // Along the way to the deepest point each height is linear.
  double part = 0.0;
  for (const OutwardFace& face : faces) {
    const double from = height(face, start);
    const double to = height(face, deepest.point);
    if (from < wanted) part = std::max(part, (wanted - from) / (to - from));
  }
  return start + part * (deepest.point - start);
}

}  // namespace wellknit
