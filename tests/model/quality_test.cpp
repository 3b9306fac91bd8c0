// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "model/errors.h"
#include "tests/support/meshes.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

const PairQuality& pair_of(const QualityReport& report, FacePair pair) {
  return report.pairs[static_cast<std::size_t>(pair)];
}

/// Two boxes with the second centre moved by `by`.
Mesh moved_centre(const Vec3& by) {
  Mesh mesh = meshes::two_boxes();
  mesh.cells.center[CellId(1)] += by;
  return mesh;
}

TEST(Quality, OfTwoBoxesIsPerfect) {
  const QualityReport report = quality(meshes::two_boxes());
  EXPECT_EQ(report.cells_of_kind, (std::array<std::int64_t, 4>{2, 0, 0, 0}));
  EXPECT_EQ(report.faces, 11);
  EXPECT_EQ(report.vertices, 12);
  EXPECT_EQ(report.connections, 1);
  EXPECT_EQ(pair_of(report, FacePair::host).faces, 1);
  EXPECT_NEAR(pair_of(report, FacePair::host).non_orthogonality.max, 0.0, 1e-12);
  EXPECT_DOUBLE_EQ(report.min_volume, 1.0);
  EXPECT_DOUBLE_EQ(report.max_volume, 2.0);
  EXPECT_DOUBLE_EQ(report.min_volume_ratio, 0.5);
  EXPECT_DOUBLE_EQ(report.min_edge, 1.0);
  EXPECT_DOUBLE_EQ(report.min_face_area, 1.0);
  EXPECT_DOUBLE_EQ(report.min_flatness, 1.0);
  EXPECT_NEAR(report.max_skewness, 0.0, 1e-12);
  // The face stands 0.5 m from one centre and 1 m from the other: 0.5 / 1.5.
  EXPECT_NEAR(report.min_interpolation_weight, 1.0 / 3.0, 1e-14);
  // 2 x 1 x 1: the components of the faces' areas add up to (2, 4, 4), so 4 / 2; (2 + 4 + 4) / 6 / 2^(2/3) = 1.05 is
  // less.
  EXPECT_NEAR(report.max_aspect_ratio, 2.0, 1e-14);
}

TEST(Quality, MeasuresTheAngleBetweenNormalAndLineOfCentres) {
  // The line goes from (0.5, 0.5) to (2, 2): 1.5 along and 1.5 across the normal, 45 degrees.
  const QualityReport report = quality(moved_centre(Vec3(0, 1.5, 0)));
  EXPECT_NEAR(pair_of(report, FacePair::host).non_orthogonality.max, 45.0, 1e-12);
  EXPECT_NEAR(pair_of(report, FacePair::host).non_orthogonality.area_mean, 45.0, 1e-12);
  EXPECT_EQ(report.faces_above_70_degrees, 0);
}

TEST(Quality, CountsFacesAboveItsLimits) {
  // 1.5 along and 15 across: atan 10 = 84.3 degrees. The line meets the face's plane x = 1 a third along, 5 m from its
  // centroid, the face reaches 0.5 m in that direction, and 0.2 of the line's length is 0.2 * 15.07 = 3.015: skewness 5
  // / 3.015 = 1.658.
  const QualityReport report = quality(moved_centre(Vec3(0, 15, 0)));
  EXPECT_NEAR(pair_of(report, FacePair::host).non_orthogonality.max, std::atan(10.0) * 180.0 / std::acos(-1.0), 1e-10);
  EXPECT_EQ(report.faces_above_70_degrees, 1);
  EXPECT_NEAR(report.max_skewness, 5.0 / (0.2 * std::hypot(1.5, 15.0)), 1e-12);
  EXPECT_EQ(report.host_cells_not_seen_from_centre, 1);
  EXPECT_EQ(report.made_faces_beyond_90_degrees, 0);  // host cells both
}

