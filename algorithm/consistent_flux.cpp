// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/consistent_flux.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "algorithm/boundary_conductance.h"
#include "model/geometry.h"

namespace wellknit {

namespace {

/// Directions that the neighbours of a cell span less than this, of the best one, have no slope: the cells of a single
/// layer have none across it.
constexpr double least_spread = 1e-4;

/// Of what near_well_parts() adds.
constexpr double largest_part = 0.25;

/// The point where the pressure is the mean of two cells' whatever its slope, and the share of the second cell in it.
struct AveragingPoint {
  Vec3 offset = Vec3::Zero();  ///< from the first cell's centre
  double share = 0.0;
};

struct CellSlope {
  struct Part {
    CellId cell;
    Vec3 weight;  ///< of the neighbour's pressure less the cell's own, 1/m
  };
  std::vector<Part> parts;
};

struct Term {
  CellId cell;
  double coefficient = 0.0;
};

/// The slope of the pressure in cells from those of their neighbours, exact for a pressure that is linear in each cell
/// and has one flux through each face.
class Slopes {
 public:
  /// Of the cells with a `wanted` of 1; `permeability` of each cell, empty: the same everywhere.
  Slopes(const Mesh& mesh, const std::vector<Eigen::Matrix3d>& permeability, const std::vector<std::uint8_t>& wanted)
      : mesh_(mesh), permeability_(permeability) {
    start_.assign(mesh.cells.size() + 1, 0);
    for_each_neighbour([&](CellId cell, ConnectionId) { ++start_[cell.index() + 1]; });
    for (std::size_t n = 0; n < mesh.cells.size(); ++n) start_[n + 1] += start_[n];
    around_.resize(start_.back());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for_each_neighbour([&](CellId cell, ConnectionId connection) { around_[next[cell.index()]++] = connection; });
    slopes_.resize(mesh.cells.size());
    tbb::parallel_for(std::size_t{0}, slopes_.size(), [&](std::size_t n) {
      if (wanted[n] != 0) slopes_[n] = slope_of(CellId(n));
    });
  }

  [[nodiscard]] const CellSlope& operator[](CellId cell) const { return slopes_[cell.index()]; }

 private:
  template <class Visitor>
  void for_each_neighbour(Visitor&& visit) const {
    const Connections& c = mesh_.connections;
    for (std::size_t n = 0; n < c.size(); ++n) {
      const ConnectionId id(n);
      if (!c.face[id].is_valid() || !(c.transmissibility[id] > 0.0) || !(c.area[id] > 0.0)) continue;
      visit(c.cells[id][0], id);
      visit(c.cells[id][1], id);
    }
  }

  /// Least squares over the averaging points, each with the inverse square of its distance.
  [[nodiscard]] CellSlope slope_of(CellId cell) const {
    struct Row {
      CellId other;
      Vec3 direction;  ///< to the averaging point, of length 1
      double rise;     ///< share of the neighbour over the distance, 1/m
    };
    std::vector<Row> rows;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    for (std::size_t n = start_[cell.index()]; n < start_[cell.index() + 1]; ++n) {
      const auto [a, b] = mesh_.connections.cells[around_[n]];
      const CellId other = a == cell ? b : a;
      const AveragingPoint point = averaging_point(cell, other, around_[n]);
      const double distance = point.offset.norm();
      if (!(distance > 0.0) || !(point.share > 0.0)) continue;
      rows.push_back({other, point.offset / distance, point.share / distance});
      normal += rows.back().direction * rows.back().direction.transpose();
    }
    const Eigen::Matrix3d inverse = inverse_of(normal);
    CellSlope out;
    for (const Row& row : rows) out.parts.push_back({row.other, row.rise * (inverse * row.direction)});
    return out;
  }

  static Eigen::Matrix3d inverse_of(const Eigen::Matrix3d& normal) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts(normal);
    Vec3 inverse = Vec3::Zero();
    for (Eigen::Index n = 0; n < 3; ++n)
      if (parts.eigenvalues()[n] > least_spread * parts.eigenvalues()[2]) inverse[n] = 1.0 / parts.eigenvalues()[n];
    return parts.eigenvectors() * inverse.asDiagonal() * parts.eigenvectors().transpose();
  }

