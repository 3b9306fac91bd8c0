// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Depths need one look at each cell. Jacobians do not: at a corner on pillar p with the next pillars q and r the
// Jacobian has the sign of D_pq(z_q) x D_pr(z_r), where D_pq(z) is the vector in plan from p to q at depth z. D is
// linear in z, so the product over a column's depths is least at the ends of their range: sixteen products clear a
// whole column, and only the cells of the others are looked at. The scaled Jacobian is P. M. Knupp's, "Algebraic mesh
// quality metrics", 2001 (key Knupp2001), at the corners.

#include "algorithm/host_validity.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "algorithm/host_pillars.h"

namespace wellknit {

namespace {

using Place = std::array<std::int64_t, 3>;
using Vec2 = Eigen::Vector2d;

constexpr double tolerance = pillar_merge_tolerance;
constexpr std::size_t places_kept = 10;
/// Sines and scaled Jacobians below this are rounding: coordinates have 16 digits, cells are 10^-5 of them.
constexpr double rounding = 1e-10;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

bool is_jacobian(GridOddity kind) { return kind == GridOddity::self_overlapping || kind == GridOddity::twisted; }

bool stands_before(const OddPlace& a, const OddPlace& b) {
  const auto key = [](const OddPlace& place) {
    return std::array{place.cell[2], place.cell[1], place.cell[0], place.other[1], place.other[0]};
  };
  return key(a) < key(b);
}

bool is_worse(GridOddity kind, const OddPlace& a, const OddPlace& b) {
  if (a.figure != b.figure) return is_jacobian(kind) ? a.figure < b.figure : a.figure > b.figure;
  return stands_before(a, b);
}

void keep_first(std::vector<OddPlace>& first, const OddPlace& place) {
  if (first.size() == places_kept && !stands_before(place, first.back())) return;
  first.insert(std::upper_bound(first.begin(), first.end(), place, stands_before), place);
  if (first.size() > places_kept) first.pop_back();
}

void add(GridValidity& validity, GridOddity kind, const OddPlace& place) {
  OddPlaces& places = validity[kind];
  if (places.count++ == 0 || is_worse(kind, place, places.worst)) places.worst = place;
  keep_first(places.first, place);
}

void join(GridValidity& all, const GridValidity& part) {
  for (std::size_t n = 0; n < grid_oddity_count; ++n) {
    OddPlaces& to = all.kinds[n];
    const OddPlaces& from = part.kinds[n];
    if (from.count == 0) continue;
    if (to.count == 0 || is_worse(static_cast<GridOddity>(n), from.worst, to.worst)) to.worst = from.worst;
    to.count += from.count;
    to.area += from.area;
    for (const OddPlace& place : from.first) keep_first(to.first, place);
  }
}

/// Depths of a column's active cells, m; empty where low > high.
struct DepthRange {
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();

  [[nodiscard]] bool empty() const { return low > high; }
  void add(const DepthRange& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
};

/// The layers of the grid from above, whichever way they are numbered.
struct Layers {
  const CornerPointGrid& grid;
  bool upside_down = false;

  [[nodiscard]] std::int64_t count() const { return grid.dimensions[2]; }
  [[nodiscard]] std::int64_t layer(std::int64_t place) const { return upside_down ? count() - 1 - place : place; }
  /// Depths at dj of row j of columns, 2 i + di; of the upper (0) or lower (1) side of the layer at `place`.
  [[nodiscard]] const double* row(std::int64_t place, int side, std::int64_t j, int dj) const {
    const std::int64_t k2 = 2 * layer(place) + (upside_down ? 1 - side : side);
    return grid.zcorn.data() + 2 * grid.dimensions[0] * (2 * j + dj + 2 * grid.dimensions[1] * k2);
  }
};

/// Depths of four corners, di + 2 dj.
using Depths = std::array<double, 4>;

double largest_difference(const Depths& a, const Depths& b) {
  double largest = a[0] - b[0];
  for (std::size_t c = 1; c < 4; ++c) largest = std::max(largest, a[c] - b[c]);
  return largest;
}

/// One row of columns, layer by layer from above.
class RowScan {
 public:
  RowScan(const Layers& layers, std::int64_t j, DepthRange* ranges, GridValidity& out)
      : layers_(layers), grid_(layers.grid), j_(j), ranges_(ranges), out_(out) {}

