// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/steady_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "algorithm/boundary_conductance.h"
#include "algorithm/build_mesh.h"
#include "model/errors.h"
#include "tests/support/grids.h"
#include "tests/support/meshes.h"
#include "tests/support/near_well.h"

namespace wellknit {
namespace {

constexpr double bar = 1e5;

WellControl pressure(double pascal) { return {WellControl::Kind::pressure, pascal}; }
WellControl rate(double m3_per_second) { return {WellControl::Kind::rate, m3_per_second}; }
WellControl shut() { return {}; }

SteadyFlowProblem problem(const std::vector<WellControl>& wells = {}) {
  SteadyFlowProblem out;
  for (const WellControl& well : wells) out.wells.push_back(well);
  return out;
}

/// A connection list alone: unit cells in a row, joined by these transmissibilities.
Mesh row(const std::vector<double>& transmissibilities) {
  Mesh mesh;
  const std::size_t cells = transmissibilities.size() + 1;
  mesh.cells.kind.resize(cells);
  mesh.cells.volume.resize(cells, 1.0);
  mesh.cells.pore_volume.resize(cells, 0.25);
  mesh.cells.depth.resize(cells, 1000.0);
  mesh.cells.source_cell.resize(cells);
  for (std::size_t c = 0; c + 1 < cells; ++c) {
    mesh.connections.cells.push_back({CellId(c), CellId(c + 1)});
    mesh.connections.transmissibility.push_back(transmissibilities[c]);
  }
  return mesh;
}

MeshWell well_in(std::vector<WellConnection> connections, const std::string& name = "W") {
  MeshWell out;
  out.name = name;
  out.connections = std::move(connections);
  return out;
}

/// Every face of the outer boundary with a pressure by place.
template <class Field>
std::vector<HeldFace> all_outer_faces(const Mesh& mesh, Field field) {
  std::vector<HeldFace> out;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (!mesh.faces.cells[FaceId(f)][1].is_valid())
      out.push_back({FaceId(f), field(face_geometry(mesh, FaceId(f)).centroid)});
  return out;
}

std::string message_of(const Mesh& mesh, const SteadyFlowProblem& what) {
  try {
    (void)solve_steady_flow(mesh, what);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(SteadyFlow, ResistancesInARowAddUp) {
  // 1/T = 1/2e-13 + 1/1e-13 + 1/4e-13 = (5 + 10 + 2.5)e12; q = 10 bar / (17.5e12 * 1e-3 Pa s).
  const Mesh mesh = row({2e-13, 1e-13, 4e-13});
  SteadyFlowProblem what = problem();
  what.cells = {{CellId(0), 30 * bar}, {CellId(3), 20 * bar}};
  const SteadyFlow flow = solve_steady_flow(mesh, what);
  const double expected = 10 * bar / 17.5e9;
  for (const double flux : flow.solution.flux) EXPECT_NEAR(flux / expected, 1.0, 1e-13);
  EXPECT_NEAR(flow.cell_rate[0] / expected, -1.0, 1e-13) << "a held cell takes up what does not flow on";
  EXPECT_NEAR(flow.cell_rate[1] / expected, 1.0, 1e-13);
  // The drop over the first: 10 bar * 5 / 17.5.
  EXPECT_NEAR(flow.solution.pressure[CellId(1)], (30.0 - 50.0 / 17.5) * bar, 1e-6);
}

TEST(SteadyFlow, AWellOnRateLetsItsCellsFlowIntoEachOther) {
  // Cells 0 and 2 at 30 and 10 bar are joined by the bore alone, both with index 1e-13. A rate of 0 puts the bore at 20
  // bar and lets 10 bar * 1e-13 / 1e-3 pass through it.
  Mesh mesh = row({0.0, 0.0});
  mesh.wells.push_back(well_in({{CellId(0), 1e-13, {}}, {CellId(2), 1e-13, {}}}));
  SteadyFlowProblem what = problem({rate(0.0)});
  what.cells = {{CellId(0), 30 * bar}, {CellId(2), 10 * bar}};
  const SteadyFlow flow = solve_steady_flow(mesh, what);
  const WellFlow& well = flow.wells[WellId(0)];
  EXPECT_NEAR(well.pressure, 20 * bar, 1e-6);
  EXPECT_NEAR(well.connection_rate[0] * 1e4, 1.0, 1e-12);
  EXPECT_NEAR(well.connection_rate[1] * 1e4, -1.0, 1e-12);
  EXPECT_EQ(flow.closed_connections, 2);
  ASSERT_EQ(flow.isolated.size(), 1U) << "cell 1 has no way out";
  EXPECT_EQ(flow.isolated[0].first_cell, CellId(1));
  EXPECT_TRUE(std::isnan(flow.solution.pressure[CellId(1)]));
}

TEST(SteadyFlow, AShutWellIsNotThere) {
  Mesh mesh = row({1e-13});
  mesh.wells.push_back(well_in({{CellId(0), 1e-13, {}}, {CellId(1), 1e-13, {}}}));
  SteadyFlowProblem what = problem({shut()});
  what.cells = {{CellId(0), 30 * bar}};
  const SteadyFlow flow = solve_steady_flow(mesh, what);
  EXPECT_EQ(flow.wells[WellId(0)].rate, 0.0);
  EXPECT_TRUE(std::isnan(flow.wells[WellId(0)].pressure));
  EXPECT_NEAR(flow.solution.pressure[CellId(1)], 30 * bar, 1e-6);
}

TEST(SteadyFlow, PressureAndRateOfAWellSayTheSame) {
  Mesh mesh = meshes::box_grid(5);
  const SteadyFlow on_pressure = solve_steady_flow(mesh, problem({pressure(300 * bar), pressure(100 * bar)}));
  const double q = on_pressure.wells[WellId(1)].rate;
  EXPECT_GT(q, 0.0);
  EXPECT_NEAR(on_pressure.wells[WellId(0)].rate, -q, 1e-12 * q);
  const SteadyFlow on_rate = solve_steady_flow(mesh, problem({pressure(300 * bar), rate(q)}));
  EXPECT_NEAR(on_rate.wells[WellId(1)].pressure, 100 * bar, 1e-10 * 200 * bar);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    EXPECT_NEAR(on_rate.solution.pressure[CellId(c)], on_pressure.solution.pressure[CellId(c)], 1e-10 * 200 * bar);
}

TEST(SteadyFlow, ALinearPressureInABoxIsExact) {
  Case source;
  source.grid = grids::box({7, 6, 5});
  const Mesh mesh = build_mesh(source, {}, {}).mesh;
  const Vec3 gradient(120.0, -70.0, 900.0);  // Pa/m
  const auto field = [&](const Vec3& x) { return 2e7 + gradient.dot(x); };
  SteadyFlowProblem what = problem();
  what.faces = all_outer_faces(mesh, field);
  const SteadyFlow flow = solve_steady_flow(mesh, what);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const double exact = field(mesh.cells.center[CellId(c)]);
    EXPECT_NEAR(flow.solution.pressure[CellId(c)] / exact, 1.0, 1e-12);
  }
  EXPECT_LT(flow.balance.error, 1e-10);
  EXPECT_LT(flow.balance.largest_cell, 1e-10);
}

TEST(SteadyFlow, NothingFlowsInAHydrostaticColumn) {
  Case source;
  source.grid = grids::twisted({5, 4, 6});
  const Mesh mesh = build_mesh(source, {}, {}).mesh;
  SteadyFlowProblem what = problem();
  what.density = 850.0;
  // One cell is held; all others follow by density * g * depth, 8.336 kPa a metre.
  what.cells = {{CellId(7), 200 * bar}};
  const SteadyFlow flow = solve_steady_flow(mesh, what);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const double deeper = mesh.cells.depth[CellId(c)] - mesh.cells.depth[CellId(7)];
    EXPECT_NEAR(flow.solution.pressure[CellId(c)], 200 * bar + 850.0 * 9.80665 * deeper, 1e-3);
  }
  // Against 1 bar over one of its connections.
  for (std::size_t c = 0; c < mesh.connections.size(); ++c)
    EXPECT_LE(std::abs(flow.solution.flux[ConnectionId(c)]),
              1e-12 * mesh.connections.transmissibility[ConnectionId(c)] / 1e-3 * bar);
}

/// p = ln(r / r_w) is 0 at the bore and harmonic: held in the outermost columns it makes Thiem's rate 2 pi k H for
/// viscosity 1 (see flow_connections_test.cpp).
TEST(SteadyFlow, ThiemsRateComesOutOfARadialMesh) {
  constexpr double permeability = 1e-13;
  Case source;
  source.grid = grids::box({21, 21, 4}, {20.0, 20.0, 5.0});
  for (auto& k : source.grid.permeability) k.assign(static_cast<std::size_t>(source.grid.cell_count()), permeability);
  Well well = near_well::straight("W", {210.0, 210.0, 990.0}, {210.0, 210.0, 1030.0});
  well.radial.drainage_radius = 12.0;
  const Mesh mesh = build_mesh(source, {well}, {}).mesh;
  SteadyFlowProblem what = problem({pressure(0.0)});
  what.viscosity = 1.0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Vec3 d = mesh.cells.center[CellId(c)] - Vec3(210.0, 210.0, 0.0);
    if (std::max(std::abs(d.x()), std::abs(d.y())) < 199.0) continue;
    what.cells.push_back({CellId(c), std::log(std::hypot(d.x(), d.y()) / well.radial.bore_radius)});
  }
  ASSERT_GT(what.cells.size(), 0U);
  const SteadyFlow flow = solve_steady_flow(mesh, what);
  EXPECT_NEAR(flow.wells[WellId(0)].rate / (2.0 * std::numbers::pi * permeability * 20.0), 1.0, 0.005);
}

TEST(SteadyFlow, ExpansionLeavesThroughTheWellByPoreVolume) {
  Mesh mesh = row({1e-13, 1e-13});
  mesh.wells.push_back(well_in({{CellId(0), 1e-13, {}}}));
  SteadyFlowProblem what = problem({pressure(0.0)});
  what.expansion = 3e-6;  // a third in each cell: 1e-6 flows from cell 2 to 1, 2e-6 from 1 to 0
  const SteadyFlow flow = solve_steady_flow(mesh, what);
  EXPECT_NEAR(flow.wells[WellId(0)].rate, 3e-6, 1e-18);
  EXPECT_NEAR(flow.solution.flux[ConnectionId(0)], -2e-6, 1e-18);
  EXPECT_NEAR(flow.solution.flux[ConnectionId(1)], -1e-6, 1e-18);
  // Drops of q viscosity / T: 3, 2 and 1 times 1e4 Pa; the mean of 3e4, 5e4 and 6e4 Pa.
  EXPECT_NEAR(flow.wells[WellId(0)].mean_pressure, 14e4 / 3.0, 1e-6);
  EXPECT_NEAR(flow.wells[WellId(0)].productivity_index, 3e-6 / (14e4 / 3.0), 1e-20);
}

TEST(SteadyFlow, BadTransmissibilitiesAreClosedAndCounted) {
  const Mesh mesh = row({1e-13, -1e-13, 0.0, std::nan("")});
  SteadyFlowProblem what = problem();
  what.cells = {{CellId(0), bar}};
  const SteadyFlow flow = solve_steady_flow(mesh, what);
  EXPECT_EQ(flow.closed_connections, 1);
  EXPECT_EQ(flow.refused_connections, 2);
  EXPECT_EQ(flow.isolated.size(), 3U);
  for (const double flux : flow.solution.flux) EXPECT_EQ(flux, 0.0);
}

TEST(SteadyFlow, ARateWhereNothingHoldsAPressureNamesThePart) {
  Mesh mesh = row({1e-13, 0.0, 1e-13, 1e-13});
  mesh.wells.push_back(well_in({{CellId(3), 1e-13, {}}}, "P7"));
  SteadyFlowProblem what = problem({rate(1e-6)});
  what.cells = {{CellId(0), bar}};
  const std::string message = message_of(mesh, what);
  for (const char* word : {"P7", "3 cells", "cell 2"}) EXPECT_NE(message.find(word), std::string::npos) << message;
}

TEST(SteadyFlow, RefusesWhatMakesNoProblem) {
  Mesh mesh = row({1e-13});
  mesh.wells.push_back(well_in({}, "empty"));
  SteadyFlowProblem what = problem({rate(1.0)});
  EXPECT_NE(message_of(mesh, what).find("empty"), std::string::npos);
  what = problem();
  EXPECT_NE(message_of(mesh, what).find("0 well controls for 1 wells"), std::string::npos);
  what = problem({shut()});
  what.cells = {{CellId(0), bar}, {CellId(0), bar}};
  EXPECT_NE(message_of(mesh, what).find("twice"), std::string::npos);
  what.cells = {{CellId(2), bar}};
  EXPECT_NE(message_of(mesh, what).find("cell 2"), std::string::npos);
  what.cells = {{CellId(0), std::nan("")}};
  EXPECT_NE(message_of(mesh, what).find("not finite"), std::string::npos);
  what.cells.clear();
  what.viscosity = 0.0;
  EXPECT_NE(message_of(mesh, what).find("viscosity"), std::string::npos);
  const Mesh boxes = meshes::two_boxes();
  what = problem();
  for (std::size_t f = 0; f < boxes.faces.size(); ++f)
    if (boxes.faces.cells[FaceId(f)][1].is_valid()) what.faces = {{FaceId(f), bar}};
  EXPECT_NE(message_of(boxes, what).find("between two cells"), std::string::npos);
  for (std::size_t f = 0; f < boxes.faces.size(); ++f)
    if (!boxes.faces.cells[FaceId(f)][1].is_valid()) what.faces = {{FaceId(f), std::nan("")}};
  EXPECT_NE(message_of(boxes, what).find("is not finite"), std::string::npos);
  what = problem({rate(std::nan(""))});
  EXPECT_EQ(message_of(mesh, what), "well empty: its pressure or rate is not finite");
  what = problem({shut()});
  what.density = std::nan("");
  EXPECT_EQ(message_of(mesh, what), "the density and the expansion must be finite numbers");
}

TEST(SteadyFlow, DirectAndMultigridAgree) {
  Case source = near_well::deformed(1.0);
  near_well::randomise(source.grid, 7);  // permeabilities that differ from cell to cell
  const Mesh mesh = build_mesh(source, {}, {}).mesh;
  SteadyFlowProblem what = problem();
  what.faces = all_outer_faces(mesh, [](const Vec3& x) { return 1e4 * x.x() + 3e3 * x.z(); });
  what.solver.method = PressureMethod::direct;
  const SteadyFlow direct = solve_steady_flow(mesh, what);
  what.solver.method = PressureMethod::multigrid;
  const SteadyFlow multigrid = solve_steady_flow(mesh, what);
  const SteadyFlow again = solve_steady_flow(mesh, what);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    EXPECT_NEAR(multigrid.solution.pressure[CellId(c)], direct.solution.pressure[CellId(c)], 1e-9 * 1e7);
    EXPECT_EQ(multigrid.solution.pressure[CellId(c)], again.solution.pressure[CellId(c)]);
  }
  EXPECT_LT(multigrid.balance.largest_cell, 1e-10);
}

TEST(SteadyFlow, ABoundaryFaceConductsAsHalfACell) {
  // Box 1 x 1 x 1 m, 100 mD: k A / (1/2 m).
  const Mesh mesh = meshes::two_boxes();
  int sides = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (mesh.faces.cells[FaceId(f)] != std::array<CellId, 2>{CellId(0), no_cell}) continue;
    ++sides;
    EXPECT_NEAR(boundary_conductance(mesh, FaceId(f)) / (2.0 * mesh.cells.permeability[CellId(0)].x()), 1.0, 1e-12);
  }
  EXPECT_EQ(sides, 5);
}

}  // namespace
}  // namespace wellknit
