// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "tests/support/steady_flow.h"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <stdexcept>

namespace wellknit::steady_flow {

std::vector<double> pressures(const Mesh& mesh, double bore_pressure,
                              const std::function<std::optional<double>(CellId)>& fixed) {
  const auto n = static_cast<Eigen::Index>(mesh.cells.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  // A stiff link holds a fixed pressure: 1e9 times the largest transmissibility.
  double largest = 0.0;
  for (const double t : mesh.connections.transmissibility) largest = std::max(largest, t);
  for (std::size_t c = 0; c < mesh.connections.size(); ++c) {
    const auto [a, b] = mesh.connections.cells[ConnectionId(c)];
    const double t = mesh.connections.transmissibility[ConnectionId(c)] / largest;
    entries.emplace_back(a.value(), a.value(), t);
    entries.emplace_back(b.value(), b.value(), t);
    entries.emplace_back(a.value(), b.value(), -t);
    entries.emplace_back(b.value(), a.value(), -t);
  }
  for (const MeshWell& w : mesh.wells)
    for (const WellConnection& c : w.connections) {
      entries.emplace_back(c.cell.value(), c.cell.value(), c.well_index / largest);
      right[c.cell.value()] += c.well_index / largest * bore_pressure;
    }
  for (Eigen::Index c = 0; c < n; ++c) {
    const auto p = fixed(CellId(static_cast<std::int64_t>(c)));
    entries.emplace_back(c, c, p ? 1e9 : 0.0);
    if (p) right[c] += 1e9 * *p;
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  if (factor.info() != Eigen::Success) throw std::runtime_error("the pressure matrix is singular");
  const Eigen::VectorXd p = factor.solve(right);
  return {p.data(), p.data() + n};
}

double well_rate(const Mesh& mesh, WellId well, double bore_pressure, const std::vector<double>& pressure) {
  double rate = 0.0;
  for (const WellConnection& c : mesh.wells[well].connections)
    rate += c.well_index * (pressure[c.cell.index()] - bore_pressure);
  return rate;
}

}  // namespace wellknit::steady_flow
