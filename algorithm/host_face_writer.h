// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The host's faces as they are written: their loops, cells and transmissibilities.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algorithm/host_mesh.h"

namespace wellknit {

/// What a cell is to the faces: one that exists, an inactive one, or nothing, as an active one without a volume.
enum class HostCellState : std::uint8_t { none = 0, exists = 1, inactive = 2 };

/// A cell beside a face.
struct FaceCell {
  HostCellId id;
  HostCellState state = HostCellState::none;
  const std::array<Vec3, 3>* conductance = nullptr;  ///< by axis; null without permeability
};

/// The cells of one column, from the uppermost downwards; the arrays have nz elements.
struct HostColumn {
  std::int64_t first_cell = 0;  ///< id of the uppermost cell
  std::int64_t cell_step = 0;   ///< to the id of the cell below
  const HostCellState* state = nullptr;
  const std::array<Vec3, 3>* conductance = nullptr;

  [[nodiscard]] FaceCell cell(std::int64_t place) const {
    return {HostCellId(first_cell + place * cell_step), state[place],
            conductance == nullptr ? nullptr : conductance + place};
  }
};

/// Throws InvalidInput when the faces are too many to be numbered.
void append_faces(HostFaces& all, const HostFaces& more);

/// Closes loops that were pushed: turns them, orders the two cells, and fills the other arrays.
class HostFaceWriter {
 public:
  /// `mirrored`: i, j, depth make a left-handed triple. `vertices` are all of the mesh's, crossings too.
  HostFaceWriter(HostFaces& faces, const IdVector<VertexId, Vec3>& vertices, bool mirrored)
      : faces_(faces), vertices_(vertices), mirrored_(mirrored) {}

  void push(VertexId vertex) { faces_.vertices.push_back(vertex); }
  /// The vertices pushed since the last close() are a face with its normal, where not mirrored, from `from` to `to`.
  /// One that no existing cell has or with fewer than three vertices is dropped. Its area is that of the loop.
  void close(const FaceCell& from, const FaceCell& to, Axis axis, bool is_fault, bool is_pinch);
  /// The same for a top or base, whose area is that of its four corners alone (host_face_area_vector()).
  void close_horizon(const FaceCell& from, const FaceCell& to, const std::array<VertexId, 4>& corners, bool is_pinch);

 private:
  [[nodiscard]] bool drop_if_empty(const FaceCell& from, const FaceCell& to);
  [[nodiscard]] Vec3 loop_area() const;
  void add(FaceCell from, FaceCell to, Axis axis, bool is_fault, bool is_pinch, const Vec3& area);

  HostFaces& faces_;
  const IdVector<VertexId, Vec3>& vertices_;
  bool mirrored_;
};

}  // namespace wellknit
