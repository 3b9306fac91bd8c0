// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// wellknit solve: steady single-phase flow on a mesh file's connection list (docs/commands/solve.md).

#include <chrono>
#include <iostream>
#include <memory>

#include "cli/commands.h"
#include "cli/flow_report.h"
#include "cli/flow_request.h"
#include "cli/output_set.h"
#include "readers/read_mesh.h"

namespace wellknit {

namespace {

struct SolveRequest {
  std::string mesh;
  FlowRequest flow;
  std::string out;
  std::string vtu;
  bool overwrite = false;
  bool quiet = false;
  bool json = false;
};

/// The options that shape the solution, as they could be given again.
std::string command_text(const SolveRequest& request) {
  const FlowRequest& flow = request.flow;
  const FlowRequest defaults;
  std::string out = "wellknit solve";
  const auto add = [&](const char* option, const std::string& value, const std::string& fallback) {
    if (value != fallback) out += std::string(" ") + option + " " + value;
  };
  for (const std::string& well : flow.wells) add("--well", well, "");
  add("--producers", flow.producers, defaults.producers);
  add("--injectors", flow.injectors, defaults.injectors);
  for (const std::string& boundary : flow.boundaries) add("--boundary", boundary, "");
  add("--field", flow.field, "");
  add("--hold", flow.hold, "");
  add("--viscosity", flow.viscosity, defaults.viscosity);
  add("--gravity", flow.density, "");
  add("--datum", flow.datum, "");
  add("--expansion", flow.expansion, "");
  add("--fluxes", flow.fluxes, defaults.fluxes);
  add("--solver", flow.solver, defaults.solver);
  return out;
}

OutputSet outputs_of(const SolveRequest& request) {
  std::vector<OutputRequest> outputs;
  if (!request.out.empty()) outputs.push_back({"hdf5", request.out});
  if (!request.vtu.empty()) outputs.push_back({"vtu", request.vtu});
  std::vector<std::string> inputs{request.mesh};
  if (!request.flow.hold.empty()) inputs.push_back(request.flow.hold);
  return {outputs, inputs, request.overwrite};
}

int solve(const SolveRequest& request) {
  const FlowSetting setting = understand(request.flow);
  const OutputSet outputs = outputs_of(request);
  MeshFile file = read_mesh(request.mesh);
  FlowReport report;
  report.mesh_path = request.mesh;
  report.mesh = &file.mesh;
  report.problem = make_problem(setting, file.mesh);
  const auto begin = std::chrono::steady_clock::now();
  report.flow = solve_steady_flow(file.mesh, report.problem.problem);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  file.mesh.flow = report.flow.solution;
  file.mesh.flow->command = command_text(request);
  report.files = outputs.write(file.mesh, file.provenance);
  if (request.json)
    std::cout << to_json(report);
  else if (!request.quiet)
    std::cout << to_text(report);
  return 0;
}

void add_flow_options(CLI::App& app, FlowRequest& flow) {
  app.add_option("--well", flow.wells,
                 "NAME=VALUE: a pressure (200bar), a rate out of the rock (500m3/d, negative: in), or shut; NAME may "
                 "hold * and ?; repeatable")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  app.add_option("--producers", flow.producers, "The same for producers that no --well names")->capture_default_str();
  app.add_option("--injectors", flow.injectors, "The same for injectors")->capture_default_str();
  app.add_option("--boundary", flow.boundaries,
                 "SIDES=VALUE: i-, i+, j-, j+, k-, k+ or all, with commas; a pressure, or field; repeatable. Nothing "
                 "flows through the other sides")
      ->type_name("SIDES=VALUE")
      ->allow_extra_args(false);
  app.add_option("--field", flow.field, "A linear pressure field: bar at the origin, bar/m along x, y and depth")
      ->type_name("P0,GX,GY,GZ");
  app.add_option("--hold", flow.hold, "A table `cell,pressure_bar` or `face,pressure_bar` of held pressures")
      ->type_name("FILE");
  app.add_option("--viscosity", flow.viscosity, "cP")->capture_default_str();
  app.add_option("--gravity", flow.density, "Gravity, with this density of the fluid in kg/m3; off by default")
      ->type_name("DENSITY");
  app.add_option("--datum", flow.datum, "With gravity: depth in m where a side's pressure holds; the mesh's mean depth")
      ->type_name("DEPTH");
  app.add_option("--expansion", flow.expansion,
                 "A rate (500m3/d) that the rock gives off, spread by pore volume: pseudo-steady flow")
      ->type_name("RATE");
  app.add_option("--fluxes", flow.fluxes, "two-point, or consistent of a mesh built so")->capture_default_str();
  app.add_option("--solver", flow.solver, "auto, direct or multigrid")->capture_default_str();
}

}  // namespace

Run add_solve(CLI::App& app) {
  const auto request = std::make_shared<SolveRequest>();
  app.add_option("MESH", request->mesh, "A mesh file (HDF5)")->required()->type_name("FILE");
  add_flow_options(app, request->flow);
  app.add_option("-o,--output", request->out, "The mesh file with pressures and fluxes")->type_name("OUT.h5");
  app.add_option("--vtu", request->vtu, "VTU with the pressures")->type_name("FILE");
  app.add_flag("--overwrite", request->overwrite, "Replace outputs that exist");
  app.add_flag("--quiet", request->quiet, "No output but errors");
  app.add_flag("--json", request->json, "As JSON");
  return [request] { return solve(*request); };
}

}  // namespace wellknit