  void scan() {
    const auto nx = static_cast<std::size_t>(grid_.dimensions[0]);
    columns_.resize(nx);
    for (std::int64_t place = 0; place < layers_.count(); ++place) {
      const std::array tops{layers_.row(place, 0, j_, 0), layers_.row(place, 0, j_, 1)};
      const std::array bases{layers_.row(place, 1, j_, 0), layers_.row(place, 1, j_, 1)};
      const std::size_t first = grid_.cell_id(0, j_, layers_.layer(place)).index();
      for (std::size_t i = 0; i < nx; ++i) {
        const Depths top{tops[0][2 * i], tops[0][2 * i + 1], tops[1][2 * i], tops[1][2 * i + 1]};
        const Depths base{bases[0][2 * i], bases[0][2 * i + 1], bases[1][2 * i], bases[1][2 * i + 1]};
        cell(i, place, top, base, grid_.active[first + i] != 0);
      }
    }
  }

 private:
  /// What stands over the next cell of a column.
  struct Column {
    Depths level = lowest();       ///< the deepest so far, on each pillar
    Depths open{};                 ///< void between the last cell with thickness and `level`, m
    std::int64_t above = -1;       ///< place of the last cell with thickness
    bool is_active_above = false;  ///< that cell
    bool is_open = false;          ///< `open` is not 0
  };
  static Depths lowest() {
    constexpr double value = std::numeric_limits<double>::lowest();
    return {value, value, value, value};
  }

  void cell(std::size_t i, std::int64_t place, const Depths& top, const Depths& base, bool active) {
    Column& column = columns_[i];
    const bool meets = top == column.level && !column.is_open;
    const bool is_thick = base[0] > top[0] && base[1] > top[1] && base[2] > top[2] && base[3] > top[3];
    if (meets && is_thick) {
      column.level = base;
      column.above = place;
      column.is_active_above = active;
    } else {
      odd_cell(i, place, top, base, active);
    }
    if (!active) return;
    DepthRange& range = ranges_[i];
    range.low = std::min(range.low, *std::min_element(top.begin(), top.end()));
    range.high = std::max(range.high, *std::max_element(column.level.begin(), column.level.end()));
  }

  void odd_cell(std::size_t i, std::int64_t place, const Depths& top, const Depths& base, bool active) {
    Column& column = columns_[i];
    const bool is_first = place == 0;
    const Place over = is_first ? no_place : Place{static_cast<std::int64_t>(i), j_, layers_.layer(place - 1)};
    if (active) {
      if (const double d = largest_difference(top, base); d > tolerance)
        report(GridOddity::reversed_corners, i, place, no_place, d);
      if (const double d = largest_difference(column.level, top); d > tolerance && !is_first)
        report(GridOddity::overlapping, i, place, over, d);
    }
    Depths upper = top;
    Depths lower = base;
    for (std::size_t c = 0; c < 4; ++c) {
      upper[c] = std::max(upper[c], column.level[c]);
      lower[c] = std::max(lower[c], upper[c]);
      if (!is_first) column.open[c] += upper[c] - column.level[c];
    }
    column.level = lower;
    column.is_open = column.above >= 0;
    if (largest_difference(lower, upper) <= tolerance) return;
    if (active && column.is_active_above) gap(i, place, upper);
    column.open = {};
    column.above = place;
    column.is_active_above = active;
    column.is_open = false;
  }

  void gap(std::size_t i, std::int64_t place, const Depths& upper) {
    const Column& column = columns_[i];
    const double thickness = *std::max_element(column.open.begin(), column.open.end());
    if (thickness <= tolerance) return;
    report(GridOddity::gap, i, place, {static_cast<std::int64_t>(i), j_, layers_.layer(column.above)}, thickness);
    std::array<Vec2, 4> p;
    for (int c = 0; c < 4; ++c)
      p[static_cast<std::size_t>(c)] =
          grid_.pillar_point(static_cast<std::int64_t>(i) + (c & 1), j_ + (c >> 1), upper[static_cast<std::size_t>(c)])
              .head<2>();
    out_[GridOddity::gap].area += 0.5 * std::abs(cross(p[3] - p[0], p[2] - p[1]));
  }

