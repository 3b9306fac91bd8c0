// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Y. Notay, An aggregation-based algebraic multigrid method, 2010 (key Notay2010): pairs of the strongest coupling,
// twice a level, plain sums as restriction. The K-cycle, up to two steps of conjugate gradients on each coarse level,
// makes up for the plain prolongation (Y. Notay and P. Vassilevski, Recursive Krylov-based multigrid cycles, 2008, key
// NotayVassilevski2008).

#include "algorithm/aggregation_multigrid.h"

#include <algorithm>

#include "model/errors.h"

namespace wellknit {

namespace {

using Eigen::VectorXd;
using Index = std::int32_t;

constexpr Index no_aggregate = -1;
constexpr Index largest_direct = 2000;       ///< rows that are factored rather than made coarser
constexpr double least_coupling = 0.25;      ///< of a row's strongest: weaker ones make no pair
constexpr double dominance = 5.0;            ///< diagonal over the other entries: the smoother alone solves such a row
constexpr double least_reduction = 0.9;      ///< rows of the next level over those of this one: coarsening has stalled
constexpr double second_step_needed = 0.25;  ///< residual after the K-cycle's first step; above it a second is made

struct Aggregation {
  std::vector<Index> of_row;
  Index count = 0;
};

/// Sum of the off-diagonal entries' sizes, and the largest of them.
struct RowStrength {
  double diagonal = 0.0;
  double sum = 0.0;
  double largest = 0.0;
};

RowStrength strength(const SparseMatrix& a, Index row) {
  RowStrength out;
  for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry) {
    if (entry.col() == row) {
      out.diagonal = entry.value();
      continue;
    }
    out.sum -= entry.value();
    out.largest = std::max(out.largest, -entry.value());
  }
  return out;
}

/// The free neighbour of the strongest coupling; none where that is too weak beside the row's strongest.
Index partner(const SparseMatrix& a, Index row, double largest, const std::vector<std::uint8_t>& is_taken) {
  Index best = no_aggregate;
  double strongest = least_coupling * largest;
  for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry) {
    if (entry.col() == row || is_taken[static_cast<std::size_t>(entry.col())] != 0) continue;
    if (-entry.value() < strongest || (best != no_aggregate && -entry.value() == strongest)) continue;
    strongest = -entry.value();
    best = static_cast<Index>(entry.col());
  }
  return best;
}

/// `leaves_dominant`: rows that the smoother solves alone belong to no aggregate.
Aggregation pairs(const SparseMatrix& a, bool leaves_dominant) {
  Aggregation out;
  out.of_row.assign(static_cast<std::size_t>(a.rows()), no_aggregate);
  std::vector<std::uint8_t> is_taken(out.of_row.size(), 0);
  std::vector<RowStrength> rows(out.of_row.size());
  for (Index row = 0; row < a.rows(); ++row) {
    const auto at = static_cast<std::size_t>(row);
    rows[at] = strength(a, row);
    if (leaves_dominant && rows[at].diagonal > dominance * rows[at].sum) is_taken[at] = 1;
  }
  for (Index row = 0; row < a.rows(); ++row) {
    const auto at = static_cast<std::size_t>(row);
    if (is_taken[at] != 0) continue;
    is_taken[at] = 1;
    out.of_row[at] = out.count;
    const Index other = partner(a, row, rows[at].largest, is_taken);
    if (other != no_aggregate) {
      is_taken[static_cast<std::size_t>(other)] = 1;
      out.of_row[static_cast<std::size_t>(other)] = out.count;
    }
    ++out.count;
  }
  return out;
}

/// Rows of each aggregate, one list after the other: offsets and rows.
struct Members {
  std::vector<std::size_t> start;
  std::vector<Index> rows;
};

Members members_of(const Aggregation& aggregation) {
  Members out;
  out.start.assign(static_cast<std::size_t>(aggregation.count) + 1, 0);
  for (const Index aggregate : aggregation.of_row)
    if (aggregate != no_aggregate) ++out.start[static_cast<std::size_t>(aggregate) + 1];
  for (std::size_t n = 1; n < out.start.size(); ++n) out.start[n] += out.start[n - 1];
  out.rows.resize(out.start.back());
  std::vector<std::size_t> next(out.start.begin(), out.start.end() - 1);
  for (std::size_t row = 0; row < aggregation.of_row.size(); ++row)
    if (const Index aggregate = aggregation.of_row[row]; aggregate != no_aggregate)
      out.rows[next[static_cast<std::size_t>(aggregate)]++] = static_cast<Index>(row);
  return out;
}

