// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Pillars are independent of each other. On one, corners that must stay together are joined into levels: those of a
// column that coincide, and those of all columns that belong to one horizon of an active cell with thickness. A level
// gets one depth when that neither closes nor opens a layer; the check of the levels' order only ever takes levels out,
// so it ends. The method is our own.

#include "algorithm/heal_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <span>

#include "algorithm/cell_locator.h"
#include "algorithm/cell_path.h"
#include "algorithm/host_pillars.h"
#include "algorithm/host_row.h"

namespace wellknit {

namespace {

/// Columns on all sides of a crossed one that are healed too: the cavity's wall keeps its distance from the tube.
constexpr std::int64_t columns_around = 2;
/// The same as a distance from the path in drainage radii.
constexpr double radii_around = 3.0;
/// The default limit as a part of the mean layer thickness: less than what separates two layers' flow.
constexpr double default_part_of_thickness = 0.1;
/// A layer keeps at least this part of its thickness at a pillar; four columns' mean alone leaves a quarter.
constexpr double least_part_kept = 0.1;

using Place = std::array<std::int64_t, 2>;

double distance_in_plan(const Vec3& point, const CellPart& part) {
  const Eigen::Vector2d a = part.entry.head<2>();
  const Eigen::Vector2d along = part.exit.head<2>() - a;
  const double square = along.squaredNorm();
  const double t = square > 0.0 ? std::clamp((point.head<2>() - a).dot(along) / square, 0.0, 1.0) : 0.0;
  return (point.head<2>() - a - t * along).norm();
}

/// Which columns are around the wells' paths.
class ColumnsAround {
 public:
  ColumnsAround(const CornerPointGrid& grid, const std::vector<Well>& wells)
      : grid_(grid), is_near_(static_cast<std::size_t>(grid.dimensions[0] * grid.dimensions[1]), 0) {
    const CellLocator locator(grid);
    for (const Well& well : wells)
      for (const CellPart& part : cells_along(grid, locator, well.trajectory)) {
        const auto [i, j, k] = grid.ijk(part.cell);
        add_block({i, j});
        add_within(radii_around * well.radial.drainage_radius, part, {i, j});
      }
  }

  [[nodiscard]] bool holds(std::int64_t i, std::int64_t j) const {
    return i >= 0 && j >= 0 && i < grid_.dimensions[0] && j < grid_.dimensions[1] &&
           is_near_[static_cast<std::size_t>(i + grid_.dimensions[0] * j)] != 0;
  }

 private:
  void add(Place at) { is_near_[static_cast<std::size_t>(at[0] + grid_.dimensions[0] * at[1])] = 1; }

  void add_block(Place at) {
    for (std::int64_t j = std::max<std::int64_t>(0, at[1] - columns_around);
         j <= std::min(grid_.dimensions[1] - 1, at[1] + columns_around); ++j)
      for (std::int64_t i = std::max<std::int64_t>(0, at[0] - columns_around);
           i <= std::min(grid_.dimensions[0] - 1, at[0] + columns_around); ++i)
        add({i, j});
  }

  /// From the crossed column outwards while columns are near enough.
  void add_within(double distance, const CellPart& part, Place from) {
    std::set<Place> seen{from};
    std::vector<Place> next{from};
    while (!next.empty()) {
      const Place at = next.back();
      next.pop_back();
      add(at);
      for (const Place& step : {Place{-1, 0}, Place{1, 0}, Place{0, -1}, Place{0, 1}}) {
        const Place to{at[0] + step[0], at[1] + step[1]};
        if (to[0] < 0 || to[1] < 0 || to[0] >= grid_.dimensions[0] || to[1] >= grid_.dimensions[1]) continue;
        if (is_within(distance, part, to) && seen.insert(to).second) next.push_back(to);
      }
    }
  }

  /// The circle around the column at the path's depth is that near.
  [[nodiscard]] bool is_within(double distance, const CellPart& part, Place column) const {
    const double depth = 0.5 * (part.entry.z() + part.exit.z());
    std::array<Vec3, 4> corners;
    for (int c = 0; c < 4; ++c)
      corners[static_cast<std::size_t>(c)] = grid_.pillar_point(column[0] + (c & 1), column[1] + (c >> 1), depth);
    const Vec3 middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
    double radius = 0.0;
    for (const Vec3& c : corners) radius = std::max(radius, (c - middle).norm());
    return distance_in_plan(middle, part) <= distance + radius;
  }

