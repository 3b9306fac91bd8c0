// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/write_report.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "report/assets.h"
#include "tests/support/meshes.h"

namespace wellknit {
namespace {

std::string page_of(const Mesh& mesh, const std::string& path = "mesh.h5", std::size_t budget = 1'000'000) {
  const Assessment assessment = assess(mesh, {});
  const Provenance provenance = meshes::provenance();
  return report_html({mesh, provenance, assessment, path, "wellknit 0", std::nullopt, budget});
}

nlohmann::json check_of(const std::string& page) {
  const std::string open = "id=\"check\">";
  const std::size_t begin = page.find(open) + open.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(WriteReport, HasEveryAsset) {
  for (const char* name :
       {"report.css", "arrays.js", "matrices.js", "surface.js", "drawing.js", "viewer.js", "page.js"})
    EXPECT_FALSE(report_asset(name).empty()) << name;
  EXPECT_TRUE(report_asset("other").empty());
}

TEST(WriteReport, FiguresAreThoseOfCheck) {
  const std::string page = page_of(meshes::ring_in_boxes());
  const nlohmann::json figures = check_of(page)["quality"];
  const std::regex shown("data-figure=\"([^\"]+)\" data-value=\"([^\"]+)\"");
  int count = 0;
  for (std::sregex_iterator match(page.begin(), page.end(), shown), end; match != end; ++match, ++count)
    EXPECT_EQ(std::stod((*match)[2]), figures.at((*match)[1]).get<double>()) << (*match)[1];
  EXPECT_GT(count, 80);  // four conditions of five pairs, and the rest
}

TEST(WriteReport, NamesNoOtherFile) {
  const std::string page = page_of(meshes::ring_in_boxes());
  const std::regex link("(src|href)=\"([^\"#][^\"]*)\"");
  for (std::sregex_iterator match(page.begin(), page.end(), link), end; match != end; ++match)
    EXPECT_EQ((*match)[2], "data:,");
  EXPECT_EQ(page.find("http://"), std::string::npos);
  EXPECT_EQ(page.find("https://"), std::string::npos);
}

TEST(WriteReport, NamesCannotBecomeMarkup) {
  Mesh mesh = meshes::box_grid(2);
  mesh.wells[WellId(0)].name = "</script><script>alert(1)</script>";
  const std::string page = page_of(mesh, "<img src=x>.h5");
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_EQ(page.find("<img"), std::string::npos);
}

TEST(WriteReport, IsTheSameEachTime) { EXPECT_EQ(page_of(meshes::ring_in_boxes()), page_of(meshes::ring_in_boxes())); }

TEST(WriteReport, SaysWhichArraysDoNotFit) {
  // 64 cells of 4 bytes: room for two arrays.
  const std::string page = page_of(meshes::ring_in_boxes(), "mesh.h5", 600);
  EXPECT_NE(page.find("Not in this file, for its size: K-orthogonality"), std::string::npos);
  EXPECT_NE(page.find("data-array=\"nonorth\""), std::string::npos);
  EXPECT_EQ(page.find("data-array=\"knonorth\""), std::string::npos);
}

TEST(WriteReport, OfAMeshWithoutFiniteNumbersIsAPageStill) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Mesh mesh = meshes::ring_in_boxes();
  mesh.cells.center[CellId(0)] = Vec3(nan, 0, 0);
  mesh.vertices[VertexId(3)] = Vec3(std::numeric_limits<double>::infinity(), 0, 0);
  mesh.connections.k_non_orthogonality[ConnectionId(0)] = nan;
  mesh.wells[WellId(0)].trajectory.points[0].x() = nan;
  const std::string page = page_of(mesh);
  EXPECT_NE(page.find("Not valid"), std::string::npos);
  // No drawing has such a number, on which browsers complain.
  EXPECT_FALSE(std::regex_search(page, std::regex("(points|x|y|width|height)=\"[^\"]*(nan|inf)")));
}

TEST(WriteReport, OfABrokenMeshShowsItsViolations) {
  Mesh mesh = meshes::two_boxes();
  mesh.faces.cells[FaceId(0)][0] = CellId(7);
  const std::string page = page_of(mesh);
  EXPECT_NE(page.find("Not valid"), std::string::npos);
  EXPECT_NE(page.find("out of range"), std::string::npos);
  EXPECT_EQ(page.find("v-canvas\""), page.find("v-canvas\"", page.find("<script>")));  // in the scripts only
}

}  // namespace
}  // namespace wellknit
