// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/adapted_flux.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "algorithm/consistent_flux.h"
#include "algorithm/flow_network.h"
#include "algorithm/linear_flux_error.h"
#include "algorithm/steady_flow.h"
#include "model/errors.h"

namespace wellknit {

namespace {

/// A transmissibility becomes at most so many times as large or as small. A hundred fits no better (validation), and
/// time steps of a simulator would suffer.
constexpr double most_change = 10.0;
/// A connection that carries less than this part of the flow of its two cells keeps about its own transmissibility:
/// flux over drop is a ratio of two small numbers there.
constexpr double marginal_flow = 0.1;
/// Of the energy of a mean well's field in each of the three linear ones. Less fits the wells better and flow past them
/// worse (docs/algorithms/adapted_flux.md).
constexpr double linear_share = 0.1;
/// More wells than this flow in groups, each of wells far from each other: a field costs as much as a solution.
constexpr std::size_t most_groups = 8;
constexpr int most_rounds = 8;
/// Rounds end when one leaves more than this of the imbalance.
constexpr double least_gain = 0.95;

/// One flow through the rock, with multi-point fluxes. Pressures are of no unit that matters.
struct FlowField {
  std::vector<double> drop;    ///< of each connection, from its first to its second cell
  std::vector<double> flux;    ///< of each connection, viscosity 1
  std::vector<double> source;  ///< of each cell: what its connections carry away
};

double energy(const FlowField& field) {
  double sum = 0.0;
  for (std::size_t n = 0; n < field.drop.size(); ++n) sum += std::abs(field.drop[n] * field.flux[n]);
  return sum;
}

/// Empty where the equations are not solved or nothing flows.
std::optional<FlowField> solved(const Mesh& mesh, SteadyFlowProblem problem) {
  problem.viscosity = 1.0;
  problem.consistent = true;
  // Far below what two points can be fitted to.
  problem.solver.tolerance = 1e-10;
  try {
    const SteadyFlow flow = solve_steady_flow(mesh, problem);
    const Connections& c = mesh.connections;
    FlowField out;
    out.flux.assign(flow.solution.flux.begin(), flow.solution.flux.end());
    out.drop.resize(c.size());
    out.source.assign(mesh.cells.size(), 0.0);
    for (std::size_t n = 0; n < c.size(); ++n) {
      const auto [a, b] = c.cells[ConnectionId(n)];
      const double drop = flow.solution.pressure[a] - flow.solution.pressure[b];
      out.drop[n] = std::isfinite(drop) ? drop : 0.0;
      out.source[a.index()] += out.flux[n];
      out.source[b.index()] -= out.flux[n];
    }
    if (energy(out) > 0.0) return out;
  } catch (const InvalidInput&) {
    // The other fields serve too.
  }
  return std::nullopt;
}

/// Wells of one group have one pressure, the others are shut; the rock gives off what they take.
SteadyFlowProblem flow_to(const Mesh& mesh, const std::vector<std::size_t>& group) {
  SteadyFlowProblem out;
  out.expansion = 1.0;
  out.wells.resize(mesh.wells.size());
  for (const std::size_t well : group) out.wells[WellId(well)] = {WellControl::Kind::pressure, 0.0};
  return out;
}

/// A linear pressure on the outside, but in the bores; all wells are shut.
SteadyFlowProblem flow_along(const Mesh& mesh, Eigen::Index axis) {
  SteadyFlowProblem out;
  out.wells.resize(mesh.wells.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [cell, other] = mesh.faces.cells[FaceId(f)];
    if (other.is_valid() || mesh.cells.kind[cell] == CellKind::radial) continue;
    out.faces.push_back({FaceId(f), face_geometry(mesh, FaceId(f)).centroid[axis]});
  }
  return out;
}

/// Each well goes to the group whose nearest well is farthest from it.
std::vector<std::vector<std::size_t>> groups_of(const Mesh& mesh) {
  std::vector<std::vector<std::size_t>> out;
  std::vector<Vec3> places(mesh.wells.size(), Vec3::Zero());
  for (std::size_t w = 0; w < mesh.wells.size(); ++w) {
    double sum = 0.0;
    for (const WellConnection& c : mesh.wells[WellId(w)].connections) {
      if (!(c.well_index > 0.0)) continue;
      places[w] += mesh.cells.center[c.cell];
      sum += 1.0;
    }
    if (!(sum > 0.0)) continue;
    places[w] /= sum;
    if (out.size() < most_groups) {
      out.push_back({w});
      continue;
    }
    std::size_t best = 0;
    double farthest = -1.0;
    for (std::size_t g = 0; g < out.size(); ++g) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const std::size_t other : out[g]) nearest = std::min(nearest, (places[w] - places[other]).norm());
      if (nearest <= farthest) continue;
      farthest = nearest;
      best = g;
    }
    out[best].push_back(w);
  }
  return out;
}

