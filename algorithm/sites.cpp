// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Notation of method.md §8: c(t) = o_f + t n_f, weight rho_f^2 + t^2.
#include "algorithm/sites.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "algorithm/weighted_point_tree.h"

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

/// The sites of the faces on one side as points and weights.
struct WeightedPoints {
  std::vector<Vec3> centers;
  std::vector<double> weights;
};

WeightedPoints weighted_points(const Cavity& cavity, const std::vector<double>& t) {
  WeightedPoints points;
  points.centers.reserve(t.size());
  points.weights.reserve(t.size());
  for (std::size_t f = 0; f < t.size(); ++f) {
    const BoundaryFace& face = cavity.faces[f];
    points.centers.push_back(face.center + t[f] * face.normal);
    points.weights.push_back(face.radius * face.radius + t[f] * t[f]);
  }
  return points;
}

/// Tells which inner sites lie outside of their cells. Images in the planes never beat a site.
class CentringTest {
 public:
  CentringTest(WeightedPoints inner, const WeightedPoints& outer)
      : inner_(std::move(inner)),
        inner_tree_(inner_.centers, inner_.weights),
        outer_tree_(outer.centers, outer.weights) {}

  void move(WeightedPoints inner) {
    inner_ = std::move(inner);
    inner_tree_.refit(inner_.centers, inner_.weights);
  }

  /// Those of the given sites at whose centres another site has a smaller power than their own, in the order given.
  [[nodiscard]] std::vector<std::size_t> outside(const std::vector<std::size_t>& sites) const {
    std::vector<std::uint8_t> is_outside(sites.size(), 0);
    tbb::parallel_for(std::size_t{0}, sites.size(), [&](std::size_t i) {
      const Vec3& c = inner_.centers[sites[i]];
      // Coincident sites have equal power: rounding must not count.
      const double own = -inner_.weights[sites[i]] * (1.0 + 1e-10);
      const auto wins = [&](std::size_t, double power) { return power < own; };
      is_outside[i] = inner_tree_.visit(c, own, wins) || outer_tree_.visit(c, own, wins) ? 1 : 0;
    });
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < sites.size(); ++i)
      if (is_outside[i] != 0) out.push_back(sites[i]);
    return out;
  }

 private:
  WeightedPoints inner_;
  WeightedPointTree inner_tree_;
  WeightedPointTree outer_tree_;
};

/// Draws inner sites towards their faces until each lies in its cell; how many still do not. A site that was moved is
/// tested again at once, all are when none is left.
std::int64_t centre_sites(const Cavity& cavity, const std::vector<std::int32_t>& group, Offsets& t) {
  CentringTest test(weighted_points(cavity, t.in), weighted_points(cavity, t.out));
  std::vector<std::size_t> all(t.in.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<std::size_t> tested = all;
  for (int round = 0;;) {
    const auto outside = test.outside(tested);
    if (outside.empty()) {
      if (tested.size() == all.size()) return 0;
      tested = all;
      continue;
    }
    if (round++ == most_shrinks) return static_cast<std::int64_t>(test.outside(all).size());
    const std::vector<double> before = t.in;
    for (const std::size_t f : outside) {
      const double least = std::max(cavity.faces[f].t_low, 0.0);
      t.in[f] = least + shrink * (t.in[f] - least);
    }
    level_groups(group, t.in);
    tested.clear();
    for (const std::size_t f : all)
      if (t.in[f] != before[f]) tested.push_back(f);
    test.move(weighted_points(cavity, t.in));
  }
}

/// One site for each face, or for several whose sites coincide: the first of them then stands for all. Returns the
/// site of each face.
std::vector<std::int32_t> unite_sites(const Cavity& cavity, const std::vector<double>& t, std::vector<Site>& sites) {
  std::vector<Vec3> centers(t.size());
  for (std::size_t f = 0; f < t.size(); ++f) centers[f] = on_axis(cavity.faces[f], t[f]);
  const WeightedPointTree tree(centers);
  std::vector<std::int32_t> site_of(t.size(), -1);
  for (std::size_t f = 0; f < t.size(); ++f) {
    const BoundaryFace& face = cavity.faces[f];
    const double tolerance = coincidence * face.radius;
    std::size_t first = f;
    tree.visit(centers[f], tolerance * tolerance, [&](std::size_t g, double) {
      if (g < first && sites[static_cast<std::size_t>(site_of[g])].center == centers[g]) first = g;
      return false;
    });
    if (first == f) {
      site_of[f] = static_cast<std::int32_t>(sites.size());
      sites.push_back({centers[f], face.radius * face.radius + t[f] * t[f], face.loop});
    } else {
      site_of[f] = site_of[first];
      auto& list = sites[static_cast<std::size_t>(site_of[f])].on_sphere;
      list.insert(list.end(), face.loop.begin(), face.loop.end());
    }
  }
  return site_of;
}

/// Adds the vertices that lie on a site's sphere without belonging to its face (a natural site's sphere passes through
/// all corners of its box), and sorts the lists.
void complete_lists(const std::vector<CavityVertex>& vertices, const WeightedPointTree& tree,
                    std::vector<Site>& sites) {
  constexpr double on_sphere =
      1e-9;  // of the weight: rounding of centre and weight; the next vertices are off by 1e-3 and more
  tbb::parallel_for(std::size_t{0}, sites.size(), [&](std::size_t i) {
    Site& s = sites[i];
    tree.visit(s.center, s.weight * (1.0 + 2.0 * on_sphere), [&](std::size_t v, double) {
      if (std::abs((vertices[v].reference - s.center).squaredNorm() - s.weight) <= on_sphere * s.weight)
        s.on_sphere.push_back(static_cast<std::int32_t>(v));
      return false;
    });
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
  Sites sites;
  sites.not_centred = centre_sites(cavity, group, t);
  sites.inner_of = unite_sites(cavity, t.in, sites.inner);
  sites.outer_of = unite_sites(cavity, t.out, sites.outer);
  std::vector<Vec3> points;
  points.reserve(cavity.vertices.size());
  for (const CavityVertex& v : cavity.vertices) points.push_back(v.reference);
  const WeightedPointTree tree(points);
  complete_lists(cavity.vertices, tree, sites.inner);
  complete_lists(cavity.vertices, tree, sites.outer);
  return sites;
}

}  // namespace wellknit
