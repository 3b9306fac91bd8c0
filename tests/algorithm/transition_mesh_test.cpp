// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What the mapping and the mesh that is made with it refuse. What they give is tested in untangle_test.cpp and
/// build_mesh_test.cpp.

#include "algorithm/transition_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "algorithm/cavity_mapping.h"
#include "tests/support/near_well.h"
#include "tests/support/near_well_setting.h"

namespace wellknit {
namespace {

/// A layered tube of 12 m through the middle of the box grid.
struct Layered {
  near_well::Setting setting{near_well::deformed(0.0).grid};
  Tube tube = setting.tube(near_well::well(near_well::Path::vertical, 12.0), true);
};

std::string failure_of(const Cavity& cavity) {
  return CavityMapping(cavity, MappingMethod::automatic).report().failure;
}

TEST(CavityMapping, SaysWhatIsWrongWithACavity) {
  const Layered layered;
  const Cavity sound = layered.setting.cavity(layered.tube);
  ASSERT_EQ(failure_of(sound), "");
  Cavity cavity = sound;
  cavity.reference_volume *= 1.25;  // 1 / 1.25 - 1 = -0.2
  EXPECT_EQ(failure_of(cavity), "the tetrahedra do not fill the cavity: -0.200000 relative");
  cavity = sound;
  cavity.faces[0].normal = -cavity.faces[0].normal;
  EXPECT_EQ(failure_of(cavity), "the cavity's boundary is not in the triangulation");
}

TEST(CavityMapping, SaysWhereTheBoundaryHasNoArea) {
  const Layered layered;
  Cavity cavity = layered.setting.cavity(layered.tube);
  const std::vector<std::int32_t> loop = cavity.faces[0].loop;
  for (const auto v : loop) cavity.vertices[static_cast<std::size_t>(v)].real = Vec3(400.0, 320.0, 2000.0);
  const std::string failure = failure_of(cavity);
  EXPECT_NE(failure.find(" triangles of the cavity's boundary have no area, the first near (400.000000, 320.000000, "
                         "2000.000000), as where a layer has no thickness at the wall"),
            std::string::npos)
      << failure;
}

TEST(TransitionMesh, RefusesATubeThatStandsElsewhereThanItsImage) {
  // 40 m are a cell: on one side the tube lies outside of its cavity.
  Layered layered;
  for (Vec3& p : layered.tube.real.points) p.x() += 40.0;
  const auto made =
      build_transition_mesh(layered.setting.frame(), {layered.tube}, MappingMethod::automatic, /*tight=*/true);
  ASSERT_TRUE(std::holds_alternative<NoCavity>(made));
  const std::string& reason = std::get<NoCavity>(made).reason;
  for (const char* words : {" tetrahedra of the mapping stay inverted (", " at the start, ",
                            ": the grid is deformed too much around the tube"})
    EXPECT_NE(reason.find(words), std::string::npos) << reason;
}

}  // namespace
}  // namespace wellknit
