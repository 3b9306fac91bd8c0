// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// wellknit build: host grid and wells to a mesh file (docs/commands/build.md).

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numeric>
#include <optional>
#include <set>

#include "algorithm/build_mesh.h"
#include "cli/build_request.h"
#include "cli/commands.h"
#include "cli/output_set.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/run_file.h"
#include "cli/usage_error.h"
#include "conversion/convert_deck.h"
#include "model/assessment.h"
#include "model/errors.h"
#include "readers/file_content.h"
#include "readers/fit_to_grid.h"
#include "readers/read_case.h"
#include "readers/read_trajectory.h"
#include "readers/whole_deck.h"
#include "report/write_report.h"

namespace wellknit {

namespace {

/// Options that change neither the mesh nor its wells: they stay out of the mesh file, so that it is the same for all
/// of them.
constexpr std::array outside_the_mesh{"output",    "write", "report", "progress", "threads",
                                      "overwrite", "quiet", "json",   "strict"};

class Stopwatch {
 public:
  /// Seconds since the last call.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> passed = now - start_;
    start_ = now;
    return passed.count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

struct GivenRequest {
  BuildRequest request;
  std::string command = "wellknit build";  ///< the command line, as far as it shapes the mesh
};

/// Sets one option and puts its name before a complaint.
void set_from_command_line(GivenRequest& given, const BuildOption& option, const std::string& value) {
  try {
    option.set(given.request, value);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("--{}: {}", option.name, error.what()));
  }
  if (std::ranges::find(outside_the_mesh, std::string_view(option.name)) != outside_the_mesh.end()) return;
  given.command += fmt::format(" --{} {}", option.name, value);
}

void add_option(CLI::App& app, const BuildOption& option, const std::shared_ptr<GivenRequest>& given) {
  const std::string name = option.name == std::string_view("output") ? "-o,--output" : fmt::format("--{}", option.name);
  const auto set = [given, &option](const std::string& value) { set_from_command_line(*given, option, value); };
  if (option.kind == BuildOption::Kind::flag) {
    app.add_flag_callback(
        name, [set] { set("true"); }, option.description);
  } else if (option.kind == BuildOption::Kind::value) {
    app.add_option_function<std::string>(name, set, option.description)->type_name(option.placeholder);
  } else {
    const auto set_all = [set](const std::vector<std::string>& values) { std::ranges::for_each(values, set); };
    app.add_option_function<std::vector<std::string>>(name, set_all, option.description)
        ->type_name(option.placeholder)
        ->allow_extra_args(false);
  }
}

bool is_run_file(const std::string& path) { return std::filesystem::path(path).extension() == ".toml"; }

BuildRequest complete(const BuildRequest& given) {
  BuildRequest request = given;
  if (given.case_path && is_run_file(*given.case_path)) {
    request.case_path.reset();
    request = overlay(request, read_run_file(*given.case_path));
  }
  validate(request);
  return request;
}

std::vector<OutputRequest> outputs_of(const BuildRequest& request) {
  std::vector<OutputRequest> outputs;
  if (request.output) outputs.push_back({"hdf5", *request.output});
  outputs.insert(outputs.end(), request.writes.begin(), request.writes.end());
  return outputs;
}

/// CASE where it is a whole deck that is to be written on the mesh. Refuses what cannot be converted.
std::optional<WholeDeck> deck_to_convert(const BuildRequest& request) {
  const auto is_deck = [](const OutputRequest& output) {
    const WriterFormat* format = find_writer(output.format);
    return format != nullptr && format->name == "deck";
  };
  if (std::ranges::none_of(request.writes, is_deck)) return std::nullopt;
  DiskFiles files;
  auto deck = read_whole_deck(files, *request.case_path);
  if (deck) refuse_what_cannot_be_converted(*deck);
  return deck;
}

std::vector<std::string> inputs_of(const BuildRequest& request, const std::optional<WholeDeck>& deck) {
  std::vector<std::string> inputs{*request.case_path};
  if (deck)
    for (const DeckTextFile& file : deck->files) inputs.push_back(file.content.path);
  inputs.insert(inputs.end(), request.grid_includes.begin(), request.grid_includes.end());
  for (const WellRequest& well : request.wells) inputs.push_back(well.file);
  return inputs;
}

/// What the user said about the well on top of what its file says.
void apply(const WellRequest& request, const BuildRequest& all, Well& well) {
  well.radial = resolve(request.radial, all.radial, well.radial);
  if (request.skin) well.skin = *request.skin;
  if (!request.from && !request.to) return;
  const std::vector<double>& md = well.trajectory.measured_depth;
  const MeasuredDepthRange open{request.from.value_or(md.front()), request.to.value_or(md.back())};
  if (open.from >= open.to || open.to <= md.front() || open.from >= md.back()) {
    throw InvalidInput(fmt::format(
        "{}: no part of the path is open to flow: from={} m to={} m, but its measured depth goes from {} to {} m",
        request.file, open.from, open.to, md.front(), md.back()));
  }
  well.open = {open};
}

/// True for the well of this name and its branches.
bool is_called(const Well& well, const std::string& name) { return well.name == name || well.parent == name; }

/// The wells of one trajectory file; `name` picks one of several with its branches, or names the only one.
std::vector<Well> wells_of_file(const WellRequest& request, const BuildRequest& all, TrajectoryFile file) {
  if (request.name && file.wells.size() == 1) file.wells[0].name = *request.name;
  if (request.name) std::erase_if(file.wells, [&](const Well& well) { return !is_called(well, *request.name); });
  if (file.wells.empty()) {
    throw InvalidInput(fmt::format("{}: no well of the name {} in it", request.file, request.name.value_or("")));
  }
  for (Well& well : file.wells) apply(request, all, well);
  return file.wells;
}

std::vector<Well> chosen_deck_wells(const BuildRequest& request, const Case& source) {
  std::vector<Well> chosen;
  if (request.deck_wells.empty()) return chosen;
  if (source.deck_wells.empty()) {
    throw InvalidInput(fmt::format("{}: --deck-wells: it has no wells (WELSPECS and COMPDAT)", *request.case_path));
  }
  const bool all = request.deck_wells == std::vector<std::string>{"all"};
  for (const std::string& name : request.deck_wells) {
    const auto same = [&](const Well& well) { return is_called(well, name); };
    if (!all && std::ranges::none_of(source.deck_wells, same)) {
      const std::string names =
          std::accumulate(source.deck_wells.begin(), source.deck_wells.end(), std::string(),
                          [](const std::string& text, const Well& w) { return text + " " + w.name; });
      throw InvalidInput(fmt::format("{}: --deck-wells: no well {}; its wells are{}", *request.case_path, name, names));
    }
  }
  for (Well well : source.deck_wells) {
    const auto asks_for = [&](const std::string& name) { return is_called(well, name); };
    if (!all && std::ranges::none_of(request.deck_wells, asks_for)) continue;
    well.radial = resolve(RadialChoice{}, request.radial, well.radial);
    if (well.radial.bore_radius >= well.radial.drainage_radius) {
      throw InvalidInput(fmt::format(
          "well {}: its bore radius {} m is not below the drainage radius {} m; raise --radius or give --bore",
          well.name, well.radial.bore_radius, well.radial.drainage_radius));
    }
    chosen.push_back(std::move(well));
  }
  return chosen;
}

/// A tube that is wider than the whole grid is a slip in the options (feet, millimetres), not a well that happens not
/// to fit.
void require_room(const CornerPointGrid& grid, const std::vector<Well>& wells) {
  Eigen::AlignedBox2d plan;
  for (std::size_t i = 0; i + 2 < grid.coord.size(); i += 3)
    plan.extend(Eigen::Vector2d(grid.coord[i], grid.coord[i + 1]));
  for (const Well& well : wells) {
    if (2.0 * well.radial.drainage_radius < plan.sizes().minCoeff()) continue;
    throw InvalidInput(fmt::format(
        "well {}: a tube of radius {} m is larger than the grid, which is {:.6g} m by {:.6g} m; give a smaller radius",
        well.name, well.radial.drainage_radius, plan.sizes().x(), plan.sizes().y()));
  }
}

/// Everything that was read for the run.
struct Inputs {
  Case source;
  std::vector<Well> wells;
  std::vector<SourceFile> files;
  std::vector<std::string> notes;
};

Inputs read_inputs(const BuildRequest& request, bool converts_deck) {
  Inputs in;
  in.source = read_case(*request.case_path, request.grid_includes);
  in.files = in.source.sources;
  in.notes = in.source.notes;
  in.wells = chosen_deck_wells(request, in.source);
  if (converts_deck)
    for (Well& well : in.wells) open_all_completions(in.source.grid, well);
  std::set<std::string> hashed;
  for (const WellRequest& well : request.wells) {
    TrajectoryFile file = read_trajectory(well.file, {well.head, false});
    in.notes.insert(in.notes.end(), file.notes.begin(), file.notes.end());
    std::ranges::move(wells_of_file(well, request, std::move(file)), std::back_inserter(in.wells));
    if (hashed.insert(well.file).second) in.files.push_back({well.file, sha256_hex(load_file(well.file).text)});
  }
  for (Well& well : in.wells) {
    // Cells of the grid are in its frame already.
    if (well.approximate_path) continue;
    if (auto note = fit_to_grid(well, in.source.grid)) in.notes.push_back(*std::move(note));
  }
  require_room(in.source.grid, in.wells);
  std::set<std::string> names;
  for (const Well& well : in.wells) {
    if (!names.insert(well.name).second) {
      throw InvalidInput(
          fmt::format("two wells are named {}; give one of them another with --well FILE,name=NAME", well.name));
    }
  }
  return in;
}

BuildReport make_report(const BuildRequest& request, const Inputs& in, const BuildResult& result) {
  BuildReport report;
  report.case_path = *request.case_path;
  report.dimensions = in.source.grid.dimensions;
  report.build = result.summary;
  report.quality = quality(result.mesh);
  const auto& pore_volumes = result.mesh.cells.pore_volume.raw();
  report.pore_volume = std::accumulate(pore_volumes.begin(), pore_volumes.end(), 0.0);
  report.notes = in.notes;
  return report;
}

/// With --strict a well that was not meshed is a failure, and a failed run leaves no output.
void require_all_meshed(const BuildSummary& summary) {
  std::string names;
  const WellSummary* first = nullptr;
  for (const WellSummary& well : summary.wells) {
    if (well.meshed) continue;
    if (first == nullptr) first = &well;
    names += (names.empty() ? "" : ", ") + well.name;
  }
  if (first == nullptr) return;
  throw InvalidInput(fmt::format("--strict: not meshed: {}; {}: {}", names, first->name, first->reason));
}

/// The report, with what the run knows so far; the time of writing is not among it.
std::string page_of(const BuildRequest& request, const Mesh& mesh, const Provenance& provenance,
                    const BuildReport& report) {
  const std::string name = request.output.value_or(*request.case_path);
  const Assessment assessment = assess(mesh, {});
  return report_html({mesh, provenance, assessment, name, program_and_version(),
                      parse_build_facts(to_json(report), "the summary of this run")});
}

/// A deck of several phases wants larger cells at the bore than a mesh alone; what the user gives goes first.
DeckRings choose_rings(BuildRequest& request, const std::optional<WholeDeck>& deck) {
  if (!deck || request.split.value_or(1) > 1) return {};
  DeckRings chosen = rings_for(*deck);
  if (request.radial.sectors) chosen.sectors.reset();
  if (request.radial.rings) chosen.rings.reset();
  if (request.radial.growth) chosen.growth.reset();
  if (chosen.sectors) request.radial.sectors = chosen.sectors;
  if (chosen.rings) request.radial.rings = chosen.rings;
  if (chosen.growth) request.radial.growth = chosen.growth;
  return chosen;
}

int build(const GivenRequest& given) {
  BuildRequest request = complete(given.request);
  const std::optional<WholeDeck> deck = deck_to_convert(request);
  const DeckRings chosen_rings = choose_rings(request, deck);
  OwnOutputs own;
  own.has_deck_folders = deck.has_value();
  if (request.report) own.page = {"report", *request.report};
  const OutputSet outputs(outputs_of(request), inputs_of(request, deck), request.overwrite, own);
  std::optional<tbb::global_control> threads;
  if (request.threads) {
    threads.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(*request.threads));
  }

