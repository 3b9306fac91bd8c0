// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Source: S. Agmon, The relaxation method for linear inequalities, Canadian Journal of Mathematics 6 (1954) (key
// Agmon).
#include "algorithm/cell_center.h"

#include <limits>

namespace wellknit {

namespace {

double height(const OutwardFace& face, const Vec3& point) {
  const double area = face.area_vector.norm();
  return area > 0.0 ? (face.mean - point).dot(face.area_vector) / area : std::numeric_limits<double>::infinity();
}

std::optional<Vec3> relax(std::span<const OutwardFace> faces, Vec3 point, double margin) {
  constexpr int most_steps = 3000;  // a step costs as much as one test of the cell
  for (int step = 0; step < most_steps; ++step) {
    double worst = margin;
    const OutwardFace* hidden = nullptr;
    for (const OutwardFace& face : faces) {
      const double h = height(face, point);
      if (h < worst) {
        worst = h;
        hidden = &face;
      }
    }
    if (hidden == nullptr) return point;
    point -= 1.05 * (margin - worst) * hidden->area_vector.normalized();
  }
  return std::nullopt;
}

}  // namespace

double smallest_height(std::span<const OutwardFace> faces, const Vec3& point) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const OutwardFace& face : faces) smallest = std::min(smallest, height(face, point));
  return smallest;
}

std::optional<Vec3> point_that_sees_all(std::span<const OutwardFace> faces, const Vec3& start, double size) {
  for (const double part : {0.05, 0.02, 0.005, 0.001, 0.0001})
    if (const auto p = relax(faces, start, part * size)) return p;
  return std::nullopt;
}

}  // namespace wellknit
