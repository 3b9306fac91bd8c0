// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Notation of method.md §6: c(t) = o_f + t n_f, h = n_f.(v - o_f), p = |v - o_f|^2 - rho_f^2; v is inside iff p < 2th.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "algorithm/cavity.h"
#include "algorithm/weighted_point_tree.h"

namespace wellknit {

namespace {

/// How far along its axis a face looks, over the larger of its radius and its natural distance on that side. Sites
/// stand at the natural distance at most, which takes twice of it in t_high; the rest is room for points of the
/// mapping.
constexpr double reach_of_natural = 4.0;

/// What stops the sphere on one side of a face.
struct Stop {
  double t = 0.0;            ///< towards the side
  std::int32_t vertex = -1;  ///< -1: the reach
};

class BoundsOfFace {
 public:
  BoundsOfFace(const BoundaryFace& face, const std::vector<CavityVertex>& vertices, const WeightedPointTree& tree)
      : f_(face), vertices_(vertices), tree_(tree), flat_(1e-9 * face.radius) {}

  /// All vertices that stop the sphere before t lie in that sphere or on it: a ball that holds one tells the first.
  /// The first ball ends just beyond the natural site's: the grid's own spheres stop there.
  [[nodiscard]] Stop stop(double side, double natural) {
    const double reach = reach_of_natural * std::max(natural, f_.radius);
    for (double t = std::min(reach, std::max((1.0 + 1e-6) * natural, 0.125 * f_.radius));;
         t = std::min(reach, 2.0 * t)) {
      const Stop found = first_in_ball(side, t);
      if (found.vertex >= 0 || t >= reach) return found;
    }
  }

  /// A vertex in the face's plane and inside its circle, closer than `flat` counts as in the plane; -1: none. Every
  /// ball of stop() holds the circle: known after its first call.
  [[nodiscard]] std::int32_t vertex_in_circle() const { return in_circle_; }

 private:
  [[nodiscard]] Stop first_in_ball(double side, double t) {
    Stop first{t, -1};
    const double r2 = f_.radius * f_.radius;
    // A billionth: a vertex on the ball must not fall out by rounding; t itself decides.
    tree_.visit(f_.center + side * t * f_.normal, (r2 + t * t) * (1.0 + 1e-9), [&](std::size_t v, double) {
      const Vec3 d = vertices_[v].reference - f_.center;
      const double h = side * f_.normal.dot(d);
      const auto id = static_cast<std::int32_t>(v);
      if (h <= flat_) {
        if (h >= -flat_ && d.squaredNorm() - r2 < -1e-9 * r2) note_in_circle(id);
        return false;
      }
      const double at = (d.squaredNorm() - r2) / (2.0 * h);
      if (at < first.t || (at == first.t && id < first.vertex)) first = {at, id};
      return false;
    });
    return first;
  }

  void note_in_circle(std::int32_t id) {
    if (std::find(f_.loop.begin(), f_.loop.end(), id) == f_.loop.end()) in_circle_ = std::max(in_circle_, id);
  }

  const BoundaryFace& f_;
  const std::vector<CavityVertex>& vertices_;
  const WeightedPointTree& tree_;
  std::int32_t in_circle_ = -1;
  double flat_;  ///< m; closer to the face's plane counts as on it: rounding of the vertices
};

/// A site stays on its side of a plane: four fifths of the way at most.
void stop_at_planes(const std::vector<MirrorPlane>& planes, BoundaryFace& f) {
  for (const MirrorPlane& plane : planes) {
    const double toward = -plane.inward * f.normal[plane.axis];  // speed of c(t) towards the plane
    const double distance = plane.inward * (f.center[plane.axis] - plane.coordinate);
    if (toward > 1e-9 && 0.8 * distance / toward < f.t_high) {
      f.t_high = 0.8 * distance / toward;
      f.high_vertex = -1;
    }
  }
}

}  // namespace

void set_sphere_bounds(std::vector<BoundaryFace>& faces, const std::vector<CavityVertex>& vertices,
                       const std::vector<MirrorPlane>& planes) {
  std::vector<Vec3> points;
  points.reserve(vertices.size());
  for (const CavityVertex& v : vertices) points.push_back(v.reference);
  const WeightedPointTree tree(points);
  tbb::parallel_for(std::size_t{0}, faces.size(), [&](std::size_t index) {
    BoundaryFace& f = faces[index];
    BoundsOfFace bounds(f, vertices, tree);
    const Stop high = bounds.stop(1.0, std::abs(f.natural));
    const Stop low = bounds.stop(-1.0, std::abs(f.natural_outside));
    const std::int32_t blocking = bounds.vertex_in_circle();
    f.t_high = blocking >= 0 ? -std::numeric_limits<double>::infinity() : high.t;
    f.high_vertex = blocking >= 0 ? blocking : high.vertex;
    f.t_low = -low.t;
    f.low_vertex = low.vertex;
    stop_at_planes(planes, f);
  });
}

}  // namespace wellknit
