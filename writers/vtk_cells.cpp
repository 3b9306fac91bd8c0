// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/vtk_cells.h"

namespace wellknit {

void VtkCells::add_polyhedron(const CellSurface& surface) {
  for (const VertexId v : surface.points()) connectivity.push_back(v.value());
  faces.push_back(static_cast<std::int64_t>(surface.size()));
  for (std::size_t f = 0; f < surface.size(); ++f) {
    faces.push_back(static_cast<std::int64_t>(surface.ring(f).size()));
    for (const VertexId v : surface.ring(f)) faces.push_back(v.value());
  }
  face_offsets.push_back(static_cast<std::int64_t>(faces.size()));
  types.push_back(vtk_polyhedron);
  offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
}

void VtkCells::add(std::uint8_t type, std::span<const std::int64_t> points) {
  connectivity.insert(connectivity.end(), points.begin(), points.end());
  face_offsets.push_back(-1);
  types.push_back(type);
  offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
}

}  // namespace wellknit
