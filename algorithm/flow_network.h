// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A network of nodes joined by conductances: what is left of a mesh and its wells for steady single-phase flow.
/// Units are free as long as flow = conductance * difference of potentials.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "algorithm/pressure_solver.h"
#include "model/ids.h"

namespace wellknit {

/// Flow as coefficients of nodes' potentials. They point into arrays that outlive the network.
struct FlowStencil {
  std::span<const CellId> nodes;  ///< cells are the first nodes
  std::span<const double> coefficients;
  double scale = 1.0;

  [[nodiscard]] bool empty() const { return nodes.empty(); }
  [[nodiscard]] double flow(std::span<const double> potential) const {
    double sum = 0.0;
    for (std::size_t n = 0; n < nodes.size(); ++n) sum += coefficients[n] * potential[nodes[n].index()];
    return scale * sum;
  }
};

struct FlowNetwork {
  using Node = std::int32_t;
  struct Link {
    Node a = 0;
    Node b = 0;
    double conductance = 0.0;  ///< positive
    FlowStencil stencil;       ///< empty: conductance * (potential of a - potential of b)
  };
  /// A link to something that keeps its potential.
  struct Hold {
    Node node = 0;
    double conductance = 0.0;  ///< positive
    double potential = 0.0;
    FlowStencil stencil;  ///< of the nodes' part; empty: conductance * potential of the node
  };

  std::vector<std::optional<double>> fixed;  ///< one a node: its potential, where that is given
  std::vector<double> source;                ///< one a node: flow into it from outside; nothing at fixed nodes
  std::vector<Link> links;
  std::vector<Hold> holds;

  [[nodiscard]] std::size_t node_count() const { return fixed.size(); }
  FlowNetwork::Node add_node() {
    fixed.emplace_back();
    source.push_back(0.0);
    return static_cast<Node>(fixed.size() - 1);
  }
};

/// The connected parts of a network, numbered by their first nodes.
struct NetworkParts {
  std::vector<std::int32_t> of_node;
  std::vector<std::uint8_t> is_held;  ///< one a part: 1 where a node is fixed or held
  [[nodiscard]] std::size_t size() const { return is_held.size(); }
};
NetworkParts network_parts(const FlowNetwork& network);

struct NetworkSolution {
  /// One a node, less `reference`: what is left keeps small differences exact. Not a number in parts that are not held.
  std::vector<double> potential;
  double reference = 0.0;     ///< the lowest potential that is fixed or held
  PressureSolution equation;  ///< how it was solved; its values are those of the free nodes
};

/// Throws what solve_pressure() throws.
NetworkSolution solve(const FlowNetwork& network, const NetworkParts& parts, const PressureSolverOptions& options);

}  // namespace wellknit
