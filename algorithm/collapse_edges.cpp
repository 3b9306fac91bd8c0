// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Edge contraction in a polyhedral complex. What keeps a cell a sphere: two vertices of it become one only where it has
// the edge between them, the faces that have both have that edge, and afterwards each edge is in two of its faces (the
// link condition of key Dey1999, asked of each cell by counting).

#include "algorithm/collapse_edges.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "algorithm/assembly.h"

namespace wellknit {

namespace {

bool is_transition(const Mesh& mesh, CellId cell) {
  return cell.is_valid() && mesh.cells.kind[cell] == CellKind::transition;
}

/// What a face is to the two-point flux and to the cells beside it.
struct FaceShape {
  double angle = 0.0;      ///< radians, normal to line of centres
  double planarity = 0.0;  ///< largest height over the plane, over the root of the area
  double thinnest = 0.0;   ///< least volume of a tetrahedron between a centre and the face's fan, where one is negative
  double height = 0.0;     ///< least distance of a centre behind the face, over the size of its cell
};

class EdgeCollapser {
 public:
  EdgeCollapser(Assembly& assembly, const std::vector<CellId>& kept, const CollapseLimits& limits)
      : assembly_(assembly), mesh_(assembly.mesh), limits_(limits) {
    read_faces();
    fix_vertices(kept);
  }

  EdgeCollapse run() {
    EdgeCollapse out;
    for (std::size_t v = 0; v < points_.size(); ++v) add_edges_of(static_cast<int>(v));
    std::tie(out.short_before, out.shortest_before) = short_edges();
    std::tie(out.short_after, out.shortest_after) = std::tie(out.short_before, out.shortest_before);
    while (!queue_.empty()) {
      const auto [ratio, u, v] = *queue_.begin();
      queue_.erase(queue_.begin());
      if (collapse(u, v)) ++out.edges_removed;
    }
    if (out.edges_removed == 0) return out;
    out.faces_removed = std::count_if(faces_.begin(), faces_.end(), [](const Face& f) { return f.loop.empty(); });
    std::tie(out.short_after, out.shortest_after) = short_edges();
    write();
    return out;
  }

 private:
  struct Face {
    FaceId id;
    std::vector<int> loop;                ///< empty: it is gone
    std::array<int, 2> cell{-1, -1};      ///< transition cells; -1 another one or none
    std::array<const Vec3*, 2> center{};  ///< of whatever cell; null: none
  };
  struct Cell {
    CellId id;
    double volume = 0.0;
    double size = 0.0;
    std::vector<int> faces;
  };
  /// A face as it would be.
  struct NewLoop {
    int face = 0;
    std::vector<int> loop;  ///< empty: it goes
    FaceShape before;
  };
  using Edge = std::pair<int, int>;

  void read_faces() {
    std::unordered_map<std::int64_t, int> vertex_at;
    std::unordered_map<std::int64_t, int> cell_at;
    for (std::size_t n = 0; n < mesh_.faces.size(); ++n) {
      const FaceId id(n);
      const auto cells = mesh_.faces.cells[id];
      if (!is_transition(mesh_, cells[0]) && !is_transition(mesh_, cells[1])) continue;
      Face face;
      face.id = id;
      for (const VertexId v : mesh_.faces.loop(id)) {
        const auto [at, is_new] = vertex_at.try_emplace(v.value(), static_cast<int>(points_.size()));
        if (is_new) {
          points_.push_back(mesh_.vertices[v]);
          vertex_.push_back(v);
          faces_at_.emplace_back();
        }
        face.loop.push_back(at->second);
        faces_at_[static_cast<std::size_t>(at->second)].push_back(static_cast<int>(faces_.size()));
      }
      for (std::size_t side = 0; side < 2; ++side) {
        if (!cells[side].is_valid()) continue;
        face.center[side] = &mesh_.cells.center[cells[side]];
        if (!is_transition(mesh_, cells[side])) continue;
        const auto [at, is_new] = cell_at.try_emplace(cells[side].value(), static_cast<int>(cells_.size()));
        const double volume = std::abs(mesh_.cells.volume[cells[side]]);
        if (is_new) cells_.push_back({cells[side], volume, std::cbrt(volume), {}});
        face.cell[side] = at->second;
        cells_[static_cast<std::size_t>(at->second)].faces.push_back(static_cast<int>(faces_.size()));
      }
      faces_.push_back(std::move(face));
    }
  }

