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

/// Where the corners of all source cells lie on their pillars. The horizons of a column of cells, each a top or a base,
/// are its levels: 0 the uppermost, 2 nz - 1 the deepest. The nodes of a pillar are vertices with consecutive ids,
/// downwards: a pillar's ranks compare like depths.
struct HostCorners {
  std::array<std::int64_t, 3> dimensions{};
  bool upside_down = false;     ///< layers are numbered upwards
  std::vector<VertexId> first;  ///< (nx+1)(ny+1): a pillar's uppermost node
  /// 8 nx ny nz: rank of level l of corner di + 2 dj of column i + nx j, counted from the pillar's uppermost node, at
  /// 2 nz (corner + 4 column) + l. Corners whose depths differ by no more than the merge tolerance have one rank.
  LargeArray<std::int32_t> rank;

  [[nodiscard]] std::int64_t levels() const { return 2 * dimensions[2]; }
  /// Place in `first` of corner di + 2 dj of column (i, j).
  [[nodiscard]] std::size_t pillar(std::int64_t i, std::int64_t j, int corner) const {
    return static_cast<std::size_t>(i + (corner & 1) + (dimensions[0] + 1) * (j + (corner >> 1)));
  }
  /// A pillar's uppermost node, and the vertex after its deepest.
  [[nodiscard]] std::array<VertexId, 2> nodes_on(std::size_t pillar) const {
    if (pillar + 1 < first.size()) return {first[pillar], first[pillar + 1]};
    // The last pillar is that of one column alone.
    const std::int32_t last = on_pillar(dimensions[0] * dimensions[1] - 1, 3)[levels() - 1];
    return {first[pillar], VertexId(first[pillar].value() + last + 1)};
  }
  /// Ranks of a column's levels on one of its pillars, rising; 2 nz of them.
  [[nodiscard]] const std::int32_t* on_pillar(std::int64_t column, int corner) const {
    return rank.data() + levels() * (corner + 4 * column);
  }
  /// Layer whose cell lies between levels 2 place and 2 place + 1; and the other way round.
  [[nodiscard]] std::int64_t layer(std::int64_t place) const { return upside_down ? dimensions[2] - 1 - place : place; }
};

/// Faces that have an active cell of positive volume on at least one side.
struct HostFaces {
  LargeArray<std::int64_t> vertex_start{0};  ///< size()+1 offsets
  LargeArray<VertexId> vertices;             ///< loops; right-hand normal from cells[0] to cells[1]
  /// The source cells on both sides. cells[0] is always an active cell; cells[1] may be active, inactive, or invalid
  /// (outside of the grid, or a gap). Two active cells stand in order of their ids.
  IdVector<FaceId, std::array<HostCellId, 2>> cells;
  IdVector<FaceId, Axis> axis;
  IdVector<FaceId, std::uint8_t> is_fault;  ///< 1: a part of a cell's face, cut along a split pillar pair
  IdVector<FaceId, std::uint8_t> is_pinch;  ///< 1: the two cells are neighbours across zero-thickness cells
  /// m3, NEWTRAN without multipliers (host_transmissibility.h); 0 with one active cell. Empty without permeability.
  IdVector<FaceId, double> transmissibility;

  /// Once the mesh has them: 130 bytes for each cell of a large grid.
  void forget_loops() {
    vertex_start = LargeArray<std::int64_t>{0};
    vertices = LargeArray<VertexId>{};
  }
  [[nodiscard]] std::size_t size() const { return cells.size(); }
  [[nodiscard]] std::span<const VertexId> loop(FaceId face) const {
    const auto begin = static_cast<std::size_t>(vertex_start[face.index()]);
    return {vertices.data() + begin, static_cast<std::size_t>(vertex_start[face.index() + 1]) - begin};
  }
};

/// Where a part of a source cell lies in it: lowest and highest (u, v, w) of its trilinear map (cell_locator.h).
struct PieceBox {
  std::array<double, 3> low{};
  std::array<double, 3> high{};
};

