// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/cavity_walls.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace wellknit {

namespace {

/// A side of a host cell: 2 axis, and 1 more on the axis' high side.
using CellSide = std::pair<HostCellId, int>;

std::array<Vec3, 8> points_of(const HostMesh& host, HostCellId cell) {
  const auto corners = host.corners_of(cell);
  std::array<Vec3, 8> points;
  for (std::size_t n = 0; n < 8; ++n) points[n] = host.vertices[corners[n]];
  return points;
}

/// The corners on one side of a cell, rising ids.
std::array<VertexId, 4> side_corners(const std::array<VertexId, 8>& corners, int side) {
  std::array<VertexId, 4> out;
  std::size_t count = 0;
  for (std::size_t n = 0; n < 8; ++n)
    if (static_cast<int>((n >> (side / 2)) & 1U) == side % 2) out[count++] = corners[n];
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<VertexId> sorted(std::span<const VertexId> loop) {
  std::vector<VertexId> out(loop.begin(), loop.end());
  std::sort(out.begin(), out.end());
  return out;
}

class WallFinder {
 public:
  WallFinder(const HostMesh& host, const std::vector<TransitionMesh>& cavities,
             const IdVector<HostCellId, std::uint8_t>& is_removed)
      : host_(host), cavities_(cavities), is_removed_(is_removed) {}

  CavityWalls find() {
    out_.walls.resize(cavities_.size());
    for (std::size_t c = 0; c < cavities_.size(); ++c) name_sides(c);
    for (std::size_t f = 0; f < host_.faces.size(); ++f) sort_in(FaceId(f));
    for (std::size_t c = 0; c < cavities_.size(); ++c)
      for (auto& [number, wall] : out_.walls[c]) {
        const auto loop = outline(c, number);
        wall.is_plain = wall.faces.size() == 1 && !out_.shared.contains(wall.faces.front()) &&
                        sorted(host_.faces.loop(wall.faces.front())) == sorted(loop);
        if (wall.is_plain) continue;
        if (host_.exists[wall.removed] != 0 || wall.axis == Axis::k)
          divide(wall, loop);
        else
          note_straight(wall, loop);
      }
    take_straight();
    return std::move(out_);
  }

 private:
  /// A boundary face's corners in the host.
  [[nodiscard]] std::vector<VertexId> outline(std::size_t cavity, std::size_t number) const {
    const Cavity& from = cavities_[cavity].cavity;
    std::vector<VertexId> out;
    for (const std::int32_t v : from.faces[number].loop) out.push_back(from.vertices[static_cast<std::size_t>(v)].host);
    return out;
  }

  void name_sides(std::size_t cavity) {
    const auto& faces = cavities_[cavity].cavity.faces;
    for (std::size_t number = 0; number < faces.size(); ++number) {
      if (faces[number].kind != BoundaryFaceKind::host) continue;
      const auto wanted = sorted(outline(cavity, number));
      const auto corners = host_.corners_of(faces[number].removed_cell);
      for (int side = 0; side < 6; ++side) {
        const auto on_side = side_corners(corners, side);
        if (std::equal(wanted.begin(), wanted.end(), on_side.begin(), on_side.end()))
          side_of_.insert({{faces[number].removed_cell, side}, {cavity, number}});
      }
    }
  }

  void sort_in(FaceId face) {
    const auto [a, b] = host_.faces.cells[face];
    const bool first = is_removed_[a] != 0;
    const bool second = b.is_valid() && is_removed_[b] != 0;
    if (!first && !second) return;
    if (first && second) {
      const auto one = side_of_.find({a, side_at(a, face, true)});
      const auto two = side_of_.find({b, side_at(b, face, false)});
      if (one != side_of_.end() && two != side_of_.end()) {
        add_to(one->second, a, face);
        add_to(two->second, b, face);
        out_.shared[face] = {one->second, two->second};
      }
    } else {
      const HostCellId removed = first ? a : b;
      const auto found = side_of_.find({removed, side_at(removed, face, first)});
      if (found != side_of_.end())
        add_to(found->second, removed, face);
      else if (const HostCellId other = first ? b : a; other.is_valid() && host_.is_cell(other))
        return;  // stays, as an outer face
    }
    out_.faces.insert(face.value());
  }

  void add_to(const std::pair<std::size_t, std::size_t>& place, HostCellId removed, FaceId face) {
    CavityWall& wall = out_.walls[place.first][place.second];
    wall.removed = removed;
    wall.axis = host_.faces.axis[face];
    wall.faces.push_back(face);
  }

  /// The side of a cell that a face is on; `outward`: the face's normal points out of the cell.
  [[nodiscard]] int side_at(HostCellId cell, FaceId face, bool outward) const {
    const int axis = static_cast<int>(host_.faces.axis[face]);
    const auto corners = host_.corners_of(cell);
    for (const VertexId v : host_.faces.loop(face))
      if (const auto at = std::find(corners.begin(), corners.end(), v); at != corners.end())
        return 2 * axis + static_cast<int>(((at - corners.begin()) >> axis) & 1);
    if (axis < 2)
      for (const VertexId v : host_.faces.loop(face))
        if (const auto pillar = pillar_of(corners, v)) return 2 * axis + ((*pillar >> axis) & 1);
    const auto cells = host_.faces.cells[face];
    if (const HostCellId other = cells[outward ? 1 : 0]; other.is_valid() && axis < 2)
      return 2 * axis + (low_of(cell, axis) < low_of(other, axis) ? 1 : 0);
    return side_by_normal(cell, face, outward);
  }

  /// The pillar, di + 2 dj, of a cell that a node between its top and base lies on. The nodes of a pillar that came
  /// with the host have consecutive ids, and so have those that came with a refinement.
  [[nodiscard]] std::optional<int> pillar_of(const std::array<VertexId, 8>& corners, VertexId node) const {
    const VertexId end = host_.corners.nodes_on(host_.corners.first.size() - 1)[1];
    for (std::size_t n = 0; n < 4; ++n) {
      const auto [low, high] = std::minmax(corners[n], corners[n + 4]);
      if ((low < end) == (high < end) && low < node && node < high) return static_cast<int>(n);
    }
    return std::nullopt;
  }

  /// Where a cell begins along i or j, in source columns.
  [[nodiscard]] double low_of(HostCellId cell, int axis) const {
    const std::int64_t source = host_.source_of(cell).value();
    const std::int64_t nx = host_.corners.dimensions[0];
    const auto column = static_cast<double>(axis == 0 ? source % nx : source / nx % host_.corners.dimensions[1]);
    if (cell.index() < host_.source_count()) return column;
    const std::size_t number = cell.index() - host_.source_count();
    const auto first = static_cast<std::size_t>(host_.refined.piece_start[number]);
    if (first == static_cast<std::size_t>(host_.refined.piece_start[number + 1])) return column;
    return column + host_.refined.piece_box[first].low[static_cast<std::size_t>(axis)];
  }

  /// A face amid a side, with nothing on its other side.
  [[nodiscard]] int side_by_normal(HostCellId cell, FaceId face, bool outward) const {
    const auto axis = static_cast<std::size_t>(host_.faces.axis[face]);
    const auto points = points_of(host_, cell);
    Vec3 along = Vec3::Zero();
    for (std::size_t n = 0; n < 8; ++n) along += ((n >> axis) & 1U) != 0 ? points[n] : Vec3(-points[n]);
    Vec3 doubled = Vec3::Zero();
    const auto loop = host_.faces.loop(face);
    const Vec3& origin = host_.vertices[loop[0]];
    for (std::size_t n = 1; n + 1 < loop.size(); ++n)
      doubled += (host_.vertices[loop[n]] - origin).cross(host_.vertices[loop[n + 1]] - origin);
    const bool high = (outward ? 1.0 : -1.0) * along.dot(doubled) > 0.0;
    return 2 * static_cast<int>(axis) + (high ? 1 : 0);
  }

  /// Vertices on the edges of a boundary face: the outline of all its polygons, from corner to corner.
  void divide(const CavityWall& wall, const std::vector<VertexId>& corners) {
    LoopRemainder together;
    for (const FaceId f : wall.faces) {
      const auto loop = host_.faces.loop(f);
      const bool outward = host_.faces.cells[f][0] == wall.removed;
      std::vector<VertexId> inward(loop.begin(), loop.end());
      if (outward) std::reverse(inward.begin(), inward.end());
      together.add(inward);
    }
    for (const auto& loop : together.loops()) divide_along(loop, corners);
  }

  void divide_along(const std::vector<VertexId>& loop, const std::vector<VertexId>& corners) {
    const auto corner = [&](VertexId v) { return std::find(corners.begin(), corners.end(), v); };
    for (std::size_t n = 0; n < loop.size(); ++n) {
      const auto from = corner(loop[n]);
      if (from == corners.end()) continue;
      std::vector<VertexId> between;
      std::size_t m = n + 1;
      for (; m < n + loop.size() && corner(loop[m % loop.size()]) == corners.end(); ++m)
        between.push_back(loop[m % loop.size()]);
      const auto to = corner(loop[m % loop.size()]);
      const auto apart = static_cast<std::size_t>(std::abs(to - from));
      const bool are_neighbors = apart == 1 || apart + 1 == corners.size();
      if (between.empty() || to == corners.end() || !are_neighbors) continue;
      if (*to < *from) std::reverse(between.begin(), between.end());
      out_.edges[std::minmax(*from, *to)] = std::move(between);
    }
  }

  /// Of an inactive cell's side a part may have no face at all, and what runs from corner to corner need not be the
  /// edge: vertices on the straight line are.
  void note_straight(const CavityWall& wall, const std::vector<VertexId>& corners) {
    for (std::size_t n = 0; n < corners.size(); ++n) {
      const auto [from, to] = std::minmax(corners[n], corners[(n + 1) % corners.size()]);
      for (const FaceId f : wall.faces)
        for (const VertexId v : host_.faces.loop(f))
          if (const auto at = place_on(from, to, v)) straight_[{from, to}][*at] = v;
    }
  }

  void take_straight() {
    for (const auto& [edge, vertices] : straight_) {
      const auto [entry, is_new] = out_.edges.try_emplace(edge);
      if (!is_new) continue;
      for (const auto& [at, v] : vertices) entry->second.push_back(v);
    }
  }

  /// Place, between 0 and 1, of a vertex on the straight line between two others.
  [[nodiscard]] std::optional<double> place_on(VertexId from, VertexId to, VertexId vertex) const {
    const Vec3 along = host_.vertices[to] - host_.vertices[from];
    const Vec3 way = host_.vertices[vertex] - host_.vertices[from];
    const double at = way.dot(along) / along.squaredNorm();
    constexpr double accuracy = 1e-6;  // of the edge's length: rounding of coordinates
    const bool is_on =
        vertex != from && vertex != to && at > 0.0 && at < 1.0 && (way - at * along).norm() <= accuracy * along.norm();
    return is_on ? std::optional(at) : std::nullopt;
  }

  const HostMesh& host_;
  const std::vector<TransitionMesh>& cavities_;
  const IdVector<HostCellId, std::uint8_t>& is_removed_;
  std::map<CellSide, std::pair<std::size_t, std::size_t>> side_of_;  ///< cavity and its boundary face
  std::map<std::pair<VertexId, VertexId>, std::map<double, VertexId>> straight_;
  CavityWalls out_;
};

}  // namespace

std::vector<VertexId> CavityWalls::between(VertexId a, VertexId b) const {
  if (!a.is_valid() || !b.is_valid()) return {};
  const auto found = edges.find(std::minmax(a, b));
  if (found == edges.end()) return {};
  std::vector<VertexId> out = found->second;
  if (b < a) std::reverse(out.begin(), out.end());
  return out;
}

CavityWalls find_cavity_walls(const HostMesh& host, const std::vector<TransitionMesh>& cavities,
                              const IdVector<HostCellId, std::uint8_t>& is_removed) {
  CavityWalls out;
  if (cavities.empty()) return out;
  return WallFinder(host, cavities, is_removed).find();
}

void LoopRemainder::add_edge(VertexId from, VertexId to) {
  // Two edges in opposite senses are none.
  if (const auto found = next_.find(to); found != next_.end()) {
    auto& ends = found->second;
    if (const auto back = std::find(ends.begin(), ends.end(), from); back != ends.end()) {
      ends.erase(back);
      if (ends.empty()) next_.erase(found);
      return;
    }
  }
  next_[from].push_back(to);
}

void LoopRemainder::add(std::span<const VertexId> outline) {
  for (std::size_t n = 0; n < outline.size(); ++n) add_edge(outline[n], outline[(n + 1) % outline.size()]);
}

void LoopRemainder::remove(std::span<const VertexId> polygon) {
  for (std::size_t n = 0; n < polygon.size(); ++n) add_edge(polygon[(n + 1) % polygon.size()], polygon[n]);
}

std::vector<std::vector<VertexId>> LoopRemainder::loops() const {
  auto next = next_;
  std::vector<std::vector<VertexId>> out;
  while (!next.empty()) {
    std::vector<VertexId> path;
    VertexId at = next.begin()->first;
    // Where the path comes back to itself a loop is complete.
    for (;;) {
      if (const auto again = std::find(path.begin(), path.end(), at); again != path.end()) {
        out.emplace_back(again, path.end());
        path.erase(again, path.end());
        if (path.empty() && !next.contains(at)) break;
      }
      const auto found = next.find(at);
      if (found == next.end()) break;
      path.push_back(at);
      at = found->second.back();
      found->second.pop_back();
      if (found->second.empty()) next.erase(found);
    }
  }
  return out;
}

}  // namespace wellknit