  const CornerPointGrid& grid_;
  std::vector<std::uint8_t> is_near_;
};

/// Corners of a grid by levels, 0 the uppermost, whichever way its layers are numbered.
class Levels {
 public:
  explicit Levels(const CornerPointGrid& grid) : grid_(grid), upside_down_(is_upside_down(grid)) {}

  [[nodiscard]] std::int64_t count() const { return 2 * grid_.dimensions[2]; }
  [[nodiscard]] std::int64_t layer(std::int64_t level) const {
    return upside_down_ ? grid_.dimensions[2] - 1 - level / 2 : level / 2;
  }
  /// Place in zcorn of a level of corner di + 2 dj of a column.
  [[nodiscard]] std::size_t place(Place column, int corner, std::int64_t level) const {
    const std::int64_t k2 = upside_down_ ? count() - 1 - level : level;
    return grid_.zcorn_index({column[0], column[1], k2 / 2}, corner & 1, corner >> 1, static_cast<int>(k2 & 1));
  }
  [[nodiscard]] double depth(Place column, int corner, std::int64_t level) const {
    return grid_.zcorn[place(column, corner, level)];
  }
  /// Active, and not of zero thickness on all four pillars: its corners are a reason to heal.
  [[nodiscard]] bool counts(Place column, std::int64_t level) const {
    return grid_.active[grid_.cell_id(column[0], column[1], layer(level)).index()] != 0 && is_thick(column, level);
  }
  [[nodiscard]] bool is_thick(Place column, std::int64_t level) const {
    for (int corner = 0; corner < 4; ++corner)
      if (thickness(column, corner, level) > pillar_merge_tolerance) return true;
    return false;
  }
  [[nodiscard]] double thickness(Place column, int corner, std::int64_t level) const {
    const std::int64_t upper = level - level % 2;
    return depth(column, corner, upper + 1) - depth(column, corner, upper);
  }

 private:
  const CornerPointGrid& grid_;
  bool upside_down_;
};

/// The corners of one pillar, and which of them get one new depth.
class PillarHealer {
 public:
  PillarHealer(const CornerPointGrid& grid, const Levels& levels, double limit)
      : grid_(grid), levels_(levels), limit_(limit) {}

  /// Moves the corners of pillar (i, j) in `out` and counts what was done there.
  void heal(std::int64_t i, std::int64_t j, HealedFaults& out) {
    read(i, j);
    if (columns_.size() < 2) return;
    join();
    collect();
    keep_order();
    write(out);
  }

 private:
  struct Column {
    Place at{};
    int corner = 0;
    std::vector<double> depth;             ///< falling levels are at the one before, as the host takes them
    std::vector<std::uint8_t> counts;      ///< per level
    std::vector<std::uint8_t> is_thick;    ///< per level; of inactive cells too
    std::vector<std::size_t> cluster;      ///< per level: rises by one where the depth does
    std::vector<std::uint8_t> has_reason;  ///< per cluster: one of its levels counts
  };

  enum class State : std::uint8_t { matched, healed, beyond, kept };

  struct Level {
    std::array<std::size_t, 4> cluster{};  ///< of each column; with has_cluster
    std::array<bool, 4> has_cluster{};
    double least = std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();
    double sum = 0.0;
    int counted = 0;        ///< columns in `sum`
    bool is_single = true;  ///< no column has two depths in it
    State state = State::matched;

    [[nodiscard]] double target() const { return sum / counted; }
  };

  void read(std::int64_t i, std::int64_t j) {
    columns_.clear();
    for (int corner = 0; corner < 4; ++corner) {
      const Place at{i - (corner & 1), j - (corner >> 1)};
      if (at[0] < 0 || at[1] < 0 || at[0] >= grid_.dimensions[0] || at[1] >= grid_.dimensions[1]) continue;
      Column column{at, corner, {}, {}, {}, {}, {}};
      for (std::int64_t l = 0; l < levels_.count(); ++l) {
        const double depth = levels_.depth(at, corner, l);
        const double above = l == 0 ? depth : column.depth.back();
        column.depth.push_back(std::max(depth, above));
        column.counts.push_back(levels_.counts(at, l) ? 1 : 0);
        column.is_thick.push_back(levels_.is_thick(at, l) ? 1 : 0);
        const std::size_t step = column.depth.back() - above > pillar_merge_tolerance ? 1 : 0;
        column.cluster.push_back(l == 0 ? 0 : column.cluster.back() + step);
        column.has_reason.resize(column.cluster.back() + 1, 0);
        column.has_reason.back() |= column.counts.back();
      }
      columns_.push_back(std::move(column));
    }
  }

  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(levels_.count()); }

