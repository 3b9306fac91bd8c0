// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Everything is computed with potentials p - density * g * (depth - datum) from a datum on: with gravity too the flow
// between two nodes is conductance * difference.

#include "algorithm/steady_flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithm/boundary_conductance.h"
#include "algorithm/flow_network.h"
#include "model/errors.h"

namespace wellknit {

namespace {

using Node = FlowNetwork::Node;
using Kind = WellControl::Kind;

constexpr double standard_gravity = 9.80665;  ///< m/s2, exact by definition
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr Node no_node = -1;

void check_once(std::vector<std::uint8_t>& seen, std::int64_t index, const char* what) {
  if (index < 0 || index >= static_cast<std::int64_t>(seen.size()))
    throw InvalidInput(
        fmt::format("{} {} cannot hold a pressure: there are {} of them, from 0", what, index, seen.size()));
  if (seen[static_cast<std::size_t>(index)] != 0)
    throw InvalidInput(fmt::format("{} {} is given a pressure twice", what, index));
  seen[static_cast<std::size_t>(index)] = 1;
}

void check_held(const Mesh& mesh, const SteadyFlowProblem& problem) {
  std::vector<std::uint8_t> seen(mesh.faces.size(), 0);
  for (const HeldFace& held : problem.faces) {
    check_once(seen, held.face.value(), "face");
    if (mesh.faces.cells[held.face][1].is_valid())
      throw InvalidInput(fmt::format(
          "face {} lies between two cells: only faces of the outer boundary can hold a pressure", held.face.value()));
    if (!std::isfinite(held.pressure))
      throw InvalidInput(fmt::format("the pressure of face {} is not finite", held.face.value()));
  }
  seen.assign(mesh.cells.size(), 0);
  for (const HeldCell& held : problem.cells) {
    check_once(seen, held.cell.value(), "cell");
    if (!std::isfinite(held.pressure))
      throw InvalidInput(fmt::format("the pressure of cell {} is not finite", held.cell.value()));
  }
}

void check_problem(const Mesh& mesh, const SteadyFlowProblem& problem) {
  if (!(problem.viscosity > 0.0) || !std::isfinite(problem.viscosity))
    throw InvalidInput(fmt::format("a viscosity of {} Pa s: expected a positive number", problem.viscosity));
  if (!std::isfinite(problem.density) || !std::isfinite(problem.expansion))
    throw InvalidInput("the density and the expansion must be finite numbers");
  if (problem.wells.size() != mesh.wells.size())
    throw InvalidInput(fmt::format("{} well controls for {} wells", problem.wells.size(), mesh.wells.size()));
  for (std::size_t w = 0; w < mesh.wells.size(); ++w)
    if (!std::isfinite(problem.wells[WellId(w)].value))
      throw InvalidInput(fmt::format("well {}: its pressure or rate is not finite", mesh.wells[WellId(w)].name));
  if (problem.consistent && !mesh.stencils)
    throw InvalidInput(
        "the mesh has no consistent fluxes: build it with --fluxes consistent, or solve with --fluxes two-point");
  check_held(mesh, problem);
}

/// Depth that the bore's pressure refers to: the well's own, else that of its shallowest cell.
double reference_depth(const Mesh& mesh, const MeshWell& well) {
  if (well.reference_depth) return *well.reference_depth;
  double depth = std::numeric_limits<double>::infinity();
  for (const WellConnection& c : well.connections) depth = std::min(depth, mesh.cells.depth[c.cell]);
  return std::isfinite(depth) ? depth : 0.0;
}

/// One run: the network of a mesh, its solution, and what follows from it.
class SteadyFlowRun {
 public:
  SteadyFlowRun(const Mesh& mesh, const SteadyFlowProblem& problem)
      : mesh_(mesh), problem_(problem), weight_(problem.density * standard_gravity) {}

  SteadyFlow run() {
    add_cells();
    add_connections();
    add_faces();
    add_wells();
    parts_ = network_parts(network_);
    refuse_flow_from_nowhere();
    spread_expansion();
    solution_ = solve(network_, parts_, problem_.solver);
    take_statistics();
    take_cells();
    take_wells();
    take_balance();
    return std::move(out_);
  }

