// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/rock_tensor.h"

namespace wellknit {

namespace {

/// Orthonormal axes from a direction in the layer and one about normal to it; nothing where they do not span a plane.
Eigen::Matrix3d axes_from(const Vec3& along, const Vec3& normal) {
  const Vec3 n = normal.normalized();
  const Vec3 first = along - along.dot(n) * n;
  // A millionth: the directions' own rounding.
  if (!(normal.norm() > 0.0) || !(first.norm() > 1e-6 * along.norm())) return Eigen::Matrix3d::Identity();
  Eigen::Matrix3d out;
  out.col(0) = first.normalized();
  out.col(1) = n.cross(out.col(0));
  out.col(2) = n;
  return out;
}

Eigen::Matrix3d turned(const Cells& cells, CellId cell, const Eigen::Matrix3d& axes) {
  const double ntg = cells.net_to_gross[cell];
  const Vec3 k = cells.permeability[cell].cwiseProduct(Vec3(ntg, ntg, 1.0));
  return axes * k.asDiagonal() * axes.transpose();
}

std::int64_t first_made(const Assembly& assembly) {
  return assembly.first_transition_cell.empty() ? static_cast<std::int64_t>(assembly.mesh.cells.size())
                                                : assembly.first_transition_cell.front();
}

}  // namespace

Eigen::Matrix3d layer_axes(const HostMesh& host, HostCellId cell) {
  const auto corners = host.corners_of(cell);
  Vec3 i = Vec3::Zero();
  Vec3 j = Vec3::Zero();
  for (std::size_t c = 0; c < 8; ++c) {
    const Vec3& p = host.vertices[corners[c]];
    i += (c & 1U) != 0 ? p : Vec3(-p);
    j += (c & 2U) != 0 ? p : Vec3(-p);
  }
  const Vec3 normal = i.cross(j);
  return axes_from(i, normal.z() < 0.0 ? Vec3(-normal) : normal);
}

void set_rock_axes(const HostMesh& host, Assembly& assembly) {
  const std::int64_t first = first_made(assembly);
  const std::size_t count = assembly.mesh.cells.size() - static_cast<std::size_t>(first);
  std::vector<Vec3> along(count, Vec3::Zero());
  std::vector<Vec3> normal(count, Vec3::Zero());
  const Transfer& transfer = assembly.mesh.transfer;
  for (std::size_t c = 0; c + 1 < transfer.start.size(); ++c) {
    if (host.exists[HostCellId(c)] == 0) continue;
    Eigen::Matrix3d axes;
    bool is_known = false;
    for (auto at = static_cast<std::size_t>(transfer.start[c]); at < static_cast<std::size_t>(transfer.start[c + 1]);
         ++at) {
      if (transfer.cell[at].value() < first) continue;
      if (!is_known) axes = layer_axes(host, HostCellId(c));
      is_known = true;
      const auto made = static_cast<std::size_t>(transfer.cell[at].value() - first);
      const double volume = transfer.fraction[at] * host.volume[HostCellId(c)];
      along[made] += volume * axes.col(0);
      normal[made] += volume * axes.col(2);
    }
  }
  assembly.rock_axes.clear();
  for (std::size_t m = 0; m < count; ++m) assembly.rock_axes.push_back(axes_from(along[m], normal[m]));
}

Eigen::Matrix3d rock_tensor(const Assembly& assembly, CellId cell) {
  const std::int64_t number = cell.value() - first_made(assembly);
  const bool is_made = number >= 0 && static_cast<std::size_t>(number) < assembly.rock_axes.size();
  return turned(assembly.mesh.cells, cell,
                is_made ? assembly.rock_axes[static_cast<std::size_t>(number)] : Eigen::Matrix3d::Identity());
}

Eigen::Matrix3d rock_tensor(const Assembly& assembly, const HostMesh& host, CellId cell) {
  if (cell.value() >= first_made(assembly)) return rock_tensor(assembly, cell);
  return turned(assembly.mesh.cells, cell, layer_axes(host, assembly.host_cell[cell.index()]));
}

}  // namespace wellknit
