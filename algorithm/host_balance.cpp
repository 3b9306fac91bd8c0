// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Heights are over the plane through the middle C of the four corners, normal to the quad's area vector A, times |A|.
// A is normal to both diagonals, so the corners' heights are h, -h, h, -h, and along an edge the height goes from h to
// -h. A loop with n points whose heights add up to S changes the fan's volume by S / (3 n): points of total height -S
// undo it (docs/algorithms/host.md).

#include "algorithm/host_balance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace wellknit {

namespace {

/// Change of volume, relative to the smaller cell's, that is left alone.
constexpr double tolerance = 1e-3;
/// Height of a point, relative to the corners', that leaves room for others beside it.
constexpr double usual_height = 0.75;
constexpr double height_spread = 0.15;
/// Times that all horizons are looked at.
constexpr int passes = 4;

using EdgePiece = std::pair<VertexId, VertexId>;  ///< the smaller id first

struct AddedPoint {
  double fraction = 0.0;  ///< of the piece, from its first vertex
  VertexId vertex;
};

class TopBalancer {
 public:
  explicit TopBalancer(HostMesh& mesh) : mesh_(mesh) {}

  std::int64_t balance() {
    std::vector<FaceId> cut;
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
      if (mesh_.faces.axis[FaceId(f)] == Axis::k && mesh_.faces.loop(FaceId(f)).size() > 4) cut.emplace_back(f);
    for (const FaceId face : cut)
      for (const Edge& edge : edges_of(face)) ++horizons_[key_of(edge)];
    // A point on an edge that two horizons of a column share disturbs the other one.
    for (int pass = 0; pass < passes; ++pass) {
      const std::int64_t before = count_;
      for (const FaceId face : cut) balance(face);
      if (count_ == before) break;
    }
    if (!added_.empty()) rewrite_loops();
    return count_;
  }

 private:
  /// A stretch of the loop from corner to corner.
  struct Edge {
    std::vector<VertexId> points;  ///< both corners among them
  };

  /// The loop's four edges; nothing when it has not four corners.
  [[nodiscard]] std::vector<Edge> edges_of(FaceId face) const {
    const auto loop = mesh_.faces.loop(face);
    const HostCellId cell = mesh_.faces.cells[face][0];
    const auto corners = mesh_.corners_of(cell);
    std::vector<std::size_t> at;
    for (std::size_t n = 0; n < loop.size(); ++n)
      if (std::find(corners.begin(), corners.end(), loop[n]) != corners.end()) at.push_back(n);
    if (at.size() != 4) return {};
    std::vector<Edge> edges(4);
    for (std::size_t e = 0; e < 4; ++e) {
      const std::size_t end = e == 3 ? at[0] + loop.size() : at[e + 1];
      for (std::size_t n = at[e]; n <= end; ++n) edges[e].points.push_back(loop[n % loop.size()]);
    }
    return edges;
  }

  [[nodiscard]] double smaller_volume(FaceId face) const {
    double volume = mesh_.volume[mesh_.faces.cells[face][0]];
    const HostCellId other = mesh_.faces.cells[face][1];
    if (other.is_valid() && mesh_.exists[other] != 0) volume = std::min(volume, mesh_.volume[other]);
    return volume;
  }

  static EdgePiece key_of(const Edge& edge) { return std::minmax(edge.points.front(), edge.points.back()); }

  /// Points between the corners of an edge, with those that were added; `visit` gets each.
  template <class Visit>
  void for_each_inner_point(const Edge& edge, const Visit& visit) const {
    for (std::size_t n = 0; n + 1 < edge.points.size(); ++n) {
      if (n > 0) visit(edge.points[n]);
      const auto found = added_.find(std::minmax(edge.points[n], edge.points[n + 1]));
      if (found == added_.end()) continue;
      for (const AddedPoint& point : found->second) visit(point.vertex);
    }
  }

