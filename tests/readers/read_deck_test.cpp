// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A whole deck, with sections, titles and tables to pass over: testdata/grdecl/deck.
#include <gtest/gtest.h>

#include <variant>

#include "model/units.h"
#include "readers/read_case.h"
#include "tests/readers/reader_helpers.h"

namespace wellknit {
namespace {

const std::string deck_file = std::string(WELLKNIT_TESTDATA) + "/grdecl/deck/BOX.DATA";
constexpr double foot = metre_per_foot;

TEST(ReadDeck, TakesTheGridOutOfAWholeDeck) {
  const CornerPointGrid grid = read_case(deck_file).grid;
  EXPECT_EQ(grid.dimensions, (std::array<std::int64_t, 3>{4, 3, 2}));
  EXPECT_EQ(grid.units, UnitSystem::field);
  // Cell (1,1,2): 100 x 200 x 20 ft.
  EXPECT_NEAR(bilinear_hexahedron_volume(grid.corners(grid.cell_id(0, 0, 1))),
              100.0 * 200.0 * 20.0 * foot * foot * foot, 1e-6);
  EXPECT_EQ(grid.porosity, std::vector<double>(24, 0.25));
  EXPECT_DOUBLE_EQ(grid.permeability[1][0], 100.0 * m2_per_millidarcy);
  EXPECT_DOUBLE_EQ(grid.permeability[2][23], 200.0 * 0.1 * m2_per_millidarcy);
  EXPECT_TRUE(grid.mapaxes);
}

TEST(ReadDeck, CarriesArraysOfLaterSections) {
  const CornerPointGrid grid = read_case(deck_file).grid;
  EXPECT_EQ(grid.properties.size(), 3U) << "SWL, SATNUM, FIPZON; SWAT stands only in RPTSOL";
  EXPECT_EQ(std::get<std::vector<double>>(grid.properties.at("SWL")), std::vector<double>(24, 0.2));
  EXPECT_EQ(std::get<std::vector<std::int32_t>>(grid.properties.at("SATNUM"))[12], 2);
  EXPECT_EQ(std::get<std::vector<std::int32_t>>(grid.properties.at("FIPZON"))[0], 3);
}

TEST(ReadDeck, NotesWhatItPassesOverInTheGridOnly) {
  const std::vector<std::string> notes = read_case(deck_file).notes;
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], deck_file + ":34: UNHEARD is not understood and is skipped");
}

TEST(ReadDeck, ListsItsFilesAsIncludeNamesThem) {
  const auto sources = read_case(deck_file).sources;
  ASSERT_EQ(sources.size(), 3U);
  EXPECT_EQ(sources[1].path, "geometry.inc");
  EXPECT_EQ(sources[2].path, "include/rock.inc") << "found as include/Rock.inc, through PATHS";
}

TEST(ReadDeck, ReadsItsWells) {
  const std::vector<Well> wells = read_case(deck_file).deck_wells;
  ASSERT_EQ(wells.size(), 3U);
  EXPECT_EQ(wells[0].name, "PROD1");
  EXPECT_EQ(wells[0].type, WellType::producer);
  EXPECT_DOUBLE_EQ(*wells[0].reference_depth, 1010.0 * foot);
  EXPECT_DOUBLE_EQ(wells[0].radial.bore_radius, 0.5 * foot);
  EXPECT_FALSE(wells[1].reference_depth);
  EXPECT_EQ(wells[2].type, WellType::injector);
}

TEST(ReadDeck, ConvertsWhatCompdatStates) {
  const std::vector<Well> wells = read_case(deck_file).deck_wells;
  const DeckCompletion& first = wells[0].completions[0];
  EXPECT_DOUBLE_EQ(*first.connection_factor, 10.0 * m3_per_transmissibility_unit(UnitSystem::field));
  EXPECT_FALSE(first.permeability_thickness);
  const DeckCompletion& last = wells[2].completions[1];
  EXPECT_FALSE(last.connection_factor);
  EXPECT_DOUBLE_EQ(*last.permeability_thickness, 300.0 * m2_per_millidarcy * foot);
  EXPECT_DOUBLE_EQ(last.skin, 2.0);
}

TEST(ReadDeck, FollowsCompletionsThroughTime) {
  const std::vector<Well> wells = read_case(deck_file).deck_wells;
  ASSERT_EQ(wells[1].completions.size(), 2U);
  EXPECT_TRUE(wells[1].completions[0].open);
  EXPECT_FALSE(wells[1].completions[1].open) << "shut after the first time step";
  // Open over the upper layer of 10 ft, of 30 ft in all.
  ASSERT_EQ(wells[1].open.size(), 1U);
  EXPECT_NEAR(wells[1].open[0].from, 0.0, 1e-9);
  EXPECT_NEAR(wells[1].open[0].to, 10.0 * foot, 1e-9);
  EXPECT_NEAR(wells[1].trajectory.measured_depth.back(), 30.0 * foot, 1e-9);
}

TEST(ReadDeck, DoesNotTakeDataOfOtherSectionsForKeywords) {
  const std::string deck = "RUNSPEC\nTITLE\nFIELD\nDIMENS\n 1 1 1 /\nGRID\n" + unit_boxes(1, 1, 1) +
                           "PROPS\nTRACER\n SEA WAT /\n/\nSOLUTION\nRPTSOL\nPORO\nSWAT SGAS "
                           "/\nSUMMARY\nINCLUDE\n'none' /\nPORO\n/\nSCHEDULE\n"
                           "RPTSCHED\nPORO 1 /\nVFPPROD\n 1 2 3 /\nPORO /\nGRUPTREE\n 'A' 'FIELD' /\nFIELD /\n/\n";
  const Case read = case_of(deck);
  EXPECT_EQ(read.grid.units, UnitSystem::metric) << "FIELD is the title";
  EXPECT_TRUE(read.grid.porosity.empty());
  EXPECT_TRUE(read.notes.empty());
}

}  // namespace
}  // namespace wellknit
