// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Cells as VTK has them: surfaces in the frame with z up, and the shapes that they are.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/mesh.h"
#include "model/mesh_topology.h"

namespace wellknit {

inline constexpr std::uint8_t vtk_tetrahedron = 10;
inline constexpr std::uint8_t vtk_hexahedron = 12;
inline constexpr std::uint8_t vtk_pyramid = 14;
inline constexpr std::uint8_t vtk_polyhedron = 42;

/// A cell's outer surface in the mirrored frame: every ring turns outwards after z has changed its sign.
class CellSurface {
 public:
  void assign(const Mesh& mesh, std::span<const CellFace> faces) {
    start_.assign(1, 0);
    vertices_.clear();
    for (const CellFace& side : faces) {
      const auto loop = mesh.faces.loop(side.face);
      // Outward in (x, y, depth) is inward in (x, y, -depth).
      if (side.outward)
        vertices_.insert(vertices_.end(), loop.rbegin(), loop.rend());
      else
        vertices_.insert(vertices_.end(), loop.begin(), loop.end());
      start_.push_back(vertices_.size());
    }
    points_ = vertices_;
    std::sort(points_.begin(), points_.end());
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
  }

  [[nodiscard]] std::size_t size() const { return start_.size() - 1; }
  [[nodiscard]] std::span<const VertexId> ring(std::size_t face) const {
    return std::span(vertices_).subspan(start_[face], start_[face + 1] - start_[face]);
  }
  /// Sorted, each once.
  [[nodiscard]] const std::vector<VertexId>& points() const { return points_; }

  /// The eight points in VTK's order when the surface is that of a hexahedron.
  [[nodiscard]] std::optional<std::array<VertexId, 8>> hexahedron() const {
    if (size() != 6 || points_.size() != 8 || vertices_.size() != 24) return std::nullopt;
    for (std::size_t f = 0; f < 6; ++f)
      if (ring(f).size() != 4) return std::nullopt;
    // VTK's base looks into the cell: the reverse of an outward ring.
    std::array<VertexId, 8> out;
    std::reverse_copy(ring(0).begin(), ring(0).end(), out.begin());
    for (std::size_t i = 0; i < 4; ++i) {
      const std::optional<VertexId> top = neighbour_off_base(out[i]);
      if (!top) return std::nullopt;
      out[4 + i] = *top;
    }
    return is_ring({out[4], out[5], out[6], out[7]}) ? std::optional(out) : std::nullopt;
  }

 private:
  [[nodiscard]] bool on_base(VertexId v) const { return std::count(ring(0).begin(), ring(0).end(), v) > 0; }

  /// The one vertex outside of the first face that an edge joins to v.
  [[nodiscard]] std::optional<VertexId> neighbour_off_base(VertexId v) const {
    std::optional<VertexId> found;
    for (std::size_t f = 1; f < 6; ++f) {
      const auto loop = ring(f);
      for (std::size_t i = 0; i < 4; ++i) {
        const VertexId next = loop[(i + 1) % 4];
        if (loop[i] != v || on_base(next)) continue;
        if (found && *found != next) return std::nullopt;
        found = next;
      }
    }
    return found;
  }

  /// Whether one of the faces is this ring, from any start. Outward, the top runs as VTK's order has it.
  [[nodiscard]] bool is_ring(std::array<VertexId, 4> wanted) const {
    for (std::size_t f = 1; f < 6; ++f) {
      const auto loop = ring(f);
      for (std::size_t turn = 0; turn < 4; ++turn) {
        std::rotate(wanted.begin(), wanted.begin() + 1, wanted.end());
        if (std::equal(wanted.begin(), wanted.end(), loop.begin())) return true;
      }
    }
    return false;
  }

  std::vector<std::size_t> start_;
  std::vector<VertexId> vertices_;
  std::vector<VertexId> points_;
};

/// The cells as VTK's legacy polyhedron form has them.
struct VtkCells {
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets;
  std::vector<std::uint8_t> types;
  std::vector<std::int64_t> faces;         ///< per polyhedron: number of faces, then per face its size and its points
  std::vector<std::int64_t> face_offsets;  ///< the END of each polyhedron's stream; -1 for other cells

  void add_polyhedron(const CellSurface& surface);
  void add(std::uint8_t type, std::span<const std::int64_t> points);
};

}  // namespace wellknit
