// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "tests/support/meshes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "model/mesh_topology.h"
#include "model/quality.h"
#include "model/units.h"

namespace wellknit::meshes {

namespace {

/// A partition of a plane into polygons, each counter-clockwise in (x, y).
struct Plan {
  std::vector<std::array<double, 2>> points;
  std::vector<std::vector<std::size_t>> polygons;
};

/// Index of this point, made when no point is within 1 micrometre: the plans are in metres and their points metres
/// apart.
std::size_t point_of(Plan& plan, double x, double y) {
  for (std::size_t i = 0; i < plan.points.size(); ++i)
    if (std::hypot(plan.points[i][0] - x, plan.points[i][1] - y) < 1e-6) return i;
  plan.points.push_back({x, y});
  return plan.points.size() - 1;
}

void add_polygon(Plan& plan, const std::vector<std::array<double, 2>>& corners) {
  std::vector<std::size_t> polygon;
  for (const auto& [x, y] : corners) polygon.push_back(point_of(plan, x, y));
  plan.polygons.push_back(polygon);
}

/// Prisms over the plan between successive depths: cell = layer * polygons + polygon. Vertices and faces only.
Mesh extruded(const Plan& plan, const std::vector<double>& depths) {
  Mesh mesh;
  for (const double depth : depths)
    for (const auto& [x, y] : plan.points) mesh.vertices.push_back(Vec3(x, y, depth));
  const auto vertex = [&](std::size_t level, std::size_t point) {
    return VertexId(level * plan.points.size() + point);
  };
  const std::size_t layers = depths.size() - 1;
  const auto cell = [&](std::size_t layer, std::size_t polygon) {
    return CellId(layer * plan.polygons.size() + polygon);
  };

  for (std::size_t level = 0; level <= layers; ++level)
    for (std::size_t p = 0; p < plan.polygons.size(); ++p) {
      std::vector<VertexId> loop;
      for (const std::size_t point : plan.polygons[p]) loop.push_back(vertex(level, point));
      if (level == 0) std::reverse(loop.begin(), loop.end());  // out of the first layer is up
      mesh.faces.add(loop, cell(level == 0 ? 0 : level - 1, p),
                     level == 0 || level == layers ? no_cell : cell(level, p));
    }

  std::map<std::array<std::size_t, 2>, std::size_t> owner;  // directed edge to its polygon
  for (std::size_t p = 0; p < plan.polygons.size(); ++p)
    for (std::size_t i = 0; i < plan.polygons[p].size(); ++i)
      owner[{plan.polygons[p][i], plan.polygons[p][(i + 1) % plan.polygons[p].size()]}] = p;
  for (const auto& [edge, p] : owner) {
    const auto [a, b] = edge;
    const auto other = owner.find({b, a});
    if (other != owner.end() && other->second < p) continue;
    for (std::size_t layer = 0; layer < layers; ++layer) {
      // x cross depth is -y: to the right of the edge, out of its polygon.
      const std::array<VertexId, 4> loop{vertex(layer, a), vertex(layer, b), vertex(layer + 1, b),
                                         vertex(layer + 1, a)};
      mesh.faces.add(loop, cell(layer, p), other == owner.end() ? no_cell : cell(layer, other->second));
    }
  }
  return mesh;
}

/// Sets every per-cell array from the faces, with properties that differ from cell to cell.
void fill_cells(Mesh& mesh, std::size_t count) {
  Cells& cells = mesh.cells;
  cells.kind.resize(count, CellKind::host);
  const CellFaces faces = faces_of_cells(mesh);
  const auto geometry = all_face_geometries(mesh);
  std::vector<Vec3> buffer;
  for (std::size_t c = 0; c < count; ++c) {
    Vec3 middle = Vec3::Zero();  // any point inside
    for (const CellFace& side : faces.of(CellId(c)))
      middle += geometry[side.face].mean / static_cast<double>(faces.of(CellId(c)).size());
    double volume = 0.0;
    Vec3 moment = Vec3::Zero();
    for (const CellFace& side : faces.of(CellId(c))) {
      const PolygonGeometry& face = geometry[side.face];
      // All faces are planar: a pyramid's centroid lies a quarter of the way from its base's centroid to its top.
      const double pyramid =
          (side.outward ? 1.0 : -1.0) / 6.0 * fan_volume6(face_points(mesh, side.face, buffer), face.mean, middle);
      volume += pyramid;
      moment += pyramid * (0.75 * face.centroid + 0.25 * middle);
    }
    const double variation = static_cast<double>(c % 7);
    const double porosity = 0.1 + 0.02 * variation;
    const double net_to_gross = 1.0 - 0.05 * variation;
    cells.centroid.push_back(moment / volume);
    cells.center.push_back(moment / volume);
    cells.volume.push_back(volume);
    cells.depth.push_back(moment.z() / volume);
    cells.source_cell.push_back(HostCellId(c));
    cells.well.push_back(WellId());
    cells.radial_index.push_back(RadialIndex{});
    cells.porosity.push_back(porosity);
    cells.net_to_gross.push_back(net_to_gross);
    cells.pore_volume.push_back(volume * porosity * net_to_gross);
    cells.permeability.push_back(Vec3(100.0, 100.0, 10.0) * (1.0 + 0.3 * variation) * m2_per_millidarcy);
  }
}

double half_transmissibility(const Vec3& permeability, const Vec3& normal, double area, const Vec3& to_face) {
  return area * normal.dot(permeability.cwiseProduct(to_face)) / to_face.squaredNorm();
}

/// One connection for each inner face, smaller cell first, with two-point transmissibilities.
void fill_connections(Mesh& mesh) {
  Connections& out = mesh.connections;
  std::vector<Vec3> buffer;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    auto [a, b] = mesh.faces.cells[FaceId(f)];
    if (!b.is_valid()) continue;
    const PolygonGeometry face = face_geometry(mesh, FaceId(f));
    Vec3 normal = face.area_vector / face.area;
    if (a > b) {
      std::swap(a, b);
      normal = -normal;
    }
    const Vec3 from_a = face.centroid - mesh.cells.center[a];
    const Vec3 from_b = face.centroid - mesh.cells.center[b];
    const Vec3 k_a = mesh.cells.permeability[a];
    const Vec3 k_b = mesh.cells.permeability[b];
    const double t_a = half_transmissibility(k_a, normal, face.area, from_a);
    const double t_b = half_transmissibility(k_b, -normal, face.area, from_b);
    out.cells.push_back({a, b});
    out.face.push_back(FaceId(f));
    out.transmissibility.push_back(1.0 / (1.0 / t_a + 1.0 / t_b));
    out.area.push_back(face.area);
    out.normal.push_back(normal);
    out.half_distance.push_back({from_a.norm(), from_b.norm()});
    out.non_orthogonality.push_back(non_orthogonality(normal, mesh.cells.center[b] - mesh.cells.center[a]));
    out.k_non_orthogonality.push_back(std::max(non_orthogonality(k_a.cwiseProduct(normal), from_a),
                                               non_orthogonality(k_b.cwiseProduct(-normal), from_b)));
    out.planarity.push_back(planarity(face_points(mesh, FaceId(f), buffer), face));
    out.kind.push_back(ConnectionKind::face);
    out.multiplier.push_back(1.0);
  }
}

void add_faceless_connection(Mesh& mesh, CellId a, CellId b, double transmissibility) {
  Connections& out = mesh.connections;
  out.cells.push_back({a, b});
  out.face.push_back(FaceId());
  out.transmissibility.push_back(transmissibility);
  out.area.push_back(0.0);
  out.normal.push_back(Vec3::Zero());
  out.half_distance.push_back({0.0, 0.0});
  out.non_orthogonality.push_back(0.0);
  out.k_non_orthogonality.push_back(0.0);
  out.planarity.push_back(0.0);
  out.kind.push_back(ConnectionKind::deck_nnc);
  out.multiplier.push_back(0.5);
}

/// A vertical well of these cells, which lie one below the other, 5 m each.
MeshWell vertical_well(const std::string& name, const Mesh& mesh, const std::vector<CellId>& cells, double well_index) {
  MeshWell well;
  well.name = name;
  well.bore_radius = 0.1;
  well.drainage_radius = 0.0;
  const Vec3 top = mesh.cells.center[cells.front()];
  const Vec3 bottom = mesh.cells.center[cells.back()];
  well.trajectory.measured_depth = {100.0, 100.0 + bottom.z() - top.z() + 5.0};
  well.trajectory.points = {top - Vec3(0, 0, 2.5), bottom + Vec3(0, 0, 2.5)};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double from = 100.0 + 5.0 * static_cast<double>(i);
    well.connections.push_back({cells[i], well_index * (1.0 + 0.1 * static_cast<double>(i)), {from, from + 5.0}});
  }
  return well;
}

