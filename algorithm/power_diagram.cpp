// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The triangulation's combinatorics come from CGAL's exact predicates on the sites as given; coordinates of dual points
// are ours. Degeneracy is systematic (method.md §9): a dual point that is a cavity vertex is found from the sites' own
// lists, and a flat tetrahedron, whose dual point means nothing, takes that of a neighbour: the exact diagram does not
// have it.
#include "algorithm/power_diagram.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace wellknit {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// What a point of the triangulation is.
struct SiteCode {
  std::int32_t site = -1;   ///< inner: 0 …; outer: inner count + outer index; image: the inner site
  std::int32_t plane = -1;  ///< image in this plane; -1: none
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel,
                                                               CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using CellBase =
    CGAL::Triangulation_cell_base_with_info_3<std::int32_t, Kernel, CGAL::Regular_triangulation_cell_base_3<Kernel>>;
using Triangulation = CGAL::Regular_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;

/// Below this ratio of determinant to the product of edge lengths a tetrahedron of sites is flat: exact degeneracy
/// shows as the sites' resolution over their distance, 1e-11; generic tetrahedra stay above 1e-5.
constexpr double flat_ratio = 1e-8;
/// Dual points of neighbours closer than this part of their distance to the sites are one vertex: rounding of the sites
/// times the condition of ordinary tetrahedra.
constexpr double merge_ratio = 1e-7;

/// A tetrahedron, copied from the triangulation: what comes after it walks over these, four times smaller than CGAL's.
struct Tetrahedron {
  std::array<std::int32_t, 4> point{};     ///< numbers of its points
  std::array<std::int32_t, 4> neighbor{};  ///< opposite to each; -1: infinite, or without an inner site