  void report(GridOddity kind, std::size_t i, std::int64_t place, const Place& other, double figure) {
    add(out_, kind, {{static_cast<std::int64_t>(i), j_, layers_.layer(place)}, other, figure});
  }

  const Layers& layers_;
  const CornerPointGrid& grid_;
  std::int64_t j_;
  DepthRange* ranges_;  ///< of the row's columns
  GridValidity& out_;
  std::vector<Column> columns_;
};

/// In plan, from one pillar to another: linear in depth.
class PillarPair {
 public:
  PillarPair(const CornerPointGrid& grid, std::array<std::int64_t, 2> from, std::array<std::int64_t, 2> to)
      : grid_(grid), from_(from), to_(to) {}

  [[nodiscard]] Vec2 at(double depth) const {
    return grid_.pillar_point(to_[0], to_[1], depth).head<2>() -
           grid_.pillar_point(from_[0], from_[1], depth).head<2>();
  }
  /// Angle by which the vector turns between two depths, degrees; above 90 the pillars pass each other in between.
  [[nodiscard]] double turn(const DepthRange& range) const {
    const Vec2 a = at(range.low);
    const Vec2 b = at(range.high);
    const double lengths = a.norm() * b.norm();
    // Pillars that meet at a cell's top or base make a wedge.
    if (!(a.norm() > tolerance) || !(b.norm() > tolerance)) return 0.0;
    return std::acos(std::clamp(a.dot(b) / lengths, -1.0, 1.0)) * 180.0 / std::numbers::pi;
  }

 private:
  const CornerPointGrid& grid_;
  std::array<std::int64_t, 2> from_;
  std::array<std::int64_t, 2> to_;
};

/// Pillars pass each other where the vector between them turns by more than a right angle.
constexpr double passing_angle = 90.0;

/// Columns in which some cell's Jacobian may not be positive, and what is wrong with their cells.
class ColumnCheck {
 public:
  ColumnCheck(const Layers& layers, double orientation, GridValidity& out)
      : layers_(layers), grid_(layers.grid), orientation_(orientation), out_(out) {}

  void column(std::int64_t i, std::int64_t j, const DepthRange& range) {
    if (range.empty() || is_clear(i, j, range)) return;
    Depths level;
    level.fill(std::numeric_limits<double>::lowest());
    for (std::int64_t place = 0; place < layers_.count(); ++place) {
      std::array<Depths, 2> sides{};
      for (std::size_t side = 0; side < 2; ++side)
        for (std::size_t c = 0; c < 4; ++c) {
          const double z = layers_.row(place, static_cast<int>(side), j,
                                       static_cast<int>(c >> 1))[2 * i + static_cast<std::int64_t>(c & 1)];
          sides[side][c] = level[c] = std::max(z, level[c]);
        }
      const bool active = grid_.active[grid_.cell_id(i, j, layers_.layer(place)).index()] != 0;
      if (active && largest_difference(sides[1], sides[0]) > tolerance) cell({i, j, layers_.layer(place)}, sides);
    }
  }

 private:
  [[nodiscard]] bool is_clear(std::int64_t i, std::int64_t j, const DepthRange& range) const {
    for (int c = 0; c < 4; ++c) {
      const auto [along_i, along_j] = pairs_at(i, j, c);
      // Seen from the high side both vectors point backwards, so that the product of one of them turns its sign.
      const double sign = (c == 1 || c == 2) ? -orientation_ : orientation_;
      const std::array a{along_i.at(range.low), along_i.at(range.high)};
      const std::array b{along_j.at(range.low), along_j.at(range.high)};
      for (const Vec2& u : a)
        for (const Vec2& v : b)
          if (!(sign * cross(u, v) > rounding * u.norm() * v.norm())) return false;
    }
    return true;
  }