void identity_transfer(Mesh& mesh) {
  const std::int64_t n = mesh.source_dimensions[0] * mesh.source_dimensions[1] * mesh.source_dimensions[2];
  for (std::int64_t s = 0; s <= n; ++s)
    mesh.transfer.start.push_back(std::min(s, static_cast<std::int64_t>(mesh.cells.size())));
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    mesh.transfer.cell.push_back(CellId(c));
    mesh.transfer.fraction.push_back(1.0);
  }
}

using Corners = std::vector<std::array<double, 2>>;

Corners rectangle(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

constexpr int sectors = 8;

double azimuth(int corner) { return (corner - 0.5) * 2.0 * std::numbers::pi / sectors; }

std::array<double, 2> on_circle(double radius, int corner) {
  return {radius * std::cos(azimuth(corner)), radius * std::sin(azimuth(corner))};
}

/// Where the ray through a corner of the sectors leaves the square |x|, |y| <= half.
std::array<double, 2> on_square(double half, int corner) {
  const double c = std::cos(azimuth(corner));
  const double s = std::sin(azimuth(corner));
  // Exactly on the side: a polygon with a vertex 1e-16 m inside of an edge would not be convex.
  if (std::abs(c) > std::abs(s)) return {std::copysign(half, c), half * s / std::abs(c)};
  return {half * c / std::abs(s), std::copysign(half, s)};
}

/// Polygons 0-7 the inner ring, 8-15 the outer, 16-23 transition, 24-31 host from the corner (-12, -12).
Plan ring_plan() {
  Plan plan;
  constexpr std::array<double, 3> radii{0.5, 1.2, 3.0};
  for (std::size_t ring = 0; ring < 2; ++ring)
    for (int s = 0; s < sectors; ++s)
      add_polygon(plan, {on_circle(radii[ring], s), on_circle(radii[ring + 1], s), on_circle(radii[ring + 1], s + 1),
                         on_circle(radii[ring], s + 1)});
  for (int s = 0; s < sectors; ++s) {
    Corners polygon{on_circle(3.0, s), on_square(4.0, s)};
    if (s % 2 == 1)
      polygon.push_back({std::copysign(4.0, std::cos(azimuth(s) + std::numbers::pi / sectors)),
                         std::copysign(4.0, std::sin(azimuth(s) + std::numbers::pi / sectors))});
    polygon.push_back(on_square(4.0, s + 1));
    polygon.push_back(on_circle(3.0, s + 1));
    add_polygon(plan, polygon);
  }
  const double split = 4.0 * std::tan(std::numbers::pi / sectors);
  add_polygon(plan, rectangle(-12, -12, -4, -4));
  add_polygon(plan, {{-4, -12}, {4, -12}, {4, -4}, {split, -4}, {-split, -4}, {-4, -4}});
  add_polygon(plan, rectangle(4, -12, 12, -4));
  add_polygon(plan, {{4, -4}, {12, -4}, {12, 4}, {4, 4}, {4, split}, {4, -split}});
  add_polygon(plan, rectangle(4, 4, 12, 12));
  add_polygon(plan, {{-4, 12}, {-4, 4}, {-split, 4}, {split, 4}, {4, 4}, {4, 12}});
  add_polygon(plan, rectangle(-12, 4, -4, 12));
  add_polygon(plan, {{-12, 4}, {-12, -4}, {-4, -4}, {-4, -split}, {-4, split}, {-4, 4}});
  return plan;
}

}  // namespace

