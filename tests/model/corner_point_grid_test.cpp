// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/corner_point_grid.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "model/errors.h"
#include "tests/support/grids.h"

namespace wellknit {
namespace {

/// Readers give none of these grids: they are what a program that fills a grid itself can do wrong.
TEST(CornerPointGrid, RefusesWhatIsNoGrid) {
  struct Wrong {
    const char* message;
    std::function<void(CornerPointGrid&)> change;
  };
  const ArrayEdit edit{ComputedArray::transmissibility_x, ArrayOperation::set, {{0, 0, 0}, {1, 0, 0}}, 0.0, {1.0}};
  for (const Wrong& wrong : std::vector<Wrong>{
           {"the grid has no cells: its dimensions must be at least 1 1 1", [](auto& g) { g.dimensions[1] = 0; }},
           {"the grid of 100000 x 100000 x 100000 cells is too large: at most 250000000 cells can be read",
            [](auto& g) {
              g.dimensions = {100000, 100000, 100000};
            }},
           {"COORD has 35 values where the dimensions ask for 36", [](auto& g) { g.coord.pop_back(); }},
           {"COORD holds a value that is not finite",
            [](auto& g) { g.coord[3] = std::numeric_limits<double>::infinity(); }},
           {"ZCORN holds a value that is not finite",
            [](auto& g) { g.zcorn[3] = std::numeric_limits<double>::quiet_NaN(); }},
           {"NNC names a cell outside the grid",
            [](auto& g) {
              g.edits.non_neighbours = {{HostCellId(0), HostCellId(2), 1.0}};
            }},
           {"FAULTS names cells outside the grid along K",
            [](auto& g) {
              g.edits.faults = {{"F", {{{{0, 0, 0}, {0, 0, 1}}, FaceDirection::i_plus}}, 1.0}};
            }},
           {"TRANX has 1 values for a box of 2 cells", [&](auto& g) { g.edits.array_edits = {edit}; }},
           {"transmissibilities of block centres (OLDTRAN, OLDTRANR) are not available: ask for NEWTRAN",
            [](auto& g) { g.edits.method = TransmissibilityMethod::oldtran; }},
       }) {
    auto grid = grids::box({2, 1, 1});
    EXPECT_NO_THROW(validate(grid));
    wrong.change(grid);
    try {
      validate(grid);
      ADD_FAILURE() << "accepted: " << wrong.message;
    } catch (const InvalidInput& error) {
      EXPECT_STREQ(error.what(), wrong.message);
    }
  }
}

}  // namespace
}  // namespace wellknit
