// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/flow_network.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace wellknit {

namespace {

using Node = FlowNetwork::Node;

constexpr std::int32_t no_row = -1;

/// Union-find; the root of a set is its first node.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  Node root(Node node) {
    while (parent(node) != node) node = parent(node) = parent(parent(node));
    return node;
  }
  void join(Node a, Node b) {
    a = root(a);
    b = root(b);
    parent(std::max(a, b)) = std::min(a, b);
  }

 private:
  Node& parent(Node node) { return parent_[static_cast<std::size_t>(node)]; }
  std::vector<Node> parent_;
};

double lowest_held(const FlowNetwork& network) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const auto& potential : network.fixed)
    if (potential) lowest = std::min(lowest, *potential);
  for (const FlowNetwork::Hold& hold : network.holds) lowest = std::min(lowest, hold.potential);
  return lowest < std::numeric_limits<double>::infinity() ? lowest : 0.0;
}

/// The row of each node that is solved for.
std::vector<std::int32_t> rows_of(const FlowNetwork& network, const NetworkParts& parts, std::int32_t& count) {
  std::vector<std::int32_t> row(network.node_count(), no_row);
  for (std::size_t n = 0; n < row.size(); ++n)
    if (!network.fixed[n] && parts.is_held[static_cast<std::size_t>(parts.of_node[n])] != 0) row[n] = count++;
  return row;
}

/// Conductances between free nodes, and what fixed and held potentials and sources push into them.
class Equation {
 public:
  enum class Form : std::uint8_t { two_point, whole };

  Equation(const FlowNetwork& network, const std::vector<std::int32_t>& row, std::int32_t count, double reference,
           Form form)
      : network_(network),
        reference_(reference),
        row_(row),
        diagonal_(static_cast<std::size_t>(count), 0.0),
        right_(Eigen::VectorXd::Zero(count)) {
    entries_.reserve(2 * network.links.size() + diagonal_.size());
    for (const FlowNetwork::Link& link : network.links) {
      if (form == Form::two_point || link.stencil.empty()) {
        add(link.a, link.b, link.conductance);
      } else {
        add(at(link.a), link.stencil, 1.0);
        add(at(link.b), link.stencil, -1.0);
      }
    }
    for (const FlowNetwork::Hold& held : network.holds) {
      if (form == Form::two_point || held.stencil.empty()) {
        hold(at(held.node), held.conductance, held.potential - reference);
      } else {
        add(at(held.node), held.stencil, 1.0);
        if (at(held.node) != no_row) right_[at(held.node)] += held.conductance * (held.potential - reference);
      }
    }
    for (std::size_t n = 0; n < row.size(); ++n)
      if (row[n] != no_row) right_[row[n]] += network.source[n];
  }

  [[nodiscard]] SparseMatrix matrix() {
    const auto count = static_cast<std::int32_t>(diagonal_.size());
    for (std::int32_t r = 0; r < count; ++r) entries_.emplace_back(r, r, diagonal_[static_cast<std::size_t>(r)]);
    SparseMatrix out(count, count);
    out.setFromTriplets(entries_.begin(), entries_.end());
    return out;
  }
  [[nodiscard]] const Eigen::VectorXd& right() const { return right_; }

 private:
  [[nodiscard]] std::int32_t at(Node node) const { return row_[static_cast<std::size_t>(node)]; }

  void hold(std::int32_t row, double conductance, double potential) {
    if (row == no_row) return;
    diagonal_[static_cast<std::size_t>(row)] += conductance;
    right_[row] += conductance * potential;
  }

  [[nodiscard]] const std::optional<double>& fixed(Node node) const {
    return network_.fixed[static_cast<std::size_t>(node)];
  }

  void add(Node a, Node b, double conductance) {
    if (at(a) == no_row || at(b) == no_row) {
      if (fixed(b)) hold(at(a), conductance, *fixed(b) - reference_);
      if (fixed(a)) hold(at(b), conductance, *fixed(a) - reference_);
      return;
    }
    diagonal_[static_cast<std::size_t>(at(a))] += conductance;
    diagonal_[static_cast<std::size_t>(at(b))] += conductance;
    entries_.emplace_back(at(a), at(b), -conductance);
    entries_.emplace_back(at(b), at(a), -conductance);
  }

  /// A flow out of the row's node.
  void add(std::int32_t row, const FlowStencil& stencil, double sign) {
    if (row == no_row) return;
    for (std::size_t n = 0; n < stencil.nodes.size(); ++n) {
      const auto node = static_cast<Node>(stencil.nodes[n].value());
      const double value = sign * stencil.scale * stencil.coefficients[n];
      if (at(node) != no_row) {
        entries_.emplace_back(row, at(node), value);
      } else if (fixed(node)) {
        right_[row] -= value * (*fixed(node) - reference_);
      }
    }
  }

  const FlowNetwork& network_;
  double reference_;
  const std::vector<std::int32_t>& row_;
  std::vector<double> diagonal_;
  std::vector<Eigen::Triplet<double, std::int32_t>> entries_;
  Eigen::VectorXd right_;
};

}  // namespace

NetworkParts network_parts(const FlowNetwork& network) {
  Sets sets(network.node_count());
  for (const FlowNetwork::Link& link : network.links) sets.join(link.a, link.b);
  NetworkParts out;
  out.of_node.resize(network.node_count());
  for (std::size_t n = 0; n < out.of_node.size(); ++n) {
    const Node root = sets.root(static_cast<Node>(n));
    if (static_cast<std::size_t>(root) == n) {
      out.of_node[n] = static_cast<std::int32_t>(out.is_held.size());
      out.is_held.push_back(0);
    } else {
      out.of_node[n] = out.of_node[static_cast<std::size_t>(root)];
    }
    if (network.fixed[n]) out.is_held[static_cast<std::size_t>(out.of_node[n])] = 1;
  }
  for (const FlowNetwork::Hold& hold : network.holds)
    out.is_held[static_cast<std::size_t>(out.of_node[static_cast<std::size_t>(hold.node)])] = 1;
  return out;
}

NetworkSolution solve(const FlowNetwork& network, const NetworkParts& parts, const PressureSolverOptions& options) {
  NetworkSolution out;
  out.reference = lowest_held(network);
  std::int32_t count = 0;
  const std::vector<std::int32_t> row = rows_of(network, parts, count);
  {
    Equation equation(network, row, count, out.reference, Equation::Form::whole);
    const bool is_two_point = std::all_of(network.links.begin(), network.links.end(),
                                          [](const FlowNetwork::Link& link) { return link.stencil.empty(); });
    if (is_two_point) {
      out.equation = solve_pressure(equation.matrix(), equation.right(), options);
    } else {
      Equation near(network, row, count, out.reference, Equation::Form::two_point);
      out.equation = solve_pressure(equation.matrix(), near.matrix(), equation.right(), options);
    }
  }
  out.potential.assign(network.node_count(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t n = 0; n < out.potential.size(); ++n) {
    if (row[n] != no_row) out.potential[n] = out.equation.values[row[n]];
    if (network.fixed[n]) out.potential[n] = *network.fixed[n] - out.reference;
  }
  return out;
}

}  // namespace wellknit
