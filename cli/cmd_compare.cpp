// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// wellknit compare: two runs of a simulator beside each other (docs/commands/compare.md).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "algorithm/transfer_map.h"
#include "cli/commands.h"
#include "cli/usage_error.h"
#include "model/errors.h"
#include "readers/read_mesh.h"
#include "readers/read_run.h"
#include "writers/output_file.h"
#include "writers/write_chart.h"

namespace wellknit {

namespace {

using Json = nlohmann::ordered_json;

constexpr double same_time = 1e-3;  ///< of the files' unit, days or hours: single precision over thirty years

struct CompareRequest {
  std::string first, second, mesh, plots;
  int rows = 15;
  double limit = -1.0;  ///< below 0: none
  bool json = false;
};

struct VectorDifference {
  std::string name, unit;
  double share = 0.0;  ///< largest difference over the first run's largest value
  double difference = 0.0;
  double time = 0.0;
  double last_first = 0.0, last_second = 0.0;
};

struct PressureDifference {
  std::int32_t step = 0;
  double mean = 0.0, largest = 0.0, scale = 0.0;  ///< in the runs' unit
};

struct Comparison {
  std::size_t times = 0, first_times = 0, second_times = 0;
  double first_end = 0.0, second_end = 0.0;
  std::string time_unit;
  std::vector<VectorDifference> vectors;  ///< the largest share first
  std::vector<PressureDifference> pressures;
  std::vector<std::string> notes;
};

/// Steps that both runs have, as places in each.
std::vector<std::array<std::size_t, 2>> common_times(const SummaryRun& first, const SummaryRun& second) {
  std::vector<std::array<std::size_t, 2>> out;
  std::size_t b = 0;
  for (std::size_t a = 0; a < first.time.size(); ++a) {
    while (b < second.time.size() && second.time[b] < first.time[a] - same_time) ++b;
    if (b < second.time.size() && std::abs(second.time[b] - first.time[a]) <= same_time) out.push_back({a, b});
  }
  return out;
}

bool names_cells(const std::string& name) { return name.front() == 'B' || name.front() == 'C'; }

/// Vectors that say how a run went and not what it found.
bool is_of_the_run(const std::string& name) {
  static constexpr std::array names{"YEARS",    "DAY",    "MONTH",    "YEAR",    "TCPU",
                                    "TIMESTEP", "NEWTON", "NLINEARS", "MSUMLINS"};
  return std::ranges::find(names, name) != names.end();
}

void compare_vectors(const SummaryRun& first, const SummaryRun& second, Comparison& out) {
  const auto times = common_times(first, second);
  out.times = times.size();
  if (times.empty()) throw InvalidInput("the two runs have no time in common");
  const bool same_cells = first.dimensions == second.dimensions;
  std::size_t only_first = 0;
  std::size_t of_cells = 0;
  for (const auto& [name, vector] : first.vectors) {
    if (is_of_the_run(name)) continue;
    if (names_cells(name) && !same_cells) {
      ++of_cells;
      continue;
    }
    const auto found = second.vectors.find(name);
    if (found == second.vectors.end()) {
      ++only_first;
      continue;
    }
    VectorDifference d{name, vector.unit};
    double scale = 0.0;
    for (const auto& [a, b] : times) {
      scale = std::max(scale, std::abs(vector.values[a]));
      const double difference = std::abs(vector.values[a] - found->second.values[b]);
      if (difference <= d.difference) continue;
      d.difference = difference;
      d.time = first.time[a];
    }
    d.share = scale > 0.0 ? d.difference / scale : (d.difference > 0.0 ? 1.0 : 0.0);
    d.last_first = vector.values[times.back()[0]];
    d.last_second = found->second.values[times.back()[1]];
    out.vectors.push_back(d);
  }
  std::ranges::stable_sort(out.vectors, std::ranges::greater{}, &VectorDifference::share);
  if (only_first > 0) out.notes.push_back(fmt::format("{} vectors of the first run are not in the second", only_first));
  if (of_cells > 0)
    out.notes.push_back(fmt::format("{} vectors of cells are not compared: the runs have different grids", of_cells));
}

/// Values of active cells, in full length; not a number elsewhere.
std::vector<double> spread(const std::vector<double>& values, const std::vector<double>& pores,
                           const std::string& what) {
  const auto active = std::ranges::count_if(pores, [](double v) { return v > 0.0; });
  if (static_cast<std::size_t>(active) != values.size())
    throw InvalidInput(
        fmt::format("{} has {} active cells, and --mesh says {}: is this its mesh file?", what, values.size(), active));
  std::vector<double> out(pores.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t c = 0, at = 0; c < pores.size(); ++c)
    if (pores[c] > 0.0) out[c] = values[at++];
  return out;
}

PressureDifference difference_of(std::int32_t step, const std::vector<double>& a, const std::vector<double>& b) {
  PressureDifference out{step};
  std::size_t count = 0;
  for (std::size_t c = 0; c < a.size(); ++c) {
    if (!std::isfinite(a[c]) || !std::isfinite(b[c])) continue;
    const double d = std::abs(a[c] - b[c]);
    out.mean += d;
    out.largest = std::max(out.largest, d);
    out.scale = std::max(out.scale, std::abs(a[c]));
    ++count;
  }
  if (count > 0) out.mean /= static_cast<double>(count);
  return out;
}

void compare_pressures(const CompareRequest& request, const std::string& first, const std::string& second,
                       Comparison& out) {
  const auto a = read_restart_array(first, "PRESSURE");
  const auto b = read_restart_array(second, "PRESSURE");
  if (!a || !b) {
    out.notes.push_back("cell pressures are not compared: a run has no UNRST file");
    return;
  }
  std::optional<Mesh> mesh;
  if (!request.mesh.empty()) mesh = read_mesh(request.mesh).mesh;
  for (const auto& [step, values] : *a) {
    const auto other = b->find(step);
    if (other == b->end()) continue;
    if (mesh) {
      const auto& pores = mesh->cells.pore_volume.raw();
      const auto on_mesh = spread(other->second, {pores.begin(), pores.end()}, "the second run");
      const auto back = mean_back(*mesh, on_mesh, std::numeric_limits<double>::quiet_NaN());
      out.pressures.push_back(difference_of(step, spread(values, mesh->source_volumes.pores, "the first run"), back));
    } else if (values.size() == other->second.size()) {
      out.pressures.push_back(difference_of(step, values, other->second));
    } else {
      out.notes.push_back(
          "cell pressures are not compared: the runs have different grids; give the second one's mesh file with "
          "--mesh");
      return;
    }
  }
}

std::string to_text(const CompareRequest& request, const Comparison& c) {
  std::string text = fmt::format(
      "first       {}: {} steps to {:.6g} {}\nsecond      {}: {} steps to {:.6g} {}\ncommon      {} times\n",
      request.first, c.first_times, c.first_end, c.time_unit, request.second, c.second_times, c.second_end, c.time_unit,
      c.times);
  const auto row = [&](const VectorDifference& d) {
    text += fmt::format("  {:<20} {:>14.6g} {:>14.6g} {:>12.3e} {:>12.6g} {:>10.6g}  {}\n", d.name, d.last_first,
                        d.last_second, d.share, d.difference, d.time, d.unit);
  };
  const std::string head = fmt::format("{:>15} {:>14} {:>12} {:>12} {:>10}\n", "first, last", "second, last", "share",
                                       "difference", "at time");
  text += "field                 " + head;
  std::vector<VectorDifference> field;
  for (const VectorDifference& d : c.vectors)
    if (d.name.front() == 'F' && (d.last_first != 0.0 || d.difference != 0.0)) field.push_back(d);
  std::ranges::sort(field, {}, &VectorDifference::name);
  for (const VectorDifference& d : field) row(d);
  text += "largest               " + head;
  for (int n = 0; n < request.rows && n < static_cast<int>(c.vectors.size()); ++n)
    row(c.vectors[static_cast<std::size_t>(n)]);
  for (const PressureDifference& p : c.pressures)
    text += fmt::format("pressure    report step {:>4}: mean difference {:.4g}, largest {:.4g}, of {:.6g}\n", p.step,
                        p.mean, p.largest, p.scale);
  for (const std::string& note : c.notes) text += "note        " + note + "\n";
  return text;
}

std::string to_json(const CompareRequest& request, const Comparison& c) {
  Json json{{"program", program_and_version()},   {"first", request.first},
            {"second", request.second},           {"common_times", c.times},
            {"end", {c.first_end, c.second_end}}, {"time_unit", c.time_unit}};
  json["vectors"] = Json::array();
  for (const VectorDifference& d : c.vectors)
    json["vectors"].push_back({{"name", d.name},
                               {"unit", d.unit},
                               {"share", d.share},
                               {"difference", d.difference},
                               {"time", d.time},
                               {"last", {d.last_first, d.last_second}}});
  json["pressures"] = Json::array();
  for (const PressureDifference& p : c.pressures)
    json["pressures"].push_back(
        {{"report_step", p.step}, {"mean", p.mean}, {"largest", p.largest}, {"largest_value", p.scale}});
  json["notes"] = c.notes;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_plots(const CompareRequest& request, const SummaryRun& first, const SummaryRun& second) {
  static constexpr std::array wanted{"FOPR", "FWPR", "FGPR", "FWIR", "FGIR", "FOPT", "FWPT",
                                     "FGPT", "FPR",  "WBHP", "WOPR", "WWPR", "WWIR"};
  std::filesystem::create_directories(request.plots);
  for (const auto& [name, vector] : first.vectors) {
    const auto found = second.vectors.find(name);
    if (found == second.vectors.end() || std::ranges::find(wanted, name.substr(0, name.find(':'))) == wanted.end())
      continue;
    std::string file = name;
    for (char& c : file)
      if (c == ':' || c == '/' || c == '\\') c = '_';
    OutputStream out((std::filesystem::path(request.plots) / (file + ".svg")).string(), Overwrite::allow);
    out.stream() << chart_svg({name,
                               first.time_unit,
                               vector.unit,
                               {{"first", first.time, vector.values}, {"second", second.time, found->second.values}}});
    out.commit();
  }
}

int compare(const CompareRequest& request) {
  const std::string first_stem = run_stem(request.first);
  const std::string second_stem = run_stem(request.second);
  const SummaryRun first = read_summary(first_stem);
  const SummaryRun second = read_summary(second_stem);
  Comparison out;
  out.first_times = first.time.size();
  out.second_times = second.time.size();
  out.first_end = first.time.back();
  out.second_end = second.time.back();
  out.time_unit = first.time_unit;
  compare_vectors(first, second, out);
  compare_pressures(request, first_stem, second_stem, out);
  if (!request.plots.empty()) write_plots(request, first, second);
  std::cout << (request.json ? to_json(request, out) : to_text(request, out));
  const bool is_beyond = request.limit >= 0.0 && !out.vectors.empty() && out.vectors.front().share > request.limit;
  return is_beyond ? 1 : 0;
}

}  // namespace

Run add_compare(CLI::App& app) {
  const auto request = std::make_shared<CompareRequest>();
  app.add_option("FIRST", request->first, "A run: its deck, one of its files, or their stem")
      ->required()
      ->type_name("RUN");
  app.add_option("SECOND", request->second, "Another one")->required()->type_name("RUN");
  app.add_option("--mesh", request->mesh,
                 "The second run's mesh file: its pressures are mapped to the first one's grid")
      ->type_name("FILE");
  app.add_option("--plots", request->plots, "A folder for SVG pictures of rates, totals and pressures")
      ->type_name("FOLDER");
  app.add_option("--rows", request->rows, "Largest differences shown")->capture_default_str();
  app.add_option("--limit", request->limit,
                 "Exit 1 where a vector differs by more than this share of its largest value")
      ->type_name("SHARE");
  app.add_flag("--json", request->json, "As JSON, with every vector");
  return [request] { return compare(*request); };
}

}  // namespace wellknit
