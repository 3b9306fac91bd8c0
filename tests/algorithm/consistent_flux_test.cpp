// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/consistent_flux.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "algorithm/build_mesh.h"
#include "algorithm/steady_flow.h"
#include "model/errors.h"
#include "readers/read_mesh.h"
#include "tests/support/grids.h"
#include "tests/support/near_well.h"
#include "tests/support/scratch_folder.h"
#include "writers/write_hdf5.h"

namespace wellknit {
namespace {

/// Level layers between pillars that lean, so that K is along depth and across it; cells of about 10 x 20 x 5 m.
CornerPointGrid leaning(std::uint32_t seed, const grids::Dimensions& n = {5, 4, 4}) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.3, 0.3);
  std::vector<std::array<double, 4>> shifts(static_cast<std::size_t>((n[0] + 1) * (n[1] + 1)));
  for (auto& values : shifts)
    for (double& value : values) value = shift(random);
  return grids::make(
      {n,
       [&](std::int64_t i, std::int64_t j) {
         const auto& [x0, y0, x1, y1] = shifts[static_cast<std::size_t>(j * (n[0] + 1) + i)];
         const auto x = 10.0 * static_cast<double>(i);
         const auto y = 20.0 * static_cast<double>(j);
         return std::array{Vec3(x + 10.0 * x0, y + 20.0 * y0, 1000.0), Vec3(x + 10.0 * x1, y + 20.0 * y1, 1020.0)};
       },
       [](std::array<std::int64_t, 3> cell, std::array<int, 3> corner) {
         return 1000.0 + 5.0 * static_cast<double>(cell[2] + corner[2]);
       }});
}

Case with_permeability(CornerPointGrid grid, const Vec3& k) {
  Case source;
  source.grid = std::move(grid);
  for (std::size_t axis = 0; axis < 3; ++axis)
    source.grid.permeability[axis].assign(static_cast<std::size_t>(source.grid.cell_count()),
                                          k[static_cast<Eigen::Index>(axis)]);
  return source;
}

Mesh consistent(const Case& source, const std::vector<Well>& wells = {}) {
  BuildOptions options;
  options.fluxes = Fluxes::consistent;
  return build_mesh(source, wells, options).mesh;
}

double flux(const Mesh& mesh, std::size_t connection, const std::function<double(const Vec3&)>& pressure) {
  const FluxStencils& s = *mesh.stencils;
  double sum = 0.0;
  for (auto n = s.start[connection]; n < s.start[connection + 1]; ++n)
    sum +=
        s.coefficients[static_cast<std::size_t>(n)] * pressure(mesh.cells.center[s.cells[static_cast<std::size_t>(n)]]);
  return sum;
}

/// The flux of a pressure with this slope is -A n.K g, whatever the shapes of the cells.
TEST(ConsistentFlux, IsExactForALinearPressureInLeaningCells) {
  const Vec3 k(1e-13, 1e-13, 3e-14);
  const Vec3 slope(0.7, -1.3, 2.1);
  const auto pressure = [&](const Vec3& p) { return slope.dot(p); };
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const Mesh mesh = consistent(with_permeability(leaning(seed), k));
    double two_point_error = 0.0;
    for (std::size_t n = 0; n < mesh.connections.size(); ++n) {
      const ConnectionId id(n);
      const auto [a, b] = mesh.connections.cells[id];
      const double area = mesh.connections.area[id];
      const double wanted = -area * mesh.connections.normal[id].dot(k.cwiseProduct(slope));
      const double scale = area * k.cwiseProduct(slope).norm();
      EXPECT_NEAR(flux(mesh, n, pressure), wanted, 1e-11 * scale) << "seed " << seed << ", connection " << n;
      const double two_point =
          mesh.connections.transmissibility[id] * (pressure(mesh.cells.center[a]) - pressure(mesh.cells.center[b]));
      two_point_error = std::max(two_point_error, std::abs(two_point - wanted) / scale);
    }
    EXPECT_GT(two_point_error, 0.1) << "seed " << seed << ": cells that two points are right for show nothing";
  }
}

