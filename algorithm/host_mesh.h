// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The corner-point host as a watertight polyhedral mesh (method.md §1): unique vertices along the pillars, matched
/// faces, and fault faces cut into their common polygons.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/corner_point_grid.h"
#include "model/ids.h"
#include "model/mesh.h"

namespace wellknit {

/// Axis of the grid that a host face is normal to.
enum class Axis : std::uint8_t { i = 0, j = 1, k = 2 };

/// Faces that have an active cell of positive volume on at least one side.
struct HostFaces {
  std::vector<std::int64_t> vertex_start{0};  ///< size()+1 offsets
  std::vector<VertexId> vertices;             ///< loops; right-hand normal from cells[0] to cells[1]
  /// The source cells on both sides. cells[0] is always an active cell; cells[1] may be active, inactive, or invalid
  /// (outside of the grid, or a gap). Two active cells stand in order of their ids.
  IdVector<FaceId, std::array<HostCellId, 2>> cells;
  IdVector<FaceId, Axis> axis;
  IdVector<FaceId, std::uint8_t> is_fault;  ///< 1: a part of a cell's face, cut along a split pillar pair
  IdVector<FaceId, std::uint8_t> is_pinch;  ///< 1: the two cells are neighbours across zero-thickness cells

  [[nodiscard]] std::size_t size() const { return cells.size(); }
  [[nodiscard]] std::span<const VertexId> loop(FaceId face) const {
    const auto begin = static_cast<std::size_t>(vertex_start[face.index()]);
    return {vertices.data() + begin, static_cast<std::size_t>(vertex_start[face.index() + 1]) - begin};
  }
};

struct HostMesh {
  IdVector<VertexId, Vec3> vertices;
  /// 8 per source cell, inactive ones too: vertex of corner (di, dj, dk) at 8 cell + di + 2 dj + 4 dk. Corners of one
  /// pillar whose depths differ by no more than the merge tolerance share a vertex.
  std::vector<VertexId> corner_vertex;
  HostFaces faces;
  IdVector<HostCellId, double> volume;        ///< m3, positive: eight corners with bilinear faces; all source cells
  IdVector<HostCellId, double> pore_volume;   ///< m3; see source_pore_volumes()
  IdVector<HostCellId, std::uint8_t> exists;  ///< 1: active, of positive volume and not below MINPV: a cell of the mesh
  bool left_handed = false;                   ///< i, j, k make a left-handed triple in (x, y, depth)
  std::vector<std::string> notes;             ///< what was mended or looks wrong, one sentence each

  [[nodiscard]] VertexId corner(HostCellId cell, int di, int dj, int dk) const {
    return corner_vertex[8 * cell.index() + static_cast<std::size_t>(di + 2 * dj + 4 * dk)];
  }
};

/// Corners of one pillar closer than this are one vertex, m. Decks give three decimals and EGRID files 24 bits.
inline constexpr double pillar_merge_tolerance = 1e-6;

/// Builds the host. Throws InvalidInput where validate(grid) would, or when no active cell has a volume.
HostMesh build_host_mesh(const CornerPointGrid& grid);

}  // namespace wellknit
