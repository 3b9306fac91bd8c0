// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "interface/model_builder.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include "model/errors.h"
#include "model/mesh_check.h"
#include "model/quality.h"
#include "readers/file_content.h"
#include "readers/fit_to_grid.h"
#include "readers/read_case.h"
#include "readers/read_mesh.h"
#include "readers/read_trajectory.h"
#include "wellknit_version.h"
#include "writers/formats.h"

namespace wellknit {

namespace {

template <class Value, std::size_t size>
Value chosen(std::string_view option, std::string_view text,
             const std::array<std::pair<std::string_view, Value>, size>& table) {
  std::string names;
  for (const auto& [name, value] : table) {
    if (name == text) return value;
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  throw InvalidInput(fmt::format("{}: expected one of {}, found {}", option, names, text));
}

double number(std::string_view option, const std::string& text) {
  std::istringstream in(text);
  double value = 0.0;
  if (!(in >> value) || !in.eof() || !std::isfinite(value))
    throw InvalidInput(fmt::format("{}: expected a number, found {}", option, text));
  return value;
}

int count(std::string_view option, const std::string& text, int most) {
  const double value = number(option, text);
  if (value != std::floor(value) || value < 0.0 || value > most)
    throw InvalidInput(fmt::format("{}: expected a whole number from 0 to {}, found {}", option, most, text));
  return static_cast<int>(value);
}

void check(const WellOptions& options) {
  const RadialOptions& r = options.radial;
  if (!(r.bore_radius > 0.0) || !(r.drainage_radius > r.bore_radius) || !std::isfinite(r.drainage_radius))
    throw InvalidInput(fmt::format("expected a bore radius above 0 and a drainage radius above it, found {} m and {} m",
                                   r.bore_radius, r.drainage_radius));
  if (r.sectors < 3 || r.sectors > 360)
    throw InvalidInput(fmt::format("sectors: expected 3 to 360, found {}", r.sectors));
  if (r.rings < 1 || r.rings > 1000) throw InvalidInput(fmt::format("rings: expected 1 to 1000, found {}", r.rings));
  if (r.segments && (*r.segments < 1 || *r.segments > 1'000'000))
    throw InvalidInput(fmt::format("segments: expected 1 to 1000000, found {}", *r.segments));
  if (!std::isfinite(options.skin)) throw InvalidInput("skin: expected a number");
}

std::vector<double> lengths_along(const std::vector<Vec3>& points) {
  std::vector<double> out;
  for (std::size_t i = 0; i < points.size(); ++i)
    out.push_back(i == 0 ? 0.0 : out.back() + (points[i] - points[i - 1]).norm());
  return out;
}

}  // namespace

MeshMode mesh_mode_named(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, MeshMode>, 3> modes{
      {{"auto", MeshMode::automatic}, {"layered", MeshMode::layered}, {"swept", MeshMode::swept}}};
  return chosen("mode", name, modes);
}

ModelBuilder::ModelBuilder(const std::string& path, const std::vector<std::string>& grid_includes)
    : path_(path), source_(read_case(path, grid_includes)), files_(source_.sources), notes_(source_.notes) {}

void ModelBuilder::add(Well well, const WellOptions& options) {
  check(options);
  const auto same = [&](const Well& other) { return other.name == well.name; };
  if (std::any_of(wells_.begin(), wells_.end(), same))
    throw InvalidInput(fmt::format("two wells are named {}; give one of them another name", well.name));
  well.radial = options.radial;
  if (options.skin != 0.0) well.skin = options.skin;
  if (!well.approximate_path)
    if (auto note = fit_to_grid(well, source_.grid)) notes_.push_back(*std::move(note));
  wells_.push_back(std::move(well));
}

void ModelBuilder::add_file(const std::string& path, const WellOptions& options) {
  TrajectoryFile file = read_trajectory(path);
  notes_.insert(notes_.end(), file.notes.begin(), file.notes.end());
  for (Well& well : file.wells) add(std::move(well), options);
  files_.push_back({path, sha256_hex(load_file(path).text)});
}

void ModelBuilder::add_path(const std::string& name, const std::vector<Vec3>& points,
                            const std::vector<double>& measured_depth, const WellOptions& options) {
  if (name.empty()) throw InvalidInput("a well needs a name");
  if (points.size() < 2)
    throw InvalidInput(fmt::format("well {}: expected 2 points or more, found {}", name, points.size()));
  Well well;
  well.name = name;
  well.trajectory = {measured_depth.empty() ? lengths_along(points) : measured_depth, points};
  const auto& md = well.trajectory.measured_depth;
  if (md.size() != points.size())
    throw InvalidInput(fmt::format("well {}: {} points and {} measured depths", name, points.size(), md.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite() || !std::isfinite(md[i]))
      throw InvalidInput(fmt::format("well {}: point {} has a value that is not a number", name, i));
    if (i > 0 && !(md[i] > md[i - 1]))
      throw InvalidInput(
          fmt::format("well {}: measured depth {} at point {} is not above the one before", name, md[i], i));
  }
  add(std::move(well), options);
}

void ModelBuilder::add_deck_wells(const std::string& names, const WellOptions& options) {
  std::istringstream in(names);
  std::vector<std::string> wanted;
  for (std::string name; std::getline(in, name, ',');) wanted.push_back(name);
  const bool all = names == "all";
  for (const std::string& name : wanted) {
    const auto same = [&](const Well& well) { return well.name == name; };
    if (!all && std::none_of(source_.deck_wells.begin(), source_.deck_wells.end(), same))
      throw InvalidInput(fmt::format("{} has no well {}", path_, name));
  }
  if (source_.deck_wells.empty()) throw InvalidInput(fmt::format("{} has no wells", path_));
  for (const Well& well : source_.deck_wells)
    if (all || std::find(wanted.begin(), wanted.end(), well.name) != wanted.end() ||
        (!well.parent.empty() && std::find(wanted.begin(), wanted.end(), well.parent) != wanted.end()))
      add(well, options);
}

void ModelBuilder::set(std::string_view option, const std::string& value) {
  constexpr int most_levels = 6;
  constexpr int most_threads = 1024;
  static constexpr std::array<std::pair<std::string_view, MappingMethod>, 2> mappings{
      {{"auto", MappingMethod::automatic}, {"paper", MappingMethod::paper}}};
  static constexpr std::array<std::pair<std::string_view, FaultPolicy>, 2> policies{
      {{"stop", FaultPolicy::stop}, {"heal", FaultPolicy::heal}}};
  static constexpr std::array<std::pair<std::string_view, Fluxes>, 3> fluxes{
      {{"two-point", Fluxes::two_point}, {"consistent", Fluxes::consistent}, {"adapted", Fluxes::adapted}}};
  static constexpr std::array<std::pair<std::string_view, Metric>, 2> metrics{
      {{"geometric", Metric::geometric}, {"permeability", Metric::permeability}}};
  static constexpr std::array<std::pair<std::string_view, Optimisation>, 4> optimisations{
      {{"off", Optimisation::off},
       {"on", Optimisation::on},
       {"edges", Optimisation::edges},
       {"vertices", Optimisation::vertices}}};
  if (option == "mapping")
    options_.mapping = chosen(option, value, mappings);
  else if (option == "fault-policy")
    options_.fault_policy = chosen(option, value, policies);
  else if (option == "fluxes")
    options_.fluxes = chosen(option, value, fluxes);
  else if (option == "metric")
    options_.metric = chosen(option, value, metrics);
  else if (option == "optimise")
    options_.optimise = chosen(option, value, optimisations);
  else if (option == "refine")
    options_.refinement_levels = value == "auto" ? -1 : value == "off" ? 0 : count(option, value, most_levels);
  else if (option == "heal-throw")
    options_.heal_throw = number(option, value);
  else if (option == "threads")
    options_.threads = count(option, value, most_threads);
  else
    throw InvalidInput(fmt::format(
        "expected the option mapping, metric, optimise, refine, fault-policy, heal-throw, fluxes or threads, found {}",
        option));
}

std::unique_ptr<Model> ModelBuilder::build() const {
  std::optional<tbb::global_control> threads;
  if (options_.threads > 0)
    threads.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options_.threads));
  BuildResult result = build_mesh(source_, wells_, options_);
  auto model = std::make_unique<Model>(std::move(result.mesh));
  model->wells = std::move(result.summary.wells);
  model->notes = notes_;
  model->provenance = {fmt::format("wellknit {}", version), "", "", files_};
  return model;
}

std::unique_ptr<Model> read_model(const std::string& path) {
  MeshFile file = read_mesh(path);
  auto model = std::make_unique<Model>(std::move(file.mesh));
  model->provenance = std::move(file.provenance);
  return model;
}

std::vector<std::string> write_model(const Model& model, const std::string& path, const std::string& format,
                                     bool overwrite) {
  const WriterFormat* const writer = format.empty() ? writer_of_path(path) : find_writer(format);
  if (writer == nullptr)
    throw InvalidInput(format.empty() ? fmt::format("{}: its extension is none of those in `wellknit formats`", path)
                                      : fmt::format("no format {}; `wellknit formats` names them", format));
  return writer->write({model.mesh, model.provenance, path, overwrite ? Overwrite::allow : Overwrite::refuse});
}

std::vector<std::string> violations_of(const Model& model) {
  std::vector<std::string> out;
  for (const Violation& v : check_mesh(model.mesh))
    out.push_back(fmt::format("{}: {} {}", v.entity, v.check, v.detail));
  return out;
}

std::string quality_json(const Model& model) { return quality(model.mesh).to_json(); }

}  // namespace wellknit
