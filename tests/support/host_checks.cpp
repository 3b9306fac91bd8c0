// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "tests/support/host_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace wellknit {

namespace {

/// Of the mesh: a cell that exists and was not replaced by refined ones.
bool is_cell(const HostMesh& mesh, HostCellId cell) {
  const bool is_source = cell.index() < mesh.exists.size() - mesh.refined.size();
  return mesh.exists[cell] != 0 && !(is_source && mesh.is_refined(cell));
}

/// A face as one of its cells sees it.
struct SeenFace {
  FaceId face;
  bool outward;  ///< the loop's normal points out of the cell
};

std::vector<std::vector<SeenFace>> faces_of_cells(const HostMesh& mesh) {
  std::vector<std::vector<SeenFace>> faces(mesh.exists.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [first, second] = mesh.faces.cells[FaceId(f)];
    faces[first.index()].push_back({FaceId(f), true});
    if (second.is_valid() && is_cell(mesh, second)) faces[second.index()].push_back({FaceId(f), false});
  }
  return faces;
}

/// Number of directed edges that are used twice or whose reverse is missing.
std::size_t loose_edges(const HostMesh& mesh, const std::vector<SeenFace>& faces) {
  std::vector<std::pair<VertexId, VertexId>> edges;
  for (const SeenFace& seen : faces) {
    const auto loop = mesh.faces.loop(seen.face);
    for (std::size_t v = 0; v < loop.size(); ++v) {
      const VertexId a = loop[v];
      const VertexId b = loop[(v + 1) % loop.size()];
      edges.push_back(seen.outward ? std::pair(a, b) : std::pair(b, a));
    }
  }
  std::sort(edges.begin(), edges.end());
  std::size_t loose = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (e > 0 && edges[e] == edges[e - 1]) ++loose;
    if (!std::binary_search(edges.begin(), edges.end(), std::pair(edges[e].second, edges[e].first))) ++loose;
  }
  return loose;
}

bool has_cut_top(const HostMesh& mesh, const std::vector<SeenFace>& faces) {
  return std::any_of(faces.begin(), faces.end(), [&](const SeenFace& seen) {
    return mesh.faces.axis[seen.face] == Axis::k && mesh.faces.loop(seen.face).size() > 4;
  });
}

void check_loops(const HostMesh& mesh, HostCheck& out) {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto loop = mesh.faces.loop(FaceId(f));
    std::vector<VertexId> sorted(loop.begin(), loop.end());
    std::sort(sorted.begin(), sorted.end());
    if (loop.size() < 3 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      out.faults.push_back(fmt::format("face {} has a vertex twice or fewer than three", f));
    const auto [first, second] = mesh.faces.cells[FaceId(f)];
    const bool both = second.is_valid() && is_cell(mesh, second);
    if (!first.is_valid() || !is_cell(mesh, first) || (both && !(first < second)))
      out.faults.push_back(fmt::format("face {} has cells {} and {}", f, first.value(), second.value()));
  }
}

/// Sets that are joined pair by pair.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count), count_(count) {
    for (std::size_t n = 0; n < count; ++n) parent_[n] = n;
  }
  void join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    if (a != b) --count_;
    parent_[a] = b;
  }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::size_t root(std::size_t a) const {
    while (parent_[a] != a) a = parent_[a];
    return a;
  }
  std::vector<std::size_t> parent_;
  std::size_t count_;
};

/// One directed edge of a cell's surface: from one corner of a face to the next.
struct HalfEdge {
  VertexId from;
  VertexId to;
  std::size_t face;    ///< of the cell
  std::size_t corner;  ///< of the cell's list of corners: where it begins
  std::size_t next;    ///< where it ends
};

struct Surface {
  std::int64_t euler = 0;
  bool is_whole = false;  ///< one piece, and one fan of faces at each vertex
};

Surface surface_of(const HostMesh& mesh, const std::vector<SeenFace>& faces) {
  std::vector<HalfEdge> edges;
  std::vector<VertexId> vertices;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto loop = mesh.faces.loop(faces[f].face);
    const std::size_t n = loop.size();
    const std::size_t begin = vertices.size();
    for (std::size_t v = 0; v < n; ++v) vertices.push_back(faces[f].outward ? loop[v] : loop[n - 1 - v]);
    for (std::size_t v = 0; v < n; ++v)
      edges.push_back({vertices[begin + v], vertices[begin + (v + 1) % n], f, begin + v, begin + (v + 1) % n});
  }
  const auto before = [](const HalfEdge& a, const HalfEdge& b) {
    return std::pair(a.from, a.to) < std::pair(b.from, b.to);
  };
  std::sort(edges.begin(), edges.end(), before);
  Sets pieces(faces.size());
  Sets fans(vertices.size());
  for (const HalfEdge& edge : edges) {
    const HalfEdge reverse{edge.to, edge.from, 0, 0, 0};
    const auto twin = std::lower_bound(edges.begin(), edges.end(), reverse, before);
    if (twin == edges.end() || before(reverse, *twin)) continue;  // a loose edge: check_host() says so
    pieces.join(edge.face, twin->face);
    fans.join(edge.corner, twin->next);
  }
  std::sort(vertices.begin(), vertices.end());
  const auto distinct = std::unique(vertices.begin(), vertices.end()) - vertices.begin();
  Surface out;
  out.euler = distinct - static_cast<std::int64_t>(edges.size() / 2) + static_cast<std::int64_t>(faces.size());
  out.is_whole = pieces.count() == 1 && fans.count() == static_cast<std::size_t>(distinct);
  return out;
}