  std::size_t root(std::size_t item) {
    while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
    return item;
  }
  void unite(std::size_t a, std::size_t b) {
    const std::size_t from = root(a);
    const std::size_t to = root(b);
    parent_[std::max(from, to)] = std::min(from, to);
  }

  /// Corners that must stay or come together get one root.
  void join() {
    parent_.resize(columns_.size() * size());
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (std::size_t c = 0; c < columns_.size(); ++c)
      for (std::size_t l = 0; l < size(); ++l) {
        const Column& column = columns_[c];
        if (l > 0 && column.cluster[l] == column.cluster[l - 1]) unite(c * size() + l - 1, c * size() + l);
        for (std::size_t d = 0; d < c; ++d)
          if (belong_together(columns_[d], column, l)) unite(d * size() + l, c * size() + l);
      }
  }

  /// Corners of inactive cells follow within the limit, those of cells without thickness where they coincide.
  [[nodiscard]] bool belong_together(const Column& a, const Column& b, std::size_t level) const {
    if (a.counts[level] != 0 && b.counts[level] != 0) return true;
    if (a.counts[level] == 0 && b.counts[level] == 0) return false;
    const bool both_thick = a.is_thick[level] != 0 && b.is_thick[level] != 0;
    return std::abs(a.depth[level] - b.depth[level]) <= (both_thick ? limit_ : pillar_merge_tolerance);
  }

  void collect() {
    found_.clear();
    level_of_.assign(parent_.size(), 0);
    for (std::size_t item = 0; item < parent_.size(); ++item) {
      const std::size_t from = root(item);
      if (from == item) {
        level_of_[item] = found_.size();
        found_.emplace_back();
      }
      level_of_[item] = level_of_[from];
      add_corner(found_[level_of_[item]], item / size(), item % size());
    }
    for (Level& level : found_) level.state = first_state(level);
  }

  void add_corner(Level& level, std::size_t c, std::size_t l) {
    const Column& column = columns_[c];
    if (level.has_cluster[c]) {
      level.is_single = level.is_single && level.cluster[c] == column.cluster[l];
      return;
    }
    level.has_cluster[c] = true;
    level.cluster[c] = column.cluster[l];
    const double depth = column.depth[l];
    level.least = std::min(level.least, depth);
    level.most = std::max(level.most, depth);
    if (column.has_reason[column.cluster[l]] == 0) return;
    level.sum += depth;
    ++level.counted;
  }

  [[nodiscard]] State first_state(const Level& level) const {
    if (level.counted == 0 || level.most - level.least <= pillar_merge_tolerance) return State::matched;
    if (!level.is_single) return State::kept;
    return level.most - level.least > limit_ ? State::beyond : State::healed;
  }

  [[nodiscard]] Level& level_at(std::size_t c, std::size_t l) { return found_[level_of_[c * size() + l]]; }

  [[nodiscard]] double depth_after(std::size_t c, std::size_t l) {
    const Level& level = level_at(c, l);
    return level.state == State::healed ? level.target() : columns_[c].depth[l];
  }

  /// Takes out levels that would cross another one or leave too little of a layer.
  void keep_order() {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t c = 0; c < columns_.size(); ++c)
        for (std::size_t l = 1; l < size(); ++l) {
          const double before = columns_[c].depth[l] - columns_[c].depth[l - 1];
          if (columns_[c].cluster[l] == columns_[c].cluster[l - 1]) continue;
          if (depth_after(c, l) - depth_after(c, l - 1) >= least_part_kept * before) continue;
          for (Level* level : {&level_at(c, l - 1), &level_at(c, l)})
            if (level->state == State::healed) {
              level->state = State::kept;
              changed = true;
            }
        }
    }
  }

  void write(HealedFaults& out) {
    const std::int64_t before = out.levels_healed;
    for (const Level& level : found_) {
      out.levels_beyond += level.state == State::beyond ? 1 : 0;
      out.levels_kept += level.state == State::kept ? 1 : 0;
      if (level.state != State::healed) continue;
      ++out.levels_healed;
      out.largest_throw = std::max(out.largest_throw, level.most - level.least);
    }
    if (out.levels_healed == before) return;
    ++out.pillars_healed;
    for (std::size_t c = 0; c < columns_.size(); ++c)
      for (std::size_t l = 0; l < size(); ++l)
        if (const Level& level = level_at(c, l); level.state == State::healed)
          out.grid.zcorn[levels_.place(columns_[c].at, columns_[c].corner, static_cast<std::int64_t>(l))] =
              level.target();
  }

  const CornerPointGrid& grid_;
  const Levels& levels_;
  double limit_;
  std::vector<Column> columns_;
  std::vector<std::size_t> parent_;    ///< per corner, column by column
  std::vector<std::size_t> level_of_;  ///< per corner: place in found_
  std::vector<Level> found_;
};

