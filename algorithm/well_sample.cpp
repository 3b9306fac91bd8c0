// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/well_sample.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algorithm/well_path.h"
#include "model/errors.h"

namespace wellknit {

namespace {

constexpr int sample_count = 500;        ///< along a well, to measure lengths
constexpr double least_radius = 0.5;     ///< m
constexpr double bores_in_radius = 5.0;  ///< a smaller drainage radius than this many bore radii makes no mesh
/// Drainage radii in the length of a well whose radius is made smaller: thinner tubes cost too many cells.
constexpr double most_radii_long = 1500.0;

/// From the first to the last place inside the grid, and one step beyond; the whole path where there is none.
MeasuredDepthRange range_in_grid(const CellLocator& locator, const WellPath& path) {
  constexpr int steps = 2000;
  const double step = (path.last_depth() - path.first_depth()) / steps;
  MeasuredDepthRange range{path.last_depth(), path.first_depth()};
  HostCellId hint;
  for (int i = 0; i <= steps; ++i) {
    const double md = path.first_depth() + step * i;
    const auto location = locator.locate(path.point(md), hint);
    if (!location) continue;
    hint = location->cell;
    range.from = std::min(range.from, std::max(path.first_depth(), md - step));
    range.to = std::max(range.to, std::min(path.last_depth(), md + step));
  }
  return range.from < range.to ? range : MeasuredDepthRange{path.first_depth(), path.last_depth()};
}

/// Two wells that run beside each other over more than a tenth of either share the room between them.
void limit_radii(const std::vector<Well>& wells, const std::vector<WellSample>& samples, std::size_t a, std::size_t b,
                 std::vector<RadiusLimit>& limits) {
  if (wells[a].parent == wells[b].name || wells[b].parent == wells[a].name) return;
  const double both = wells[a].radial.drainage_radius + wells[b].radial.drainage_radius;
  std::array<std::vector<Vec3>, 2> points;
  for (const auto& [w, at] : {std::pair(a, std::size_t{0}), std::pair(b, std::size_t{1})}) {
    const WellPath path(wells[w].trajectory);
    for (const PathCell& c : samples[w].cells) points[at].push_back(path.point(c.measured_depth));
  }
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t close = 0;
  for (const Vec3& p : points[0]) {
    double d = std::numeric_limits<double>::infinity();
    for (const Vec3& q : points[1]) d = std::min(d, (p - q).squaredNorm());
    d = std::sqrt(d);
    nearest = std::min(nearest, d);
    close += d < 1.35 * both ? 1 : 0;
  }
  if (static_cast<double>(close) <= 0.1 * static_cast<double>(std::min(points[0].size(), points[1].size()))) return;
  for (const auto& [w, other] : {std::pair(a, b), std::pair(b, a)}) {
    const double limit = nearest / 1.35 * wells[w].radial.drainage_radius / both;
    if (limit >= limits[w].most || limit >= wells[w].radial.drainage_radius ||
        limit < smallest_radius(wells[w], samples[w]))
      continue;
    limits[w] = {limit, fmt::format("well {} comes within {:.1f} m of it", wells[other].name, nearest)};
  }
}

}  // namespace

double WellSample::share(const std::vector<MeasuredDepthRange>& ranges) const {
  double inside = 0.0;
  double all = 0.0;
  for (const PathCell& c : cells) {
    if (!c.exists) continue;
    all += c.weight;
    if (std::any_of(ranges.begin(), ranges.end(), [&](const MeasuredDepthRange& r) {
          return c.measured_depth >= r.from && c.measured_depth <= r.to;
        }))
      inside += c.weight;
  }
  return all > 0.0 ? inside / all : 0.0;
}

WellSample sample_well(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator,
                       const Well& well) {
  WellSample out;
  std::vector<PathCell>& cells = out.cells;
  const WellPath path(well.trajectory);
  const MeasuredDepthRange inside = range_in_grid(locator, path);
  const double step = (inside.to - inside.from) / sample_count;
  HostCellId hint;
  double in_rock = 0.0;
  for (int i = 0; i <= sample_count; ++i) {
    const double md = inside.from + step * i;
    const auto location = locator.locate(path.point(md), hint);
    if (!location) continue;
    hint = location->cell;
    auto at = grid.ijk(hint);
    at[2] = host.corners.layer(at[2]);
    const double weight = well.trajectory.moved.measured_depth.empty()
                              ? 1.0
                              : (path.original(md + 0.5 * step) - path.original(md - 0.5 * step)) / step;
    cells.push_back({md, path.point(md).z(), at, host.exists[hint] != 0, weight});
    in_rock += cells.back().exists ? weight : 0.0;
  }
  const double most = path.original(inside.from + step * sample_count) - path.original(inside.from);
  out.length_in_rock = std::min(most, step * in_rock);
  if (cells.empty()) {
    const Vec3& a = well.trajectory.points.front();
    const Vec3& b = well.trajectory.points.back();
    throw InvalidInput(fmt::format(
        "well {} does not meet the grid: its path runs from ({:.1f}, {:.1f}, {:.1f}) to ({:.1f}, {:.1f}, {:.1f}); "
        "check its coordinates, units and depth sign",
        well.name, a.x(), a.y(), a.z(), b.x(), b.y(), b.z()));
  }
  return out;
}

std::vector<RadiusLimit> radius_limits(const std::vector<Well>& wells, const std::vector<WellSample>& samples) {
  std::vector<RadiusLimit> limits(wells.size());
  for (std::size_t a = 0; a < wells.size(); ++a)
    for (std::size_t b = a + 1; b < wells.size(); ++b) limit_radii(wells, samples, a, b, limits);
  return limits;
}

double smallest_radius(const Well& well, const WellSample& sample) {
  return std::min(well.radial.drainage_radius, std::max({least_radius, bores_in_radius * well.radial.bore_radius,
                                                         sample.length_in_rock / most_radii_long}));
}

}  // namespace wellknit