  /// From the pillar at corner c = di + 2 dj of a column to its neighbours along i and j.
  [[nodiscard]] std::array<PillarPair, 2> pairs_at(std::int64_t i, std::int64_t j, int c) const {
    const std::array<std::int64_t, 2> here{i + (c & 1), j + (c >> 1)};
    return {PillarPair(grid_, here, {i + 1 - (c & 1), here[1]}), PillarPair(grid_, here, {here[0], j + 1 - (c >> 1)})};
  }

  /// Corners (di, dj, side), side 1 the lower one, at di + 2 dj + 4 side.
  [[nodiscard]] std::array<Vec3, 8> corners(const Place& at, const std::array<Depths, 2>& sides) const {
    std::array<Vec3, 8> out;
    for (std::size_t n = 0; n < 8; ++n)
      out[n] = grid_.pillar_point(at[0] + static_cast<std::int64_t>(n & 1),
                                  at[1] + static_cast<std::int64_t>((n >> 1) & 1), sides[n >> 2][n & 3]);
    return out;
  }

  void cell(const Place& at, const std::array<Depths, 2>& sides) {
    const std::array<Vec3, 8> points = corners(at, sides);
    if (const double volume = orientation_ * bilinear_hexahedron_volume(points);
        !(volume > 0.0) || is_rounding(volume, points)) {
      add(out_, GridOddity::negative_volume, {at, no_place, -volume});
      return;
    }
    double least = 1.0;
    std::array<int, 2> turned{};  // corners of the top and of the base that run the wrong way round
    for (std::size_t n = 0; n < 8; ++n) {
      const double jacobian = scaled_jacobian(points, n);
      least = std::min(least, jacobian);
      if (jacobian < -rounding) ++turned[n >> 2];
    }
    if (!(least < rounding)) return;
    // A quad whose corners turn two one way and two the other crosses itself; with one it is concave.
    const bool is_bow_tie = turned[0] == 2 || turned[1] == 2;
    const bool overlaps = least < 0.0 && (is_bow_tie || pillars_cross(at, sides));
    add(out_, overlaps ? GridOddity::self_overlapping : GridOddity::twisted, {at, no_place, least});
  }

  /// At a corner: the volume of its three edges over the product of their lengths. 1 where an edge has no length.
  [[nodiscard]] double scaled_jacobian(const std::array<Vec3, 8>& points, std::size_t n) const {
    const auto edge = [&](std::size_t bit) { return Vec3(points[n | bit] - points[n & ~bit]); };
    const Vec3 u = edge(1);
    const Vec3 v = edge(2);
    const Vec3 w = edge(4);
    const double lengths = u.norm() * v.norm() * w.norm();
    if (!(u.norm() > tolerance) || !(v.norm() > tolerance) || !(w.z() > tolerance)) return 1.0;
    return orientation_ * u.dot(v.cross(w)) / lengths;
  }

  [[nodiscard]] bool pillars_cross(const Place& at, const std::array<Depths, 2>& sides) const {
    for (int c : {0, 3})  // two opposite corners have all four pairs
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto one = static_cast<std::size_t>(c);
        const std::size_t other = one ^ (axis == 0 ? 1U : 2U);
        const DepthRange range{std::min(sides[0][one], sides[0][other]), std::max(sides[1][one], sides[1][other])};
        if (pairs_at(at[0], at[1], c)[axis].turn(range) > passing_angle) return true;
      }
    return false;
  }

  const Layers& layers_;
  const CornerPointGrid& grid_;
  double orientation_;  ///< 1: i, j, depth are right-handed; -1
  GridValidity& out_;
};

class ValidityCheck {
 public:
  explicit ValidityCheck(const CornerPointGrid& grid)
      : grid_(grid), layers_{grid, is_upside_down(grid)}, nx_(grid.dimensions[0]), ny_(grid.dimensions[1]) {}

