// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Real decks, grids and wells. They are not part of the project: without the folder WELLKNIT_SHARED the tests are
/// skipped.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <vector>

#include "model/units.h"
#include "readers/describe.h"
#include "readers/file_content.h"
#include "readers/read_case.h"
#include "readers/read_trajectory.h"
#include "tests/readers/reader_helpers.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

class PublicData : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* variable = std::getenv("WELLKNIT_SHARED");
    folder_ = std::filesystem::path(variable != nullptr ? variable : WELLKNIT_SHARED) / "data";
    if (!std::filesystem::is_directory(folder_)) GTEST_SKIP() << "no folder " << folder_;
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }

  std::filesystem::path folder_;
};

double volume(const CornerPointGrid& grid) { return describe(grid).bulk_volume; }

constexpr double cubic_foot = metre_per_foot * metre_per_foot * metre_per_foot;
// SPE 9: 24 x 25 columns of 300 ft; layers of 20 15 26 15 16 14 8 8 18 12 19 18 20 50 100 ft, 359 ft in all.
constexpr double spe9_volume = 24 * 300.0 * 25 * 300.0 * 359.0 * cubic_foot;

TEST_F(PublicData, Spe9CornerPointHasItsGridAndWells) {
  const Case read = read_case(file("spe9/SPE9_CP.DATA"));
  EXPECT_EQ(read.grid.dimensions, (std::array<std::int64_t, 3>{24, 25, 15}));
  EXPECT_EQ(read.grid.units, UnitSystem::field);
  EXPECT_NEAR(volume(read.grid), spe9_volume, 1e-9 * spe9_volume);
  ASSERT_EQ(read.deck_wells.size(), 26U);
  EXPECT_EQ(read.sources.size(), 3U);
  EXPECT_TRUE(read.notes.empty());
  const Well& injector = read.deck_wells[0];
  EXPECT_EQ(injector.name, "INJE1");
  EXPECT_EQ(injector.type, WellType::injector);
  EXPECT_EQ(injector.completions.size(), 5U) << "layers 11 to 15";
  EXPECT_DOUBLE_EQ(*injector.reference_depth, 9110 * metre_per_foot);
  for (const Well& well : read.deck_wells) {
    EXPECT_DOUBLE_EQ(well.radial.bore_radius, 0.5 * metre_per_foot);
    EXPECT_EQ(well.open.size(), 1U) << well.name;
  }
  // Layers 2 to 4 are 15 + 26 + 15 ft thick.
  EXPECT_NEAR(read.deck_wells[1].trajectory.measured_depth.back(), 56 * metre_per_foot, 1e-3);
}

TEST_F(PublicData, Spe9BlockCentredHasTheSameVolumeAndRock) {
  const Case blocks = read_case(file("spe9/SPE9.DATA"));
  const Case corners = read_case(file("spe9/SPE9_CP.DATA"));
  EXPECT_NEAR(volume(blocks.grid), spe9_volume, 1e-9 * spe9_volume);
  EXPECT_EQ(blocks.grid.permeability, corners.grid.permeability);
  EXPECT_DOUBLE_EQ(blocks.grid.zcorn[0], 9000 * metre_per_foot) << "the corner-point version smooths the tops";
}

TEST_F(PublicData, Spe9HasTheSameCellVolumesInBothForms) {
  const CornerPointGrid blocks = read_case(file("spe9/SPE9.DATA")).grid;
  const CornerPointGrid corners = read_case(file("spe9/SPE9_CP.DATA")).grid;
  ASSERT_EQ(blocks.cell_count(), corners.cell_count());
  for (std::int64_t cell = 0; cell < blocks.cell_count(); ++cell) {
    const double expected = bilinear_hexahedron_volume(blocks.corners(HostCellId(cell)));
    EXPECT_NEAR(bilinear_hexahedron_volume(corners.corners(HostCellId(cell))), expected, 1e-6 * expected) << cell;
  }
}