/// The matrix of the aggregates: the sums of the entries between them.
SparseMatrix sum_over(const SparseMatrix& a, const Aggregation& aggregation) {
  const Members members = members_of(aggregation);
  SparseMatrix out(aggregation.count, aggregation.count);
  out.reserve(a.nonZeros() / 2);
  std::vector<double> sum(static_cast<std::size_t>(aggregation.count), 0.0);
  std::vector<Index> seen_in(sum.size(), no_aggregate);
  std::vector<Index> columns;
  for (Index row = 0; row < aggregation.count; ++row) {
    columns.clear();
    const auto at = static_cast<std::size_t>(row);
    for (std::size_t m = members.start[at]; m < members.start[at + 1]; ++m)
      for (SparseMatrix::InnerIterator entry(a, members.rows[m]); entry; ++entry) {
        const Index column = aggregation.of_row[static_cast<std::size_t>(entry.col())];
        if (column == no_aggregate) continue;
        const auto place = static_cast<std::size_t>(column);
        if (seen_in[place] != row) {
          seen_in[place] = row;
          sum[place] = 0.0;
          columns.push_back(column);
        }
        sum[place] += entry.value();
      }
    std::sort(columns.begin(), columns.end());
    out.startVec(row);
    for (const Index column : columns) out.insertBack(row, column) = sum[static_cast<std::size_t>(column)];
  }
  out.finalize();
  return out;
}

/// One Gauss-Seidel sweep over the rows, from zero.
VectorXd forward_sweep(const SparseMatrix& a, const VectorXd& r) {
  VectorXd x(r.size());
  for (Index row = 0; row < a.rows(); ++row) {
    double rest = r[row];
    double diagonal = 1.0;
    for (SparseMatrix::InnerIterator entry(a, row); entry && entry.col() <= row; ++entry) {
      if (entry.col() == row)
        diagonal = entry.value();
      else
        rest -= entry.value() * x[entry.col()];
    }
    x[row] = rest / diagonal;
  }
  return x;
}

/// The same backwards, from x: the two together are symmetric.
void backward_sweep(const SparseMatrix& a, const VectorXd& r, VectorXd& x) {
  for (auto row = static_cast<Index>(a.rows() - 1); row >= 0; --row) {
    double rest = r[row];
    double diagonal = 1.0;
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry) {
      if (entry.col() == row)
        diagonal = entry.value();
      else
        rest -= entry.value() * x[entry.col()];
    }
    x[row] = rest / diagonal;
  }
}

}  // namespace

AggregationMultigrid::AggregationMultigrid(const SparseMatrix& matrix) {
  levels_.push_back({matrix, {}});
  while (levels_.back().matrix.rows() > largest_direct) {
    Level& fine = levels_.back();
    Aggregation first = pairs(fine.matrix, true);
    const SparseMatrix halved = sum_over(fine.matrix, first);
    const Aggregation second = pairs(halved, false);
    if (second.count == 0 || second.count > least_reduction * static_cast<double>(fine.matrix.rows())) break;
    for (Index& aggregate : first.of_row)
      if (aggregate != no_aggregate) aggregate = second.of_row[static_cast<std::size_t>(aggregate)];
    fine.aggregate = std::move(first.of_row);
    levels_.push_back({sum_over(halved, second), {}});
  }
  coarsest_.compute(Eigen::SparseMatrix<double>(levels_.back().matrix));
  if (coarsest_.info() != Eigen::Success) throw InvalidInput("the pressure equation is singular");
}

Eigen::VectorXd AggregationMultigrid::cycle(std::size_t level, const VectorXd& r) const {
  if (level + 1 == levels_.size()) return coarsest_.solve(r);
  const auto& [a, aggregate] = levels_[level];
  VectorXd x = forward_sweep(a, r);
  const VectorXd rest = r - a * x;
  VectorXd coarse = VectorXd::Zero(levels_[level + 1].matrix.rows());
  for (std::size_t row = 0; row < aggregate.size(); ++row)
    if (aggregate[row] != no_aggregate) coarse[aggregate[row]] += rest[static_cast<Eigen::Index>(row)];
  const VectorXd correction = solve_coarse(level + 1, coarse);
  for (std::size_t row = 0; row < aggregate.size(); ++row)
    if (aggregate[row] != no_aggregate) x[static_cast<Eigen::Index>(row)] += correction[aggregate[row]];
  backward_sweep(a, r, x);
  return x;
}

/// The K-cycle: one or two steps of flexible conjugate gradients, each preconditioned with a cycle.
Eigen::VectorXd AggregationMultigrid::solve_coarse(std::size_t level, const VectorXd& r) const {
  if (level + 1 == levels_.size()) return coarsest_.solve(r);
  const SparseMatrix& a = levels_[level].matrix;
  const VectorXd c = cycle(level, r);
  const VectorXd v = a * c;
  const double energy = c.dot(v);
  if (!(energy > 0.0)) return c;
  const double step = c.dot(r) / energy;
  const VectorXd rest = r - step * v;
  if (rest.norm() <= second_step_needed * r.norm()) return step * c;
  const VectorXd d = cycle(level, rest);
  const VectorXd w = a * d;
  const double mixed = d.dot(v);
  const double second_energy = d.dot(w) - mixed * mixed / energy;
  if (!(second_energy > 0.0)) return step * c;
  const double second_step = d.dot(rest) / second_energy;
  return (step - mixed * second_step / energy) * c + second_step * d;
}

}  // namespace wellknit