TEST(Quality, MeasuresSkewnessAgainstTheFacesExtent) {
  // 1.5 along and 0.6 across: the line misses the centroid by 0.2; the face reaches 0.5, more than 0.2 * 1.62 = 0.32:
  // 0.2 / 0.5.
  EXPECT_NEAR(quality(moved_centre(Vec3(0, 0.6, 0))).max_skewness, 0.4, 1e-12);
}

TEST(Quality, CountsSkewFaces) {
  // A centre just behind the face and 20 m aside: the line crosses the plane near the second centre, 19.6 m off, and is
  // 20 m long.
  Mesh mesh = moved_centre(Vec3(-0.99, 20, 0));
  EXPECT_EQ(quality(mesh).faces_above_skewness_4, 1);  // 19.6 / 4.0 = 4.9
  EXPECT_EQ(quality(mesh).faces_below_weight_005, 1);  // 0.01 / 0.51 = 0.02
}

TEST(Quality, CountsReversedFacesOfMadeCells) {
  Mesh mesh = moved_centre(Vec3(-2, 0, 0));  // behind the first centre
  EXPECT_EQ(quality(mesh).made_faces_beyond_90_degrees, 0);
  mesh.cells.kind[CellId(1)] = CellKind::transition;
  const QualityReport report = quality(mesh);
  EXPECT_EQ(report.made_faces_beyond_90_degrees, 1);
  EXPECT_EQ(report.made_cells_not_seen_from_centre, 1);
  EXPECT_NEAR(pair_of(report, FacePair::transition_host).non_orthogonality.max, 180.0, 1e-12);
}

TEST(Quality, SortsFacesByTheKindsOfTheirCells) {
  // Per layer: 8 faces between the two rings and 8 between the sectors of each; 8 from ring to transition, 8 between
  // transition cells, 12 on the square, whose sides are in three, 8 between host cells. Between the layers one in each
  // of the 32 columns.
  const QualityReport report = quality(meshes::ring_in_boxes());
  EXPECT_EQ(report.cells_of_kind, (std::array<std::int64_t, 4>{16, 0, 16, 32}));
  EXPECT_EQ(pair_of(report, FacePair::radial).faces, 2 * (8 + 16) + 16);
  EXPECT_EQ(pair_of(report, FacePair::transition_radial).faces, 2 * 8);
  EXPECT_EQ(pair_of(report, FacePair::transition).faces, 2 * 8 + 8);
  EXPECT_EQ(pair_of(report, FacePair::transition_host).faces, 2 * 12);
  EXPECT_EQ(pair_of(report, FacePair::host).faces, 2 * 8 + 8);
  EXPECT_EQ(pair_of(report, FacePair::radial_host).faces, 0);
}

TEST(Quality, LinearFluxErrorIsThatOfMadeFacesOutsideOfTubes) {
  Mesh mesh = meshes::ring_in_boxes();
  EXPECT_FALSE(quality(mesh).linear_flux.has_value());  // a file without them
  for (std::size_t i = 0; i < mesh.connections.size(); ++i) {
    const auto& [a, b] = mesh.connections.cells[ConnectionId(i)];
    const FacePair pair = face_pair(mesh.cells.kind[a], mesh.cells.kind[b]);
    const double error = pair == FacePair::transition ? 0.4 : pair == FacePair::transition_host ? 0.1 : 9.0;
    mesh.connections.linear_flux_error.push_back({error, 2.0 * error, 0.0});
  }
  const QualityReport report = quality(mesh);
  ASSERT_TRUE(report.linear_flux.has_value());
  EXPECT_EQ(report.linear_flux->faces, 24 + 24);  // the two pairs of the test above
  const double one = pair_of(report, FacePair::transition).area;
  const double other = pair_of(report, FacePair::transition_host).area;
  const double mean = (0.4 * one + 0.1 * other) / (one + other);
  EXPECT_NEAR(report.linear_flux->area_mean[0], mean, 1e-12);
  EXPECT_NEAR(report.linear_flux->area_mean[1], 2.0 * mean, 1e-12);
  EXPECT_EQ(report.linear_flux->max, (std::array{0.4, 0.8, 0.0}));
  const auto all = figures(report);
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const Figure& f) { return f.name == "linear_flux_error_max_y"; }));
}

