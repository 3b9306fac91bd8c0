// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/boundary_patches.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace wellknit {

namespace {

/// How far along a row of the grid a cell's neighbours are looked for: wells' cavities are narrower.
constexpr std::int64_t reach = 32;

using Place = std::array<std::int64_t, 3>;  ///< (i, j, k) of a source cell
using Directions = std::array<Vec3, 3>;     ///< along i, j, k

struct Side {
  std::size_t axis = 0;
  bool is_max = false;
};

/// Which source cells are in the mesh, whole or as part of made cells, and where they lie.
class SourceCells {
 public:
  explicit SourceCells(const Mesh& mesh) : mesh_(mesh) {
    const auto& source = mesh.cells.source_cell;
    for (std::size_t c = 0; c < source.size(); ++c)
      if (source[CellId(c)].is_valid()) hosts_.push_back({source[CellId(c)], CellId(c)});
    if (!std::is_sorted(hosts_.begin(), hosts_.end())) std::sort(hosts_.begin(), hosts_.end());
    for (std::size_t axis = 0; axis < 3; ++axis) mean_[axis] = mean_direction(axis);
    complete_means();
  }

  [[nodiscard]] Place place(HostCellId cell) const {
    const auto [nx, ny, nz] = mesh_.source_dimensions;
    const std::int64_t row = std::max<std::int64_t>(nx, 1);
    const std::int64_t layer = row * std::max<std::int64_t>(ny, 1);
    return {cell.value() % row, cell.value() / row % std::max<std::int64_t>(ny, 1), cell.value() / layer};
  }

  /// Invalid outside of the grid.
  [[nodiscard]] HostCellId at(const Place& p) const {
    const auto& n = mesh_.source_dimensions;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (p[axis] < 0 || p[axis] >= n[axis]) return {};
    return HostCellId(p[0] + n[0] * (p[1] + n[1] * p[2]));
  }

  [[nodiscard]] HostCellId behind(const Place& p, Side side) const {
    Place next = p;
    next[side.axis] += side.is_max ? 1 : -1;
    return at(next);
  }

  [[nodiscard]] bool is_in_mesh(HostCellId cell) const {
    const auto& start = mesh_.transfer.start;
    if (cell.index() + 1 < start.size() && start[cell.index()] < start[cell.index() + 1]) return true;
    return host_of(cell).is_valid();
  }

  /// A vector across the cells there, towards the larger index: normal to the rows along the other two axes. Across a
  /// fault rows of centroids jump, but the normal of two of them does not mind the third.
  [[nodiscard]] Vec3 across(const Place& p, std::size_t axis) const {
    const Vec3 normal = direction(p, (axis + 1) % 3).cross(direction(p, (axis + 2) % 3));
    return normal.dot(direction(p, axis)) < 0.0 ? Vec3(-normal) : normal;
  }

 private:
  struct Host {
    HostCellId source;
    CellId cell;
    friend auto operator<=>(const Host&, const Host&) = default;
  };

  /// The first of its cells that are host or refined.
  [[nodiscard]] CellId host_of(HostCellId source) const {
    const auto found = std::lower_bound(hosts_.begin(), hosts_.end(), source,
                                        [](const Host& host, HostCellId wanted) { return host.source < wanted; });
    return found != hosts_.end() && found->source == source ? found->cell : no_cell;
  }

  /// The nearest one along a row, itself left out.
  [[nodiscard]] CellId nearest(Place p, std::size_t axis, std::int64_t step) const {
    for (std::int64_t n = 0; n < reach; ++n) {
      p[axis] += step;
      const HostCellId source = at(p);
      if (!source.is_valid()) return no_cell;
      if (const CellId cell = host_of(source); cell.is_valid()) return cell;
    }
    return no_cell;
  }