  Progress progress(request.quiet ? ProgressStyle::off : request.progress, {"read", "mesh", "quality", "write"});
  Stopwatch watch;
  progress.next();
  const Inputs in = read_inputs(request, deck.has_value());
  std::vector<StepTime> times{{"read", watch.lap()}};
  const BuildOptions options{request.mapping.value_or(MappingMethod::automatic),
                             request.threads.value_or(0),
                             request.refinement_levels.value_or(-1),
                             request.fault_policy.value_or(FaultPolicy::stop),
                             request.heal_throw,
                             request.fluxes.value_or(Fluxes::two_point),
                             request.optimise.value_or(Optimisation::off),
                             request.metric.value_or(Metric::geometric),
                             request.split.value_or(1)};
  progress.next();
  const BuildResult result = build_mesh(in.source, in.wells, options);
  if (request.strict) require_all_meshed(result.summary);
  times.insert(times.end(), result.summary.times.begin(), result.summary.times.end());
  watch.lap();

  progress.next();
  BuildReport report = make_report(request, in, result);
  times.push_back({"quality", watch.lap()});
  report.times = std::move(times);
  progress.next();
  const Provenance provenance{program_and_version(), given.command, config_text(request), in.files};
  std::vector<bool> meshed;
  for (const WellSummary& well : result.summary.wells) meshed.push_back(well.meshed || request.split.value_or(1) > 1);
  const DeckOutput write_deck = [&](const std::string& file, const std::string& folder, const std::string& name) {
    report.conversion =
        convert_deck({*deck, in.source, in.wells, meshed, result.mesh, chosen_rings}, {file, folder, name});
    return std::vector<std::string>{fmt::format("{} beside it holds what it includes", name)};
  };
  const auto page = [&] { return page_of(request, result.mesh, provenance, report); };
  report.files = outputs.write(result.mesh, provenance, {&in.source.grid, write_deck, page});
  report.times.push_back({"write", watch.lap()});
  progress.next();
  if (request.json) {
    std::cout << to_json(report);
  } else if (!request.quiet) {
    std::cout << to_text(report);
  }
  return 0;
}

}  // namespace

Run add_build(CLI::App& app) {
  const auto given = std::make_shared<GivenRequest>();
  const auto set_case = [given](const std::string& path) {
    given->request.case_path = path;
    given->command += " " + path;
  };
  app.add_option_function<std::string>("CASE", set_case, "A deck (.DATA), a grid (.GRDECL) or a run file (.toml)")
      ->type_name("FILE");
  for (const BuildOption& option : build_options()) add_option(app, option, given);
  return [given] { return build(*given); };
}

}  // namespace wellknit
