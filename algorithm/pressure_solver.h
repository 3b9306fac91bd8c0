// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Solves the symmetric, positive definite equations of flow networks to rounding.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "algorithm/aggregation_multigrid.h"

namespace wellknit {

enum class PressureMethod : std::uint8_t {
  automatic,  ///< direct up to `largest_direct_system` rows
  direct,     ///< sparse Cholesky
  multigrid   ///< conjugate gradients preconditioned by AggregationMultigrid
};

/// Above it the factor of a three-dimensional mesh costs more than the iteration (docs/algorithms/steady_flow.md).
inline constexpr std::int64_t largest_direct_system = 10'000;

struct PressureSolverOptions {
  PressureMethod method = PressureMethod::automatic;
  double tolerance = 1e-13;  ///< wanted norm of the residual over that of the right-hand side
  int most_iterations = 500;
};

struct PressureSolution {
  Eigen::VectorXd values;
  PressureMethod method = PressureMethod::direct;
  int iterations = 0;     ///< conjugate gradients; of direct, the refinements
  double residual = 0.0;  ///< norm of the residual over that of the right-hand side
};

/// `matrix` as for AggregationMultigrid. Ends when the tolerance is reached or rounding lets the residual fall no
/// further. The same input gives the same bytes. Throws InvalidInput when the matrix is singular, or when the residual
/// stays above 1e-8 and above the tolerance.
PressureSolution solve_pressure(const SparseMatrix& matrix, const Eigen::VectorXd& right,
                                const PressureSolverOptions& options = {});

/// The same for a matrix that is not symmetric; `near` is a symmetric, positive definite one near it, and what the
/// options say is how that one is solved.
PressureSolution solve_pressure(const SparseMatrix& matrix, const SparseMatrix& near, const Eigen::VectorXd& right,
                                const PressureSolverOptions& options = {});

}  // namespace wellknit
