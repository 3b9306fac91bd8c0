// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/weighted_point_tree.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace wellknit {
namespace {

struct Points {
  std::vector<Vec3> centers;
  std::vector<double> weights;
};

Points random_points(std::size_t count, std::mt19937& generator) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    points.centers.emplace_back(unit(generator), unit(generator), 0.01 * unit(generator));
    points.weights.push_back(0.01 * unit(generator));
  }
  return points;
}

std::set<std::size_t> all_below(const Points& points, const Vec3& x, double limit) {
  std::set<std::size_t> out;
  for (std::size_t i = 0; i < points.centers.size(); ++i)
    if ((x - points.centers[i]).squaredNorm() - points.weights[i] <= limit) out.insert(i);
  return out;
}

std::set<std::size_t> visited(const WeightedPointTree& tree, const Vec3& x, double limit) {
  std::set<std::size_t> out;
  tree.visit(x, limit, [&](std::size_t i, double) { return !out.insert(i).second; });
  return out;
}

TEST(WeightedPointTree, VisitsThePointsThatADirectTestFinds) {
  constexpr unsigned seed = 5;
  SCOPED_TRACE(seed);
  std::mt19937 generator(seed);
  for (const std::size_t count : {0U, 1U, 8U, 9U, 1000U}) {
    Points points = random_points(count, generator);
    WeightedPointTree tree(points.centers, points.weights);
    for (int pass = 0; pass < 2; ++pass) {
      for (int query = 0; query < 50; ++query) {
        const Vec3 x = random_points(1, generator).centers[0];
        for (const double limit : {-0.005, 0.0, 0.02}) EXPECT_EQ(visited(tree, x, limit), all_below(points, x, limit));
      }
      points = random_points(count, generator);
      tree.refit(points.centers, points.weights);
    }
  }
}

TEST(WeightedPointTree, StopsAtTheFirstThatWillDo) {
  const std::vector<Vec3> line(100, Vec3(1.0, 2.0, 3.0));
  const WeightedPointTree tree(line);
  int calls = 0;
  EXPECT_TRUE(tree.visit({1.0, 2.0, 3.0}, 0.0, [&](std::size_t, double) { return ++calls == 3; }));
  EXPECT_EQ(calls, 3);
  EXPECT_FALSE(tree.visit({1.0, 2.0, 4.0}, 0.5, [](std::size_t, double) { return true; }));
}

}  // namespace
}  // namespace wellknit
