// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "model/units.h"
#include "report/html.h"
#include "report/sections.h"
#include "report/well_sketch.h"

namespace wellknit {

namespace {

/// m3 as simulators print it.
std::string connection_factor(double well_index) {
  return shown(well_index / m3_per_transmissibility_unit(UnitSystem::metric));
}

std::string_view title_of(const WellStretch& stretch) {
  if (stretch.own) return "its radial mesh";
  constexpr std::array<std::string_view, 4> titles{"host cells, by index", "refined cells, by index",
                                                   "transition cells, by index",
                                                   "another well's radial cells, by index"};
  return titles[static_cast<std::size_t>(stretch.kind)];
}

std::int64_t radial_cells(const Mesh& mesh, WellId well) {
  std::int64_t count = 0;
  for (const WellId owner : mesh.cells.well) count += owner == well ? 1 : 0;
  return count;
}

std::string facts(const Mesh& mesh, WellId id, const std::vector<WellStretch>& stretches) {
  const MeshWell& well = mesh.wells[id];
  double meshed = 0.0;
  double open = 0.0;
  double index = 0.0;
  for (const WellStretch& stretch : stretches) {
    const double length = stretch.range.to - stretch.range.from;
    open += length;
    if (stretch.own) meshed += length;
    index += stretch.well_index;
  }
  std::string rows;
  rows += row({"type", well.type == WellType::injector ? "injector" : "producer"});
  rows += row({"bore radius, m", shown(well.bore_radius)});
  rows += row({"drainage radius, m", well.drainage_radius > 0.0 ? shown(well.drainage_radius) : "not meshed"});
  rows += row({"radial cells", grouped(radial_cells(mesh, id))});
  rows += row({"open to flow, m", shown(std::round(open * 10.0) / 10.0)});
  rows += row({"of it in a radial mesh, m", shown(std::round(meshed * 10.0) / 10.0)});
  rows += row({"connections", grouped(static_cast<std::int64_t>(well.connections.size()))});
  rows += row({"sum of indices, cP·rm³/(day·bar)", connection_factor(index)});
  if (mesh.flow && id.index() < mesh.flow->well_rate.size()) {
    rows += row({"rate of <code>solve</code>, m³/day", shown(mesh.flow->well_rate[id] * second_per_day)});
    rows += row({"bore pressure of <code>solve</code>, bar", shown(mesh.flow->well_pressure[id] / pascal_per_bar)});
  }
  return table("Facts of " + escaped(well.name), {"", ""}, rows);
}

std::string stretch_table(const std::vector<WellStretch>& stretches) {
  std::string rows;
  for (const WellStretch& stretch : stretches)
    rows += row({fmt::format("{:.1f}", stretch.range.from), fmt::format("{:.1f}", stretch.range.to),
                 std::string(title_of(stretch)), grouped(stretch.cells), connection_factor(stretch.well_index)});
  return table("Along the well", {"from, m", "to, m", "connected to", "cells", "sum of indices"}, rows);
}

/// What was not meshed, and why as far as the run's summary says so.
std::string not_meshed(const std::vector<WellStretch>& stretches, const BuildFacts::Well* built) {
  double by_index = 0.0;
  for (const WellStretch& stretch : stretches)
    if (!stretch.own) by_index += stretch.range.to - stretch.range.from;
  std::string out;
  if (by_index > 0.0)
    out +=
        fmt::format("<p class=\"note\">Not in a radial mesh: {:.1f} m, connected by a Peaceman index.</p>\n", by_index);
  if (built == nullptr) return out;
  if (!built->reason.empty()) out += "<p class=\"note\">Not meshed: " + escaped(built->reason) + "</p>\n";
  if (built->drainage_radius > 0.0 && built->drainage_radius < built->radius_wanted)
    out += fmt::format("<p class=\"note\">Asked for a radius of {} m; {} m fits.</p>\n", shown(built->radius_wanted),
                       shown(built->drainage_radius));
  for (const std::string& note : built->notes) out += "<p class=\"note\">" + escaped(note) + "</p>\n";
  return out;
}

std::string well(const ReportInput& input, WellId id) {
  const MeshWell& well = input.mesh.wells[id];
  const std::vector<WellStretch> stretches = stretches_of(input.mesh, id);
  const BuildFacts::Well* built = input.build ? input.build->well(well.name) : nullptr;
  return fmt::format("<article class=\"well\">\n<h3>{}</h3>\n", escaped(well.name)) + not_meshed(stretches, built) +
         "<div class=\"beside\">" + well_sketch(well, stretches) + facts(input.mesh, id, stretches) + "</div>" +
         stretch_table(stretches) + "</article>\n";
}

}  // namespace

std::string wells_section(const ReportInput& input) {
  if (!input.assessment.has_quality) return "";
  std::string out = "<section id=\"wells\">\n<h2>Wells</h2>\n";
  if (input.mesh.wells.empty()) out += "<p>No wells: the host alone.</p>\n";
  for (std::size_t i = 0; i < input.mesh.wells.size(); ++i) out += well(input, WellId(i));
  return out + "</section>\n";
}

}  // namespace wellknit