Mesh two_boxes() {
  Plan plan;
  add_polygon(plan, rectangle(0, 0, 1, 1));
  add_polygon(plan, rectangle(1, 0, 3, 1));
  Mesh mesh = extruded(plan, {0.0, 1.0});
  fill_cells(mesh, 2);
  for (Vec3& k : mesh.cells.permeability) k = Vec3::Constant(100.0 * m2_per_millidarcy);
  fill_connections(mesh);
  mesh.source_dimensions = {2, 1, 1};
  identity_transfer(mesh);
  return mesh;
}

Mesh box_grid(std::int64_t n) {
  Plan plan;
  for (std::int64_t j = 0; j < n; ++j)
    for (std::int64_t i = 0; i < n; ++i) {
      const auto x = static_cast<double>(10 * i);
      const auto y = static_cast<double>(20 * j);
      add_polygon(plan, rectangle(x, y, x + 10, y + 20));
    }
  std::vector<double> depths;
  for (std::int64_t k = 0; k <= n; ++k) depths.push_back(2000.0 + 5.0 * static_cast<double>(k));
  Mesh mesh = extruded(plan, depths);
  const auto count = static_cast<std::size_t>(n * n * n);
  fill_cells(mesh, count);
  fill_connections(mesh);
  add_faceless_connection(mesh, CellId(0), CellId(count - 1), 1e-14);

  std::vector<std::int32_t> region;
  std::vector<double> saturation;
  for (std::size_t c = 0; c < count; ++c) {
    region.push_back(static_cast<std::int32_t>(c % 3) - 1);
    saturation.push_back(0.2 + 0.5 / (1.0 + static_cast<double>(c)));
  }
  mesh.cells.properties["FIPNUM"] = region;
  mesh.cells.properties["SWAT"] = saturation;

  std::vector<CellId> first;
  std::vector<CellId> last;
  for (std::int64_t k = 0; k < n; ++k) {
    first.emplace_back(k * n * n);
    last.emplace_back((k + 1) * n * n - 1);
  }
  mesh.wells.push_back(vertical_well("INJ", mesh, first, 3e-13));
  mesh.wells.push_back(vertical_well("PROD", mesh, last, 2e-13));
  mesh.wells.raw().front().type = WellType::injector;
  mesh.wells.raw().front().reference_depth = 1990.0;
  mesh.source_dimensions = {n, n, n};
  mesh.mapaxes = {0.0, 100.0, 0.0, 0.0, 100.0, 0.0};
  mesh.source_units = UnitSystem::field;
  identity_transfer(mesh);
  return mesh;
}