  void fix_vertices(const std::vector<CellId>& kept) {
    is_free_.assign(points_.size(), 1);
    for (const Face& face : faces_) {
      const bool is_inner = std::all_of(face.cell.begin(), face.cell.end(), [&](int c) {
        return c >= 0 && !std::binary_search(kept.begin(), kept.end(), cells_[static_cast<std::size_t>(c)].id);
      });
      if (is_inner) continue;
      for (const int v : face.loop) is_free_[static_cast<std::size_t>(v)] = 0;
    }
  }

  [[nodiscard]] const Face& face(int f) const { return faces_[static_cast<std::size_t>(f)]; }
  [[nodiscard]] const Vec3& point(int v) const { return points_[static_cast<std::size_t>(v)]; }
  [[nodiscard]] bool is_free(int v) const { return is_free_[static_cast<std::size_t>(v)] != 0; }
  [[nodiscard]] const std::vector<int>& faces_at(int v) const { return faces_at_[static_cast<std::size_t>(v)]; }

  /// Sizes of the smallest and the largest cell at an edge.
  [[nodiscard]] std::array<double, 2> sizes_at(int u, int v) const {
    std::array<double, 2> out{std::numeric_limits<double>::infinity(), 0.0};
    for (const int f : faces_at(u)) {
      if (!has_edge(face(f).loop, u, v)) continue;
      for (const int c : face(f).cell) {
        if (c < 0) continue;
        const double size = cells_[static_cast<std::size_t>(c)].size;
        out = {std::min(out[0], size), std::max(out[1], size)};
      }
    }
    return out;
  }

  [[nodiscard]] double ratio(int u, int v) const {
    const double size = sizes_at(u, v)[1];
    return size > 0.0 ? (point(u) - point(v)).norm() / size : std::numeric_limits<double>::infinity();
  }

  static bool has_edge(const std::vector<int>& loop, int u, int v) {
    for (std::size_t n = 0; n < loop.size(); ++n) {
      const int a = loop[n];
      const int b = loop[(n + 1) % loop.size()];
      if ((a == u && b == v) || (a == v && b == u)) return true;
    }
    return false;
  }

