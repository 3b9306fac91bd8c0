// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The mesh steps of one well (cavity, sites, power diagram, mapping, back) beside CGAL's own triangulations of the
/// same points in the same run: the regular one of the sites and their images, the Delaunay one of the cavity's
/// vertices. No program that makes this mesh can do with less than these two.
///
///     near_well_benchmark [SITES…]      default: 1000 10000 100000
///
/// A horizontal well along a gently folded grid of cells of 3 x 3 x 3 m; it grows by its length. Prints processor time
/// on one thread, the least of a few runs, and their ratio.

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "algorithm/cavity_mapping.h"
#include "algorithm/short_edges.h"
#include "algorithm/transition_mesh.h"

namespace wellknit {

namespace {

constexpr double cell = 3.0;                  // m
constexpr std::int64_t across = 16;           // cells
constexpr double sites_for_each_cell = 49.0;  // along the well: 16 sectors and the wall

CornerPointGrid make_grid(std::int64_t along) {
  CornerPointGrid grid;
  grid.dimensions = {along, across, across};
  for (std::int64_t j = 0; j <= across; ++j)
    for (std::int64_t i = 0; i <= along; ++i) {
      const double x = cell * static_cast<double>(i);
      const double y = cell * static_cast<double>(j);
      grid.coord.insert(grid.coord.end(), {x, y, 1000.0, x, y, 2000.0});
    }
  const auto cells = static_cast<std::size_t>(grid.cell_count());
  grid.zcorn.resize(8 * cells);
  grid.active.assign(cells, 1);
  for (std::size_t c = 0; c < cells; ++c) {
    const auto at = grid.ijk(HostCellId(c));
    for (int corner = 0; corner < 8; ++corner) {
      const double x = cell * static_cast<double>(at[0] + (corner & 1));
      const double y = cell * static_cast<double>(at[1] + ((corner >> 1) & 1));
      grid.zcorn[grid.zcorn_index(at, corner & 1, (corner >> 1) & 1, corner >> 2)] =
          1500.0 + 3.0 * std::sin(x / 100.0) * std::cos(y / 80.0) + cell * static_cast<double>(at[2] + (corner >> 2));
    }
  }
  return grid;
}

Well make_well(std::int64_t along) {
  Well well;
  well.name = "H";
  const double length = cell * static_cast<double>(along);
  const double middle = 0.5 * cell * across;
  for (int s = 0; s <= 200; ++s) {
    const double x = length * s / 200.0;
    const double fold = 3.0 * std::sin(x / 100.0) * std::cos(middle / 80.0);
    well.trajectory.points.emplace_back(x, middle + 1.0, 1500.0 + fold + middle + 0.7);
    const auto& p = well.trajectory.points;
    well.trajectory.measured_depth.push_back(
        s == 0 ? 0.0 : well.trajectory.measured_depth.back() + (p.back() - p[p.size() - 2]).norm());
  }
  well.radial.drainage_radius = 8.0;
  well.radial.sectors = 16;
  well.radial.rings = 4;
  well.radial.segments = static_cast<int>(along);
  well.radial.mode = MeshMode::swept;
  return well;
}

/// Processor time of this process, s: other work on the machine does not count.
double now() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class Work>
double seconds(Work&& work) {
  const double begin = now();
  work();
  return now() - begin;
}

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

double peer_seconds(const Cavity& cavity, const Sites& sites) {
  std::vector<Kernel::Weighted_point_3> weighted;
  const auto add = [&](const Vec3& c, double w) { weighted.emplace_back(Kernel::Point_3(c.x(), c.y(), c.z()), w); };
  for (const Site& s : sites.inner) add(s.center, s.weight);
  for (const Site& s : sites.outer) add(s.center, s.weight);
  for (const MirrorPlane& plane : cavity.planes)
    for (const Site& s : sites.inner) {
      Vec3 image = s.center;
      image[plane.axis] = 2.0 * plane.coordinate - image[plane.axis];
      add(image, s.weight);
    }
  std::vector<Kernel::Point_3> points;
  for (const CavityVertex& v : cavity.vertices) points.emplace_back(v.reference.x(), v.reference.y(), v.reference.z());
  return seconds([&] {
    const CGAL::Regular_triangulation_3<Kernel> regular(weighted.begin(), weighted.end());
    const CGAL::Delaunay_triangulation_3<Kernel> delaunay(points.begin(), points.end());
    if (regular.number_of_vertices() + delaunay.number_of_vertices() == 0) std::abort();
  });
}

struct Times {
  double cavity = 1e30;
  double sites = 1e30;
  double diagram = 1e30;
  double short_edges = 1e30;
  double mapping = 1e30;
  double all = 1e30;
  double peer = 1e30;
};

void keep_least(double& least, double value) { least = std::min(least, value); }

template <class T, class Other>
T value_or_stop(std::variant<T, Other> made) {
  if (auto* none = std::get_if<Other>(&made)) {
    fmt::print(stderr, "near_well_benchmark: {}\n", none->reason);
    std::exit(1);
  }
  return std::move(std::get<T>(made));
}

void compare(double wanted) {
  const auto along = static_cast<std::int64_t>(wanted / sites_for_each_cell) + 10;
  const CornerPointGrid grid = make_grid(along);
  const HostMesh host = build_host_mesh(grid);
  const CellLocator locator(grid);
  const NearWellGrid near(grid, host, locator, {1, 1}, ColumnLayers::of_source(grid.dimensions[2]));
  const CellRange region{{0, 0, 0}, grid.dimensions};
  const ReferenceSpace space(near, region);
  const HostFrame frame{near, space};
  const Well well = make_well(along);
  const auto stretches =
      clear_stretches(frame, well, path_in_reference(frame, well), Obstacles(near, space, region), {}, {});
  const Tube tube = value_or_stop(build_swept_tube(frame, well, stretches.at(0)));
  CavityOptions options;
  options.most_cells = grid.cell_count();
  Times t;
  std::size_t sites_made = 0;
  AdjustmentReport adjustment;
  const int runs = wanted < 5e4 ? 3 : 2;
  for (int run = 0; run < runs; ++run) {
    Cavity cavity;
    keep_least(t.cavity, seconds([&] { cavity = value_or_stop(build_cavity(frame, {tube}, options)); }));
    DiagramTrial trial;
    keep_least(t.sites, seconds([&] { trial.sites = place_sites(cavity); }));
    keep_least(t.diagram, seconds([&] {
                 trial.diagram = build_power_diagram(cavity, trial.sites);
                 trial.match = match_boundary(cavity, trial.sites, trial.diagram);
               }));
    keep_least(t.short_edges, seconds([&] {
                 adjustment = {};
                 trial = expand_short_edges(cavity, std::move(trial), adjustment);
               }));
    keep_least(t.mapping, seconds([&] {
                 const CavityMapping mapping(cavity, MappingMethod::automatic);
                 if (mapping.to_real(trial.diagram.vertices).empty()) std::abort();
               }));
    keep_least(t.all,
               seconds([&] { (void)value_or_stop(build_transition_mesh(frame, {tube}, MappingMethod::automatic)); }));
    keep_least(t.peer, peer_seconds(cavity, trial.sites));
    sites_made = trial.sites.inner.size();
  }
  fmt::print(
      "{:>7} sites: all {:.3f} s (cavity {:.3f}, sites {:.3f}, diagram {:.3f}, short edges {:.3f} [{} to {}], mapping "
      "and back {:.3f}); CGAL's two triangulations {:.3f} s; ratio {:.2f}\n",
      sites_made, t.all, t.cavity, t.sites, t.diagram, t.short_edges, adjustment.short_before, adjustment.short_after,
      t.mapping, t.peer, t.all / t.peer);
}

}  // namespace

}  // namespace wellknit

int main(int argc, char** argv) {
  const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  if (argc == 1)
    for (const double sites : {1e3, 1e4, 1e5}) wellknit::compare(sites);
  for (int a = 1; a < argc; ++a) wellknit::compare(std::atof(argv[a]));
}