  [[nodiscard]] Vec3 direction(const Place& p, std::size_t axis) const {
    CellId low = nearest(p, axis, -1);
    CellId high = nearest(p, axis, 1);
    const CellId own = host_of(at(p));
    if (!low.is_valid()) low = own;
    if (!high.is_valid()) high = own;
    if (!low.is_valid() || !high.is_valid() || low == high) return mean_[axis];
    const Vec3 line = mesh_.cells.centroid[high] - mesh_.cells.centroid[low];
    return line.norm() > 0.0 ? Vec3(line.normalized()) : mean_[axis];
  }

  [[nodiscard]] Vec3 mean_direction(std::size_t axis) const {
    Vec3 sum = Vec3::Zero();
    for (const auto& [source, cell] : hosts_) {
      const HostCellId next = behind(place(source), {axis, true});
      const CellId other = next.is_valid() ? host_of(next) : no_cell;
      if (other.is_valid()) sum += mesh_.cells.centroid[other] - mesh_.cells.centroid[cell];
    }
    return sum.norm() > 0.0 ? Vec3(sum.normalized()) : Vec3(Vec3::Zero());
  }

  /// Axes with one cell only: k points down, and i, j, k make a right-handed triple.
  void complete_means() {
    if (mean_[2].isZero()) mean_[2] = Vec3::UnitZ();
    if (mean_[0].isZero() && mean_[1].isZero()) mean_[0] = Vec3::UnitX();
    if (mean_[0].isZero()) mean_[0] = mean_[1].cross(mean_[2]).normalized();
    if (mean_[1].isZero()) mean_[1] = mean_[2].cross(mean_[0]).normalized();
  }

  const Mesh& mesh_;
  std::vector<Host> hosts_;  ///< sorted
  Directions mean_;
};

/// The side of its source cell that each boundary face is on.
class BoundarySides {
 public:
  BoundarySides(const Mesh& mesh, const SourceCells& sources, const std::vector<FaceId>& boundary)
      : mesh_(mesh), sources_(sources), slot_(mesh.cells.size(), -1) {
    for (const FaceId face : boundary) {
      const CellId cell = mesh.faces.cells[face][0];
      if (slot_[cell.index()] < 0) {
        slot_[cell.index()] = static_cast<std::int64_t>(around_.size());
        around_.emplace_back();
      }
      around_[static_cast<std::size_t>(slot_[cell.index()])].faces.push_back(face);
    }
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const auto& [a, b] = mesh.faces.cells[FaceId(f)];
      if (!b.is_valid()) continue;
      add_inner_face(FaceId(f), a, b, 1.0);
      add_inner_face(FaceId(f), b, a, -1.0);
    }
  }

  /// Of a cell's boundary faces, in the order of faces_of(). `p` is the place of one of the source cells it stands for.
  [[nodiscard]] std::vector<Side> sides(CellId cell, const Place& p) const {
    const Around& around = around_[static_cast<std::size_t>(slot_[cell.index()])];
    const Directions across = directions_across(around, p);
    std::vector<std::optional<Side>> found(around.faces.size());
    // A corner-point cell has one top and one base: what no other cell covers is one boundary face.
    const bool is_whole = mesh_.cells.kind[cell] == CellKind::host && !around.beside_made;
    for (const bool is_max : {false, true}) {
      if (!is_whole || around.covered[is_max ? 1 : 0]) continue;
      std::optional<std::size_t> best;
      for (std::size_t n = 0; n < found.size(); ++n)
        if (!found[n] && (!best || cosine(cell, around.faces[n], across[2], is_max) >
                                       cosine(cell, around.faces[*best], across[2], is_max)))
          best = n;
      if (best) found[*best] = Side{2, is_max};
    }
    std::vector<Side> out;
    for (std::size_t n = 0; n < found.size(); ++n)
      out.push_back(found[n] ? *found[n] : nearest_side(cell, around, n, across, is_whole ? 2 : 3));
    return out;
  }

  [[nodiscard]] const std::vector<FaceId>& faces_of(CellId cell) const {
    return around_[static_cast<std::size_t>(slot_[cell.index()])].faces;
  }

 private:
  /// What surrounds a cell with boundary faces.
  struct Around {
    std::vector<FaceId> faces;                                    ///< on the boundary
    Directions normal{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  ///< of the faces to its neighbours along an axis
    std::array<bool, 2> covered{};                                ///< its top, its base by a cell of its column
    bool beside_made = false;
  };

