// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// D. W. Peaceman, "Interpretation of well-block pressures in numerical reservoir simulation with nonsquare grid blocks
// and anisotropic permeability", SPE Journal 23(3), 1983 (key Peaceman1983): the equivalent radius. Schlumberger,
// manuals of Schedule and ECLIPSE (projection of a path): a path's index is the length of the vector of the indices of
// its projections on the cell's three axes.
//
// For axis a with the other two b, c:  WI_a = 2 pi sqrt(k_b k_c) L_a / (ln(r_o / r_w) + skin),  WI = |(WI_x, WI_y,
// WI_z)|. L_a is the path's share of the cell along a, from its (u, v, w), times the cell's size along a: a path from
// face to face counts the whole size, whatever the cell's slant. Net-to-gross shortens the cell along k, as in
// simulators.

#include "algorithm/peaceman.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "model/errors.h"
#include "model/units.h"

namespace wellknit {

namespace {

/// What a COMPDAT record without a diameter means.
constexpr double default_diameter = metre_per_foot;

/// A cell as its wells see it.
struct WellCell {
  Vec3 size;          ///< m, net along k
  Vec3 permeability;  ///< m2; 0 where not given
};

WellCell well_cell(const CornerPointGrid& grid, HostCellId cell) {
  WellCell out{well_cell_size(grid, cell), Vec3::Zero()};
  if (!grid.net_to_gross.empty()) out.size[2] *= grid.net_to_gross[cell.index()];
  for (int axis = 0; axis < 3; ++axis) {
    const auto& values = grid.permeability[static_cast<std::size_t>(axis)];
    if (!values.empty()) out.permeability[axis] = values[cell.index()];
  }
  return out;
}

/// The two axes across `axis`.
std::array<int, 2> across(int axis) { return {(axis + 1) % 3, (axis + 2) % 3}; }

struct Bore {
  double radius;
  double skin;
};

/// ln(r_o / r_w) + skin for a bore along `axis`.
double resistance(const CornerPointGrid& grid, HostCellId id, const WellCell& cell, int axis, const Bore& bore) {
  const auto [b, c] = across(axis);
  const double radius = peaceman_radius(cell.permeability[b], cell.permeability[c], cell.size[b], cell.size[c]);
  const double value = std::log(radius / bore.radius) + bore.skin;
  if (value > 0.0) return value;
  const auto [i, j, k] = grid.ijk(id);
  throw InvalidInput(fmt::format(
      "the bore of radius {} m with skin {} is too wide for cell ({}, {}, {}), whose equivalent radius is {:.4g} m; "
      "use a smaller radius or a higher skin",
      bore.radius, bore.skin, i + 1, j + 1, k + 1, radius));
}

/// sqrt(k_b k_c): permeability across `axis`.
double permeability_across(const WellCell& cell, int axis) {
  const auto [b, c] = across(axis);
  return std::sqrt(cell.permeability[b] * cell.permeability[c]);
}

double index_along(const CornerPointGrid& grid, HostCellId id, const WellCell& cell, int axis, double length,
                   const Bore& bore) {
  const double k = permeability_across(cell, axis);
  if (!(k > 0.0) || !(length > 0.0)) return 0.0;
  return 2.0 * std::numbers::pi * k * length / resistance(grid, id, cell, axis, bore);
}

/// Shares [from, to] of the part, each in [0, 1], that are open.
std::vector<std::array<double, 2>> open_shares(const Well& well, const MeasuredDepthRange& part) {
  if (well.open.empty()) return {{0.0, 1.0}};
  std::vector<std::array<double, 2>> shares;
  const double span = part.to - part.from;
  for (const MeasuredDepthRange& range : well.open) {
    const double from = std::max(range.from, part.from);
    const double to = std::min(range.to, part.to);
    if (to > from) shares.push_back({(from - part.from) / span, (to - part.from) / span});
  }
  return shares;
}

/// Share of the cell along each of its axes between two points in it; outside by rounding at most.
Vec3 share_of_cell(const std::array<Vec3, 8>& corners, const Vec3& from, const Vec3& to) {
  const auto a = inverse_trilinear(corners, from);
  const auto b = inverse_trilinear(corners, to);
  if (!a || !b) return Vec3::Zero();
  const auto clamped = [](const Vec3& uvw) { return Vec3(uvw.cwiseMax(0.0).cwiseMin(1.0)); };
  return (clamped(*b) - clamped(*a)).cwiseAbs();
}

/// What the open parts of a path add up to in one cell.
struct CellSum {
  HostCellId cell;
  Vec3 share = Vec3::Zero();
  MeasuredDepthRange measured_depth;
};

std::vector<CellSum> sum_by_cell(const CornerPointGrid& grid, const HostMesh& host, const Well& well,
                                 const std::vector<CellPart>& parts) {
  std::vector<CellSum> sums;
  std::map<HostCellId, std::size_t> place;
  for (const CellPart& part : parts) {
    if (host.exists[part.cell] == 0) continue;
    const auto corners = grid.corners(part.cell);
    const double span = part.measured_depth.to - part.measured_depth.from;
    for (const auto& [from, to] : open_shares(well, part.measured_depth)) {
      const MeasuredDepthRange range{part.measured_depth.from + from * span, part.measured_depth.from + to * span};
      const auto [found, is_new] = place.try_emplace(part.cell, sums.size());
      if (is_new) sums.push_back({part.cell, Vec3::Zero(), range});
      CellSum& sum = sums[found->second];
      const Vec3 along = part.exit - part.entry;
      sum.share += share_of_cell(corners, part.entry + from * along, part.entry + to * along);
      sum.measured_depth.from = std::min(sum.measured_depth.from, range.from);
      sum.measured_depth.to = std::max(sum.measured_depth.to, range.to);
    }
  }
  return sums;
}

int axis_of(char direction) { return direction == 'X' ? 0 : direction == 'Y' ? 1 : 2; }

double completion_index(const CornerPointGrid& grid, const DeckCompletion& completion) {
  if (completion.connection_factor) return *completion.connection_factor;
  const WellCell cell = well_cell(grid, completion.cell);
  const int axis = axis_of(completion.direction);
  const double diameter = completion.diameter > 0.0 ? completion.diameter : default_diameter;
  const Bore bore{0.5 * diameter, completion.skin};
  if (!completion.permeability_thickness) return index_along(grid, completion.cell, cell, axis, cell.size[axis], bore);
  if (!(permeability_across(cell, axis) > 0.0)) return 0.0;
  return 2.0 * std::numbers::pi * *completion.permeability_thickness /
         resistance(grid, completion.cell, cell, axis, bore);
}

/// Measured depths of the trajectory in the cell; where it misses the cell, that of its nearest station.
MeasuredDepthRange depths_in(const CornerPointGrid& grid, HostCellId cell, const Well& well,
                             const std::vector<CellPart>& parts) {
  MeasuredDepthRange range;
  bool begun = false;
  for (const CellPart& part : parts) {
    if (part.cell != cell) continue;
    range.from = begun ? std::min(range.from, part.measured_depth.from) : part.measured_depth.from;
    range.to = begun ? std::max(range.to, part.measured_depth.to) : part.measured_depth.to;
    begun = true;
  }
  if (begun || well.trajectory.points.empty()) return range;
  const Vec3 centre = trilinear(grid.corners(cell), Vec3::Constant(0.5));
  const auto& points = well.trajectory.points;
  const auto nearest = std::min_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
    return (a - centre).squaredNorm() < (b - centre).squaredNorm();
  });
  range.from = range.to = well.trajectory.measured_depth[static_cast<std::size_t>(nearest - points.begin())];
  return range;
}

}  // namespace

