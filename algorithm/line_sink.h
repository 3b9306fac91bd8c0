// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Flow from a long straight circular bore in anisotropic rock, in closed form (docs/algorithms/flow.md, "Line sink").
///
/// The pressure does not change along the bore. In a section plane with the principal permeabilities k_1 >= k_2 the
/// coordinates x sqrt(k/k_1), y sqrt(k/k_2), k = sqrt(k_1 k_2), make the rock isotropic and the bore an ellipse. Around
/// it zeta = (z + sqrt(z^2 + c^2)) / 2, z = x + i y there, c the half distance of the foci, is the coordinate in which
/// the confocal ellipses are circles: p = q mu / (2 pi k L) ln(rho / rho_bore), rho = |zeta|, and the flow between two
/// points is q / (2 pi) times the difference of nu = arg zeta. Isotropic: rho is the distance, nu the angle.
#pragma once

#include <complex>

#include "model/geometry.h"

namespace wellknit {

/// A section plane through the bore's axis, and the coordinates in it.
class BoreSection {
 public:
  /// `axis`: along the bore, any length. `normal`: of the section; the axis itself for a section across the bore, the
  /// vertical for one in plan. Where they are more than 70 degrees apart the section is across the bore.
  BoreSection(const Vec3& axis, const Vec3& normal);

  [[nodiscard]] const Vec3& normal() const { return normal_; }
  /// Coordinates of a point, given from a point of the axis: where the line through it along the axis meets the plane.
  [[nodiscard]] Eigen::Vector2d along_axis(const Vec3& offset) const { return oblique_ * offset; }
  /// Coordinates of its foot on the plane.
  [[nodiscard]] Eigen::Vector2d in_plane(const Vec3& offset) const { return basis_.transpose() * offset; }
  /// What a permeability is in these coordinates: 2 x 2.
  [[nodiscard]] Eigen::Matrix2d permeability(const Eigen::Matrix3d& k) const {
    return oblique_ * k * oblique_.transpose();
  }
  /// Gradient in space of a function of these coordinates that does not change along the axis.
  [[nodiscard]] Vec3 gradient(const Eigen::Vector2d& in_section) const { return oblique_.transpose() * in_section; }

 private:
  Vec3 normal_;
  Eigen::Matrix<double, 3, 2> basis_;
  Eigen::Matrix<double, 2, 3> oblique_;
};

/// The field in a section.
class LineSink {
 public:
  /// `permeability`: 2 x 2, symmetric, m2. `bore_radius`: m; the bore is a circle of the section.
  LineSink(const Eigen::Matrix2d& permeability, double bore_radius);

  /// sqrt(k_1 k_2), m2; 0 where the rock lets nothing through in some direction: then nothing else is defined.
  [[nodiscard]] double conductance() const { return conductance_; }
  /// zeta of a point outside of the bore, m.
  [[nodiscard]] std::complex<double> at(const Eigen::Vector2d& point) const;
  /// rho of the bore's wall, m.
  [[nodiscard]] double bore() const { return bore_; }
  /// Of ln rho at a point, 1/m.
  [[nodiscard]] Eigen::Vector2d gradient(const Eigen::Vector2d& point) const;

 private:
  [[nodiscard]] std::complex<double> stretched(const Eigen::Vector2d& point) const;
  [[nodiscard]] std::complex<double> root(std::complex<double> z) const;

  double conductance_ = 0.0;
  double ratio_ = 1.0;            ///< sqrt(k_1 / k_2)
  double focus2_ = 0.0;           ///< c^2, m2
  double bore_ = 0.0;             ///< m
  Eigen::Vector2d first_{1, 0};   ///< unit direction of k_1
  Eigen::Vector2d second_{0, 1};  ///< of k_2
};

/// Angle from one zeta to another, within half a turn either way.
inline double angle_between(std::complex<double> from, std::complex<double> to) {
  return std::arg(to * std::conj(from));
}

}  // namespace wellknit
