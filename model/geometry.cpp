// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/geometry.h"

#include <algorithm>
#include <cmath>

namespace wellknit {

PolygonGeometry polygon_geometry(std::span<const Vec3> vertices) {
  PolygonGeometry out;
  for (const Vec3& v : vertices) out.mean += v;
  out.mean /= static_cast<double>(vertices.size());
  double weight = 0.0;
  Vec3 moment = Vec3::Zero();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3& p = vertices[i];
    const Vec3& q = vertices[(i + 1) % vertices.size()];
    const Vec3 triangle = 0.5 * (p - out.mean).cross(q - out.mean);
    const double area = triangle.norm();
    out.area_vector += triangle;
    weight += area;
    moment += area * ((p - out.mean) + (q - out.mean)) / 3.0;
  }
  out.area = out.area_vector.norm();
  out.centroid = weight > 0.0 ? Vec3(out.mean + moment / weight) : out.mean;
  return out;
}

double planarity(std::span<const Vec3> vertices, const PolygonGeometry& geometry) {
  if (geometry.area <= 0.0) return 0.0;
  const Vec3 normal = geometry.area_vector / geometry.area;
  double worst = 0.0;
  for (const Vec3& v : vertices) worst = std::max(worst, std::abs(normal.dot(v - geometry.mean)));
  return worst / std::sqrt(geometry.area);
}

}  // namespace wellknit