/// Fields to the wells, each of the same flow, and with them linear ones. `not_solved` counts those that are missing.
std::vector<FlowField> fields_of(const Mesh& mesh, std::int64_t& not_solved) {
  const std::vector<std::vector<std::size_t>> groups = groups_of(mesh);
  if (groups.empty()) return {};
  std::vector<std::optional<FlowField>> found(groups.size() + 3);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t n) {
    const bool is_linear = n >= groups.size();
    found[n] = solved(
        mesh, is_linear ? flow_along(mesh, static_cast<Eigen::Index>(n - groups.size())) : flow_to(mesh, groups[n]));
  });
  std::vector<FlowField> out;
  double mean = 0.0;
  for (std::size_t n = 0; n < found.size(); ++n) {
    if (n == groups.size()) {
      if (out.empty()) return {};
      for (const FlowField& field : out) mean += energy(field) / static_cast<double>(out.size());
    }
    if (!found[n]) {
      ++not_solved;
      continue;
    }
    out.push_back(std::move(*found[n]));
    if (n < groups.size()) continue;
    const double scale = std::sqrt(linear_share * mean / energy(out.back()));
    for (auto* values : {&out.back().drop, &out.back().flux, &out.back().source})
      for (double& value : *values) value *= scale;
  }
  return out;
}

/// Two points cannot give a cell's fluxes as several do. So it is not the multi-point fluxes themselves that are fitted
/// to but, from the second round on, the nearest ones to the two-point fluxes of these pressures that balance in each
/// cell: the pressures are then nearly those of the two-point equations.
class Fit {
 public:
  Fit(const Mesh& mesh, const std::vector<FlowField>& fields)
      : mesh_(mesh),
        fields_(fields),
        own_(mesh.connections.transmissibility.begin(), mesh.connections.transmissibility.end()),
        fitted_(own_) {
    for (const FlowField& field : fields) wanted_.push_back(field.flux);
    choose();
  }

  void run(FluxAdaptation& out) {
    out.fields = static_cast<std::int64_t>(fields_.size());
    out.imbalance_before = imbalance();
    fit();
    out.imbalance_after = imbalance();
    for (int round = 0; round < most_rounds; ++round) {
      if (!balance()) break;
      fit();
      const double left = imbalance();
      const bool has_stalled = !(left < least_gain * out.imbalance_after);
      out.imbalance_after = left;
      if (has_stalled) break;
    }
    count(out);
  }

  [[nodiscard]] const std::vector<double>& transmissibilities() const { return fitted_; }

 private:
  [[nodiscard]] const std::array<CellId, 2>& cells(std::size_t n) const {
    return mesh_.connections.cells[ConnectionId(n)];
  }
  [[nodiscard]] bool conducts(std::size_t n) const { return own_[n] > 0.0 && std::isfinite(own_[n]); }

  /// Inside of a tube flow is radial, and its transmissibilities are right.
  [[nodiscard]] bool may_change(std::size_t n) const {
    const auto [a, b] = cells(n);
    const auto& kind = mesh_.cells.kind;
    const bool is_in_tube = kind[a] == CellKind::radial && kind[b] == CellKind::radial;
    return conducts(n) && !is_in_tube && mesh_.connections.face[ConnectionId(n)].is_valid();
  }

  /// How much each connection is drawn to the fields and to its own transmissibility.
  void choose() {
    weight_.assign(own_.size(), 0.0);
    own_weight_.assign(own_.size(), 0.0);
    std::vector<double> most(mesh_.cells.size(), 0.0);
    for (std::size_t n = 0; n < own_.size(); ++n) {
      if (!conducts(n)) continue;
      for (const FlowField& field : fields_) weight_[n] += field.drop[n] * field.drop[n];
      for (const CellId cell : cells(n)) most[cell.index()] = std::max(most[cell.index()], own_[n] * weight_[n]);
    }
    for (std::size_t n = 0; n < own_.size(); ++n) {
      const auto [a, b] = cells(n);
      if (!may_change(n))
        weight_[n] = 0.0;
      else
        own_weight_[n] = marginal_flow * marginal_flow * std::min(most[a.index()], most[b.index()]) / own_[n];
    }
  }

  /// Least squares over the fields.
  void fit() {
    for (std::size_t n = 0; n < own_.size(); ++n) {
      if (!(weight_[n] > 0.0)) continue;
      double sum = own_weight_[n] * own_[n];
      for (std::size_t f = 0; f < fields_.size(); ++f) sum += wanted_[f][n] * fields_[f].drop[n];
      fitted_[n] = std::clamp(sum / (weight_[n] + own_weight_[n]), own_[n] / most_change, own_[n] * most_change);
    }
  }