  /// `left_handed`: as HostMesh says; unset: found out here.
  GridValidity check(std::optional<bool> left_handed) {
    ranges_.resize(static_cast<std::size_t>(nx_ * ny_));
    over_rows(ny_, [&](std::int64_t j, GridValidity& out) { RowScan(layers_, j, &ranges_[index(0, j)], out).scan(); });
    const bool mirrored = left_handed ? *left_handed != layers_.upside_down : is_mirrored();
    const double orientation = mirrored ? -1.0 : 1.0;
    over_rows(ny_, [&](std::int64_t j, GridValidity& out) {
      ColumnCheck check(layers_, orientation, out);
      for (std::int64_t i = 0; i < nx_; ++i) check.column(i, j, ranges_[index(i, j)]);
    });
    over_rows(ny_ + 1, [&](std::int64_t j, GridValidity& out) {
      for (std::int64_t i = 0; i <= nx_; ++i) {
        if (i < nx_) check_pillars({i, j}, {i + 1, j}, {i, j - 1}, {i, j}, out);
        if (j < ny_) check_pillars({i, j}, {i, j + 1}, {i - 1, j}, {i, j}, out);
      }
    });
    return std::move(all_);
  }

 private:
  using Column = std::array<std::int64_t, 2>;

  [[nodiscard]] std::size_t index(std::int64_t i, std::int64_t j) const {
    return static_cast<std::size_t>(i + nx_ * j);
  }

  /// Runs rows side by side and joins what they found in their order.
  void over_rows(std::int64_t count, const std::function<void(std::int64_t, GridValidity&)>& row) {
    std::vector<GridValidity> parts(static_cast<std::size_t>(count));
    tbb::parallel_for(std::int64_t{0}, count, [&](std::int64_t j) { row(j, parts[static_cast<std::size_t>(j)]); });
    for (const GridValidity& part : parts) join(all_, part);
  }

  /// The sign of the columns' volumes, each its area in plan half way down times its height.
  [[nodiscard]] bool is_mirrored() const {
    double total = 0.0;
    for (std::int64_t j = 0; j < ny_; ++j)
      for (std::int64_t i = 0; i < nx_; ++i) {
        const DepthRange& range = ranges_[index(i, j)];
        if (range.empty()) continue;
        const double depth = 0.5 * (range.low + range.high);
        const Vec2 a = PillarPair(grid_, {i, j}, {i + 1, j + 1}).at(depth);
        const Vec2 b = PillarPair(grid_, {i + 1, j}, {i, j + 1}).at(depth);
        total += 0.5 * cross(a, b) * (range.high - range.low);
      }
    return total < 0.0;
  }

  /// Two pillars with the columns on either side of the strip between them.
  void check_pillars(Column from, Column to, Column one, Column other, GridValidity& out) const {
    DepthRange range;
    for (const Column& c : {one, other})
      if (c[0] >= 0 && c[1] >= 0 && c[0] < nx_ && c[1] < ny_) range.add(ranges_[index(c[0], c[1])]);
    if (range.empty()) return;
    const double angle = PillarPair(grid_, from, to).turn(range);
    if (angle > passing_angle)
      add(out, GridOddity::crossing_pillars, {{from[0], from[1], -1}, {to[0], to[1], -1}, angle});
  }

  const CornerPointGrid& grid_;
  Layers layers_;
  std::int64_t nx_;
  std::int64_t ny_;
  std::vector<DepthRange> ranges_;  ///< of each column
  GridValidity all_;
};

/// Parts of fault faces with an existing cell on one side and no cell on the other.
std::int64_t count_open_fault_faces(const HostFaces& faces) {
  const auto count = [&](const tbb::blocked_range<std::size_t>& range, std::int64_t sum) {
    for (std::size_t f = range.begin(); f < range.end(); ++f)
      sum += faces.is_fault[FaceId(f)] != 0 && !faces.cells[FaceId(f)][1].is_valid() ? 1 : 0;
    return sum;
  };
  return tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, faces.size()), std::int64_t{0}, count, std::plus<>());
}

}  // namespace

GridValidity check_host_validity(const CornerPointGrid& grid) {
  validate(grid);
  return ValidityCheck(grid).check(std::nullopt);
}

GridValidity check_host_validity(const CornerPointGrid& grid, const HostMesh& mesh) {
  validate(grid);
  GridValidity validity = ValidityCheck(grid).check(mesh.left_handed);
  validity.open_fault_faces = count_open_fault_faces(mesh.faces);
  return validity;
}

}  // namespace wellknit
