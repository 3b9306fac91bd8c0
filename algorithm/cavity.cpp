// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/cavity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "algorithm/removed_cells.h"

namespace wellknit {

namespace {

using Cell = NearWellCell;
using Node = NearWellCell;

Cell neighbour(const Cell& c, int side) {
  Cell out = c;
  out[static_cast<std::size_t>(side / 2)] += side % 2 == 0 ? -1 : 1;
  return out;
}

/// The four nodes of a side of a cell, in an order around it; side 0, 1 are low and high i, then j, then k.
std::array<Node, 4> side_nodes(const Cell& c, int side) {
  const auto a = static_cast<std::size_t>(side / 2);
  const std::size_t b = (a + 1) % 3;
  const std::size_t d = (a + 2) % 3;
  std::array<Node, 4> nodes;
  static constexpr std::array<std::array<std::int64_t, 2>, 4> around{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (std::size_t q = 0; q < 4; ++q) {
    nodes[q] = c;
    nodes[q][a] += side % 2;
    nodes[q][b] += around[q][0];
    nodes[q][d] += around[q][1];
  }
  return nodes;
}

/// Number of a node; rises as the cells' indices do.
std::int64_t node_index(const NearWellGrid& grid, const Node& n) {
  const auto& d = grid.dimensions();
  return n[0] + (d[0] + 1) * (n[1] + (d[1] + 1) * n[2]);
}

// ---- boundary
// ---------------------------------------------------------------------------------------------------------

/// Real positions of the nodes of the cavity's cells, which must agree.
class HostNodes {
 public:
  explicit HostNodes(const NearWellGrid& grid) : grid_(grid) {}

  /// False when a cell sees another point at one of its corners than an earlier cell did: a fault ends there.
  bool add(const Cell& c) {
    constexpr double same = 1e-5;  // m
    for (int corner = 0; corner < 8; ++corner) {
      const Node n{c[0] + (corner & 1), c[1] + ((corner >> 1) & 1), c[2] + (corner >> 2)};
      const double z = grid_.corner_depth(c, corner);
      const auto [at, is_new] = nodes_.try_emplace(node_index(grid_, n));
      if (is_new)
        at->second = {n, grid_.corner(c, corner)};
      else if (std::abs(at->second.second.z() - z) > same)
        return false;
    }
    return true;
  }
  [[nodiscard]] const Vec3& at(const Node& n) const { return nodes_.at(node_index(grid_, n)).second; }
  /// In order of the nodes.
  [[nodiscard]] std::vector<std::pair<Node, Vec3>> on_outside() const {
    std::vector<std::pair<Node, Vec3>> out;
    for (const auto& [index, node] : nodes_) {
      bool is_on_plane = false;
      for (std::size_t a = 0; a < 3; ++a) is_on_plane |= node.first[a] == 0 || node.first[a] == grid_.dimensions()[a];
      if (is_on_plane) out.push_back(node);
    }
    std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    return out;
  }

 private:
  const NearWellGrid& grid_;
  std::unordered_map<std::int64_t, std::pair<Node, Vec3>> nodes_;
};

/// Collects the boundary of a set of removed cells and tubes.
class BoundaryBuilder {
 public:
  BoundaryBuilder(const HostFrame& frame, const RemovedCells& removed, Cavity& cavity)
      : frame_(frame), removed_(removed), cavity_(cavity) {}

  void build() {
    cavity_.vertices.clear();
    cavity_.faces.clear();
    cavity_.planes.clear();
    for (const Tube& t : cavity_.tubes) tube_vertices_.emplace_back(t.reference.points.size(), -1);
    for (const Cell& c : cavity_.removed)
      for (int side = 0; side < 6; ++side) add_side(c, side);
    for (std::size_t t = 0; t < cavity_.tubes.size(); ++t) add_tube(t);
  }

 private:
  void add_side(const Cell& c, int side) {
    const Cell outside = neighbour(c, side);
    if (removed_.contains(outside)) return;
    if (!removed_.is_inside_grid(outside)) {
      add_plane(side);
      return;
    }
    BoundaryFace face;
    face.kind = BoundaryFaceKind::host;
    face.removed = c;
    face.outside = outside;
    for (const Node& n : side_nodes(c, side)) face.loop.push_back(host_vertex(n));
    const int axis = side / 2;
    const auto half = [&](const Cell& cell) {
      const Box box = frame_.space.box(cell);
      return 0.5 * (box.high[axis] - box.low[axis]);
    };
    face.natural = half(c);
    face.natural_outside = -half(outside);
    const Box box = frame_.space.box(c);
    finish(face, 0.5 * (box.low + box.high));
  }

  std::int32_t host_vertex(const Node& n) {
    const auto [at, is_new] =
        host_vertices_.emplace(node_index(frame_.grid, n), static_cast<std::int32_t>(cavity_.vertices.size()));
    if (is_new) {
      CavityVertex v;
      v.reference = frame_.space.node(n[0], n[1], n[2]);
      v.is_host = true;
      v.node = n;
      cavity_.vertices.push_back(v);
    }
    return at->second;
  }

  void add_plane(int side) {
    const int axis = side / 2;
    const std::int64_t n = frame_.grid.dimensions()[static_cast<std::size_t>(axis)];
    const double coordinate = frame_.space.plane(axis, side % 2 == 0 ? 0 : n);
    const double other = frame_.space.plane(axis, side % 2 == 0 ? n : 0);
    for (const MirrorPlane& p : cavity_.planes)
      if (p.axis == axis && p.coordinate == coordinate) return;
    cavity_.planes.push_back({axis, coordinate, other > coordinate ? 1.0 : -1.0});
  }

  std::int32_t tube_vertex(std::size_t tube, std::size_t point) {
    std::int32_t& id = tube_vertices_[tube][point];
    if (id < 0) {
      id = static_cast<std::int32_t>(cavity_.vertices.size());
      CavityVertex v;
      v.reference = cavity_.tubes[tube].reference.points[point];
      v.real = cavity_.tubes[tube].real.points[point];
      v.tube = tube;
      v.tube_point = point;
      cavity_.vertices.push_back(v);
    }
    return id;
  }

  void add_tube(std::size_t t) {
    const RadialMesh& mesh = cavity_.tubes[t].reference;
    for (int k = 0; k < mesh.segments; ++k)
      for (int s = 0; s < mesh.sectors; ++s) add_lateral(t, k, s);
    if (cavity_.tubes[t].layered) return;
    add_cap(t, 0);
    add_cap(t, mesh.segments);
  }

  void add_lateral(std::size_t t, int k, int s) {
    const RadialMesh& mesh = cavity_.tubes[t].reference;
    BoundaryFace face;
    face.kind = BoundaryFaceKind::lateral;
    face.tube = t;
    face.radial = {k, s, mesh.rings - 1};
    const int outer = mesh.rings;
    for (const auto& [station, sector] :
         {std::pair(k, s), std::pair(k, s + 1), std::pair(k + 1, s + 1), std::pair(k + 1, s)})
      face.loop.push_back(tube_vertex(t, mesh.point_index(station, outer, sector)));
    const double radius = cavity_.tubes[t].reference_radius;
    const double inner = (mesh.point(k, outer - 1, s) - mesh.axis[static_cast<std::size_t>(k)]).norm();
    // The next ring outwards would grow as the outermost one did.
    face.natural = 0.5 * (radius - inner) * radius / std::max(inner, 0.2 * radius);
    face.natural_outside = -0.5 * (radius - inner);
    const Vec3 axis_point = 0.5 * (mesh.axis[static_cast<std::size_t>(k)] + mesh.axis[static_cast<std::size_t>(k) + 1]);
    Vec3 mean = Vec3::Zero();
    for (const auto v : face.loop) mean += cavity_.vertices[static_cast<std::size_t>(v)].reference / 4.0;
    finish(face, mean + (mean - axis_point));
  }

  /// The polar faces of an end: trapezoids, and the polygon of the bore.
  void add_cap(std::size_t t, int station) {
    const RadialMesh& mesh = cavity_.tubes[t].reference;
    const int segment = station == 0 ? 0 : mesh.segments - 1;
    const Vec3& end = mesh.axis[static_cast<std::size_t>(station)];
    const Vec3& next = mesh.axis[static_cast<std::size_t>(station == 0 ? 1 : station - 1)];
    const double half = 0.5 * (end - next).norm();
    const auto add = [&](BoundaryFace face) {
      face.kind = BoundaryFaceKind::cap;
      face.tube = t;
      face.natural = half;
      // Short of the centre of the radial cell's sphere: that passes through the lateral face behind, and two outside
      // sites with power 0 on one face would share it.
      face.natural_outside = -0.6 * half;
      finish(face, end + (end - next));
    };
    for (int ring = 0; ring < mesh.rings; ++ring)
      for (int s = 0; s < mesh.sectors; ++s) {
        BoundaryFace face;
        face.radial = {segment, s, ring};
        for (const auto& [circle, sector] :
             {std::pair(ring, s), std::pair(ring, s + 1), std::pair(ring + 1, s + 1), std::pair(ring + 1, s)})
          face.loop.push_back(tube_vertex(t, mesh.point_index(station, circle, sector)));
        add(std::move(face));
      }
    BoundaryFace bore;
    bore.radial = {segment, -1, -1};
    for (int s = 0; s < mesh.sectors; ++s) bore.loop.push_back(tube_vertex(t, mesh.point_index(station, 0, s)));
    add(std::move(bore));
  }

  /// Circle and normal of a face; `inside` is a point on the cavity's side.
  void finish(BoundaryFace face, const Vec3& inside) {
    std::vector<Vec3> points;
    for (const auto v : face.loop) points.push_back(cavity_.vertices[static_cast<std::size_t>(v)].reference);
    const PolygonGeometry geometry = polygon_geometry(points);
    face.normal = geometry.area_vector.normalized();
    if (face.normal.dot(inside - geometry.mean) < 0.0) {
      face.normal = -face.normal;
      std::reverse(face.loop.begin(), face.loop.end());
    }
    set_circle(face, points, geometry.mean);
    cavity_.faces.push_back(std::move(face));
  }

  /// Circle through the first three well spread vertices; the others lie on it to rounding.
  static void set_circle(BoundaryFace& face, const std::vector<Vec3>& points, const Vec3& mean) {
    if (points.size() == 4 && face.kind == BoundaryFaceKind::host) {
      face.center = mean;  // a rectangle: exact
    } else {
      const std::size_t n = points.size();
      const Vec3 a = points[n / 3] - points[0];
      const Vec3 b = points[(2 * n) / 3] - points[0];
      const Vec3 normal = a.cross(b);
      face.center = points[0] + (a.squaredNorm() * b.cross(normal) + b.squaredNorm() * normal.cross(a)) /
                                    (2.0 * normal.squaredNorm());
    }
    for (const Vec3& p : points) face.radius += (p - face.center).norm() / static_cast<double>(points.size());
  }

  const HostFrame& frame_;
  const RemovedCells& removed_;
  Cavity& cavity_;
  std::unordered_map<std::int64_t, std::int32_t> host_vertices_;  ///< by node_index()
  std::vector<std::vector<std::int32_t>> tube_vertices_;          ///< per tube and point; -1: none yet
};

// ---- rounds
// -----------------------------------------------------------------------------------------------------------

std::vector<std::size_t> all_tubes(const Cavity& cavity) {
  std::vector<std::size_t> tubes(cavity.tubes.size());
  for (std::size_t t = 0; t < tubes.size(); ++t) tubes[t] = t;
  return tubes;
}

double least_t_high(const BoundaryFace& face, const CavityOptions& options) {
  if (face.kind == BoundaryFaceKind::host) return options.least_host_clearance * face.natural;
  // Beside a plane of the grid's outside nothing can be removed to make more room.
  const double part = face.high_vertex < 0 ? options.least_plane_clearance : options.least_radial_clearance;
  return part * std::min(face.natural, face.radius);
}

bool is_good(const BoundaryFace& face, const CavityOptions& options) {
  // Between the bounds both sites must find room: a tenth of the inner one's.
  return face.t_high >= least_t_high(face, options) && face.t_low < 0.9 * std::min(face.t_high, face.natural);
}

/// Removes all cells around a node; an earlier face of the same round may have done so already.
void remove_at_node(const Node& n, RemovedCells& removed) {
  for (int c = 0; c < 8; ++c) removed.add({n[0] - (c & 1), n[1] - ((c >> 1) & 1), n[2] - (c >> 2)});
}

/// The largest distance of a tube's outermost points from its axis.
double widest(const RadialMesh& mesh) {
  double widest = 0.0;
  for (int k = 0; k < mesh.stations(); ++k)
    for (int s = 0; s < mesh.sectors; ++s)
      widest = std::max(widest, (mesh.point(k, mesh.rings, s) - mesh.axis[static_cast<std::size_t>(k)]).norm());
  return widest;
}

/// One face that is not admissible: removes what is in its way. Returns a reason when nothing can be removed.
std::optional<NoCavity> make_room(const Cavity& cavity, const BoundaryFace& face, const CavityOptions& options,
                                  RemovedCells& removed) {
  if (face.kind == BoundaryFaceKind::host) {
    removed.add(face.outside);
    return std::nullopt;
  }
  const bool is_high = face.t_high < least_t_high(face, options);
  const std::int32_t culprit = is_high ? face.high_vertex : face.low_vertex;
  const auto none = [&](std::string reason, std::size_t tube) {
    const double measured_depth =
        cavity.tubes[face.tube].real.measured_depth[static_cast<std::size_t>(face.radial.segment)];
    return NoCavity{std::move(reason), {tube}, false, {{face.tube, measured_depth}}};
  };
  if (culprit < 0) return none("its tube comes too close to the top, base or a side of the grid", face.tube);
  const CavityVertex& v = cavity.vertices[static_cast<std::size_t>(culprit)];
  if (v.is_host) {
    remove_at_node(v.node, removed);
    return std::nullopt;
  }
  if (v.tube == face.tube) return none("its tube comes too close to itself", face.tube);
  const double reach = widest(cavity.tubes[v.tube].real) + widest(cavity.tubes[face.tube].real);
  NoCavity close = none("its tube comes too close to another one", std::max(v.tube, face.tube));
  close.places[0].reach = reach;
  close.places.push_back({v.tube, nearest_place({cavity.tubes[v.tube]}, v.reference).measured_depth, reach});
  return close;
}

std::string cell_name(const NearWellGrid& grid, const Cell& c) {
  const auto [i, j, k] = grid.source().ijk(grid.source_cell(c));
  return fmt::format("({}, {}, {})", i + 1, j + 1, k + 1);
}

NoCavity too_many_rounds(const Cavity& cavity, const RemovedCells& removed) {
  return {fmt::format("no cavity was found in {} rounds of removing cells ({} removed)", cavity.rounds - 1,
                      removed.count()),
          all_tubes(cavity)};
}

/// Why no more cells could be removed. A face that is not admissible and gives no reason asks for a cell, behind it or
/// at a vertex of the boundary, that is still there: it was taken or something keeps it.
NoCavity blocked(const HostFrame& frame, const Cavity& cavity, const RemovedCells& removed) {
  if (!removed.blocked()) return too_many_rounds(cavity, removed);
  const Box box = frame.space.box(*removed.blocked());
  return {fmt::format("a fault, a gap or a place without thickness at cell {} is too close to its tube",
                      cell_name(frame.grid, *removed.blocked())),
          all_tubes(cavity),
          false,
          {nearest_place(cavity.tubes, 0.5 * (box.low + box.high))}};
}

/// Least distance of two segments, by their ends and by the interior minimum.
double segment_distance(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
  const Vec3 u = q - p;
  const Vec3 v = s - r;
  const Vec3 w = p - r;
  const double a = u.squaredNorm();
  const double b = u.dot(v);
  const double c = v.squaredNorm();
  const double det = a * c - b * b;
  const auto on = [](double t) { return std::clamp(t, 0.0, 1.0); };
  double best = std::numeric_limits<double>::infinity();
  const auto trial = [&](double t, double x) { best = std::min(best, (p + on(t) * u - r - on(x) * v).norm()); };
  if (det > 1e-12 * a * c) trial((b * v.dot(w) - c * u.dot(w)) / det, (a * v.dot(w) - b * u.dot(w)) / det);
  trial(0.0, v.dot(w) / c);
  trial(1.0, v.dot(q - r) / c);
  trial(-u.dot(w) / a, 0.0);
  trial(u.dot(s - p) / a, 1.0);
  return best;
}

/// Nodes of the footprint on the mirror planes that no boundary face uses.
void add_plane_nodes(const HostFrame& frame, const HostNodes& nodes, Cavity& cavity) {
  const auto outside = nodes.on_outside();
  if (outside.empty()) return;
  std::set<Node> used;
  for (const CavityVertex& v : cavity.vertices)
    if (v.is_host) used.insert(v.node);
  for (const auto& [n, point] : outside)
    if (!used.contains(n)) cavity.plane_nodes.push_back({frame.space.node(n[0], n[1], n[2]), point});
}

/// Volume of a tube in E_ref: each segment as the prismatoid between its two polygons, faces as fans.
double tube_volume(const RadialMesh& mesh) {
  double volume = 0.0;
  const auto fan = [&](const std::array<Vec3, 4>& p, const Vec3& o) {
    const PolygonGeometry g = polygon_geometry(p);
    return (g.mean - o).dot(g.area_vector) / 3.0;
  };
  for (int k = 0; k < mesh.segments; ++k) {
    const Vec3 o = 0.5 * (mesh.axis[static_cast<std::size_t>(k)] + mesh.axis[static_cast<std::size_t>(k) + 1]);
    double segment = 0.0;
    for (int s = 0; s < mesh.sectors; ++s)
      segment += fan({mesh.point(k, mesh.rings, s), mesh.point(k, mesh.rings, s + 1),
                      mesh.point(k + 1, mesh.rings, s + 1), mesh.point(k + 1, mesh.rings, s)},
                     o);
    for (const int station : {k, k + 1}) {
      std::vector<Vec3> ring;
      for (int s = 0; s < mesh.sectors; ++s) ring.push_back(mesh.point(station, mesh.rings, s));
      const PolygonGeometry g = polygon_geometry(ring);
      segment += (station == k ? -1.0 : 1.0) * (g.mean - o).dot(g.area_vector) / 3.0;
    }
    volume += std::abs(segment);
  }
  return volume;
}

void set_reference_volume(const HostFrame& frame, Cavity& cavity) {
  cavity.reference_volume = 0.0;
  for (const Cell& c : cavity.removed) {
    const Box box = frame.space.box(c);
    cavity.reference_volume += (box.high - box.low).prod();
  }
  for (const Tube& t : cavity.tubes) cavity.reference_volume -= tube_volume(t.reference);
}

/// The box of stations [first, last] of a tube's axis.
Box axis_box(const std::vector<Vec3>& axis, std::size_t first, std::size_t last) {
  Box box{axis[first], axis[first]};
  for (std::size_t k = first + 1; k <= last; ++k) box = {box.low.cwiseMin(axis[k]), box.high.cwiseMax(axis[k])};
  return box;
}

/// Boxes are at least this far apart.
bool is_apart(const Box& a, const Box& b, double distance) {
  return (a.low - b.high).cwiseMax(b.low - a.high).maxCoeff() >= distance;
}

/// Segments of two polylines that come closer than they may.
struct Closer {
  double distance = 0.0;
  std::size_t of_one = 0;
  std::size_t of_two = 0;
};

/// The distance of the first pair of segments of two axes that are closer than `least`.
std::optional<Closer> first_closer(const std::vector<Vec3>& one, const std::vector<Vec3>& two, double least) {
  constexpr std::size_t run = 16;  // segments that are passed over at once
  std::vector<Box> boxes;
  for (std::size_t j = 0; j + 1 < two.size(); j += run)
    boxes.push_back(axis_box(two, j, std::min(j + run, two.size() - 1)));
  const Box whole = axis_box(two, 0, two.size() - 1);
  for (std::size_t i = 0; i + 1 < one.size(); ++i) {
    const Box box = axis_box(one, i, i + 1);
    if (is_apart(box, whole, least)) continue;
    for (std::size_t b = 0; b < boxes.size(); ++b) {
      if (is_apart(box, boxes[b], least)) continue;
      for (std::size_t j = b * run; j + 1 < two.size() && j < (b + 1) * run; ++j)
        if (const double d = segment_distance(one[i], one[i + 1], two[j], two[j + 1]); d < least)
          return Closer{d, i, j};
    }
  }
  return std::nullopt;
}

/// Two tubes that overlap: the later well gives way.
std::optional<NoCavity> overlapping_tubes(const std::vector<Tube>& tubes) {
  for (std::size_t a = 0; a < tubes.size(); ++a)
    for (std::size_t b = a + 1; b < tubes.size(); ++b) {
      const double least = tubes[a].reference_radius + tubes[b].reference_radius;
      if (const auto at = first_closer(tubes[a].reference.axis, tubes[b].reference.axis, least)) {
        const double reach = widest(tubes[a].real) + widest(tubes[b].real);
        return NoCavity{fmt::format("its tube overlaps another one: their paths come within {:.1f} m where the two "
                                    "radii need {:.1f} m",
                                    at->distance, least),
                        {b},
                        false,
                        {{a, tubes[a].real.measured_depth[at->of_one], reach},
                         {b, tubes[b].real.measured_depth[at->of_two], reach}}};
      }
    }
  return std::nullopt;
}

}  // namespace

std::variant<Cavity, NoCavity> build_cavity(const HostFrame& frame, std::vector<Tube> tubes,
                                            const CavityOptions& options) {
  if (auto overlap = overlapping_tubes(tubes)) return *overlap;
  Cavity cavity;
  cavity.tubes = std::move(tubes);
  RemovedCells removed(frame.grid);
  for (std::size_t t = 0; t < cavity.tubes.size(); ++t) {
    remove_cells_at_tube(frame, cavity.tubes[t], removed);
    if (removed.blocked()) {
      NoCavity none = blocked(frame, cavity, removed);
      none.tubes = {t};
      return none;
    }
  }
  const bool in_columns =
      std::all_of(cavity.tubes.begin(), cavity.tubes.end(), [](const Tube& t) { return t.layered; });
  for (const Tube& tube : cavity.tubes) remove_cells_around_tube(frame, tube, options.dilation, in_columns, removed);
  for (cavity.rounds = 1;; ++cavity.rounds) {
    make_closed(frame.grid, in_columns, removed);
    if (cavity.rounds > options.most_rounds) return too_many_rounds(cavity, removed);
    if (removed.count() > options.most_cells)
      return NoCavity{fmt::format("its cavity would swallow {} cells", removed.count()), all_tubes(cavity)};
    cavity.removed = removed.list();
    BoundaryBuilder(frame, removed, cavity).build();
    set_sphere_bounds(cavity.faces, cavity.vertices, cavity.planes);
    const std::int64_t before = removed.count();
    for (const BoundaryFace& f : cavity.faces)
      if (!is_good(f, options))
        if (auto reason = make_room(cavity, f, options, removed)) return *reason;
    if (removed.count() != before) continue;
    if (!std::all_of(cavity.faces.begin(), cavity.faces.end(),
                     [&](const BoundaryFace& f) { return is_good(f, options); }))
      return blocked(frame, cavity, removed);
    break;
  }
  HostNodes nodes(frame.grid);
  for (const Cell& c : cavity.removed)
    if (!nodes.add(c))
      return NoCavity{fmt::format("a fault ends inside its cavity, at cell {}", cell_name(frame.grid, c)),
                      all_tubes(cavity),
                      false,
                      {nearest_place(cavity.tubes, frame.space.box(c).low)}};
  for (CavityVertex& v : cavity.vertices)
    if (v.is_host) v.real = nodes.at(v.node);
  add_plane_nodes(frame, nodes, cavity);
  set_reference_volume(frame, cavity);
  return cavity;
}

TubePlace nearest_place(const std::vector<Tube>& tubes, const Vec3& point, RadialMesh Tube::*mesh) {
  TubePlace best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < tubes.size(); ++t)
    for (std::size_t k = 0; k < (tubes[t].*mesh).axis.size(); ++k)
      if (const double d = ((tubes[t].*mesh).axis[k] - point).squaredNorm(); d < least) {
        least = d;
        best = {t, tubes[t].real.measured_depth[k]};
      }
  return best;
}

void bind_to_host(const NearWellGrid& grid, const RefinementPlan& plan, Cavity& cavity) {
  const HostMesh& host = grid.host();
  const LatticePoint size{plan.unit[0] / grid.parts()[0], plan.unit[1] / grid.parts()[1]};
  std::map<LatticePoint, const RefinedColumn*> refined;
  for (const RefinedColumn& c : plan.columns) refined.emplace(c.low, &c);
  const auto id_of = [&](const Cell& c) {
    const auto at = refined.find({c[0] * size[0], c[1] * size[1]});
    if (at == refined.end()) return grid.source_cell(c);
    const ColumnLayers& layers = plan.layers[static_cast<std::size_t>(at->second->layers)];
    return HostCellId(at->second->first_cell.value() +
                      layers.place_of(grid.layers().cells[static_cast<std::size_t>(c[2])]));
  };
  const bool turned = host.corners.upside_down;
  std::unordered_map<std::int64_t, VertexId> vertices;
  cavity.removed_cells.clear();
  for (const Cell& c : cavity.removed) {
    const HostCellId id = id_of(c);
    cavity.removed_cells.push_back(id);
    // Source cells count their corners in the order of the layers, refined ones downwards.
    const int flip = turned && id.value() < grid.source().cell_count() ? 4 : 0;
    const auto corners = host.corners_of(id);
    for (int corner = 0; corner < 8; ++corner)
      vertices.try_emplace(node_index(grid, {c[0] + (corner & 1), c[1] + ((corner >> 1) & 1), c[2] + (corner >> 2)}),
                           corners[static_cast<std::size_t>(corner ^ flip)]);
  }
  for (CavityVertex& v : cavity.vertices)
    if (v.is_host) {
      v.host = vertices.at(node_index(grid, v.node));
      v.real = host.vertices[v.host];
    }
  for (BoundaryFace& f : cavity.faces)
    if (f.kind == BoundaryFaceKind::host) {
      f.removed_cell = id_of(f.removed);
      f.outside_cell = id_of(f.outside);
    }
}

}  // namespace wellknit
