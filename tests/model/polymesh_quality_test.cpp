// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Hand-made cases; check_openfoam.py holds the figures of whole models against checkMesh.

#include "model/polymesh_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/meshes.h"

namespace wellknit {
namespace {

TEST(PolymeshQuality, IsZeroInBoxes) {
  const PolymeshQuality boxes = polymesh_quality(meshes::two_boxes());
  EXPECT_NEAR(boxes.max_non_orthogonality, 0.0, 1e-6);
  EXPECT_NEAR(boxes.mean_non_orthogonality, 0.0, 1e-6);
  EXPECT_NEAR(boxes.max_skewness, 0.0, 1e-12);
}

/// The end x = 3 of the second box is moved by 1 along y. Its centroid is (2, 1, 0.5): the line from (0.5, 0.5, 0.5)
/// has a slope of 1/3 and misses the middle of the face at x = 1 by 0.5/3, where the face reaches 0.5. At x = 3 the
/// centre of the face lies 0.5 beside the normal through the centroid, where it reaches 0.5 too.
TEST(PolymeshQuality, TakesCentroidsAndTheBoundaryToo) {
  Mesh mesh = meshes::two_boxes();
  for (Vec3& point : mesh.vertices)
    if (point.x() == 3.0) point.y() += 1.0;
  mesh.cells.center[CellId(1)] = Vec3(1.7, 0.3, 0.2);  // not looked at
  const PolymeshQuality sheared = polymesh_quality(mesh);
  const double angle = std::atan(1.0 / 3.0) * 180.0 / std::numbers::pi;
  EXPECT_NEAR(sheared.max_non_orthogonality, angle, 1e-9);
  EXPECT_NEAR(sheared.mean_non_orthogonality, angle, 1e-9);
  EXPECT_NEAR(sheared.max_skewness, 1.0, 1e-12);
}

}  // namespace
}  // namespace wellknit
