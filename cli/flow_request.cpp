// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/flow_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "cli/quantity.h"
#include "cli/usage_error.h"
#include "model/errors.h"
#include "model/units.h"
#include "readers/text.h"
#include "writers/boundary_patches.h"

namespace wellknit {

namespace {

constexpr double standard_gravity = 9.80665;  ///< m/s2
constexpr std::string_view all_sides = "all";

struct SideName {
  std::string_view option;
  std::string_view patch;
};
constexpr std::array side_names{SideName{"i-", "i_min"}, SideName{"i+", "i_max"}, SideName{"j-", "j_min"},
                                SideName{"j+", "j_max"}, SideName{"k-", "k_min"}, SideName{"k+", "k_max"}};

double parse_number(const std::string& text, const std::string& option, std::string_view what) {
  const auto number = parse_real(text);
  if (!number) throw UsageError(fmt::format("{}: expected {}, found '{}'", option, what, text));
  return *number;
}

WellControl parse_control(const std::string& text, const std::string& option) {
  if (equal_ignoring_case(text, "shut")) return {WellControl::Kind::shut, 0.0};
  const auto quantity = parse_quantity(text);
  if (!quantity)
    throw UsageError(fmt::format("{}: expected a pressure ({}), a rate ({}) or shut, found '{}'", option,
                                 pressure_units, rate_units, text));
  const bool is_rate = quantity->kind == Quantity::Kind::rate;
  return {is_rate ? WellControl::Kind::rate : WellControl::Kind::pressure, quantity->value};
}

/// The text before and after the last '='; names may hold one.
std::pair<std::string, std::string> split_assignment(const std::string& text, const std::string& option) {
  const std::size_t at = text.rfind('=');
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw UsageError(fmt::format("{}: expected NAME=VALUE, found '{}'", option, text));
  return {text.substr(0, at), text.substr(at + 1)};
}

PressureField parse_field(const std::string& text) {
  const auto fields = split_fields(text, ',');
  if (fields.size() != 4)
    throw UsageError(
        fmt::format("--field: expected P0,GX,GY,GZ (bar, and bar/m along x, y and depth), found '{}'", text));
  std::array<double, 4> numbers{};
  for (std::size_t n = 0; n < 4; ++n)
    numbers[n] = pascal_per_bar * parse_number(std::string(fields[n]), "--field", "four numbers");
  return {numbers[0], Vec3(numbers[1], numbers[2], numbers[3])};
}

std::vector<FlowSetting::Side> parse_sides(const std::string& text) {
  const auto [names, value] = split_assignment(text, "--boundary");
  std::optional<double> pressure;
  if (!equal_ignoring_case(value, "field")) pressure = parse_pressure(value, "--boundary");
  std::vector<FlowSetting::Side> out;
  for (const std::string_view name : split_fields(names, ',')) {
    const bool is_known = name == all_sides || std::any_of(side_names.begin(), side_names.end(),
                                                           [&](const SideName& s) { return s.option == name; });
    if (!is_known)
      throw UsageError(fmt::format("--boundary: expected i-, i+, j-, j+, k-, k+ or all, found '{}'", name));
    out.push_back({std::string(name), pressure});
  }
  return out;
}

PressureMethod parse_method(const std::string& text) {
  if (text == "auto") return PressureMethod::automatic;
  if (text == "direct") return PressureMethod::direct;
  if (text == "multigrid") return PressureMethod::multigrid;
  throw UsageError(fmt::format("--solver: expected auto, direct or multigrid, found '{}'", text));
}

bool parse_fluxes(const std::string& text) {
  if (text == "two-point") return false;
  if (text == "consistent") return true;
  throw UsageError(fmt::format("--fluxes: expected two-point or consistent, found '{}'", text));
}

void require_field(const FlowSetting& setting) {
  const bool is_used = std::any_of(setting.sides.begin(), setting.sides.end(),
                                   [](const FlowSetting::Side& side) { return !side.pressure; });
  if (is_used && !setting.field) throw UsageError("--boundary …=field: give the field with --field P0,GX,GY,GZ");
  if (!is_used && setting.field) throw UsageError("--field: say where it holds, as --boundary all=field");
}

/// Pa in one unit of the table's values, from the end of their title: pressure_bar, p_psi; bar without one.
double unit_of_title(const ValueTable& table) {
  const std::size_t at = table.value_title.find_last_of("_[(");
  std::string unit = at == std::string::npos ? "" : table.value_title.substr(at + 1);
  while (!unit.empty() && (unit.back() == ']' || unit.back() == ')')) unit.pop_back();
  const auto quantity = unit.empty() ? std::nullopt : parse_quantity("1" + unit);
  return quantity && quantity->kind == Quantity::Kind::pressure ? quantity->value : pascal_per_bar;
}

/// The faces of each side that were asked for, the later option deciding where two name the same side.
class Boundary {
 public:
  Boundary(const FlowSetting& setting, const Mesh& mesh) : mesh_(mesh) {
    for (const BoundaryPatch& patch : boundary_patches(mesh)) patches_[patch.name] = patch.faces;
    for (const FlowSetting::Side& side : setting.sides) take(side);
  }

