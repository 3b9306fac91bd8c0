// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A k-d tree over weighted points that answers where the power |x - c|^2 - w is small. Without weights it answers
/// which points lie in a ball.
///
/// Source: J. L. Bentley, Multidimensional binary search trees used for associative searching, CACM 18 (1975) (key
/// Bentley); the largest weight of each node makes its bound.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/geometry.h"

namespace wellknit {

class WeightedPointTree {
 public:
  /// `weights`: m2, as many as there are centres; empty: 0 everywhere.
  explicit WeightedPointTree(std::span<const Vec3> centers, std::span<const double> weights = {});

  /// Takes new centres and weights for the same points: the tree's order stays, its bounds follow. Best where the
  /// points moved little.
  void refit(std::span<const Vec3> centers, std::span<const double> weights);

  /// Calls visitor(index, power) for each point with a power of at most `limit` (m2) at x, until one call returns true;
  /// true when one did. The order of the calls is that of the tree.
  template <class Visitor>
  bool visit(const Vec3& x, double limit, Visitor&& visitor) const {
    return !nodes_.empty() && visit_node(0, x, limit, visitor);
  }

 private:
  struct Node {
    Vec3 low = Vec3::Zero();
    Vec3 high = Vec3::Zero();
    double most_weight = 0.0;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::uint32_t right = 0;  ///< the left child follows its parent; 0: a leaf
  };
  struct Point {
    Vec3 center = Vec3::Zero();
    double weight = 0.0;
    std::uint32_t index = 0;
  };

  void split(std::uint32_t begin, std::uint32_t end);
  void set_bounds();

  template <class Visitor>
  bool visit_node(std::uint32_t at, const Vec3& x, double limit, Visitor& visitor) const {
    const Node& node = nodes_[at];
    if ((x - x.cwiseMax(node.low).cwiseMin(node.high)).squaredNorm() - node.most_weight > limit) return false;
    if (node.right != 0) return visit_node(at + 1, x, limit, visitor) || visit_node(node.right, x, limit, visitor);
    for (std::uint32_t p = node.begin; p < node.end; ++p) {
      const Point& point = points_[p];
      const double power = (x - point.center).squaredNorm() - point.weight;
      if (power <= limit && visitor(static_cast<std::size_t>(point.index), power)) return true;
    }
    return false;
  }

  std::vector<Point> points_;  ///< in the order of the leaves
  std::vector<Node> nodes_;
};

}  // namespace wellknit
