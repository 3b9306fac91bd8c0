// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Writes the small meshes in every format for the scripts of this folder, which open them with other programs.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "model/mesh_check.h"
#include "model/quality.h"
#include "tests/support/grids.h"
#include "tests/support/meshes.h"
#include "writers/formats.h"
#include "writers/write_flow_deck.h"
#include "writers/write_geos.h"

namespace wellknit {
namespace {

struct NamedMesh {
  const char* name;
  Mesh mesh;
};

std::vector<NamedMesh> examples() {
  return {{"two_boxes", meshes::two_boxes()},
          {"box_grid", meshes::box_grid(4)},
          {"ring_in_boxes", meshes::ring_in_boxes()},
          {"twisted", meshes::twisted_box()}};
}

TEST(ExampleFiles, AreWrittenForTheScripts) {
  const char* folder = std::getenv("WELLKNIT_EXAMPLES");
  if (folder == nullptr) GTEST_SKIP() << "WELLKNIT_EXAMPLES names no folder";
  std::filesystem::create_directories(folder);
  for (const auto& [name, mesh] : examples()) {
    const std::string base = std::string(folder) + "/" + name;
    const CornerPointGrid source = grids::box(mesh.source_dimensions);
    for (const WriterFormat& format : writer_formats())
      format.write(
          {mesh, meshes::provenance(), base + std::string(format.extensions.front()), Overwrite::allow, {}, &source});
    GeosOptions geos;  // no cell of these meshes has more than five sides, and their FIPNUM is below 0
    geos.most_sides = 4;
    geos.region = "SATNUM";
    write_geos(mesh, base + "_geos.vtu", geos, Overwrite::allow);
    write_flow_deck(mesh, base + "_water.data", {FlowFluids::water}, Overwrite::allow);
    std::ofstream(base + "_quality.json") << quality(mesh).to_json();
    EXPECT_TRUE(check_mesh(mesh).empty()) << name;
    EXPECT_TRUE(std::filesystem::exists(base + ".h5"));
  }
}

}  // namespace
}  // namespace wellknit
