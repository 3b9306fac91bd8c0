// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/pressure_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/errors.h"

namespace wellknit {

namespace {

using Eigen::VectorXd;

constexpr double acceptable_residual = 1e-8;  ///< relative; above it rates would be wrong in their eighth digit
constexpr double pass_target = 0.5;           ///< of the tolerance: the residual of a pass drifts from the true one
constexpr int most_refinements = 10;
constexpr double least_gain = 0.5;  ///< a pass that lowers the residual less has reached rounding

/// The Cholesky factor of the matrix scaled to a unit diagonal: its entries may differ by many powers of ten.
class DirectSolver {
 public:
  explicit DirectSolver(const SparseMatrix& matrix) : scale_(matrix.diagonal().cwiseSqrt().cwiseInverse()) {
    factor_.compute(Eigen::SparseMatrix<double>(scale_.asDiagonal() * matrix * scale_.asDiagonal()));
    if (factor_.info() != Eigen::Success) throw InvalidInput("the pressure equation is singular");
  }
  [[nodiscard]] VectorXd approximate(const VectorXd& r) const {
    return scale_.cwiseProduct(factor_.solve(scale_.cwiseProduct(r)));
  }
  [[nodiscard]] VectorXd solve(const VectorXd& r, double /*enough*/, int& passes) const {
    ++passes;
    return scale_.cwiseProduct(factor_.solve(scale_.cwiseProduct(r)));
  }

 private:
  VectorXd scale_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

/// Flexible conjugate gradients from zero.
class MultigridSolver {
 public:
  MultigridSolver(const SparseMatrix& matrix, const PressureSolverOptions& options)
      : matrix_(matrix), options_(options), multigrid_(matrix) {}

  /// One cycle.
  [[nodiscard]] VectorXd approximate(const VectorXd& r) const { return multigrid_.apply(r); }

  /// Until the residual's norm is `enough`.
  [[nodiscard]] VectorXd solve(const VectorXd& right, double enough, int& iterations) const {
    VectorXd x = VectorXd::Zero(right.size());
    VectorXd r = right;
    VectorXd z = multigrid_.apply(r);
    VectorXd direction = z;
    double zr = z.dot(r);
    for (; iterations < options_.most_iterations && zr > 0.0; ++iterations) {
      const VectorXd image = matrix_ * direction;
      const double step = zr / direction.dot(image);
      x += step * direction;
      r -= step * image;
      if (r.norm() <= enough) break;
      z = multigrid_.apply(r);
      // Polak and Ribiere's form: the preconditioner is not the same in each step.
      const double turn = -step * z.dot(image) / zr;
      zr = z.dot(r);
      direction = z + turn * direction;
    }
    return x;
  }

 private:
  const SparseMatrix& matrix_;
  PressureSolverOptions options_;
  AggregationMultigrid multigrid_;
};

/// Generalised conjugate residuals (key `EisenstatElmanSchultz1983`), begun again after some steps; the preconditioner
/// need not be linear.
template <class Near>
class NearbySolver {
 public:
  NearbySolver(const SparseMatrix& matrix, const Near& near, const PressureSolverOptions& options)
      : matrix_(matrix), near_(near), options_(options) {}

  [[nodiscard]] VectorXd solve(const VectorXd& right, double enough, int& iterations) const {
    VectorXd x = VectorXd::Zero(right.size());
    VectorXd r = right;
    std::vector<VectorXd> directions;
    std::vector<VectorXd> images;  // orthonormal
    for (; iterations < options_.most_iterations && r.norm() > enough; ++iterations) {
      if (directions.size() == most_kept) {
        directions.clear();
        images.clear();
      }
      VectorXd direction = near_.approximate(r);
      VectorXd image = matrix_ * direction;
      for (std::size_t n = 0; n < images.size(); ++n) {
        const double part = image.dot(images[n]);
        image -= part * images[n];
        direction -= part * directions[n];
      }
      const double size = image.norm();
      if (!(size > 0.0) || !std::isfinite(size)) break;
      images.emplace_back(image / size);
      directions.emplace_back(direction / size);
      const double step = r.dot(images.back());
      x += step * directions.back();
      r -= step * images.back();
    }
    return x;
  }

 private:
  static constexpr std::size_t most_kept = 40;
  const SparseMatrix& matrix_;
  const Near& near_;
  PressureSolverOptions options_;
};

/// Solves for what is left until it is small or falls no further.
template <class Solver>
PressureSolution refine(const SparseMatrix& matrix, const VectorXd& right, const Solver& solver, double tolerance) {
  PressureSolution out;
  out.values = VectorXd::Zero(right.size());
  const double size = right.norm();
  if (!(size > 0.0)) return out;
  VectorXd rest = right;
  out.residual = 1.0;
  for (int pass = 0; pass < most_refinements && out.residual > tolerance; ++pass) {
    const VectorXd better = out.values + solver.solve(rest, pass_target * tolerance * size, out.iterations);
    const VectorXd left = right - matrix * better;
    const double residual = left.norm() / size;
    if (!(residual < out.residual)) break;
    const bool has_stalled = residual > least_gain * out.residual;
    out.values = better;
    out.residual = residual;
    rest = left;
    if (has_stalled) break;
  }
  return out;
}

}  // namespace

namespace {

PressureMethod method_for(const SparseMatrix& matrix, const PressureSolverOptions& options) {
  if (options.method != PressureMethod::automatic) return options.method;
  return matrix.rows() <= largest_direct_system ? PressureMethod::direct : PressureMethod::multigrid;
}

void expect_solved(const SparseMatrix& matrix, const PressureSolution& out, const PressureSolverOptions& options) {
  if (!(out.residual <= std::max(acceptable_residual, options.tolerance)))
    throw InvalidInput(fmt::format(
        "the pressure equation of {} unknowns was not solved: after {} iterations the residual is {:.2g} of "
        "the right-hand side; try the other --solver",
        matrix.rows(), out.iterations, out.residual));
}

template <class Near>
PressureSolution solve_nearby(const SparseMatrix& matrix, const Near& near, const VectorXd& right,
                              const PressureSolverOptions& options) {
  return refine(matrix, right, NearbySolver<Near>(matrix, near, options), options.tolerance);
}

}  // namespace

PressureSolution solve_pressure(const SparseMatrix& matrix, const VectorXd& right,
                                const PressureSolverOptions& options) {
  const PressureMethod method = method_for(matrix, options);
  PressureSolution out;
  if (matrix.rows() > 0)
    out = method == PressureMethod::direct ? refine(matrix, right, DirectSolver(matrix), options.tolerance)
                                           : refine(matrix, right, MultigridSolver(matrix, options), options.tolerance);
  out.method = method;
  expect_solved(matrix, out, options);
  return out;
}

PressureSolution solve_pressure(const SparseMatrix& matrix, const SparseMatrix& near, const VectorXd& right,
                                const PressureSolverOptions& options) {
  const PressureMethod method = method_for(matrix, options);
  PressureSolution out;
  if (matrix.rows() > 0)
    out = method == PressureMethod::direct ? solve_nearby(matrix, DirectSolver(near), right, options)
                                           : solve_nearby(matrix, MultigridSolver(near, options), right, options);
  out.method = method;
  expect_solved(matrix, out, options);
  return out;
}

}  // namespace wellknit
