// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Host, transition and radial cells knitted into one watertight mesh (method.md §0 step 8): vertices, faces, cells and
/// their geometry.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithm/host_mesh.h"
#include "algorithm/transition_mesh.h"
#include "model/mesh.h"

namespace wellknit {

/// What a face is to the flow through it.
enum class FaceRole : std::uint8_t {
  host,     ///< a corner-point face; also between a host and a transition cell
  general,  ///< between two transition cells
  ring,     ///< between two rings of a tube, or the bore's wall
  lateral,  ///< between the outermost ring and a transition cell
  sector,   ///< between two sectors of a ring
  axial     ///< between two segments, and at the caps
};

struct FaceInfo {
  FaceRole role = FaceRole::general;
  Axis axis = Axis::i;               ///< role host
  std::uint8_t is_fault = 0;         ///< role host
  std::uint8_t is_pinch = 0;         ///< role host
  FaceId host_face;                  ///< role host between two host cells: the host mesh's face
  std::int32_t circle = -1;          ///< roles ring, lateral: circle of the radial mesh, bore 0
  std::array<HostCellId, 2> host{};  ///< role host: the source cells on the sides of cells[0] and cells[1]; a removed
                                     ///< one on the side of a transition cell; that of a refined cell is its parent
};

/// A tube and the ids of its cells: first_cell + (segment * sectors + sector) * rings + ring.
struct PlacedTube {
  const Tube* tube = nullptr;
  CellId first_cell;

  [[nodiscard]] CellId cell(int segment, int sector, int ring) const {
    const RadialMesh& m = tube->real;
    const int wrapped = (sector % m.sectors + m.sectors) % m.sectors;
    return CellId(first_cell.value() + (static_cast<std::int64_t>(segment) * m.sectors + wrapped) * m.rings + ring);
  }
};

/// Host cells whose faces enclose another volume than their corners do: cut faces between pillars that lean.
struct VolumeMismatch {
  static constexpr double limit = 0.05;  ///< relative; as the mesh check has it
  std::int64_t count = 0;                ///< beyond the limit
  double worst = 0.0;                    ///< relative
  CellId cell;                           ///< the worst
};

struct Assembly {
  Mesh mesh;  ///< geometry only: no properties, connections, transfer
  VolumeMismatch volume_mismatch;
  std::vector<CellId> unsound_cells;  ///< that do not close, or made ones without positive volume; only beside cavities
  IdVector<FaceId, FaceInfo> face_info;
  IdVector<HostCellId, CellId> cell_of;             ///< mesh cell of each host cell that stayed; invalid for the others
  std::vector<HostCellId> host_cell;                ///< of each mesh cell of kinds host and refined, which come first
  std::vector<PlacedTube> tubes;                    ///< in the order of the cavities and their tubes
  std::vector<std::int64_t> first_transition_cell;  ///< per cavity
  std::vector<std::size_t> first_tube;              ///< cavities + 1 offsets into tubes
  /// Of each made cell, from the first transition cell on: directions of its three permeabilities as orthonormal
  /// columns (rock_tensor.h). Empty: x, y, depth.
  std::vector<Eigen::Matrix3d> rock_axes;
};

/// Cells are numbered: host cells in the source's order, refined cells, transition cells by cavity, radial cells by
/// tube. `cavities` must be bound to the host and outlive the result. Where a face of a cavity meets other cells of the
/// host than one with the same four corners, the host's faces stand in its place.
Assembly assemble(const CornerPointGrid& grid, const HostMesh& host, const std::vector<TransitionMesh>& cavities);

}  // namespace wellknit
