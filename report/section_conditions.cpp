// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <fmt/format.h>

#include <array>

#include "report/histogram.h"
#include "report/html.h"
#include "report/sections.h"

namespace wellknit {

namespace {

struct Heading {
  FaceMeasure measure;
  const char* title;
  const char* unit;
  const char* meaning;
};

constexpr std::array headings{
    Heading{FaceMeasure::non_orthogonality, "Non-orthogonality", "°",
            "Degrees between a face's normal and the line of centres. Marked: 70° and more."},
    Heading{FaceMeasure::k_non_orthogonality, "K-orthogonality", "°",
            "Degrees between K·n and the line from a cell's centre to its face, the worse side. Marked: 90° and more."},
    Heading{
        FaceMeasure::planarity, "Planarity", "",
        "Largest distance of a vertex from the face's mean plane over the square root of its area. Marked: about 0.1 "
        "and more."},
    Heading{FaceMeasure::skewness, "Centring", "",
            "How far from a face's centroid the line of centres crosses it, over the face's extent (checkMesh's "
            "skewness). Marked: 4 and more."}};

/// From the host to the well; joints between their two sides.
constexpr std::array order{FacePair::host,       FacePair::transition_host,
                           FacePair::transition, FacePair::transition_radial,
                           FacePair::radial,     FacePair::radial_host};

std::string title_of(FacePair pair) {
  switch (pair) {
    case FacePair::host: return "host";
    case FacePair::transition_host: return "joint host–transition";
    case FacePair::transition: return "transition";
    case FacePair::transition_radial: return "joint transition–radial";
    case FacePair::radial: return "radial";
    default: return "joint radial–host";
  }
}

std::string condition(const QualityReport& quality, const Figures& all, const Heading& heading) {
  bool has_flow = false;
  for (const PairQuality& pair : quality.pairs) has_flow = has_flow || pair.of(heading.measure).flow_mean.has_value();
  std::string rows;
  for (const FacePair pair : order) {
    const PairQuality& values = quality.pairs[static_cast<std::size_t>(pair)];
    if (values.faces == 0) continue;
    const std::string name = fmt::format("{}_{}", name_of(heading.measure), name_of(pair));
    const std::string unit = heading.unit[0] == '\0' ? "" : "_deg";
    const auto figure = [&](const char* which) { return all.span(name + which + unit, heading.unit); };
    std::vector<std::string> cells{fmt::format("<span class=\"key {}\"></span>{}", style_of(pair), title_of(pair)),
                                   all.span(fmt::format("faces_{}", name_of(pair))), figure("_mean"),
                                   figure("_area_mean")};
    if (has_flow) cells.push_back(figure("_flow_mean"));
    cells.insert(cells.end(),
                 {figure("_p99"), figure("_max"), histogram(heading.measure, values.of(heading.measure), pair)});
    rows += row(cells);
  }
  std::vector<std::string> heads{"faces between", "number", "mean", "by area"};
  if (has_flow) heads.emplace_back("by flow");
  heads.insert(heads.end(), {"99 %", "worst", histogram_axis(heading.measure)});
  return fmt::format("<h3>{}</h3>\n<p>{}{}</p>\n", heading.title, heading.meaning,
                     has_flow ? " The line shows the share of the flow." : "") +
         table(heading.title, heads, rows);
}

struct FoamCheck {
  const char* title;
  const char* figure;
  const char* limit;
  const char* beyond;  ///< figure that counts what lies beyond; null: none does
};

constexpr std::array foam_checks{
    FoamCheck{"Openness of cells", "max_openness", "at most 1e-6", "cells_above_openness_1e-6"},
    FoamCheck{"Aspect ratio", "max_aspect_ratio", "at most 1,000", "cells_above_aspect_ratio_1000"},
    FoamCheck{"Smallest volume, m³", "min_volume", "above 0", nullptr},
    FoamCheck{"Smallest face area, m²", "min_face_area", "above 0", nullptr},
    FoamCheck{"Non-orthogonality, degrees", "max_nonorth_deg", "70 is severe", "faces_above_70_deg"},
    FoamCheck{"Reversed faces of made cells", nullptr, "none at 90 degrees", "made_faces_beyond_90_deg"},
    FoamCheck{"Skewness, inner faces", "max_skewness", "at most 4", "faces_above_skewness_4"},
    FoamCheck{"Skewness, boundary", "max_boundary_skewness", "at most 20", nullptr},
    FoamCheck{"Non-orthogonality from centroids, as checkMesh prints it", "checkmesh_nonorth_max_deg", "70 is severe",
              nullptr},
    FoamCheck{"Skewness from centroids, as checkMesh prints it", "checkmesh_skewness_max", "at most 4", nullptr},
    FoamCheck{"Interpolation weight", "min_interpolation_weight", "at least 0.05", "faces_below_weight_5_percent"},
    FoamCheck{"Volume ratio of neighbours", "min_volume_ratio", "at least 0.01", nullptr},
    FoamCheck{"Flatness of faces", "min_flatness", "at least 0.8", nullptr}};

}  // namespace

std::string conditions_section(const ReportInput& input) {
  if (!input.assessment.has_quality) return "";
  const Figures all(input.assessment.quality);
  std::string out = "<section id=\"conditions\">\n<h2>The four finite-volume conditions</h2>\n";
  for (const Heading& heading : headings) out += condition(input.assessment.quality, all, heading);
  return out + "</section>\n";
}

std::string openfoam_section(const ReportInput& input) {
  if (!input.assessment.has_quality) return "";
  const Figures all(input.assessment.quality);
  std::string rows;
  for (const FoamCheck& check : foam_checks)
    rows += row({check.title, check.figure == nullptr ? "" : all.span(check.figure), check.limit,
                 check.beyond == nullptr ? "" : all.span(check.beyond)});
  return "<section id=\"openfoam\">\n<h2>Beside OpenFOAM's checkMesh</h2>\n<p>The same measures between the pressure "
         "points, where the row does not say centroids, which checkMesh takes. All cells count, the host's too.</p>\n" +
         table("checkMesh's measures", {"measure", "worst", "checkMesh's limit", "number beyond"}, rows) +
         "</section>\n";
}

}  // namespace wellknit