double mean_thickness(const CornerPointGrid& grid, const Levels& levels, const ColumnsAround& around) {
  double sum = 0.0;
  std::int64_t count = 0;
  for (std::int64_t j = 0; j < grid.dimensions[1]; ++j)
    for (std::int64_t i = 0; i < grid.dimensions[0]; ++i) {
      if (!around.holds(i, j)) continue;
      for (std::int64_t l = 0; l < levels.count(); l += 2) {
        if (!levels.counts({i, j}, l)) continue;
        for (int corner = 0; corner < 4; ++corner) sum += 0.25 * std::max(0.0, levels.thickness({i, j}, corner, l));
        ++count;
      }
    }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

/// The columns of pillar (i, j) that are around a well: one is enough.
bool is_around(const ColumnsAround& around, std::int64_t i, std::int64_t j) {
  return around.holds(i - 1, j - 1) || around.holds(i, j - 1) || around.holds(i - 1, j) || around.holds(i, j);
}

/// Volumes as the host takes them, with the sign of the grid's handedness; 0 without thickness.
double signed_volume(const PillarNodes& nodes, Place column, std::int64_t place) {
  const ColumnCorners corners(nodes.corners, nodes.nodes, column[0], column[1]);
  if (!corners.has_thickness(place)) return 0.0;
  const auto points = corners.corners(place);
  const double volume = bilinear_hexahedron_volume(points);
  return is_rounding(volume, points) ? 0.0 : volume;
}

struct VolumeChange {
  HostCellId cell;
  Place column{};
  double before = 0.0;
  double after = 0.0;

  /// A cell neither comes, goes nor turns over.
  [[nodiscard]] bool is_sound() const { return before * after > 0.0 || (before == 0.0 && after == 0.0); }
};

bool has_moved(const CornerPointGrid& grid, const CornerPointGrid& healed, HostCellId cell) {
  for (int corner = 0; corner < 8; ++corner) {
    const std::size_t at = grid.zcorn_index(grid.ijk(cell), corner & 1, (corner >> 1) & 1, corner >> 2);
    if (grid.zcorn[at] != healed.zcorn[at]) return true;
  }
  return false;
}

/// True when a pillar has other nodes than before.
bool has_changed(const PillarNodes& before, const PillarNodes& after, std::size_t pillar) {
  const auto nodes = [pillar](const PillarNodes& p) {
    const std::span all(p.nodes.raw());
    const std::size_t first = p.corners.first[pillar].index();
    const bool is_last = pillar + 1 == p.corners.first.size();
    return all.subspan(first, (is_last ? all.size() : p.corners.first[pillar + 1].index()) - first);
  };
  return !std::ranges::equal(nodes(before), nodes(after));
}

/// Of the active cells with a moved corner, in the order of columns. A corner that lies within the tolerance of nodes
/// from one that was healed may move with their common node, so volumes are compared too.
std::vector<VolumeChange> volume_changes(const CornerPointGrid& grid, const PillarNodes& before,
                                         const CornerPointGrid& healed) {
  std::vector<VolumeChange> out;
  const PillarNodes after = resolve_pillars(healed);
  const std::int64_t nx = grid.dimensions[0];
  const std::int64_t ny = grid.dimensions[1];
  const std::int64_t nz = grid.dimensions[2];
  const auto pillar_has_changed = [&](std::int64_t i, std::int64_t j) {
    return has_changed(before, after, static_cast<std::size_t>(j * (nx + 1) + i));
  };
  for (std::int64_t j = 0; j < ny; ++j)
    for (std::int64_t i = 0; i < nx; ++i) {
      if (!pillar_has_changed(i, j) && !pillar_has_changed(i + 1, j) && !pillar_has_changed(i, j + 1) &&
          !pillar_has_changed(i + 1, j + 1))
        continue;
      for (std::int64_t place = 0; place < nz; ++place) {
        const HostCellId cell = grid.cell_id(i, j, before.corners.layer(place));
        if (grid.active[cell.index()] == 0) continue;
        const VolumeChange change{
            cell, {i, j}, signed_volume(before, {i, j}, place), signed_volume(after, {i, j}, place)};
        if (change.before != change.after || has_moved(grid, healed, cell)) out.push_back(change);
      }
    }
  return out;
}

/// Pore volumes stay those of the source, and the cells are marked.
void keep_pore_volumes(const std::vector<VolumeChange>& changes, HealedFaults& out) {
  if (changes.empty()) return;
  const auto cells = static_cast<std::size_t>(out.grid.cell_count());
  std::vector<double>& multiplier = out.grid.edits.pore_volume_multiplier;
  if (multiplier.empty()) multiplier.assign(cells, 1.0);
  std::vector<std::int32_t> healed(cells, 0);
  for (const VolumeChange& c : changes) {
    healed[c.cell.index()] = 1;
    if (c.before == 0.0) continue;
    multiplier[c.cell.index()] *= c.before / c.after;
    out.changed_bulk_volume += std::abs(c.before);
    out.bulk_volume_change += std::abs(c.after) - std::abs(c.before);
  }
  out.cells_changed = static_cast<std::int64_t>(changes.size());
  out.grid.properties[healed_keyword] = std::move(healed);
}

}  // namespace