 private:
  [[nodiscard]] double potential(double pressure, double depth) const { return pressure - weight_ * depth; }
  [[nodiscard]] double pressure(Node node, double depth) const {
    return solution_.potential[static_cast<std::size_t>(node)] + solution_.reference + weight_ * depth;
  }
  /// Less the solution's reference.
  [[nodiscard]] double relative(CellId cell) const { return solution_.potential[cell.index()]; }
  [[nodiscard]] bool is_held(Node node) const {
    return parts_.is_held[static_cast<std::size_t>(parts_.of_node[static_cast<std::size_t>(node)])] != 0;
  }
  [[nodiscard]] static bool conducts(double t) { return t > 0.0 && std::isfinite(t); }
  /// m3/(s Pa)
  [[nodiscard]] double mobility(double t) const { return t / problem_.viscosity; }
  [[nodiscard]] static Node node_of(CellId cell) { return static_cast<Node>(cell.value()); }

  void add_cells() {
    network_.fixed.resize(mesh_.cells.size());
    network_.source.assign(mesh_.cells.size(), 0.0);
    for (const auto& [cell, held] : problem_.cells)
      network_.fixed[cell.index()] = potential(held, mesh_.cells.depth[cell]);
  }

  void add_connections() {
    for (std::size_t c = 0; c < mesh_.connections.size(); ++c) {
      const double t = mesh_.connections.transmissibility[ConnectionId(c)];
      const auto [a, b] = mesh_.connections.cells[ConnectionId(c)];
      if (conducts(t)) {
        network_.links.push_back({node_of(a), node_of(b), mobility(t), stencil_of(ConnectionId(c))});
      } else {
        ++(t == 0.0 ? out_.closed_connections : out_.refused_connections);
      }
    }
  }

  void add_faces() {
    face_conductance_.reserve(problem_.faces.size());
    for (const auto& [face, held] : problem_.faces) {
      const FlowStencil stencil = stencil_of(face);
      const double t = boundary_conductance(mesh_, face);
      face_stencil_.push_back(stencil);
      face_conductance_.push_back(conducts(t) ? mobility(t) : 0.0);
      face_potential_.push_back(potential(held, face_geometry(mesh_, face).centroid.z()));
      if (!conducts(t)) {
        ++out_.closed_faces;
        continue;
      }
      network_.holds.push_back({node_of(mesh_.faces.cells[face][0]), mobility(t), face_potential_.back(), stencil});
    }
  }

  /// Of a connection; empty where fluxes are two-point.
  [[nodiscard]] FlowStencil stencil_of(ConnectionId connection) const {
    if (!problem_.consistent) return {};
    const FluxStencils& s = *mesh_.stencils;
    return stencil(s.cells, s.coefficients, s.start[connection.index()], s.start[connection.index() + 1]);
  }
  [[nodiscard]] FlowStencil stencil_of(FaceId face) const {
    if (!problem_.consistent) return {};
    const FluxStencils& s = *mesh_.stencils;
    const auto found = std::lower_bound(s.boundary_face.begin(), s.boundary_face.end(), face);
    if (found == s.boundary_face.end() || *found != face) return {};
    const auto n = static_cast<std::size_t>(found - s.boundary_face.begin());
    return stencil(s.boundary_cells, s.boundary_coefficients, s.boundary_start[n], s.boundary_start[n + 1]);
  }
  [[nodiscard]] FlowStencil stencil(const std::vector<CellId>& cells, const std::vector<double>& coefficients,
                                    std::int64_t from, std::int64_t to) const {
    const auto begin = static_cast<std::size_t>(from);
    const auto count = static_cast<std::size_t>(to - from);
    return {std::span(cells).subspan(begin, count), std::span(coefficients).subspan(begin, count), mobility(1.0)};
  }

  void add_wells() {
    for (std::size_t w = 0; w < mesh_.wells.size(); ++w) {
      const WellControl& control = problem_.wells[WellId(w)];
      const MeshWell& well = mesh_.wells[WellId(w)];
      well_node_.push_back(no_node);
      if (control.kind == Kind::rate) {
        well_node_.back() = network_.add_node();
        network_.source.back() = -control.value;
      }
      for (const WellConnection& c : well.connections) {
        if (control.kind == Kind::shut || !conducts(c.well_index)) continue;
        if (control.kind == Kind::rate)
          network_.links.push_back({node_of(c.cell), well_node_.back(), mobility(c.well_index), {}});
        else
          network_.holds.push_back({node_of(c.cell), mobility(c.well_index), bore_potential(WellId(w)), {}});
      }
    }
  }

  /// Of a well on pressure.
  [[nodiscard]] double bore_potential(WellId well) const {
    return potential(problem_.wells[well].value, reference_depth(mesh_, mesh_.wells[well]));
  }

  [[nodiscard]] std::vector<IsolatedPart> cells_of_parts() const {
    std::vector<IsolatedPart> out(parts_.size());
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      IsolatedPart& part = out[static_cast<std::size_t>(parts_.of_node[c])];
      if (part.cells++ == 0) part.first_cell = CellId(c);
    }
    return out;
  }

