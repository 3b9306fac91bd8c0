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

#include "algorithm/host_transmissibility.h"
#include "algorithm/refined_path.h"
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
  bool is_refined = false;
};

/// A source cell's as the grid gives them.
std::array<Vec3, 8> corner_points(const CornerPointGrid& grid, const HostMesh& host, HostCellId cell) {
  if (cell.index() < host.source_count()) return grid.corners(cell);
  const auto corners = host.corners_of(cell);
  std::array<Vec3, 8> points;
  for (std::size_t n = 0; n < 8; ++n) points[n] = host.vertices[corners[n]];
  return points;
}

Vec3 size_of(const std::array<Vec3, 8>& corners) {
  std::array<Vec3, 3> between{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (std::size_t c = 0; c < 8; ++c)
    for (std::size_t axis = 0; axis < 3; ++axis) between[axis] += (((c >> axis) & 1U) != 0 ? 0.25 : -0.25) * corners[c];
  return {between[0].head<2>().norm(), between[1].head<2>().norm(), std::abs(between[2][2])};
}

WellCell well_cell(const CornerPointGrid& grid, const HostMesh& host, HostCellId cell) {
  const HostRock rock = host_rock(grid, host, cell);
  WellCell out{size_of(corner_points(grid, host, cell)),
               Vec3(rock.permeability[0], rock.permeability[1], rock.permeability[2]), false};
  out.size[2] *= rock.net_to_gross;
  out.is_refined = cell.index() >= host.source_count();
  return out;
}

/// The two axes across `axis`.
std::array<int, 2> across(int axis) { return {(axis + 1) % 3, (axis + 2) % 3}; }

struct Bore {
  double radius;
  double skin;
};

/// ln(r_o / r_w) + skin for a bore along `axis`.
double resistance(const CornerPointGrid& grid, HostCellId source, const WellCell& cell, int axis, const Bore& bore) {
  const auto [b, c] = across(axis);
  double radius = peaceman_radius(cell.permeability[b], cell.permeability[c], cell.size[b], cell.size[c]);
  // A refinement for a tube near by may leave cells that the bore all but fills; their own resistance is then next to
  // nothing beside that of their neighbours.
  constexpr double least_ratio = 1.5;
  if (cell.is_refined) radius = std::max(radius, least_ratio * bore.radius);
  const double value = std::log(radius / bore.radius) + bore.skin;
  if (value > 0.0) return value;
  const auto [i, j, k] = grid.ijk(source);
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

double index_along(const CornerPointGrid& grid, HostCellId source, const WellCell& cell, int axis, double length,
                   const Bore& bore) {
  const double k = permeability_across(cell, axis);
  if (!(k > 0.0) || !(length > 0.0)) return 0.0;
  return 2.0 * std::numbers::pi * k * length / resistance(grid, source, cell, axis, bore);
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
    if (!host.is_cell(part.cell)) continue;
    const auto corners = corner_points(grid, host, part.cell);
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

double completion_index(const CornerPointGrid& grid, const HostMesh& host, const DeckCompletion& completion) {
  if (completion.connection_factor) return *completion.connection_factor;
  const WellCell cell = well_cell(grid, host, completion.cell);
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

/// Weights of the refined cells in a source cell for a completion: their lengths of the path, else those along the line
/// through the cell's middle in the completion's direction.
std::map<HostCellId, double> refined_weights(const CornerPointGrid& grid, const HostMesh& host,
                                             const DeckCompletion& completion, const std::vector<CellPart>& parts) {
  std::vector<CellPart> inside;
  for (const CellPart& part : parts)
    if (part.cell == completion.cell) inside.push_back(part);
  std::map<HostCellId, double> weights;
  for (const CellPart& part : split_at_refined(grid, host, inside).parts)
    if (host.is_cell(part.cell)) weights[part.cell] += (part.exit - part.entry).norm();
  if (!weights.empty()) return weights;
  const auto along = static_cast<std::size_t>(axis_of(completion.direction));
  const RefinedCells& refined = host.refined;
  for (std::size_t c = 0; c < refined.size(); ++c) {
    const HostCellId cell(c + host.source_count());
    for (auto p = static_cast<std::size_t>(refined.piece_start[c]);
         p < static_cast<std::size_t>(refined.piece_start[c + 1]); ++p) {
      if (refined.piece_source[p] != completion.cell || !host.is_cell(cell)) continue;
      const PieceBox& box = refined.piece_box[p];
      bool is_at_middle = true;
      for (std::size_t a = 0; a < 3; ++a)
        is_at_middle = is_at_middle && (a == along || (box.low[a] <= 0.5 && box.high[a] > 0.5));
      if (is_at_middle) weights[cell] += box.high[along] - box.low[along];
    }
  }
  return weights;
}

/// A completion's connections: one, or those of the refined cells in its cell, which share its index.
std::vector<HostWellConnection> connections_of(const CornerPointGrid& grid, const HostMesh& host, const Well& well,
                                               const DeckCompletion& completion, double index,
                                               const std::vector<CellPart>& parts) {
  const MeasuredDepthRange depths = depths_in(grid, completion.cell, well, parts);
  if (!host.is_refined(completion.cell)) return {{completion.cell, index, depths}};
  const auto weights = refined_weights(grid, host, completion, parts);
  double total = 0.0;
  for (const auto& [cell, weight] : weights) total += weight;
  std::vector<HostWellConnection> out;
  for (const auto& [cell, weight] : weights)
    if (weight > 0.0) out.push_back({cell, index * weight / total, depths});
  return out;
}

/// A refined cell over several completed cells gets all they give it.
std::vector<HostWellConnection> added_up(const std::vector<std::vector<HostWellConnection>>& lists) {
  std::vector<HostWellConnection> out;
  std::map<HostCellId, std::size_t> place;
  for (const auto& list : lists)
    for (const HostWellConnection& connection : list) {
      const auto [found, is_new] = place.try_emplace(connection.cell, out.size());
      if (is_new) {
        out.push_back(connection);
        continue;
      }
      HostWellConnection& sum = out[found->second];
      sum.well_index += connection.well_index;
      sum.measured_depth.from = std::min(sum.measured_depth.from, connection.measured_depth.from);
      sum.measured_depth.to = std::max(sum.measured_depth.to, connection.measured_depth.to);
    }
  return out;
}

}  // namespace

Vec3 well_cell_size(const CornerPointGrid& grid, HostCellId cell) { return size_of(grid.corners(cell)); }

double peaceman_radius(double k_b, double k_c, double d_b, double d_c) {
  const double ratio = std::sqrt(k_c / k_b);
  return 0.28 * std::sqrt(ratio * d_b * d_b + d_c * d_c / ratio) / (std::sqrt(ratio) + 1.0 / std::sqrt(ratio));
}

std::vector<HostWellConnection> peaceman_indices(const CornerPointGrid& grid, const HostMesh& host, const Well& well,
                                                 const std::vector<CellPart>& parts) {
  const Bore bore{well.radial.bore_radius, well.skin};
  std::vector<HostWellConnection> out;
  for (const CellSum& sum : sum_by_cell(grid, host, well, parts)) {
    const WellCell cell = well_cell(grid, host, sum.cell);
    Vec3 index;
    for (int axis = 0; axis < 3; ++axis)
      index[axis] = index_along(grid, host.source_of(sum.cell), cell, axis, sum.share[axis] * cell.size[axis], bore);
    if (index.norm() > 0.0) out.push_back({sum.cell, index.norm(), sum.measured_depth});
  }
  return out;
}

std::vector<HostWellConnection> completion_indices(const CornerPointGrid& grid, const HostMesh& host, const Well& well,
                                                   const std::vector<CellPart>& parts) {
  std::vector<std::vector<HostWellConnection>> lists;
  std::map<HostCellId, std::size_t> list_of;
  for (const DeckCompletion& completion : well.completions) {
    if (!completion.open || host.exists[completion.cell] == 0) continue;
    const double index = completion_index(grid, host, completion);
    if (!(index > 0.0)) continue;
    // A later record of the same cell replaces the earlier one.
    const auto [found, is_new] = list_of.try_emplace(completion.cell, lists.size());
    if (is_new) lists.emplace_back();
    lists[found->second] = connections_of(grid, host, well, completion, index, parts);
  }
  return added_up(lists);
}

}  // namespace wellknit
