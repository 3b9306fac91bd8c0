// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/cavity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "tests/support/grids.h"
#include "tests/support/near_well.h"

namespace wellknit {
namespace {

/// Host, space and one tube of a well in a deformed grid.
struct Setting {
  Case source;
  HostMesh host;
  std::unique_ptr<CellLocator> locator;
  std::unique_ptr<ReferenceSpace> space;
  Tube tube;

  Setting(double deformation, near_well::Path path) : source(near_well::deformed(deformation)) {
    host = build_host_mesh(source.grid);
    locator = std::make_unique<CellLocator>(source.grid);
    space = std::make_unique<ReferenceSpace>(source.grid, host, CellRange{{0, 0, 0}, source.grid.dimensions});
    const Well well = near_well::well(path, 12.0);
    const auto samples = path_in_reference(frame(), well);
    auto made = path == near_well::Path::vertical ? build_layered_tube(frame(), well, samples)
                                                  : build_swept_tube(frame(), well, samples);
    if (auto* none = std::get_if<NoTube>(&made)) throw std::runtime_error(none->reason);
    tube = std::get<Tube>(made);
  }
  [[nodiscard]] HostFrame frame() const { return {source.grid, host, *locator, *space}; }
  [[nodiscard]] Cavity cavity(const CavityOptions& options = {}) const {
    auto made = build_cavity(frame(), {tube}, options);
    if (auto* none = std::get_if<NoCavity>(&made)) throw std::runtime_error(none->reason);
    return std::get<Cavity>(made);
  }
};

const std::vector<std::pair<double, near_well::Path>> settings{{0.0, near_well::Path::vertical},
                                                               {0.0, near_well::Path::curved},
                                                               {0.6, near_well::Path::deviated},
                                                               {1.0, near_well::Path::horizontal},
                                                               {1.0, near_well::Path::curved}};

TEST(Cavity, BoundaryIsAClosedManifold) {
  for (const auto& [deformation, path] : settings) {
    const Cavity cavity = Setting(deformation, path).cavity();
    std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
    for (const BoundaryFace& f : cavity.faces)
      for (std::size_t i = 0; i < f.loop.size(); ++i) ++edges[{f.loop[i], f.loop[(i + 1) % f.loop.size()]}];
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      const auto on_plane = [&](const MirrorPlane& p) {
        return cavity.vertices[static_cast<std::size_t>(edge.first)].reference[p.axis] == p.coordinate &&
               cavity.vertices[static_cast<std::size_t>(edge.second)].reference[p.axis] == p.coordinate;
      };
      // An edge on the grid's outside has its second face in the mirror image.
      const bool is_open = std::any_of(cavity.planes.begin(), cavity.planes.end(), on_plane);
      EXPECT_EQ(edges.contains({edge.second, edge.first}), !is_open);
    }
  }
}

TEST(Cavity, EveryFaceIsCocyclicAndHasAnEmptySphere) {
  for (const auto& [deformation, path] : settings) {
    const Cavity cavity = Setting(deformation, path).cavity();
    for (const BoundaryFace& f : cavity.faces) {
      for (const auto v : f.loop)
        EXPECT_NEAR((cavity.vertices[static_cast<std::size_t>(v)].reference - f.center).norm(), f.radius,
                    1e-9 * f.radius);
      ASSERT_LT(f.t_low, f.t_high);
      // The bounds against a direct test of the sphere half way (or a radius within, where a bound is infinite).
      const double t = 0.5 * (std::max(f.t_low, -f.radius) + std::min(f.t_high, f.radius));
      const double r2 = f.radius * f.radius + t * t;
      for (const CavityVertex& v : cavity.vertices)
        EXPECT_GE((v.reference - (f.center + t * f.normal)).squaredNorm() - r2, -1e-8 * r2);
    }
  }
}

TEST(Cavity, HoldsItsTube) {
  for (const auto& [deformation, path] : settings) {
    const Setting setting(deformation, path);
    const Cavity cavity = setting.cavity();
    const std::set<std::array<std::int64_t, 3>> removed(cavity.removed.begin(), cavity.removed.end());
    for (const Vec3& p : setting.tube.reference.points) {
      std::array<std::int64_t, 3> c;
      for (int a = 0; a < 3; ++a) c[static_cast<std::size_t>(a)] = setting.space->place(a, p[a]).first;
      EXPECT_TRUE(removed.contains(c));
    }
  }
}

TEST(Cavity, LayeredTubeTakesWholeColumns) {
  const Cavity cavity = Setting(0.0, near_well::Path::vertical).cavity();
  EXPECT_EQ(cavity.removed.size() % 12, 0U);
  EXPECT_EQ(cavity.planes.size(), 2U);  // top and base
  for (const BoundaryFace& f : cavity.faces) EXPECT_LT(std::abs(f.normal.z()), 1e-12);
}

TEST(Cavity, GrowsWhenAskedTo) {
  const Setting setting(0.0, near_well::Path::curved);
  CavityOptions wide;
  wide.dilation = 1;
  EXPECT_GT(setting.cavity(wide).removed.size(), setting.cavity().removed.size());
}

TEST(Cavity, RefusesAFaultInsideItself) {
  const CornerPointGrid grid = grids::faulted({12, 12, 8}, 3.0);
  const HostMesh host = build_host_mesh(grid);
  const CellLocator locator(grid);
  const ReferenceSpace space(grid, host, {{0, 0, 0}, grid.dimensions});
  const HostFrame frame{grid, host, locator, space};
  Well well = near_well::straight("F", {52.0, 110.0, 1020.0}, {55.0, 130.0, 1020.0});  // 5 m from the fault at x = 60
  well.radial.drainage_radius = 4.0;
  auto tube = build_swept_tube(frame, well, path_in_reference(frame, well));
  ASSERT_TRUE(std::holds_alternative<Tube>(tube)) << std::get<NoTube>(tube).reason;
  const auto cavity = build_cavity(frame, {std::get<Tube>(tube)}, {});
  ASSERT_TRUE(std::holds_alternative<NoCavity>(cavity));
  EXPECT_NE(std::get<NoCavity>(cavity).reason.find("fault"), std::string::npos);
}

}  // namespace
}  // namespace wellknit
