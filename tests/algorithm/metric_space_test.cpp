// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/metric_space.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "algorithm/build_mesh.h"
#include "algorithm/rock_tensor.h"
#include "algorithm/well_path.h"
#include "model/errors.h"
#include "model/mesh_check.h"
#include "tests/support/grids.h"
#include "tests/support/near_well.h"

namespace wellknit {
namespace {

using near_well::Path;

Well straight(const Vec3& from, const Vec3& to) { return near_well::straight("W", from, to); }

AffineMap space_of(const CornerPointGrid& grid, const Well& well) {
  return metric_space(grid, build_host_mesh(grid), CellLocator(grid), {well});
}

/// The box with these permeabilities along i, j, k, in units of 1e-13 m2, whose layers dip by dz/dx and dz/dy.
CornerPointGrid dipping(const Vec3& k, double along_x, double along_y) {
  CornerPointGrid grid = grids::box({4, 4, 4});
  for (std::int64_t c = 0; c < grid.cell_count(); ++c) {
    const auto at = grid.ijk(HostCellId(c));
    for (int n = 0; n < 8; ++n) {
      const int di = n & 1;
      const int dj = (n >> 1) & 1;
      grid.zcorn[grid.zcorn_index(at, di, dj, n >> 2)] +=
          along_x * 10.0 * static_cast<double>(at[0] + di) + along_y * 20.0 * static_cast<double>(at[1] + dj);
    }
    for (std::size_t a = 0; a < 3; ++a)
      grid.permeability[a][static_cast<std::size_t>(c)] = 1e-13 * k[static_cast<int>(a)];
  }
  return grid;
}

TEST(MetricSpace, OfLevelLayersMultipliesDepth) {
  const CornerPointGrid grid = dipping({1.0, 1.0, 0.01}, 0.0, 0.0);
  const AffineMap space = space_of(grid, straight({5, 10, 1001}, {35, 70, 1019}));
  const Vec3 expected(1.0, 1.0, 10.0);
  EXPECT_NEAR((space.matrix - Eigen::Matrix3d(expected.asDiagonal())).norm(), 0.0, 1e-12);
  EXPECT_NEAR(space.determinant, 10.0, 1e-12);
  // Points go and come back.
  const Vec3 p(3.0, 7.0, 1234.5);
  EXPECT_NEAR((space.from(space.to(p)) - p).norm(), 0.0, 1e-9);
}

TEST(MetricSpace, IsTheRealOneInIsotropicRock) {
  EXPECT_TRUE(space_of(dipping({2.0, 2.0, 2.0}, 0.3, 0.1), straight({5, 10, 1005}, {35, 70, 1030})).is_identity());
}

TEST(MetricSpace, MakesThePermeabilityTheSameInAllDirections) {
  const CornerPointGrid grid = dipping({3.0, 1.0, 0.02}, 0.4, -0.2);
  const HostMesh host = build_host_mesh(grid);
  const AffineMap space = space_of(grid, straight({5, 10, 1001}, {35, 70, 1019}));
  const Eigen::Matrix3d axes = layer_axes(host, HostCellId(0));
  const Eigen::Matrix3d k = axes * Vec3(3.0, 1.0, 0.02).asDiagonal() * axes.transpose();
  const Eigen::Matrix3d there = moved_permeability(space, k);
  EXPECT_NEAR((there / there(0, 0) - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-10);
  // Vertical lines stay vertical, areas in plan stay.
  EXPECT_EQ(space.matrix(0, 2), 0.0);
  EXPECT_EQ(space.matrix(1, 2), 0.0);
  EXPECT_NEAR((space.matrix.topLeftCorner<2, 2>().determinant()), 1.0, 1e-12);
}

TEST(MetricSpace, KeepsFluxes) {
  AffineMap space;
  space.matrix << 1.1, 0.2, 0.0, 0.2, 0.9, 0.0, 0.7, -0.4, 3.0;
  space.inverse = space.matrix.inverse();
  space.determinant = space.matrix.determinant();
  Eigen::Matrix3d k;
  k << 2.0, 0.3, 0.1, 0.3, 1.0, 0.2, 0.1, 0.2, 0.5;
  const Vec3 area(1.0, 2.0, -0.5);
  const Vec3 line(0.3, 0.8, 0.1);
  // The two-point expression of a K-orthogonal face: A.K A / A.d.
  const Vec3 a = moved_area(space, area);
  EXPECT_NEAR(a.dot(moved_permeability(space, k) * a) / a.dot(space.matrix * line), area.dot(k * area) / area.dot(line),
              1e-12);
}

TEST(MetricSpace, ABoreIsAnEllipseThere) {
  AffineMap space;
  space.matrix = Vec3(1.0, 1.0, 10.0).asDiagonal();
  // Horizontal: semi-axes r and 10 r. Vertical: a circle. At 45 degrees: r and 10 r sin 45 / cos of the lean there,
  // area and direction by hand: 10 sqrt(2) / sqrt(101).
  EXPECT_NEAR(moved_bore_radius(space, {2, 1, 0}, 0.1), 0.55, 1e-12);
  EXPECT_NEAR(moved_bore_radius(space, {0, 0, 3}, 0.1), 0.1, 1e-12);
  EXPECT_NEAR(moved_bore_radius(space, {1, 0, 1}, 0.1), 0.05 * (1.0 + 10.0 * std::sqrt(2.0 / 101.0)), 1e-12);
}

TEST(MetricSpace, MovesWellsByTheirLengthThere) {
  const CornerPointGrid grid = dipping({1.0, 1.0, 0.01}, 0.0, 0.0);
  Well well = straight({5, 10, 1000}, {5, 50, 1030});  // 50 m long; there 40 and 300
  well.open = {{10.0, 25.0}};
  const AffineMap space = space_of(grid, well);
  const Well there = moved(space, grid, well);
  const double length = std::hypot(40.0, 300.0);
  EXPECT_NEAR(there.trajectory.measured_depth.back() - there.trajectory.measured_depth.front(), length, 1e-9);
  EXPECT_NEAR(there.open[0].to - there.open[0].from, 0.3 * length, 1e-9);
  const WellPath path(there.trajectory);
  EXPECT_NEAR(path.original(there.open[0].to), 25.0, 1e-9);
}

TEST(MetricSpace, BringsTheHostBack) {
  // Along the middle of a deformed grid, where layers dip.
  const Case source = near_well::deformed(1.0);
  const CornerPointGrid& grid = source.grid;
  const HostMesh real = build_host_mesh(grid);
  const AffineMap space = metric_space(grid, real, CellLocator(grid), {near_well::well(Path::curved, 12.0)});
  EXPECT_GT(space.matrix(2, 2), 2.0);
  EXPECT_FALSE(space.is_identity());
  HostMesh host = build_host_mesh(moved(space, grid));
  move_back(space, grid, host);
  ASSERT_EQ(host.vertices.size(), real.vertices.size());
  ASSERT_EQ(host.faces.size(), real.faces.size());
  for (std::size_t v = 0; v < real.vertices.size(); ++v)
    ASSERT_LT((host.vertices[VertexId(v)] - real.vertices[VertexId(v)]).norm(), 1e-8);
  for (std::size_t c = 0; c < real.volume.size(); ++c) {
    ASSERT_NEAR(host.volume[HostCellId(c)] / real.volume[HostCellId(c)], 1.0, 1e-10);
    ASSERT_NEAR(host.pore_volume[HostCellId(c)] / real.pore_volume[HostCellId(c)], 1.0, 1e-10);
  }
  for (std::size_t f = 0; f < real.faces.size(); ++f)
    ASSERT_NEAR(host.faces.transmissibility[FaceId(f)], real.faces.transmissibility[FaceId(f)],
                1e-9 * real.faces.transmissibility[FaceId(f)]);
}

/// Largest angle, in degrees, between the line of centres and the face's normal where K measures, of transition faces
/// of more than a small area.
double largest_k_angle(const Mesh& mesh, const Vec3& k) {
  double worst = 0.0;
  const auto& c = mesh.connections;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const ConnectionId id(i);
    const auto [a, b] = c.cells[id];
    if (mesh.cells.kind[a] != CellKind::transition || mesh.cells.kind[b] != CellKind::transition || c.area[id] < 1e-6)
      continue;
    const Vec3 d = mesh.cells.center[b] - mesh.cells.center[a];
    const Vec3 n = c.normal[id];
    const Vec3 one = k.cwiseSqrt().cwiseProduct(n);
    const Vec3 two = d.cwiseQuotient(k.cwiseSqrt());
    worst = std::max(worst, std::atan2(one.cross(two).norm(), one.dot(two)) * 180.0 / std::numbers::pi);
  }
  return worst;
}

TEST(MetricSpace, MeshesOfABoxAreKOrthogonal) {
  BuildOptions options;
  const Case source = near_well::deformed(0.0);
  const Vec3 k(1.0, 1.0, 0.1);
  for (const Path path : {Path::deviated, Path::horizontal}) {
    const Well well = near_well::well(path, 12.0);
    options.metric = Metric::geometric;
    const BuildResult plain = build_mesh(source, {well}, options);
    options.metric = Metric::permeability;
    const BuildResult result = build_mesh(source, {well}, options);
    EXPECT_EQ(check_mesh(result.mesh).size(), 0U);
    EXPECT_LT(largest_k_angle(result.mesh, k), 1e-4);
    EXPECT_GT(largest_k_angle(plain.mesh, k), 10.0) << "the geometric metric would do as well";
    ASSERT_TRUE(result.summary.metric_space.has_value());
    EXPECT_NEAR(result.summary.metric_space->matrix(2, 2), std::sqrt(10.0), 1e-9);
    EXPECT_FALSE(plain.summary.metric_space.has_value());
    // Pore volume and the well's measured depths are the real ones.
    double pore_volume = 0.0;
    double expected = 0.0;
    for (const double v : result.mesh.cells.pore_volume.raw()) pore_volume += v;
    for (const double v : plain.mesh.cells.pore_volume.raw()) expected += v;
    EXPECT_NEAR(pore_volume / expected, 1.0, 1e-12);
    const WellSummary& one = result.summary.wells[0];
    ASSERT_TRUE(one.meshed) << one.reason;
    EXPECT_NEAR(one.length_in_rock, plain.summary.wells[0].length_in_rock, 0.02 * one.length_in_rock);
    EXPECT_GE(one.tubes[0].range.from, well.trajectory.measured_depth.front() - 1e-6);
    EXPECT_LE(one.tubes[0].range.to, well.trajectory.measured_depth.back() + 1e-6);
    for (const WellConnection& c : result.mesh.wells[WellId(0)].connections) {
      EXPECT_GE(c.measured_depth.from, well.trajectory.measured_depth.front() - 1e-6);
      EXPECT_LE(c.measured_depth.to, well.trajectory.measured_depth.back() + 1e-6);
    }
  }
}

TEST(MetricSpace, MeshesOfDeformedGridsAreValid) {
  BuildOptions options;
  options.metric = Metric::permeability;
  for (const Path path : {Path::vertical, Path::curved}) {
    const BuildResult result = build_mesh(near_well::deformed(0.5), {near_well::well(path, 12.0)}, options);
    EXPECT_TRUE(result.summary.wells[0].meshed) << result.summary.wells[0].reason;
    EXPECT_EQ(check_mesh(result.mesh).size(), 0U);
  }
}

TEST(MetricSpace, NeedsPermeability) {
  CornerPointGrid grid = dipping({1.0, 1.0, 0.1}, 0.0, 0.0);
  const Well well = straight({5, 10, 1001}, {35, 70, 1019});
  for (double& k : grid.permeability[2]) k = 0.0;
  EXPECT_THROW(space_of(grid, well), InvalidInput);
  grid.permeability[2].clear();
  EXPECT_THROW(space_of(grid, well), InvalidInput);
}

}  // namespace
}  // namespace wellknit
