// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The text of the deck is looked at here; check_flow_deck.py has Flow run it.

#include "writers/write_flow_deck.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "model/errors.h"
#include "model/units.h"
#include "tests/support/meshes.h"
#include "tests/support/scratch_folder.h"
#include "writers/deck_layout.h"

namespace wellknit {
namespace {

struct Deck {
  std::string text;
  std::vector<std::string> notes;
};

Deck written(const Mesh& mesh, const FlowDeckOptions& options = {}) {
  const ScratchFolder folder;
  Deck deck;
  deck.notes = write_flow_deck(mesh, folder.file("out.DATA"), options);
  deck.text = folder.read("out.DATA");
  return deck;
}

/// The records of a keyword: what stands between its line and the next line with only a slash.
std::vector<std::string> records(const std::string& text, const std::string& keyword) {
  std::vector<std::string> out;
  std::istringstream in(text.substr(text.find("\n" + keyword + "\n") + 1));
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line) && line != "/") out.push_back(line);
  return out;
}

/// The numbers of an array keyword, repeat counts expanded.
std::vector<double> array(const std::string& text, const std::string& keyword) {
  std::vector<double> out;
  for (const std::string& line : records(text, keyword)) {
    std::istringstream in(line);
    std::string token;
    while (in >> token) {
      const std::size_t star = token.find('*');
      const std::size_t count = star == std::string::npos ? 1 : std::stoul(token.substr(0, star));
      out.insert(out.end(), count, std::stod(star == std::string::npos ? token : token.substr(star + 1)));
    }
  }
  return out;
}

TEST(WriteFlowDeck, WritesTheTransmissibilityOfTwoBoxes) {
  // 66.6667 mD m are 66.6667 * 0.008527014671917 = 0.568468 cP rm3/(day bar).
  const std::vector<std::string> nnc = records(written(meshes::two_boxes()).text, "NNC");
  ASSERT_EQ(nnc.size(), 1U);
  EXPECT_EQ(nnc[0].substr(0, 15), " 1 1 1 2 1 1 0.");
  EXPECT_NEAR(std::stod(nnc[0].substr(13)), 0.568468, 5e-7);
}

TEST(WriteFlowDeck, GivesEachBoxItsVolumeDepthAndThickness) {
  const Mesh mesh = meshes::ring_in_boxes();
  const std::string text = written(mesh).text;
  const std::vector<double> coord = array(text, "COORD");
  const std::vector<double> zcorn = array(text, "ZCORN");
  const std::size_t n = mesh.cells.size();
  ASSERT_EQ(coord.size(), 12 * (n + 1));
  ASSERT_EQ(zcorn.size(), 8 * n);
  const double width = coord[6 * (n + 1) + 1];
  for (std::size_t c = 0; c < n; ++c) {
    const double length = coord[6 * (c + 1)] - coord[6 * c];
    const double top = zcorn[2 * c];
    const double base = zcorn[4 * n + 2 * c];
    EXPECT_NEAR(base - top, 5.0, 1e-9);  // every cell is a layer thick
    EXPECT_NEAR(0.5 * (top + base), mesh.cells.depth[CellId(c)], 1e-9);
    EXPECT_NEAR(length * width * (base - top) / mesh.cells.volume[CellId(c)], 1.0, 1e-9);
  }
}

TEST(WriteFlowDeck, KeepsPoreVolumesExactly) {
  const Mesh mesh = meshes::box_grid(3);
  EXPECT_EQ(array(written(mesh).text, "PORV"),
            std::vector<double>(mesh.cells.pore_volume.begin(), mesh.cells.pore_volume.end()));
}

TEST(WriteFlowDeck, AddsUpConnectionsOfOnePair) {
  Mesh mesh = meshes::two_boxes();
  Connections& all = mesh.connections;
  all.cells.push_back({CellId(0), CellId(1)});
  all.transmissibility.push_back(2.0 * all.transmissibility[ConnectionId(0)]);
  for (auto* values : {&all.area, &all.non_orthogonality, &all.k_non_orthogonality, &all.planarity, &all.multiplier})
    values->push_back(0.0);
  all.face.push_back(FaceId());
  all.normal.push_back(Vec3::Zero());
  all.half_distance.push_back({0.0, 0.0});
  all.kind.push_back(ConnectionKind::deck_nnc);
  const std::vector<std::string> nnc = records(written(mesh).text, "NNC");
  ASSERT_EQ(nnc.size(), 1U);
  EXPECT_NEAR(std::stod(nnc[0].substr(13)), 3.0 * 0.568468, 2e-6);
}

