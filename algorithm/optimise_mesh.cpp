// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What is made small, over the faces of one cavity's transition cells, with e = 2 (1 - cos) of the angle between a
// face's normal and the line of the centres, about its square:
//   e + 2 e^2           of each face between two cells, a joint's 1.2-fold;
//   (e - e_0)^2         of each such face whose e is above what it was, 300-fold, of a joint 2,000-fold;
//   sum of h^2 / A      of each inner face, 90-fold: heights h of its vertices over its plane, area A;
//   (1 - l / l_0)^2     of each edge that moves, 0.5-fold, where its length l is below l_0: 0.04 of the size of the
//                       largest cell at it;
//   (1 - t / t_0)^2     of each tetrahedron between a centre, a face's middle and an edge, 0.03-fold, where its volume
//                       t is below t_0: a fifth of what it was, or a thousandth of the cell where that is more.
// All are smooth where faces have an area and centres differ. docs/algorithms/optimisation.md says what was tried.

#include "algorithm/optimise_mesh.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <unordered_map>
#include <vector>

#include "algorithm/cell_center.h"
#include "algorithm/quasi_newton.h"

namespace wellknit {

namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

bool is_transition(const Mesh& mesh, CellId cell) {
  return cell.is_valid() && mesh.cells.kind[cell] == CellKind::transition;
}

/// Faces of each group of transition cells that are joined by faces.
std::vector<std::vector<FaceId>> cavities_of(const Mesh& mesh) {
  std::vector<std::int64_t> group(mesh.cells.size());
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](CellId cell) {
    std::size_t at = cell.index();
    while (group[at] != static_cast<std::int64_t>(at)) {
      group[at] = group[static_cast<std::size_t>(group[at])];
      at = static_cast<std::size_t>(group[at]);
    }
    return at;
  };
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [a, b] = mesh.faces.cells[FaceId(f)];
    if (!is_transition(mesh, a) || !is_transition(mesh, b)) continue;
    const auto [low, high] = std::minmax({root(a), root(b)});
    group[high] = static_cast<std::int64_t>(low);
  }
  std::vector<std::int64_t> place(mesh.cells.size(), -1);
  std::vector<std::vector<FaceId>> out;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [a, b] = mesh.faces.cells[FaceId(f)];
    if (!is_transition(mesh, a) && !is_transition(mesh, b)) continue;
    std::int64_t& at = place[root(is_transition(mesh, a) ? a : b)];
    if (at < 0) {
      at = static_cast<std::int64_t>(out.size());
      out.emplace_back();
    }
    out[static_cast<std::size_t>(at)].emplace_back(f);
  }
  return out;
}

/// Vertices that belong to transition cells alone, and to none of the sorted cells that are kept.
std::vector<std::uint8_t> free_vertices(const Mesh& mesh, const std::vector<CellId>& kept) {
  const auto moves = [&](CellId cell) {
    return is_transition(mesh, cell) && !std::binary_search(kept.begin(), kept.end(), cell);
  };
  std::vector<std::uint8_t> out(mesh.vertices.size(), 1);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [a, b] = mesh.faces.cells[FaceId(f)];
    if (moves(a) && moves(b)) continue;
    for (const VertexId v : mesh.faces.loop(FaceId(f))) out[v.index()] = 0;
  }
  return out;
}

/// One cavity in arrays of its own. Unknowns: three for each point that moves, in units of its scale.
class CavityShape {
 public:
  CavityShape(const Mesh& mesh, const std::vector<FaceId>& faces, const std::vector<std::uint8_t>& is_free,
              const std::vector<CellId>& kept, const OptimisationWeights& weights)
      : weights_(weights) {
    // By index in the mesh; the cavity is a small part of it.
    std::unordered_map<std::size_t, std::int32_t> place_of_vertex;
    std::unordered_map<std::size_t, std::int32_t> place_of_cell;
    const auto place = [&](auto& places, std::size_t at, const Vec3& point, bool moves) {
      const auto [known, is_new] = places.try_emplace(at, static_cast<std::int32_t>(points_.size()));
      if (is_new) {
        points_.push_back(point);
        moves_.push_back(moves ? 1 : 0);
      }
      return known->second;
    };
    for (const FaceId face : faces) {
      Face out;
      out.begin = loops_.size();
      for (const VertexId v : mesh.faces.loop(face)) {
        const bool is_new = !place_of_vertex.contains(v.index());
        loops_.push_back(place(place_of_vertex, v.index(), mesh.vertices[v], is_free[v.index()] != 0));
        if (is_new) vertices_.push_back({v, loops_.back()});
      }
      out.end = loops_.size();
      for (std::size_t side = 0; side < 2; ++side) {
        const CellId cell = mesh.faces.cells[face][side];
        if (!cell.is_valid()) continue;
        const bool is_made = is_transition(mesh, cell);
        const bool moves = is_made && !std::binary_search(kept.begin(), kept.end(), cell);
        const bool is_new = !place_of_cell.contains(cell.index());
        out.center[side] = place(place_of_cell, cell.index(), mesh.cells.center[cell], moves);
        out.is_made[side] = is_made;
        if (is_new && is_made) cells_.push_back({cell, out.center[side], mesh.cells.volume[cell]});
      }
      faces_.push_back(out);
    }
    start_ = points_;
    set_scales();
    set_thin();
    set_edges();
    constexpr std::size_t least_share = 1000;
    constexpr std::size_t most_shares = 4;
    shares_.resize(std::clamp<std::size_t>(faces_.size() / least_share, 1, most_shares));
  }