TEST_F(PublicData, ReekHasItsFaults) {
  const Case read = read_case(file("reek/reek_sim.grdecl"), {file("reek/reek_sim_faults.grdecl")});
  ASSERT_FALSE(read.grid.edits.faults.empty());
  for (const Fault& fault : read.grid.edits.faults) EXPECT_GT(fault.face_count(), 0) << fault.name;
}

TEST_F(PublicData, Model5KeepsItsEdits) {
  const ConnectionEdits edits = read_case(file("model5/MODEL5.DATA")).grid.edits;
  ASSERT_EQ(edits.array_edits.size(), 1U);
  EXPECT_EQ(edits.array_edits[0].array, ComputedArray::transmissibility_z);
  EXPECT_EQ(edits.array_edits[0].operation, ArrayOperation::at_most);
  EXPECT_FALSE(edits.face_multiplier[static_cast<std::size_t>(FaceDirection::j_plus)].empty());
  EXPECT_EQ(edits.method, TransmissibilityMethod::newtran);
}

TEST_F(PublicData, CutFilesEndInAnErrorOrAGrid) {
  std::vector<std::filesystem::path> paths{folder_ / "spe9/SPE9.GRDECL", folder_ / "reek/reek_sim_faults.grdecl",
                                           folder_ / "reek/reek_sim_poro.grdecl", folder_ / "model5/MODEL5.DATA"};
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "odd"))
    if (entry.path().extension() == ".grdecl") paths.push_back(entry.path());
  for (const auto& path : paths) {
    const std::string text(load_file(path.string()).text);
    for (std::size_t n = 0; n < 200; ++n) {
      MemoryFiles files({{"case", text.substr(0, text.size() * n / 200)}});
      try {
        validate(parse_case(files, "case").grid);
      } catch (const ParseError& error) {
        EXPECT_EQ(error.where().file, "case") << path;
      }
    }
  }
}

TEST_F(PublicData, Model5HasItsGridAndWells) {
  const Case read = read_case(file("model5/MODEL5.DATA"));
  EXPECT_EQ(read.grid.dimensions, (std::array<std::int64_t, 3>{20, 30, 10}));
  EXPECT_EQ(read.grid.porosity[0], 0.28);
  EXPECT_DOUBLE_EQ(read.grid.permeability[2][0], 0.8 * read.grid.permeability[0][0]);
  ASSERT_EQ(read.deck_wells.size(), 9U);
  EXPECT_EQ(std::count_if(read.deck_wells.begin(), read.deck_wells.end(),
                          [](const Well& w) { return w.type == WellType::injector; }),
            4);
  EXPECT_EQ(read.deck_wells[0].completions.size(), 5U);
  EXPECT_EQ(read.deck_wells[0].radial.bore_radius, 0.108);
  EXPECT_TRUE(read.notes.empty()) << read.notes.front();
}

TEST_F(PublicData, NwmIsFoundInAnotherCase) {
  const Case read = read_case(file("nwm/NWM.DATA"));
  EXPECT_EQ(read.grid.dimensions, (std::array<std::int64_t, 3>{40, 30, 8}));
  EXPECT_EQ(std::accumulate(read.grid.active.begin(), read.grid.active.end(), 0), 6200);
  EXPECT_EQ(read.grid.net_to_gross[0], 0.9);
  EXPECT_EQ(read.grid.permeability[1], read.grid.permeability[0]);
  ASSERT_EQ(read.deck_wells.size(), 3U);
  EXPECT_EQ(read.deck_wells[2].completions.size(), 19U);
  EXPECT_EQ(read.deck_wells[2].radial.bore_radius, 0.15);
  EXPECT_TRUE(read.notes.empty());
}

TEST_F(PublicData, NwmTrajectoryIsRead) {
  const TrajectoryFile read = read_trajectory(file("nwm/trajectory.csv"));
  ASSERT_EQ(read.wells.size(), 1U);
  EXPECT_EQ(read.wells[0].trajectory.points.size(), 21U);
  EXPECT_EQ(read.wells[0].trajectory.points[0], Vec3(155, 155, 1005));
}