  void refuse_flow_from_nowhere() {
    const std::vector<IsolatedPart> cells = cells_of_parts();
    for (std::size_t w = 0; w < well_node_.size(); ++w) {
      const Node node = well_node_[w];
      if (node == no_node || is_held(node) || problem_.wells[WellId(w)].value == 0.0) continue;
      const IsolatedPart& part = cells[static_cast<std::size_t>(parts_.of_node[static_cast<std::size_t>(node)])];
      const std::string& name = mesh_.wells[WellId(w)].name;
      if (part.cells == 0)
        throw InvalidInput(fmt::format("well {}: has a rate and no connection that conducts; shut it", name));
      throw InvalidInput(fmt::format(
          "well {}: has a rate in a part of the mesh where nothing holds a pressure ({} cells, the first is "
          "cell {}{}): give a well there a pressure, or hold a boundary or a cell",
          name, part.cells, part.first_cell.value(), place_of(part.first_cell)));
    }
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (parts_.is_held[p] == 0 && cells[p].cells > 0) out_.isolated.push_back(cells[p]);
  }

  /// " at (i,j,k)" of a host cell, from 1.
  [[nodiscard]] std::string place_of(CellId cell) const {
    const HostCellId source = mesh_.cells.source_cell[cell];
    const auto [nx, ny, nz] = mesh_.source_dimensions;
    if (!source.is_valid() || nx < 1 || ny < 1) return "";
    return fmt::format(" at ({},{},{})", source.value() % nx + 1, source.value() / nx % ny + 1,
                       source.value() / (nx * ny) + 1);
  }

  void spread_expansion() {
    cell_expansion_.assign(mesh_.cells.size(), 0.0);
    if (problem_.expansion == 0.0) return;
    for (const auto* sizes : {&mesh_.cells.pore_volume, &mesh_.cells.volume}) {
      double total = 0.0;
      for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
        if (is_held(static_cast<Node>(c))) total += (*sizes)[CellId(c)];
      if (!(total > 0.0)) continue;
      for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
        if (!is_held(static_cast<Node>(c))) continue;
        cell_expansion_[c] = problem_.expansion * (*sizes)[CellId(c)] / total;
        if (!network_.fixed[c]) network_.source[c] += cell_expansion_[c];
      }
      return;
    }
  }

  void take_statistics() {
    out_.unknowns = solution_.equation.values.size();
    out_.method = solution_.equation.method;
    out_.iterations = solution_.equation.iterations;
    out_.residual = solution_.equation.residual;
  }

  void take_cells() {
    out_.solution.pressure.resize(mesh_.cells.size());
    surplus_ = cell_expansion_;
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      out_.solution.pressure[CellId(c)] = pressure(static_cast<Node>(c), mesh_.cells.depth[CellId(c)]);
    out_.solution.flux.resize(mesh_.connections.size(), 0.0);
    for (std::size_t c = 0; c < mesh_.connections.size(); ++c) {
      const double t = mesh_.connections.transmissibility[ConnectionId(c)];
      const auto [a, b] = mesh_.connections.cells[ConnectionId(c)];
      if (!conducts(t) || !is_held(node_of(a))) continue;
      const FlowStencil stencil = stencil_of(ConnectionId(c));
      const double flux =
          stencil.empty() ? mobility(t) * (relative(a) - relative(b)) : stencil.flow(solution_.potential);
      out_.solution.flux[ConnectionId(c)] = flux;
      surplus_[a.index()] -= flux;
      surplus_[b.index()] += flux;
    }
    for (std::size_t f = 0; f < problem_.faces.size(); ++f) {
      const CellId cell = mesh_.faces.cells[problem_.faces[f].face][0];
      const double outside = face_potential_[f] - solution_.reference;
      const FlowStencil& stencil = face_stencil_[f];
      const double inside = stencil.empty() ? face_conductance_[f] * relative(cell) : stencil.flow(solution_.potential);
      const double rate = face_conductance_[f] > 0.0 ? inside - face_conductance_[f] * outside : 0.0;
      out_.face_rate.push_back(rate);
      surplus_[cell.index()] -= rate;
    }
  }

  void take_wells() {
    const std::vector<double> means = mean_potentials();
    for (std::size_t w = 0; w < mesh_.wells.size(); ++w) {
      const WellFlow flow = take_well(WellId(w), means);
      out_.solution.well_pressure.push_back(flow.pressure);
      out_.solution.well_rate.push_back(flow.rate);
      out_.solution.well_connection_rate.insert(out_.solution.well_connection_rate.end(), flow.connection_rate.begin(),
                                                flow.connection_rate.end());
      out_.wells.push_back(flow);
    }
  }