Vec3 well_cell_size(const CornerPointGrid& grid, HostCellId cell) {
  const auto corners = grid.corners(cell);
  std::array<Vec3, 3> between{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (std::size_t c = 0; c < 8; ++c)
    for (std::size_t axis = 0; axis < 3; ++axis) between[axis] += (((c >> axis) & 1U) != 0 ? 0.25 : -0.25) * corners[c];
  return {between[0].head<2>().norm(), between[1].head<2>().norm(), std::abs(between[2][2])};
}

double peaceman_radius(double k_b, double k_c, double d_b, double d_c) {
  const double ratio = std::sqrt(k_c / k_b);
  return 0.28 * std::sqrt(ratio * d_b * d_b + d_c * d_c / ratio) / (std::sqrt(ratio) + 1.0 / std::sqrt(ratio));
}

std::vector<HostWellConnection> peaceman_indices(const CornerPointGrid& grid, const HostMesh& host, const Well& well,
                                                 const std::vector<CellPart>& parts) {
  const Bore bore{well.radial.bore_radius, well.skin};
  std::vector<HostWellConnection> out;
  for (const CellSum& sum : sum_by_cell(grid, host, well, parts)) {
    const WellCell cell = well_cell(grid, sum.cell);
    Vec3 index;
    for (int axis = 0; axis < 3; ++axis)
      index[axis] = index_along(grid, sum.cell, cell, axis, sum.share[axis] * cell.size[axis], bore);
    if (index.norm() > 0.0) out.push_back({sum.cell, index.norm(), sum.measured_depth});
  }
  return out;
}

std::vector<HostWellConnection> completion_indices(const CornerPointGrid& grid, const HostMesh& host, const Well& well,
                                                   const std::vector<CellPart>& parts) {
  std::vector<HostWellConnection> out;
  for (const DeckCompletion& completion : well.completions) {
    if (!completion.open || host.exists[completion.cell] == 0) continue;
    const double index = completion_index(grid, completion);
    if (!(index > 0.0)) continue;
    const HostWellConnection connection{completion.cell, index, depths_in(grid, completion.cell, well, parts)};
    // A later record of the same cell replaces the earlier one.
    const auto same = std::find_if(out.begin(), out.end(), [&](const auto& c) { return c.cell == completion.cell; });
    if (same == out.end())
      out.push_back(connection);
    else
      *same = connection;
  }
  return out;
}

}  // namespace wellknit
