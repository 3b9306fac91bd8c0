// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/metric_space.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "algorithm/cell_path.h"
#include "algorithm/host_transmissibility.h"
#include "algorithm/rock_tensor.h"
#include "algorithm/well_path.h"
#include "model/errors.h"

namespace wellknit {

namespace {

constexpr double least_permeability = 1e-4;  ///< of the largest of a cell

/// Logarithm of a cell's permeability in units of the cube root of its determinant; zero where it is not defined.
bool log_permeability(const CornerPointGrid& grid, const HostMesh& host, HostCellId cell, Eigen::Matrix3d& out) {
  const auto k = host_rock(grid, host, cell).effective();
  const double largest = *std::max_element(k.begin(), k.end());
  if (!(*std::min_element(k.begin(), k.end()) > 0.0) || !std::isfinite(largest)) return false;
  Vec3 logs;
  for (int a = 0; a < 3; ++a)
    logs[a] = std::log(std::max(k[static_cast<std::size_t>(a)] / largest, least_permeability));
  logs.array() -= logs.mean();
  const Eigen::Matrix3d axes = layer_axes(host, cell);
  out = axes * logs.asDiagonal() * axes.transpose();
  return true;
}

Eigen::Matrix3d exponential(const Eigen::Matrix3d& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(symmetric);
  return eigen.eigenvectors() * eigen.eigenvalues().array().exp().matrix().asDiagonal() *
         eigen.eigenvectors().transpose();
}

Eigen::Matrix2d square_root(const Eigen::Matrix2d& positive) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(positive).operatorSqrt();
}

/// S with S^T S = metric up to a factor, of the form ((P, 0), (r^T, t)), P symmetric and of determinant 1.
Eigen::Matrix3d plan_preserving_root(const Eigen::Matrix3d& metric) {
  const double t = std::sqrt(metric(2, 2));
  const Eigen::Vector2d r = metric.topRightCorner<2, 1>() / t;
  const Eigen::Matrix2d p = square_root(metric.topLeftCorner<2, 2>() - r * r.transpose());
  Eigen::Matrix3d s = Eigen::Matrix3d::Zero();
  s.topLeftCorner<2, 2>() = p;
  s.bottomLeftCorner<1, 2>() = r.transpose();
  s(2, 2) = t;
  return s / std::sqrt(p.determinant());
}

/// Depth rises along all pillars in the image too.
bool keeps_pillars_upright(const CornerPointGrid& grid, const Eigen::Matrix3d& s) {
  for (std::size_t n = 0; n + 5 < grid.coord.size(); n += 6) {
    const Vec3 d(grid.coord[n + 3] - grid.coord[n], grid.coord[n + 4] - grid.coord[n + 1],
                 grid.coord[n + 5] - grid.coord[n + 2]);
    if (d.z() != 0.0 && !((s.row(2) * d).value() * d.z() > 0.0)) return false;
  }
  return true;
}

AffineMap affine_map(const Eigen::Matrix3d& matrix, const Vec3& origin) {
  return {matrix, matrix.inverse(), origin, matrix.determinant()};
}

/// Least and largest depth of the grid's corners.
std::array<double, 2> depth_range(const CornerPointGrid& grid) {
  const auto [low, high] = std::minmax_element(grid.zcorn.begin(), grid.zcorn.end());
  return {*low, *high};
}

/// The bore's largest radius on the pieces of a path that lie in a range of depths; on all where none does.
double largest_bore_radius(const AffineMap& space, const Trajectory& path, double bore_radius,
                           const std::array<double, 2>& range) {
  for (const bool all : {false, true}) {
    double largest = 0.0;
    for (std::size_t n = 0; n + 1 < path.points.size(); ++n) {
      const Vec3& a = path.points[n];
      const Vec3& b = path.points[n + 1];
      const bool is_inside = std::max(a.z(), b.z()) >= range[0] && std::min(a.z(), b.z()) <= range[1];
      if (!(all || is_inside) || a == b) continue;
      largest = std::max(largest, moved_bore_radius(space, b - a, bore_radius));
    }
    if (largest > 0.0) return largest;
  }
  return bore_radius;
}

void move_pillar(const AffineMap& space, double* p) {
  const Vec3 top(p[0], p[1], p[2]);
  Vec3 bottom(p[3], p[4], p[5]);
  // One without height is vertical (CornerPointGrid::pillar_point).
  if (top.z() == bottom.z()) bottom = top + Vec3::UnitZ();
  const Vec3 a = space.to(top);
  const Vec3 b = space.to(bottom);
  std::copy_n(a.data(), 3, p);
  std::copy_n(b.data(), 3, p + 3);
}

}  // namespace

AffineMap metric_space(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator,
                       const std::vector<Well>& wells) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (grid.permeability[axis].empty())
      throw InvalidInput(fmt::format(
          "--metric permeability needs PERM{}: give it with the grid, or take --metric geometric", "XYZ"[axis]));
  double length = 0.0;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Vec3 middle = Vec3::Zero();
  for (const Well& well : wells)
    for (const CellPart& part : cells_along(grid, locator, well.trajectory)) {
      Eigen::Matrix3d logs;
      if (host.exists[part.cell] == 0 || !log_permeability(grid, host, part.cell, logs)) continue;
      const double weight = (part.exit - part.entry).norm();
      length += weight;
      sum += weight * logs;
      middle += weight * part.entry;
    }
  if (!(length > 0.0))
    throw InvalidInput(
        "--metric permeability: no cell on the wells' paths has permeability along all of its axes; take --metric "
        "geometric");
  const Eigen::Matrix3d metric = exponential(-sum / length);
  const Vec3 origin = middle / length;
  const Eigen::Matrix3d s = plan_preserving_root(metric);
  if (keeps_pillars_upright(grid, s)) return affine_map(s, origin);
  return affine_map(Vec3(1.0, 1.0, s(2, 2)).asDiagonal(), origin);
}