TEST(WriteFlowDeck, AddsUpPerforationsOfOneCell) {
  Mesh mesh = meshes::box_grid(2);
  std::vector<WellConnection>& connections = mesh.wells[WellId(0)].connections;
  ASSERT_EQ(connections.size(), 2U);
  connections[1].cell = connections[0].cell;
  const double sum =
      (connections[0].well_index + connections[1].well_index) / m3_per_transmissibility_unit(UnitSystem::metric);
  const std::vector<std::string> lines = records(written(mesh).text, "COMPDAT");
  ASSERT_EQ(lines.size(), 3U);
  std::istringstream in(lines[0]);
  std::string token;
  for (int i = 0; i < 8; ++i) in >> token;
  EXPECT_DOUBLE_EQ(std::stod(token), sum) << lines[0];
}

TEST(WriteFlowDeck, LeavesOutCellsWithoutPoreVolumeAndSaysSo) {
  Mesh mesh = meshes::box_grid(2);
  mesh.cells.pore_volume[CellId(0)] = 0.0;  // a corner: 3 faces inside, an NNC, and the injector's first perforation
  const Deck deck = written(mesh);
  EXPECT_EQ(array(deck.text, "ACTNUM"), (std::vector<double>{0, 1, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(records(deck.text, "NNC").size(), 12U + 1U - 4U);
  EXPECT_EQ(records(deck.text, "COMPDAT").size(), 3U);
  ASSERT_FALSE(deck.notes.empty());
  EXPECT_EQ(deck.notes[0],
            "1 cells without pore volume are inactive in the deck, with 4 connections and 1 perforations");
}

TEST(WriteFlowDeck, LeavesOutAWellWithoutConnections) {
  Mesh mesh = meshes::box_grid(2);
  mesh.wells[WellId(1)].connections.clear();
  const Deck deck = written(mesh);
  EXPECT_EQ(records(deck.text, "WELSPECS").size(), 1U);
  EXPECT_EQ(deck.text.find("WCONPROD"), std::string::npos);
  EXPECT_EQ(
      deck.notes,
      (std::vector<std::string>{"well PROD is not in the deck: it has no connection to a cell with pore volume"}));
}

TEST(WriteFlowDeck, CountsConnectionsThatFlowDoesNotSee) {
  Mesh mesh = meshes::box_grid(2);
  const double unit = m3_per_transmissibility_unit(UnitSystem::metric);
  for (std::size_t i = 0; i < mesh.connections.size(); ++i)
    mesh.connections.transmissibility[ConnectionId(i)] = 0.99e-6 * unit;
  // 12 faces and the NNC 0-7, without the neighbours in the row 0-1, 2-3, 4-5 and 6-7.
  EXPECT_EQ(written(mesh).notes,
            (std::vector<std::string>{"9 connections lie below 1e-06 cP rm3/(day bar): Flow sets them to zero"}));
  EXPECT_EQ(records(written(mesh).text, "NNC").size(), 13U);  // they stand in the deck all the same
}

TEST(WriteFlowDeck, SetsPressuresOfWellsAroundTheInitialOne) {
  const std::string text = written(meshes::box_grid(2), {FlowFluids::water}).text;
  // Depths 2000 to 2010: datum 2005, 0.1 bar a metre: 200.5 bar; drawdown a fifth: 40.1 bar. Water weighs 1000
  // * 9.80665e-5 bar/m. INJ has its own reference depth, 1990 m; PROD's is its first cell's, 2002.5 m.
  EXPECT_EQ(records(text, "WCONINJE"),
            (std::vector<std::string>{" 'INJ' WATER OPEN BHP 2* 239.129 /"}));  // 200.5 - 15 * 0.0980665 + 40.1
  EXPECT_EQ(records(text, "WCONPROD"),
            (std::vector<std::string>{" 'PROD' OPEN BHP 5* 160.15483 /"}));  // 200.5 - 2.5 * 0.0980665 - 40.1
  const std::vector<std::string> wells = records(text, "WELSPECS");
  ASSERT_EQ(wells.size(), 2U);
  EXPECT_EQ(wells[0], " 'INJ' 'G' 1 1 1990 WATER /");
  EXPECT_EQ(wells[1].substr(0, 16), " 'PROD' 'G' 4 1 ");
  EXPECT_NEAR(std::stod(wells[1].substr(16)), 2002.5, 1e-9);
}

TEST(WriteFlowDeck, KeepsLinesWithin128Characters) {
  Mesh mesh = meshes::ring_in_boxes();
  mesh.wells[WellId(0)].name = std::string(300, 'n') + "\n/\nEND";
  std::istringstream in(written(mesh).text);
  std::string line;
  while (std::getline(in, line)) EXPECT_LE(line.size(), 128U) << line;
}

FlowDeckOptions in_layout(DeckLayoutKind layout) { return {FlowFluids::oil_and_water, layout, CellOrder::mesh}; }

TEST(WriteFlowDeck, PortableLayoutPutsBoxesWhereTheCellsAre) {
  const Mesh mesh = meshes::ring_in_boxes();
  const std::string text = written(mesh, in_layout(DeckLayoutKind::portable)).text;
  const std::size_t n = mesh.cells.size();
  EXPECT_EQ(records(text, "DIMENS").front(), " 127 1 1 /");  // 2 * 64 - 1
  const std::vector<double> coord = array(text, "COORD");
  ASSERT_EQ(coord.size(), 24 * n);  // two rows of 2 n pillars, six numbers each
  const std::vector<double> active = array(text, "ACTNUM");
  for (std::size_t c = 0; c < n; ++c) {
    const double* first = &coord[6 * (2 * c)];
    const double* last = &coord[6 * (2 * n + 2 * c + 1)];
    EXPECT_NEAR(0.5 * (first[0] + last[0]), mesh.cells.center[CellId(c)].x(), 1e-9);
    EXPECT_NEAR(0.5 * (first[1] + last[1]), mesh.cells.center[CellId(c)].y(), 1e-9);
    // Every cell is a layer of 5 m.
    EXPECT_NEAR((last[0] - first[0]) * (last[1] - first[1]) * 5.0 / mesh.cells.volume[CellId(c)], 1.0, 1e-9);
    EXPECT_EQ(active[2 * c], 1.0);
    if (c > 0) {
      EXPECT_EQ(active[2 * c - 1], 0.0);
    }
  }
  EXPECT_EQ(text.find("TRANX"), std::string::npos);  // no boxes touch
}

TEST(WriteFlowDeck, PortableLayoutHasEveryConnection) {
  const Mesh mesh = meshes::two_boxes();
  const std::vector<std::string> nnc = records(written(mesh, in_layout(DeckLayoutKind::portable)).text, "NNC");
  ASSERT_EQ(nnc.size(), 1U);
  EXPECT_EQ(nnc[0].substr(0, 15), " 1 1 1 3 1 1 0.");
}

/// The grid of meshes::box_grid(n).
CornerPointGrid grid_of_boxes(std::int64_t n) {
  CornerPointGrid grid;
  grid.dimensions = {n, n, n};
  for (std::int64_t j = 0; j <= n; ++j)
    for (std::int64_t i = 0; i <= n; ++i)
      grid.coord.insert(grid.coord.end(), {10.0 * static_cast<double>(i), 20.0 * static_cast<double>(j), 1000.0,
                                           10.0 * static_cast<double>(i), 20.0 * static_cast<double>(j), 3000.0});
  for (std::int64_t k = 0; k < n; ++k)
    for (const double base : {0.0, 5.0})
      grid.zcorn.insert(grid.zcorn.end(), static_cast<std::size_t>(4 * n * n),
                        2000.0 + 5.0 * static_cast<double>(k) + base);
  grid.active.assign(static_cast<std::size_t>(n * n * n), 1);
  return grid;
}

TEST(WriteFlowDeck, NestedLayoutKeepsTheSourceGrid) {
  Mesh mesh = meshes::box_grid(3);
  // The cell in the middle counts as made in the place of source cell 13.
  mesh.cells.kind[CellId(13)] = CellKind::transition;
  mesh.cells.source_cell[CellId(13)] = HostCellId();
  const CornerPointGrid source = grid_of_boxes(3);
  const ScratchFolder folder;
  const FlowDeckOptions options = in_layout(DeckLayoutKind::nested);
  write_flow_deck(mesh, folder.file("out.DATA"), options, Overwrite::refuse, &source);
  const std::string text = folder.read("out.DATA");
  EXPECT_EQ(records(text, "DIMENS").front(), " 5 3 3 /");  // a gap and a column beyond the three
  const std::vector<double> active = array(text, "ACTNUM");
  ASSERT_EQ(active.size(), 45U);
  for (std::size_t at = 0; at < 45; ++at) {
    const bool is_host = at % 5 < 3 && at != 1 + 5 * (1 + 3 * 1);
    EXPECT_EQ(active[at], is_host || at == 4 ? 1.0 : 0.0) << at;
  }
  const std::vector<double> coord = array(text, "COORD");
  ASSERT_EQ(coord.size(), 6U * 6U * 4U);
  EXPECT_EQ(coord[6 * 2], 20.0);
  // Pillars 4 and 5 of row 0 stand around the cell's centre (15, 30): 200 m2 are a square of 14.142 m.
  EXPECT_NEAR(coord[6 * 4], 15.0 - 0.5 * std::sqrt(200.0), 1e-9);
  EXPECT_NEAR(coord[6 * 5 + 1], 30.0 - 0.5 * std::sqrt(200.0), 1e-9);
  EXPECT_EQ(records(text, "NNC").size(), mesh.connections.size());
  EXPECT_NE(text.find(" MULTZ 0 /"), std::string::npos);

  const std::vector<std::string> names = flow_deck_side_files(folder.file("out.DATA"), options);
  ASSERT_EQ(names.size(), 3U);
  EXPECT_EQ(names[1], folder.file("OUT_REFINE.grdecl"));
  write_flow_deck_side_files(mesh, names, options, Overwrite::refuse, &source);
  const std::vector<double> level = array(folder.read("OUT_REFINE.grdecl"), "REFINE");
  const std::vector<double> number = array(folder.read("OUT_CELLS.grdecl"), "MESHCELL");
  const std::string old = folder.read("OUT_OLDIJK.grdecl");
  EXPECT_EQ(level[4], 2.0);
  EXPECT_EQ(std::count(level.begin(), level.end(), 1.0), 44);
  EXPECT_EQ(number[4], 14.0);
  EXPECT_EQ(number[1 + 5 * 4], 0.0);  // replaced
  for (const char* keyword : {"OLDI", "OLDJ", "OLDK"}) EXPECT_EQ(array(old, keyword)[4], 2.0) << keyword;
}

TEST(WriteFlowDeck, NestedLayoutNeedsItsOwnSource) {
  const ScratchFolder folder;
  const FlowDeckOptions options = in_layout(DeckLayoutKind::nested);
  const Mesh mesh = meshes::box_grid(3);
  EXPECT_THROW(write_flow_deck(mesh, folder.file("out.DATA"), options), InvalidInput);
  const CornerPointGrid other = grid_of_boxes(2);
  EXPECT_THROW(write_flow_deck(mesh, folder.file("out.DATA"), options, Overwrite::refuse, &other), InvalidInput);
  CornerPointGrid far = grid_of_boxes(3);
  for (double& depth : far.zcorn) depth += 500.0;
  EXPECT_THROW(write_flow_deck(mesh, folder.file("out.DATA"), options, Overwrite::refuse, &far), InvalidInput);
  EXPECT_EQ(folder.count(), 0U);
}

TEST(WriteFlowDeck, NestedLayoutRefusesAGridThatNoSimulatorHolds) {
  // One column of 5000 x 5000 places, and two more for the eight made cells: 3 x 25 million places.
  Mesh mesh = meshes::box_grid(2);
  mesh.source_dimensions = {1, 5000, 5000};
  mesh.cells.kind = IdVector<CellId, CellKind>(8, CellKind::transition);
  CornerPointGrid source;
  source.dimensions = mesh.source_dimensions;
  const DeckBoxes boxes{std::vector<double>(8, 200.0), std::vector<double>(8, 5.0)};
  DeckLayoutInput input{mesh, boxes, {}, &source};
  for (std::size_t c = 0; c < 8; ++c) input.order.emplace_back(c);
  try {
    (void)make_deck_layout(DeckLayoutKind::nested, input);
    FAIL() << "made";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(),
                 "layout=nested: 8 made cells beside 1 x 5000 x 5000 cells need a grid of 3 x 5000 x 5000 cells, more "
                 "than 50000000; use layout=portable");
  }
}

TEST(WriteFlowDeck, RefusesAMeshWithoutCells) {
  const ScratchFolder folder;
  EXPECT_THROW(write_flow_deck(Mesh(), folder.file("out.DATA")), InvalidInput);
  EXPECT_EQ(folder.count(), 0U);
}

}  // namespace
}  // namespace wellknit
