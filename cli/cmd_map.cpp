// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// wellknit map: values from the source grid to the mesh, or back (docs/commands/map.md).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "algorithm/transfer_map.h"
#include "cli/commands.h"
#include "cli/output_set.h"
#include "cli/usage_error.h"
#include "model/errors.h"
#include "model/mesh_arrays.h"
#include "readers/read_mesh.h"
#include "readers/read_properties.h"
#include "readers/read_value_table.h"
#include "readers/text.h"
#include "writers/write_property.h"

namespace wellknit {

namespace {

using Json = nlohmann::ordered_json;

struct MapRequest {
  std::string mesh;
  std::vector<std::string> forward;
  std::string back;
  std::vector<std::string> keywords;
  std::vector<std::string> sums;
  std::string weight = "volume";
  double unset = 0.0;
  std::string out;
  std::string vtu;
  bool overwrite = false;
  bool quiet = false;
  bool json = false;

  [[nodiscard]] PartWeight part_weight() const {
    return weight == "pore-volume" ? PartWeight::pore_volume : PartWeight::volume;
  }
  [[nodiscard]] Overwrite overwriting() const { return overwrite ? Overwrite::allow : Overwrite::refuse; }
};

/// Of values that are numbers.
struct Figures {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  double sum = 0.0;
};

Figures figures_of(const CellProperty& property) {
  Figures out;
  const auto add = [&](double value) {
    if (!std::isfinite(value)) return;
    out.low = std::min(out.low, value);
    out.high = std::max(out.high, value);
    out.sum += value;
  };
  std::visit(
      [&](const auto& values) {
        for (const auto value : values) add(static_cast<double>(value));
      },
      property);
  return out;
}

struct Carried {
  std::string keyword;
  std::string rule;
  Figures from;
  Figures to;
};

struct MapReport {
  std::vector<Carried> carried;
  std::vector<std::string> notes;
  std::vector<WrittenFile> files;
};

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::any_of(names.begin(), names.end(), [&](const std::string& n) { return equal_ignoring_case(n, name); });
}

std::vector<double> as_real(const CellProperty& property) {
  return std::visit([](const auto& values) { return std::vector<double>(values.begin(), values.end()); }, property);
}

std::string rule_name(const MapRequest& request, const CellProperty& property, bool is_sum) {
  if (is_sum) return "sum";
  return (std::holds_alternative<std::vector<double>>(property) ? "mean by " : "largest by ") + request.weight;
}

CellProperty carried_forward(const MapRequest& request, const Mesh& mesh, const CellProperty& property, bool is_sum) {
  if (is_sum) return sum_forward(mesh, as_real(property), request.unset);
  if (const auto* integers = std::get_if<std::vector<std::int32_t>>(&property))
    return largest_forward(mesh, *integers, request.part_weight(), static_cast<std::int32_t>(request.unset));
  return mean_forward(mesh, std::get<std::vector<double>>(property), request.part_weight(), request.unset);
}

CellProperty carried_back(const MapRequest& request, const Mesh& mesh, const CellProperty& property, bool is_sum) {
  if (is_sum) return sum_back(mesh, as_real(property), request.part_weight(), request.unset);
  if (const auto* integers = std::get_if<std::vector<std::int32_t>>(&property))
    return largest_back(mesh, *integers, static_cast<std::int32_t>(request.unset));
  return mean_back(mesh, std::get<std::vector<double>>(property), request.unset);
}

void refuse_unknown(const std::vector<std::string>& names, const std::vector<std::string>& known, const char* option) {
  for (const std::string& name : names)
    if (!contains(known, name))
      throw UsageError(fmt::format("{} {}: not among what is carried: {}", option, name, fmt::join(known, ", ")));
}

MapReport map_forward(const MapRequest& request, MeshFile& file) {
  std::vector<OutputRequest> outputs{{"hdf5", request.out}};
  if (!request.vtu.empty()) outputs.push_back({"vtu", request.vtu});
  std::vector<std::string> inputs = request.forward;
  inputs.push_back(request.mesh);
  const OutputSet output_set(outputs, inputs, request.overwrite);
  MapReport report;
  Mesh& mesh = file.mesh;
  std::map<std::string, CellProperty> properties;
  const auto [nx, ny, nz] = mesh.source_dimensions;
  for (const std::string& path : request.forward) {
    PropertyFile read = read_properties(path, nx * ny * nz);
    report.notes.insert(report.notes.end(), read.notes.begin(), read.notes.end());
    file.provenance.sources.push_back(read.source);
    for (auto& [keyword, values] : read.properties) properties[keyword] = std::move(values);
  }
  std::vector<std::string> known;
  for (const auto& [keyword, values] : properties) known.push_back(keyword);
  refuse_unknown(request.keywords, known, "--keyword");
  refuse_unknown(request.sums, known, "--sum");
  for (const auto& [keyword, values] : properties) {
    if (!request.keywords.empty() && !contains(request.keywords, keyword)) continue;
    const bool is_sum = contains(request.sums, keyword);
    CellProperty result = carried_forward(request, mesh, values, is_sum);
    report.carried.push_back({keyword, rule_name(request, values, is_sum), figures_of(values), figures_of(result)});
    if (mesh.cells.properties.contains(keyword)) report.notes.push_back(keyword + " of the mesh file is replaced");
    mesh.cells.properties[keyword] = std::move(result);
  }
  report.files = output_set.write(mesh, file.provenance);
  return report;
}

/// Pa in the source's unit of pressure.
double pascal_per_source_unit(UnitSystem units) {
  switch (units) {
    case UnitSystem::field: return pascal_per_psi;
    case UnitSystem::lab: return 101325.0;
    case UnitSystem::metric: break;
  }
  return pascal_per_bar;
}

/// A dataset of the mesh file with one number a cell, by its path or the name of a property; pressures in the source's
/// unit.
std::optional<CellProperty> mesh_values(const Mesh& mesh, const std::string& name) {
  std::optional<CellProperty> out;
  const std::string property = name.starts_with("cells/properties/") ? name.substr(17) : name;
  if (const auto found = mesh.cells.properties.find(property); found != mesh.cells.properties.end())
    return found->second;
  if ((name == "flow/pressure" || name == "pressure") && mesh.flow) {
    std::vector<double> values(mesh.flow->pressure.begin(), mesh.flow->pressure.end());
    for (double& value : values) value /= pascal_per_source_unit(mesh.source_units);
    return values;
  }
  for_each_array(mesh, [&](std::string_view path, const auto& values) {
    using Value = typename std::decay_t<decltype(values)>::value_type;
    if constexpr (std::is_same_v<Value, double>)
      if (path == name && path.starts_with("cells/")) out = std::vector<double>(values.begin(), values.end());
  });
  return out;
}

CellProperty table_values(const std::string& path, const Mesh& mesh) {
  const ValueTable table = read_value_table(path);
  if (table.index_title == "face")
    throw ParseError({path, 1, ""}, {"values of cells", "values of faces", "give a header `cell,NAME`"});
  std::vector<double> values(mesh.cells.size(), std::numeric_limits<double>::quiet_NaN());
  if (table.index_title.empty() && table.value.size() != values.size())
    throw ParseError({path, 0, ""}, {fmt::format("{} values, one for each cell of the mesh", values.size()),
                                     fmt::format("{}", table.value.size()), ""});
  for (std::size_t n = 0; n < table.index.size(); ++n) {
    if (table.index[n] >= static_cast<std::int64_t>(values.size()))
      throw ParseError({path, 0, ""}, {fmt::format("cells from 0 to {}", values.size() - 1),
                                       fmt::format("cell {}", table.index[n]), ""});
    double& value = values[static_cast<std::size_t>(table.index[n])];
    if (!std::isnan(value))
      throw ParseError({path, 0, ""}, {"each cell once", fmt::format("cell {} twice", table.index[n]), ""});
    value = table.value[n];
  }
  return values;
}

std::string keyword_of(const MapRequest& request) {
  if (!request.keywords.empty()) return upper_case(request.keywords.front());
  return upper_case(std::filesystem::path(request.back).stem().string()).substr(0, 8);
}

MapReport map_back(const MapRequest& request, const MeshFile& file) {
  MapReport report;
  const Mesh& mesh = file.mesh;
  std::optional<CellProperty> values = mesh_values(mesh, request.back);
  if (!values) {
    if (!std::filesystem::exists(request.back))
      throw InvalidInput(fmt::format(
          "--back {}: neither a dataset of {} with one number a cell nor a file; give cells/properties/NAME, "
          "flow/pressure (of a file from `wellknit solve -o`) or a table",
          request.back, request.mesh));
    values = table_values(request.back, mesh);
  }
  const std::string keyword = keyword_of(request);
  refuse_unknown(request.sums, {keyword}, "--sum");
  const CellProperty result = carried_back(request, mesh, *values, !request.sums.empty());
  report.carried.push_back(
      {keyword, rule_name(request, *values, !request.sums.empty()), figures_of(*values), figures_of(result)});
  std::int64_t empty = 0;
  for (std::size_t s = 0; s + 1 < mesh.transfer.start.size(); ++s)
    empty += mesh.transfer.start[s] == mesh.transfer.start[s + 1] ? 1 : 0;
  if (empty > 0)
    report.notes.push_back(fmt::format("{} source cells are not in the mesh and have {:g}", empty, request.unset));
  write_property(request.out, keyword, result,
                 fmt::format("{} of {}, {}", request.back, request.mesh, program_and_version()), request.overwriting());
  report.files.push_back(
      {"grdecl", request.out, static_cast<std::int64_t>(std::filesystem::file_size(request.out)), {}});
  return report;
}

std::string to_text(const MapReport& report, bool is_forward) {
  std::string text = fmt::format("{:<10} {:<22} {:>36} {:>36}\n", "keyword", "rule",
                                 is_forward ? "source: min, max, sum" : "mesh: min, max, sum",
                                 is_forward ? "mesh: min, max, sum" : "source: min, max, sum");
  for (const auto& [keyword, rule, from, to] : report.carried)
    text += fmt::format("  {:<8} {:<22} {:>10.5g} {:>10.5g} {:>14.9g} {:>10.5g} {:>10.5g} {:>14.9g}\n", keyword, rule,
                        from.low, from.high, from.sum, to.low, to.high, to.sum);
  for (const std::string& note : report.notes) text += "note        " + note + "\n";
  for (const WrittenFile& file : report.files) text += wellknit::to_text(file);
  return text;
}

std::string to_json(const MapRequest& request, const MapReport& report) {
  const auto figures = [](const Figures& f) {
    if (!(f.low <= f.high)) return Json();
    return Json{{"min", f.low}, {"max", f.high}, {"sum", f.sum}};
  };
  Json json{{"program", program_and_version()}, {"file", request.mesh}};
  json["direction"] = request.back.empty() ? "forward" : "back";
  json["carried"] = Json::array();
  for (const auto& [keyword, rule, from, to] : report.carried)
    json["carried"].push_back({{"keyword", keyword}, {"rule", rule}, {"from", figures(from)}, {"to", figures(to)}});
  json["notes"] = report.notes;
  json["outputs"] = Json::array();
  for (const WrittenFile& file : report.files)
    json["outputs"].push_back({{"format", file.format}, {"path", file.path}, {"bytes", file.bytes}});
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void validate(const MapRequest& request) {
  if (request.forward.empty() == request.back.empty())
    throw UsageError("give either --forward FILE (source grid to mesh) or --back DATASET|FILE (mesh to source grid)");
  if (request.weight != "volume" && request.weight != "pore-volume")
    throw UsageError(fmt::format("--weight: expected volume or pore-volume, found '{}'", request.weight));
  if (request.back.empty()) return;
  if (request.keywords.size() > 1) throw UsageError("--keyword: with --back it names the one result");
  if (!request.keywords.empty() && request.keywords.front().size() > 8)
    throw UsageError(fmt::format("--keyword {}: a keyword of a deck has 8 letters at most", request.keywords.front()));
  if (!request.vtu.empty()) throw UsageError("--vtu: the source grid is not written as VTU; leave it out with --back");
  if (std::filesystem::path(request.out) == std::filesystem::path(request.mesh) ||
      std::filesystem::path(request.out) == std::filesystem::path(request.back))
    throw UsageError(fmt::format("{}: is an input of this run", request.out));
  check_output_path(request.out, request.overwriting());
}

int map(const MapRequest& request) {
  validate(request);
  MeshFile file = read_mesh(request.mesh);
  const MapReport report = request.back.empty() ? map_forward(request, file) : map_back(request, file);
  if (request.json)
    std::cout << to_json(request, report);
  else if (!request.quiet)
    std::cout << to_text(report, request.back.empty());
  return 0;
}

}  // namespace

Run add_map(CLI::App& app) {
  const auto request = std::make_shared<MapRequest>();
  app.add_option("MESH", request->mesh, "A mesh file (HDF5)")->required()->type_name("FILE");
  app.add_option("--forward", request->forward, "Properties on the source grid (GRDECL …); repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.add_option("--back", request->back, "A dataset of the mesh file with a number a cell, or a table of cells")
      ->type_name("DATASET|FILE");
  app.add_option("--keyword", request->keywords, "Forward: carry only these; back: the result's name")
      ->type_name("NAME")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--sum", request->sums, "Keywords that are amounts: their sum is kept, not their mean")
      ->type_name("NAME")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--weight", request->weight, "Of a cell's parts: volume or pore-volume")->capture_default_str();
  app.add_option("--default", request->unset, "Of cells that get no value")->capture_default_str();
  app.add_option("-o,--output", request->out, "Forward: a mesh file with the properties; back: a GRDECL file")
      ->required()
      ->type_name("OUT");
  app.add_option("--vtu", request->vtu, "Forward: a VTU as well")->type_name("FILE");
  app.add_flag("--overwrite", request->overwrite, "Replace outputs that exist");
  app.add_flag("--quiet", request->quiet, "No output but errors");
  app.add_flag("--json", request->json, "As JSON");
  return [request] { return map(*request); };
}

}  // namespace wellknit