TEST(Quality, TakesPercentilesBetweenOrderStatistics) {
  Mesh mesh = meshes::box_grid(2);  // 12 faces: 4 of 20 x 5 m, 4 of 10 x 5 m and 4 of 10 x 20 m
  double weighted = 0.0;
  for (int i = 0; i < 12; ++i) {
    mesh.connections.k_non_orthogonality[ConnectionId(i)] = 11 - i;
    weighted += (11 - i) * mesh.connections.area[ConnectionId(i)];
  }
  const QualityReport report = quality(mesh);
  const Distribution& angles = pair_of(report, FacePair::host).k_non_orthogonality;
  EXPECT_DOUBLE_EQ(angles.mean, 5.5);
  EXPECT_NEAR(angles.p99, 0.99 * 11, 1e-12);  // between 10 and 11
  EXPECT_DOUBLE_EQ(angles.max, 11.0);
  EXPECT_NEAR(angles.area_mean, weighted / (4 * 100 + 4 * 50 + 4 * 200), 1e-12);
}

TEST(Quality, MeasuresPlanarity) {
  const QualityReport report = quality(meshes::twisted_box());
  const PairQuality& pair = pair_of(report, FacePair::transition_host);
  ASSERT_EQ(pair.faces, 1);
  EXPECT_NEAR(pair.planarity.max, 0.05, 1e-14);  // 0.5 m off the plane of a face of 100 m2: 0.5 / 10
  EXPECT_NEAR(pair.planarity.mean, 0.05, 1e-14);
  // Seen from the middle, a triangle of the fan has the corners (-5, -5, 0.5) and (5, -5, -0.5): their cross product is
  // (5, 0, 50), its area sqrt(25 + 2500) / 2, and a quarter of the area vector 25 m2.
  EXPECT_NEAR(report.min_flatness, 25.0 / (0.5 * std::sqrt(2525.0)), 1e-12);
}

TEST(Quality, CountsTransmissibilities) {
  Mesh mesh = meshes::box_grid(2);
  mesh.connections.transmissibility[ConnectionId(0)] = 0.0;
  mesh.connections.transmissibility[ConnectionId(1)] = -1.0;
  EXPECT_EQ(quality(mesh).zero_transmissibilities, 1);
  EXPECT_EQ(quality(mesh).negative_transmissibilities, 1);
}

TEST(Quality, OfAnEmptyMeshHasNoFigures) {
  const QualityReport report = quality(Mesh());
  EXPECT_EQ(report.faces, 0);
  EXPECT_EQ(report.min_edge, 0.0);
  EXPECT_FALSE(report.to_text().empty());
}

TEST(Quality, JsonHasEveryFigure) {
  const QualityReport report = quality(meshes::ring_in_boxes());
  const auto json = nlohmann::json::parse(report.to_json());
  EXPECT_EQ(json.size(), figures(report).size());
  for (const Figure& f : figures(report)) EXPECT_EQ(json.at(f.name).get<double>(), f.value) << f.name;
  EXPECT_EQ(json.at("cells"), 64);
}

TEST(Quality, TextNamesThePairsThatExist) {
  const std::string text = quality(meshes::ring_in_boxes()).to_text();
  EXPECT_NE(text.find("cells 64 (host 16, refined 0, transition 16, radial 32)"), std::string::npos) << text;
  EXPECT_NE(text.find("transition_radial"), std::string::npos);
  EXPECT_EQ(text.find("radial_host"), std::string::npos);
}

TEST(CellQuality, TakesTheWorstOfTheConnections) {
  const Mesh mesh = meshes::twisted_box();
  const CellQuality cells = cell_quality(mesh);
  EXPECT_NEAR(cells.max_planarity[CellId(0)], 0.05, 1e-14);
  EXPECT_EQ(cells.min_transmissibility[CellId(1)], mesh.connections.transmissibility[ConnectionId(0)]);
  EXPECT_EQ(cells.max_non_orthogonality[CellId(0)], mesh.connections.non_orthogonality[ConnectionId(0)]);
}

