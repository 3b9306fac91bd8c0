// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/weighted_point_tree.h"

#include <algorithm>

namespace wellknit {

namespace {

constexpr std::uint32_t leaf_size = 8;  // fewer cost more bounds, more cost more powers: 4 to 16 are equal to a tenth

}  // namespace

WeightedPointTree::WeightedPointTree(std::span<const Vec3> centers, std::span<const double> weights) {
  points_.resize(centers.size());
  for (std::size_t i = 0; i < centers.size(); ++i)
    points_[i] = {centers[i], weights.empty() ? 0.0 : weights[i], static_cast<std::uint32_t>(i)};
  if (points_.empty()) return;
  split(0, static_cast<std::uint32_t>(points_.size()));
  set_bounds();
}

void WeightedPointTree::refit(std::span<const Vec3> centers, std::span<const double> weights) {
  for (Point& p : points_) {
    p.center = centers[p.index];
    p.weight = weights.empty() ? 0.0 : weights[p.index];
  }
  set_bounds();
}

void WeightedPointTree::split(std::uint32_t begin, std::uint32_t end) {
  const std::size_t at = nodes_.size();
  nodes_.push_back({});
  nodes_[at].begin = begin;
  nodes_[at].end = end;
  if (end - begin <= leaf_size) return;
  Vec3 low = points_[begin].center;
  Vec3 high = low;
  for (std::uint32_t p = begin + 1; p < end; ++p) {
    low = low.cwiseMin(points_[p].center);
    high = high.cwiseMax(points_[p].center);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto place = [&](std::uint32_t p) { return points_.begin() + static_cast<std::ptrdiff_t>(p); };
  // Ties by number: the tree is the same on every machine.
  std::nth_element(place(begin), place(middle), place(end), [axis](const Point& a, const Point& b) {
    return a.center[axis] < b.center[axis] || (a.center[axis] == b.center[axis] && a.index < b.index);
  });
  split(begin, middle);
  nodes_[at].right = static_cast<std::uint32_t>(nodes_.size());
  split(middle, end);
}

void WeightedPointTree::set_bounds() {
  for (std::size_t at = nodes_.size(); at-- > 0;) {
    Node& node = nodes_[at];
    if (node.right != 0) {
      const Node& a = nodes_[at + 1];
      const Node& b = nodes_[node.right];
      node.low = a.low.cwiseMin(b.low);
      node.high = a.high.cwiseMax(b.high);
      node.most_weight = std::max(a.most_weight, b.most_weight);
      continue;
    }
    const Point& first = points_[node.begin];
    node.low = node.high = first.center;
    node.most_weight = first.weight;
    for (std::uint32_t p = node.begin + 1; p < node.end; ++p) {
      node.low = node.low.cwiseMin(points_[p].center);
      node.high = node.high.cwiseMax(points_[p].center);
      node.most_weight = std::max(node.most_weight, points_[p].weight);
    }
  }
}

}  // namespace wellknit
