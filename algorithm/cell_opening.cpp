// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/cell_opening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace wellknit {

namespace {

constexpr double open_depth = 1e-6;  ///< over the cell's size: less counts as not seen, as rounding of the file might
constexpr double good_depth = 0.01;  ///< over the cell's size: where opening ends, and what no neighbour falls below
constexpr int most_rounds = 40;      ///< over the vertices of one cell
constexpr double least_gain = 1e-5;  ///< over the cell's size: a smaller one is none
/// Trial steps over the cell's size.
constexpr std::array<double, 5> steps{0.3, 0.1, 0.03, 0.01, 0.003};

class Opener {
 public:
  Opener(TransitionMesh& mesh, std::span<const std::uint8_t> is_fixed) : mesh_(mesh), is_fixed_(is_fixed) { index(); }

  OpeningReport run() {
    const auto closed = closed_cells();
    report_.closed_first = static_cast<std::int64_t>(closed.size());
    if (closed.empty()) return report_;
    // Twice: a neighbour that has moved may leave the room that was missing.
    for (int pass = 0; pass < 2; ++pass)
      for (const std::int32_t c : closed) open(c);
    report_.moved = static_cast<std::int64_t>(moved_.size());
    for (const std::int32_t c : closed_cells()) merge(c);
    if (report_.merged > 0) renumber();
    report_.closed_last = static_cast<std::int64_t>(closed_cells().size());
    return report_;
  }

 private:
  struct Side {
    std::int32_t face = -1;
    double sign = 1.0;
  };

  void index() {
    sides_.assign(mesh_.centers.size(), {});
    faces_at_.assign(mesh_.vertices.size(), {});
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const DiagramFace& face = mesh_.faces[f];
      const auto id = static_cast<std::int32_t>(f);
      sides_[static_cast<std::size_t>(face.cell)].push_back({id, 1.0});
      if (face.other_kind == DiagramFace::Other::inner)
        sides_[static_cast<std::size_t>(face.other)].push_back({id, -1.0});
      for (const auto v : face.loop) faces_at_[static_cast<std::size_t>(v)].push_back(id);
    }
    is_gone_.assign(mesh_.centers.size(), 0);
  }

  [[nodiscard]] PolygonGeometry geometry(std::int32_t face) const {
    std::vector<Vec3> points;
    for (const auto v : mesh_.faces[static_cast<std::size_t>(face)].loop)
      points.push_back(mesh_.vertices[static_cast<std::size_t>(v)]);
    return polygon_geometry(points);
  }

  [[nodiscard]] std::vector<OutwardFace> outward(const std::vector<Side>& sides) const {
    std::vector<OutwardFace> faces;
    faces.reserve(sides.size());
    for (const Side& s : sides) {
      const PolygonGeometry g = geometry(s.face);
      faces.push_back({g.mean, s.sign * g.area_vector});
    }
    return faces;
  }

  /// Largest height from which all faces are seen, over the cell's size.
  [[nodiscard]] double depth(std::int32_t cell) const { return depth_of(sides_[static_cast<std::size_t>(cell)]); }

  [[nodiscard]] double depth_of(const std::vector<Side>& sides) const {
    const auto faces = outward(sides);
    Vec3 middle = Vec3::Zero();
    for (const OutwardFace& f : faces) middle += f.mean / static_cast<double>(faces.size());
    const double size = cell_size(faces);
    return deepest_point(faces, middle, size).height / size;
  }

  [[nodiscard]] std::vector<std::int32_t> closed_cells() const {
    std::vector<std::int32_t> closed;
    for (std::size_t c = 0; c < sides_.size(); ++c) {
      if (is_gone_[c] != 0) continue;
      const auto faces = outward(sides_[c]);
      if (smallest_height(faces, mesh_.centers[c]) > open_depth * cell_size(faces)) continue;
      if (depth(static_cast<std::int32_t>(c)) <= open_depth) closed.push_back(static_cast<std::int32_t>(c));
    }
    return closed;
  }

  // ---- moving vertices ----

  [[nodiscard]] std::vector<std::int32_t> free_vertices(std::int32_t cell) const {
    std::set<std::int32_t> vertices;
    for (const Side& s : sides_[static_cast<std::size_t>(cell)])
      for (const auto v : mesh_.faces[static_cast<std::size_t>(s.face)].loop)
        if (is_fixed_[static_cast<std::size_t>(v)] == 0) vertices.insert(v);
    return {vertices.begin(), vertices.end()};
  }