TEST(ConsistentFlux, IsExactThroughTheOuterBoundary) {
  const Vec3 k(1e-13, 1e-13, 3e-14);
  const Vec3 slope(0.7, -1.3, 2.1);
  const Mesh mesh = consistent(with_permeability(leaning(7), k));
  const FluxStencils& s = *mesh.stencils;
  ASSERT_EQ(s.boundary_face.size(), 2U * (5 * 4 + 5 * 4 + 4 * 4));
  for (std::size_t f = 0; f < s.boundary_face.size(); ++f) {
    const PolygonGeometry g = face_geometry(mesh, s.boundary_face[f]);
    double sum = -s.boundary_transmissibility[f] * slope.dot(g.centroid);
    for (auto n = s.boundary_start[f]; n < s.boundary_start[f + 1]; ++n)
      sum += s.boundary_coefficients[static_cast<std::size_t>(n)] *
             slope.dot(mesh.cells.center[s.boundary_cells[static_cast<std::size_t>(n)]]);
    EXPECT_NEAR(sum, -g.area_vector.dot(k.cwiseProduct(slope)), 1e-11 * g.area * k.cwiseProduct(slope).norm()) << f;
  }
}

/// Layers of K and 1000 K in turn: the slope along depth is 1000 times steeper in the weak ones, the flux the same.
TEST(ConsistentFlux, IsExactAcrossLayersOfDifferentRock) {
  Case source = with_permeability(leaning(3), Vec3::Constant(1e-13));
  const auto factor = [](std::int64_t layer) { return layer % 2 == 0 ? 1.0 : 1e-3; };
  for (std::size_t c = 0; c < source.grid.permeability[0].size(); ++c)
    for (auto& k : source.grid.permeability) k[c] *= factor(static_cast<std::int64_t>(c) / 20);
  const Mesh mesh = consistent(source);
  const auto pressure = [&](const Vec3& p) {
    double sum = 0.4 * p.x() + 0.2 * p.y();
    for (std::int64_t layer = 0; layer < 4; ++layer)
      sum += std::clamp(p.z() - 1000.0 - 5.0 * static_cast<double>(layer), 0.0, 5.0) / factor(layer);
    return sum;
  };
  for (std::size_t n = 0; n < mesh.connections.size(); ++n) {
    const ConnectionId id(n);
    const auto [a, b] = mesh.connections.cells[id];
    const auto layer_of = [&](CellId cell) { return mesh.cells.source_cell[cell].value() / 20; };
    const Vec3& normal = mesh.connections.normal[id];
    const double k = 1e-13 * factor(layer_of(a));
    // Level faces between layers carry the flux along depth alone; the others lie in one layer.
    const double wanted =
        layer_of(a) == layer_of(b) ? -k * normal.dot(Vec3(0.4, 0.2, 1.0 / factor(layer_of(a)))) : -1e-13 * normal.z();
    EXPECT_NEAR(flux(mesh, n, pressure), mesh.connections.area[id] * wanted, 1e-10 * mesh.connections.area[id] * 1e-13)
        << n;
  }
}

TEST(ConsistentFlux, IsTheTwoPointFluxWhereThatIsRight) {
  const Mesh mesh = consistent(with_permeability(grids::box({4, 3, 3}), Vec3(1e-13, 1e-13, 1e-14)));
  const FluxStencils& s = *mesh.stencils;
  for (std::size_t n = 0; n < mesh.connections.size(); ++n) {
    const double t = mesh.connections.transmissibility[ConnectionId(n)];
    for (auto m = s.start[n]; m < s.start[n + 1]; ++m) {
      const auto at = static_cast<std::size_t>(m);
      const double wanted = m == s.start[n] ? t : m == s.start[n] + 1 ? -t : 0.0;
      EXPECT_NEAR(s.coefficients[at], wanted, 1e-12 * t) << n;
    }
  }
}

SteadyFlowProblem linear_boundary(const Mesh& mesh, const Vec3& slope) {
  SteadyFlowProblem problem;
  problem.consistent = true;
  problem.wells.resize(mesh.wells.size());
  for (const FaceId face : mesh.stencils->boundary_face)
    problem.faces.push_back({face, 1e7 + slope.dot(face_geometry(mesh, face).centroid - Vec3(0.0, 0.0, 1000.0))});
  return problem;
}

TEST(ConsistentFlux, SolvesToALinearPressure) {
  const Vec3 slope(1e4, -2e4, 5e3);
  const Mesh mesh = consistent(with_permeability(leaning(11), Vec3(1e-13, 1e-13, 3e-14)));
  for (const PressureMethod method : {PressureMethod::direct, PressureMethod::multigrid}) {
    SteadyFlowProblem problem = linear_boundary(mesh, slope);
    problem.solver.method = method;
    const SteadyFlow flow = solve_steady_flow(mesh, problem);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      EXPECT_NEAR(flow.solution.pressure[CellId(c)],
                  1e7 + slope.dot(mesh.cells.center[CellId(c)] - Vec3(0.0, 0.0, 1000.0)), 1e-3);
    EXPECT_LT(flow.balance.error, 1e-10);
    EXPECT_LT(flow.balance.largest_cell, 1e-10);
    problem.consistent = false;
    const SteadyFlow two_point = solve_steady_flow(mesh, problem);
    double worst = 0.0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      worst = std::max(worst, std::abs(two_point.solution.pressure[CellId(c)] - flow.solution.pressure[CellId(c)]));
    EXPECT_GT(worst, 1e3) << "else the test shows nothing";
  }
}

