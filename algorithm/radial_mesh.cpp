// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/radial_mesh.h"

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/errors.h"

namespace wellknit {

namespace {

/// Mirror image of a direction in a plane with this unit normal.
Vec3 reflected(const Vec3& direction, const Vec3& unit_normal) {
  return direction - 2.0 * direction.dot(unit_normal) * unit_normal;
}

/// The normals n_k are linear in n_0: n_k = M_k n_0. The best unit n_0 is along sum of M_k^T tangent_k.
Vec3 best_first_normal(std::span<const Vec3> stations, std::span<const Vec3> tangents) {
  Eigen::Matrix3d m = Eigen::Matrix3d::Identity();
  Vec3 sum = tangents[0].normalized();
  for (std::size_t k = 0; k + 1 < stations.size(); ++k) {
    const Vec3 d = (stations[k + 1] - stations[k]).normalized();
    m = (2.0 * d * d.transpose() - Eigen::Matrix3d::Identity()) * m;
    sum += m.transpose() * tangents[k + 1].normalized();
  }
  return sum.norm() > 1e-6 ? sum.normalized() : tangents[0].normalized();
}

/// A direction normal to n, horizontal where that is possible: then sector 0 is easy to find.
Vec3 horizontal_normal_to(const Vec3& n) {
  const Vec3 down(0.0, 0.0, 1.0);
  const Vec3 side = down.cross(n);
  // Below 1e-3 (0.06 degrees) the well is vertical for this purpose and the x axis serves.
  if (side.norm() > 1e-3) return side.normalized();
  return (Vec3::UnitX() - n.x() * n).normalized();
}

}  // namespace

std::vector<double> circle_radii(const RadialOptions& options) {
  const double bore = options.bore_radius;
  const double outer = options.drainage_radius;
  if (!(bore > 0.0)) throw InvalidInput("the bore radius must be positive");
  if (!(outer > bore)) throw InvalidInput("the drainage radius must be larger than the bore radius");
  if (options.sectors < 3) throw InvalidInput("a radial mesh needs 3 or more sectors");
  if (options.rings < 1) throw InvalidInput("a radial mesh needs one or more rings");
  if (options.sectors > 360 || options.rings > 100 || options.segments.value_or(1) > 5000)
    throw InvalidInput("a radial mesh has at most 360 sectors, 100 rings and 5000 segments");
  if (options.segments.value_or(1) < 1) throw InvalidInput("a radial mesh needs one or more segments");
  const int n = options.rings;
  std::vector<double> radii(static_cast<std::size_t>(n) + 1);
  for (int i = 0; i <= n; ++i) {
    double part = 0.0;
    if (options.growth) {
      const double g = *options.growth;
      if (!(g > 0.0) || !std::isfinite(g)) throw InvalidInput("the growth of the rings must be positive");
      part = std::abs(g - 1.0) < 1e-12 ? static_cast<double>(i) / n : (std::pow(g, i) - 1.0) / (std::pow(g, n) - 1.0);
      radii[static_cast<std::size_t>(i)] = bore + part * (outer - bore);
    } else {
      radii[static_cast<std::size_t>(i)] = bore * std::pow(outer / bore, static_cast<double>(i) / n);
    }
  }
  radii.back() = outer;
  for (std::size_t i = 1; i < radii.size(); ++i)
    if (!(radii[i] > radii[i - 1]))
      throw InvalidInput("the rings' growth leaves some of them without width: choose a growth nearer to 1");
  return radii;
}

int rings_within(const RadialOptions& options, double smaller_radius) {
  if (!(smaller_radius < options.drainage_radius)) return options.rings;
  const auto radii = circle_radii(options);
  const auto apart = [&](double radius) { return std::abs(std::log(radius / smaller_radius)); };
  const auto nearest =
      std::min_element(radii.begin() + 1, radii.end(), [&](double a, double b) { return apart(a) < apart(b); });
  return static_cast<int>(nearest - radii.begin());
}

std::vector<RingFrame> sweep_frames(std::span<const Vec3> stations, std::span<const Vec3> tangents) {
  std::vector<RingFrame> frames(stations.size());
  RingFrame frame;
  frame.center = stations[0];
  frame.normal = best_first_normal(stations, tangents);
  frame.e1 = horizontal_normal_to(frame.normal);
  frame.e2 = frame.normal.cross(frame.e1);
  frames[0] = frame;
  for (std::size_t k = 1; k < stations.size(); ++k) {
    const Vec3 d = (stations[k] - stations[k - 1]).normalized();
    frame.center = stations[k];
    frame.normal = -reflected(frame.normal, d);
    frame.e1 = reflected(frame.e1, d);
    frame.e2 = reflected(frame.e2, d);
    frames[k] = frame;
  }
  return frames;
}

double largest_tilt(std::span<const RingFrame> frames, std::span<const Vec3> tangents) {
  double worst = 0.0;
  for (std::size_t k = 0; k < frames.size(); ++k)
    worst = std::max(worst, std::acos(std::clamp(frames[k].normal.dot(tangents[k].normalized()), -1.0, 1.0)));
  return worst;
}

std::vector<Vec3> polyline_tangents(std::span<const Vec3> stations) {
  const std::size_t n = stations.size();
  std::vector<Vec3> tangents(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t before = k == 0 ? 0 : k - 1;
    const std::size_t after = k + 1 == n ? k : k + 1;
    tangents[k] = stations[after] - stations[before];
  }
  if (n > 2) {  // second order at the ends too: the end of a parabola through three stations
    tangents[0] = 4.0 * stations[1] - 3.0 * stations[0] - stations[2];
    tangents[n - 1] = 3.0 * stations[n - 1] - 4.0 * stations[n - 2] + stations[n - 3];
  }
  return tangents;
}

std::vector<Vec3> smoothed_stations(std::span<const Vec3> stations, double weight) {
  const auto n = static_cast<Eigen::Index>(stations.size());
  if (n < 3) return {stations.begin(), stations.end()};
  Eigen::SparseMatrix<double> second(n - 2, n);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index k = 0; k + 2 < n; ++k) {
    entries.emplace_back(k, k, 1.0);
    entries.emplace_back(k, k + 1, -2.0);
    entries.emplace_back(k, k + 2, 1.0);
  }
  second.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseMatrix<double> identity(n, n);
  identity.setIdentity();
  const Eigen::SparseMatrix<double> system =
      identity + weight * Eigen::SparseMatrix<double>(second.transpose() * second);
  Eigen::MatrixXd right(n, 3);
  for (Eigen::Index k = 0; k < n; ++k) right.row(k) = stations[static_cast<std::size_t>(k)].transpose();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(system);
  const Eigen::MatrixXd solution = factor.solve(right);
  std::vector<Vec3> out(stations.size());
  for (Eigen::Index k = 0; k < n; ++k) out[static_cast<std::size_t>(k)] = solution.row(k).transpose();
  return out;
}

