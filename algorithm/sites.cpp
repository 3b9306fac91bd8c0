// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Notation of method.md §8: c(t) = o_f + t n_f, weight rho_f^2 + t^2.
#include "algorithm/sites.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace wellknit {

namespace {

constexpr double part_of_t_high =
    0.5;  ///< lambda of method.md §8: of its 0.5 to 0.9 the least, for Thiem's flow is met best there
constexpr double shrink = 0.85;   ///< of t, for a site outside of its cell
constexpr int most_shrinks = 60;  ///< 0.85^60 = 6e-5: by then a centrable face has its site
/// Sites closer than this part of their face's radius are one site: two faces of one cell whose natural sites coincide.
constexpr double coincidence = 1e-7;

/// Distances of the two sites of each face along its axis.
struct Offsets {
  std::vector<double> in;
  std::vector<double> out;
};

/// Faces that share one distance: those of one cap; every other face is a group of its own.
std::vector<std::int32_t> groups_of(const Cavity& cavity) {
  std::vector<std::int32_t> group(cavity.faces.size());
  std::map<std::pair<std::size_t, std::int32_t>, std::int32_t> caps;
  for (std::size_t f = 0; f < group.size(); ++f) {
    const BoundaryFace& face = cavity.faces[f];
    group[f] = static_cast<std::int32_t>(f);
    if (face.kind == BoundaryFaceKind::cap)
      group[f] = caps.emplace(std::pair(face.tube, face.radial.segment), group[f]).first->second;
  }
  return group;
}

/// One distance for each group: the smallest its faces allow.
void level_groups(const std::vector<std::int32_t>& group, std::vector<double>& in) {
  for (std::size_t f = 0; f < in.size(); ++f) {
    auto& leader = in[static_cast<std::size_t>(group[f])];
    leader = std::min(leader, in[f]);
  }
  for (std::size_t f = 0; f < in.size(); ++f) in[f] = in[static_cast<std::size_t>(group[f])];
}

Offsets first_offsets(const Cavity& cavity) {
  Offsets t;
  for (const BoundaryFace& f : cavity.faces) {
    const double in = std::min(part_of_t_high * f.t_high, f.natural);
    t.in.push_back(f.t_low > 0.0 ? std::max(in, 0.5 * (f.t_low + f.t_high)) : in);
    // Any outside site between the bounds gives the same face; a natural one keeps the numbers well scaled.
    // The natural one is the centre of the kept cell's box; its sphere passes through all eight corners, so that
    // rounding must not push it out of the bounds that those corners set.
    const bool is_natural = f.natural_outside >= f.t_low - 1e-9 * f.radius;
    t.out.push_back(is_natural ? f.natural_outside : f.t_low + 0.1 * std::min(t.in.back() - f.t_low, f.radius));
  }
  return t;
}

Vec3 on_axis(const BoundaryFace& f, double t) {
  const Vec3 c = f.center + t * f.normal;
  return {on_reference_lattice(c.x()), on_reference_lattice(c.y()), on_reference_lattice(c.z())};
}

struct WeightedPoint {
  Vec3 center;
  double weight;
};

std::vector<WeightedPoint> weighted_points(const Cavity& cavity, const std::vector<double>& t) {
  std::vector<WeightedPoint> points(t.size());
  for (std::size_t f = 0; f < t.size(); ++f) {
    const BoundaryFace& face = cavity.faces[f];
    points[f] = {face.center + t[f] * face.normal, face.radius * face.radius + t[f] * t[f]};
  }
  return points;
}

/// Which inner sites have a smaller power than their own at their centres: 1 where so. Images in the planes never do.
std::vector<std::uint8_t> sites_outside_cells(const std::vector<WeightedPoint>& inner,
                                              const std::vector<WeightedPoint>& outer) {
  std::vector<std::uint8_t> out(inner.size(), 0);
  tbb::parallel_for(std::size_t{0}, inner.size(), [&](std::size_t s) {
    const Vec3& c = inner[s].center;
    // Coincident sites have equal power: rounding must not count.
    const double own = -inner[s].weight * (1.0 + 1e-10);
    const auto wins = [&](const WeightedPoint& p) { return (c - p.center).squaredNorm() - p.weight < own; };
    out[s] = std::any_of(inner.begin(), inner.end(), wins) || std::any_of(outer.begin(), outer.end(), wins) ? 1 : 0;
  });
  return out;
}

/// Makes one site of those that coincide; a hash of the lattice would split pairs at its borders, so neighbours are
/// searched by x.
class SiteList {
 public:
  std::int32_t add(const Vec3& center, double weight, const std::vector<std::int32_t>& loop, double tolerance,
                   std::vector<Site>& sites) {
    for (auto at = by_x_.lower_bound(center.x() - tolerance); at != by_x_.end() && at->first <= center.x() + tolerance;
         ++at) {
      Site& site = sites[static_cast<std::size_t>(at->second)];
      if ((site.center - center).norm() > tolerance) continue;
      site.on_sphere.insert(site.on_sphere.end(), loop.begin(), loop.end());
      return at->second;
    }
    const auto id = static_cast<std::int32_t>(sites.size());
    sites.push_back({center, weight, loop});
    by_x_.emplace(center.x(), id);
    return id;
  }

