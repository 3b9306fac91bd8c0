// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/flow_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "model/units.h"

namespace wellknit {

namespace {

using Json = nlohmann::ordered_json;

constexpr double per_day = second_per_day;
constexpr double index_unit = second_per_day * pascal_per_bar;  ///< m3/(s Pa) in m3/(d bar)
constexpr std::size_t isolated_shown = 3;

double bar(double pascal) { return pascal / pascal_per_bar; }

std::string_view name_of(PressureMethod method) { return method == PressureMethod::direct ? "direct" : "multigrid"; }

std::string_view name_of(WellControl::Kind kind) {
  switch (kind) {
    case WellControl::Kind::pressure: return "pressure";
    case WellControl::Kind::rate: return "rate";
    case WellControl::Kind::shut: break;
  }
  return "shut";
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  [[nodiscard]] bool is_empty() const { return !(low <= high); }
};

Range pressure_range(const SteadyFlow& flow) {
  Range out;
  for (const double p : flow.solution.pressure) {
    if (!std::isfinite(p)) continue;
    out.low = std::min(out.low, p);
    out.high = std::max(out.high, p);
  }
  return out;
}

/// JSON has no NaN.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

std::string text_or_dash(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

std::string wells_text(const FlowReport& report) {
  if (report.flow.wells.empty()) return "";
  std::string text = fmt::format("{:<14} {:<9} {:>12} {:>12} {:>12} {:>14} {:>12} {:>12}\n", "wells", "control",
                                 "bore bar", "mean bar", "rate m3/d", "index m3/d/bar", "crossflow", "connections");
  for (std::size_t w = 0; w < report.flow.wells.size(); ++w) {
    const WellFlow& flow = report.flow.wells[WellId(w)];
    text += fmt::format("  {:<12} {:<9} {:>12} {:>12} {:>12.6g} {:>14} {:>12.4g} {:>12}\n",
                        report.mesh->wells[WellId(w)].name, name_of(report.problem.problem.wells[WellId(w)].kind),
                        text_or_dash(bar(flow.pressure), "{:.6g}"), text_or_dash(bar(flow.mean_pressure), "{:.6g}"),
                        flow.rate * per_day, text_or_dash(flow.productivity_index * index_unit, "{:.6g}"),
                        flow.crossflow * per_day, flow.connection_rate.size());
  }
  return text;
}

double sum(const std::vector<double>& values) {
  double out = 0.0;
  for (const double value : values) out += value;
  return out;
}

Json wells_json(const FlowReport& report) {
  Json out = Json::array();
  for (std::size_t w = 0; w < report.flow.wells.size(); ++w) {
    const WellFlow& flow = report.flow.wells[WellId(w)];
    const MeshWell& well = report.mesh->wells[WellId(w)];
    Json connections = Json::array();
    for (std::size_t n = 0; n < well.connections.size(); ++n) {
      const auto& [cell, index, range] = well.connections[n];
      connections.push_back({{"cell", cell.value()},
                             {"from", number(range.from)},
                             {"to", number(range.to)},
                             {"well_index", number(index)},
                             {"cell_pressure_bar", number(bar(report.flow.solution.pressure[cell]))},
                             {"rate_m3_per_day", number(flow.connection_rate[n] * per_day)}});
    }
    out.push_back({{"name", well.name},
                   {"control", name_of(report.problem.problem.wells[WellId(w)].kind)},
                   {"pressure_bar", number(bar(flow.pressure))},
                   {"reference_depth", flow.reference_depth},
                   {"mean_pressure_bar", number(bar(flow.mean_pressure))},
                   {"rate_m3_per_day", number(flow.rate * per_day)},
                   {"productivity_index_m3_per_day_bar", number(flow.productivity_index * index_unit)},
                   {"crossflow_m3_per_day", number(flow.crossflow * per_day)},
                   {"connections", connections}});
  }
  return out;
}

void note_count(std::int64_t count, const char* one_or_many, std::vector<std::string>& notes) {
  if (count > 0) notes.push_back(fmt::format("{} {}", count, one_or_many));
}

}  // namespace

std::vector<std::string> flow_notes(const FlowReport& report) {
  std::vector<std::string> notes = report.problem.notes;
  const SteadyFlow& flow = report.flow;
  note_count(flow.closed_connections, "connections have no transmissibility", notes);
  note_count(flow.refused_connections, "connections of negative or undefined transmissibility were taken as closed",
             notes);
  note_count(flow.closed_faces, "boundary faces of the held sides conduct nothing", notes);
  std::int64_t cells = 0;
  std::string parts;
  for (std::size_t n = 0; n < flow.isolated.size(); ++n) {
    cells += flow.isolated[n].cells;
    if (n < isolated_shown)
      parts += fmt::format("{}{} from cell {}", n == 0 ? "" : ", ", flow.isolated[n].cells,
                           flow.isolated[n].first_cell.value());
  }
  if (!flow.isolated.empty())
    notes.push_back(fmt::format("{} cells in {} parts without a held pressure have none (NaN) and no flow: {}{}", cells,
                                flow.isolated.size(), parts, flow.isolated.size() > isolated_shown ? ", …" : ""));
  return notes;
}

std::string to_text(const FlowReport& report) {
  const SteadyFlow& flow = report.flow;
  std::string text = fmt::format("mesh        {}: {} cells, {} connections, {} wells\n", report.mesh_path,
                                 report.mesh->cells.size(), report.mesh->connections.size(), report.mesh->wells.size());
  text += wells_text(report);
  if (!flow.face_rate.empty())
    text += fmt::format("boundary    {} faces held, {:.6g} m3/d flow out\n", flow.face_rate.size(),
                        sum(flow.face_rate) * per_day);
  if (!flow.cell_rate.empty())
    text += fmt::format("held cells  {}, {:.6g} m3/d flow out\n", flow.cell_rate.size(), sum(flow.cell_rate) * per_day);
  if (const Range range = pressure_range(flow); !range.is_empty())
    text += fmt::format("pressure    {:.6g} to {:.6g} bar\n", bar(range.low), bar(range.high));
  text +=
      fmt::format("balance     in {:.6g}, out {:.6g} m3/d, error {:.1e}, worst cell {:.1e}\n",
                  flow.balance.in * per_day, flow.balance.out * per_day, flow.balance.error, flow.balance.largest_cell);
  if (report.problem.problem.consistent) text += "fluxes      consistent (multi-point)\n";
  text += fmt::format("solver      {}, {} unknowns, {} iterations, residual {:.1e}, {:.2f} s\n", name_of(flow.method),
                      flow.unknowns, flow.iterations, flow.residual, report.seconds);
  for (const std::string& note : flow_notes(report)) text += "note        " + note + "\n";
  for (const WrittenFile& file : report.files) text += to_text(file);
  return text;
}

std::string to_json(const FlowReport& report) {
  const SteadyFlow& flow = report.flow;
  const Range range = pressure_range(flow);
  Json json{{"program", program_and_version()},
            {"file", report.mesh_path},
            {"cells", report.mesh->cells.size()},
            {"viscosity_cp", report.problem.problem.viscosity / pascal_second_per_centipoise},
            {"density", report.problem.problem.density}};
  if (report.problem.problem.density != 0.0) json["datum"] = report.problem.datum;
  json["wells"] = wells_json(report);
  json["boundary"] = {{"faces", flow.face_rate.size()}, {"rate_out_m3_per_day", number(sum(flow.face_rate) * per_day)}};
  json["held_cells"] = {{"cells", flow.cell_rate.size()},
                        {"rate_out_m3_per_day", number(sum(flow.cell_rate) * per_day)}};
  json["pressure_bar"] = {{"min", number(bar(range.low))}, {"max", number(bar(range.high))}};
  json["balance"] = {{"in_m3_per_day", flow.balance.in * per_day},
                     {"out_m3_per_day", flow.balance.out * per_day},
                     {"error", flow.balance.error},
                     {"worst_cell", flow.balance.largest_cell}};
  json["fluxes"] = report.problem.problem.consistent ? "consistent" : "two-point";
  json["solver"] = {{"method", name_of(flow.method)},
                    {"unknowns", flow.unknowns},
                    {"iterations", flow.iterations},
                    {"residual", flow.residual},
                    {"seconds", report.seconds}};
  json["isolated"] = Json::array();
  for (const IsolatedPart& part : flow.isolated)
    json["isolated"].push_back({{"first_cell", part.first_cell.value()}, {"cells", part.cells}});
  json["notes"] = flow_notes(report);
  json["outputs"] = Json::array();
  for (const WrittenFile& file : report.files)
    json["outputs"].push_back({{"format", file.format}, {"path", file.path}, {"bytes", file.bytes}});
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace wellknit
