// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/cavity_mapping.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include "algorithm/untangle.h"

namespace wellknit {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Where a tetrahedron lies.
enum class Side : std::uint8_t { unknown, inside, outside, flat };

struct CellInfo {
  Side side = Side::unknown;
  std::array<std::int32_t, 4> face{-1, -1, -1, -1};  ///< per facet: the boundary face that holds it; -1: none
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel>;
using CellBase = CGAL::Triangulation_cell_base_with_info_3<CellInfo, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Triangulation = Delaunay::Tr_Base;
using CellHandle = Delaunay::Cell_handle;
using VertexHandle = Delaunay::Vertex_handle;

constexpr std::int64_t most_loops = 25;
constexpr int most_sweeps = 12;
constexpr std::size_t most_growth = 2;  ///< of the number of points, by those that are inserted
constexpr double room_for_face = 0.02;  ///< of its radius: what a face's interval of empty spheres must keep

double six_volumes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a);
}

Kernel::Point_3 cgal_point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

/// Interval of empty spheres of a boundary face, with all inserted points.
struct Interval {
  double low = 0.0;
  double high = 0.0;
  std::int32_t face = -1;
};

struct Tetrahedron {
  std::array<std::int32_t, 4> vertex{};
  double reference = 0.0;  ///< six times the volume in E_ref
};

}  // namespace

class CavityMapping::Implementation {
 public:
  Implementation(const Cavity& cavity, MappingMethod method)
      : cavity_(cavity), method_(method), is_left_out_(cavity.plane_nodes.size(), 0) {
    do {
      start();
      insert_boundary();
      if (!label_and_collect()) return;
      report_.inverted_first = count_inverted();
      if (!flip()) return;
    } while (leave_out_plane_nodes());
    if (has_boundary_without_area()) return;
    correct();
    report_.inverted_last = count_inverted();
    report_.tetrahedra = static_cast<std::int64_t>(tetrahedra_.size());
    report_.smallest_ratio = smallest_ratio();
    if (report_.failure.empty() && report_.inverted_last > 0)
      report_.failure = std::to_string(report_.inverted_last) + " tetrahedra of the mapping stay inverted (" +
                        std::to_string(report_.inverted_first) + " at the start, " + std::to_string(report_.loops) +
                        " loops, " + std::to_string(report_.points_inserted) + " points)";
  }

  [[nodiscard]] const MappingReport& report() const { return report_; }

  [[nodiscard]] Vec3 to_real(const Vec3& x) const {
    CellHandle c = mesh_.locate(cgal_point(x), hint_);
    hint_ = c;
    if (is_inside(c)) return interpolate(c, x);
    const CellHandle near = nearest_inside(c, x);
    return near != CellHandle() ? interpolate(near, x) : x;
  }

 private:
  // ---- triangulation ----

  void start() {
    delaunay_.clear();
    hint_ = CellHandle();
    insert_hint_ = CellHandle();
    reference_.clear();
    real_.clear();
    interval_.clear();
    plane_node_of_.clear();
    faces_at_.assign(cavity_.vertices.size(), {});
  }

  void insert_boundary() {
    // The lists of faces at each vertex tell whether a triangle lies in a face.
    for (std::size_t f = 0; f < cavity_.faces.size(); ++f) {
      interval_.push_back({cavity_.faces[f].t_low, cavity_.faces[f].t_high, static_cast<std::int32_t>(f)});
      for (const auto v : cavity_.faces[f].loop)
        faces_at_[static_cast<std::size_t>(v)].push_back(static_cast<std::int32_t>(f));
    }
    std::vector<std::pair<Kernel::Point_3, std::int32_t>> points;
    points.reserve(cavity_.vertices.size());
    for (const CavityVertex& v : cavity_.vertices) {
      points.emplace_back(cgal_point(v.reference), static_cast<std::int32_t>(reference_.size()));
      reference_.push_back(v.reference);
      real_.push_back(v.real);
    }
    delaunay_.insert(points.begin(), points.end());
    fixed_ = reference_.size();
    for (std::size_t n = 0; n < cavity_.plane_nodes.size(); ++n) {
      const PlaneNode& node = cavity_.plane_nodes[n];
      if (is_left_out_[n] != 0) continue;
      if (!reserve_room(node.reference)) {
        is_left_out_[n] = 1;
        ++report_.plane_nodes_left_out;
        continue;
      }
      insert(node.reference, node.real);
      plane_node_of_.push_back(n);
      ++fixed_;
    }
  }