  void add_inner_face(FaceId face, CellId cell, CellId other, double sign) {
    if (slot_[cell.index()] < 0 || !mesh_.cells.source_cell[cell].is_valid()) return;
    Around& around = around_[static_cast<std::size_t>(slot_[cell.index()])];
    if (!mesh_.cells.source_cell[other].is_valid()) {
      around.beside_made = true;
      return;
    }
    const Place here = sources_.place(mesh_.cells.source_cell[cell]);
    const Place there = sources_.place(mesh_.cells.source_cell[other]);
    const bool same_i = here[0] == there[0];
    const bool same_j = here[1] == there[1];
    if (same_i == same_j && (!same_i || here[2] == there[2])) return;  // no neighbours, or parts of one cell
    const std::size_t axis = !same_i ? 0 : !same_j ? 1 : 2;
    const bool is_max = there[axis] > here[axis];
    around.normal[axis] += (is_max ? sign : -sign) * face_geometry(mesh_, face).area_vector;
    if (axis == 2) around.covered[is_max ? 1 : 0] = true;
  }

  [[nodiscard]] Directions directions_across(const Around& around, const Place& p) const {
    Directions out;
    for (std::size_t axis = 0; axis < 3; ++axis)
      out[axis] = (around.normal[axis].isZero() ? sources_.across(p, axis) : around.normal[axis]).normalized();
    return out;
  }

  /// Between a boundary face's normal and the way out of a side.
  [[nodiscard]] double cosine(CellId cell, FaceId face, const Vec3& across, bool is_max) const {
    const PolygonGeometry geometry = face_geometry(mesh_, face);
    const Vec3 normal = geometry.area > 0.0 ? Vec3(geometry.area_vector / geometry.area)
                                            : Vec3((geometry.mean - mesh_.cells.centroid[cell]).normalized());
    return is_max ? normal.dot(across) : -normal.dot(across);
  }

  [[nodiscard]] Side nearest_side(CellId cell, const Around& around, std::size_t n, const Directions& across,
                                  std::size_t axes) const {
    Side best;
    double most = -2.0;
    for (std::size_t axis = 0; axis < axes; ++axis)
      for (const bool is_max : {false, true}) {
        const double value = cosine(cell, around.faces[n], across[axis], is_max);
        if (value <= most || (axis == 2 && around.covered[is_max ? 1 : 0])) continue;
        most = value;
        best = {axis, is_max};
      }
    return best;
  }

  const Mesh& mesh_;
  const SourceCells& sources_;
  std::vector<std::int64_t> slot_;  ///< of each cell in around_; -1: it has no boundary face
  std::vector<Around> around_;
};

/// The point of a polyline nearest to a point, and its direction there.
struct PathPoint {
  Vec3 point;
  Vec3 tangent;
};

std::optional<PathPoint> nearest_on_path(const std::vector<Vec3>& path, const Vec3& p) {
  std::optional<PathPoint> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vec3 line = path[i + 1] - path[i];
    if (line.isZero()) continue;
    const double t = std::clamp((p - path[i]).dot(line) / line.squaredNorm(), 0.0, 1.0);
    const Vec3 point = path[i] + t * line;
    if ((p - point).squaredNorm() >= least) continue;
    least = (p - point).squaredNorm();
    best = {point, line.normalized()};
  }
  return best;
}

