// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "report/html.h"
#include "report/sections.h"

namespace wellknit {

namespace {

std::string volume(double value) { return fmt::format("{:.9g}", value); }

std::string steps(const BuildFacts& build) {
  double longest = 0.0;
  double total = 0.0;
  for (const auto& step : build.steps) {
    longest = std::max(longest, step.seconds);
    total += step.seconds;
  }
  std::string rows;
  for (const auto& step : build.steps) {
    const double share = longest > 0.0 ? step.seconds / longest : 0.0;
    rows += row({escaped(step.name), fmt::format("{:.2f}", step.seconds),
                 fmt::format("<svg class=\"bar\" viewBox=\"0 0 200 10\" aria-hidden=\"true\"><rect width=\"{:.1f}\" "
                             "height=\"10\"/></svg>",
                             200.0 * share)});
  }
  rows += row({"all", fmt::format("{:.2f}", total), ""});
  return "<h3>Steps</h3>\n" + table("Steps of the run", {"step", "seconds", ""}, rows);
}

std::string notes(const BuildFacts& build) {
  if (build.notes.empty()) return "";
  std::string out = "<h3>Notes</h3>\n<ul>\n";
  for (const std::string& note : build.notes) out += "<li>" + escaped(note) + "</li>\n";
  return out + "</ul>\n";
}

}  // namespace

std::string conservation_section(const ReportInput& input) {
  std::string out = "<section id=\"conservation\">\n<h2>Conservation</h2>\n";
  if (!input.assessment.has_quality || !input.assessment.quality.conservation)
    return out + "<p>The mesh file does not hold its source's volumes.</p>\n</section>\n";
  const Conservation& volumes = *input.assessment.quality.conservation;
  const Figures all(input.assessment.quality);
  constexpr std::array<std::string_view, 4> kinds{"host", "refined", "transition", "radial"};
  std::string rows = row({"source, active cells", volume(volumes.source_bulk), volume(volumes.source_pores)});
  for (std::size_t kind = 0; kind < kinds.size(); ++kind)
    rows += row({fmt::format("mesh, {} cells", kinds[kind]), volume(volumes.bulk_of_kind[kind]),
                 volume(volumes.pores_of_kind[kind])});
  rows += row({"mesh", volume(volumes.mesh_bulk()), volume(volumes.mesh_pores())});
  rows += row({"relative difference", all.span("bulk_volume_error"), all.span("pore_volume_error")});
  return out + table("Volumes of source and mesh", {"", "bulk, m³", "pores, m³"}, rows) +
         fmt::format(
             "<p>Each source cell's volume went somewhere: fractions add up to 1 within {}. Bulk volume may differ "
             "where twisted faces are cut; pore volume is carried over.</p>\n</section>\n",
             shown(volumes.largest_fraction_error));
}

std::string run_section(const ReportInput& input) {
  std::string out = "<section id=\"run\">\n<h2>The run</h2>\n";
  if (input.build)
    out += steps(*input.build) + notes(*input.build);
  else
    out +=
        "<p>The mesh file holds no times. <code>wellknit build … --json &gt; summary.json</code> and <code>wellknit "
        "report … --summary summary.json</code> show them here, or <code>wellknit build … --report "
        "FILE</code>.</p>\n";
  const Provenance& from = input.provenance;
  out += fmt::format(
      "<h3>Command</h3>\n<pre tabindex=\"0\">{}</pre>\n<h3>Effective configuration</h3>\n<pre "
      "tabindex=\"0\">{}</pre>\n",
      escaped(from.command), escaped(from.config));
  std::string rows;
  for (const SourceFile& source : from.sources)
    rows += row({escaped(source.path), "<code>" + escaped(source.sha256) + "</code>"});
  out += "<h3>Sources</h3>\n" + table("Input files", {"file", "SHA-256"}, rows);
  return out + fmt::format("<p>Mesh made by {}, report by {}.</p>\n</section>\n", escaped(from.created_by),
                           escaped(input.program));
}

}  // namespace wellknit