  /// Where the line of centres meets the face's plane, shifted along the plane by the jump of K n (key
  /// `AgelasEymardHerbin2009`).
  [[nodiscard]] AveragingPoint averaging_point(CellId cell, CellId other, ConnectionId connection) const {
    const Connections& c = mesh_.connections;
    const bool is_first = c.cells[connection][0] == cell;
    const Vec3 n = is_first ? c.normal[connection] : Vec3(-c.normal[connection]);
    const Vec3 centroid = face_geometry(mesh_, c.face[connection]).centroid;
    const double d1 = std::abs(n.dot(centroid - mesh_.cells.center[cell]));
    const double d2 = std::abs(n.dot(mesh_.cells.center[other] - centroid));
    const Vec3 k1 = permeability_.empty() ? n : Vec3(permeability_[cell.index()] * n);
    const Vec3 k2 = permeability_.empty() ? n : Vec3(permeability_[other.index()] * n);
    const double l1 = n.dot(k1) * d2;
    const double l2 = n.dot(k2) * d1;
    const double sum = l1 + l2;
    if (!(sum > 0.0) || !std::isfinite(sum)) return {};
    const Vec3 line = mesh_.cells.center[other] - mesh_.cells.center[cell];
    return {(l2 * line + d1 * d2 * (k1 - k2)) / sum, l2 / sum};
  }

  const Mesh& mesh_;
  std::vector<Eigen::Matrix3d> permeability_;
  std::vector<std::size_t> start_;
  std::vector<ConnectionId> around_;
  std::vector<CellSlope> slopes_;
};

/// Adds factor * defect.slope.
void add_slope(std::vector<Term>& terms, CellId cell, const CellSlope& slope, const Vec3& defect, double factor) {
  double own = 0.0;
  for (const auto& [other, weight] : slope.parts) {
    const double value = factor * defect.dot(weight);
    terms.push_back({other, value});
    own -= value;
  }
  terms.push_back({cell, own});
}

/// One term a cell, `first` and `second` in front and the rest by number.
void tidy(std::vector<Term>& terms, std::size_t kept) {
  const auto rank = [&](CellId cell) {
    for (std::size_t n = 0; n < kept; ++n)
      if (terms[n].cell == cell) return n;
    return kept;
  };
  for (std::size_t n = kept; n < terms.size(); ++n)
    if (const std::size_t place = rank(terms[n].cell); place < kept) {
      terms[place].coefficient += terms[n].coefficient;
      terms[n].coefficient = 0.0;
    }
  const auto rest = terms.begin() + static_cast<std::ptrdiff_t>(kept);
  terms.erase(std::remove_if(rest, terms.end(), [](const Term& t) { return t.coefficient == 0.0; }), terms.end());
  std::stable_sort(terms.begin() + static_cast<std::ptrdiff_t>(kept), terms.end(),
                   [](const Term& one, const Term& other) { return one.cell < other.cell; });
  std::size_t last = kept;
  for (std::size_t n = kept; n < terms.size(); ++n) {
    if (n > kept && terms[n].cell == terms[last - 1].cell) {
      terms[last - 1].coefficient += terms[n].coefficient;
      continue;
    }
    terms[last++] = terms[n];
  }
  terms.resize(last);
}

void append(const std::vector<std::vector<Term>>& all, std::vector<std::int64_t>& start, std::vector<CellId>& cells,
            std::vector<double>& coefficients) {
  start.assign(1, 0);
  for (const std::vector<Term>& terms : all) {
    for (const Term& term : terms) {
      cells.push_back(term.cell);
      coefficients.push_back(term.coefficient);
    }
    start.push_back(static_cast<std::int64_t>(cells.size()));
  }
}

std::vector<std::uint8_t> cells_with_defects(const Mesh& mesh, const FluxDefects& defects) {
  std::vector<std::uint8_t> out(mesh.cells.size(), 0);
  for (std::size_t n = 0; n < defects.of_connection.size(); ++n)
    for (std::size_t side = 0; side < 2; ++side)
      if (!defects.of_connection[n][side].isZero(0.0)) out[mesh.connections.cells[ConnectionId(n)][side].index()] = 1;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (const auto& cells = mesh.faces.cells[FaceId(f)]; !cells[1].is_valid()) out[cells[0].index()] = 1;
  return out;
}

/// Beside a well: what the two-point part of each connection's flux needs more, over it, so that the flux of the well's
/// own field is that of the line sink.
std::vector<double> near_well_parts(const Mesh& mesh, const FluxDefects& defects) {
  std::vector<double> out(mesh.connections.size(), 0.0);
  std::vector<std::uint8_t> wanted(mesh.cells.size(), 0);
  for (const FluxDefects::NearWell& near : defects.near_wells)
    for (const CellId cell : mesh.connections.cells[near.connection]) wanted[cell.index()] = 1;
  const Slopes slopes(mesh, {}, wanted);
  tbb::parallel_for(std::size_t{0}, defects.near_wells.size(), [&](std::size_t n) {
    const FluxDefects::NearWell& near = defects.near_wells[n];
    const auto& cells = mesh.connections.cells[near.connection];
    const auto at = [&](CellId cell) { return near.field.at(mesh.cells.center[cell]); };
    const double straight = at(cells[1]) - at(cells[0]);
    double drop = straight;
    for (std::size_t side = 0; side < 2; ++side) {
      Vec3 slope = Vec3::Zero();
      for (const auto& [other, weight] : slopes[cells[side]].parts) slope += weight * (at(other) - at(cells[side]));
      drop += defects.of_connection[near.connection.index()][side].dot(slope);
    }
    const double more = (near.field.flux / near.linear - drop) / straight;
    if (std::isfinite(more)) out[near.connection.index()] = near.radial * std::clamp(more, -largest_part, largest_part);
  });
  return out;
}

}  // namespace