  /// A node of the grid's outside that makes an inverted tetrahedron cannot be helped by points inside: where a layered
  /// tube's circle in E_ref and its real one stand differently to the node, the surface itself is folded. True when
  /// some were found.
  bool leave_out_plane_nodes() {
    bool found = false;
    for (const Tetrahedron& t : tetrahedra_) {
      if (ratio(t) > 0.0) continue;
      for (const auto v : t.vertex) {
        const auto at = static_cast<std::size_t>(v);
        if (at < cavity_.vertices.size() || at >= fixed_) continue;
        auto& left_out = is_left_out_[plane_node_of_[at - cavity_.vertices.size()]];
        report_.plane_nodes_left_out += left_out == 0 ? 1 : 0;
        left_out = 1;
        found = true;
      }
    }
    return found;
  }

  /// A triangle of the boundary without area in the real space (a layer without thickness at the wall) makes a
  /// tetrahedron without volume that no point inside can mend: a plain failure.
  bool has_boundary_without_area() {
    std::int64_t count = 0;
    Vec3 first = Vec3::Zero();
    std::set<std::size_t> tubes;
    for (auto c = mesh_.finite_cells_begin(); c != mesh_.finite_cells_end(); ++c) {
      if (c->info().side != Side::inside) continue;
      for (int i = 0; i < 4; ++i) {
        const std::int32_t f = c->info().face[static_cast<std::size_t>(i)];
        if (f < 0) continue;
        std::array<std::size_t, 3> v{};
        for (int j = 0, n = 0; j < 4; ++j)
          if (j != i) v[static_cast<std::size_t>(n++)] = static_cast<std::size_t>(c->vertex(j)->info());
        const Vec3 a = real_[v[1]] - real_[v[0]];
        const Vec3 b = real_[v[2]] - real_[v[0]];
        const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()});
        // A ten-billionth: coordinates of files are rounded to 1e-3 m, edges are a thousand metres at most.
        if (a.cross(b).norm() > 1e-10 * longest) continue;
        if (count++ == 0) first = real_[v[0]];
        const BoundaryFace& face = cavity_.faces[static_cast<std::size_t>(f)];
        if (face.kind != BoundaryFaceKind::host) tubes.insert(face.tube);
      }
    }
    if (count == 0) return false;
    report_.tubes_at_fault.assign(tubes.begin(), tubes.end());
    return !fail(std::to_string(count) + " triangles of the cavity's boundary have no area, the first near (" +
                 std::to_string(first.x()) + ", " + std::to_string(first.y()) + ", " + std::to_string(first.z()) +
                 "), as where a layer has no thickness at the wall");
  }

  /// Where the inverted tetrahedra are, of which there were never fewer.
  void find_places_at_fault() {
    std::set<std::pair<std::size_t, double>> places;
    for (const Tetrahedron& t : tetrahedra_) {
      if (ratio(t) > 0.0) continue;
      Vec3 middle = Vec3::Zero();
      for (const auto v : t.vertex) middle += 0.25 * reference_[static_cast<std::size_t>(v)];
      const TubePlace place = nearest_place(cavity_.tubes, middle);
      places.emplace(place.tube, place.measured_depth);
    }
    report_.places_at_fault.clear();
    std::set<std::size_t> tubes;
    for (const auto& [tube, measured_depth] : places) {
      report_.places_at_fault.push_back({tube, measured_depth});
      tubes.insert(tube);
    }
    report_.tubes_at_fault.assign(tubes.begin(), tubes.end());
  }

  void insert(const Vec3& reference, const Vec3& real) {
    const auto v = delaunay_.insert(cgal_point(reference), insert_hint_);
    v->info() = static_cast<std::int32_t>(reference_.size());
    insert_hint_ = v->cell();
    reference_.push_back(reference);
    real_.push_back(real);
  }

  /// True when every boundary face stays a Delaunay face with this point added; the faces' bounds are then narrowed.
  /// The sphere at a face's bound is that of a tetrahedron on the face: only faces of tetrahedra in conflict can lose.
  /// Where a vertex stands already there is no room, and no face is broken.
  bool reserve_room(const Vec3& q, std::int32_t* broken = nullptr) {
    std::vector<Interval> narrowed;
    Delaunay::Locate_type type{};
    int i = 0;
    int j = 0;
    const CellHandle start = delaunay_.locate(cgal_point(q), type, i, j, insert_hint_);
    if (type == Delaunay::VERTEX) return false;
    for (const std::int32_t f : faces_in_conflict(q, start)) {
      const BoundaryFace& face = cavity_.faces[static_cast<std::size_t>(f)];
      Interval next = interval_[static_cast<std::size_t>(f)];
      const Vec3 d = q - face.center;
      const double h = face.normal.dot(d);
      const double p = d.squaredNorm() - face.radius * face.radius;
      if (std::abs(h) <= 1e-9 * face.radius) {
        if (p < 0.0) next.high = next.low;
      } else if (h > 0.0) {
        next.high = std::min(next.high, p / (2.0 * h));
      } else {
        next.low = std::max(next.low, p / (2.0 * h));
      }
      // Faces that had little room from the start keep a quarter of it.
      const double room = std::min(room_for_face * face.radius, 0.25 * (face.t_high - face.t_low));
      if (next.high - next.low < room) {
        if (broken != nullptr) *broken = f;
        return false;
      }
      next.face = f;
      narrowed.push_back(next);
    }
    for (const Interval& n : narrowed) interval_[static_cast<std::size_t>(n.face)] = n;
    return true;
  }

  /// Boundary faces with a facet on a tetrahedron whose sphere holds the point, rising.
  [[nodiscard]] std::vector<std::int32_t> faces_in_conflict(const Vec3& q, CellHandle start) const {
    std::vector<std::int32_t> faces;
    std::vector<CellHandle> cells;
    std::vector<Delaunay::Facet> facets;
    delaunay_.find_conflicts(cgal_point(q), start, std::back_inserter(facets), std::back_inserter(cells));
    for (const CellHandle c : cells)
      for (int i = 0; i < 4; ++i)
        if (const std::int32_t f = face_of(c, i); f >= 0) faces.push_back(f);
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
  }

  /// The boundary face that holds all three vertices of a facet, or -1.
  [[nodiscard]] std::int32_t face_of(CellHandle c, int opposite) const {
    std::array<std::int32_t, 3> v{};
    std::size_t n = 0;
    for (int i = 0; i < 4; ++i)
      if (i != opposite) {
        v[n] = c->vertex(i)->info();
        if (static_cast<std::size_t>(v[n]) >= faces_at_.size()) return -1;
        ++n;
      }
    for (const auto f : faces_at_[static_cast<std::size_t>(v[0])]) {
      const auto& b = faces_at_[static_cast<std::size_t>(v[1])];
      const auto& d = faces_at_[static_cast<std::size_t>(v[2])];
      if (std::find(b.begin(), b.end(), f) != b.end() && std::find(d.begin(), d.end(), f) != d.end()) return f;
    }
    return -1;
  }

  /// Labels the tetrahedra from the boundary faces inwards and outwards; false when the boundary is not in the
  /// triangulation.
  bool label_and_collect() {
    mesh_ = delaunay_;
    hint_ = CellHandle();
    std::vector<CellHandle> stack;
    const auto set = [&](CellHandle c, Side side) {
      if (c->info().side == side) return true;
      if (c->info().side != Side::unknown) return false;
      c->info().side = side;
      if (side != Side::flat) stack.push_back(c);
      return true;
    };
    for (auto c = mesh_.finite_cells_begin(); c != mesh_.finite_cells_end(); ++c) c->info().side = Side::unknown;
    for (auto c = mesh_.finite_cells_begin(); c != mesh_.finite_cells_end(); ++c)
      for (int i = 0; i < 4; ++i) {
        const std::int32_t f = face_of(c, i);
        c->info().face[static_cast<std::size_t>(i)] = f;
        if (f < 0) continue;
        if (!set(c, side_of(c, i, f))) return fail("the cavity's boundary is not in the triangulation");
      }
    while (!stack.empty()) {
      const CellHandle c = stack.back();
      stack.pop_back();
      for (int i = 0; i < 4; ++i) {
        const CellHandle n = c->neighbor(i);
        if (mesh_.is_infinite(n) || c->info().face[static_cast<std::size_t>(i)] >= 0) continue;
        if (!set(n, c->info().side)) return fail("the cavity's boundary is not in the triangulation");
      }
    }
    return collect();
  }

  /// Side of face f on which a tetrahedron with a facet in it lies.
  [[nodiscard]] Side side_of(CellHandle c, int opposite, std::int32_t f) const {
    const std::int32_t apex = c->vertex(opposite)->info();
    const BoundaryFace& face = cavity_.faces[static_cast<std::size_t>(f)];
    if (std::find(face.loop.begin(), face.loop.end(), apex) != face.loop.end()) return Side::flat;
    return face.normal.dot(reference_[static_cast<std::size_t>(apex)] - face.center) > 0.0 ? Side::inside
                                                                                           : Side::outside;
  }

  bool collect() {
    tetrahedra_.clear();
    double volume = 0.0;
    for (auto c = mesh_.finite_cells_begin(); c != mesh_.finite_cells_end(); ++c) {
      if (c->info().side != Side::inside) continue;
      Tetrahedron t;
      for (int i = 0; i < 4; ++i) t.vertex[static_cast<std::size_t>(i)] = c->vertex(i)->info();
      t.reference = six_volumes(
          reference_[static_cast<std::size_t>(t.vertex[0])], reference_[static_cast<std::size_t>(t.vertex[1])],
          reference_[static_cast<std::size_t>(t.vertex[2])], reference_[static_cast<std::size_t>(t.vertex[3])]);
      volume += t.reference / 6.0;
      tetrahedra_.push_back(t);
    }
    // A boundary that is not respected shows as volume: the smallest face's tetrahedron is far above this rounding.
    if (std::abs(volume - cavity_.reference_volume) > 1e-8 * cavity_.reference_volume)
      return fail("the tetrahedra do not fill the cavity: " + std::to_string(volume / cavity_.reference_volume - 1.0) +
                  " relative");
    return true;
  }

  bool fail(std::string reason) {
    report_.failure = std::move(reason);
    return false;
  }

  // ---- inverted tetrahedra ----

  [[nodiscard]] const Vec3& real_of(const Tetrahedron& t, std::size_t i) const {
    return real_[static_cast<std::size_t>(t.vertex[i])];
  }

  [[nodiscard]] double ratio(const Tetrahedron& t) const {
    return six_volumes(real_of(t, 0), real_of(t, 1), real_of(t, 2), real_of(t, 3)) /
           std::max(t.reference, least_reference_);
  }

  [[nodiscard]] std::int64_t count_inverted() const {
    return std::count_if(tetrahedra_.begin(), tetrahedra_.end(), [&](const Tetrahedron& t) { return ratio(t) <= 0.0; });
  }

  [[nodiscard]] double smallest_ratio() const {
    double smallest = std::numeric_limits<double>::infinity();
    for (const auto& t : tetrahedra_) smallest = std::min(smallest, ratio(t));
    return smallest;
  }

  void correct() {
    std::int64_t fewest = std::numeric_limits<std::int64_t>::max();
    int stalled = 0;
    const std::size_t first_size = reference_.size();
    while (report_.loops < most_loops) {
      const std::int64_t inverted = count_inverted();
      if (inverted == 0) break;
      stalled = inverted < fewest ? 0 : stalled + 1;
      if (inverted < fewest) find_places_at_fault();
      fewest = std::min(fewest, inverted);
      // Points that breed more inverted tetrahedra than they cure will not end well, and must not grow without bound.
      if (stalled >= 8 || inverted > 2 * fewest + 150 || reference_.size() > most_growth * first_size) break;
      ++report_.loops;
      if (!insert_barycentres()) break;
      if (!label_and_collect()) return;
      untangle();
      if (!flip()) return;
      // Vertices whose own tetrahedra are sound may stand in the way of others: all are spread, then it is tried again.
      if (method_ == MappingMethod::automatic && report_.loops > 1 && count_inverted() > 0) {
        smooth();
        untangle();
        if (!flip()) return;
      }
    }
    if (report_.loops > 0 && method_ == MappingMethod::automatic) smooth();
  }

  /// One point for each inverted tetrahedron; false when none could be placed.
  bool insert_barycentres() {
    std::vector<std::pair<Vec3, Vec3>> points;
    for (const Tetrahedron& t : tetrahedra_) {
      if (ratio(t) > 0.0) continue;
      Vec3 reference = Vec3::Zero();
      Vec3 real = Vec3::Zero();
      for (std::size_t i = 0; i < 4; ++i) {
        reference += 0.25 * reference_[static_cast<std::size_t>(t.vertex[i])];
        real += 0.25 * real_of(t, i);
      }
      points.emplace_back(reference, real);
    }
    std::int64_t placed = 0;
    for (auto& [reference, real] : points) {
      if (!slide_clear(reference, real)) continue;
      insert(reference, real);
      ++placed;
    }
    report_.points_inserted += placed;
    return placed > 0;
  }

  /// Slides a point away from the boundary faces that it would destroy; false when it finds no place.
  bool slide_clear(Vec3& reference, Vec3& real) {
    for (int step = 0; step < 20; ++step) {
      std::int32_t broken = -1;
      if (reserve_room(reference, &broken)) {
        if (step > 0) real = to_real_or(reference, real);
        return true;
      }
      if (broken < 0) return false;
      const BoundaryFace& face = cavity_.faces[static_cast<std::size_t>(broken)];
      reference += 0.15 * face.radius * face.normal;
      const CellHandle c = mesh_.locate(cgal_point(reference), hint_);
      if (mesh_.is_infinite(c) || c->info().side == Side::outside || c->info().side == Side::flat) return false;
    }
    return false;
  }

  [[nodiscard]] Vec3 to_real_or(const Vec3& reference, const Vec3& fallback) const {
    const CellHandle c = mesh_.locate(cgal_point(reference), hint_);
    return mesh_.is_infinite(c) ? fallback : interpolate(c, reference);
  }

  // ---- flips ----

  using Corners = std::array<std::int32_t, 4>;

  static Corners corners_of(CellHandle c) {
    return {c->vertex(0)->info(), c->vertex(1)->info(), c->vertex(2)->info(), c->vertex(3)->info()};
  }

  /// Real volume over the cube of the longest edge: negative when inverted.
  [[nodiscard]] double real_quality(const Corners& t) const {
    const auto at = [&](std::size_t i) -> const Vec3& { return real_[static_cast<std::size_t>(t[i])]; };
    double longest = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) longest = std::max(longest, (at(i) - at(j)).squaredNorm());
    return six_volumes(at(0), at(1), at(2), at(3)) / (longest * std::sqrt(longest));
  }

  [[nodiscard]] double reference_volume(const Corners& t) const {
    const auto at = [&](std::size_t i) -> const Vec3& { return reference_[static_cast<std::size_t>(t[i])]; };
    return six_volumes(at(0), at(1), at(2), at(3));
  }

  /// Tetrahedra that a flip would take away and those that it would make.
  struct Flip {
    CellHandle cell;
    int i = -1;
    int j =
        -1;  ///< -1: the facet opposite to i becomes the edge between its apexes; else the edge i, j becomes a facet
    double gain = 0.0;                   ///< of the smallest real quality
    std::array<VertexHandle, 3> made{};  ///< the edge, or the facet
  };

  /// The least quality that a set of tetrahedra has; minus infinity when one has no volume in E_ref.
  template <class List>
  [[nodiscard]] double least_quality(const List& tetrahedra) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Corners& t : tetrahedra) {
      if (!(reference_volume(t) > least_reference_)) return -std::numeric_limits<double>::infinity();
      least = std::min(least, real_quality(t));
    }
    return least;
  }

  void consider_facet(CellHandle c, int i, Flip& best) const {
    const CellHandle n = c->neighbor(i);
    if (c->info().face[static_cast<std::size_t>(i)] >= 0 || !is_inside(n)) return;
    const VertexHandle apex = mesh_.mirror_vertex(c, i);
    std::vector<Corners> made;
    for (int j = 0; j < 4; ++j) {
      if (j == i) continue;
      Corners t = corners_of(c);
      t[static_cast<std::size_t>(j)] = apex->info();
      made.push_back(t);
    }
    const double before = std::min(real_quality(corners_of(c)), real_quality(corners_of(n)));
    if (const double gain = least_quality(made) - before; gain > best.gain)
      best = {c, i, -1, gain, {c->vertex(i), apex, VertexHandle()}};
  }

  void consider_edge(CellHandle c, int i, int j, Flip& best) const {
    std::vector<VertexHandle> ring;
    double before = std::numeric_limits<double>::infinity();
    const VertexHandle a = c->vertex(i);
    const VertexHandle b = c->vertex(j);
    auto at = mesh_.incident_cells(c, i, j);
    const auto first = at;
    do {
      const CellHandle n = at;
      if (!is_inside(n) || ring.size() == 3) return;
      // The facet that leads on to the next cell around the edge must not be in the boundary.
      const int ia = n->index(a);
      const int ib = n->index(b);
      const int next = CGAL::Triangulation_utils_3::next_around_edge(ia, ib);
      if (n->info().face[static_cast<std::size_t>(next)] >= 0) return;
      const int last = CGAL::Triangulation_utils_3::next_around_edge(ib, ia);
      if (n->info().face[static_cast<std::size_t>(last)] >= 0) return;
      ring.push_back(n->vertex(last));
      before = std::min(before, real_quality(corners_of(n)));
    } while (++at != first);
    if (ring.size() != 3) return;
    std::vector<Corners> made;
    for (const auto& [apex, sign] : {std::pair(a, 1), std::pair(b, -1)}) {
      Corners t{ring[0]->info(), ring[1]->info(), ring[2]->info(), apex->info()};
      if (sign < 0) std::swap(t[0], t[1]);
      made.push_back(t);
    }
    // Which way the ring turns is not known.
    if (reference_volume(made[0]) < 0.0)
      for (Corners& t : made) std::swap(t[0], t[1]);
    if (const double gain = least_quality(made) - before; gain > best.gain)
      best = {c, i, j, gain, {ring[0], ring[1], ring[2]}};
  }

  void relabel(CellHandle c) {
    c->info() = {};
    c->info().side = Side::inside;
    for (int i = 0; i < 4; ++i) c->info().face[static_cast<std::size_t>(i)] = face_of(c, i);
  }

  bool carry_out(const Flip& f) {
    if (f.j < 0) {
      if (!mesh_.flip(f.cell, f.i)) return false;
      CellHandle c;
      int i = 0;
      int j = 0;
      if (!mesh_.is_edge(f.made[0], f.made[1], c, i, j)) return false;
      auto at = mesh_.incident_cells(c, i, j);
      const auto first = at;
      do relabel(at);
      while (++at != first);
      return true;
    }
    if (!mesh_.flip(f.cell, f.i, f.j)) return false;
    CellHandle c;
    int i = 0;
    int j = 0;
    int k = 0;
    if (!mesh_.is_facet(f.made[0], f.made[1], f.made[2], c, i, j, k)) return false;
    const CellHandle n = c->neighbor(6 - i - j - k);
    relabel(c);
    relabel(n);
    return true;
  }

  /// Inverted tetrahedra are mostly slivers of E_ref, whose vertices lie near one circle: other tetrahedra of the same
  /// vertices do as well. Each flip makes the smallest real quality of those that it touches larger. False when the
  /// cavity is no longer filled.
  bool flip() {
    if (method_ == MappingMethod::paper) return true;
    constexpr int most_passes = 20;
    bool has_flipped = false;
    for (int pass = 0; pass < most_passes; ++pass) {
      std::vector<std::array<VertexHandle, 4>> inverted;
      for (auto c = mesh_.finite_cells_begin(); c != mesh_.finite_cells_end(); ++c)
        if (c->info().side == Side::inside && real_quality(corners_of(c)) <= 0.0)
          inverted.push_back({c->vertex(0), c->vertex(1), c->vertex(2), c->vertex(3)});
      bool is_better = false;
      for (const auto& v : inverted) {
        CellHandle c;
        if (!mesh_.is_cell(v[0], v[1], v[2], v[3], c)) continue;
        Flip best;
        for (int i = 0; i < 4; ++i) {
          consider_facet(c, i, best);
          for (int j = 0; j < i; ++j) consider_edge(c, i, j, best);
        }
        if (best.i >= 0 && carry_out(best)) is_better = true;
      }
      has_flipped = has_flipped || is_better;
      if (!is_better) break;
    }
    hint_ = CellHandle();
    return !has_flipped || collect();
  }

  // ---- moving free vertices ----

  void find_balls() {
    balls_.assign(reference_.size() - fixed_, {});
    for (std::size_t t = 0; t < tetrahedra_.size(); ++t)
      for (const auto v : tetrahedra_[t].vertex)
        if (static_cast<std::size_t>(v) >= fixed_) balls_[static_cast<std::size_t>(v) - fixed_].push_back(t);
  }

  /// Volumes around a vertex as functions of its position; `normalised`: over their reference volumes.
  [[nodiscard]] VertexBall ball_of(std::int32_t vertex, const std::vector<std::size_t>& around, bool normalised) const {
    VertexBall ball;
    for (const std::size_t index : around) {
      const Tetrahedron& t = tetrahedra_[index];
      const auto at = static_cast<std::size_t>(
          std::distance(t.vertex.begin(), std::find(t.vertex.begin(), t.vertex.end(), vertex)));
      // Opposite facet, ordered so that its normal times the vertex gives the signed volume.
      static constexpr std::array<std::array<std::size_t, 3>, 4> facets{{{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};
      const Vec3& a = real_of(t, facets[at][0]);
      const Vec3 normal = (real_of(t, facets[at][1]) - a).cross(real_of(t, facets[at][2]) - a);
      const double unit = normalised ? std::max(t.reference, least_reference_) : 1.0;
      ball.gradient.push_back(normal / unit);
      ball.offset.push_back(-normal.dot(a) / unit);
    }
    return ball;
  }

  [[nodiscard]] double smallest_around(const std::vector<std::size_t>& around) const {
    double smallest = std::numeric_limits<double>::infinity();
    for (const std::size_t t : around) smallest = std::min(smallest, ratio(tetrahedra_[t]));
    return smallest;
  }

  void place_best(std::size_t free) {
    const auto vertex = static_cast<std::int32_t>(fixed_ + free);
    const auto& around = balls_[free];
    const VertexBall ball = ball_of(vertex, around, true);
    Vec3& p = real_[static_cast<std::size_t>(vertex)];
    // The mean ratio over the ball does not change with p: no position does better.
    double reference = 0.0;
    double real = 0.0;
    for (std::size_t j = 0; j < around.size(); ++j) {
      const double unit = std::max(tetrahedra_[around[j]].reference, least_reference_);
      reference += unit;
      real += ball.value(j, p) * unit;
    }
    if (real > 0.0) p = largest_smallest_value(ball, real / reference, p);
  }

  void untangle() {
    find_balls();
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      bool moved = false;
      for (std::size_t free = 0; free < balls_.size(); ++free) {
        if (balls_[free].empty() || smallest_around(balls_[free]) > 0.0) continue;
        Vec3& p = real_[fixed_ + free];
        const Vec3 before = p;
        if (method_ == MappingMethod::paper)
          p = paper_position(ball_of(static_cast<std::int32_t>(fixed_ + free), balls_[free], false), p);
        else
          place_best(free);
        moved |= (p - before).norm() > 1e-9 * (1.0 + before.norm());
      }
      if (!moved) break;
    }
  }

  /// All free vertices to where the smallest volume ratio around them is largest.
  void smooth() {
    find_balls();
    for (int sweep = 0; sweep < 5; ++sweep)
      for (std::size_t free = 0; free < balls_.size(); ++free)
        if (!balls_[free].empty()) place_best(free);
  }

  // ---- location ----

  [[nodiscard]] bool is_inside(CellHandle c) const { return !mesh_.is_infinite(c) && c->info().side == Side::inside; }

  [[nodiscard]] std::array<double, 4> barycentric(CellHandle c, const Vec3& x) const {
    std::array<Vec3, 4> p;
    for (int i = 0; i < 4; ++i)
      p[static_cast<std::size_t>(i)] = reference_[static_cast<std::size_t>(c->vertex(i)->info())];
    const double total = six_volumes(p[0], p[1], p[2], p[3]);
    return {six_volumes(x, p[1], p[2], p[3]) / total, six_volumes(p[0], x, p[2], p[3]) / total,
            six_volumes(p[0], p[1], x, p[3]) / total, six_volumes(p[0], p[1], p[2], x) / total};
  }

  [[nodiscard]] Vec3 interpolate(CellHandle c, const Vec3& x) const {
    const auto b = barycentric(c, x);
    Vec3 out = Vec3::Zero();
    for (int i = 0; i < 4; ++i)
      out += b[static_cast<std::size_t>(i)] * real_[static_cast<std::size_t>(c->vertex(i)->info())];
    return out;
  }

  /// For points that rounding puts just outside: the nearest tetrahedron inside that holds the point to rounding, else
  /// of the first few thousand the one that it is least outside of.
  [[nodiscard]] CellHandle nearest_inside(CellHandle start, const Vec3& x) const {
    constexpr double holds = -1e-9;  // barycentric coordinate
    constexpr std::size_t most = 5000;
    std::vector<CellHandle> queue{start};
    std::set<const void*> seen{&*start};
    CellHandle best = nullptr;
    double best_value = -std::numeric_limits<double>::infinity();
    for (std::size_t at = 0; at < queue.size() && at < most && best_value < holds; ++at) {
      const CellHandle c = queue[at];
      if (is_inside(c)) {
        const auto b = barycentric(c, x);
        const double value = *std::min_element(b.begin(), b.end());
        if (value > best_value) {
          best_value = value;
          best = c;
        }
      }
      for (int i = 0; i < 4; ++i)
        if (seen.insert(&*c->neighbor(i)).second) queue.push_back(c->neighbor(i));
    }
    return best;
  }

  const Cavity& cavity_;
  MappingMethod method_;
  MappingReport report_;
  Delaunay delaunay_;        ///< of all points
  Triangulation mesh_;       ///< the same with labels, and with flips
  CellHandle insert_hint_;   ///< in delaunay_
  mutable CellHandle hint_;  ///< in mesh_
  std::vector<std::vector<std::int32_t>> faces_at_;
  std::vector<Interval> interval_;  ///< per boundary face
  std::vector<Vec3> reference_;     ///< per vertex of the triangulation
  std::vector<Vec3> real_;
  std::size_t fixed_ = 0;                   ///< vertices before this one do not move
  std::vector<std::uint8_t> is_left_out_;   ///< per plane node of the cavity
  std::vector<std::size_t> plane_node_of_;  ///< per inserted plane node: its place in the cavity's
  std::vector<Tetrahedron> tetrahedra_;
  std::vector<std::vector<std::size_t>> balls_;  ///< per free vertex
  /// Six volumes, m3, below which a reference tetrahedron counts as this large: a sliver's ratio must not rule its
  /// ball.
  double least_reference_ = 1e-9;
};

CavityMapping::CavityMapping(const Cavity& cavity, MappingMethod method)
    : implementation_(std::make_unique<Implementation>(cavity, method)) {}
CavityMapping::~CavityMapping() = default;
const MappingReport& CavityMapping::report() const { return implementation_->report(); }
Vec3 CavityMapping::to_real(const Vec3& reference) const { return implementation_->to_real(reference); }
std::vector<Vec3> CavityMapping::to_real(std::span<const Vec3> reference) const {
  std::vector<Kernel::Point_3> points;
  points.reserve(reference.size());
  for (const Vec3& p : reference) points.push_back(cgal_point(p));
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  using Traits = CGAL::Spatial_sort_traits_adapter_3<Kernel, CGAL::Pointer_property_map<Kernel::Point_3>::type>;
  CGAL::hilbert_sort(order.begin(), order.end(), Traits(CGAL::make_property_map(points)));
  std::vector<Vec3> real(points.size());
  for (const std::size_t i : order) real[i] = implementation_->to_real(reference[i]);
  return real;
}

}  // namespace wellknit