void check_for_copies(const HostMesh& mesh, TopologyCheck& out) {
  std::vector<std::vector<std::int64_t>> keys;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto loop = mesh.faces.loop(FaceId(f));
    auto& key = keys.emplace_back();
    for (const VertexId v : loop) key.push_back(v.value());
    std::sort(key.begin(), key.end());
    for (const HostCellId cell : mesh.faces.cells[FaceId(f)]) key.push_back(cell.value());
  }
  std::sort(keys.begin(), keys.end());
  if (std::adjacent_find(keys.begin(), keys.end()) != keys.end())
    out.faults.emplace_back("two faces have the same vertices and the same cells");
}

}  // namespace

TopologyCheck check_topology(const HostMesh& mesh) {
  TopologyCheck out;
  check_for_copies(mesh, out);
  const auto faces = faces_of_cells(mesh);
  for (std::size_t c = 0; c < faces.size(); ++c) {
    if (!is_cell(mesh, HostCellId(c))) continue;
    const Surface surface = surface_of(mesh, faces[c]);
    ++(surface.is_whole ? out.spheres : out.others);
    if (surface.is_whole && surface.euler != 2)
      out.faults.push_back(fmt::format("cell {} has the Euler characteristic {}", c, surface.euler));
  }
  return out;
}

std::vector<Vec3> loop_points(const HostMesh& mesh, FaceId face) {
  std::vector<Vec3> points;
  for (const VertexId v : mesh.faces.loop(face)) points.push_back(mesh.vertices[v]);
  return points;
}

HostCheck check_host(const CornerPointGrid& grid, const HostMesh& mesh) {
  HostCheck out;
  check_loops(mesh, out);
  const auto faces = faces_of_cells(mesh);
  for (std::size_t c = 0; c < faces.size(); ++c) {
    if (!is_cell(mesh, HostCellId(c))) {
      if (!faces[c].empty()) out.faults.push_back(fmt::format("cell {} does not exist but has faces", c));
      continue;
    }
    ++out.cells;
    if (c < grid.active.size() && grid.active[c] == 0)
      out.faults.push_back(fmt::format("cell {} exists but is inactive", c));
    if (const auto loose = loose_edges(mesh, faces[c]); loose > 0)
      out.faults.push_back(fmt::format("cell {} has {} loose edges", c, loose));
    const Vec3 origin = mesh.vertices[mesh.corner(HostCellId(c), 0, 0, 0)];
    Vec3 sum = Vec3::Zero();
    double area = 0.0;
    double volume = 0.0;
    for (const SeenFace& seen : faces[c]) {
      auto points = loop_points(mesh, seen.face);
      for (Vec3& p : points) p -= origin;
      const auto geometry = polygon_geometry(points);
      const double sign = seen.outward ? 1.0 : -1.0;
      sum += sign * geometry.area_vector;
      area += geometry.area;
      for (std::size_t v = 0; v < points.size(); ++v)
        volume += sign * geometry.mean.dot(points[v].cross(points[(v + 1) % points.size()])) / 6.0;
    }
    out.worst_openness = std::max(out.worst_openness, sum.norm() / area);
    const double expected = mesh.volume[HostCellId(c)];
    const double difference = std::abs(volume / expected - 1.0);
    out.worst_volume = std::max(out.worst_volume, difference);
    if (expected > sliver_volume) {
      const bool is_cut = has_cut_top(mesh, faces[c]);
      if (!is_cut) out.worst_uncut_volume = std::max(out.worst_uncut_volume, difference);
      ++(is_cut ? out.cut_cells : out.uncut_cells);
      out.far_off_cells += difference > 0.02 ? 1 : 0;
    }
    if (!(expected > 0.0)) out.faults.push_back(fmt::format("cell {} has volume {}", c, expected));
  }
  return out;
}

double worst_side_area(const CornerPointGrid& grid, const HostMesh& mesh) {
  // Per cell and side (low and high i, low and high j): the expected area less what the faces give.
  static constexpr std::array<std::array<std::size_t, 4>, 4> sides{
      {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}}};
  std::vector<std::array<double, 4>> left(mesh.exists.size());
  std::vector<std::array<double, 4>> whole(mesh.exists.size());
  for (std::size_t c = 0; c < left.size(); ++c) {
    if (mesh.exists[HostCellId(c)] == 0) continue;
    const auto corners = mesh.corners_of(HostCellId(c));
    for (std::size_t s = 0; s < 4; ++s) {
      std::array<Vec3, 4> points;
      for (std::size_t n = 0; n < 4; ++n) points[n] = mesh.vertices[corners[sides[s][n]]];
      left[c][s] = whole[c][s] = polygon_geometry(points).area;
    }
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const FaceId face(f);
    const auto axis = static_cast<std::size_t>(mesh.faces.axis[face]);
    if (axis == 2) continue;
    const auto geometry = polygon_geometry(loop_points(mesh, face));
    for (const HostCellId cell : mesh.faces.cells[face]) {
      if (!cell.is_valid() || mesh.exists[cell] == 0) continue;
      Vec3 centre = Vec3::Zero();
      for (const VertexId v : mesh.corners_of(cell)) centre += mesh.vertices[v] / 8.0;
      const bool high =
          (geometry.mean - centre)[static_cast<Eigen::Index>(axis)] > 0.0;  // these grids' axes are x and y
      left[cell.index()][2 * axis + (high ? 1 : 0)] -= geometry.area;
    }
  }
  double worst = 0.0;
  for (std::size_t c = 0; c < left.size(); ++c)
    for (std::size_t s = 0; s < 4; ++s)
      if (grid.active[c] != 0 && whole[c][s] > 0.0) worst = std::max(worst, std::abs(left[c][s]) / whole[c][s]);
  return worst;
}

}  // namespace wellknit