TEST_F(PublicData, ReekComesInThreeFiles) {
  const Case read =
      read_case(file("reek/reek_sim.grdecl"), {file("reek/reek_sim_poro.grdecl"), file("reek/reek_sim_faults.grdecl")});
  EXPECT_EQ(read.grid.dimensions, (std::array<std::int64_t, 3>{40, 64, 14}));
  EXPECT_EQ(read.grid.porosity[0], 0.177493915);
  EXPECT_EQ(read.sources.size(), 3U);
  EXPECT_TRUE(read.notes.empty());
  EXPECT_FALSE(describe(read.grid).is_right_handed) << "as exported";
}

TEST_F(PublicData, EveryOddGridIsRead) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "odd")) {
    if (entry.path().extension() != ".grdecl") continue;
    const Case read = read_case(entry.path().string());
    EXPECT_GT(volume(read.grid), 0.0) << entry.path();
    EXPECT_TRUE(read.notes.empty()) << entry.path();
    ++count;
  }
  EXPECT_EQ(count, 20U);
}

TEST_F(PublicData, DevWellsAreRead) {
  const TrajectoryFile read = read_trajectory(file("wells/TEST10K_FLT_LGR_NNC_wellpath_a.dev"));
  ASSERT_EQ(read.wells.size(), 1U);
  EXPECT_EQ(read.wells[0].name, "Well Path A");
  EXPECT_EQ(read.wells[0].trajectory.points[0], Vec3(3736.27, 4630.61, 4133.5));
}

/// None of these has a log of measured depth: arc length, which the script computes for itself.
TEST_F(PublicData, RmsWellsAreThoseOfAnIndependentReader) {
  const ScratchFolder scratch;
  for (const char* name : {"OP_1", "OP_2", "OP_3", "OP_4", "OP_5", "WI_1", "WI_2", "XP_with_repeat"}) {
    const std::string path = file(std::string("reek/wells/") + name + ".w");
    const TrajectoryFile read = read_trajectory(path);
    ASSERT_EQ(read.wells.size(), 1U);
    std::string text = read.wells[0].name + "\n";
    const Trajectory& along = read.wells[0].trajectory;
    for (std::size_t n = 0; n < along.points.size(); ++n)
      text += fmt::format("{} {} {} {}\n", along.points[n].x(), along.points[n].y(), along.points[n].z(),
                          along.measured_depth[n]);
    scratch.write("read.txt", text);
    const std::string command = fmt::format("'{}' '{}/tests/readers/check_rms_wells.py' '{}' '{}'", WELLKNIT_PYTHON,
                                            WELLKNIT_SOURCE_DIR, path, scratch.file("read.txt"));
    EXPECT_EQ(std::system(command.c_str()), 0) << name;
  }
}

TEST_F(PublicData, DecksWithTrajectoriesHaveTheirWells) {
  const Case read = read_case(file("decks/SPE1CASE1_WELTRAJ.DATA"));
  EXPECT_EQ(read.grid.dimensions, (std::array<std::int64_t, 3>{10, 10, 3}));
  // 10 x 10 columns of 1000 ft, 20 + 30 + 50 ft thick.
  EXPECT_NEAR(volume(read.grid), 1e4 * 1e4 * 100 * cubic_foot, 1.0);
  ASSERT_EQ(read.deck_wells.size(), 2U);
  for (const Well& well : read.deck_wells) {
    EXPECT_FALSE(well.approximate_path);
    EXPECT_DOUBLE_EQ(well.radial.bore_radius, 0.25 * metre_per_foot);
    EXPECT_EQ(well.skin, 0.1);
    ASSERT_EQ(well.open.size(), 1U);
    EXPECT_DOUBLE_EQ(well.open[0].from, 8325 * metre_per_foot);
  }
  const auto prod = std::find_if(read.deck_wells.begin(), read.deck_wells.end(),
                                 [](const Well& well) { return well.name == "PROD"; });
  ASSERT_NE(prod, read.deck_wells.end());
  EXPECT_EQ(prod->trajectory.points.back(), Vec3(9500, 9500, 8425) * metre_per_foot);
  EXPECT_EQ(read_case(file("decks/SPE1CASE1_WELTRAJ_2.DATA")).deck_wells.size(), 2U);
}

}  // namespace
}  // namespace wellknit