  [[nodiscard]] int place_of(std::int32_t p) const {
    return static_cast<int>(std::distance(point.begin(), std::find(point.begin(), point.end(), p)));
  }
};

/// The dual of one tetrahedron.
struct Dual {
  Vec3 point = Vec3::Zero();
  double quality = 0.0;      ///< determinant ratio
  double scale = 0.0;        ///< distance to its sites, m
  std::int32_t anchor = -1;  ///< the cavity vertex that it is
  std::uint8_t planes = 0;   ///< mirror planes that it lies on
  bool is_flat = false;
};

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::size_t find(std::size_t a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void unite(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

class DiagramBuilder {
 public:
  DiagramBuilder(const Cavity& cavity, const Sites& sites)
      : cavity_(cavity), sites_(sites), inner_count_(sites.inner.size()) {}

  PowerDiagram build() {
    collect_points();
    copy_triangulation();
    if (diagram_.failure.empty()) compute_duals();
    if (diagram_.failure.empty()) absorb_flat();
    if (diagram_.failure.empty()) group_duals();
    if (diagram_.failure.empty()) extract_faces();
    return std::move(diagram_);
  }

 private:
  /// Inner sites, outer ones, then the images of the inner ones in each plane.
  void collect_points() {
    points_.reserve(inner_count_ * (1 + cavity_.planes.size()) + sites_.outer.size());
    const auto add = [&](const Vec3& c, double weight) {
      const auto number = static_cast<std::int32_t>(points_.size());
      points_.emplace_back(Kernel::Weighted_point_3(Kernel::Point_3(c.x(), c.y(), c.z()), weight), number);
    };
    for (const Site& s : sites_.inner) add(s.center, s.weight);
    for (const Site& s : sites_.outer) add(s.center, s.weight);
    for (const MirrorPlane& plane : cavity_.planes)
      for (const Site& s : sites_.inner) {
        Vec3 image = s.center;
        image[plane.axis] = 2.0 * plane.coordinate - image[plane.axis];
        add(image, s.weight);
      }
  }

  void copy_triangulation() {
    Triangulation triangulation(points_.begin(), points_.end());
    std::vector<std::uint8_t> is_there(inner_count_, 0);
    for (auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end(); ++v)
      if (is_inner(v->info())) is_there[static_cast<std::size_t>(v->info())] = 1;
    const auto hidden = std::count(is_there.begin(), is_there.end(), 0);
    if (hidden > 0) diagram_.failure = std::to_string(hidden) + " sites have no cell";
    std::vector<Triangulation::Cell_handle> handles;
    handles.reserve(triangulation.tds().number_of_cells());
    cells_.reserve(triangulation.tds().number_of_cells());
    const auto infinite = triangulation.infinite_vertex();
    for (auto c = triangulation.all_cells_begin(); c != triangulation.all_cells_end(); ++c) {
      c->info() = -1;
      if (c->has_vertex(infinite)) continue;
      Tetrahedron t;
      for (int i = 0; i < 4; ++i) t.point[static_cast<std::size_t>(i)] = c->vertex(i)->info();
      if (std::none_of(t.point.begin(), t.point.end(), [&](std::int32_t p) { return is_inner(p); })) continue;
      c->info() = static_cast<std::int32_t>(cells_.size());
      handles.push_back(c);
      cells_.push_back(t);
    }
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (int i = 0; i < 4; ++i) cells_[c].neighbor[static_cast<std::size_t>(i)] = handles[c]->neighbor(i)->info();
  }

  [[nodiscard]] bool is_inner(std::int32_t point) const { return static_cast<std::size_t>(point) < inner_count_; }

  [[nodiscard]] SiteCode code_of(std::int32_t point) const {
    const auto sites = static_cast<std::int32_t>(inner_count_ + sites_.outer.size());
    const auto inner = static_cast<std::int32_t>(inner_count_);
    if (point < sites) return {point, -1};
    return {(point - sites) % inner, (point - sites) / inner};
  }

  [[nodiscard]] Vec3 position(std::int32_t point) const {
    const auto& p = points_[static_cast<std::size_t>(point)].first;
    return {p.x(), p.y(), p.z()};
  }

  /// The cavity vertices on a site's sphere. An image shares those of its site that lie on the plane.
  [[nodiscard]] const std::vector<std::int32_t>& sphere_list(const SiteCode& code) const {
    const auto site = static_cast<std::size_t>(code.site);
    return site < inner_count_ ? sites_.inner[site].on_sphere : sites_.outer[site - inner_count_].on_sphere;
  }

  [[nodiscard]] bool is_on_sphere(const SiteCode& code, std::int32_t vertex) const {
    const auto& list = sphere_list(code);
    if (!std::binary_search(list.begin(), list.end(), vertex)) return false;
    if (code.plane < 0) return true;
    const MirrorPlane& plane = cavity_.planes[static_cast<std::size_t>(code.plane)];
    return cavity_.vertices[static_cast<std::size_t>(vertex)].reference[plane.axis] == plane.coordinate;
  }

  using Codes = std::array<SiteCode, 4>;

  /// The first cavity vertex on the spheres of all four sites, or -1.
  [[nodiscard]] std::int32_t common_vertex(const Codes& codes) const {
    for (const std::int32_t v : sphere_list(codes[0]))
      if (std::all_of(codes.begin(), codes.end(), [&](const SiteCode& code) { return is_on_sphere(code, v); }))
        return v;
    return -1;
  }

  /// Planes that the dual lies on: a site and its own image are both at the tetrahedron.
  static std::uint8_t planes_of(const Codes& codes) {
    std::uint8_t planes = 0;
    for (const SiteCode& a : codes)
      for (const SiteCode& b : codes)
        if (a.plane < 0 && b.plane >= 0 && a.site == b.site)
          planes = static_cast<std::uint8_t>(planes | (1U << static_cast<unsigned>(b.plane)));
    return planes;
  }

  [[nodiscard]] Dual dual_of(const Tetrahedron& t) const {
    std::array<Vec3, 4> p;
    std::array<double, 4> w;
    for (std::size_t i = 0; i < 4; ++i) {
      p[i] = position(t.point[i]);
      w[i] = points_[static_cast<std::size_t>(t.point[i])].first.weight();
    }
    const Vec3 a = p[1] - p[0];
    const Vec3 b = p[2] - p[0];
    const Vec3 d = p[3] - p[0];
    const double det = a.dot(b.cross(d));
    Dual dual;
    dual.quality = std::abs(det) / (a.norm() * b.norm() * d.norm());
    dual.is_flat = !(dual.quality > flat_ratio);
    if (dual.is_flat) return dual;
    const double fa = a.squaredNorm() - w[1] + w[0];
    const double fb = b.squaredNorm() - w[2] + w[0];
    const double fd = d.squaredNorm() - w[3] + w[0];
    const Vec3 y = (fa * b.cross(d) + fb * d.cross(a) + fd * a.cross(b)) / (2.0 * det);
    dual.point = p[0] + y;
    dual.scale = std::max(y.norm(), std::max(a.norm(), std::max(b.norm(), d.norm())));
    return dual;
  }

  void compute_duals() {
    duals_.resize(cells_.size());
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      Dual& dual = duals_[c];
      Codes codes;
      for (std::size_t i = 0; i < 4; ++i) codes[i] = code_of(cells_[c].point[i]);
      const std::int32_t anchor = common_vertex(codes);
      dual = dual_of(cells_[c]);
      dual.planes = planes_of(codes);
      if (anchor < 0) continue;
      dual.anchor = anchor;
      dual.is_flat = false;
      dual.point = cavity_.vertices[static_cast<std::size_t>(anchor)].reference;
      dual.quality = std::numeric_limits<double>::infinity();
    }
  }

  /// Flat tetrahedra take the dual of a neighbour, nearest to a sound one first.
  void absorb_flat() {
    std::vector<std::size_t> flat;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      if (duals_[c].is_flat) flat.push_back(c);
    diagram_.absorbed_flat = static_cast<std::int64_t>(flat.size());
    while (!flat.empty()) {
      std::vector<std::size_t> left;
      std::vector<std::pair<std::size_t, Dual>> taken;
      for (const std::size_t c : flat) {
        const Dual* best = nullptr;
        for (const std::int32_t n : cells_[c].neighbor) {
          if (n < 0 || duals_[static_cast<std::size_t>(n)].is_flat) continue;
          const Dual& candidate = duals_[static_cast<std::size_t>(n)];
          if (best == nullptr || candidate.quality > best->quality) best = &candidate;
        }
        if (best != nullptr)
          taken.emplace_back(c, *best);
        else
          left.push_back(c);
      }
      if (taken.empty()) {
        diagram_.failure = std::to_string(left.size()) + " flat tetrahedra have no sound neighbour";
        return;
      }
      for (const auto& [c, dual] : taken) duals_[c] = dual;
      flat = std::move(left);
    }
  }

  /// One vertex for each group of neighbours with one dual point.
  void group_duals() {
    UnionFind groups(cells_.size());
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (const std::int32_t n : cells_[c].neighbor) {
        if (n < 0) continue;
        const auto other = static_cast<std::size_t>(n);
        if (other < c && is_same(duals_[c], duals_[other])) groups.unite(c, other);
      }
    diagram_.vertices.clear();
    for (const CavityVertex& v : cavity_.vertices) diagram_.vertices.push_back(v.reference);
    diagram_.planes.assign(diagram_.vertices.size(), 0);
    std::vector<std::size_t> best(cells_.size());
    std::vector<std::uint8_t> planes(cells_.size(), 0);
    std::iota(best.begin(), best.end(), 0);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const std::size_t g = groups.find(c);
      if (duals_[c].quality > duals_[best[g]].quality) best[g] = c;
      planes[g] |= duals_[c].planes;
    }
    vertex_of_.assign(cells_.size(), -1);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const std::size_t g = groups.find(c);
      if (g == c) vertex_of_[g] = group_vertex(duals_[best[g]], planes[g]);
      vertex_of_[c] = vertex_of_[g];
    }
  }

