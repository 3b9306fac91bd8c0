// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/path_cells.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "algorithm/well_path.h"
#include "algorithm/well_piece.h"

namespace wellknit {

namespace {

using Bounds = Eigen::AlignedBox3d;

/// Of every transition cell, from the first one on.
std::vector<Bounds> boxes_of(const Mesh& mesh, std::int64_t first, std::int64_t end) {
  std::vector<Bounds> out(static_cast<std::size_t>(end - first));
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const CellId cell : mesh.faces.cells[FaceId(f)])
      if (cell.value() >= first && cell.value() < end)
        for (const VertexId v : mesh.faces.loop(FaceId(f)))
          out[static_cast<std::size_t>(cell.value() - first)].extend(mesh.vertices[v]);
  return out;
}

/// Places on the path outside of its tubes that lie in a box.
std::vector<Vec3> places_outside(const Well& well, const std::vector<MeasuredDepthRange>& tubes, const Bounds& within) {
  constexpr double most = 20000.0;
  // A path that ends with its tube does not go on behind it, whatever rounding says; of the drainage radius.
  constexpr double rounding = 1e-6;
  const WellPath path(well.trajectory);
  const double length = path.last_depth() - path.first_depth();
  const auto steps = static_cast<int>(std::clamp(std::ceil(10.0 * length / well.radial.drainage_radius), 1.0, most));
  const double near = rounding * well.radial.drainage_radius;
  std::vector<Vec3> out;
  for (int n = 0; n <= steps; ++n) {
    const double depth = path.first_depth() + length * n / steps;
    if (std::any_of(tubes.begin(), tubes.end(),
                    [&](const MeasuredDepthRange& t) { return t.from - near < depth && depth < t.to + near; }))
      continue;
    if (const Vec3 p = path.point(depth); within.contains(p)) out.push_back(p);
  }
  return out;
}

}  // namespace

std::vector<CellId> transition_cells_on_paths(const Assembly& assembly, const std::vector<Well>& wells) {
  std::vector<CellId> out;
  if (assembly.first_transition_cell.empty() || assembly.tubes.empty()) return out;
  const std::int64_t first = assembly.first_transition_cell.front();
  const std::vector<Bounds> boxes = boxes_of(assembly.mesh, first, assembly.tubes.front().first_cell.value());
  Bounds all;
  for (const Bounds& box : boxes) all.extend(box);
  for (std::size_t w = 0; w < wells.size(); ++w) {
    std::vector<MeasuredDepthRange> tubes;
    for (const PlacedTube& t : assembly.tubes)
      if (t.tube->well == w) tubes.push_back(range_of(*t.tube));
    const std::vector<Vec3> places = places_outside(wells[w], tubes, all);
    Bounds around;
    for (const Vec3& p : places) around.extend(p);
    for (std::size_t c = 0; c < boxes.size(); ++c)
      if (boxes[c].intersects(around) &&
          std::any_of(places.begin(), places.end(), [&](const Vec3& p) { return boxes[c].contains(p); }))
        out.emplace_back(first + static_cast<std::int64_t>(c));
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace wellknit