CornerPointGrid moved(const AffineMap& space, const CornerPointGrid& grid) {
  CornerPointGrid out = grid;
  const std::int64_t columns = 2 * grid.dimensions[0];
  const std::int64_t rows = 2 * grid.dimensions[1];
  tbb::parallel_for(std::int64_t{0}, 2 * grid.dimensions[2] * rows, [&](std::int64_t row) {
    const std::int64_t j = (row % rows + 1) / 2;
    for (std::int64_t n = 0; n < columns; ++n) {
      const auto at = static_cast<std::size_t>(columns * row + n);
      out.zcorn[at] = space.to(grid.pillar_point((n + 1) / 2, j, grid.zcorn[at])).z();
    }
  });
  for (std::size_t n = 0; n + 5 < out.coord.size(); n += 6) move_pillar(space, &out.coord[n]);
  for (double& p : out.porosity) p /= space.determinant;
  return out;
}

Well moved(const AffineMap& space, const CornerPointGrid& grid, Well well) {
  Trajectory& path = well.trajectory;
  well.radial.bore_radius = largest_bore_radius(space, path, well.radial.bore_radius, depth_range(grid));
  path.moved = {space, path.measured_depth};
  const std::vector<double>& before = path.moved.measured_depth;
  for (std::size_t n = 0; n + 1 < path.points.size(); ++n) {
    const Vec3 step = path.points[n + 1] - path.points[n];
    const double ratio = step.norm() > 0.0 ? (space.matrix * step).norm() / step.norm() : 1.0;
    path.measured_depth[n + 1] = path.measured_depth[n] + ratio * (before[n + 1] - before[n]);
  }
  for (Vec3& p : path.points) p = space.to(p);
  const auto along = [&](double depth) { return interpolated(before, path.measured_depth, depth); };
  for (MeasuredDepthRange& o : well.open) o = {along(o.from), along(o.to)};
  return well;
}

double moved_bore_radius(const AffineMap& space, const Vec3& axis, double bore_radius) {
  const Vec3 u = axis.normalized();
  const Vec3 first = u.unitOrthogonal();
  const Vec3 along = (space.matrix * u).normalized();
  // The image of the bore's circle, seen along the image of its axis: semi-axes are singular values.
  Eigen::Matrix<double, 3, 2> image;
  image << space.matrix * first, space.matrix * u.cross(first);
  image -= along * (along.transpose() * image).eval();
  const Eigen::Matrix2d square = image.transpose() * image;
  // (p + q)^2 = p^2 + q^2 + 2 p q.
  return bore_radius * 0.5 * std::sqrt(square.trace() + 2.0 * std::sqrt(std::max(0.0, square.determinant())));
}

Eigen::Matrix3d moved_permeability(const AffineMap& space, const Eigen::Matrix3d& k) {
  if (space.is_identity()) return k;
  return space.matrix * k * space.matrix.transpose() / space.determinant;
}

Vec3 moved_area(const AffineMap& space, const Vec3& area_vector) {
  if (space.is_identity()) return area_vector;
  return space.determinant * (space.inverse.transpose() * area_vector);
}

void move_back(const AffineMap& space, const CornerPointGrid& grid, HostMesh& host) {
  for (Vec3& p : host.vertices.raw()) p = space.from(p);
  for (double& v : host.volume.raw()) v /= space.determinant;
  if (host.faces.transmissibility.empty()) return;
  tbb::parallel_for(std::size_t{0}, host.faces.size(), [&](std::size_t f) {
    const FaceId face(f);
    double& t = host.faces.transmissibility[face];
    const auto [a, b] = host.faces.cells[face];
    if (!b.is_valid() || host.exists[a] == 0 || host.exists[b] == 0) return;
    const Vec3 area = host_face_area_vector(host, face);
    const Axis axis = host.faces.axis[face];
    const double first = host_half_transmissibility(grid, host, a, axis, area);
    const double second = host_half_transmissibility(grid, host, b, axis, area);
    t = first > 0.0 && second > 0.0 ? first / (first + second) * second : 0.0;
  });
}

void move_back(const AffineMap& space, Assembly& assembly) {
  Cells& cells = assembly.mesh.cells;
  for (Vec3& p : assembly.mesh.vertices.raw()) p = space.from(p);
  for (Vec3& p : cells.center.raw()) p = space.from(p);
  for (Vec3& p : cells.centroid.raw()) p = space.from(p);
  for (std::size_t c = 0; c < cells.size(); ++c) cells.depth[CellId(c)] = cells.center[CellId(c)].z();
  for (double& v : cells.volume.raw()) v /= space.determinant;
}

void move_back(const Well& moved_well, Tube& tube) {
  const WellPath path(moved_well.trajectory);
  for (double& depth : tube.real.measured_depth) depth = path.original(depth);
}

}  // namespace wellknit