  static bool is_same(const Dual& a, const Dual& b) {
    if (a.anchor >= 0 && b.anchor >= 0) return a.anchor == b.anchor;
    return (a.point - b.point).norm() <= merge_ratio * std::max(a.scale, b.scale);
  }

  std::int32_t group_vertex(const Dual& dual, std::uint8_t planes) {
    if (dual.anchor >= 0) return dual.anchor;
    Vec3 p = dual.point;
    for (std::size_t i = 0; i < cavity_.planes.size(); ++i)
      if ((planes >> i) & 1U) p[cavity_.planes[i].axis] = cavity_.planes[i].coordinate;
    diagram_.vertices.push_back(p);
    diagram_.planes.push_back(planes);
    return static_cast<std::int32_t>(diagram_.vertices.size()) - 1;
  }

  /// Removes repeated vertices and spikes (a, b, a): both bound nothing.
  static void reduce(std::vector<std::int32_t>& loop) {
    bool changed = true;
    while (changed && loop.size() > 1) {
      changed = false;
      const std::size_t n = loop.size();
      for (std::size_t i = 0; i < n && !changed; ++i) {
        const std::size_t j = (i + 1) % n;
        if (loop[i] == loop[j]) {
          loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(j));
          changed = true;
        } else if (n > 2 && loop[i] == loop[(i + 2) % n]) {
          const std::size_t k = (i + 2) % n;
          loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(std::max(j, k)));
          loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(std::min(j, k)));
          changed = true;
        }
      }
    }
  }

  /// The dual points around an edge of a tetrahedron; false where the edge belongs to an earlier one.
  bool go_around(std::size_t first, int i, int j, std::vector<std::int32_t>& loop) {
    loop.clear();
    const std::int32_t a = cells_[first].point[static_cast<std::size_t>(i)];
    const std::int32_t b = cells_[first].point[static_cast<std::size_t>(j)];
    const auto is_earlier = [first](std::int32_t n) { return n >= 0 && static_cast<std::size_t>(n) < first; };
    // Most edges are told by the neighbour on the other side.
    if (is_earlier(cells_[first].neighbor[static_cast<std::size_t>(Triangulation::next_around_edge(j, i))]))
      return false;
    std::size_t c = first;
    do {
      loop.push_back(vertex_of_[c]);
      const Tetrahedron& t = cells_[c];
      const int next = Triangulation::next_around_edge(t.place_of(a), t.place_of(b));
      const std::int32_t number = t.neighbor[static_cast<std::size_t>(next)];
      if (number < 0) {
        diagram_.failure = "a cell is not bounded";
        return true;
      }
      if (is_earlier(number)) return false;
      c = static_cast<std::size_t>(number);
    } while (c != first);
    return true;
  }

  void extract_faces() {
    static constexpr std::array<std::array<int, 2>, 6> edges_of_cell{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
    double largest = 0.0;
    bool is_reversed = false;  // of CGAL's circulation, told by the largest polygon
    std::vector<std::int32_t> loop;
    for (std::size_t cell = 0; cell < cells_.size(); ++cell)
      for (const auto& [i, j] : edges_of_cell) {
        std::int32_t a = cells_[cell].point[static_cast<std::size_t>(i)];
        std::int32_t b = cells_[cell].point[static_cast<std::size_t>(j)];
        if (!is_inner(a) && !is_inner(b)) continue;
        if (!go_around(cell, i, j, loop)) continue;
        if (!diagram_.failure.empty()) return;
        // Which end comes first and where the circulation starts depends on addresses: both are set by our own numbers.
        if (b < a) {
          std::swap(a, b);
          std::reverse(loop.begin(), loop.end());
        }
        start_at_least(loop);
        reduce(loop);
        if (loop.size() < 3) continue;
        const Vec3 area = area_vector(loop);
        if (area.norm() > largest) {
          largest = area.norm();
          is_reversed = area.dot(position(b) - position(a)) < 0.0;
        }
        add_face(loop, a, code_of(b));
      }
    if (is_reversed)
      for (DiagramFace& f : diagram_.faces) std::reverse(f.loop.begin(), f.loop.end());
    sort_faces();
  }

  /// By cell, then by what is on the other side, then by loop.
  void sort_faces() {
    std::vector<std::size_t> start(inner_count_ + 1, 0);
    for (const DiagramFace& f : diagram_.faces) ++start[static_cast<std::size_t>(f.cell) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<DiagramFace> sorted(diagram_.faces.size());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for (DiagramFace& f : diagram_.faces) sorted[next[static_cast<std::size_t>(f.cell)]++] = std::move(f);
    const auto key = [](const DiagramFace& f) { return std::tie(f.other_kind, f.other, f.loop); };
    for (std::size_t s = 0; s < inner_count_; ++s)
      std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(start[s]),
                sorted.begin() + static_cast<std::ptrdiff_t>(start[s + 1]),
                [&](const DiagramFace& f, const DiagramFace& g) { return key(f) < key(g); });
    diagram_.faces = std::move(sorted);
  }

  /// Rotates a loop to the first of its rotations in lexicographical order.
  static void start_at_least(std::vector<std::int32_t>& loop) {
    const std::size_t n = loop.size();
    const auto is_less = [&](std::size_t a, std::size_t b) {
      for (std::size_t i = 0; i < n; ++i) {
        const std::int32_t x = loop[(a + i) % n];
        const std::int32_t y = loop[(b + i) % n];
        if (x != y) return x < y;
      }
      return false;
    };
    std::size_t best = 0;
    for (std::size_t i = 1; i < n; ++i)
      if (loop[i] <= loop[best] && is_less(i, best)) best = i;
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(best), loop.end());
  }

  [[nodiscard]] Vec3 area_vector(const std::vector<std::int32_t>& loop) const {
    const auto at = [&](std::size_t i) -> const Vec3& { return diagram_.vertices[static_cast<std::size_t>(loop[i])]; };
    Vec3 area = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) area += 0.5 * (at(i) - at(0)).cross(at(i + 1) - at(0));
    return area;
  }

  void add_face(const std::vector<std::int32_t>& loop, std::int32_t cell, const SiteCode& other) {
    DiagramFace face;
    face.loop = loop;
    face.cell = cell;
    if (other.plane >= 0) {
      face.other_kind = DiagramFace::Other::plane;
      face.other = other.plane;
      if (other.site != cell) diagram_.failure = "a site and the image of another have a common face";
    } else if (is_inner(other.site)) {
      face.other = other.site;
    } else {
      face.other_kind = DiagramFace::Other::outer;
      face.other = other.site - static_cast<std::int32_t>(inner_count_);
    }
    diagram_.faces.push_back(std::move(face));
  }

  const Cavity& cavity_;
  const Sites& sites_;
  std::size_t inner_count_;
  std::vector<std::pair<Kernel::Weighted_point_3, std::int32_t>> points_;  ///< and their own numbers
  std::vector<Tetrahedron> cells_;                                         ///< finite ones with an inner site
  std::vector<Dual> duals_;                                                ///< per cell
  std::vector<std::int32_t> vertex_of_;                                    ///< per cell
  PowerDiagram diagram_;
};

}  // namespace

