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
#include <map>
#include <numeric>
#include <tuple>

namespace wellknit {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// What a vertex of the triangulation is.
struct SiteCode {
  std::int32_t site = -1;   ///< inner: 0 …; outer: inner count + outer index; image: the inner site
  std::int32_t plane = -1;  ///< image in this plane; -1: none
};

using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_3<SiteCode, Kernel, CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using CellBase =
    CGAL::Triangulation_cell_base_with_info_3<std::int32_t, Kernel, CGAL::Regular_triangulation_cell_base_3<Kernel>>;
using Triangulation = CGAL::Regular_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;

/// Below this ratio of determinant to the product of edge lengths a tetrahedron of sites is flat: exact degeneracy
/// shows as the sites' resolution over their distance, 1e-11; generic tetrahedra stay above 1e-5.
constexpr double flat_ratio = 1e-8;
/// Dual points of neighbours closer than this part of their distance to the sites are one vertex: rounding of the sites
/// times the condition of ordinary tetrahedra.
constexpr double merge_ratio = 1e-7;

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
    triangulate();
    number_cells();
    if (diagram_.failure.empty()) compute_duals();
    if (diagram_.failure.empty()) absorb_flat();
    if (diagram_.failure.empty()) group_duals();
    if (diagram_.failure.empty()) extract_faces();
    return std::move(diagram_);
  }

 private:
  using CellHandle = Triangulation::Cell_handle;

  void triangulate() {
    std::vector<std::pair<Kernel::Weighted_point_3, SiteCode>> points;
    const auto add = [&](const Vec3& c, double weight, SiteCode code) {
      points.emplace_back(Kernel::Weighted_point_3(Kernel::Point_3(c.x(), c.y(), c.z()), weight), code);
    };
    for (std::size_t s = 0; s < inner_count_; ++s)
      add(sites_.inner[s].center, sites_.inner[s].weight, {static_cast<std::int32_t>(s), -1});
    for (std::size_t s = 0; s < sites_.outer.size(); ++s)
      add(sites_.outer[s].center, sites_.outer[s].weight, {static_cast<std::int32_t>(inner_count_ + s), -1});
    for (std::size_t p = 0; p < cavity_.planes.size(); ++p)
      for (std::size_t s = 0; s < inner_count_; ++s) {
        Vec3 image = sites_.inner[s].center;
        double& x = image[cavity_.planes[p].axis];
        x = 2.0 * cavity_.planes[p].coordinate - x;
        add(image, sites_.inner[s].weight, {static_cast<std::int32_t>(s), static_cast<std::int32_t>(p)});
      }
    triangulation_.insert(points.begin(), points.end());
  }

  void number_cells() {
    std::vector<std::uint8_t> is_there(inner_count_, 0);
    for (auto v = triangulation_.finite_vertices_begin(); v != triangulation_.finite_vertices_end(); ++v)
      if (v->info().plane < 0 && is_inner(v->info())) is_there[static_cast<std::size_t>(v->info().site)] = 1;
    const auto hidden = std::count(is_there.begin(), is_there.end(), 0);
    if (hidden > 0) diagram_.failure = std::to_string(hidden) + " sites have no cell";
    for (auto c = triangulation_.all_cells_begin(); c != triangulation_.all_cells_end(); ++c) c->info() = -1;
    for (auto c = triangulation_.finite_cells_begin(); c != triangulation_.finite_cells_end(); ++c) {
      if (!touches_inner(c)) continue;
      c->info() = static_cast<std::int32_t>(cells_.size());
      cells_.push_back(c);
    }
  }

  [[nodiscard]] bool is_inner(const SiteCode& code) const {
    return code.plane < 0 && static_cast<std::size_t>(code.site) < inner_count_;
  }

  [[nodiscard]] bool touches_inner(CellHandle c) const {
    for (int i = 0; i < 4; ++i)
      if (is_inner(c->vertex(i)->info())) return true;
    return false;
  }

  /// The cavity vertices on a site's sphere; an image has those of its site that lie on the plane.
  [[nodiscard]] std::vector<std::int32_t> sphere_list(const SiteCode& code) const {
    const auto site = static_cast<std::size_t>(code.site);
    const auto& list = site < inner_count_ ? sites_.inner[site].on_sphere : sites_.outer[site - inner_count_].on_sphere;
    if (code.plane < 0) return list;
    const MirrorPlane& plane = cavity_.planes[static_cast<std::size_t>(code.plane)];
    std::vector<std::int32_t> on_plane;
    for (const auto v : list)
      if (cavity_.vertices[static_cast<std::size_t>(v)].reference[plane.axis] == plane.coordinate)
        on_plane.push_back(v);
    return on_plane;
  }

  [[nodiscard]] std::int32_t common_vertex(CellHandle c) const {
    std::vector<std::int32_t> common = sphere_list(c->vertex(0)->info());
    for (int i = 1; i < 4 && !common.empty(); ++i) {
      const auto list = sphere_list(c->vertex(i)->info());
      std::vector<std::int32_t> both;
      std::set_intersection(common.begin(), common.end(), list.begin(), list.end(), std::back_inserter(both));
      common = std::move(both);
    }
    return common.empty() ? -1 : common.front();
  }

  /// Planes that the dual lies on: a site and its own image are both at the tetrahedron.
  static std::uint8_t planes_of(CellHandle c) {
    std::uint8_t planes = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const SiteCode& a = c->vertex(i)->info();
        const SiteCode& b = c->vertex(j)->info();
        if (a.plane < 0 && b.plane >= 0 && a.site == b.site)
          planes = static_cast<std::uint8_t>(planes | (1U << static_cast<unsigned>(b.plane)));
      }
    return planes;
  }

  static Dual dual_of(CellHandle c) {
    std::array<Vec3, 4> p;
    std::array<double, 4> w;
    for (int i = 0; i < 4; ++i) {
      const auto& q = c->vertex(i)->point();
      p[static_cast<std::size_t>(i)] = {q.x(), q.y(), q.z()};
      w[static_cast<std::size_t>(i)] = q.weight();
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
      const std::int32_t anchor = common_vertex(cells_[c]);
      dual = dual_of(cells_[c]);
      dual.planes = planes_of(cells_[c]);
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
        for (int i = 0; i < 4; ++i) {
          const std::int32_t n = cells_[c]->neighbor(i)->info();
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
      for (int i = 0; i < 4; ++i) {
        const std::int32_t n = cells_[c]->neighbor(i)->info();
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

  void extract_faces() {
    double largest = 0.0;
    bool is_reversed = false;  // of CGAL's circulation, told by the largest polygon
    for (auto e = triangulation_.finite_edges_begin();
         e != triangulation_.finite_edges_end() && diagram_.failure.empty(); ++e) {
      auto a = e->first->vertex(e->second);
      auto b = e->first->vertex(e->third);
      if (!is_inner(a->info()) && !is_inner(b->info())) continue;
      std::vector<std::int32_t> loop;
      auto c = triangulation_.incident_cells(*e);
      const auto end = c;
      do {
        if (c->info() < 0) {
          diagram_.failure = "a cell is not bounded";
          return;
        }
        loop.push_back(vertex_of_[static_cast<std::size_t>(c->info())]);
      } while (++c != end);
      // Which end comes first and where the circulation starts depends on addresses: both are set by our own numbers.
      if (!is_inner(a->info()) || (is_inner(b->info()) && b->info().site < a->info().site)) {
        std::swap(a, b);
        std::reverse(loop.begin(), loop.end());
      }
      start_at_least(loop);
      reduce(loop);
      if (loop.size() < 3) continue;
      const Vec3 area = area_vector(loop);
      if (area.norm() > largest) {
        largest = area.norm();
        const auto& p = a->point();
        const auto& q = b->point();
        is_reversed = area.dot(Vec3(q.x() - p.x(), q.y() - p.y(), q.z() - p.z())) < 0.0;
      }
      add_face(std::move(loop), a->info(), b->info());
    }
    if (is_reversed)
      for (DiagramFace& f : diagram_.faces) std::reverse(f.loop.begin(), f.loop.end());
    const auto key = [](const DiagramFace& f) { return std::tie(f.cell, f.other_kind, f.other, f.loop); };
    std::sort(diagram_.faces.begin(), diagram_.faces.end(),
              [&](const DiagramFace& f, const DiagramFace& g) { return key(f) < key(g); });
  }

  /// Rotates a loop to the first of its rotations in lexicographical order.
  static void start_at_least(std::vector<std::int32_t>& loop) {
    std::vector<std::int32_t> best = loop;
    for (std::size_t i = 1; i < loop.size(); ++i) {
      std::rotate(loop.begin(), loop.begin() + 1, loop.end());
      if (loop < best) best = loop;
    }
    loop = std::move(best);
  }

  [[nodiscard]] Vec3 area_vector(const std::vector<std::int32_t>& loop) const {
    std::vector<Vec3> points;
    for (const auto v : loop) points.push_back(diagram_.vertices[static_cast<std::size_t>(v)]);
    return polygon_geometry(points).area_vector;
  }

  void add_face(std::vector<std::int32_t> loop, const SiteCode& cell, const SiteCode& other) {
    DiagramFace face;
    face.loop = std::move(loop);
    face.cell = cell.site;
    if (other.plane >= 0) {
      face.other_kind = DiagramFace::Other::plane;
      face.other = other.plane;
      if (other.site != cell.site) diagram_.failure = "a site and the image of another have a common face";
    } else if (is_inner(other)) {
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
  Triangulation triangulation_;
  std::vector<CellHandle> cells_;        ///< finite ones with an inner site
  std::vector<Dual> duals_;              ///< per cell
  std::vector<std::int32_t> vertex_of_;  ///< per cell
  PowerDiagram diagram_;
};

}  // namespace

PowerDiagram build_power_diagram(const Cavity& cavity, const Sites& sites) {
  return DiagramBuilder(cavity, sites).build();
}

BoundaryMatch match_boundary(const Cavity& cavity, const Sites& sites, const PowerDiagram& diagram) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> face_of;
  for (std::size_t f = 0; f < cavity.faces.size(); ++f)
    face_of.emplace(std::pair(sites.inner_of[f], sites.outer_of[f]), static_cast<std::int32_t>(f));
  BoundaryMatch match;
  double volume = 0.0;
  for (const DiagramFace& face : diagram.faces) {
    std::vector<Vec3> points;
    for (const auto v : face.loop) points.push_back(diagram.vertices[static_cast<std::size_t>(v)]);
    const PolygonGeometry g = polygon_geometry(points);
    if (face.other_kind != DiagramFace::Other::inner) volume += g.mean.dot(g.area_vector) / 3.0;
    std::int32_t boundary = -1;
    if (face.other_kind == DiagramFace::Other::outer) {
      const auto at = face_of.find(std::pair(face.cell, face.other));
      std::vector<std::int32_t> found = face.loop;
      std::sort(found.begin(), found.end());
      if (at != face_of.end()) {
        std::vector<std::int32_t> given = cavity.faces[static_cast<std::size_t>(at->second)].loop;
        std::sort(given.begin(), given.end());
        if (given == found) boundary = at->second;
      }
      boundary >= 0 ? ++match.found : ++match.foreign;
    }
    match.boundary_face.push_back(boundary);
  }
  match.volume_error = std::abs(volume - cavity.reference_volume) / cavity.reference_volume;
  return match;
}

}  // namespace wellknit
