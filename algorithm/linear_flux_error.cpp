// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/linear_flux_error.h"

#include <cmath>

namespace wellknit {

Vec3 linear_flux_error(const FaceBetween& face, double transmissibility) {
  const double area = face.area_vector.norm();
  if (!(area > 0.0)) return Vec3::Zero();
  const auto& [k1, k2] = face.permeability;
  const Vec3 n = face.area_vector / area;
  const Vec3 both = 0.5 * (k1 + k2) * n;
  const double d1 = std::abs(n.dot(face.centroid - face.centers[0]));
  const double d2 = std::abs(n.dot(face.centroid - face.centers[1]));
  const double resistance = d1 / n.dot(k1 * n) + d2 / n.dot(k2 * n);
  if (!(n.dot(both) > 0.0) || !std::isfinite(resistance) || !(resistance > 0.0)) return Vec3::Zero();
  const Vec3 flux = (d1 + d2) / resistance / n.dot(both) * area * both;
  return (transmissibility * (face.centers[1] - face.centers[0]) - flux).cwiseAbs() / flux.norm();
}

}  // namespace wellknit