/// Held cells and a well on a rate: the balance closes with the fluxes that the stencils give.
TEST(ConsistentFlux, BalancesWithWellsAndHeldCells) {
  const Case source = with_permeability(leaning(5), Vec3::Constant(1e-13));
  Well well = near_well::straight("W", {25.0, 40.0, 990.0}, {25.0, 40.0, 1030.0});
  well.radial.drainage_radius = 3.0;
  const Mesh mesh = consistent(source, {well});
  SteadyFlowProblem problem;
  problem.consistent = true;
  problem.wells.push_back({WellControl::Kind::rate, 1e-4});
  problem.cells.push_back({CellId(0), 2e7});
  const SteadyFlow flow = solve_steady_flow(mesh, problem);
  EXPECT_NEAR(flow.wells[WellId(0)].rate, 1e-4, 1e-14);
  EXPECT_NEAR(flow.cell_rate.front(), -1e-4, 1e-12);
  EXPECT_LT(flow.balance.largest_cell, 1e-10);
}

/// Rate of a well on 0 in leaning cells, over Thiem's, when the outer faces hold ln(r / r_w)
/// (flow_connections_test.cpp).
double rate_over_thiem(bool is_consistent) {
  const Case source = with_permeability(leaning(9, {42, 21, 4}), Vec3::Constant(1e-13));
  const Vec3 place(213.0, 208.0, 0.0);
  Well well = near_well::straight("W", place + Vec3(0.0, 0.0, 990.0), place + Vec3(0.0, 0.0, 1030.0));
  well.radial.drainage_radius = 12.0;
  const Mesh mesh = consistent(source, {well});
  SteadyFlowProblem problem;
  problem.viscosity = 1.0;
  problem.consistent = is_consistent;
  problem.wells.push_back({WellControl::Kind::pressure, 0.0});
  for (const FaceId face : mesh.stencils->boundary_face) {
    const PolygonGeometry g = face_geometry(mesh, face);
    const double r = std::hypot(g.centroid.x() - place.x(), g.centroid.y() - place.y());
    if (std::abs(g.area_vector.z()) < 0.99 * g.area && r > 100.0)
      problem.faces.push_back({face, std::log(r / well.radial.bore_radius)});
  }
  return solve_steady_flow(mesh, problem).wells[WellId(0)].rate / (2.0 * std::numbers::pi * 1e-13 * 20.0);
}

TEST(ConsistentFlux, FlowsToAWellAsThiemSaysInLeaningCellsToo) {
  EXPECT_NEAR(rate_over_thiem(true), 1.0, 0.005);
  EXPECT_GT(std::abs(rate_over_thiem(false) - 1.0), 0.01) << "else the cells show nothing";
}

TEST(ConsistentFlux, GoesThroughTheMeshFile) {
  const Mesh mesh = consistent(with_permeability(leaning(2), Vec3::Constant(1e-13)));
  const ScratchFolder folder;
  write_hdf5(mesh, {}, folder.file("mesh.h5"));
  const Mesh found = read_mesh(folder.file("mesh.h5")).mesh;
  ASSERT_TRUE(found.stencils.has_value());
  EXPECT_EQ(found.stencils->start, mesh.stencils->start);
  EXPECT_EQ(found.stencils->cells, mesh.stencils->cells);
  EXPECT_EQ(found.stencils->coefficients, mesh.stencils->coefficients);
  EXPECT_EQ(found.stencils->boundary_coefficients, mesh.stencils->boundary_coefficients);
}

TEST(ConsistentFlux, ThatAMeshDoesNotHaveIsRefused) {
  const Mesh mesh = build_mesh(with_permeability(leaning(2), Vec3::Constant(1e-13)), {}, {}).mesh;
  EXPECT_FALSE(mesh.stencils.has_value());
  SteadyFlowProblem problem;
  problem.consistent = true;
  try {
    solve_steady_flow(mesh, problem);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("--fluxes consistent"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace wellknit