  [[nodiscard]] std::vector<std::int32_t> cells_at(std::int32_t vertex) const {
    std::set<std::int32_t> cells;
    for (const auto f : faces_at_[static_cast<std::size_t>(vertex)]) {
      const DiagramFace& face = mesh_.faces[static_cast<std::size_t>(f)];
      cells.insert(face.cell);
      if (face.other_kind == DiagramFace::Other::inner) cells.insert(face.other);
    }
    return {cells.begin(), cells.end()};
  }

  void open(std::int32_t cell) {
    double now = depth(cell);
    for (int round = 0; round < most_rounds && now < good_depth; ++round) {
      bool has_gained = false;
      for (const std::int32_t v : free_vertices(cell)) has_gained |= improve(cell, v, now);
      if (!has_gained) return;
    }
  }

  /// Moves one vertex to the trial place from which the cell is seen best; false when none is better.
  bool improve(std::int32_t cell, std::int32_t vertex, double& now) {
    Vec3& p = mesh_.vertices[static_cast<std::size_t>(vertex)];
    const Vec3 start = p;
    std::vector<std::pair<std::int32_t, double>> neighbours;  // and the least depth that each must keep
    for (const auto c : cells_at(vertex))
      if (c != cell) neighbours.emplace_back(c, std::min(depth(c), good_depth));
    const double size = cell_size(outward(sides_[static_cast<std::size_t>(cell)]));
    Vec3 best = start;
    double best_depth = now + least_gain;
    for (const Vec3& direction : directions(cell, p, size, now))
      for (const double step : steps) {
        p = start + step * size * direction;
        const double trial = depth(cell);
        if (trial <= best_depth) continue;
        if (!std::all_of(neighbours.begin(), neighbours.end(),
                         [&](const auto& n) { return depth(n.first) >= n.second; }))
          continue;
        best = p;
        best_depth = trial;
      }
    p = best;
    if (best == start) return false;
    now = best_depth;
    moved_.insert(vertex);
    return true;
  }

  /// The axes both ways, and the gradient of the depth by differences.
  [[nodiscard]] std::vector<Vec3> directions(std::int32_t cell, Vec3& p, double size, double now) const {
    constexpr double difference = 1e-4;  // of the size; the depth is piecewise smooth
    std::vector<Vec3> out;
    Vec3 gradient = Vec3::Zero();
    const Vec3 start = p;
    for (int axis = 0; axis < 3; ++axis) {
      out.push_back(Vec3::Unit(axis));
      out.push_back(-Vec3::Unit(axis));
      p = start + difference * size * Vec3::Unit(axis);
      gradient[axis] = depth(cell) - now;
    }
    p = start;
    if (gradient.norm() > 0.0) out.push_back(gradient.normalized());
    return out;
  }

  // ---- merging ----