  void balance(FaceId face) {
    const auto edges = edges_of(face);
    if (edges.empty()) return;
    std::array<Vec3, 4> corner;
    for (std::size_t e = 0; e < 4; ++e) corner[e] = mesh_.vertices[edges[e].points.front()];
    const Vec3 middle = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]);
    const Vec3 area = 0.5 * (corner[2] - corner[0]).cross(corner[3] - corner[1]);
    const auto height = [&](VertexId v) { return area.dot(mesh_.vertices[v] - middle); };
    double sum = 0.0;
    std::size_t points = 4;
    const Edge* best = nullptr;
    // Rather an edge of this horizon alone, and one with many points.
    const auto is_better = [&](const Edge& one, const Edge& other) {
      const int shared_one = horizons_.at(key_of(one));
      const int shared_other = horizons_.at(key_of(other));
      return shared_one != shared_other ? shared_one < shared_other : one.points.size() > other.points.size();
    };
    for (const Edge& edge : edges) {
      for_each_inner_point(edge, [&](VertexId v) {
        sum += height(v);
        ++points;
      });
      if (edge.points.size() > 2 && (best == nullptr || is_better(edge, *best))) best = &edge;
    }
    const double change = sum / (3.0 * static_cast<double>(points));
    if (best == nullptr || std::abs(change) <= tolerance * smaller_volume(face)) return;
    add_points(*best, -sum, height(best->points.front()), points - 4);
  }

  /// Points on a cut edge whose heights add up to `total`; the edge's first corner has the height `first`.
  void add_points(const Edge& edge, double total, double first, std::size_t cut_points) {
    // k crossings on the edges themselves have at most k times a corner's height. More comes from crossings that bulge
    // out between skew pillars, over a flat top: no point on an edge undoes that.
    const double wanted = std::ceil(std::abs(total / first) / usual_height);
    if (!(wanted <= 2.0 * static_cast<double>(cut_points))) return;
    const auto count = static_cast<std::size_t>(wanted);
    const Vec3 begin = mesh_.vertices[edge.points.front()];
    const Vec3 along = mesh_.vertices[edge.points.back()] - begin;
    const double square = along.squaredNorm();
    const auto fraction_of = [&](VertexId v) { return along.dot(mesh_.vertices[v] - begin) / square; };
    for (std::size_t n = 0; n < count; ++n) {
      // Spread evenly around the mean height, so that no two are one point.
      const double place = count == 1 ? 0.0 : 2.0 * static_cast<double>(n) / static_cast<double>(count - 1) - 1.0;
      const double mean = total / (first * static_cast<double>(count));
      const double fraction = 0.5 * (1.0 - (mean + place * height_spread * std::min(1.0, std::abs(mean))));
      for (std::size_t piece = 0; piece + 1 < edge.points.size(); ++piece) {
        const double from = fraction_of(edge.points[piece]);
        const double to = fraction_of(edge.points[piece + 1]);
        // A point that all but meets a crossing would make a face without extent.
        const double room = 1e-3 * (to - from);
        if (!(fraction > from + room) || !(fraction < to - room)) continue;
        add_point(edge.points[piece], edge.points[piece + 1], (fraction - from) / (to - from));
        break;
      }
    }
  }

  void add_point(VertexId a, VertexId b, double fraction) {
    if (b < a) {
      std::swap(a, b);
      fraction = 1.0 - fraction;
    }
    auto& points = added_[{a, b}];
    const Vec3 point = (1.0 - fraction) * mesh_.vertices[a] + fraction * mesh_.vertices[b];
    // The faces above and below one gap may ask for the same.
    for (const AddedPoint& other : points)
      if (std::abs(other.fraction - fraction) < 1e-3) return;
    points.push_back({fraction, mesh_.vertices.push_back(point)});
    ++count_;
  }

  /// The loop with the points that its edges got, each in the loop's own direction.
  [[nodiscard]] std::vector<VertexId> lengthened(const std::vector<std::uint8_t>& is_end,
                                                 std::span<const VertexId> loop) const {
    std::vector<VertexId> out;
    for (std::size_t n = 0; n < loop.size(); ++n) {
      const VertexId a = loop[n];
      const VertexId b = loop[n + 1 == loop.size() ? 0 : n + 1];
      out.push_back(a);
      if (is_end[a.index()] == 0 || is_end[b.index()] == 0) continue;
      const auto found = added_.find(a < b ? EdgePiece{a, b} : EdgePiece{b, a});
      if (found == added_.end()) continue;
      const auto& points = found->second;
      for (std::size_t p = 0; p < points.size(); ++p) out.push_back(points[a < b ? p : points.size() - 1 - p].vertex);
    }
    return out;
  }

  using ChangedLoop = std::pair<std::size_t, std::vector<VertexId>>;  ///< face, all of its new loop

  /// Every face with a piece of edge that was divided gets the points.
  void rewrite_loops() {
    std::vector<std::uint8_t> is_end(mesh_.vertices.size(), 0);
    for (auto& [piece, points] : added_) {
      is_end[piece.first.index()] = is_end[piece.second.index()] = 1;
      std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.fraction < b.fraction; });
    }
    const auto is_marked = [&](VertexId v) { return is_end[v.index()] != 0; };
    std::vector<ChangedLoop> changed;
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const auto loop = mesh_.faces.loop(FaceId(f));
      if (std::count_if(loop.begin(), loop.end(), is_marked) < 2) continue;
      auto longer = lengthened(is_end, loop);
      if (longer.size() > loop.size()) changed.emplace_back(f, std::move(longer));
    }
    put_in(changed);
  }

  /// The loops behind a changed one move up in place, from the last one backwards.
  void put_in(const std::vector<ChangedLoop>& changed) {
    HostFaces& faces = mesh_.faces;
    std::size_t more = 0;
    for (const auto& [face, loop] : changed) more += loop.size() - faces.loop(FaceId(face)).size();
    auto read = static_cast<std::ptrdiff_t>(faces.vertices.size());
    faces.vertices.resize(faces.vertices.size() + more);
    auto shift = static_cast<std::ptrdiff_t>(more);
    std::size_t last = faces.size();
    for (auto next = changed.rbegin(); next != changed.rend(); ++next) {
      const auto& [face, loop] = *next;
      // Faces face + 1 … last - 1 keep their loops.
      const auto begin = static_cast<std::ptrdiff_t>(faces.vertex_start[face + 1]);
      std::copy_backward(faces.vertices.begin() + begin, faces.vertices.begin() + read,
                         faces.vertices.begin() + read + shift);
      for (std::size_t f = last; f > face; --f) faces.vertex_start[f] += shift;
      std::copy(loop.rbegin(), loop.rend(), std::make_reverse_iterator(faces.vertices.begin() + begin + shift));
      read = static_cast<std::ptrdiff_t>(faces.vertex_start[face]);
      shift -= static_cast<std::ptrdiff_t>(loop.size()) - (begin - read);
      last = face;
    }
  }

  HostMesh& mesh_;
  std::map<EdgePiece, int> horizons_;  ///< tops and bases that have an edge, by its corners
  std::map<EdgePiece, std::vector<AddedPoint>> added_;
  std::int64_t count_ = 0;
};

}  // namespace

std::int64_t balance_cut_tops(HostMesh& mesh) { return TopBalancer(mesh).balance(); }

}  // namespace wellknit
