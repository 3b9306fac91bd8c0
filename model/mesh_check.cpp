// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/mesh_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/mesh_arrays.h"
#include "model/mesh_topology.h"
#include "model/quality.h"

namespace wellknit {

namespace {

bool is_finite(double value) { return std::isfinite(value); }
bool is_finite(const Vec3& value) { return value.allFinite(); }
bool is_finite(const std::array<double, 2>& value) { return std::isfinite(value[0]) && std::isfinite(value[1]); }
template <class T>
bool is_finite(const T&) {
  return true;  // integers
}

/// Put into words only when something is wrong with it.
struct Entity {
  const char* kind;
  std::int64_t id;
};

/// A directed edge of a cell's surface, kept with its smaller vertex first so that both directions sort together.
struct SurfaceEdge {
  VertexId low, high;
  bool rises;  ///< runs from low to high
};

bool operator<(const SurfaceEdge& a, const SurfaceEdge& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; }

class MeshCheck {
 public:
  MeshCheck(const Mesh& mesh, const MeshCheckOptions& options)
      : mesh_(mesh), options_(options), cell_faces_(faces_of_cells(mesh)), geometry_(all_face_geometries(mesh)) {}

  std::vector<Violation> run() {
    finite_values();
    vertices();
    faces();
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      watertight(CellId(c));
      surface(CellId(c));
    }
    stored_volumes();
    connections();
    faces_and_connections();
    wells();
    transfer();
    return std::move(violations_);
  }

 private:
  void add(std::string_view check, std::string entity, std::string detail) {
    violations_.push_back({std::string(check), std::move(entity), std::move(detail)});
  }

  void add(std::string_view check, Entity entity, std::string detail) {
    add(check, fmt::format("{} {}", entity.kind, entity.id), std::move(detail));
  }

  void finite_values() {
    for_each_array(mesh_, [&](std::string_view path, const auto& values) {
      const std::string_view entity = path.starts_with("cells/")         ? "cell"
                                      : path.starts_with("connections/") ? "connection"
                                                                         : "vertex";
      for (std::size_t i = 0; i < values.size(); ++i)
        // A transmissibility has a check of its own.
        if (!is_finite(values[i]) && path != "connections/transmissibility")
          add("value not finite", fmt::format("{} {}", entity, i), fmt::format("in {}", path));
    });
  }

  void vertices() {
    std::vector<bool> used(mesh_.vertices.size(), false);
    for (const VertexId v : mesh_.faces.vertices) used[v.index()] = true;
    for (std::size_t v = 0; v < used.size(); ++v)
      if (!used[v]) add("vertex of no face", fmt::format("vertex {}", v), "");
  }

  void faces() {
    std::vector<VertexId> sorted;
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const auto loop = mesh_.faces.loop(FaceId(f));
      sorted.assign(loop.begin(), loop.end());
      std::sort(sorted.begin(), sorted.end());
      const auto distinct = std::distance(sorted.begin(), std::unique(sorted.begin(), sorted.end()));
      const Entity entity{"face", static_cast<std::int64_t>(f)};
      if (distinct < 3)
        add("face with fewer than 3 distinct vertices", entity, fmt::format("{} of {}", distinct, loop.size()));
      for (std::size_t i = 0; i < loop.size(); ++i)
        if (loop.size() > 1 && loop[i] == loop[(i + 1) % loop.size()])
          add("vertex repeated in a face", entity, fmt::format("vertex {}", loop[i].value()));
      const auto& pair = mesh_.faces.cells[FaceId(f)];
      if (pair[0] == pair[1]) add("face with one cell on both sides", entity, fmt::format("cell {}", pair[0].value()));
    }
  }