  /// Sides of the union of two cells: all but those between them.
  [[nodiscard]] std::vector<Side> union_of(std::int32_t a, std::int32_t b) const {
    std::vector<Side> sides;
    for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)})
      for (const Side& s : sides_[static_cast<std::size_t>(one)])
        if (beyond(s) != other) sides.push_back(s);
    return sides;
  }

  /// The cell on the other side, or -1.
  [[nodiscard]] std::int32_t beyond(const Side& s) const {
    const DiagramFace& f = mesh_.faces[static_cast<std::size_t>(s.face)];
    if (s.sign < 0.0) return f.cell;
    return f.other_kind == DiagramFace::Other::inner ? f.other : -1;
  }

  /// A union's surface is a ball's when V - E + F = 2 and each edge has two faces.
  [[nodiscard]] bool is_ball(const std::vector<Side>& sides) const {
    std::set<std::int32_t> vertices;
    std::map<std::array<std::int32_t, 2>, int> edges;
    for (const Side& s : sides) {
      const auto& loop = mesh_.faces[static_cast<std::size_t>(s.face)].loop;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::int32_t a = loop[i];
        const std::int32_t b = loop[(i + 1) % loop.size()];
        vertices.insert(a);
        ++edges[{std::min(a, b), std::max(a, b)}];
      }
    }
    return std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.second == 2; }) &&
           vertices.size() + sides.size() == edges.size() + 2;
  }

  void merge(std::int32_t cell) {
    if (is_gone_[static_cast<std::size_t>(cell)] != 0) return;
    std::map<std::int32_t, double> area;  // shared with each neighbour
    for (const Side& s : sides_[static_cast<std::size_t>(cell)])
      if (const std::int32_t n = beyond(s); n >= 0) area[n] += geometry(s.face).area;
    std::int32_t best = -1;
    for (const auto& [n, shared] : area) {
      if (best >= 0 && shared <= area[best]) continue;
      const auto sides = union_of(cell, n);
      if (is_ball(sides) && depth_of(sides) > open_depth) best = n;
    }
    if (best < 0) return;
    sides_[static_cast<std::size_t>(best)] = union_of(cell, best);
    sides_[static_cast<std::size_t>(cell)].clear();
    is_gone_[static_cast<std::size_t>(cell)] = 1;
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      DiagramFace& face = mesh_.faces[f];
      if (face.cell == cell) face.cell = best;
      if (face.other_kind == DiagramFace::Other::inner && face.other == cell) face.other = best;
    }
    ++report_.merged;
  }

  /// Drops merged cells and the faces inside them.
  void renumber() {
    std::vector<std::int32_t> number(mesh_.centers.size(), -1);
    std::vector<Vec3> centers;
    for (std::size_t c = 0; c < number.size(); ++c) {
      if (is_gone_[c] != 0) continue;
      number[c] = static_cast<std::int32_t>(centers.size());
      centers.push_back(mesh_.centers[c]);
    }
    std::vector<DiagramFace> faces;
    std::vector<std::int32_t> boundary_face;
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      DiagramFace& face = mesh_.faces[f];
      const bool is_inner = face.other_kind == DiagramFace::Other::inner;
      if (is_inner && face.cell == face.other) continue;
      face.cell = number[static_cast<std::size_t>(face.cell)];
      if (is_inner) face.other = number[static_cast<std::size_t>(face.other)];
      faces.push_back(std::move(face));
      boundary_face.push_back(mesh_.boundary_face[f]);
    }
    mesh_.centers = std::move(centers);
    mesh_.faces = std::move(faces);
    mesh_.boundary_face = std::move(boundary_face);
    index();
  }

  TransitionMesh& mesh_;
  std::span<const std::uint8_t> is_fixed_;
  std::vector<std::vector<Side>> sides_;             ///< per cell
  std::vector<std::vector<std::int32_t>> faces_at_;  ///< per vertex
  std::vector<std::uint8_t> is_gone_;                ///< per cell: merged into another
  std::set<std::int32_t> moved_;
  OpeningReport report_;
};

}  // namespace

std::vector<std::vector<OutwardFace>> outward_faces(const TransitionMesh& mesh) {
  std::vector<std::vector<OutwardFace>> out(mesh.centers.size());
  std::vector<std::size_t> count(out.size(), 0);
  for (const DiagramFace& f : mesh.faces) {
    ++count[static_cast<std::size_t>(f.cell)];
    if (f.other_kind == DiagramFace::Other::inner) ++count[static_cast<std::size_t>(f.other)];
  }
  for (std::size_t c = 0; c < out.size(); ++c) out[c].reserve(count[c]);
  std::vector<Vec3> points;
  for (const DiagramFace& f : mesh.faces) {
    points.clear();
    for (const auto v : f.loop) points.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
    const PolygonGeometry g = polygon_geometry(points);
    out[static_cast<std::size_t>(f.cell)].push_back({g.mean, g.area_vector});
    if (f.other_kind == DiagramFace::Other::inner)
      out[static_cast<std::size_t>(f.other)].push_back({g.mean, -g.area_vector});
  }
  return out;
}

double enclosed_volume(std::span<const OutwardFace> faces) {
  double volume = 0.0;
  for (const OutwardFace& f : faces) volume += (f.mean - faces.front().mean).dot(f.area_vector) / 3.0;
  return volume;
}

double cell_size(std::span<const OutwardFace> faces) {
  const double volume = enclosed_volume(faces);
  if (volume > 0.0) return std::cbrt(volume);
  double area = 0.0;
  for (const OutwardFace& f : faces) area += f.area_vector.norm();
  return std::sqrt(area / 6.0);
}

OpeningReport open_cells(TransitionMesh& mesh, std::span<const std::uint8_t> is_fixed) {
  return Opener(mesh, is_fixed).run();
}

}  // namespace wellknit