Mesh ring_in_boxes() {
  Mesh mesh = extruded(ring_plan(), {1500.0, 1505.0, 1510.0});
  constexpr std::size_t in_layer = 32;
  fill_cells(mesh, 2 * in_layer);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const CellId cell(c);
    const std::size_t place = c % in_layer;
    const bool radial = place < 2 * sectors;
    mesh.cells.kind[cell] = radial ? CellKind::radial : place < 3 * sectors ? CellKind::transition : CellKind::host;
    // The source grid is 3 x 3 x 2; the cells of the middle column were replaced.
    const std::array<std::int64_t, 8> around{0, 1, 2, 5, 8, 7, 6, 3};
    mesh.cells.source_cell[cell] =
        place < 24 ? HostCellId() : HostCellId(around[place - 24] + 9 * static_cast<std::int64_t>(c / in_layer));
    if (!radial) continue;
    mesh.cells.well[cell] = WellId(0);
    mesh.cells.radial_index[cell] = {static_cast<std::int32_t>(c / in_layer),
                                     static_cast<std::int32_t>(place % sectors),
                                     static_cast<std::int32_t>(place / sectors)};
  }
  fill_connections(mesh);

  MeshWell producer = vertical_well("P", mesh, {CellId(0), CellId(in_layer)}, 1.0);
  producer.drainage_radius = 3.0;
  producer.bore_radius = 0.5;
  producer.trajectory.points = {Vec3(0, 0, 1500), Vec3(0, 0, 1510)};
  producer.connections.clear();
  for (std::size_t layer = 0; layer < 2; ++layer)
    for (std::size_t s = 0; s < sectors; ++s) {
      const CellId cell(layer * in_layer + s);
      // k L theta / ln(r_0 / r_w) with r_0 = 0.9 m, near enough to the radius of the mean pressure between 0.5 and 1.2
      // m.
      const double index =
          mesh.cells.permeability[cell].x() * 5.0 * (2.0 * std::numbers::pi / sectors) / std::log(0.9 / 0.5);
      const double from = 100.0 + 5.0 * static_cast<double>(layer);
      producer.connections.push_back({cell, index, {from, from + 5.0}});
    }
  mesh.wells.push_back(producer);
  mesh.wells.push_back(vertical_well("I", mesh, {CellId(24), CellId(in_layer + 24)}, 5e-13));
  mesh.wells.raw().back().type = WellType::injector;
  mesh.source_dimensions = {3, 3, 2};
  return mesh;
}

Mesh twisted_box() {
  Plan plan;
  add_polygon(plan, rectangle(0, 0, 10, 10));
  Mesh mesh = extruded(plan, {1000.0, 1010.0, 1020.0});
  for (std::size_t corner = 0; corner < 4; ++corner)
    mesh.vertices[VertexId(4 + corner)].z() += corner % 2 == 0 ? 0.5 : -0.5;
  fill_cells(mesh, 2);
  mesh.cells.kind[CellId(1)] = CellKind::transition;
  mesh.cells.source_cell[CellId(1)] = HostCellId();
  fill_connections(mesh);
  mesh.source_dimensions = {1, 1, 2};
  return mesh;
}

Provenance provenance() {
  return {"wellknit 0.1.0",
          "wellknit build \"a case.DATA\" -o out.h5",
          "mapping = \"automatic\"\nthreads = 0\n",
          {{"a case.DATA", std::string(64, 'a')}, {"include/größe.inc", std::string(64, '0')}}};
}

}  // namespace wellknit::meshes
