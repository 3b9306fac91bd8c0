// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Read back by matio; check_mrst.py has Octave load the test meshes by the shipped loader.

#include "writers/write_mrst.h"

#include <gtest/gtest.h>
#include <matio.h>

#include <cmath>

#include "model/errors.h"
#include "model/units.h"
#include "tests/support/meshes.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

class MatlabFile {
 public:
  explicit MatlabFile(const Mesh& mesh, const MrstOptions& options = {}) {
    notes = write_mrst(mesh, folder_.file("out.mat"), options);
    file_ = Mat_Open(folder_.file("out.mat").c_str(), MAT_ACC_RDONLY);
  }
  ~MatlabFile() {
    for (matvar_t* variable : read_) Mat_VarFree(variable);
    Mat_Close(file_);
  }
  MatlabFile(const MatlabFile&) = delete;
  MatlabFile& operator=(const MatlabFile&) = delete;

  /// The values at a path such as {"G", "cells", "num"}, column by column; of the struct's element `n`.
  std::vector<double> numbers(const std::vector<std::string>& path, std::size_t n = 0) {
    const matvar_t* variable = at(path, n);
    if (variable == nullptr) throw InvalidInput("no " + path.back());
    std::vector<double> out;
    for (std::size_t i = 0; i < variable->nbytes / static_cast<std::size_t>(variable->data_size); ++i)
      out.push_back(variable->data_type == MAT_T_INT32 ? static_cast<const std::int32_t*>(variable->data)[i]
                                                       : static_cast<const double*>(variable->data)[i]);
    EXPECT_EQ(variable->class_type, MAT_C_DOUBLE) << path.back();
    return out;
  }
  const matvar_t* at(const std::vector<std::string>& path, std::size_t n = 0) {
    matvar_t* variable = Mat_VarRead(file_, path.front().c_str());
    if (variable == nullptr) return nullptr;
    read_.push_back(variable);
    for (std::size_t i = 1; i < path.size(); ++i)
      variable = Mat_VarGetStructFieldByName(variable, path[i].c_str(), i == 1 ? n : 0);
    return variable;
  }
  std::string bytes() { return folder_.read("out.mat"); }

  std::vector<std::string> notes;

 private:
  ScratchFolder folder_;
  mat_t* file_ = nullptr;
  std::vector<matvar_t*> read_;
};

using Numbers = std::vector<double>;

TEST(WriteMrst, WritesTwoBoxesByHand) {
  Mesh mesh = meshes::two_boxes();
  mesh.cells.volume.raw() = {1.0, 2.0};  // without the rounding of their sums
  MatlabFile file(mesh);
  EXPECT_EQ(file.numbers({"G", "cells", "num"}), Numbers{2});
  EXPECT_EQ(file.numbers({"G", "cells", "facePos"}), (Numbers{1, 7, 13}));
  EXPECT_EQ(file.numbers({"G", "cells", "volumes"}), (Numbers{1, 2}));
  EXPECT_EQ(file.numbers({"G", "cells", "centroids"}), (Numbers{0.5, 2, 0.5, 0.5, 0.5, 0.5}));
  EXPECT_EQ(file.numbers({"G", "faces", "num"}), Numbers{11});
  EXPECT_EQ(file.numbers({"G", "nodes", "num"}), Numbers{12});
  EXPECT_EQ(file.numbers({"G", "nodes", "coords"})[35], 1.0);  // the deepest: depth stays as it is
  EXPECT_EQ(file.numbers({"G", "griddim"}), Numbers{3});
  EXPECT_EQ(file.numbers({"N"}), (Numbers{1, 2}));
  // 100 mD over half lengths of 0.5 and 1 m and an area of 1 m2: k / 1.5.
  ASSERT_EQ(file.numbers({"T"}).size(), 1U);
  EXPECT_NEAR(file.numbers({"T"})[0], 6.579488e-14, 1e-20);
  EXPECT_EQ(file.numbers({"rock", "perm"}), Numbers(6, 100 * m2_per_millidarcy));
  EXPECT_EQ(file.at({"W"}), nullptr);
  EXPECT_TRUE(file.notes.empty());
  // Outside is 0; every normal points from the first neighbour to the second.
  const Numbers neighbours = file.numbers({"G", "faces", "neighbors"});
  EXPECT_EQ(std::count(neighbours.begin(), neighbours.end(), 0.0), 10);
}

TEST(WriteMrst, HasAFaceLessConnectionAsNncAndAtTheEndOfTheList) {
  const Mesh mesh = meshes::box_grid(2);
  MatlabFile file(mesh);
  EXPECT_EQ(file.numbers({"G", "nnc", "cells"}), (Numbers{1, 8}));
  const Numbers pairs = file.numbers({"N"});
  const Numbers flow = file.numbers({"T"});
  ASSERT_EQ(flow.size(), 13U);  // 12 faces inside 2 x 2 x 2 cells
  EXPECT_EQ(pairs[12], 1.0);
  EXPECT_EQ(pairs[25], 8.0);
  EXPECT_EQ(flow.back(), file.numbers({"G", "nnc", "trans"})[0]);
}

TEST(WriteMrst, HasAZeroForAFaceThatNothingCrosses) {
  Mesh mesh = meshes::two_boxes();
  mesh.connections = {};
  MatlabFile file(mesh);
  EXPECT_EQ(file.numbers({"N"}), (Numbers{1, 2}));
  EXPECT_EQ(file.numbers({"T"}), Numbers{0});
}

TEST(WriteMrst, WritesTheWells) {
  const Mesh mesh = meshes::ring_in_boxes();
  MatlabFile file(mesh);
  for (std::size_t n = 0; n < mesh.wells.size(); ++n) {
    const MeshWell& well = mesh.wells[WellId(n)];
    ASSERT_EQ(file.numbers({"W", "cells"}, n).size(), well.connections.size());
    for (std::size_t i = 0; i < well.connections.size(); ++i) {
      EXPECT_EQ(file.numbers({"W", "cells"}, n)[i], static_cast<double>(well.connections[i].cell.value() + 1));
      EXPECT_EQ(file.numbers({"W", "WI"}, n)[i], well.connections[i].well_index);
    }
    EXPECT_EQ(file.numbers({"W", "sign"}, n), Numbers{well.type == WellType::injector ? 1.0 : -1.0});
    EXPECT_TRUE(std::isnan(file.numbers({"W", "val"}, n)[0]));
  }
  EXPECT_EQ(file.notes.size(), 1U);
}

TEST(WriteMrst, AddsUpPerforationsOfOneCell) {
  Mesh mesh = meshes::ring_in_boxes();
  MeshWell& well = mesh.wells[WellId(0)];
  well.connections = {{CellId(3), 1.0, {5, 6}}, {CellId(1), 4.0, {6, 7}}, {CellId(3), 2.0, {7, 8}}};
  MatlabFile file(mesh);
  EXPECT_EQ(file.numbers({"W", "cells"}), (Numbers{4, 2}));
  EXPECT_EQ(file.numbers({"W", "WI"}), (Numbers{3, 4}));
}

TEST(WriteMrst, GivesTheSameBytesTwice) {
  EXPECT_EQ(MatlabFile(meshes::ring_in_boxes()).bytes(), MatlabFile(meshes::ring_in_boxes()).bytes());
}

}  // namespace
}  // namespace wellknit
