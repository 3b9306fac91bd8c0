// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A preconditioner for the pressure equation of large meshes: algebraic multigrid by pairwise aggregation with a
/// K-cycle (keys `Notay2010`, `NotayVassilevski2008`).
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

namespace wellknit {

/// Compressed by rows, both triangles stored.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;

class AggregationMultigrid {
 public:
  /// `matrix`: symmetric, positive definite, off-diagonal entries at most 0, row sums at least 0 up to rounding.
  /// Throws InvalidInput when its coarsest form cannot be factored: it is singular.
  explicit AggregationMultigrid(const SparseMatrix& matrix);

  /// One cycle: an approximate solution of A x = r. Not a linear function of r: for flexible conjugate gradients.
  [[nodiscard]] Eigen::VectorXd apply(const Eigen::VectorXd& r) const { return cycle(0, r); }

  [[nodiscard]] std::size_t level_count() const { return levels_.size(); }

 private:
  struct Level {
    SparseMatrix matrix;
    std::vector<std::int32_t> aggregate;  ///< of each row, a row of the next level; -1: left to the smoother
  };

  [[nodiscard]] Eigen::VectorXd cycle(std::size_t level, const Eigen::VectorXd& r) const;
  [[nodiscard]] Eigen::VectorXd solve_coarse(std::size_t level, const Eigen::VectorXd& r) const;

  std::vector<Level> levels_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> coarsest_;
};

}  // namespace wellknit