RadialMesh sweep_rings(std::span<const RingFrame> frames, std::span<const double> radii, int sectors,
                       double start_angle) {
  RadialMesh mesh;
  mesh.segments = static_cast<int>(frames.size()) - 1;
  mesh.sectors = sectors;
  mesh.rings = static_cast<int>(radii.size()) - 1;
  mesh.points.reserve(frames.size() * radii.size() * static_cast<std::size_t>(sectors));
  for (const RingFrame& frame : frames) {
    mesh.axis.push_back(frame.center);
    for (const double r : radii)
      for (int s = 0; s < sectors; ++s) {
        const double angle = start_angle + 2.0 * std::numbers::pi * s / sectors;
        mesh.points.push_back(frame.center + r * (std::cos(angle) * frame.e1 + std::sin(angle) * frame.e2));
      }
  }
  return mesh;
}

double smallest_lateral_ratio(const RadialMesh& mesh, int* station) {
  double smallest = 1.0;
  for (int k = 0; k < mesh.segments; ++k) {
    const Vec3 chord = mesh.axis[static_cast<std::size_t>(k) + 1] - mesh.axis[static_cast<std::size_t>(k)];
    for (int s = 0; s < mesh.sectors; ++s) {
      const Vec3 edge = mesh.point(k + 1, mesh.rings, s) - mesh.point(k, mesh.rings, s);
      const double ratio = edge.dot(chord) / chord.squaredNorm();
      if (ratio < smallest) {
        smallest = ratio;
        if (station != nullptr) *station = k;
      }
    }
  }
  return smallest;
}

}  // namespace wellknit
