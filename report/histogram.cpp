// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/histogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "model/worst_cells.h"

namespace wellknit {

namespace {

constexpr double width = 260.0;  // of the drawing, in its own units
constexpr double height = 44.0;

double bar_width(FaceMeasure measure) { return width / static_cast<double>(classes_of(measure).size()); }

/// Where the classes beyond the reference begin; the drawing's right side when none is.
double reference_place(FaceMeasure measure) {
  const auto classes = classes_of(measure);
  const auto beyond = std::ranges::lower_bound(classes, reference_of(measure));
  return bar_width(measure) * static_cast<double>(beyond - classes.begin());
}

std::string flow_line(const Distribution& values, double bar, double highest) {
  std::string points;
  for (std::size_t i = 0; i < values.flow_share.size(); ++i) {
    const double top = height - height * values.flow_share[i] / highest;
    const double left = bar * static_cast<double>(i);
    points += fmt::format("{:.1f},{:.1f} {:.1f},{:.1f} ", left, top, left + bar, top);
  }
  return points.empty() ? "" : fmt::format("<polyline class=\"flow\" points=\"{}\"/>", points);
}

std::string label(FaceMeasure measure, double lower) {
  if (measure != FaceMeasure::planarity || lower == 0.0 || lower >= 0.01) return fmt::format("{:g}", lower);
  return fmt::format("{:.0e}", lower);
}

}  // namespace

std::string_view style_of(FacePair pair) {
  static constexpr std::array<std::string_view, face_pair_count> styles{"transition", "joint", "joint",
                                                                        "radial",     "host",  "joint"};
  return styles[static_cast<std::size_t>(pair)];
}

std::string histogram(FaceMeasure measure, const Distribution& values, FacePair pair) {
  if (values.area_share.empty()) return "";
  const double bar = bar_width(measure);
  double highest = *std::ranges::max_element(values.area_share);
  for (const double share : values.flow_share) highest = std::max(highest, share);
  std::string bars;
  for (std::size_t i = 0; i < values.area_share.size(); ++i) {
    const double share = values.area_share[i];
    if (!(share > 0.0)) continue;
    const double tall = std::max(0.8, height * share / highest);  // a class that is not empty can be seen
    bars += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>from {:g}: {:.3g} % "
        "of the area</title></rect>",
        bar * static_cast<double>(i) + 0.5, height - tall, bar - 1.0, tall, classes_of(measure)[i], 100.0 * share);
  }
  const double limit = reference_place(measure);
  return fmt::format(
      "<svg class=\"histogram {}\" preserveAspectRatio=\"none\" viewBox=\"0 0 {} {}\" role=\"img\" "
      "aria-label=\"distribution of {}\">"
      "<rect class=\"beyond\" x=\"{:.1f}\" y=\"0\" width=\"{:.1f}\" height=\"{}\"/>{}{}</svg>",
      style_of(pair), width, height, name_of(pair), limit, width - limit, height, bars,
      flow_line(values, bar, highest));
}

std::string histogram_axis(FaceMeasure measure) {
  const auto classes = classes_of(measure);
  const double bar = bar_width(measure);
  const std::size_t step = std::max<std::size_t>(1, classes.size() / 6);
  std::string ticks;
  for (std::size_t i = 0; i < classes.size(); i += step) {
    const double x = bar * static_cast<double>(i);
    ticks += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"0\" y2=\"4\"/><text x=\"{0:.1f}\" y=\"15\"{2}>{1}"
        "</text>",
        x, label(measure, classes[i]), i == 0 ? " class=\"first\"" : "");
  }
  return fmt::format("<svg class=\"axis\" viewBox=\"0 0 {} 18\" aria-hidden=\"true\">{}</svg>", width, ticks);
}

}  // namespace wellknit
