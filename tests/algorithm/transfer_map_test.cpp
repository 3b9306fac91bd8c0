// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/transfer_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "algorithm/build_mesh.h"
#include "model/errors.h"
#include "tests/support/near_well.h"

namespace wellknit {
namespace {

constexpr double unset = -1.0;

/// Source cells of 10, 20 and 30 m3 with 1, 4 and 0 m3 of pores; mesh cell 0 is the first and half of the second, mesh
/// cell 1 the rest.
Mesh three_into_two() {
  Mesh mesh;
  mesh.source_dimensions = {3, 1, 1};
  mesh.cells.kind.resize(2);
  mesh.transfer = {{0, 1, 3, 4}, {CellId(0), CellId(0), CellId(1), CellId(1)}, {1.0, 0.5, 0.5, 1.0}};
  mesh.source_volumes = {{10.0, 20.0, 30.0}, {1.0, 4.0, 0.0}};
  return mesh;
}

TEST(TransferMap, MeansForwardAreWeighted) {
  const std::vector<double> values{1.0, 2.0, 5.0};
  const auto by_volume = mean_forward(three_into_two(), values, PartWeight::volume, unset);
  EXPECT_DOUBLE_EQ(by_volume[0], (10.0 * 1.0 + 10.0 * 2.0) / 20.0);
  EXPECT_DOUBLE_EQ(by_volume[1], (10.0 * 2.0 + 30.0 * 5.0) / 40.0);
  const auto by_pores = mean_forward(three_into_two(), values, PartWeight::pore_volume, unset);
  EXPECT_DOUBLE_EQ(by_pores[0], (1.0 * 1.0 + 2.0 * 2.0) / 3.0);
  EXPECT_DOUBLE_EQ(by_pores[1], 2.0);
}

TEST(TransferMap, WhatIsNotANumberIsLeftOut) {
  const double none = std::nan("");
  EXPECT_DOUBLE_EQ(mean_forward(three_into_two(), {none, 2.0, 5.0}, PartWeight::volume, unset)[0], 2.0);
  EXPECT_DOUBLE_EQ(mean_forward(three_into_two(), {none, none, 5.0}, PartWeight::volume, unset)[0], unset);
  EXPECT_DOUBLE_EQ(mean_back(three_into_two(), {none, 3.0}, unset)[0], unset);
  EXPECT_DOUBLE_EQ(mean_back(three_into_two(), {none, 3.0}, unset)[1], 3.0);
}

TEST(TransferMap, SumsAreSharedOut) {
  const auto forward = sum_forward(three_into_two(), {1.0, 2.0, 5.0}, unset);
  EXPECT_EQ(forward, (std::vector<double>{1.0 + 1.0, 1.0 + 5.0}));
  // Back by volume: mesh cell 0 is 10 + 10, mesh cell 1 is 10 + 30 m3.
  const auto back = sum_back(three_into_two(), {4.0, 8.0}, PartWeight::volume, unset);
  EXPECT_EQ(back, (std::vector<double>{2.0, 2.0 + 2.0, 6.0}));
}

TEST(TransferMap, IntegersAreThoseOfTheLargestPart) {
  EXPECT_EQ(largest_forward(three_into_two(), {7, 8, 9}, PartWeight::volume, 0), (std::vector<std::int32_t>{7, 9}));
  EXPECT_EQ(largest_forward(three_into_two(), {7, 8, 9}, PartWeight::pore_volume, 0),
            (std::vector<std::int32_t>{8, 8}));
  EXPECT_EQ(largest_back(three_into_two(), {3, 4}, 0), (std::vector<std::int32_t>{3, 3, 4}));
}

TEST(TransferMap, ConservesOnANearWellMesh) {
  Case source = near_well::deformed(0.5);
  near_well::randomise(source.grid, 21);
  const Mesh mesh = build_mesh(source, {near_well::well(near_well::Path::deviated, 15.0)}, {}).mesh;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(1.0, 2.0);
  std::vector<double> values(mesh.transfer.start.size() - 1);
  for (double& value : values) value = uniform(random);
  const auto total = [](const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); };
  const auto amounts = sum_forward(mesh, values, 0.0);
  EXPECT_NEAR(total(amounts) / total(values), 1.0, 1e-12);
  EXPECT_NEAR(total(sum_back(mesh, amounts, PartWeight::pore_volume, 0.0)) / total(values), 1.0, 1e-12);
  // A mean by pore volume keeps what is in the pores: a mesh cell's pores are the sum of its parts'.
  const auto means = mean_forward(mesh, values, PartWeight::pore_volume, 0.0);
  double in_source = 0.0;
  double in_mesh = 0.0;
  for (std::size_t s = 0; s < values.size(); ++s) in_source += mesh.source_volumes.pores[s] * values[s];
  for (std::size_t c = 0; c < means.size(); ++c) in_mesh += mesh.cells.pore_volume[CellId(c)] * means[c];
  EXPECT_NEAR(in_mesh / in_source, 1.0, 1e-9);
  // A constant stays one, both ways.
  for (const double v : mean_back(mesh, std::vector<double>(mesh.cells.size(), 3.5), unset)) EXPECT_NEAR(v, 3.5, 1e-12);
}

TEST(TransferMap, RefusesAMeshWithoutItsMap) {
  EXPECT_THROW((void)mean_back(Mesh(), {}, unset), InvalidInput);
  Mesh old = three_into_two();
  old.source_volumes = {};
  EXPECT_THROW((void)mean_forward(old, {1.0, 2.0, 3.0}, PartWeight::volume, unset), InvalidInput);
  EXPECT_EQ(mean_back(old, {1.0, 2.0}, unset).size(), 3U) << "back needs no volumes";
  EXPECT_THROW((void)mean_back(old, {1.0}, unset), InvalidInput);
}

}  // namespace
}  // namespace wellknit