HealedFaults heal_faults(const CornerPointGrid& grid, const std::vector<Well>& wells, std::optional<double> limit) {
  validate(grid);
  const ColumnsAround around(grid, wells);
  const Levels levels(grid);
  const double largest = limit.value_or(default_part_of_thickness * mean_thickness(grid, levels, around));
  const PillarNodes before = resolve_pillars(grid);
  std::set<Place> left;  // pillars of cells that healing would turn over
  for (;;) {
    HealedFaults out;
    out.grid = grid;
    out.limit = largest;
    PillarHealer healer(grid, levels, largest);
    for (std::int64_t j = 0; j <= grid.dimensions[1]; ++j)
      for (std::int64_t i = 0; i <= grid.dimensions[0]; ++i)
        if (is_around(around, i, j) && !left.contains({i, j})) healer.heal(i, j, out);
    if (out.levels_healed == 0) return out;
    const std::vector<VolumeChange> changes = volume_changes(grid, before, out.grid);
    const std::size_t known = left.size();
    for (const VolumeChange& c : changes)
      if (!c.is_sound())
        for (int corner = 0; corner < 4; ++corner)
          left.insert({c.column[0] + (corner & 1), c.column[1] + (corner >> 1)});
    if (left.size() > known) continue;
    keep_pore_volumes(changes, out);
    return out;
  }
}

std::vector<std::string> HealedFaults::notes() const {
  std::vector<std::string> out;
  double percent = changed_bulk_volume > 0.0 ? 100.0 * bulk_volume_change / changed_bulk_volume : 0.0;
  if (std::abs(percent) < 1e-6) percent = 0.0;  // rounding
  if (levels_healed == 0)
    out.push_back(fmt::format("fault policy heal: no throw up to {:.3g} m near the wells", limit));
  else
    out.push_back(fmt::format(
        "fault policy heal: {} levels on {} pillars near the wells were brought to their mean depth, the largest throw "
        "{:.3g} m; {} cells changed their shape (property {}), their bulk volume by {:+.3g} %, and kept their pore "
        "volumes",
        levels_healed, pillars_healed, largest_throw, cells_changed, healed_keyword, percent));
  if (levels_beyond > 0)
    out.push_back(
        fmt::format("fault policy heal: {} levels on pillars near the wells are thrown by more than {:.3g} m "
                    "and were left; --heal-throw sets the limit",
                    levels_beyond, limit));
  if (levels_kept > 0)
    out.push_back(fmt::format(
        "fault policy heal: {} levels on pillars near the wells were left, since a layer would have opened, "
        "closed or nearly closed there",
        levels_kept));
  return out;
}

}  // namespace wellknit
