// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/assessment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "model/worst_cells.h"
#include "tests/support/meshes.h"

namespace wellknit {
namespace {

const KeyFigure* find(const Assessment& assessment, const std::string& name) {
  for (const KeyFigure& figure : assessment.figures)
    if (figure.figure == name) return &figure;
  return nullptr;
}

/// Two boxes, the second a transition cell whose centre is moved by `by`.
Mesh made_box(const Vec3& by) {
  Mesh mesh = meshes::two_boxes();
  mesh.cells.kind[CellId(1)] = CellKind::transition;
  mesh.cells.center[CellId(1)] += by;
  return mesh;
}

TEST(Assessment, OfAGoodMeshHasNothingToSay) {
  const Assessment result = assess(meshes::box_grid(2), {});
  EXPECT_TRUE(result.is_good());
  EXPECT_EQ(worst_of(result.figures), nullptr);
  ASSERT_NE(find(result, "nonorth_host_max_deg"), nullptr);          // nothing was made: the host's faces count
  EXPECT_EQ(headline(result), "Valid; all 4 key figures are good");  // this mesh knows nothing of its source's volumes
}

TEST(Assessment, NamesTheWorstFigure) {
  // 1.5 along and 15 across: atan 10 = 84.3 degrees, between 70 and 90; skewness 1.658, between 1 and 4. Of the way
  // from watch to poor the angle has gone 0.71, the skewness 0.22.
  const Assessment result = assess(made_box(Vec3(0, 15, 0)), {});
  ASSERT_NE(find(result, "nonorth_made_max_deg"), nullptr);
  EXPECT_EQ(find(result, "nonorth_made_max_deg")->grade, Grade::watch);
  EXPECT_NEAR(find(result, "nonorth_made_max_deg")->value, std::atan(10.0) * 180.0 / std::acos(-1.0), 1e-10);
  EXPECT_EQ(find(result, "skewness_made_max")->grade, Grade::watch);
  ASSERT_NE(worst_of(result.figures), nullptr);
  EXPECT_EQ(worst_of(result.figures)->figure, "nonorth_made_max_deg");
  EXPECT_FALSE(worst_of(result.figures)->advice.empty());
}

TEST(Assessment, TakesALimitForAThreshold) {
  const Assessment result = assess(made_box(Vec3(0, 15, 0)), {{"nonorth_made_max_deg", 80.0}});
  EXPECT_EQ(find(result, "nonorth_made_max_deg")->grade, Grade::poor);
  ASSERT_EQ(result.passed.size(), 1);
  EXPECT_EQ(result.passed[0].limit.name, "nonorth_made_max_deg");
}

TEST(Assessment, SharesAddUpToOne) {
  const Assessment result = assess(meshes::ring_in_boxes(), {});
  for (const PairQuality& pair : result.quality.pairs)
    for (std::size_t m = 0; m < face_measure_count; ++m) {
      const Distribution& values = pair.of(static_cast<FaceMeasure>(m));
      EXPECT_EQ(values.area_share.empty(), pair.faces == 0);
      EXPECT_FALSE(values.flow_mean.has_value());
      if (!values.area_share.empty()) {
        EXPECT_EQ(values.area_share.size(), classes_of(static_cast<FaceMeasure>(m)).size());
        EXPECT_NEAR(std::accumulate(values.area_share.begin(), values.area_share.end(), 0.0), 1.0, 1e-12);
      }
    }
}

TEST(Assessment, WeightsWithTheFlow) {
  Mesh mesh = meshes::box_grid(2);
  mesh.flow.emplace();
  mesh.flow->flux.resize(mesh.connections.size(), 0.0);
  mesh.flow->flux[ConnectionId(0)] = -3.0;
  mesh.flow->flux[ConnectionId(1)] = 1.0;
  mesh.connections.k_non_orthogonality[ConnectionId(0)] = 20.0;
  mesh.connections.k_non_orthogonality[ConnectionId(1)] = 60.0;
  const QualityReport report = quality(mesh);
  const Distribution& angles = report.pairs[static_cast<std::size_t>(FacePair::host)].k_non_orthogonality;
  ASSERT_TRUE(angles.flow_mean.has_value());
  EXPECT_DOUBLE_EQ(*angles.flow_mean, (3.0 * 20.0 + 60.0) / 4.0);
  EXPECT_DOUBLE_EQ(angles.flow_share[4], 0.75);   // from 20 degrees
  EXPECT_DOUBLE_EQ(angles.flow_share[12], 0.25);  // from 60 degrees
}

TEST(Assessment, WhatIsNotANumberIsPoor) {
  Mesh mesh = made_box(Vec3(0, 0, 0));
  mesh.connections.k_non_orthogonality[ConnectionId(0)] = std::numeric_limits<double>::quiet_NaN();
  const Assessment result = assess(mesh, {});
  EXPECT_FALSE(result.is_valid());
  EXPECT_EQ(find(result, "knonorth_made_area_mean_deg")->grade, Grade::poor);
  EXPECT_EQ(worst_of(result.figures)->figure, "knonorth_made_area_mean_deg");
}

TEST(Assessment, OfABrokenMeshHasNoFigures) {
  Mesh mesh = meshes::two_boxes();
  mesh.faces.cells[FaceId(0)][0] = CellId(7);
  const Assessment result = assess(mesh, {});
  EXPECT_FALSE(result.is_valid());
  EXPECT_FALSE(result.has_quality);
  EXPECT_TRUE(result.figures.empty());
  EXPECT_FALSE(nlohmann::json::parse(to_json(result, "m.h5", "wellknit"))["valid"].get<bool>());
}

TEST(Assessment, PrintsTheFiguresOfItsJson) {
  const Assessment result = assess(meshes::ring_in_boxes(), {{"min_volume", 1e30}});
  const auto json = nlohmann::json::parse(to_json(result, "m.h5", "wellknit"));
  for (const Figure& figure : figures(result.quality))
    EXPECT_EQ(json["quality"][figure.name].get<double>(), figure.value) << figure.name;
  EXPECT_EQ(json["headline"], headline(result));
  EXPECT_EQ(json["passed_limits"][0]["name"], "min_volume");
}

TEST(Conservation, ComparesTheMeshWithItsSource) {
  Mesh mesh = meshes::box_grid(2);
  const std::size_t n = mesh.cells.size();
  EXPECT_FALSE(conservation(mesh).has_value());
  mesh.source_volumes.bulk.assign(n, 1000.0);  // 10 x 20 x 5 m
  mesh.source_volumes.pores.assign(mesh.cells.pore_volume.begin(), mesh.cells.pore_volume.end());
  const auto kept = conservation(mesh);
  ASSERT_TRUE(kept.has_value());
  EXPECT_NEAR(kept->bulk_error(), 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(kept->source_bulk, 8000.0);
  const double gained = 0.5 * mesh.cells.pore_volume[CellId(0)];
  mesh.cells.pore_volume[CellId(0)] += gained;
  EXPECT_NEAR(conservation(mesh)->pore_error(), gained / (kept->source_pores + gained), 1e-12);
  EXPECT_EQ(find(assess(mesh, {}), "pore_volume_error")->grade, Grade::poor);
}

TEST(WorstCells, AreSortedByTheirMeasure) {
  Mesh mesh = meshes::ring_in_boxes();
  CellQuality quality = cell_quality(mesh);
  quality.max_planarity[CellId(3)] = 0.5;
  quality.max_planarity[CellId(9)] = 0.7;
  const auto any = [](CellKind) { return true; };
  const std::vector<CellId> worst = worst_cells(mesh, quality, FaceMeasure::planarity, 2, any);
  EXPECT_EQ(worst, (std::vector<CellId>{CellId(9), CellId(3)}));
  const auto none = [](CellKind) { return false; };
  EXPECT_TRUE(worst_cells(mesh, quality, FaceMeasure::planarity, 2, none).empty());
}

}  // namespace
}  // namespace wellknit
