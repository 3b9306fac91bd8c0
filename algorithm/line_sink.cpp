// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/line_sink.h"

#include <cmath>

namespace wellknit {

namespace {

/// Cosine of 70 degrees: beyond, a section in plan would be a poor picture of the bore.
constexpr double least_cosine = 0.342;

/// k_2 below this part of k_1 is no flow at all: sqrt(k_1 / k_2) would be 1e6.
constexpr double least_ratio = 1e-12;

}  // namespace

BoreSection::BoreSection(const Vec3& axis, const Vec3& normal) : normal_(normal.normalized()) {
  const Vec3 e = axis.normalized();
  if (std::abs(e.dot(normal_)) < least_cosine) normal_ = e;
  basis_.col(0) = normal_.unitOrthogonal();
  basis_.col(1) = normal_.cross(basis_.col(0));
  oblique_ = basis_.transpose() * (Eigen::Matrix3d::Identity() - e * normal_.transpose() / normal_.dot(e));
}

LineSink::LineSink(const Eigen::Matrix2d& permeability, double bore_radius) {
  const double mean = 0.5 * permeability.trace();
  const double difference = 0.5 * (permeability(0, 0) - permeability(1, 1));
  const double off = permeability(0, 1);
  const double spread = std::hypot(difference, off);
  const double k1 = mean + spread;
  // Not mean - spread, which cancels.
  const double k2 = k1 > 0.0 ? permeability.determinant() / k1 : 0.0;
  if (!(k2 > least_ratio * k1)) return;
  conductance_ = std::sqrt(k1 * k2);
  ratio_ = std::sqrt(k1 / k2);
  const double angle = 0.5 * std::atan2(off, difference);
  first_ = {std::cos(angle), std::sin(angle)};
  second_ = {-std::sin(angle), std::cos(angle)};
  // The bore's half-axes are r / sqrt(ratio) and r sqrt(ratio).
  focus2_ = bore_radius * bore_radius * std::max(0.0, ratio_ - 1.0 / ratio_);
  bore_ = 0.5 * bore_radius * (std::sqrt(ratio_) + 1.0 / std::sqrt(ratio_));
}

std::complex<double> LineSink::stretched(const Eigen::Vector2d& point) const {
  const double root = std::sqrt(ratio_);
  return {first_.dot(point) / root, second_.dot(point) * root};
}

/// Of the two values the one that points as z does: the outside of the ellipses.
std::complex<double> LineSink::root(std::complex<double> z) const {
  const std::complex<double> r = std::sqrt(z * z + focus2_);
  return r.real() * z.real() + r.imag() * z.imag() < 0.0 ? -r : r;
}

std::complex<double> LineSink::at(const Eigen::Vector2d& point) const {
  const auto z = stretched(point);
  return 0.5 * (z + root(z));
}

Eigen::Vector2d LineSink::gradient(const Eigen::Vector2d& point) const {
  // d ln zeta / dz = 1 / sqrt(z^2 + c^2); the gradient of its real part is the conjugate.
  const auto derivative = 1.0 / root(stretched(point));
  const double root = std::sqrt(ratio_);
  return derivative.real() / root * first_ - derivative.imag() * root * second_;
}

}  // namespace wellknit