PowerDiagram build_power_diagram(const Cavity& cavity, const Sites& sites) {
  return DiagramBuilder(cavity, sites).build();
}

BoundaryMatch match_boundary(const Cavity& cavity, const Sites& sites, const PowerDiagram& diagram) {
  using Key = std::tuple<std::int32_t, std::int32_t, std::int32_t>;  // inner site, outer site, face
  std::vector<Key> face_of;
  face_of.reserve(cavity.faces.size());
  for (std::size_t f = 0; f < cavity.faces.size(); ++f)
    face_of.emplace_back(sites.inner_of[f], sites.outer_of[f], static_cast<std::int32_t>(f));
  std::sort(face_of.begin(), face_of.end());
  const auto first_between = [&](std::int32_t inner, std::int32_t outer) {
    const auto at = std::lower_bound(face_of.begin(), face_of.end(), Key(inner, outer, -1));
    const bool is_there = at != face_of.end() && std::get<0>(*at) == inner && std::get<1>(*at) == outer;
    return is_there ? std::get<2>(*at) : -1;
  };
  const auto sorted = [](std::vector<std::int32_t> loop) {
    std::sort(loop.begin(), loop.end());
    return loop;
  };
  BoundaryMatch match;
  match.boundary_face.reserve(diagram.faces.size());
  double volume = 0.0;
  std::vector<Vec3> points;
  for (const DiagramFace& face : diagram.faces) {
    std::int32_t boundary = -1;
    if (face.other_kind != DiagramFace::Other::inner) {
      points.clear();
      for (const auto v : face.loop) points.push_back(diagram.vertices[static_cast<std::size_t>(v)]);
      const PolygonGeometry g = polygon_geometry(points);
      volume += g.mean.dot(g.area_vector) / 3.0;
    }
    if (face.other_kind == DiagramFace::Other::outer) {
      const std::int32_t f = first_between(face.cell, face.other);
      if (f >= 0 && sorted(cavity.faces[static_cast<std::size_t>(f)].loop) == sorted(face.loop)) boundary = f;
      boundary >= 0 ? ++match.found : ++match.foreign;
    }
    match.boundary_face.push_back(boundary);
  }
  match.volume_error = std::abs(volume - cavity.reference_volume) / cavity.reference_volume;
  return match;
}

}  // namespace wellknit
