// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/pressure_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "model/errors.h"

namespace wellknit {
namespace {

/// n x n x n cells with lognormal conductivities, `vertical` times weaker downwards; the first and the last cell are
/// held.
SparseMatrix random_box(int n, double deviation, double vertical, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, deviation);
  const int count = n * n * n;
  std::vector<double> k(static_cast<std::size_t>(count));
  for (double& value : k) value = std::exp(normal(random));
  std::vector<double> diagonal(k.size(), 0.0);
  diagonal.front() = k.front();
  diagonal.back() = k.back();
  std::vector<Eigen::Triplet<double>> entries;
  const auto join = [&](int a, int b, double factor) {
    const double ka = k[static_cast<std::size_t>(a)];
    const double kb = k[static_cast<std::size_t>(b)];
    const double t = factor * 2.0 * ka * kb / (ka + kb);
    entries.emplace_back(a, b, -t);
    entries.emplace_back(b, a, -t);
    diagonal[static_cast<std::size_t>(a)] += t;
    diagonal[static_cast<std::size_t>(b)] += t;
  };
  for (int c = 0; c < count; ++c) {
    if (c % n + 1 < n) join(c, c + 1, 1.0);
    if (c / n % n + 1 < n) join(c, c + n, 1.0);
    if (c / (n * n) + 1 < n) join(c, c + n * n, vertical);
  }
  for (int c = 0; c < count; ++c) entries.emplace_back(c, c, diagonal[static_cast<std::size_t>(c)]);
  SparseMatrix out(count, count);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

Eigen::VectorXd push(Eigen::Index count) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(count);
  out[0] = 1.0;
  out[count / 2] = -0.5;
  return out;
}

TEST(PressureSolver, BothMethodsSolveToRounding) {
  for (const auto& [deviation, vertical] : {std::pair{0.0, 1.0}, {1.0, 0.1}, {3.0, 0.01}}) {
    const SparseMatrix matrix = random_box(12, deviation, vertical, 11);
    const Eigen::VectorXd right = push(matrix.rows());
    for (const PressureMethod method : {PressureMethod::direct, PressureMethod::multigrid}) {
      const PressureSolution solution = solve_pressure(matrix, right, {method});
      EXPECT_LT((right - matrix * solution.values).norm(), 1e-10) << deviation << " " << static_cast<int>(method);
      EXPECT_EQ(solution.method, method);
    }
  }
}

TEST(PressureSolver, MultigridTakesAsManyStepsOnAFineGridAsOnACoarseOne) {
  const auto steps = [](int n) {
    const SparseMatrix matrix = random_box(n, 1.0, 0.1, 3);
    return solve_pressure(matrix, push(matrix.rows()), {PressureMethod::multigrid, 1e-10}).iterations;
  };
  const int coarse = steps(14);  // 2,744 rows: two levels
  const int fine = steps(42);    // 27 times as many
  EXPECT_GT(coarse, 1);
  EXPECT_LE(fine, 2 * coarse) << coarse << " steps on the coarse grid";
}

TEST(PressureSolver, RefusesASingularMatrix) {
  // Two cells joined to each other alone, and a flow into one.
  SparseMatrix matrix(2, 2);
  matrix.coeffRef(0, 0) = matrix.coeffRef(1, 1) = 1.0;
  matrix.coeffRef(0, 1) = matrix.coeffRef(1, 0) = -1.0;
  Eigen::VectorXd right(2);
  right << 1.0, 0.0;
  EXPECT_THROW((void)solve_pressure(matrix, right, {PressureMethod::direct}), InvalidInput);
  EXPECT_THROW((void)solve_pressure(matrix, right, {PressureMethod::multigrid}), InvalidInput);
}

TEST(PressureSolver, SaysSoWhenItDoesNotConverge) {
  const SparseMatrix matrix = random_box(16, 3.0, 0.01, 5);
  PressureSolverOptions options{PressureMethod::multigrid};
  options.most_iterations = 1;
  try {
    (void)solve_pressure(matrix, push(matrix.rows()), options);
    FAIL() << "one step cannot do";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("4096 unknowns"), std::string::npos) << error.what();
  }
}

TEST(PressureSolver, NothingPushedIsNothing) {
  const SparseMatrix matrix = random_box(3, 1.0, 1.0, 1);
  const PressureSolution solution = solve_pressure(matrix, Eigen::VectorXd::Zero(27));
  EXPECT_EQ(solution.values.norm(), 0.0);
  EXPECT_EQ(solve_pressure(SparseMatrix(0, 0), Eigen::VectorXd(0)).values.size(), 0);
}

}  // namespace
}  // namespace wellknit