  /// Of faces between two transition cells, or between one and another cell.
  void add_angles(bool inner, std::vector<double>& out) const {
    for (const Face& face : faces_)
      if (face.has_two_cells() && face.is_inner() == inner) out.push_back(angle(face));
  }

  /// Returns the number of iterations.
  int optimise() {
    // In a regular grid the faces are orthogonal as they come: nothing is to be won that the joints would not cost.
    constexpr double orthogonal = 0.5;  // degrees
    std::vector<double> angles;
    add_angles(true, angles);
    if (std::accumulate(angles.begin(), angles.end(), 0.0) <= orthogonal * static_cast<double>(angles.size())) return 0;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * scale_.size()));
    QuasiNewtonOptions options;
    options.iterations = weights_.iterations;
    const auto result =
        minimise([&](const Eigen::VectorXd& at, Eigen::VectorXd& g) { return value(at, g); }, x, options);
    set_points(x);
    return result.iterations;
  }

  /// Puts back what is not sound now and was before: the centre and the vertices of a cell that is not seen whole, or
  /// that has a face beyond 90 degrees. Returns the number of cells.
  std::int64_t restore_unsound() {
    const std::vector<Vec3> moved = points_;
    std::swap(points_, start_);
    const std::vector<std::uint8_t> was_bad = bad_cells();
    std::swap(points_, start_);
    std::vector<std::uint8_t> is_restored(cells_.size(), 0);
    for (;;) {
      const std::vector<std::uint8_t> is_bad = bad_cells();
      bool changed = false;
      for (std::size_t c = 0; c < cells_.size(); ++c)
        if (is_bad[c] != 0 && was_bad[c] == 0 && is_restored[c] == 0) {
          is_restored[c] = 1;
          changed = true;
        }
      if (!changed) break;
      for (const Face& face : faces_)
        for (std::size_t side = 0; side < 2; ++side) {
          if (!face.is_made[side] || is_restored[cell_at(face.center[side])] == 0) continue;
          restore(face.center[side]);
          for (std::size_t n = face.begin; n < face.end; ++n) restore(loops_[n]);
        }
    }
    // A cell whose neighbours were put back may be bad where it was good, with nothing of its own left to put back.
    if (const auto is_bad = bad_cells(); [&] {
          for (std::size_t c = 0; c < cells_.size(); ++c)
            if (is_bad[c] != 0 && was_bad[c] == 0) return true;
          return false;
        }())
      points_ = start_;
    return std::count(is_restored.begin(), is_restored.end(), 1);
  }

  void write(Mesh& mesh) const {
    for (const auto& [id, at] : vertices_)
      if (moves_[static_cast<std::size_t>(at)] != 0) mesh.vertices[id] = points_[static_cast<std::size_t>(at)];
    std::vector<double> volume(cells_.size(), 0.0);
    std::vector<Vec3> moment(cells_.size(), Vec3::Zero());
    for (const Face& face : faces_)
      for (std::size_t side = 0; side < 2; ++side) {
        if (!face.is_made[side]) continue;
        const std::size_t cell = cell_at(face.center[side]);
        for_each_tetrahedron(face, side, [&](double t, const Vec3& a, const Vec3& b, const Vec3& m) {
          volume[cell] += t / 6.0;
          moment[cell] += t / 6.0 * (a + b + m) / 4.0;
        });
      }
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const CellId cell = cells_[c].id;
      const Vec3& center = points_[static_cast<std::size_t>(cells_[c].place)];
      mesh.cells.center[cell] = center;
      mesh.cells.depth[cell] = center.z();
      mesh.cells.volume[cell] = volume[c];
      mesh.cells.centroid[cell] = center + moment[c] / volume[c];
    }
  }

  [[nodiscard]] std::int64_t cell_count() const { return static_cast<std::int64_t>(cells_.size()); }
  [[nodiscard]] std::int64_t vertex_count() const {
    return std::count_if(vertices_.begin(), vertices_.end(),
                         [&](const auto& v) { return moves_[static_cast<std::size_t>(v.place)] != 0; });
  }

 private:
  struct Face {
    std::size_t begin = 0;  ///< into loops_
    std::size_t end = 0;
    std::size_t tetrahedra = 0;  ///< the first of its own in thin_: those of the first side, then of the second
    double square = 0.0;         ///< of the angle that it had: 2 (1 - cos)
    std::array<std::int32_t, 2> center{-1, -1};  ///< into points_; the normal goes from the first to the second
    std::array<bool, 2> is_made{};               ///< a transition cell
    [[nodiscard]] bool has_two_cells() const { return center[0] >= 0 && center[1] >= 0; }
    [[nodiscard]] bool is_inner() const { return is_made[0] && is_made[1]; }
    [[nodiscard]] std::size_t size() const { return end - begin; }
  };
  /// What one share of the faces adds to the sum and its slopes, with room for one face.
  struct Share {
    double sum = 0.0;
    std::vector<Vec3> slope;  ///< per point
    // The face's corners over its middle, the first once more at the end; products of neighbours; slopes by the
    // corners.
    std::vector<Vec3> rim;
    std::vector<Vec3> product;
    std::vector<Vec3> rim_slope;
  };
  struct Edge {
    std::int32_t a;
    std::int32_t b;
    double shortest;  ///< m: it is short below
  };
  struct VertexPlace {
    VertexId id;
    std::int32_t place;
  };
  struct CellPlace {
    CellId id;
    std::int32_t place;
    double volume;
  };

  [[nodiscard]] const Vec3& point(std::int32_t at) const { return points_[static_cast<std::size_t>(at)]; }
  [[nodiscard]] const Vec3& corner(const Face& face, std::size_t n) const {
    return point(loops_[face.begin + n % face.size()]);
  }
  [[nodiscard]] std::size_t cell_at(std::int32_t center) const {
    return static_cast<std::size_t>(cell_of_place_[static_cast<std::size_t>(center)]);
  }

  [[nodiscard]] Vec3 mean(const Face& face) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t n = 0; n < face.size(); ++n) sum += corner(face, n);
    return sum / static_cast<double>(face.size());
  }

  [[nodiscard]] Vec3 area_vector(const Face& face, const Vec3& middle) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t n = 0; n < face.size(); ++n) sum += (corner(face, n) - middle).cross(corner(face, n + 1) - middle);
    return 0.5 * sum;
  }

  [[nodiscard]] double angle(const Face& face) const {
    const Vec3 normal = area_vector(face, mean(face));
    const Vec3 line = point(face.center[1]) - point(face.center[0]);
    return degrees * std::atan2(normal.cross(line).norm(), normal.dot(line));
  }

  /// Six times the volume of each tetrahedron between a centre and the face's fan, with its corners over the centre.
  template <class Visit>
  void for_each_tetrahedron(const Face& face, std::size_t side, const Visit& visit) const {
    const Vec3& center = point(face.center[side]);
    const Vec3 m = mean(face) - center;
    const double sign = side == 0 ? 1.0 : -1.0;
    for (std::size_t n = 0; n < face.size(); ++n) {
      const Vec3 a = corner(face, n) - center;
      const Vec3 b = corner(face, n + 1) - center;
      visit(sign * m.dot(a.cross(b)), a, b, m);
    }
  }

  /// A vertex moves in units of the shortest edge at it, but a fiftieth of the median at least; a centre in units of
  /// a quarter of its cell's size.
  void set_scales() {
    std::vector<double> shortest(points_.size(), std::numeric_limits<double>::infinity());
    std::vector<double> lengths;
    for (const Face& face : faces_)
      for (std::size_t n = 0; n < face.size(); ++n) {
        const double length = (corner(face, n + 1) - corner(face, n)).norm();
        lengths.push_back(length);
        for (const std::size_t end : {n, (n + 1) % face.size()}) {
          double& least = shortest[static_cast<std::size_t>(loops_[face.begin + end])];
          least = std::min(least, length);
        }
      }
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    cell_of_place_.assign(points_.size(), -1);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const auto at = static_cast<std::size_t>(cells_[c].place);
      cell_of_place_[at] = static_cast<std::int32_t>(c);
      shortest[at] = 0.25 * std::cbrt(cells_[c].volume);
    }
    unknown_.assign(points_.size(), -1);
    for (std::size_t p = 0; p < points_.size(); ++p) {
      if (moves_[p] == 0) continue;
      unknown_[p] = static_cast<std::int32_t>(scale_.size());
      scale_.push_back(std::max(shortest[p], 0.02 * *middle));
    }
  }

  void set_thin() {
    constexpr double part = 0.2;
    constexpr double least = 1e-3;
    for (Face& face : faces_) {
      face.tetrahedra = thin_.size();
      if (face.has_two_cells()) face.square = 2.0 * (1.0 - std::cos(angle(face) / degrees));
      for (std::size_t side = 0; side < 2; ++side)
        if (face.is_made[side])
          for_each_tetrahedron(face, side, [&](double t, const Vec3&, const Vec3&, const Vec3&) {
            thin_.push_back(std::max(part * t, least * cells_[cell_at(face.center[side])].volume));
          });
    }
  }

  /// Edges with an end that moves.
  void set_edges() {
    std::unordered_map<std::int64_t, std::size_t> known;
    for (const Face& face : faces_)
      for (std::size_t n = 0; n < face.size(); ++n) {
        const auto [a, b] = std::minmax(loops_[face.begin + n], loops_[face.begin + (n + 1) % face.size()]);
        if (unknown_[static_cast<std::size_t>(a)] < 0 && unknown_[static_cast<std::size_t>(b)] < 0) continue;
        const std::int64_t key = a * static_cast<std::int64_t>(points_.size()) + b;
        const auto [at, is_new] = known.try_emplace(key, edges_.size());
        if (is_new) edges_.push_back({a, b, 0.0});
        for (std::size_t side = 0; side < 2; ++side)
          if (face.is_made[side]) {
            double& shortest = edges_[at->second].shortest;
            shortest = std::max(shortest, weights_.shortest * std::cbrt(cells_[cell_at(face.center[side])].volume));
          }
      }
  }

  /// The square of what an edge lacks.
  double add_edges(Share& w) const {
    double sum = 0.0;
    for (const Edge& edge : edges_) {
      const Vec3 way = point(edge.b) - point(edge.a);
      const double length = way.norm();
      const double missing = 1.0 - length / edge.shortest;
      if (missing <= 0.0 || !(length > 0.0)) continue;
      sum += weights_.edge * missing * missing;
      const Vec3 slope = 2.0 * weights_.edge * missing / (edge.shortest * length) * way;
      slope_at(w, edge.a) += slope;
      slope_at(w, edge.b) -= slope;
    }
    return sum;
  }

  void set_points(const Eigen::VectorXd& x) {
    for (std::size_t p = 0; p < points_.size(); ++p) {
      if (unknown_[p] < 0) continue;
      const auto u = static_cast<std::size_t>(unknown_[p]);
      points_[p] = start_[p] + scale_[u] * x.segment<3>(static_cast<Eigen::Index>(3 * u));
    }
  }

  /// The faces are worked on in shares that do not depend on the number of threads, and added up in their order.
  double value(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
    set_points(x);
    tbb::parallel_for(std::size_t{0}, shares_.size(), [&](std::size_t s) {
      Share& share = shares_[s];
      share.slope.assign(points_.size(), Vec3::Zero());
      share.sum = 0.0;
      const std::size_t end = (s + 1) * faces_.size() / shares_.size();
      for (std::size_t f = s * faces_.size() / shares_.size(); f < end; ++f) share.sum += add_face(faces_[f], share);
    });
    double sum = add_edges(shares_.front());
    for (const Share& share : shares_) sum += share.sum;
    for (std::size_t p = 0; p < points_.size(); ++p) {
      if (unknown_[p] < 0) continue;
      const auto u = static_cast<std::size_t>(unknown_[p]);
      Vec3 slope = shares_.front().slope[p];
      for (std::size_t s = 1; s < shares_.size(); ++s) slope += shares_[s].slope[p];
      gradient.segment<3>(static_cast<Eigen::Index>(3 * u)) = scale_[u] * slope;
    }
    return sum;
  }

  /// All that one face adds. Everything depends on the rim (corners over the middle), on its products p x q of
  /// neighbours, whose half sum is the area vector, and on the middle over the centres: six times the volume of a
  /// tetrahedron is (middle - centre) . (p x q).
  double add_face(const Face& face, Share& w) const {
    const std::size_t count = face.size();
    const Vec3 m = mean(face);
    w.rim.resize(count + 1);
    w.product.resize(count);
    for (std::size_t n = 0; n < count; ++n) w.rim[n] = point(loops_[face.begin + n]) - m;
    w.rim[count] = w.rim[0];
    Vec3 area = Vec3::Zero();
    for (std::size_t n = 0; n < count; ++n) area += w.product[n] = w.rim[n].cross(w.rim[n + 1]);
    w.rim_slope.assign(count + 1, Vec3::Zero());
    Vec3 area_slope = Vec3::Zero();
    double sum = face.has_two_cells() ? add_shape(face, 0.5 * area, area_slope, w) : 0.0;
    Vec3 middle_slope = Vec3::Zero();
    for (std::size_t side = 0; side < 2; ++side)
      if (face.is_made[side]) sum += add_barrier(face, side, m, middle_slope, w);
    w.rim_slope[0] += w.rim_slope[count];
    // A corner is in two products: the area vector changes by half the cross product with its neighbours' difference.
    const Vec3 by_product = 0.5 * area_slope;
    for (std::size_t n = 0; n < count; ++n)
      w.rim_slope[n] += (w.rim[n + 1] - w.rim[n == 0 ? count - 1 : n - 1]).cross(by_product);
    // The rim is taken from the middle, which is the corners' mean: what pulls all of it pulls them the other way.
    Vec3 all = middle_slope;
    for (std::size_t n = 0; n < count; ++n) all -= w.rim_slope[n];
    all /= static_cast<double>(count);
    for (std::size_t n = 0; n < count; ++n) slope_at(w, loops_[face.begin + n]) += w.rim_slope[n] + all;
    return sum;
  }

  /// Angle and planarity.
  double add_shape(const Face& face, const Vec3& area, Vec3& area_slope, Share& w) const {
    const Vec3 line = point(face.center[1]) - point(face.center[0]);
    const double a = area.norm();
    const double l = line.norm();
    if (!(a > 0.0) || !(l > 0.0)) return 0.0;
    const Vec3 normal = area / a;
    const Vec3 along = line / l;
    const double cosine = normal.dot(along);
    const double weight = face.is_inner() ? 1.0 : weights_.joint;
    // Large angles count for more than their square.
    const double square = 2.0 * (1.0 - cosine);
    const double keep = face.is_inner() ? weights_.keep_inner : weights_.keep_joint;
    const double more = std::max(0.0, square - face.square);
    double sum = weight * (square + weights_.large * square * square) + keep * more * more;
    const double by_cosine = -2.0 * (weight * (1.0 + 2.0 * weights_.large * square) + 2.0 * keep * more);
    area_slope = by_cosine / a * (along - cosine * normal);
    const Vec3 line_slope = by_cosine / l * (normal - cosine * along);
    slope_at(w, face.center[1]) += line_slope;
    slope_at(w, face.center[0]) -= line_slope;
    if (!face.is_inner() || face.size() <= 3) return sum;
    const double factor = weights_.planarity / a;
    Vec3 normal_slope = Vec3::Zero();
    double squares = 0.0;
    for (std::size_t n = 0; n < face.size(); ++n) {
      const double height = w.rim[n].dot(normal);
      squares += factor * height * height;
      w.rim_slope[n] += 2.0 * factor * height * normal;
      normal_slope += 2.0 * factor * height * w.rim[n];
    }
    area_slope += (normal_slope - normal_slope.dot(normal) * normal) / a - squares / a * normal;
    return sum + squares;
  }

  double add_barrier(const Face& face, std::size_t side, const Vec3& m, Vec3& middle_slope, Share& w) const {
    const Vec3 u = (side == 0 ? 1.0 : -1.0) * (m - point(face.center[side]));
    Vec3 by_u = Vec3::Zero();
    double sum = 0.0;
    std::size_t tetrahedron = face.tetrahedra + (side == 1 && face.is_made[0] ? face.size() : 0);
    for (std::size_t n = 0; n < face.size(); ++n, ++tetrahedron) {
      const double volume = u.dot(w.product[n]);
      const double thin = thin_[tetrahedron];
      if (volume >= thin) continue;
      const double missing = 1.0 - volume / thin;
      sum += weights_.barrier * missing * missing;
      const double by_volume = -2.0 * weights_.barrier * missing / thin;
      by_u += by_volume * w.product[n];
      const Vec3 by_product = by_volume * u;
      w.rim_slope[n] += w.rim[n + 1].cross(by_product);
      w.rim_slope[n + 1] += by_product.cross(w.rim[n]);
    }
    if (side == 1) by_u = -by_u;
    middle_slope += by_u;
    slope_at(w, face.center[side]) -= by_u;
    return sum;
  }

  static Vec3& slope_at(Share& w, std::int32_t at) { return w.slope[static_cast<std::size_t>(at)]; }
  void restore(std::int32_t at) { points_[static_cast<std::size_t>(at)] = start_[static_cast<std::size_t>(at)]; }

  /// Per cell: 1 where its centre does not see all of a face, or a face is beyond 90 degrees.
  [[nodiscard]] std::vector<std::uint8_t> bad_cells() const {
    std::vector<std::uint8_t> out(cells_.size(), 0);
    for (const Face& face : faces_) {
      const Vec3 area = area_vector(face, mean(face));
      const bool is_turned = face.has_two_cells() && !(area.dot(point(face.center[1]) - point(face.center[0])) > 0.0);
      for (std::size_t side = 0; side < 2; ++side) {
        if (!face.is_made[side]) continue;
        double volume = 0.0;
        for_each_tetrahedron(face, side, [&](double t, const Vec3&, const Vec3&, const Vec3&) { volume += t; });
        if (is_turned || !(volume > 0.0)) out[cell_at(face.center[side])] = 1;
      }
    }
    return out;
  }

  OptimisationWeights weights_;
  std::vector<Vec3> points_;         ///< vertices and centres
  std::vector<Vec3> start_;          ///< where they were
  std::vector<std::uint8_t> moves_;  ///< per point
  std::vector<std::int32_t> loops_;  ///< into points_
  std::vector<Face> faces_;
  std::vector<VertexPlace> vertices_;
  std::vector<CellPlace> cells_;
  std::vector<std::int32_t> cell_of_place_;  ///< per point: into cells_, or -1
  std::vector<std::int32_t> unknown_;        ///< per point, or -1
  std::vector<double> scale_;                ///< m, per point that moves
  std::vector<double> thin_;                 ///< m3, per tetrahedron in the order of faces and sides: t_0
  std::vector<Edge> edges_;
  std::vector<Share> shares_;
};

