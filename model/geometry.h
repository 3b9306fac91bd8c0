// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Points and polygons in three dimensions. Metres; (x, y, depth), depth positive down; "right-hand" is
/// the right-hand rule applied to that triple as stored.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>

namespace wellknit {

using Vec3 = Eigen::Vector3d;

/// x -> origin + matrix (x - origin). The matrix is regular.
struct AffineMap {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Identity();
  Vec3 origin = Vec3::Zero();
  double determinant = 1.0;

  [[nodiscard]] bool is_identity() const { return matrix == Eigen::Matrix3d::Identity(); }
  [[nodiscard]] Vec3 to(const Vec3& x) const { return origin + matrix * (x - origin); }
  [[nodiscard]] Vec3 from(const Vec3& x) const { return origin + inverse * (x - origin); }
};

/// A polygon taken as the fan of triangles around the mean of its vertices.
struct PolygonGeometry {
  Vec3 mean = Vec3::Zero();         ///< mean of the vertices, m
  Vec3 area_vector = Vec3::Zero();  ///< right-hand normal times area, m2
  Vec3 centroid = Vec3::Zero();     ///< area-weighted, m
  double area = 0.0;                ///< length of area_vector, m2
};

/// Geometry of the polygon with these 3 or more vertices, in order.
PolygonGeometry polygon_geometry(std::span<const Vec3> vertices);

/// Largest distance of a vertex from the plane through the mean with the polygon's normal,
/// over the square root of its area; 0 for a polygon without area.
double planarity(std::span<const Vec3> vertices, const PolygonGeometry& geometry);

}  // namespace wellknit
