// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>

#include "cli/commands.h"

namespace wellknit {

namespace {

using Json = nlohmann::ordered_json;
using Text = std::back_insert_iterator<std::string>;

/// 12345678 as 12,345,678.
std::string grouped(std::int64_t count) {
  std::string digits = fmt::format("{}", count);
  for (std::size_t end = digits.size(); end > 3 && digits[end - 4] != '-'; end -= 3) digits.insert(end - 3, ",");
  return digits;
}

std::string counted(std::int64_t count, const char* noun) {
  return fmt::format("{} {}{}", grouped(count), noun, count == 1 ? "" : "s");
}

double total_seconds(const std::vector<StepTime>& times) {
  return std::accumulate(times.begin(), times.end(), 0.0,
                         [](double sum, const StepTime& t) { return sum + t.seconds; });
}

/// The cavity that the well lies in; its figures are shared with the other wells of that cavity.
const CavitySummary* cavity_of(const BuildSummary& build, const WellSummary& well) {
  if (well.cavity < 0 || static_cast<std::size_t>(well.cavity) >= build.cavities.size()) return nullptr;
  return &build.cavities[static_cast<std::size_t>(well.cavity)];
}

/// The well in whose row the figures of this well's cavity stand; null when it is this one's.
const WellSummary* first_of_cavity(const BuildSummary& build, const WellSummary& well) {
  const auto same = [&](const WellSummary& other) { return well.cavity >= 0 && other.cavity == well.cavity; };
  const auto first = std::ranges::find_if(build.wells, same);
  return first == build.wells.end() || &*first == &well ? nullptr : &*first;
}

void write_well_row(Text out, const BuildReport& report, const WellSummary& well, std::size_t width) {
  const CavitySummary* cavity = cavity_of(report.build, well);
  const bool own_row = well.meshed && cavity != nullptr && first_of_cavity(report.build, well) == nullptr;
  const auto figure = [&](std::int64_t CavitySummary::*member) { return own_row ? grouped(cavity->*member) : "-"; };
  fmt::format_to(out, "  {:{}}  {:10} {:>7} {:>7} {:>10} {:>6} {:>8} {:>5} {:>6} {:>11}\n", well.name, width, well.mode,
                 figure(&CavitySummary::cells_removed), figure(&CavitySummary::cells_refined),
                 figure(&CavitySummary::transition_cells), well.meshed ? grouped(well.radial_cells) : "-",
                 figure(&CavitySummary::inverted_tetrahedra), figure(&CavitySummary::loops),
                 figure(&CavitySummary::points_inserted), grouped(well.connections));
}

/// What was not meshed and why, what is connected by index, and what the steps had to say.
void write_well_notes(Text out, const WellSummary& well) {
  if (!well.meshed) fmt::format_to(out, "  {}: not meshed: {}\n", well.name, well.reason);
  if (well.index_connections > 0) {
    fmt::format_to(out, "  {}: {} of {} connected by a Peaceman index\n", well.name, well.index_connections,
                   counted(well.connections, "cell"));
  }
  for (const std::string& note : well.notes) fmt::format_to(out, "  {}: {}\n", well.name, note);
}

/// A line for each cavity that several wells share.
void write_shared_cavities(Text out, const BuildSummary& build) {
  for (const WellSummary& well : build.wells) {
    if (cavity_of(build, well) == nullptr || first_of_cavity(build, well) != nullptr) continue;
    std::string others;
    for (const WellSummary& other : build.wells) {
      if (first_of_cavity(build, other) == &well) others += (others.empty() ? "" : ", ") + other.name;
    }
    if (!others.empty())
      fmt::format_to(out, "  {}: its row has the figures of the one cavity it shares with {}\n", well.name, others);
  }
}

void write_wells(Text out, const BuildReport& report) {
  if (report.build.wells.empty()) {
    fmt::format_to(out, "no wells: the host alone\n");
    return;
  }
  std::size_t width = 4;
  for (const WellSummary& well : report.build.wells) width = std::max(width, well.name.size());
  fmt::format_to(out, "{:{}}  {:10} {:>7} {:>7} {:>10} {:>6} {:>8} {:>5} {:>6} {:>11}\n", "wells", width + 2, "mode",
                 "removed", "refined", "transition", "radial", "inverted", "loops", "points", "connections");
  for (const WellSummary& well : report.build.wells) write_well_row(out, report, well, width);
  write_shared_cavities(out, report.build);
  for (const WellSummary& well : report.build.wells) write_well_notes(out, well);
}

void write_cavities(Text out, const BuildReport& report) {
  std::int64_t faces = 0;
  std::int64_t found = 0;
  std::int64_t unseen = 0;
  for (const CavitySummary& cavity : report.build.cavities) {
    faces += cavity.boundary_faces;
    found += cavity.boundary_faces_found;
    unseen += cavity.cells_not_seen_from_centre;
  }
  if (report.build.cavities.empty()) return;
  fmt::format_to(out, "boundary    {} of {} found again as the same vertices; {} not seen whole from the centre\n",
                 grouped(found), counted(faces, "cavity face"), counted(unseen, "cell"));
}

void write_optimisation(Text out, const BuildSummary& build) {
  if (build.edge_collapse) {
    const EdgeCollapse& c = *build.edge_collapse;
    fmt::format_to(out, "short edges {} to {}; {} and {} taken out; the shortest {:.2g} to {:.2g} of its cell's size\n",
                   grouped(c.short_before), grouped(c.short_after), counted(c.edges_removed, "edge"),
                   counted(c.faces_removed, "face"), c.shortest_before, c.shortest_after);
  }
  if (build.adaptation) {
    const FluxAdaptation& a = *build.adaptation;
    if (a.fields == 0)
      fmt::format_to(out, "adapted     nothing: no well flows\n");
    else
      fmt::format_to(
          out,
          "adapted     {} of {} transmissibilities by more than 1 %, {} to the limit; imbalance {:.2g} to {:.2g}\n",
          grouped(a.changed), grouped(a.connections), grouped(a.at_limit), a.imbalance_before, a.imbalance_after);
    if (a.not_solved > 0)
      fmt::format_to(out, "            {} not solved and left out\n", counted(a.not_solved, "flow"));
  }
  if (!build.optimisation) return;
  const MeshOptimisation& o = *build.optimisation;
  fmt::format_to(out,
                 "optimised   non-orthogonality of inner faces {:.1f} to {:.1f} degrees (99 % below {:.1f}, {:.1f}), "
                 "of joints {:.1f} to "
                 "{:.1f} ({:.1f}, {:.1f})\n",
                 o.inner_before.mean, o.inner_after.mean, o.inner_before.p99, o.inner_after.p99, o.joint_before.mean,
                 o.joint_after.mean, o.joint_before.p99, o.joint_after.p99);
}

void write_quality(Text out, const QualityReport& quality) {
  fmt::format_to(out, "quality             faces   non-orthogonality  K-non-orthogonality            planarity\n");
  fmt::format_to(out, "  mean, max                             degrees              degrees\n");
  for (std::size_t i = 0; i < face_pair_count; ++i) {
    const PairQuality& pair = quality.pairs[i];
    if (pair.faces == 0) continue;
    fmt::format_to(out, "  {:17} {:>6} {:>9.2f} {:>9.2f} {:>10.2f} {:>9.2f} {:>10.2g} {:>9.2g}\n",
                   name_of(static_cast<FacePair>(i)), pair.faces, pair.non_orthogonality.mean,
                   pair.non_orthogonality.max, pair.k_non_orthogonality.mean, pair.k_non_orthogonality.max,
                   pair.planarity.mean, pair.planarity.max);
  }
}

void write_mesh(Text out, const BuildReport& report) {
  const QualityReport& quality = report.quality;
  const auto& kinds = quality.cells_of_kind;
  fmt::format_to(out, "mesh        {} ({} host, {} refined, {} transition, {} radial), {}, {} vertices, {}\n",
                 counted(std::accumulate(kinds.begin(), kinds.end(), std::int64_t{0}), "cell"), grouped(kinds[0]),
                 grouped(kinds[1]), grouped(kinds[2]), grouped(kinds[3]), counted(quality.faces, "face"),
                 grouped(quality.vertices), counted(quality.connections, "connection"));
  fmt::format_to(out, "pore volume {:.6g} m3\n", report.pore_volume);
}

void write_times(Text out, const BuildReport& report) {
  fmt::format_to(out, "time        {:.2f} s", total_seconds(report.times));
  const char* separator = ": ";
  for (const StepTime& time : report.times) {
    fmt::format_to(out, "{}{} {:.2f}", separator, time.step, time.seconds);
    separator = ", ";
  }
  fmt::format_to(out, "\n");
}

Json json_of(const TubeSummary& tube) {
  return {{"from", tube.range.from},
          {"to", tube.range.to},
          {"mode", tube.mode},
          {"drainage_radius", tube.drainage_radius},
          {"cavity", tube.cavity}};
}

Json json_of(const WellSummary& well) {
  Json json{{"name", well.name},
            {"meshed", well.meshed},
            {"mode", well.mode},
            {"reason", well.reason},
            {"cavity", well.cavity},
            {"radial_cells", well.radial_cells},
            {"segments", well.segments},
            {"radius_wanted", well.radius_wanted},
            {"drainage_radius", well.drainage_radius},
            {"length_in_rock", well.length_in_rock},
            {"length_meshed", well.length_meshed},
            {"connections", well.connections},
            {"index_connections", well.index_connections}};
  json["tubes"] = Json::array();
  for (const TubeSummary& tube : well.tubes) json["tubes"].push_back(json_of(tube));
  json["notes"] = well.notes;
  return json;
}

Json json_of(const AngleFigures& figures) {
  return {{"mean_deg", figures.mean}, {"p99_deg", figures.p99}, {"max_deg", figures.largest}};
}

Json json_of(const MeshOptimisation& o) {
  return {{"cells", o.cells},
          {"vertices", o.vertices},
          {"iterations", o.iterations},
          {"cells_restored", o.restored},
          {"inner_before", json_of(o.inner_before)},
          {"inner_after", json_of(o.inner_after)},
          {"joints_before", json_of(o.joint_before)},
          {"joints_after", json_of(o.joint_after)}};
}

Json json_of(const EdgeCollapse& c) {
  return {{"short_before", c.short_before},       {"short_after", c.short_after},
          {"edges_removed", c.edges_removed},     {"faces_removed", c.faces_removed},
          {"shortest_before", c.shortest_before}, {"shortest_after", c.shortest_after}};
}

Json json_of(const FluxAdaptation& a) {
  return {{"fields", a.fields},
          {"not_solved", a.not_solved},
          {"connections", a.connections},
          {"changed", a.changed},
          {"at_limit", a.at_limit},
          {"imbalance_before", a.imbalance_before},
          {"imbalance_after", a.imbalance_after}};
}

Json json_of(const AffineMap& space) {
  Json matrix = Json::array();
  for (int row = 0; row < 3; ++row)
    matrix.push_back({space.matrix(row, 0), space.matrix(row, 1), space.matrix(row, 2)});
  return {{"matrix", std::move(matrix)}, {"origin", {space.origin.x(), space.origin.y(), space.origin.z()}}};
}

Json json_of(const CavitySummary& cavity) {
  return {{"cells_removed", cavity.cells_removed},
          {"cells_refined", cavity.cells_refined},
          {"transition_cells", cavity.transition_cells},
          {"transition_faces", cavity.transition_faces},
          {"transition_vertices", cavity.transition_vertices},
          {"cavity_rounds", cavity.cavity_rounds},
          {"boundary_faces", cavity.boundary_faces},
          {"boundary_faces_found", cavity.boundary_faces_found},
          {"inverted_tetrahedra", cavity.inverted_tetrahedra},
          {"loops", cavity.loops},
          {"points_inserted", cavity.points_inserted},
          {"cells_closed_after_mapping", cavity.cells_closed_after_mapping},
          {"vertices_moved", cavity.vertices_moved},
          {"cells_merged", cavity.cells_merged},
          {"cells_not_seen_from_centre", cavity.cells_not_seen_from_centre}};
}

}  // namespace

std::string to_text(const WrittenFile& file) {
  std::string text =
      fmt::format("wrote       {} ({}, {:.1f} MB)\n", file.path, file.format, static_cast<double>(file.bytes) / 1e6);
  for (const std::string& note : file.notes) text += fmt::format("  {}\n", note);
  return text;
}

namespace {

std::string to_text(const ConversionReport& report) {
  std::string text;
  for (const ConversionEntry& entry : report.entries) {
    const std::string where = entry.line > 0 ? fmt::format(" ({}:{})", entry.file, entry.line) : "";
    text += fmt::format("deck        {:<11} {:<8} {:>5}  {}{}\n", entry.action, entry.keyword, entry.count,
                        entry.detail, where);
  }
  for (const std::string& note : report.notes) text += fmt::format("deck        {}\n", note);
  return text;
}

Json json_of(const ConversionReport& report) {
  Json json{{"entries", Json::array()}, {"notes", report.notes}};
  for (const ConversionEntry& entry : report.entries)
    json["entries"].push_back({{"keyword", entry.keyword},
                               {"action", entry.action},
                               {"count", entry.count},
                               {"detail", entry.detail},
                               {"file", entry.file},
                               {"line", entry.line}});
  return json;
}

}  // namespace

std::string to_text(const BuildReport& report) {
  std::string text;
  const Text out(text);
  fmt::format_to(out, "case        {}: {} x {} x {} cells\n", report.case_path, report.dimensions[0],
                 report.dimensions[1], report.dimensions[2]);
  write_wells(out, report);
  write_cavities(out, report);
  write_optimisation(out, report.build);
  write_mesh(out, report);
  write_quality(out, report.quality);
  for (const std::string& line : to_lines(report.build.validity)) fmt::format_to(out, "grid        {}\n", line);
  for (const std::string& note : report.notes) fmt::format_to(out, "note        {}\n", note);
  for (const std::string& note : report.build.notes) fmt::format_to(out, "note        {}\n", note);
  if (report.conversion) text += to_text(*report.conversion);
  write_times(out, report);
  for (const WrittenFile& file : report.files) text += to_text(file);
  return text;
}

std::string to_json(const BuildReport& report) {
  Json json;
  json["program"] = program_and_version();
  json["case"] = report.case_path;
  json["source_dimensions"] = report.dimensions;
  json["wells"] = Json::array();
  for (const WellSummary& well : report.build.wells) json["wells"].push_back(json_of(well));
  json["cavities"] = Json::array();
  for (const CavitySummary& cavity : report.build.cavities) json["cavities"].push_back(json_of(cavity));
  if (report.build.metric_space) json["metric_space"] = json_of(*report.build.metric_space);
  if (report.build.optimisation) json["optimisation"] = json_of(*report.build.optimisation);
  if (report.build.edge_collapse) json["optimisation"]["edges"] = json_of(*report.build.edge_collapse);
  if (report.build.adaptation) json["adaptation"] = json_of(*report.build.adaptation);
  json["pore_volume"] = report.pore_volume;
  json["quality"] = Json::parse(report.quality.to_json());
  json["validity"] = Json::parse(to_json(report.build.validity));
  json["notes"] = report.notes;
  for (const std::string& note : report.build.notes) json["notes"].push_back(note);
  json["times"] = Json::array();
  for (const StepTime& time : report.times) json["times"].push_back({{"step", time.step}, {"seconds", time.seconds}});
  json["seconds"] = total_seconds(report.times);
  if (report.conversion) json["conversion"] = json_of(*report.conversion);
  json["outputs"] = Json::array();
  for (const WrittenFile& file : report.files) {
    json["outputs"].push_back(
        {{"format", file.format}, {"path", file.path}, {"bytes", file.bytes}, {"notes", file.notes}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace wellknit
