// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <fmt/format.h>

#include <algorithm>

#include "report/html.h"
#include "report/sections.h"

namespace wellknit {

namespace {

/// Figures as small as a volume's error are told by their power of ten.
std::string figure_text(const KeyFigure& figure) { return shown(figure.value) + figure.unit; }

std::string tile(const KeyFigure& figure) {
  return fmt::format(
      "<li class=\"tile {}\"><span class=\"grade\">{}</span><h3>{}</h3>"
      "<p class=\"number\" data-figure=\"{}\" data-value=\"{}\">{}</p><p class=\"meaning\">{} Good up to {}{}, poor "
      "above {}{}.</p></li>\n",
      name_of(figure.grade), name_of(figure.grade), escaped(figure.title), figure.figure, figure.value,
      figure_text(figure), figure.meaning, shown(figure.watch), figure.unit, shown(figure.poor), figure.unit);
}

std::string violations(const Assessment& assessment) {
  if (assessment.is_valid()) return "";
  std::string rows;
  const std::size_t count = std::min(assessment.violations.size(), violations_shown);
  for (std::size_t i = 0; i < count; ++i) {
    const Violation& violation = assessment.violations[i];
    rows += row({escaped(violation.entity), escaped(violation.check), escaped(violation.detail)});
  }
  std::string out = table("Violations", {"where", "what", "figures"}, rows);
  if (assessment.violations.size() > count)
    out +=
        fmt::format("<p>and {} more</p>\n", grouped(static_cast<std::int64_t>(assessment.violations.size() - count)));
  return out;
}

std::string limits(const Assessment& assessment) {
  if (assessment.limits.empty()) return "";
  const Figures all(assessment.quality);
  std::string rows;
  for (const Limit& limit : assessment.limits) {
    const bool passed =
        std::ranges::any_of(assessment.passed, [&](const PassedLimit& p) { return p.limit.name == limit.name; });
    rows += row({"<code>" + escaped(limit.name) + "</code>", all.span(limit.name), shown(limit.value),
                 passed ? "<strong class=\"poor\">passed</strong>" : "held"});
  }
  return table("Limits of the limits file", {"figure", "value", "limit", ""}, rows);
}

std::string advice(const Assessment& assessment) {
  if (!assessment.is_valid())
    return "<p class=\"advice\"><strong>What to do.</strong> Look at the violations below; a mesh that is not valid "
           "must "
           "not be computed with. Where only cells that are not seen from their centre are named, the grid is strongly "
           "deformed there: a smaller <code>--radius</code> or another <code>--refine</code> helps, or say in a limits "
           "file how many you tolerate.</p>\n";
  const KeyFigure* worst = worst_of(assessment.figures);
  if (worst == nullptr)
    return "<p class=\"advice\"><strong>Nothing to do.</strong> The worst cells are listed below.</p>\n";
  return fmt::format(
      "<p class=\"advice\"><strong>What to do about the worst, {}:</strong> {} "
      "<a href=\"#worst\">The worst cells</a></p>\n",
      escaped(worst->title), with_options(worst->advice));
}

}  // namespace

std::string verdict_section(const ReportInput& input) {
  const Assessment& assessment = input.assessment;
  const bool look = worst_of(assessment.figures) != nullptr || !assessment.passed.empty();
  std::string out = fmt::format("<section id=\"verdict\" class=\"{}\" data-valid=\"{}\">\n<h2>{}</h2>\n",
                                assessment.is_valid() ? (look ? "watch" : "good") : "poor", assessment.is_valid(),
                                escaped(headline(assessment)));
  out += advice(assessment);
  out += "<ul class=\"tiles\">\n";
  for (const KeyFigure& figure : assessment.figures) out += tile(figure);
  out += "</ul>\n";
  if (assessment.has_quality) {
    const Figures all(assessment.quality);
    out += "<p class=\"counts\">" + all.span("cells") + " cells: " + all.span("cells_host") + " host, " +
           all.span("cells_refined") + " refined, " + all.span("cells_transition") + " transition, " +
           all.span("cells_radial") + " radial; " + all.span("faces") + " faces, " + all.span("vertices") +
           " vertices, " + all.span("connections") + " connections.</p>\n";
  }
  return out + violations(assessment) + limits(assessment) + "</section>\n";
}

}  // namespace wellknit