  WellFlow take_well(WellId id, const std::vector<double>& means) {
    const MeshWell& well = mesh_.wells[id];
    WellFlow flow;
    flow.reference_depth = reference_depth(mesh_, well);
    flow.connection_rate.assign(well.connections.size(), 0.0);
    const double bore = this->bore(id);
    flow.pressure = bore + solution_.reference + weight_ * flow.reference_depth;
    flow.mean_pressure = flow.productivity_index = not_known;
    double mean = not_known;
    for (std::size_t n = 0; n < well.connections.size(); ++n) {
      const auto& [cell, well_index, range] = well.connections[n];
      if (!conducts(well_index) || !std::isfinite(bore) || !is_held(node_of(cell))) continue;
      flow.connection_rate[n] = mobility(well_index) * (relative(cell) - bore);
      flow.rate += flow.connection_rate[n];
      surplus_[cell.index()] -= flow.connection_rate[n];
      if (std::isnan(mean)) mean = means[static_cast<std::size_t>(parts_.of_node[cell.index()])];
    }
    for (const double rate : flow.connection_rate)
      if (rate * flow.rate < 0.0) flow.crossflow += std::abs(rate);
    flow.mean_pressure = mean + solution_.reference + weight_ * flow.reference_depth;
    if (mean != bore) flow.productivity_index = flow.rate / (mean - bore);
    return flow;
  }

  /// Potential in the bore less the reference; not a number where it is shut or isolated.
  [[nodiscard]] double bore(WellId well) const {
    if (problem_.wells[well].kind == Kind::pressure) return bore_potential(well) - solution_.reference;
    const Node node = well_node_[well.index()];
    return node == no_node ? not_known : solution_.potential[static_cast<std::size_t>(node)];
  }

  /// Of each part, by pore volume; by bulk volume where it has no pores.
  [[nodiscard]] std::vector<double> mean_potentials() const {
    struct Sum {
      double volume = 0.0;
      double value = 0.0;
    };
    std::vector<double> out(parts_.size(), not_known);
    for (const auto* sizes : {&mesh_.cells.volume, &mesh_.cells.pore_volume}) {
      std::vector<Sum> sums(parts_.size());
      for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
        Sum& sum = sums[static_cast<std::size_t>(parts_.of_node[c])];
        sum.volume += (*sizes)[CellId(c)];
        sum.value += (*sizes)[CellId(c)] * relative(CellId(c));
      }
      for (std::size_t p = 0; p < out.size(); ++p)
        if (sums[p].volume > 0.0) out[p] = sums[p].value / sums[p].volume;
    }
    return out;
  }

  /// What comes in and goes out, from the rates as they are given; held cells make up for the surplus of theirs.
  void take_balance() {
    FlowBalance& balance = out_.balance;
    const auto count = [&](double outwards) { (outwards > 0.0 ? balance.out : balance.in) += std::abs(outwards); };
    for (const double rate : out_.face_rate) count(rate);
    for (const double rate : out_.solution.well_connection_rate) count(rate);
    for (const double rate : cell_expansion_) count(-rate);
    for (const HeldCell& held : problem_.cells) {
      out_.cell_rate.push_back(surplus_[held.cell.index()]);
      count(out_.cell_rate.back());
      surplus_[held.cell.index()] = 0.0;
    }
    const double throughput = std::max(balance.in, balance.out);
    if (!(throughput > 0.0)) return;
    balance.error = std::abs(balance.in - balance.out) / throughput;
    for (const double surplus : surplus_)
      balance.largest_cell = std::max(balance.largest_cell, std::abs(surplus) / throughput);
  }

  const Mesh& mesh_;
  const SteadyFlowProblem& problem_;
  double weight_;  ///< density * g, Pa/m
  FlowNetwork network_;
  NetworkParts parts_;
  NetworkSolution solution_;
  std::vector<Node> well_node_;           ///< of wells on rate
  std::vector<double> face_conductance_;  ///< m3/(s Pa); 0: closed
  std::vector<double> face_potential_;
  std::vector<FlowStencil> face_stencil_;
  std::vector<double> cell_expansion_;  ///< m3/s
  std::vector<double> surplus_;         ///< m3/s, of each cell: what comes in less what goes out
  SteadyFlow out_;
};

}  // namespace

SteadyFlow solve_steady_flow(const Mesh& mesh, const SteadyFlowProblem& problem) {
  check_problem(mesh, problem);
  return SteadyFlowRun(mesh, problem).run();
}

}  // namespace wellknit