  [[nodiscard]] std::vector<int> neighbors(int v) const {
    std::vector<int> out;
    for (const int f : faces_at(v)) {
      const auto& loop = face(f).loop;
      const auto at = static_cast<std::size_t>(std::find(loop.begin(), loop.end(), v) - loop.begin());
      out.push_back(loop[(at + 1) % loop.size()]);
      out.push_back(loop[(at + loop.size() - 1) % loop.size()]);
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  void add_edges_of(int v) {
    for (const int other : neighbors(v)) {
      if (!is_free(v) && !is_free(other)) continue;
      const double length = ratio(v, other);
      if (length < limits_.length) queue_.insert({length, std::min(v, other), std::max(v, other)});
    }
  }

  void drop_edges_of(int v) {
    for (const int other : neighbors(v)) queue_.erase({ratio(v, other), std::min(v, other), std::max(v, other)});
  }

  [[nodiscard]] std::pair<std::int64_t, double> short_edges() const {
    std::int64_t count = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t v = 0; v < points_.size(); ++v)
      for (const int other : neighbors(static_cast<int>(v))) {
        if (other < static_cast<int>(v)) continue;
        const double length = (points_[v] - point(other)).norm() / sizes_at(static_cast<int>(v), other)[0];
        shortest = std::min(shortest, length);
        if (length < EdgeCollapse::short_edge) ++count;
      }
    return {count, shortest};
  }

  /// The faces of u and v when v becomes u; nothing where a face has both without the edge between them.
  [[nodiscard]] std::optional<std::vector<NewLoop>> loops_without(int u, int v) const {
    std::vector<int> around = faces_at(u);
    around.insert(around.end(), faces_at(v).begin(), faces_at(v).end());
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    std::vector<NewLoop> out;
    for (const int f : around) {
      const auto& loop = face(f).loop;
      const bool has_both =
          std::find(loop.begin(), loop.end(), u) != loop.end() && std::find(loop.begin(), loop.end(), v) != loop.end();
      if (has_both && !has_edge(loop, u, v)) return std::nullopt;
      NewLoop next{f, {}, {}};
      for (const int w : loop)
        if (!(has_both && w == v)) next.loop.push_back(w == v ? u : w);
      if (next.loop.size() < 3) next.loop.clear();
      // A face towards another cell cannot go: that cell has it too.
      if (next.loop.empty() && (face(f).cell[0] < 0 || face(f).cell[1] < 0)) return std::nullopt;
      out.push_back(std::move(next));
    }
    return out;
  }

  [[nodiscard]] std::vector<int> cells_of(const std::vector<NewLoop>& loops) const {
    std::vector<int> out;
    for (const NewLoop& next : loops)
      for (const int c : face(next.face).cell)
        if (c >= 0) out.push_back(c);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  static const std::vector<int>* changed(const std::vector<NewLoop>& loops, int f) {
    const auto at = std::lower_bound(loops.begin(), loops.end(), f, [](const NewLoop& l, int n) { return l.face < n; });
    return at != loops.end() && at->face == f ? &at->loop : nullptr;
  }

  /// Whether a cell is a closed surface without the edge. Only edges at u change.
  [[nodiscard]] bool stays_closed(int cell, int u, int v, const std::vector<NewLoop>& loops) {
    bool has_u = false;
    bool has_v = false;
    int on_edge = 0;
    int count = 0;
    edges_.clear();
    for (const int f : cells_[static_cast<std::size_t>(cell)].faces) {
      const auto& old = face(f).loop;
      if (old.empty()) continue;
      has_u = has_u || std::find(old.begin(), old.end(), u) != old.end();
      has_v = has_v || std::find(old.begin(), old.end(), v) != old.end();
      on_edge += has_edge(old, u, v) ? 1 : 0;
      const auto* const next = changed(loops, f);
      const auto& loop = next == nullptr ? old : *next;
      if (loop.empty()) continue;
      ++count;
      const bool is_first = face(f).cell[0] == cell;
      for (std::size_t n = 0; n < loop.size(); ++n) {
        const Edge edge{loop[n], loop[(n + 1) % loop.size()]};
        if (edge.first != u && edge.second != u) continue;
        edges_.push_back(is_first ? edge : Edge{edge.second, edge.first});
      }
    }
    if (count < 4 || (has_u && has_v && on_edge != 2)) return false;
    std::sort(edges_.begin(), edges_.end());
    for (std::size_t n = 0; n < edges_.size(); ++n) {
      if (n > 0 && edges_[n] == edges_[n - 1]) return false;
      if (!std::binary_search(edges_.begin(), edges_.end(), Edge{edges_[n].second, edges_[n].first})) return false;
    }
    return true;
  }

  /// A face whose vertex `moved` is at another place.
  [[nodiscard]] FaceShape shape_of(const Face& of, const std::vector<int>& loop, int moved, const Vec3& place) const {
    const auto corner = [&](std::size_t n) -> const Vec3& {
      const int v = loop[n % loop.size()];
      return v == moved ? place : point(v);
    };
    Vec3 middle = Vec3::Zero();
    for (std::size_t n = 0; n < loop.size(); ++n) middle += corner(n);
    middle /= static_cast<double>(loop.size());
    Vec3 area = Vec3::Zero();
    FaceShape out;
    for (std::size_t n = 0; n < loop.size(); ++n) {
      const Vec3 triangle = 0.5 * (corner(n) - middle).cross(corner(n + 1) - middle);
      area += triangle;
      for (std::size_t side = 0; side < 2; ++side)
        if (of.cell[side] >= 0)
          out.thinnest = std::min(out.thinnest, (side == 0 ? 1.0 : -1.0) * triangle.dot(middle - *of.center[side]) /
                                                    cells_[static_cast<std::size_t>(of.cell[side])].volume);
    }
    const double size = area.norm();
    out.height = size > 0.0 ? std::numeric_limits<double>::infinity() : -1.0;
    for (std::size_t side = 0; side < 2 && size > 0.0; ++side)
      if (of.cell[side] >= 0)
        out.height = std::min(out.height, (side == 0 ? 1.0 : -1.0) * area.dot(middle - *of.center[side]) /
                                              (size * cells_[static_cast<std::size_t>(of.cell[side])].size));
    for (std::size_t n = 0; n < loop.size() && size > 0.0; ++n)
      out.planarity = std::max(out.planarity, std::abs(area.dot(corner(n) - middle)) / (size * std::sqrt(size)));
    if (of.center[0] != nullptr && of.center[1] != nullptr) {
      const Vec3 line = *of.center[1] - *of.center[0];
      out.angle = std::atan2(area.cross(line).norm(), area.dot(line));
    }
    return out;
  }

  /// Sum of squared angles and heights over the planes when the one vertex is at a place; nothing where a limit
  /// forbids.
  [[nodiscard]] std::optional<double> cost(const std::vector<NewLoop>& loops, int u, const Vec3& place) const {
    const double most = limits_.angle * std::numbers::pi / 180.0;
    double sum = 0.0;
    for (const NewLoop& next : loops) {
      if (next.loop.empty()) continue;
      const Face& of = face(next.face);
      const FaceShape& before = next.before;
      const FaceShape after = shape_of(of, next.loop, u, place);
      if (!(after.height >= std::min(limits_.height, limits_.kept_height * before.height)) || !(after.height > 0.0))
        return std::nullopt;
      if (after.thinnest < before.thinnest) return std::nullopt;
      if (after.angle > std::max(most, before.angle)) return std::nullopt;
      if (after.planarity > std::max(limits_.planarity, before.planarity)) return std::nullopt;
      sum += after.angle * after.angle + after.planarity * after.planarity;
    }
    return sum;
  }

  /// The point nearest to the planes of the faces that stay, in the sum of squares (key Garland1997);
  /// about the middle of the edge where they leave it free.
  [[nodiscard]] Vec3 near_planes(const std::vector<NewLoop>& loops, int u, int v) const {
    const Vec3 middle = 0.5 * (point(u) + point(v));
    constexpr double pull = 0.01;  // to the middle, beside one for a plane
    Eigen::Matrix3d quadric = pull * Eigen::Matrix3d::Identity();
    Vec3 slope = Vec3::Zero();
    for (const NewLoop& next : loops) {
      if (next.loop.empty()) continue;
      const auto& loop = face(next.face).loop;
      Vec3 center = Vec3::Zero();
      for (const int w : loop) center += point(w) - middle;
      center /= static_cast<double>(loop.size());
      Vec3 normal = Vec3::Zero();
      for (std::size_t n = 0; n < loop.size(); ++n)
        normal += (point(loop[n]) - middle - center).cross(point(loop[(n + 1) % loop.size()]) - middle - center);
      if (!(normal.norm() > 0.0)) continue;
      normal.normalize();
      quadric += normal * normal.transpose();
      slope += normal.dot(center) * normal;
    }
    const Vec3 way = quadric.ldlt().solve(slope);
    // Not far from the edge: the faces' other corners are where they are.
    const double most = (point(u) - point(v)).norm();
    return middle + (way.norm() > most ? Vec3(most / way.norm() * way) : way);
  }

  bool collapse(int u, int v) {
    if (!is_free(v)) std::swap(u, v);
    if (!is_free(v)) return false;
    auto loops = loops_without(u, v);
    if (!loops) return false;
    for (const int c : cells_of(*loops))
      if (!stays_closed(c, u, v, *loops)) return false;
    for (NewLoop& next : *loops) next.before = shape_of(face(next.face), face(next.face).loop, -1, point(u));
    std::vector<Vec3> places{point(u)};
    if (is_free(u)) places = {near_planes(*loops, u, v), 0.5 * (point(u) + point(v)), point(u), point(v)};
    std::optional<double> best;
    Vec3 best_place = point(u);
    for (const Vec3& place : places)
      if (const auto c = cost(*loops, u, place); c && (!best || *c < *best)) {
        best = c;
        best_place = place;
      }
    if (!best) return false;
    drop_edges_of(u);
    drop_edges_of(v);
    faces_at_[static_cast<std::size_t>(v)].clear();
    auto& at_u = faces_at_[static_cast<std::size_t>(u)];
    at_u.clear();
    for (const NewLoop& next : *loops) {
      if (next.loop.empty())
        for (const int w : face(next.face).loop)
          if (w != u && w != v) std::erase(faces_at_[static_cast<std::size_t>(w)], next.face);
      faces_[static_cast<std::size_t>(next.face)].loop = next.loop;
      if (!next.loop.empty()) at_u.push_back(next.face);
    }
    points_[static_cast<std::size_t>(u)] = best_place;
    add_edges_of(u);
    return true;
  }

  /// Faces and vertices that are gone leave no gap in the numbers; volumes and centroids follow.
  void write() {
    for (std::size_t v = 0; v < points_.size(); ++v) mesh_.vertices[vertex_[v]] = points_[v];
    std::vector<std::int32_t> local(mesh_.faces.size(), -1);
    for (std::size_t f = 0; f < faces_.size(); ++f) local[faces_[f].id.index()] = static_cast<std::int32_t>(f);
    IdVector<VertexId, std::uint8_t> is_used(mesh_.vertices.size(), 1);
    for (std::size_t v = 0; v < points_.size(); ++v)
      if (faces_at_[v].empty()) is_used[vertex_[v]] = 0;
    IdVector<VertexId, VertexId> number(mesh_.vertices.size());
    IdVector<VertexId, Vec3> vertices;
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v)
      if (is_used[VertexId(v)] != 0) number[VertexId(v)] = vertices.push_back(mesh_.vertices[VertexId(v)]);
    Faces faces;
    IdVector<FaceId, FaceInfo> info;
    std::vector<VertexId> loop;
    for (std::size_t n = 0; n < mesh_.faces.size(); ++n) {
      const FaceId id(n);
      loop.clear();
      if (local[n] < 0)
        for (const VertexId v : mesh_.faces.loop(id)) loop.push_back(number[v]);
      else
        for (const int v : face(local[n]).loop) loop.push_back(number[vertex_[static_cast<std::size_t>(v)]]);
      if (loop.empty()) continue;
      faces.add(loop, mesh_.faces.cells[id][0], mesh_.faces.cells[id][1]);
      info.push_back(assembly_.face_info[id]);
    }
    mesh_.vertices = std::move(vertices);
    mesh_.faces = std::move(faces);
    assembly_.face_info = std::move(info);
    for (const Cell& cell : cells_) measure(cell);
  }

  void measure(const Cell& cell) {
    const Vec3 center = mesh_.cells.center[cell.id];
    double volume = 0.0;
    Vec3 moment = Vec3::Zero();
    for (const int f : cell.faces) {
      const auto& loop = face(f).loop;
      if (loop.empty()) continue;
      Vec3 middle = Vec3::Zero();
      for (const int v : loop) middle += point(v) - center;
      middle /= static_cast<double>(loop.size());
      const double sign = mesh_cell_is_first(f, cell) ? 1.0 : -1.0;
      for (std::size_t n = 0; n < loop.size(); ++n) {
        const Vec3 a = point(loop[n]) - center;
        const Vec3 b = point(loop[(n + 1) % loop.size()]) - center;
        const double t = sign * middle.dot(a.cross(b)) / 6.0;
        volume += t;
        moment += t * (a + b + middle) / 4.0;
      }
    }
    mesh_.cells.volume[cell.id] = volume;
    mesh_.cells.centroid[cell.id] = center + moment / volume;
  }

  [[nodiscard]] bool mesh_cell_is_first(int f, const Cell& cell) const {
    const int first = face(f).cell[0];
    return first >= 0 && cells_[static_cast<std::size_t>(first)].id == cell.id;
  }

  Assembly& assembly_;
  Mesh& mesh_;
  CollapseLimits limits_;
  std::vector<Face> faces_;
  std::vector<Cell> cells_;
  std::vector<Vec3> points_;
  std::vector<VertexId> vertex_;
  std::vector<std::uint8_t> is_free_;
  std::vector<std::vector<int>> faces_at_;        ///< of each vertex; none: it is gone
  std::set<std::tuple<double, int, int>> queue_;  ///< short edges: length over size, ends
  std::vector<Edge> edges_;
};

}  // namespace

EdgeCollapse collapse_short_edges(Assembly& assembly, const std::vector<CellId>& kept, const CollapseLimits& limits) {
  std::vector<CellId> sorted = kept;
  std::sort(sorted.begin(), sorted.end());
  return EdgeCollapser(assembly, sorted, limits).run();
}

}  // namespace wellknit