AngleFigures figures_of(std::vector<double>& angles) {
  AngleFigures out;
  if (angles.empty()) return out;
  std::sort(angles.begin(), angles.end());
  out.mean = std::accumulate(angles.begin(), angles.end(), 0.0) / static_cast<double>(angles.size());
  out.p99 = angles[static_cast<std::size_t>(0.99 * static_cast<double>(angles.size() - 1))];
  out.largest = angles.back();
  return out;
}

AngleFigures angles_of(const std::vector<CavityShape>& shapes, bool inner) {
  std::vector<double> angles;
  for (const CavityShape& shape : shapes) shape.add_angles(inner, angles);
  return figures_of(angles);
}

}  // namespace

MeshOptimisation optimise_mesh(Mesh& mesh, std::vector<CellId> kept, const OptimisationWeights& weights) {
  MeshOptimisation out;
  std::sort(kept.begin(), kept.end());
  const auto is_free = free_vertices(mesh, kept);
  std::vector<CavityShape> shapes;
  for (const std::vector<FaceId>& faces : cavities_of(mesh)) shapes.emplace_back(mesh, faces, is_free, kept, weights);
  out.inner_before = angles_of(shapes, true);
  out.joint_before = angles_of(shapes, false);
  std::vector<int> iterations(shapes.size(), 0);
  std::vector<std::int64_t> restored(shapes.size(), 0);
  tbb::parallel_for(std::size_t{0}, shapes.size(), [&](std::size_t s) {
    iterations[s] = shapes[s].optimise();
    restored[s] = shapes[s].restore_unsound();
  });
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    shapes[s].write(mesh);
    out.cells += shapes[s].cell_count();
    out.vertices += shapes[s].vertex_count();
    out.iterations = std::max(out.iterations, iterations[s]);
    out.restored += restored[s];
  }
  out.inner_after = angles_of(shapes, true);
  out.joint_after = angles_of(shapes, false);
  return out;
}

}  // namespace wellknit