/// Cells that a refinement made (host_refinement.h). Their ids follow those of the source cells.
struct RefinedCells {
  std::vector<HostCellId> parent;  ///< source cell with the largest part in it
  /// Corner (di, dj, dk) at di + 2 dj + 4 dk, dk 0 the upper one, whichever way the source numbers its layers.
  std::vector<std::array<VertexId, 8>> corners;
  std::vector<std::int64_t> piece_start{0};  ///< size()+1 offsets: parts of source cells in each refined cell
  std::vector<HostCellId> piece_source;
  std::vector<double> piece_fraction;    ///< of the source cell's volume; those of one source cell add up to 1
  std::vector<PieceBox> piece_box;       ///< place in the source cell
  std::vector<std::uint8_t> is_refined;  ///< per source cell: 1 replaced by refined ones; empty: none is

  [[nodiscard]] std::size_t size() const { return parent.size(); }
};

struct HostMesh {
  IdVector<VertexId, Vec3> vertices;  ///< pillar by pillar, then crossings
  HostCorners corners;                ///< of all source cells, inactive ones too
  HostFaces faces;
  IdVector<HostCellId, double> volume;        ///< m3, positive: eight corners with bilinear faces; all cells
  IdVector<HostCellId, double> pore_volume;   ///< m3; see source_pore_volumes()
  IdVector<HostCellId, std::uint8_t> exists;  ///< 1: active, of positive volume and not below MINPV: a cell of the mesh
  bool left_handed = false;                   ///< i, j, k make a left-handed triple in (x, y, depth)
  RefinedCells refined;                       ///< empty before a refinement
  std::vector<std::string> notes;             ///< what was mended or looks wrong, one sentence each

  /// The source cell that a cell is, or mainly lies in.
  [[nodiscard]] HostCellId source_of(HostCellId cell) const {
    const std::int64_t sources = corners.dimensions[0] * corners.dimensions[1] * corners.dimensions[2];
    return cell.value() < sources ? cell : refined.parent[static_cast<std::size_t>(cell.value() - sources)];
  }
  [[nodiscard]] std::size_t source_count() const { return volume.size() - refined.size(); }
  /// A cell of the mesh as far as the host goes: it exists and no refined ones took its place.
  [[nodiscard]] bool is_cell(HostCellId cell) const {
    return exists[cell] != 0 && !(cell.index() < source_count() && is_refined(cell));
  }
  [[nodiscard]] bool is_refined(HostCellId source) const {
    return !refined.is_refined.empty() && refined.is_refined[source.index()] != 0;
  }

  /// What a cell has of its source cells' volumes, m3: their parts, of any size, add up to the source cell.
  [[nodiscard]] double volume_of_sources(HostCellId cell) const;

  /// Corner (di, dj, dk), each 0 or 1, of any cell.
  [[nodiscard]] VertexId corner(HostCellId cell, int di, int dj, int dk) const;
  /// All eight, (di, dj, dk) at di + 2 dj + 4 dk.
  [[nodiscard]] std::array<VertexId, 8> corners_of(HostCellId cell) const;
};

/// Corners of one pillar closer than this are one vertex, m. Decks give three decimals and EGRID files 24 bits.
inline constexpr double pillar_merge_tolerance = 1e-6;

/// True where a cell's volume, m3, is rounding: where pillars coincide it has either sign. Below 10^-12 of its
/// diagonals' cube; one micrometre of a hundred metres is 10^4 times as much.
inline bool is_rounding(double volume, const std::array<Vec3, 8>& corners) {
  const double square = (corners[7] - corners[0]).squaredNorm() + (corners[6] - corners[1]).squaredNorm();
  return volume * volume <= 1e-24 * square * square * square;
}

/// Builds the host. Throws InvalidInput where validate(grid) would, or when no active cell has a volume.
HostMesh build_host_mesh(const CornerPointGrid& grid);

}  // namespace wellknit