  /// Of each cell: its source less what two-point fluxes carry away.
  [[nodiscard]] std::vector<double> surplus(const FlowField& field) const {
    std::vector<double> out = field.source;
    for (std::size_t n = 0; n < own_.size(); ++n) {
      if (!conducts(n)) continue;
      const auto [a, b] = cells(n);
      out[a.index()] -= fitted_[n] * field.drop[n];
      out[b.index()] += fitted_[n] * field.drop[n];
    }
    return out;
  }

  [[nodiscard]] double imbalance() const {
    double sum = 0.0;
    double flow = 0.0;
    for (const FlowField& field : fields_) {
      for (const double value : surplus(field)) sum += std::abs(value);
      for (const double value : field.source) flow += std::abs(value);
    }
    return flow > 0.0 ? sum / flow : 0.0;
  }

  /// A node for each cell; in each part the first one is fixed, since sources alone give no level.
  [[nodiscard]] FlowNetwork network() const {
    FlowNetwork out;
    out.fixed.resize(mesh_.cells.size());
    out.source.assign(mesh_.cells.size(), 0.0);
    for (std::size_t n = 0; n < own_.size(); ++n) {
      const auto [a, b] = cells(n);
      if (conducts(n))
        out.links.push_back(
            {static_cast<FlowNetwork::Node>(a.value()), static_cast<FlowNetwork::Node>(b.value()), fitted_[n], {}});
    }
    const NetworkParts parts = network_parts(out);
    std::vector<std::uint8_t> seen(parts.size(), 0);
    for (std::size_t n = 0; n < parts.of_node.size(); ++n)
      if (auto& has_one = seen[static_cast<std::size_t>(parts.of_node[n])]; has_one == 0) {
        has_one = 1;
        out.fixed[n] = 0.0;
      }
    return out;
  }

  /// The wanted fluxes of the next round; false where the equations are not solved.
  bool balance() {
    const FlowNetwork network = this->network();
    const NetworkParts parts = network_parts(network);
    PressureSolverOptions options;
    options.tolerance = 1e-8;  // of a correction
    std::vector<std::uint8_t> is_solved(fields_.size(), 0);
    tbb::parallel_for(std::size_t{0}, fields_.size(), [&](std::size_t f) {
      FlowNetwork own = network;
      own.source = surplus(fields_[f]);
      try {
        const NetworkSolution more = solve(own, parts, options);
        for (std::size_t n = 0; n < own_.size(); ++n) {
          const auto [a, b] = cells(n);
          if (conducts(n))
            wanted_[f][n] = fitted_[n] * (fields_[f].drop[n] + more.potential[a.index()] - more.potential[b.index()]);
        }
        is_solved[f] = 1;
      } catch (const InvalidInput&) {
      }
    });
    return std::all_of(is_solved.begin(), is_solved.end(), [](std::uint8_t one) { return one != 0; });
  }

  void count(FluxAdaptation& out) const {
    for (std::size_t n = 0; n < own_.size(); ++n) {
      if (!(weight_[n] > 0.0)) continue;
      const double change = std::abs(std::log(fitted_[n] / own_[n]));
      ++out.connections;
      out.changed += change > std::log(1.01) ? 1 : 0;
      out.at_limit += change > std::log(0.999 * most_change) ? 1 : 0;
    }
  }

  const Mesh& mesh_;
  const std::vector<FlowField>& fields_;
  std::vector<double> own_;                  ///< transmissibilities as they were, m3
  std::vector<double> fitted_;               ///< m3
  std::vector<std::vector<double>> wanted_;  ///< of each field: the fluxes to fit to
  std::vector<double> weight_;               ///< of a connection; 0: it stays
  std::vector<double> own_weight_;
};

/// Of a connection whose transmissibility has changed.
Vec3 error_of(const Mesh& mesh, const FluxDefects& defects, ConnectionId id) {
  const Connections& c = mesh.connections;
  const auto [a, b] = c.cells[id];
  return linear_flux_error({face_geometry(mesh, c.face[id]).centroid,
                            c.area[id] * c.normal[id],
                            {mesh.cells.center[a], mesh.cells.center[b]},
                            {defects.permeability[a.index()], defects.permeability[b.index()]}},
                           c.transmissibility[id] / c.multiplier[id]);
}

}  // namespace

FluxAdaptation adapt_transmissibilities(Mesh& mesh, const FluxDefects& defects) {
  FluxAdaptation out;
  const std::vector<FlowField> fields = fields_of(mesh, out.not_solved);
  if (fields.empty()) return out;
  Fit fit(mesh, fields);
  fit.run(out);
  Connections& c = mesh.connections;
  for (std::size_t n = 0; n < c.size(); ++n) {
    const ConnectionId id(n);
    const double fitted = fit.transmissibilities()[n];
    if (fitted == c.transmissibility[id]) continue;
    c.transmissibility[id] = fitted;
    if (!c.linear_flux_error.empty() && c.multiplier[id] > 0.0) c.linear_flux_error[id] = error_of(mesh, defects, id);
  }
  return out;
}

}  // namespace wellknit