  /// Hydrostatic from the datum where the pressure is one number.
  void add(const FlowSetting& setting, double datum, SteadyFlowProblem& problem) const {
    for (const SideName& name : side_names) {
      const auto found = sides_.find(std::string(name.option));
      if (found == sides_.end()) continue;
      for (const FaceId face : patches_.at(std::string(name.patch))) {
        const Vec3 at = face_geometry(mesh_, face).centroid;
        const double weight = setting.density * standard_gravity;
        problem.faces.push_back(
            {face, found->second ? *found->second + weight * (at.z() - datum) : setting.field->at(at)});
      }
    }
  }

 private:
  void take(const FlowSetting::Side& side) {
    bool is_found = false;
    for (const SideName& name : side_names) {
      if (side.name != all_sides && side.name != name.option) continue;
      if (!patches_.contains(std::string(name.patch))) continue;
      sides_[std::string(name.option)] = side.pressure;
      is_found = true;
    }
    if (!is_found) throw InvalidInput(fmt::format("--boundary {}: the mesh has no face on that side", side.name));
  }

  const Mesh& mesh_;
  std::map<std::string, std::vector<FaceId>> patches_;
  std::map<std::string, std::optional<double>> sides_;
};

/// Faces of the table win over those of sides.
void add_held_faces(const ValueTable& table, double unit, SteadyFlowProblem& problem) {
  std::vector<std::int64_t> named = table.index;
  std::sort(named.begin(), named.end());
  std::erase_if(problem.faces, [&](const HeldFace& held) {
    return std::binary_search(named.begin(), named.end(), held.face.value());
  });
  for (std::size_t n = 0; n < table.index.size(); ++n)
    problem.faces.push_back({FaceId(table.index[n]), unit * table.value[n]});
}

void add_table(const ValueTable& table, SteadyFlowProblem& problem) {
  const auto too_large =
      std::find_if(table.index.begin(), table.index.end(), [](auto index) { return index > max_ids; });
  if (too_large != table.index.end())
    throw InvalidInput(fmt::format("{}: the mesh has no {} {}", table.source.path, table.index_title, *too_large));
  const double unit = unit_of_title(table);
  if (table.index_title == "face") return add_held_faces(table, unit, problem);
  for (std::size_t n = 0; n < table.index.size(); ++n)
    problem.cells.push_back({CellId(table.index[n]), unit * table.value[n]});
}

IdVector<WellId, WellControl> well_controls(const FlowSetting& setting, const Mesh& mesh) {
  IdVector<WellId, WellControl> out;
  std::vector<std::uint8_t> is_used(setting.wells.size(), 0);
  for (const MeshWell& well : mesh.wells) {
    WellControl control = well.type == WellType::injector ? setting.injectors : setting.producers;
    for (std::size_t n = 0; n < setting.wells.size(); ++n) {
      if (!matches_pattern(well.name, setting.wells[n].pattern)) continue;
      control = setting.wells[n].control;
      is_used[n] = 1;
    }
    out.push_back(control);
  }
  for (std::size_t n = 0; n < setting.wells.size(); ++n) {
    if (is_used[n] != 0) continue;
    std::string names;
    for (const MeshWell& well : mesh.wells) names += (names.empty() ? "" : ", ") + well.name;
    throw UsageError(fmt::format("--well {}: the mesh has no such well; its wells are: {}", setting.wells[n].pattern,
                                 names.empty() ? "none" : names));
  }
  return out;
}

/// The mean depth of the mesh's cells by volume.
double mean_depth(const Mesh& mesh) {
  double volume = 0.0;
  double moment = 0.0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    volume += mesh.cells.volume[CellId(c)];
    moment += mesh.cells.volume[CellId(c)] * mesh.cells.depth[CellId(c)];
  }
  return volume > 0.0 ? moment / volume : 0.0;
}

/// What makes nothing flow at all, so that its user is not left with zeros.
void note_stillness(const SteadyFlowProblem& problem, std::vector<std::string>& notes) {
  std::vector<double> held;
  bool has_flow = problem.expansion != 0.0 || problem.density != 0.0;
  for (const WellControl& control : problem.wells) {
    if (control.kind == WellControl::Kind::pressure) held.push_back(control.value);
    has_flow = has_flow || (control.kind == WellControl::Kind::rate && control.value != 0.0);
  }
  for (const HeldFace& face : problem.faces) held.push_back(face.pressure);
  for (const HeldCell& cell : problem.cells) held.push_back(cell.pressure);
  if (held.empty() || has_flow) return;
  const auto [low, high] = std::minmax_element(held.begin(), held.end());
  if (*low == *high)
    notes.push_back(fmt::format(
        "every pressure that is held is {:g} bar, so nothing flows: give a boundary (--boundary all=200bar), a well "
        "another pressure or a rate (--well), or an --expansion",
        *low / pascal_per_bar));
}

}  // namespace