class Classifier {
 public:
  explicit Classifier(const Mesh& mesh) : mesh_(mesh), sources_(mesh) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      if (!mesh.faces.cells[FaceId(f)][1].is_valid()) boundary_.push_back(FaceId(f));
    mark_bore_walls();
    mark_twins();
    collect_sources_of_made_cells();
    has_pinch_gap_.resize(mesh.cells.size(), false);
    for (std::size_t n = 0; n < mesh.connections.size(); ++n) {
      const ConnectionId c(n);
      if (mesh.connections.kind[c] != ConnectionKind::pinch_out || mesh.connections.face[c].is_valid()) continue;
      for (const CellId cell : mesh.connections.cells[c]) has_pinch_gap_[cell.index()] = true;
    }
  }

  std::vector<BoundaryPatch> patches() {
    std::vector<BoundaryPatch> all;
    for (const char* name : {"i_min", "i_max", "j_min", "j_max", "k_min", "k_max", "fault", "inactive", "gap"})
      all.push_back({name, {}});
    std::vector<std::string> names;
    for (const MeshWell& well : mesh_.wells) names.push_back("bore_" + well.name);
    for (std::string& name : plain_words(names)) all.push_back({std::move(name), {}});
    all.push_back({"other", {}});
    const std::vector<std::size_t> place = patch_of_faces();
    for (const FaceId face : boundary_) all[place[face.index()]].faces.push_back(face);
    std::erase_if(all, [](const BoundaryPatch& patch) { return patch.faces.empty(); });
    return all;
  }

 private:
  static constexpr std::size_t fault = 6;
  static constexpr std::size_t inactive = 7;
  static constexpr std::size_t gap = 8;
  static constexpr std::size_t first_bore = 9;

  [[nodiscard]] CellId cell_of(FaceId face) const { return mesh_.faces.cells[face][0]; }

  /// The wall of a radial mesh's first ring; its faces at the ends of the tube look along the well instead.
  [[nodiscard]] bool is_bore_wall(FaceId face) const {
    const CellId cell = cell_of(face);
    if (mesh_.cells.kind[cell] != CellKind::radial || mesh_.cells.radial_index[cell].ring != 0) return false;
    if (!mesh_.cells.well[cell].is_valid()) return false;
    const PolygonGeometry geometry = face_geometry(mesh_, face);
    const auto at = nearest_on_path(mesh_.wells[mesh_.cells.well[cell]].trajectory.points, geometry.centroid);
    if (!at) return true;
    const Vec3 outwards = geometry.centroid - at->point;
    return std::abs(geometry.area_vector.dot(outwards)) >
           std::abs(geometry.area_vector.dot(at->tangent)) * outwards.norm();
  }

  void mark_bore_walls() {
    const auto is_radial = [](CellKind kind) { return kind == CellKind::radial; };
    if (std::none_of(mesh_.cells.kind.begin(), mesh_.cells.kind.end(), is_radial)) return;
    bore_of_vertex_.resize(mesh_.vertices.size());
    for (const FaceId face : boundary_) {
      if (!is_bore_wall(face)) continue;
      for (const VertexId v : mesh_.faces.loop(face)) bore_of_vertex_[v.index()] = mesh_.cells.well[cell_of(face)];
    }
  }

  /// A bore's wall, or a face that closes its end: all of its vertices are the wall's.
  [[nodiscard]] WellId bore_of(FaceId face) const {
    if (bore_of_vertex_.empty()) return {};
    const auto loop = mesh_.faces.loop(face);
    const WellId well = bore_of_vertex_[loop.front().index()];
    const auto same = [&](VertexId v) { return bore_of_vertex_[v.index()] == well; };
    return std::all_of(loop.begin(), loop.end(), same) ? well : WellId();
  }

  /// Pairs of boundary faces with the same vertices: cells that touch and are not connected.
  void mark_twins() {
    std::vector<std::pair<std::vector<VertexId>, FaceId>> sorted;
    for (const FaceId face : boundary_) {
      const auto loop = mesh_.faces.loop(face);
      sorted.push_back({{loop.begin(), loop.end()}, face});
      std::sort(sorted.back().first.begin(), sorted.back().first.end());
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i + 1 < sorted.size(); ++i)
      if (sorted[i].first == sorted[i + 1].first) twins_.insert({sorted[i].second, sorted[i + 1].second});
  }

  void collect_sources_of_made_cells() {
    std::vector<bool> wanted(mesh_.cells.size(), false);
    for (const FaceId face : boundary_)
      wanted[cell_of(face).index()] = !mesh_.cells.source_cell[cell_of(face)].is_valid();
    const auto& [start, cell, fraction] = mesh_.transfer;
    for (std::size_t s = 0; s + 1 < start.size(); ++s)
      for (auto n = static_cast<std::size_t>(start[s]); n < static_cast<std::size_t>(start[s + 1]); ++n)
        if (wanted[cell[n].index()]) made_from_.push_back({cell[n], HostCellId(s)});
    std::sort(made_from_.begin(), made_from_.end());
  }

  struct MadeFrom {
    CellId cell;
    HostCellId source;
    friend auto operator<=>(const MadeFrom&, const MadeFrom&) = default;
  };

  /// The source cells that a cell stands for.
  [[nodiscard]] std::vector<HostCellId> sources_of(CellId cell) const {
    if (const HostCellId source = mesh_.cells.source_cell[cell]; source.is_valid()) return {source};
    std::vector<HostCellId> out;
    const MadeFrom first{cell, HostCellId()};
    for (auto at = std::lower_bound(made_from_.begin(), made_from_.end(), first);
         at != made_from_.end() && at->cell == cell; ++at)
      out.push_back(at->source);
    return out;
  }

  /// By face; those between two cells have none.
  [[nodiscard]] std::vector<std::size_t> patch_of_faces() const {
    const std::size_t other = first_bore + mesh_.wells.size();
    std::vector<std::size_t> out(mesh_.faces.size(), other);
    const BoundarySides sides(mesh_, sources_, boundary_);
    for (const FaceId boundary_face : boundary_) {
      const CellId cell = cell_of(boundary_face);
      const std::vector<FaceId>& faces = sides.faces_of(cell);
      if (faces.front() != boundary_face) continue;  // every cell once
      const std::vector<HostCellId> sources = sources_of(cell);
      const std::vector<Side> side =
          sources.empty() ? std::vector<Side>() : sides.sides(cell, sources_.place(sources.front()));
      for (std::size_t n = 0; n < faces.size(); ++n) {
        const WellId well = bore_of(faces[n]);
        out[faces[n].index()] = well.is_valid()   ? first_bore + well.index()
                                : sources.empty() ? other
                                                  : patch_behind(faces[n], sources, side[n]);
      }
    }
    return out;
  }

  [[nodiscard]] std::size_t patch_behind(FaceId face, const std::vector<HostCellId>& sources, Side side) const {
    bool is_bare = false;
    for (const HostCellId source : sources) {
      const HostCellId behind = sources_.behind(sources_.place(source), side);
      if (!behind.is_valid()) return 2 * side.axis + (side.is_max ? 1 : 0);
      is_bare = is_bare || !sources_.is_in_mesh(behind);
    }
    const bool bridged = has_pinch_gap_[cell_of(face).index()] || twins_.contains(face);
    if (side.axis == 2 && (!is_bare || bridged)) return gap;
    return is_bare ? inactive : fault;
  }

  const Mesh& mesh_;
  SourceCells sources_;
  std::vector<FaceId> boundary_;
  std::vector<WellId> bore_of_vertex_;  ///< of the bore's wall; empty without radial cells
  std::vector<MadeFrom> made_from_;     ///< sorted; transition and radial cells on the boundary
  std::set<FaceId> twins_;
  std::vector<bool> has_pinch_gap_;  ///< by cell: connected across a gap
};

bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

std::string plain_word(const std::string& name) {
  std::string out;
  for (const char c : name) out += is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.' ? c : '_';
  return out.empty() || !is_letter(out.front()) ? "W" + out : out;
}

}  // namespace

std::vector<BoundaryPatch> boundary_patches(const Mesh& mesh) { return Classifier(mesh).patches(); }

std::vector<std::string> plain_words(const std::vector<std::string>& names) {
  std::vector<std::string> out;
  std::set<std::string> taken;
  for (const std::string& name : names) {
    std::string word = plain_word(name);
    for (int n = 2; !taken.insert(word).second; ++n) word = fmt::format("{}_{}", plain_word(name), n);
    out.push_back(std::move(word));
  }
  return out;
}

}  // namespace wellknit
