// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/pressure_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

PressureSolution solve_pressure(const SparseMatrix& matrix, const VectorXd& right,
                                const PressureSolverOptions& options) {
  PressureMethod method = options.method;
  if (method == PressureMethod::automatic)
    method = matrix.rows() <= largest_direct_system ? PressureMethod::direct : PressureMethod::multigrid;
  PressureSolution out;
  if (matrix.rows() > 0)
    out = method == PressureMethod::direct ? refine(matrix, right, DirectSolver(matrix), options.tolerance)
                                           : refine(matrix, right, MultigridSolver(matrix, options), options.tolerance);
  out.method = method;
  if (!(out.residual <= std::max(acceptable_residual, options.tolerance)))
    throw InvalidInput(fmt::format(
        "the pressure equation of {} unknowns was not solved: after {} iterations the residual is {:.2g} of "
        "the right-hand side; try the other --solver",
        matrix.rows(), out.iterations, out.residual));
  return out;
}

}  // namespace wellknit