FlowSetting understand(const FlowRequest& request) {
  FlowSetting out;
  out.producers = parse_control(request.producers, "--producers");
  out.injectors = parse_control(request.injectors, "--injectors");
  for (const std::string& text : request.wells) {
    const auto [name, value] = split_assignment(text, "--well");
    out.wells.push_back({name, parse_control(value, "--well " + name)});
  }
  for (const std::string& text : request.boundaries)
    for (FlowSetting::Side& side : parse_sides(text)) out.sides.push_back(std::move(side));
  if (!request.field.empty()) out.field = parse_field(request.field);
  require_field(out);
  const double viscosity = parse_number(request.viscosity, "--viscosity", "a positive number (cP)");
  if (!(viscosity > 0.0))
    throw UsageError(fmt::format("--viscosity: expected a positive number (cP), found '{}'", request.viscosity));
  out.viscosity = viscosity * pascal_second_per_centipoise;
  if (!request.density.empty()) out.density = parse_number(request.density, "--gravity", "a density (kg/m3)");
  if (!request.datum.empty()) out.datum = parse_number(request.datum, "--datum", "a depth (m)");
  if (out.datum && out.density == 0.0) throw UsageError("--datum: has a meaning with --gravity only");
  if (!request.expansion.empty()) out.expansion = parse_rate(request.expansion, "--expansion");
  out.method = parse_method(request.solver);
  out.consistent = parse_fluxes(request.fluxes);
  if (!request.hold.empty()) {
    out.hold = read_value_table(request.hold);
    if (out.hold->index_title.empty())
      throw ParseError({request.hold, 1, ""}, {"a header `cell,pressure_bar` or `face,pressure_bar`", "none", ""});
  }
  return out;
}

FlowProblem make_problem(const FlowSetting& setting, const Mesh& mesh) {
  FlowProblem out;
  out.datum = setting.datum ? *setting.datum : mean_depth(mesh);
  SteadyFlowProblem& problem = out.problem;
  problem.viscosity = setting.viscosity;
  problem.density = setting.density;
  problem.expansion = setting.expansion;
  problem.solver.method = setting.method;
  problem.consistent = setting.consistent;
  problem.wells = well_controls(setting, mesh);
  if (!setting.sides.empty()) Boundary(setting, mesh).add(setting, out.datum, problem);
  if (setting.hold) add_table(*setting.hold, problem);
  note_stillness(problem, out.notes);
  return out;
}

}  // namespace wellknit
