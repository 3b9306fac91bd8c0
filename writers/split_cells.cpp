// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/split_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <span>

#include "model/mesh_topology.h"

namespace wellknit {

namespace {

enum class Shape : std::uint8_t { split, hexahedron, prism, other };

/// Whether the surface is a prism: two polygons of one size without a common vertex, joined by as many quadrilaterals.
bool is_prism(const CellSurface& surface, std::size_t most_sides) {
  if (surface.size() < 5) return false;
  const std::size_t sides = surface.size() - 2;
  if (sides == 4 || sides > most_sides || surface.points().size() != 2 * sides) return false;
  std::vector<VertexId> caps;
  for (std::size_t f = 0; f < surface.size(); ++f) {
    const auto ring = surface.ring(f);
    if (ring.size() == sides)
      caps.insert(caps.end(), ring.begin(), ring.end());
    else if (ring.size() != 4)
      return false;
  }
  std::sort(caps.begin(), caps.end());
  return caps == surface.points();  // each vertex in one of exactly two
}

Shape shape_of(const CellSurface& surface, std::size_t most_sides) {
  if (surface.hexahedron()) return Shape::hexahedron;
  if (is_prism(surface, most_sides)) return Shape::prism;
  const std::size_t points = surface.points().size();
  const bool is_tetrahedron = surface.size() == 4 && points == 4;
  const bool is_pyramid = surface.size() == 5 && points == 5;
  return is_tetrahedron || is_pyramid ? Shape::other : Shape::split;
}

/// A face of a piece, as far as its neighbour beyond it and the angle there need it.
struct PieceFace {
  std::array<std::int64_t, 4> key{-1, -1, -1, -1};  ///< its smallest points, in order
  std::size_t piece;
  Vec3 area = Vec3::Zero();  ///< outward
};

std::array<std::int64_t, 4> key_of(std::span<const std::int64_t> ring) {
  std::array<std::int64_t, 4> key{-1, -1, -1, -1};
  std::partial_sort_copy(ring.begin(), ring.end(), key.begin(),
                         key.begin() + std::min<std::ptrdiff_t>(std::ssize(ring), 4));
  return key;
}

double angle_of(const Vec3& area, const Vec3& line) {
  const double length = area.norm() * line.norm();
  if (length == 0.0) return 0.0;
  return std::acos(std::clamp(area.dot(line) / length, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

/// Mean and largest of angles, one after another.
struct AngleTally {
  double sum = 0.0;
  double largest = 0.0;
  std::size_t count = 0;

  void add(double angle) {
    sum += angle;
    largest = std::max(largest, angle);
    ++count;
  }
  [[nodiscard]] NonOrthogonality result() const {
    return {count == 0 ? 0.0 : sum / static_cast<double>(count), largest};
  }
};

NonOrthogonality mesh_angles(const Mesh& mesh) {
  AngleTally tally;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [from, to] = mesh.faces.cells[FaceId(f)];
    if (!to.is_valid()) continue;
    tally.add(
        angle_of(face_geometry(mesh, FaceId(f)).area_vector, mesh.cells.centroid[to] - mesh.cells.centroid[from]));
  }
  return tally.result();
}

/// A piece's base: a point of its plane and its outward unit normal.
struct Base {
  Vec3 point;
  Vec3 normal;
};

/// The smallest distance from a point to the bases, positive inside of all.
double clearance(std::span<const Base> bases, const Vec3& point, const Base** nearest = nullptr) {
  double least = std::numeric_limits<double>::infinity();
  for (const Base& base : bases) {
    const double distance = base.normal.dot(base.point - point);
    if (distance >= least) continue;
    least = distance;
    if (nearest != nullptr) *nearest = &base;
  }
  return least;
}

/// A point that sees all bases, if need be and there is one: the clearance is concave, and steps away from the nearest
/// base raise it. Shor, Minimization Methods for Non-Differentiable Functions (1985): steps in geometric progression.
Vec3 apex_of(std::span<const Base> bases, const Vec3& center, const Vec3& centroid, double size) {
  constexpr double enough = 0.01;  // of the cell's size
  constexpr int steps = 300;
  constexpr double shrink = 0.98;
  const Base* nearest = nullptr;
  if (clearance(bases, center, &nearest) >= enough * size) return center;
  Vec3 best = clearance(bases, centroid) > clearance(bases, center) ? centroid : center;
  double most = clearance(bases, best);
  Vec3 point = best;
  double step = 0.1 * size;
  for (int n = 0; n < steps && most < enough * size; ++n, step *= shrink) {
    const double here = clearance(bases, point, &nearest);
    if (here > most) {
      most = here;
      best = point;
    }
    point -= step * nearest->normal;
  }
  return best;
}

class Splitter {
 public:
  Splitter(const Mesh& mesh, std::size_t most_sides)
      : mesh_(mesh), faces_(faces_of_cells(mesh)), middle_(mesh.faces.size(), -1) {
    find_shapes(most_sides);
    settle_prisms();
    out_.points.assign(mesh.vertices.raw().begin(), mesh.vertices.raw().end());
  }

  SplitCells run() {
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      surface_.assign(mesh_, faces_.of(CellId(c)));
      if (shape_[c] == Shape::split)
        add_pieces(CellId(c));
      else
        add_whole(CellId(c));
    }
    out_.before = mesh_angles(mesh_);
    out_.after = piece_angles();
    return std::move(out_);
  }

 private:
  using Ring = std::vector<std::int64_t>;

  void find_shapes(std::size_t most_sides) {
    shape_.resize(mesh_.cells.size());
    for (std::size_t c = 0; c < shape_.size(); ++c) {
      surface_.assign(mesh_, faces_.of(CellId(c)));
      shape_[c] = shape_of(surface_, most_sides);
    }
  }

  /// A polygon of five and more is a fan beside a cell that is split: a prism beyond it is split too.
  void settle_prisms() {
    std::vector<CellId> split;
    for (std::size_t c = 0; c < shape_.size(); ++c)
      if (shape_[c] == Shape::split) split.emplace_back(c);
    while (!split.empty()) {
      const CellId cell = split.back();
      split.pop_back();
      for (const CellFace& side : faces_.of(cell)) {
        if (mesh_.faces.loop(side.face).size() < 5) continue;
        const CellId beyond = mesh_.faces.cells[side.face][side.outward ? 1 : 0];
        if (!beyond.is_valid() || shape_[beyond.index()] == Shape::split) continue;
        shape_[beyond.index()] = Shape::split;
        split.push_back(beyond);
      }
    }
  }

  [[nodiscard]] const Vec3& point(std::int64_t id) const { return out_.points[static_cast<std::size_t>(id)]; }

  void add_whole(CellId cell) {
    const std::size_t piece = start_piece(cell, mesh_.cells.volume[cell], mesh_.cells.centroid[cell]);
    if (const auto hexahedron = surface_.hexahedron()) {
      std::array<std::int64_t, 8> points{};
      std::transform(hexahedron->begin(), hexahedron->end(), points.begin(), [](VertexId v) { return v.value(); });
      out_.cells.add(vtk_hexahedron, points);
    } else {
      out_.cells.add_polyhedron(surface_);
    }
    for (const CellFace& side : faces_.of(cell)) {
      const auto loop = mesh_.faces.loop(side.face);
      ring_.clear();
      for (const VertexId v : loop) ring_.push_back(v.value());
      const Vec3 area = face_geometry(mesh_, side.face).area_vector;
      piece_faces_.push_back({key_of(ring_), piece, side.outward ? area : Vec3(-area)});
    }
  }

  void add_pieces(CellId cell) {
    ++out_.cells_split;
    const auto sides = faces_.of(cell);
    const std::int64_t apex = add_apex(cell, sides);
    for (std::size_t f = 0; f < sides.size(); ++f) {
      ring_.clear();
      for (const VertexId v : surface_.ring(f)) ring_.push_back(v.value());
      if (ring_.size() < 5) {
        add_piece(cell, ring_, apex);
        continue;
      }
      const std::int64_t middle = middle_of(sides[f].face);
      for (std::size_t i = 0; i < ring_.size(); ++i)
        add_piece(cell, std::array{ring_[i], ring_[(i + 1) % ring_.size()], middle}, apex);
    }
  }

  std::int64_t add_apex(CellId cell, std::span<const CellFace> sides) {
    std::vector<Base> bases;
    for (const CellFace& side : sides) {
      const auto loop = face_points(mesh_, side.face, points_);
      const PolygonGeometry face = polygon_geometry(loop);
      const auto add = [&](const Vec3& point, const Vec3& area) {
        if (area.norm() > 0.0) bases.push_back({point, (side.outward ? 1.0 : -1.0) * area.normalized()});
      };
      if (loop.size() < 5) {
        add(face.mean, face.area_vector);
        continue;
      }
      for (std::size_t i = 0; i < loop.size(); ++i)
        add(face.mean, (loop[i] - face.mean).cross(loop[(i + 1) % loop.size()] - face.mean));
    }
    const Cells& cells = mesh_.cells;
    out_.points.push_back(
        apex_of(bases, cells.center[cell], cells.centroid[cell], std::cbrt(std::max(cells.volume[cell], 0.0))));
    return static_cast<std::int64_t>(out_.points.size()) - 1;
  }

  std::int64_t middle_of(FaceId face) {
    std::int64_t& middle = middle_[face.index()];
    if (middle < 0) {
      middle = static_cast<std::int64_t>(out_.points.size());
      out_.points.push_back(face_geometry(mesh_, face).mean);
    }
    return middle;
  }

  /// The base turns outwards in the frame with z up: inwards in that with depth.
  void add_piece(CellId cell, std::span<const std::int64_t> base, std::int64_t apex) {
    ++out_.pieces;
    std::array<Vec3, 4> corners;
    for (std::size_t i = 0; i < base.size(); ++i) corners[base.size() - 1 - i] = point(base[i]);
    const PolygonGeometry geometry = polygon_geometry(std::span(corners).first(base.size()));
    const double volume = (geometry.mean - point(apex)).dot(geometry.area_vector) / 3.0;
    if (volume <= 0.0) ++out_.pieces_inverted;
    const std::size_t piece = start_piece(cell, volume, 0.75 * geometry.centroid + 0.25 * point(apex));
    // VTK's base looks into the cell.
    std::array<std::int64_t, 5> points{};
    std::reverse_copy(base.begin(), base.end(), points.begin());
    points[base.size()] = apex;
    out_.cells.add(base.size() == 3 ? vtk_tetrahedron : vtk_pyramid, std::span(points).first(base.size() + 1));
    piece_faces_.push_back({key_of(base), piece, geometry.area_vector});
    for (std::size_t i = 0; i < base.size(); ++i) {
      const std::array side{base[i], base[(i + 1) % base.size()], apex};
      const Vec3 a = point(side[0]) - point(apex);
      const Vec3 b = point(side[1]) - point(apex);
      piece_faces_.push_back({key_of(side), piece, 0.5 * a.cross(b)});
    }
  }

  std::size_t start_piece(CellId cell, double volume, const Vec3& centroid) {
    out_.mesh_cell.push_back(cell);
    out_.volume.push_back(volume);
    centroid_.push_back(centroid);
    return centroid_.size() - 1;
  }

  NonOrthogonality piece_angles() {
    std::sort(piece_faces_.begin(), piece_faces_.end(), [](const PieceFace& a, const PieceFace& b) {
      return a.key != b.key ? a.key < b.key : a.piece < b.piece;
    });
    AngleTally tally;
    for (std::size_t n = 1; n < piece_faces_.size(); ++n) {
      const PieceFace& a = piece_faces_[n - 1];
      const PieceFace& b = piece_faces_[n];
      if (a.key == b.key) tally.add(angle_of(a.area, centroid_[b.piece] - centroid_[a.piece]));
    }
    return tally.result();
  }

  const Mesh& mesh_;
  CellFaces faces_;
  std::vector<Shape> shape_;
  std::vector<std::int64_t> middle_;  ///< point of each face, -1 where there is none
  SplitCells out_;
  std::vector<Vec3> centroid_;  ///< of each piece
  std::vector<PieceFace> piece_faces_;
  CellSurface surface_;
  Ring ring_;
  std::vector<Vec3> points_;
};

}  // namespace

SplitCells split_cells(const Mesh& mesh, std::size_t most_sides) { return Splitter(mesh, most_sides).run(); }

}  // namespace wellknit
