// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/flow_connections.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "algorithm/build_mesh.h"
#include "readers/read_mesh.h"
#include "tests/support/grids.h"
#include "tests/support/near_well.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/steady_flow.h"
#include "writers/write_hdf5.h"

namespace wellknit {
namespace {

/// A box of 21 x 21 x 4 cells of 20 x 20 x 5 m with a well through its middle from above to below.
Case thiem_box(double permeability) {
  Case source;
  source.grid = grids::box({21, 21, 4}, {20.0, 20.0, 5.0});
  const auto n = static_cast<std::size_t>(source.grid.cell_count());
  source.grid.permeability = {std::vector<double>(n, permeability), std::vector<double>(n, permeability),
                              std::vector<double>(n, permeability)};
  return source;
}

/// Rate into the bore when the outermost columns hold the pressures of p = ln(r / r_w), over Thiem's 2 pi k H.
///
/// p = ln(r / r_w) is harmonic and 0 at the bore, so it is the steady solution of every domain whose boundary holds its
/// values, whatever the boundary's shape: the circular-equivalent problem of a square. Its flow through any surface
/// around the bore is 2 pi k H (viscosity 1), which is Thiem's rate 2 pi k H (p_e - p_w) / ln(r_e / r_w) with p_e =
/// ln(r_e / r_w), p_w = 0.
double rate_over_thiem(const Mesh& mesh, double permeability, double height) {
  const MeshWell& well = mesh.wells[WellId(0)];
  const Vec3 axis = well.trajectory.points.front();
  const auto fixed = [&](CellId c) -> std::optional<double> {
    const HostCellId source = mesh.cells.source_cell[c];
    if (!source.is_valid()) return std::nullopt;
    const std::int64_t i = source.value() % mesh.source_dimensions[0];
    const std::int64_t j = (source.value() / mesh.source_dimensions[0]) % mesh.source_dimensions[1];
    if (i > 0 && j > 0 && i + 1 < mesh.source_dimensions[0] && j + 1 < mesh.source_dimensions[1]) return std::nullopt;
    const Vec3 d = mesh.cells.center[c] - axis;
    return std::log(std::hypot(d.x(), d.y()) / well.bore_radius);
  };
  const auto pressure = steady_flow::pressures(mesh, 0.0, fixed);
  return steady_flow::well_rate(mesh, WellId(0), 0.0, pressure) / (2.0 * std::numbers::pi * permeability * height);
}

TEST(FlowConnections, FullyPenetratingLayeredWellFlowsAsThiemSays) {
  constexpr double permeability = 1e-13;
  const Case source = thiem_box(permeability);
  for (const int sectors : {6, 10, 16}) {
    Well well = near_well::straight("W", {210.0, 210.0, 990.0}, {210.0, 210.0, 1030.0});
    well.radial.drainage_radius = 12.0;
    well.radial.sectors = sectors;
    const BuildResult result = build_mesh(source, {well}, {});
    ASSERT_EQ(result.summary.wells[0].mode, "layered") << result.summary.wells[0].reason;
    // Through the file: it is the written connection list that must flow right.
    const ScratchFolder folder;
    write_hdf5(result.mesh, {}, folder.file("thiem.h5"));
    const Mesh mesh = read_mesh(folder.file("thiem.h5")).mesh;
    EXPECT_NEAR(rate_over_thiem(mesh, permeability, 20.0), 1.0, 0.01) << sectors << " sectors";
  }
}

TEST(FlowConnections, SkinLowersTheRateAsItsResistance) {
  // With skin s the pressure drop for the same rate grows by s: q / q_Thiem = ln(r_e/r_w) / (ln(r_e/r_w) + s) where p_e
  // is fixed. Here the boundary holds ln(r / r_w) on a square between r = 200 m and 200 sqrt 2 m; the spread of ln is
  // 0.35 of about 7.7, hence 2 %.
  constexpr double permeability = 1e-13;
  const Case source = thiem_box(permeability);
  Well well = near_well::straight("W", {210.0, 210.0, 990.0}, {210.0, 210.0, 1030.0});
  well.radial.drainage_radius = 12.0;
  well.skin = 5.0;
  const BuildResult result = build_mesh(source, {well}, {});
  const double log_ratio =
      std::log(200.0 * 1.08 / well.radial.bore_radius);  // 1.08: mean of the square's distance over its half side
  EXPECT_NEAR(rate_over_thiem(result.mesh, permeability, 20.0), log_ratio / (log_ratio + 5.0), 0.02);
}

TEST(FlowConnections, PartlyOpenWellConnectsItsOpenLayersOnly) {
  const Case source = thiem_box(1e-13);
  Well well = near_well::straight("W", {210.0, 210.0, 990.0}, {210.0, 210.0, 1030.0});
  well.radial.drainage_radius = 12.0;
  well.open = {{15.0, 20.0}};  // depths 1005 to 1010: layer 2 of 4
  const BuildResult result = build_mesh(source, {well}, {});
  const MeshWell& out = result.mesh.wells[WellId(0)];
  ASSERT_EQ(out.connections.size(), 10U);  // one for each sector
  for (const WellConnection& c : out.connections) EXPECT_EQ(result.mesh.cells.radial_index[c.cell].segment, 1);
}

/// Isotropic rock; 3 x 1 x 3 cells of 10 x 20 x 5 m with level layers; pillars lean towards x by 3 in 4.
Case leaning() {
  Case source;
  source.grid = grids::make({{3, 1, 3},
                             [](std::int64_t i, std::int64_t j) {
                               const auto x = 10.0 * static_cast<double>(i);
                               const auto y = 20.0 * static_cast<double>(j);
                               return std::array{Vec3(x, y, 1000.0), Vec3(x + 75.0, y, 1100.0)};
                             },
                             [](std::array<std::int64_t, 3> cell, std::array<int, 3> corner) {
                               return 1000.0 + 5.0 * static_cast<double>(cell[2] + corner[2]);
                             }});
  for (auto& k : source.grid.permeability) k.assign(static_cast<std::size_t>(source.grid.cell_count()), 1e-13);
  return source;
}

// With s = 3/4 the area vector of a face along i is A (1, 0, -s), the line of centres (dx, 0, 0): the simulators' T is
// k A / dx. T l = k A (1, 0, 0) against K A = k A (1, 0, -s): off by s / sqrt(1 + s2) = 0.6 for a slope along depth.
// Along k: A (0, 0, 1), l = dz (s, 0, 1), T = k A / (dz (1 + s2)): off by s / (1 + s2) = 0.48 along x and by
// 1 - 1 / (1 + s2) = 0.36 along depth.
TEST(FlowConnections, LinearFluxErrorIsWhatTwoPointsLeaveOut) {
  const Mesh mesh = build_mesh(leaning(), {}, {}).mesh;
  ASSERT_EQ(mesh.connections.linear_flux_error.size(), mesh.connections.size());
  for (std::size_t n = 0; n < mesh.connections.size(); ++n) {
    const Vec3 line = mesh.cells.center[mesh.connections.cells[ConnectionId(n)][1]] -
                      mesh.cells.center[mesh.connections.cells[ConnectionId(n)][0]];
    const Vec3 wanted = std::abs(line.z()) > 1.0 ? Vec3(0.48, 0.0, 0.36) : Vec3(0.0, 0.0, 0.6);
    EXPECT_NEAR((mesh.connections.linear_flux_error[ConnectionId(n)] - wanted).norm(), 0.0, 1e-10) << n;
  }
}

TEST(FlowConnections, LinearFluxIsExactInABoxOfLayers) {
  Case source;
  source.grid = grids::box({3, 3, 4});
  // A factor of 1,000 from layer to layer is no error of the flux.
  for (std::size_t c = 0; c < source.grid.permeability[2].size(); ++c)
    source.grid.permeability[2][c] = (c / 9) % 2 == 0 ? 1e-14 : 1e-17;
  const Mesh mesh = build_mesh(source, {}, {}).mesh;
  for (const Vec3& error : mesh.connections.linear_flux_error) EXPECT_LT(error.norm(), 1e-10);
}

}  // namespace
}  // namespace wellknit
