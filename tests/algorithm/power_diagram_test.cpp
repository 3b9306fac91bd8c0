// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/power_diagram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "algorithm/cavity_mapping.h"
#include "algorithm/short_edges.h"
#include "tests/support/near_well.h"
#include "tests/support/near_well_setting.h"

namespace wellknit {
namespace {

struct Diagram {
  Cavity cavity;
  Sites sites;
  PowerDiagram diagram;
};

Diagram diagram_of(double deformation, near_well::Path path, double radius = 12.0) {
  const near_well::Setting setting(near_well::deformed(deformation).grid);
  const Tube tube = setting.tube(near_well::well(path, radius), path == near_well::Path::vertical);
  Diagram out{setting.cavity(tube), {}, {}};
  out.sites = place_sites(out.cavity);
  out.diagram = build_power_diagram(out.cavity, out.sites);
  return out;
}

const std::vector<std::pair<double, near_well::Path>> settings{
    {0.0, near_well::Path::vertical}, {0.0, near_well::Path::horizontal}, {0.0, near_well::Path::curved},
    {0.3, near_well::Path::vertical}, {0.6, near_well::Path::deviated},   {1.0, near_well::Path::curved}};

TEST(PowerDiagram, GivesBackEveryBoundaryFaceAsTheSameVertexSet) {
  for (const auto& [deformation, path] : settings) {
    const Diagram d = diagram_of(deformation, path);
    ASSERT_EQ(d.diagram.failure, "");
    const BoundaryMatch match = match_boundary(d.cavity, d.sites, d.diagram);
    EXPECT_EQ(match.found, static_cast<std::int64_t>(d.cavity.faces.size()));
    EXPECT_EQ(match.foreign, 0);
    EXPECT_LT(match.volume_error, 1e-12);
  }
}

TEST(PowerDiagram, EverySiteHasNonNegativePowerAtEveryBoundaryVertex) {
  // The premise of the theorem in method.md §8.
  for (const auto& [deformation, path] : settings) {
    const Diagram d = diagram_of(deformation, path);
    for (const auto* sites : {&d.sites.inner, &d.sites.outer})
      for (const Site& s : *sites)
        for (const CavityVertex& v : d.cavity.vertices)
          EXPECT_GE((v.reference - s.center).squaredNorm() - s.weight, -1e-8 * s.weight);
    EXPECT_EQ(d.sites.not_centred, 0);
  }
}

TEST(PowerDiagram, FacesArePlanarAndNormalToTheLineOfTheirSites) {
  for (const auto& [deformation, path] : settings) {
    const Diagram d = diagram_of(deformation, path);
    double scale = 0.0;
    for (const BoundaryFace& f : d.cavity.faces) scale = std::max(scale, f.radius);
    for (const DiagramFace& f : d.diagram.faces) {
      if (f.other_kind != DiagramFace::Other::inner) continue;
      std::vector<Vec3> points;
      for (const auto v : f.loop) points.push_back(d.diagram.vertices[static_cast<std::size_t>(v)]);
      const PolygonGeometry g = polygon_geometry(points);
      if (g.area < 1e-6 * scale * scale) continue;  // rounding rules the normal of a sliver
      const Vec3 line = d.sites.inner[static_cast<std::size_t>(f.other)].center -
                        d.sites.inner[static_cast<std::size_t>(f.cell)].center;
      EXPECT_LT(g.area_vector.cross(line).norm() / (g.area * line.norm()), 2e-6);  // 1e-4 degrees
      EXPECT_GT(g.area_vector.dot(line), 0.0);
      EXPECT_LT(planarity(points, g), 1e-8);
    }
  }
}

TEST(PowerDiagram, CellsAreClosedAndFollowEuler) {
  for (const auto& [deformation, path] : settings) {
    const Diagram d = diagram_of(deformation, path);
    struct Counts {
      std::set<std::int32_t> vertices;
      std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
      int faces = 0;
    };
    std::vector<Counts> cells(d.sites.inner.size());
    for (const DiagramFace& f : d.diagram.faces)
      for (const bool is_other : {false, true}) {
        if (is_other && f.other_kind != DiagramFace::Other::inner) continue;
        Counts& c = cells[static_cast<std::size_t>(is_other ? f.other : f.cell)];
        ++c.faces;
        for (std::size_t i = 0; i < f.loop.size(); ++i) {
          const std::int32_t a = f.loop[i];
          const std::int32_t b = f.loop[(i + 1) % f.loop.size()];
          c.vertices.insert(a);
          ++c.edges[is_other ? std::pair(b, a) : std::pair(a, b)];
        }
      }
    for (const Counts& c : cells) {
      for (const auto& [edge, count] : c.edges) {
        EXPECT_EQ(count, 1);
        EXPECT_TRUE(c.edges.contains({edge.second, edge.first}));
      }
      EXPECT_EQ(static_cast<int>(c.vertices.size()) - static_cast<int>(c.edges.size()) / 2 + c.faces, 2);  // V - E + F
    }
  }
}

TEST(PowerDiagram, SaysWhatIsNotSound) {
  const Diagram d = diagram_of(0.0, near_well::Path::vertical);
  ASSERT_EQ(d.cavity.planes.size(), 2U);  // top and base
  Sites sites = d.sites;
  sites.inner[0].weight = -1e9;  // its power is above any other's everywhere
  EXPECT_EQ(build_power_diagram(d.cavity, sites).failure, "1 sites have no cell");
  sites = d.sites;
  sites.outer.clear();
  EXPECT_EQ(build_power_diagram(d.cavity, sites).failure, "a cell is not bounded");
  sites = d.sites;  // one behind the plane: its image stands before it, among the others
  const MirrorPlane& plane = d.cavity.planes[0];
  sites.inner[0].center[plane.axis] = plane.coordinate - 3.0 * plane.inward;
  EXPECT_EQ(build_power_diagram(d.cavity, sites).failure, "a site and the image of another have a common face");
}

TEST(PowerDiagram, SaysThatAllTetrahedraAreFlat) {
  // Nine sites in a plane but for 1e-13 m.
  Sites sites;
  sites.inner.push_back({Vec3::Zero(), 0.0, {}});
  for (const double x : {-1.0, 0.0, 1.0})
    for (const double y : {-1.0, 0.0, 1.0})
      if (x != 0.0 || y != 0.0) sites.outer.push_back({Vec3(x, y, sites.outer.size() % 2 == 0 ? 0.0 : 1e-13), 0.0, {}});
  EXPECT_NE(build_power_diagram({}, sites).failure.find(" flat tetrahedra have no sound neighbour"), std::string::npos);
}

TEST(DiagramTrial, SaysWhatDoesNotHold) {
  const Diagram d = diagram_of(0.0, near_well::Path::vertical);
  DiagramTrial trial = try_diagram(d.cavity, {});
  EXPECT_EQ(trial.fault(d.cavity), "");
  const auto faces = std::to_string(d.cavity.faces.size());
  --trial.match.found;
  trial.match.foreign = 2;
  trial.match.volume_error = 0.25;
  EXPECT_EQ(trial.fault(d.cavity), "the power diagram gives back " + std::to_string(d.cavity.faces.size() - 1) +
                                       " of " + faces + " boundary faces (2 foreign, volume error 2.5e-01)");
  trial.diagram.failure = "a cell is not bounded";
  EXPECT_EQ(trial.fault(d.cavity), "the power diagram is not sound: a cell is not bounded");
  trial.sites.not_centred = 3;
  EXPECT_EQ(trial.fault(d.cavity), "3 sites do not lie in their own cells");
}

TEST(ShortEdges, AreFewerAfterTheAdjustmentAndTheDiagramStaysSound) {
  for (const auto& [deformation, path] : settings) {
    const Diagram d = diagram_of(deformation, path);
    AdjustmentReport report;
    const DiagramTrial trial = expand_short_edges(d.cavity, try_diagram(d.cavity, {}), report);
    EXPECT_TRUE(trial.is_sound(d.cavity));
    EXPECT_LE(report.short_after, report.short_before);
    EXPECT_EQ(report.short_after,
              static_cast<std::int64_t>(
                  short_edges(d.cavity, trial.diagram, 0.03 * d.cavity.tubes[0].reference_radius).size()));
  }
}

TEST(ShortEdges, NoneIsReportedBelowAVanishingLimit) {
  const Diagram d = diagram_of(0.6, near_well::Path::deviated);
  EXPECT_TRUE(short_edges(d.cavity, d.diagram, 1e-12).empty());
  EXPECT_FALSE(short_edges(d.cavity, d.diagram, 1.0).empty());
}

TEST(CavityMapping, OfABoxGridIsTheIdentity) {
  const Diagram d = diagram_of(0.0, near_well::Path::curved);
  const CavityMapping mapping(d.cavity, MappingMethod::automatic);
  EXPECT_EQ(mapping.report().failure, "");
  EXPECT_EQ(mapping.report().inverted_first, 0);
  const Vec3 shift = d.cavity.vertices[0].real - d.cavity.vertices[0].reference;
  for (const Vec3& v : d.diagram.vertices)
    EXPECT_LT((mapping.to_real(v) - v - shift).norm(), 1e-7);  // barycentric coordinates in flat tetrahedra
}

TEST(CavityMapping, IsUntangledByBothMethods) {
  for (const MappingMethod method : {MappingMethod::automatic, MappingMethod::paper}) {
    const Diagram d = diagram_of(1.6, near_well::Path::curved, 8.0);
    const CavityMapping mapping(d.cavity, method);
    EXPECT_EQ(mapping.report().failure, "");
    EXPECT_GT(mapping.report().inverted_first, 0) << "the setting is too gentle to test untangling";
    EXPECT_EQ(mapping.report().inverted_last, 0);
    EXPECT_GT(mapping.report().smallest_ratio, 0.0);
    EXPECT_GE(mapping.report().points_inserted, 1);
  }
}

TEST(CavityMapping, SliversAreFlippedWithoutNewPoints) {
  // Inverted tetrahedra whose vertices lie near one circle of E_ref: others of the same vertices are not.
  const Diagram d = diagram_of(1.6, near_well::Path::curved, 12.0);
  const CavityMapping mapping(d.cavity, MappingMethod::automatic);
  EXPECT_EQ(mapping.report().failure, "");
  EXPECT_GT(mapping.report().inverted_first, 0) << "the setting is too gentle to test flips";
  EXPECT_EQ(mapping.report().inverted_last, 0);
  EXPECT_EQ(mapping.report().points_inserted, 0);
}

TEST(CavityMapping, SaysWhereItFails) {
  // At a deformation where nothing helps: the places are on the tube, between its ends.
  const Diagram d = diagram_of(2.2, near_well::Path::curved, 10.0);
  const MappingReport report = CavityMapping(d.cavity, MappingMethod::automatic).report();
  ASSERT_NE(report.failure, "");
  ASSERT_FALSE(report.places_at_fault.empty());
  const auto& depths = d.cavity.tubes[0].real.measured_depth;
  for (const TubePlace& p : report.places_at_fault) {
    EXPECT_EQ(p.tube, 0U);
    EXPECT_GE(p.measured_depth, depths.front());
    EXPECT_LE(p.measured_depth, depths.back());
  }
}

TEST(CavityMapping, SaysWhereTheBoundaryHasNoArea) {
  // A layer without thickness at the wall: the two nodes of a vertical edge of a host face have one real position.
  for (const MappingMethod method : {MappingMethod::automatic, MappingMethod::paper}) {
    Diagram d = diagram_of(0.0, near_well::Path::curved);
    const auto face = std::find_if(d.cavity.faces.begin(), d.cavity.faces.end(),
                                   [](const BoundaryFace& f) { return f.kind == BoundaryFaceKind::host; });
    auto& vertices = d.cavity.vertices;
    vertices[static_cast<std::size_t>(face->loop[0])].real = vertices[static_cast<std::size_t>(face->loop[1])].real;
    const CavityMapping mapping(d.cavity, method);
    EXPECT_NE(mapping.report().failure.find("have no area"), std::string::npos) << mapping.report().failure;
    EXPECT_EQ(mapping.report().loops, 0);
  }
}

TEST(CavityMapping, EndsWithAPlainFailureWhereNothingHelps) {
  // One vertex of the tube stands on the far side of it in the real space: its own fixed neighbours fold over.
  for (const MappingMethod method : {MappingMethod::automatic, MappingMethod::paper}) {
    Diagram d = diagram_of(0.0, near_well::Path::curved);
    const auto tube = std::find_if(d.cavity.vertices.begin(), d.cavity.vertices.end(),
                                   [](const CavityVertex& v) { return !v.is_host; });
    const Vec3 axis = d.cavity.tubes[0].real.axis.front();
    tube->real += 40.0 * (tube->real - axis);
    const CavityMapping mapping(d.cavity, method);
    EXPECT_NE(mapping.report().failure.find("stay inverted"), std::string::npos);
    EXPECT_GT(mapping.report().inverted_first, 0);
    EXPECT_GT(mapping.report().inverted_last, 0);
    EXPECT_LE(mapping.report().loops, 25);
  }
}

TEST(CavityMapping, KeepsTheBoundaryVertices) {
  const Diagram d = diagram_of(1.0, near_well::Path::curved);
  const CavityMapping mapping(d.cavity, MappingMethod::automatic);
  for (const CavityVertex& v : d.cavity.vertices) EXPECT_LT((mapping.to_real(v.reference) - v.real).norm(), 1e-6);
}

}  // namespace
}  // namespace wellknit