TEST(CellQuality, IsNegativeForACentreOutside) {
  // 1.5 m beyond the face at y = 1 of a box of 2 m3, from its middle: 0.5 - 1.5.
  EXPECT_NEAR(cell_quality(moved_centre(Vec3(0, 1.5, 0))).centring[CellId(1)], -1.0 / std::cbrt(2.0), 1e-14);
}

TEST(CellQuality, LeavesConnectionsWithoutAFaceOutOfTheAngles) {
  Mesh mesh = meshes::box_grid(2);
  mesh.connections.non_orthogonality.raw().back() = 77.0;  // the deck's NNC
  EXPECT_LT(cell_quality(mesh).max_non_orthogonality[CellId(0)], 1e-6);
}

std::vector<Limit> limits_of(const std::string& text) {
  const ScratchFolder folder;
  folder.write("limits.toml", text);
  return read_limits(folder.file("limits.toml"));
}

TEST(Limits, AreReadAndCompared) {
  const std::vector<Limit> limits =
      limits_of("# ours\nmax_skewness = 0.3\nmin_interpolation_weight = 0.3\nfaces = 10\nnonorth_radial_max_deg = 1\n");
  ASSERT_EQ(limits.size(), 4U);
  // The skewness is 0.4; the weight of two boxes 1/3; 11 faces; no radial cells.
  const std::vector<PassedLimit> passed = passed_limits(quality(moved_centre(Vec3(0, 0.6, 0))), limits);
  ASSERT_EQ(passed.size(), 2U);
  EXPECT_EQ(passed[0].limit.name, "faces");
  EXPECT_EQ(passed[0].value, 11.0);
  EXPECT_EQ(passed[1].limit.name, "max_skewness");
  EXPECT_NEAR(passed[1].value, 0.4, 1e-12);
}

TEST(Limits, BelowAMinimumArePassed) {
  const std::vector<PassedLimit> passed =
      passed_limits(quality(meshes::two_boxes()), {{"min_interpolation_weight", 0.4}});
  ASSERT_EQ(passed.size(), 1U);
  EXPECT_NEAR(passed[0].value, 1.0 / 3.0, 1e-14);
}

std::string message_of(const std::string& text) {
  try {
    limits_of(text);
  } catch (const ParseError& error) {
    return std::string(error.what()).substr(error.where().file.size());
  }
  return "";
}

TEST(Limits, OfUnknownNamesAreErrorsWithTheirLine) {
  EXPECT_EQ(message_of("max_skewness = 4\nmax_skewnes = 4\n"),
            ":2: max_skewnes: expected the name of a quality figure, found an unknown name; docs/commands/check.md "
            "lists the names");
}

TEST(Limits, OfWrongFormAreErrorsWithTheirLine) {
  EXPECT_EQ(message_of("max_skewness = \"four\"\n"), ":1: max_skewness: expected a number, found something else");
  EXPECT_EQ(message_of("\nmax_skewness 4\n").substr(0, 4), ":2: ");
  EXPECT_THROW(read_limits("/no/such/limits.toml"), ParseError);
}

TEST(FacePair, NamesEveryPairOfKinds) {
  EXPECT_EQ(face_pair(CellKind::host, CellKind::refined), FacePair::host);
  EXPECT_EQ(face_pair(CellKind::refined, CellKind::transition), FacePair::transition_host);
  EXPECT_EQ(face_pair(CellKind::transition, CellKind::transition), FacePair::transition);
  EXPECT_EQ(face_pair(CellKind::radial, CellKind::transition), FacePair::transition_radial);
  EXPECT_EQ(face_pair(CellKind::radial, CellKind::radial), FacePair::radial);
  EXPECT_EQ(face_pair(CellKind::host, CellKind::radial), FacePair::radial_host);
  EXPECT_EQ(name_of(FacePair::transition_radial), "transition_radial");
}

}  // namespace
}  // namespace wellknit