 private:
  std::multimap<double, std::int32_t> by_x_;
};

/// Adds the vertices that lie on a site's sphere without belonging to its face (a natural site's sphere passes through
/// all corners of its box), and sorts the lists.
void complete_lists(const std::vector<CavityVertex>& vertices, std::vector<Site>& sites) {
  constexpr double on_sphere =
      1e-9;  // of the weight: rounding of centre and weight; the next vertices are off by 1e-3 and more
  tbb::parallel_for(std::size_t{0}, sites.size(), [&](std::size_t i) {
    Site& s = sites[i];
    for (std::size_t v = 0; v < vertices.size(); ++v)
      if (std::abs((vertices[v].reference - s.center).squaredNorm() - s.weight) <= on_sphere * s.weight)
        s.on_sphere.push_back(static_cast<std::int32_t>(v));
    std::sort(s.on_sphere.begin(), s.on_sphere.end());
    s.on_sphere.erase(std::unique(s.on_sphere.begin(), s.on_sphere.end()), s.on_sphere.end());
  });
}

}  // namespace

Sites place_sites(const Cavity& cavity, const std::vector<double>& part) {
  const auto group = groups_of(cavity);
  Offsets t = first_offsets(cavity);
  for (std::size_t f = 0; f < part.size(); ++f)
    if (cavity.faces[f].t_low <= 0.0) t.in[f] *= part[f];
  level_groups(group, t.in);
  const auto outer = weighted_points(cavity, t.out);
  Sites sites;
  for (int round = 0; round <= most_shrinks; ++round) {
    const auto outside = sites_outside_cells(weighted_points(cavity, t.in), outer);
    sites.not_centred = std::count(outside.begin(), outside.end(), 1);
    if (sites.not_centred == 0 || round == most_shrinks) break;
    for (std::size_t f = 0; f < outside.size(); ++f) {
      if (outside[f] == 0) continue;
      const double least = cavity.faces[f].t_low > 0.0 ? cavity.faces[f].t_low : 0.0;
      t.in[f] = least + shrink * (t.in[f] - least);
    }
    level_groups(group, t.in);
  }
  SiteList inner_list;
  SiteList outer_list;
  for (std::size_t f = 0; f < cavity.faces.size(); ++f) {
    const BoundaryFace& face = cavity.faces[f];
    const double tolerance = coincidence * face.radius;
    const double r2 = face.radius * face.radius;
    sites.inner_of.push_back(
        inner_list.add(on_axis(face, t.in[f]), r2 + t.in[f] * t.in[f], face.loop, tolerance, sites.inner));
    sites.outer_of.push_back(
        outer_list.add(on_axis(face, t.out[f]), r2 + t.out[f] * t.out[f], face.loop, tolerance, sites.outer));
  }
  complete_lists(cavity.vertices, sites.inner);
  complete_lists(cavity.vertices, sites.outer);
  return sites;
}

}  // namespace wellknit
