// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What the host has where the cavities' boundary faces stand: one face with the same four corners, or several along a
/// fault, beside other layers, or with more vertices on their edges.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_set>
#include <utility>
#include <vector>

#include "algorithm/host_mesh.h"
#include "algorithm/transition_mesh.h"

namespace wellknit {

/// The host's faces in the place of one boundary face.
struct CavityWall {
  HostCellId removed;
  Axis axis = Axis::i;
  std::vector<FaceId> faces;
  bool is_plain = false;  ///< one face with the boundary face's corners alone
};

struct CavityWalls {
  std::vector<std::map<std::size_t, CavityWall>> walls;  ///< per cavity, by its boundary faces
  std::unordered_set<std::int64_t> faces;                ///< the host's faces that belong to some wall or are gone
  /// Faces of two cavities' walls, one on each side of a fault: cavity and boundary face of cells[0] and of cells[1].
  std::map<FaceId, std::array<std::pair<std::size_t, std::size_t>, 2>> shared;
  /// Vertices of the host between the two ends of an edge, in order from the smaller id.
  std::map<std::pair<VertexId, VertexId>, std::vector<VertexId>> edges;

  [[nodiscard]] bool has(FaceId face) const { return faces.contains(face.value()); }
  [[nodiscard]] const CavityWall* find(std::size_t cavity, std::size_t boundary_face) const {
    const auto found = walls[cavity].find(boundary_face);
    return found == walls[cavity].end() ? nullptr : &found->second;
  }
  /// Vertices of the host on the edge from a to b, without these; invalid ends have none.
  [[nodiscard]] std::vector<VertexId> between(VertexId a, VertexId b) const;
};

/// `is_removed` has an element for each cell of the host.
CavityWalls find_cavity_walls(const HostMesh& host, const std::vector<TransitionMesh>& cavities,
                              const IdVector<HostCellId, std::uint8_t>& is_removed);

/// What is left of an outline when the polygons in it are taken away, as loops of the same sense.
class LoopRemainder {
 public:
  void add(std::span<const VertexId> outline);
  void remove(std::span<const VertexId> polygon);
  [[nodiscard]] std::vector<std::vector<VertexId>> loops() const;

 private:
  void add_edge(VertexId from, VertexId to);

  std::map<VertexId, std::vector<VertexId>> next_;  ///< ends of the edges from each vertex
};

}  // namespace wellknit
