// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/deck_connections.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "model/units.h"
#include "tests/readers/reader_helpers.h"

namespace wellknit {
namespace {

using Reals = std::vector<double>;

ConnectionEdits edits_of(const std::string& text, int nx = 2, int ny = 1, int nz = 1) {
  return case_of(unit_boxes(nx, ny, nz) + text).grid.edits;
}

const Reals& multiplier(const ConnectionEdits& edits, FaceDirection face) {
  return edits.face_multiplier[static_cast<std::size_t>(face)];
}

TEST(DeckConnections, ABareGridHasNone) {
  const ConnectionEdits edits = edits_of("");
  EXPECT_TRUE(edits.faults.empty());
  for (const Reals& values : edits.face_multiplier) EXPECT_TRUE(values.empty());
  EXPECT_FALSE(edits.pinch);
  EXPECT_FALSE(edits.least_pore_volume);
  EXPECT_EQ(edits.method, TransmissibilityMethod::by_geometry);
}

TEST(DeckConnections, ReadsFaultsInEverySpellingOfAFace) {
  using F = FaceDirection;
  const std::vector<std::pair<std::string, F>> spellings{
      {"X", F::i_plus},     {"'X'", F::i_plus},   {"I", F::i_plus},   {"X+", F::i_plus},  {"'I+'", F::i_plus},
      {"X-", F::i_minus},   {"'I-'", F::i_minus}, {"Y", F::j_plus},   {"J", F::j_plus},   {"y-", F::j_minus},
      {"'J-'", F::j_minus}, {"Z", F::k_plus},     {"'k'", F::k_plus}, {"Z-", F::k_minus}, {"\"K-\"", F::k_minus}};
  std::string text = "FAULTS\n";
  for (const auto& [spelling, face] : spellings) text += " 'F 1' 1 2 1 3 2 4 " + spelling + " /\n";
  const ConnectionEdits edits = edits_of(text + "/\n", 2, 3, 4);
  ASSERT_EQ(edits.faults.size(), 1U);
  EXPECT_EQ(edits.faults[0].name, "F 1");
  ASSERT_EQ(edits.faults[0].faces.size(), spellings.size());
  for (std::size_t n = 0; n < spellings.size(); ++n) {
    EXPECT_EQ(edits.faults[0].faces[n].face, spellings[n].second) << spellings[n].first;
    EXPECT_EQ(edits.faults[0].faces[n].cells, (CellBox{{0, 0, 1}, {1, 2, 3}}));
  }
  EXPECT_EQ(edits.faults[0].face_count(), static_cast<std::int64_t>(spellings.size()) * 2 * 3 * 3);
}

TEST(DeckConnections, TakesTheLastMultiplierOfAFaultAndMultipliesItInEdit) {
  const std::string faults = "FAULTS\nA 1 1 1 1 1 1 X /\nAB 1 1 1 1 1 1 X /\nC 1 1 1 1 1 1 X /\n/\n";
  const ConnectionEdits edits = case_of("GRID\n" + unit_boxes(2, 1, 1) + "MULTFLT\n 'A*' 0.5 /\n a 0.25 /\n/\n" +
                                        faults + "EDIT\nMULTFLT\n A 10 /\n A 2 /\n'C' 3 /\n/\n")
                                    .grid.edits;
  ASSERT_EQ(edits.faults.size(), 3U);
  EXPECT_EQ(edits.faults[0].multiplier, 0.25 * 2) << "GRID: the last record; EDIT: its last one, times that of GRID";
  EXPECT_EQ(edits.faults[1].multiplier, 0.5);
  EXPECT_EQ(edits.faults[2].multiplier, 3.0);
}

TEST(DeckConnections, NotesMultipliersOfUnknownFaultsAndNamesThatAgreeInEightCharacters) {
  const Case read =
      case_of(unit_boxes(1, 1, 1) +
              "FAULTS\nFAULT_NORTH 6*1 X /\nFAULT_NO_2 6*1 X /\nFAULT_NORD 6*1 Y /\n/\nMULTFLT\nG 2 /\n/\n");
  EXPECT_EQ(read.grid.edits.faults.size(), 1U);
  ASSERT_EQ(read.notes.size(), 2U);
  EXPECT_NE(read.notes[0].find("14: FAULTS 'FAULT_NORTH' and 'FAULT_NO_2' are one fault"), std::string::npos)
      << read.notes[0];
  EXPECT_NE(read.notes[1].find("18: MULTFLT names 'G'"), std::string::npos) << read.notes[1];
}

TEST(DeckConnections, MultipliersOfEditMultiplyThoseOfGrid) {
  const ConnectionEdits edits = case_of("GRID\n" + unit_boxes(2, 1, 1) + R"(
MULTX
 0.5 1* /
MULTX
 1* 0.25 /
EQUALS
 'MULTZ-' 3 1 1 /
/
MULTPV
 2 3 /
EDIT
MULTX
 9 9 /
MULTX
 2* /
EQUALS
 MULTX 10 1 1 /
/
MULTIPLY
 MULTX 2 /
 MULTY 4 2 2 /
/
MULTPV
 10 1* /
)")
                                    .grid.edits;
  // GRID 0.5 0.25; EDIT 9 9, then 10 9, then doubled.
  EXPECT_EQ(multiplier(edits, FaceDirection::i_plus), (Reals{0.5 * 20, 0.25 * 18}));
  EXPECT_EQ(multiplier(edits, FaceDirection::j_plus), (Reals{1, 4}));
  EXPECT_EQ(multiplier(edits, FaceDirection::k_minus), (Reals{3, 1}));
  EXPECT_TRUE(multiplier(edits, FaceDirection::i_minus).empty());
  EXPECT_EQ(edits.pore_volume_multiplier, (Reals{2, 3}));
  EXPECT_EQ(edits.pore_volume_multiplier_edit, (Reals{10, 1}));
}

TEST(DeckConnections, ReadsRegionMultipliersWithAllOptions) {
  const ConnectionEdits edits = edits_of(R"(
MULTREGT
 1 2 0.5 /
 1* -1 0.1 XY NNC F /
 3 3 0 'Z' 'NONNC' 1* /
 4 5 1.0D-2 XYZ NOAQUNNC O /
/
MULTREGP
 2 0.5 /
 -1 9 /
 3 2 F /
/
)");
  ASSERT_EQ(edits.region_multipliers.size(), 4U);
  const auto& first = edits.region_multipliers[0];
  EXPECT_EQ(first.from, 1);
  EXPECT_EQ(first.to, 2);
  EXPECT_EQ(first.multiplier, 0.5);
  EXPECT_EQ(first.directions, (std::array<bool, 3>{true, true, true}));
  EXPECT_EQ(first.connections, RegionConnections::all);
  EXPECT_EQ(first.regions, RegionSet::multnum);
  const auto& second = edits.region_multipliers[1];
  EXPECT_FALSE(second.from);
  EXPECT_FALSE(second.to);
  EXPECT_EQ(second.directions, (std::array<bool, 3>{true, true, false}));
  EXPECT_EQ(second.connections, RegionConnections::only_non_neighbours);
  EXPECT_EQ(second.regions, RegionSet::fluxnum);
  EXPECT_EQ(edits.region_multipliers[2].regions, RegionSet::fluxnum) << "left out: as in the record before";
  EXPECT_EQ(edits.region_multipliers[2].connections, RegionConnections::only_neighbours);
  EXPECT_EQ(edits.region_multipliers[3].connections, RegionConnections::not_aquifer_non_neighbours);
  EXPECT_EQ(edits.region_multipliers[3].multiplier, 0.01);
  EXPECT_EQ(edits.region_multipliers[3].regions, RegionSet::opernum);
  ASSERT_EQ(edits.region_pore_volumes.size(), 2U) << "a negative region has no effect";
  EXPECT_EQ(edits.region_pore_volumes[0].region, 2);
  EXPECT_EQ(edits.region_pore_volumes[0].regions, RegionSet::multnum);
  EXPECT_EQ(edits.region_pore_volumes[1].multiplier, 2.0);
  EXPECT_EQ(edits.region_pore_volumes[1].regions, RegionSet::fluxnum);
}

TEST(DeckConnections, ConvertsNonNeighbourConnections) {
  const auto read = [](const std::string& units) {
    return case_of(units + unit_boxes(3, 2, 1) +
                   "NNC\n 1 1 1 3 2 1 0.5 /\n 3 1 1 1 1 1 /\n/\nEDITNNC\n 1 1 1 3 2 1 2 /\n/\nEDITNNCR\n 1 1 1 3 1 1 4 "
                   "/\n/\n")
        .grid.edits;
  };
  const ConnectionEdits edits = read("");
  ASSERT_EQ(edits.non_neighbours.size(), 2U);
  EXPECT_EQ(edits.non_neighbours[0].first, HostCellId(0));
  EXPECT_EQ(edits.non_neighbours[0].second, HostCellId(5));
  // 1 cP rm3 / (day bar) = 1e-3 Pa s m3 / (86400 s 1e5 Pa)
  EXPECT_DOUBLE_EQ(edits.non_neighbours[0].value, 0.5 * 1e-3 / (86400.0 * 1e5));
  EXPECT_EQ(edits.non_neighbours[1].value, 0.0);
  EXPECT_EQ(edits.non_neighbour_multipliers[0].value, 2.0);
  EXPECT_DOUBLE_EQ(edits.non_neighbour_transmissibilities[0].value, 4 * 1e-3 / (86400.0 * 1e5));
  EXPECT_DOUBLE_EQ(read("FIELD\n").non_neighbours[0].value, 0.5 * m3_per_transmissibility_unit(UnitSystem::field));
  EXPECT_EQ(read("FIELD\n").non_neighbour_multipliers[0].value, 2.0);
}

TEST(DeckConnections, ReadsPinchWithItsOptions) {
  const ConnectionEdits plain = edits_of("PINCH\n /\n");
  ASSERT_TRUE(plain.pinch);
  EXPECT_EQ(plain.pinch->threshold, 0.001);
  EXPECT_TRUE(plain.pinch->across_gaps);
  EXPECT_EQ(plain.pinch->largest_gap, 1e20);
  EXPECT_EQ(plain.pinch->transmissibility, PinchTransmissibility::top_and_bottom);
  EXPECT_EQ(plain.pinch->multiplier, PinchMultiplier::top);
  const Case read = case_of("FIELD\n" + unit_boxes(1, 1, 1) + "PINCH\n 10 NOGAP 20 ALL 'ALL' /\nPINCHOUT\n");
  const PinchOptions& pinch = *read.grid.edits.pinch;
  EXPECT_DOUBLE_EQ(pinch.threshold, 10 * 0.3048);
  EXPECT_FALSE(pinch.across_gaps);
  EXPECT_DOUBLE_EQ(pinch.largest_gap, 20 * 0.3048);
  EXPECT_EQ(pinch.transmissibility, PinchTransmissibility::all_layers);
  EXPECT_EQ(pinch.multiplier, PinchMultiplier::all);
  EXPECT_TRUE(read.grid.edits.pinchout);
  EXPECT_TRUE(read.grid.connects_across_pinch);
  EXPECT_TRUE(read.notes.empty()) << read.notes.front();
}

TEST(DeckConnections, ReadsLeastPoreVolumes) {
  EXPECT_EQ(edits_of("MINPV\n 500 /\n").least_pore_volume, 500.0);
  EXPECT_EQ(edits_of("MINPORV\n /\n").least_pore_volume, 1e-6);
  const ConnectionEdits edits =
      case_of("FIELD\n" + unit_boxes(3, 1, 1) + "MINPVV\n 1* 7 1* /\nMINPV\n 2 /\n").grid.edits;
  EXPECT_DOUBLE_EQ(*edits.least_pore_volume, 2 * m3_per_barrel);
  EXPECT_EQ(edits.least_pore_volume_by_cell, (Reals{2 * m3_per_barrel, 7 * m3_per_barrel, 2 * m3_per_barrel}));
}

TEST(DeckConnections, ReadsHowTransmissibilitiesAreAskedFor) {
  EXPECT_EQ(edits_of("").method, TransmissibilityMethod::by_geometry);
  EXPECT_EQ(edits_of("NEWTRAN\n").method, TransmissibilityMethod::newtran);
  EXPECT_EQ(edits_of("OLDTRAN\nNEWTRAN\n").method, TransmissibilityMethod::newtran) << "the last one counts";
}

TEST(DeckConnections, RefusesTransmissibilitiesOfBlockCentres) {
  for (const std::string keyword : {"OLDTRAN", "OLDTRANR"}) {
    const auto error = error_of([&] { return edits_of("NEWTRAN\n" + keyword + "\n"); });
    ASSERT_TRUE(error) << keyword;
    EXPECT_EQ(error->where().keyword, keyword);
    EXPECT_GT(error->where().line, 0);
    EXPECT_NE(error->problem().advice.find("take the keyword out"), std::string::npos);
  }
}

TEST(DeckConnections, KeepsEditsOfComputedArraysInTheirOrder) {
  const Case read = case_of("RUNSPEC\nFIELD\nGRID\n" + unit_boxes(2, 1, 2) + R"(
EDIT
MULTIPLY
 'TRANX' 2.5 1 1 1 1 1 2 /
/
BOX
 1 2 1 1 2 2 /
TRANZ
 1* 3 /
ENDBOX
EQUALS
 PORV 1000 2 2 1 1 1 1 /
 DEPTH 100 /
/
ADD
 TRANY 1 /
/
MINVALUE
 PORV 5 /
/
MAXVALUE
 TRANZ 1E-9 /
/
COPY
 TRANX TRANY 1 2 /
/
)");
  const auto& edits = read.grid.edits.array_edits;
  ASSERT_EQ(edits.size(), 8U);
  const double transmissibility = m3_per_transmissibility_unit(UnitSystem::field);
  EXPECT_EQ(edits[0].array, ComputedArray::transmissibility_x);
  EXPECT_EQ(edits[0].operation, ArrayOperation::multiply);
  EXPECT_EQ(edits[0].value, 2.5);
  EXPECT_EQ(edits[0].cells, (CellBox{{0, 0, 0}, {0, 0, 1}}));
  EXPECT_EQ(edits[1].operation, ArrayOperation::set);
  EXPECT_EQ(edits[1].cells, (CellBox{{0, 0, 1}, {1, 0, 1}}));
  ASSERT_EQ(edits[1].values.size(), 2U);
  EXPECT_TRUE(std::isnan(edits[1].values[0])) << "a default keeps what is there";
  EXPECT_DOUBLE_EQ(edits[1].values[1], 3 * transmissibility);
  EXPECT_DOUBLE_EQ(edits[2].value, 1000 * m3_per_barrel);
  EXPECT_EQ(edits[3].array, ComputedArray::depth);
  EXPECT_DOUBLE_EQ(edits[3].value, 100 * 0.3048);
  EXPECT_EQ(edits[4].operation, ArrayOperation::add);
  EXPECT_EQ(edits[5].operation, ArrayOperation::at_least);
  EXPECT_EQ(edits[6].operation, ArrayOperation::at_most);
  EXPECT_DOUBLE_EQ(edits[6].value, 1e-9 * transmissibility);
  EXPECT_EQ(edits[7].operation, ArrayOperation::copy);
  EXPECT_EQ(edits[7].source, ComputedArray::transmissibility_x);
  EXPECT_EQ(edits[7].array, ComputedArray::transmissibility_y);
  ASSERT_EQ(read.notes.size(), 1U);
  EXPECT_NE(read.notes[0].find("DEPTH is read, and not applied to depths yet"), std::string::npos);
}

TEST(DeckConnections, NotesMultipliersThatChangeWithTime) {
  const Case read = case_of("GRID\n" + unit_boxes(1, 1, 1) +
                            "SCHEDULE\nMULTFLT\n 'F' 0.1 /\n/\nMULTX\n 0.5 /\nMULTX\n 0.5 /\nMULTREGT\n 1 2 0 /\n/\n");
  ASSERT_EQ(read.notes.size(), 3U);
  EXPECT_EQ(read.notes[0], "case.GRDECL:14: MULTFLT in SCHEDULE changes the grid with time; it is not applied");
  EXPECT_TRUE(multiplier(read.grid.edits, FaceDirection::i_plus).empty());
}

TEST(DeckConnections, ManyEditsStayWithinTheLimits) {
  std::string text = unit_boxes(1, 1, 1) + "MULTIPLY\n";
  for (int n = 0; n < 20'000; ++n) text += "TRANX 2/\n";
  MemoryFiles files({{"case", text + "/\n"}});
  DeckLimits limits;
  limits.free_values = 1000;
  const auto error = error_of([&] { return parse_case(files, "case", {}, limits); });
  ASSERT_TRUE(error);
  EXPECT_NE(std::string(error->what()).find("for files of this size"), std::string::npos) << error->what();
}

}  // namespace
}  // namespace wellknit
