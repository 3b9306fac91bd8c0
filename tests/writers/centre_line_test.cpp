// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/centre_line.h"

#include <gtest/gtest.h>

#include "model/units.h"
#include "tests/support/meshes.h"

namespace wellknit {
namespace {

TEST(CentreLine, MeetsTheFaceWhereItsPlaneCutsTheLine) {
  Mesh mesh = meshes::two_boxes();
  mesh.cells.center[CellId(1)] = Vec3(2.0, 0.5, 0.875);
  // From (0.5, 0.5, 0.5): the plane x = 1 is a third of the way, at a depth of 0.5 + 0.375 / 3.
  const CentreLine line = centre_line(mesh, ConnectionId(0));
  EXPECT_NEAR(line.first_share, 1.0 / 3.0, 1e-15);
  EXPECT_NEAR((line.crossing - Vec3(1.0, 0.5, 0.625)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(line.length, std::hypot(1.5, 0.375), 1e-15);
}

TEST(CentreLine, IsSharedByDistancesWhereItDoesNotMeetTheFace) {
  Mesh mesh = meshes::two_boxes();
  mesh.cells.center[CellId(1)] = Vec3(0.75, 0.5, 0.5);  // on the first box's side
  mesh.connections.half_distance[ConnectionId(0)] = {3.0, 1.0};
  EXPECT_EQ(centre_line(mesh, ConnectionId(0)).first_share, 0.75);
  mesh.connections.half_distance[ConnectionId(0)] = {0.0, 1.0};
  EXPECT_EQ(centre_line(mesh, ConnectionId(0)).first_share, 1e-3);
  mesh.connections.half_distance[ConnectionId(0)] = {0.0, 0.0};
  EXPECT_EQ(centre_line(mesh, ConnectionId(0)).first_share, 0.5);
}

TEST(CentreLine, HasThePermeabilityOfAGradientOfPotential) {
  // 1 / (0.36 / 2 + 0.64 / 8) = 1 / 0.26
  EXPECT_NEAR(permeability_along(Vec3(2.0, 5.0, 8.0), Vec3(0.6, 0.0, 0.8)), 1.0 / 0.26, 1e-14);
  EXPECT_EQ(permeability_along(Vec3(2.0, 0.0, 8.0), Vec3(1.0, 0.0, 0.0)), 2.0);
  EXPECT_EQ(permeability_along(Vec3(0.0, 1.0, 1.0), Vec3(1.0, 0.0, 0.0)), 0.0);
  EXPECT_EQ(permeability_along(Vec3(1.0, 1.0, 1.0), Vec3::Zero()), 0.0);
}

TEST(CentreLine, GivesTheFacesAreaBetweenBoxes) {
  const Mesh mesh = meshes::two_boxes();
  const double k = 100.0 * m2_per_millidarcy;
  const CentreLine line = centre_line(mesh, ConnectionId(0));
  EXPECT_NEAR(effective_area(mesh.connections.transmissibility[ConnectionId(0)], line, k, k), 1.0, 1e-14);
  EXPECT_EQ(effective_area(1.0, line, k, 0.0), 0.0);
}

TEST(CentreLine, TakesABoundarysAreaAcrossTheLineToItsCentroid) {
  Mesh mesh = meshes::two_boxes();
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (mesh.faces.cells[FaceId(f)][1].is_valid()) continue;
    const double raw = boundary_area(mesh, FaceId(f), AreaKind::raw);
    EXPECT_NEAR(boundary_area(mesh, FaceId(f), AreaKind::effective), raw, 1e-14);
  }
  mesh.cells.center[CellId(0)] = Vec3(0.5, 0.5, 0.5 + 0.5 * std::sqrt(3.0));  // x = 0 is now at 60 degrees
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (face_geometry(mesh, FaceId(f)).centroid.x() != 0.0) continue;
    EXPECT_NEAR(boundary_area(mesh, FaceId(f), AreaKind::effective), 0.5, 1e-14);
    return;
  }
  FAIL() << "no face at x = 0";
}

}  // namespace
}  // namespace wellknit
