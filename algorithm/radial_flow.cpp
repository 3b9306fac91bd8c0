// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/radial_flow.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wellknit {

namespace {

/// Foot of a point on a segment; `end` tells whether it lies beyond one of the ends.
Vec3 foot_on(const Vec3& from, const Vec3& to, const Vec3& point, double& parameter) {
  const Vec3 along = to - from;
  parameter = (point - from).dot(along) / along.squaredNorm();
  return from + std::clamp(parameter, 0.0, 1.0) * along;
}

/// Flux of grad ln r through a triangle by its three edge middles, r the distance from the line through `foot` along
/// `axis`.
double triangle_flux(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& foot, const Vec3& axis) {
  const Vec3 area = 0.5 * (b - a).cross(c - a);
  double sum = 0.0;
  for (const Vec3& p : {Vec3(0.5 * (a + b)), Vec3(0.5 * (b + c)), Vec3(0.5 * (c + a))}) {
    const Vec3 d = p - foot;
    const Vec3 radial = d - d.dot(axis) * axis;
    sum += area.dot(radial) / radial.squaredNorm() / 3.0;
  }
  return sum;
}

double distance_from_line(const Vec3& point, const Vec3& foot, const Vec3& axis) {
  const Vec3 d = point - foot;
  return (d - d.dot(axis) * axis).norm();
}

}  // namespace

RadialFlow::RadialFlow(const Assembly& assembly) : assembly_(assembly), axes_(assembly.first_transition_cell.size()) {
  for (std::size_t c = 0; c < axes_.size(); ++c)
    for (std::size_t t = assembly.first_tube[c]; t < assembly.first_tube[c + 1]; ++t) {
      const auto& axis = assembly.tubes[t].tube->real.axis;
      std::vector<Piece> pieces;
      for (std::size_t k = 0; k + 1 < axis.size(); ++k) pieces.push_back({axis[k], axis[k + 1]});
      axes_[c].push_back(std::move(pieces));
    }
}

RadialFlow::Nearest RadialFlow::nearest_axis(std::size_t cavity, const Vec3& point) const {
  Nearest out;
  out.distance = out.next_distance = std::numeric_limits<double>::infinity();
  for (const auto& pieces : axes_[cavity]) {
    double best = std::numeric_limits<double>::infinity();
    Vec3 best_foot = Vec3::Zero();
    bool is_beyond = false;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      double parameter = 0.0;
      const Vec3 foot = foot_on(pieces[k].from, pieces[k].to, point, parameter);
      const double distance = (point - foot).norm();
      if (distance >= best) continue;
      best = distance;
      best_foot = foot;
      is_beyond = (k == 0 && parameter < 0.0) || (k + 1 == pieces.size() && parameter > 1.0);
    }
    if (best < out.distance) {
      out.next_distance = out.distance;
      out.distance = best;
      out.foot = best_foot;
      out.is_beyond_end = is_beyond;
    } else {
      out.next_distance = std::min(out.next_distance, best);
    }
  }
  return out;
}

double RadialFlow::factor(CellId first, CellId second, std::span<const Vec3> face) const {
  const auto& starts = assembly_.first_transition_cell;
  const auto cavity = static_cast<std::size_t>(std::distance(
                          starts.begin(), std::upper_bound(starts.begin(), starts.end(), first.value()))) -
                      1;
  const PolygonGeometry g = polygon_geometry(face);
  const Nearest near = nearest_axis(cavity, g.mean);
  if (near.is_beyond_end || !(near.distance > 0.0) || !(g.area > 0.0)) return 1.0;
  const Vec3& p1 = assembly_.mesh.cells.center[first];
  const Vec3& p2 = assembly_.mesh.cells.center[second];
  // Near one tube the axis is straight: the line through the foot, normal to the face's own distance from it.
  const Vec3 out = (g.mean - near.foot).normalized();
  const Vec3 line = p2 - p1;
  Nearest other = nearest_axis(cavity, g.mean + 0.05 * near.distance * out.unitOrthogonal());
  Vec3 axis = other.foot - near.foot;
  if (axis.norm() < 1e-6 * near.distance) {
    other = nearest_axis(cavity, g.mean + 0.05 * near.distance * out.cross(out.unitOrthogonal()));
    axis = other.foot - near.foot;
  }
  if (axis.norm() < 1e-6 * near.distance) return 1.0;
  axis.normalize();
  const double r1 = distance_from_line(p1, near.foot, axis);
  const double r2 = distance_from_line(p2, near.foot, axis);
  if (!(r1 > 0.0) || !(r2 > 0.0)) return 1.0;
  const double drop = std::log(r2 / r1);
  const double radial_part = std::abs(drop) * near.distance / line.norm();  // 1: straight out, 0: around the well
  double flux = 0.0;
  for (std::size_t i = 0; i < face.size(); ++i)
    flux += triangle_flux(g.mean, face[i], face[(i + 1) % face.size()], near.foot, axis);
  const double linear = std::abs(g.area_vector.dot(line)) / line.squaredNorm();
  if (radial_part < 0.1 || !(linear > 0.0)) return 1.0;
  const double full = std::clamp(std::abs(flux / drop) / linear, 0.5, 2.0);
  // Fades where the line of centres turns around the well, and where another tube comes as near as this one.
  const double turn = std::clamp((radial_part - 0.1) / 0.2, 0.0, 1.0);
  const double alone = std::clamp(near.next_distance / near.distance - 1.0, 0.0, 1.0);
  return 1.0 + turn * alone * (full - 1.0);
}

}  // namespace wellknit
