// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/host_face_writer.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "algorithm/id_limit.h"

namespace wellknit {

namespace {

constexpr bool exists(const FaceCell& cell) { return cell.state == HostCellState::exists; }

/// Twice the area vector of a quad: its diagonals' product.
Vec3 doubled_area(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { return (c - a).cross(d - b); }

double transmissibility(const FaceCell& from, const FaceCell& to, Axis axis, const Vec3& area) {
  if (!exists(from) || !exists(to)) return 0.0;
  const auto a = static_cast<std::size_t>(axis);
  const double t1 = std::abs(area.dot((*from.conductance)[a]));
  const double t2 = std::abs(area.dot((*to.conductance)[a]));
  return t1 > 0.0 && t2 > 0.0 ? t1 / (t1 + t2) * t2 : 0.0;
}

template <class T>
void append(LargeArray<T>& all, const LargeArray<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

void append_faces(HostFaces& all, const HostFaces& more) {
  require_ids(all.size() + more.size(), "face parts");
  const auto shift = static_cast<std::int64_t>(all.vertices.size());
  std::transform(more.vertex_start.begin() + 1, more.vertex_start.end(), std::back_inserter(all.vertex_start),
                 [&](std::int64_t start) { return start + shift; });
  append(all.vertices, more.vertices);
  append(all.cells.raw(), more.cells.raw());
  append(all.axis.raw(), more.axis.raw());
  append(all.is_fault.raw(), more.is_fault.raw());
  append(all.is_pinch.raw(), more.is_pinch.raw());
  append(all.transmissibility.raw(), more.transmissibility.raw());
}

/// Newell's sum: the area vector of a closed loop does not depend on how it is cut into triangles.
Vec3 HostFaceWriter::loop_area() const {
  const auto begin = static_cast<std::size_t>(faces_.vertex_start.back());
  const std::size_t end = faces_.vertices.size();
  const auto point = [&](std::size_t n) -> const Vec3& { return vertices_[faces_.vertices[n]]; };
  if (end - begin == 4) return 0.5 * doubled_area(point(begin), point(begin + 1), point(begin + 2), point(begin + 3));
  Vec3 doubled = Vec3::Zero();
  const Vec3& first = point(begin);
  for (std::size_t n = begin + 1; n + 1 < end; ++n) doubled += (point(n) - first).cross(point(n + 1) - first);
  return 0.5 * doubled;
}

bool HostFaceWriter::drop_if_empty(const FaceCell& from, const FaceCell& to) {
  const auto begin = static_cast<std::size_t>(faces_.vertex_start.back());
  if (faces_.vertices.size() >= begin + 3 && (exists(from) || exists(to))) return false;
  faces_.vertices.resize(begin);
  return true;
}

void HostFaceWriter::close(const FaceCell& from, const FaceCell& to, Axis axis, bool is_fault, bool is_pinch) {
  if (drop_if_empty(from, to)) return;
  const bool conducts = exists(from) && exists(to) && from.conductance != nullptr;
  add(from, to, axis, is_fault, is_pinch, conducts ? loop_area() : Vec3::Zero());
}

void HostFaceWriter::close_horizon(const FaceCell& from, const FaceCell& to, const std::array<VertexId, 4>& corners,
                                   bool is_pinch) {
  if (drop_if_empty(from, to)) return;
  const auto& [a, b, c, d] = corners;
  add(from, to, Axis::k, false, is_pinch, 0.5 * doubled_area(vertices_[a], vertices_[b], vertices_[c], vertices_[d]));
}

void HostFaceWriter::add(FaceCell from, FaceCell to, Axis axis, bool is_fault, bool is_pinch, const Vec3& area) {
  const auto begin = faces_.vertices.begin() + faces_.vertex_start.back();
  bool reversed = mirrored_;
  if (!exists(from) || (exists(to) && to.id < from.id)) {
    std::swap(from, to);
    reversed = !reversed;
  }
  if (reversed) std::reverse(begin, faces_.vertices.end());
  if (to.state == HostCellState::none) to.id = HostCellId{};
  faces_.vertex_start.push_back(static_cast<std::int64_t>(faces_.vertices.size()));
  faces_.cells.push_back({from.id, to.id});
  faces_.axis.push_back(axis);
  faces_.is_fault.push_back(is_fault ? 1 : 0);
  faces_.is_pinch.push_back(is_pinch ? 1 : 0);
  if (from.conductance != nullptr) faces_.transmissibility.push_back(transmissibility(from, to, axis, area));
}

}  // namespace wellknit