FluxStencils consistent_fluxes(const Mesh& mesh, const FluxDefects& defects) {
  const Slopes slopes(mesh, defects.permeability, cells_with_defects(mesh, defects));
  const std::vector<double> more = near_well_parts(mesh, defects);
  const Connections& c = mesh.connections;
  FluxStencils out;
  std::vector<std::vector<Term>> terms(c.size());
  tbb::parallel_for(std::size_t{0}, terms.size(), [&](std::size_t n) {
    const bool is_known = n < defects.of_connection.size();
    const double t = c.transmissibility[ConnectionId(n)] * (is_known ? defects.ratio[n] : 1.0);
    const auto [a, b] = c.cells[ConnectionId(n)];
    const double straight = t * (1.0 + more[n]);
    terms[n] = {{a, straight}, {b, -straight}};
    if (!is_known || !(t > 0.0)) return;
    for (std::size_t side = 0; side < 2; ++side) {
      const CellId cell = c.cells[ConnectionId(n)][side];
      add_slope(terms[n], cell, slopes[cell], defects.of_connection[n][side], -t);
    }
    tidy(terms[n], 2);
  });
  append(terms, out.start, out.cells, out.coefficients);

  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (!mesh.faces.cells[FaceId(f)][1].is_valid()) out.boundary_face.push_back(FaceId(f));
  out.boundary_transmissibility.resize(out.boundary_face.size());
  terms.assign(out.boundary_face.size(), {});
  tbb::parallel_for(std::size_t{0}, terms.size(), [&](std::size_t n) {
    const FaceId face = out.boundary_face[n];
    const CellId cell = mesh.faces.cells[face][0];
    const double t = boundary_conductance(mesh, face);
    out.boundary_transmissibility[n] = t;
    terms[n] = {{cell, t}};
    if (!(t > 0.0)) return;
    const PolygonGeometry g = face_geometry(mesh, face);
    const Vec3 defect = defects.permeability[cell.index()] * g.area_vector / t - (g.centroid - mesh.cells.center[cell]);
    add_slope(terms[n], cell, slopes[cell], defect, -t);
    tidy(terms[n], 1);
  });
  append(terms, out.boundary_start, out.boundary_cells, out.boundary_coefficients);
  return out;
}

}  // namespace wellknit
