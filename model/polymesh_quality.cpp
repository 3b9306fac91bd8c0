// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/polymesh_quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "model/mesh_topology.h"

namespace wellknit {

namespace {

/// A face's area vector and its centre, the triangles of the fan weighted with their own areas.
struct FoamFace {
  Vec3 area = Vec3::Zero();
  Vec3 centre = Vec3::Zero();
};

FoamFace foam_face(std::span<const Vec3> loop) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& point : loop) mean += point;
  mean /= static_cast<double>(loop.size());
  FoamFace out;
  double weight = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3& p = loop[i];
    const Vec3& q = loop[(i + 1) % loop.size()];
    const Vec3 triangle = 0.5 * (q - p).cross(mean - p);
    out.area += triangle;
    out.centre += triangle.norm() * (p + q + mean) / 3.0;
    weight += triangle.norm();
  }
  out.centre = weight > 0.0 ? Vec3(out.centre / weight) : mean;
  return out;
}

std::vector<FoamFace> foam_faces(const Mesh& mesh) {
  std::vector<FoamFace> out(mesh.faces.size());
  std::vector<Vec3> points;
  for (std::size_t f = 0; f < out.size(); ++f) out[f] = foam_face(face_points(mesh, FaceId(f), points));
  return out;
}

/// Centroids of the cells, pyramid by pyramid.
std::vector<Vec3> foam_centres(const Mesh& mesh, const std::vector<FoamFace>& faces) {
  const CellFaces sides = faces_of_cells(mesh);
  std::vector<Vec3> out(mesh.cells.size());
  for (std::size_t c = 0; c < out.size(); ++c) {
    const auto of_cell = sides.of(CellId(c));
    Vec3 middle = Vec3::Zero();
    for (const CellFace& side : of_cell) middle += faces[side.face.index()].centre;
    middle /= static_cast<double>(std::max<std::size_t>(of_cell.size(), 1));
    Vec3 moment = Vec3::Zero();
    double volume = 0.0;
    for (const CellFace& side : of_cell) {
      const FoamFace& face = faces[side.face.index()];
      const double pyramid = (side.outward ? 1.0 : -1.0) * face.area.dot(face.centre - middle) / 3.0;
      moment += pyramid * (0.75 * face.centre + 0.25 * middle);
      volume += pyramid;
    }
    out[c] = volume != 0.0 ? Vec3(moment / volume) : middle;
  }
  return out;
}

/// How far the line crosses the face's plane from its centre, over the face's extent in that direction or a share of
/// the line's length.
double skewness(std::span<const Vec3> loop, const FoamFace& face, const Vec3& to_face, const Vec3& line, double share) {
  constexpr double tiny = 1e-150;  // OpenFOAM's ROOTVSMALL, which keeps it from dividing by 0
  const double along = face.area.dot(to_face) / (face.area.dot(line) + tiny);
  const Vec3 miss = to_face - along * line;
  const double distance = miss.norm();
  const Vec3 direction = miss / (distance + tiny);
  double reach = share * line.norm() + tiny;
  for (const Vec3& point : loop) reach = std::max(reach, std::abs(direction.dot(point - face.centre)));
  return distance / reach;
}

double degrees_of(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi; }

}  // namespace

PolymeshQuality polymesh_quality(const Mesh& mesh) {
  const std::vector<FoamFace> faces = foam_faces(mesh);
  const std::vector<Vec3> centres = foam_centres(mesh, faces);
  PolymeshQuality out;
  double cosines = 0.0;
  double smallest_cosine = 1.0;
  std::size_t inner = 0;
  std::vector<Vec3> points;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const FoamFace& face = faces[f];
    const auto& [first, second] = mesh.faces.cells[FaceId(f)];
    const Vec3 to_face = face.centre - centres[first.index()];
    const auto loop = face_points(mesh, FaceId(f), points);
    if (!second.is_valid()) {
      const double area = face.area.norm();
      const Vec3 normal = area > 0.0 ? Vec3(face.area / area) : Vec3(Vec3::Zero());
      out.max_skewness = std::max(out.max_skewness, skewness(loop, face, to_face, normal.dot(to_face) * normal, 0.4));
      continue;
    }
    const Vec3 line = centres[second.index()] - centres[first.index()];
    const double lengths = line.norm() * face.area.norm();
    const double cosine = lengths > 0.0 ? line.dot(face.area) / lengths : 0.0;
    cosines += cosine;
    smallest_cosine = std::min(smallest_cosine, cosine);
    ++inner;
    out.max_skewness = std::max(out.max_skewness, skewness(loop, face, to_face, line, 0.2));
  }
  if (inner == 0) return out;
  out.max_non_orthogonality = degrees_of(smallest_cosine);
  out.mean_non_orthogonality = degrees_of(cosines / static_cast<double>(inner));
  return out;
}

}  // namespace wellknit