  /// Each edge of the cell's surface is used once in each direction.
  void watertight(CellId cell) {
    edges_.clear();
    for (const CellFace& side : cell_faces_.of(cell)) {
      const auto loop = mesh_.faces.loop(side.face);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const VertexId a = loop[i];
        const VertexId b = loop[(i + 1) % loop.size()];
        edges_.push_back({std::min(a, b), std::max(a, b), (a < b) == side.outward});
      }
    }
    std::sort(edges_.begin(), edges_.end());
    std::int64_t open = 0;
    std::int64_t repeated = 0;
    for (auto edge = edges_.begin(); edge != edges_.end();) {
      const auto end = std::upper_bound(edge, edges_.end(), *edge);
      const auto rising = std::count_if(edge, end, [](const SurfaceEdge& e) { return e.rises; });
      const auto falling = std::distance(edge, end) - rising;
      if (rising != falling) ++open;
      if (rising == falling && rising > 1) ++repeated;
      edge = end;
    }
    const Entity entity{"cell", cell.value()};
    if (edges_.empty()) add("cell without faces", entity, "");
    if (open > 0) add("cell not watertight", entity, fmt::format("{} of its edges have no counterpart", open));
    if (repeated > 0) add("edge used more than once in a cell", entity, fmt::format("{} edges", repeated));
  }

  /// Closed, of positive volume, and, for made cells, every face seen from the centre.
  void surface(CellId cell) {
    const bool made = mesh_.cells.kind[cell] >= CellKind::transition;
    Vec3 flux = Vec3::Zero();
    double area = 0.0;
    double volume = 0.0;
    std::int64_t unseen = 0;
    for (const CellFace& side : cell_faces_.of(cell)) {
      const double sign = side.outward ? 1.0 : -1.0;
      const PolygonGeometry& face = geometry_[side.face];
      flux += sign * face.area_vector;
      area += face.area;
      const double pyramid =
          sign / 6.0 * fan_volume6(face_points(mesh_, side.face, points_), face.mean, mesh_.cells.center[cell]);
      volume += pyramid;
      if (!(pyramid > 0.0)) ++unseen;
    }
    volumes_.push_back(volume);
    const Entity entity{"cell", cell.value()};
    const double open = area > 0.0 ? flux.norm() / area : 0.0;
    if (!(open <= options_.open_surface_limit))
      add("open surface", entity, fmt::format("area vectors add up to {:.3g} of the area", open));
    if (!(volume > 0.0)) add("volume not positive", entity, fmt::format("{:.6g} m3 from its faces", volume));
    if (made && unseen > 0)
      add(not_seen_from_centre, entity, fmt::format("{} of {} faces", unseen, cell_faces_.of(cell).size()));
  }

  void stored_volumes() {
    double mean = 0.0;
    for (const double volume : volumes_) mean += volume / static_cast<double>(volumes_.size());
    for (std::size_t c = 0; c < volumes_.size(); ++c) {
      const CellId cell(c);
      const double stored = mesh_.cells.volume[cell];
      const bool made = mesh_.cells.kind[cell] >= CellKind::transition;
      const Entity entity{"cell", static_cast<std::int64_t>(c)};
      if (!(stored > 0.0)) add("stored volume not positive", entity, fmt::format("{:.6g} m3", stored));
      // Slivers below a millionth of the mean cell are measured against that instead of against themselves.
      const double scale = std::max(1e-6 * std::abs(mean), std::abs(volumes_[c]));
      const double difference = std::abs(stored - volumes_[c]) / scale;
      if (!(difference <= (made ? options_.volume_limit : options_.host_volume_limit)))
        add("stored volume differs from the faces'", entity,
            fmt::format("{:.9g} m3 stored, {:.9g} m3 from its faces", stored, volumes_[c]));
    }
  }

  void connections() {
    const Connections& all = mesh_.connections;
    std::vector<std::array<CellId, 2>> faceless;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const ConnectionId id(i);
      const auto& pair = all.cells[id];
      const double t = all.transmissibility[id];
      const Entity entity{"connection", static_cast<std::int64_t>(i)};
      if (pair[0] == pair[1]) add("connection of a cell to itself", entity, fmt::format("cell {}", pair[0].value()));
      if (pair[0] > pair[1])
        add("connection with the larger cell first", entity,
            fmt::format("cells {} and {}", pair[0].value(), pair[1].value()));
      if (!std::isfinite(t) || t < 0.0)
        add("transmissibility negative or not finite", entity, fmt::format("{:.6g} m3", t));
      if (!all.face[id].is_valid()) faceless.push_back(pair);
      const bool needs_face = all.kind[id] == ConnectionKind::face || all.kind[id] == ConnectionKind::fault;
      if (needs_face && !all.face[id].is_valid())
        add("connection without its face", entity, "its kind says that it has one");
    }
    std::sort(faceless.begin(), faceless.end());
    for (std::size_t i = 1; i < faceless.size(); ++i)
      if (faceless[i] == faceless[i - 1])
        add("pair connected twice without a face",
            fmt::format("cells {} and {}", faceless[i][0].value(), faceless[i][1].value()), "");
  }

  void faces_and_connections() {
    std::vector<int> uses(mesh_.faces.size(), 0);
    const double smallest = 1e-6 * median_face_area(geometry_);
    for (std::size_t i = 0; i < mesh_.connections.size(); ++i) {
      const FaceId face = mesh_.connections.face[ConnectionId(i)];
      if (!face.is_valid()) continue;
      ++uses[face.index()];
      const Entity entity{"connection", static_cast<std::int64_t>(i)};
      auto cells = mesh_.faces.cells[face];
      std::sort(cells.begin(), cells.end());
      auto pair = mesh_.connections.cells[ConnectionId(i)];
      std::sort(pair.begin(), pair.end());
      if (cells != pair)
        add("connection and face of different cells", entity,
            fmt::format("face {} lies between {} and {}", face.value(), cells[0].value(), cells[1].value()));
      else if (geometry_[face].area > smallest)
        stored_angle(ConnectionId(i), face);
    }
    for (std::size_t f = 0; f < uses.size(); ++f) {
      const bool inner = mesh_.faces.cells[FaceId(f)][1].is_valid();
      if (inner && uses[f] == 0) add("inner face without a connection", fmt::format("face {}", f), "");
      if (uses[f] > 1)
        add("face with several connections", fmt::format("face {}", f), fmt::format("{} of them", uses[f]));
    }
  }

  void stored_angle(ConnectionId id, FaceId face) {
    const auto& pair = mesh_.faces.cells[face];
    const double angle =
        non_orthogonality(geometry_[face].area_vector, mesh_.cells.center[pair[1]] - mesh_.cells.center[pair[0]]);
    const double stored = mesh_.connections.non_orthogonality[id];
    if (!(std::abs(angle - stored) <= options_.angle_limit))
      add("stored non-orthogonality differs from the face's", fmt::format("connection {}", id.value()),
          fmt::format("{:.6g} degrees stored, {:.6g} from its face", stored, angle));
  }

  void wells() {
    for (const MeshWell& well : mesh_.wells) {
      const std::string entity = fmt::format("well {}", well.name);
      if (well.connections.empty()) add("well without connections", entity, "");
      for (const WellConnection& connection : well.connections)
        if (!std::isfinite(connection.well_index) || connection.well_index <= 0.0)
          add("well index not positive and finite", entity,
              fmt::format("{:.6g} m3 in cell {}", connection.well_index, connection.cell.value()));
    }
  }

  void transfer() {
    const Transfer& map = mesh_.transfer;
    for (std::size_t s = 0; s + 1 < map.start.size(); ++s) {
      if (map.start[s] == map.start[s + 1]) continue;
      double sum = 0.0;
      for (auto i = map.start[s]; i < map.start[s + 1]; ++i) sum += map.fraction[static_cast<std::size_t>(i)];
      if (!(std::abs(sum - 1.0) <= options_.transfer_limit))
        add("fractions of a source cell do not add up to 1", fmt::format("source cell {}", s),
            fmt::format("{:.12g}", sum));
    }
  }

  const Mesh& mesh_;
  const MeshCheckOptions& options_;
  CellFaces cell_faces_;
  IdVector<FaceId, PolygonGeometry> geometry_;
  std::vector<double> volumes_;  ///< of each cell, from its faces, m3
  std::vector<Violation> violations_;
  std::vector<SurfaceEdge> edges_;  ///< of the cell at hand
  std::vector<Vec3> points_;        ///< of the face at hand
};

}  // namespace

std::vector<Violation> check_mesh(const Mesh& mesh, const MeshCheckOptions& options) {
  std::vector<Violation> structure = check_structure(mesh);
  if (!structure.empty()) return structure;
  return MeshCheck(mesh, options).run();
}

}  // namespace wellknit
