// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The network that we solve, and the same network as a deck run by OPM Flow to its steady state.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include "algorithm/build_mesh.h"
#include "algorithm/steady_flow.h"
#include "readers/ecl_records.h"
#include "readers/file_content.h"
#include "tests/support/grids.h"
#include "tests/support/near_well.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/simulator_output.h"
#include "writers/write_flow_deck.h"

namespace wellknit {
namespace {

/// Bottom-hole pressures, bar, that a deck's WCONPROD and WCONINJE give its wells.
std::map<std::string, double> deck_pressures(const std::string& deck) {
  std::map<std::string, double> out;
  std::istringstream lines(deck);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find("OPEN BHP ");
    if (at == std::string::npos) continue;
    std::istringstream words(line.substr(at + 9));
    std::string defaults;
    double value = 0.0;
    words >> defaults >> value;
    out[line.substr(2, line.find('\'', 2) - 2)] = value;
  }
  return out;
}

/// Summary vectors at the last step, as "KEYWORD:WELL".
std::map<std::string, double> last_summary(const std::string& base) {
  const FileContent names = load_file(base + ".SMSPEC");
  const FileContent steps = load_file(base + ".UNSMRY");
  std::vector<std::string> keywords;
  std::vector<std::string> wells;
  EclRecords spec(names.text, base + ".SMSPEC");
  while (const auto array = spec.next()) {
    if (array->name == "KEYWORDS") keywords = spec.strings(*array);
    if (array->name == "WGNAMES" || array->name == "NAMES") wells = spec.strings(*array);
  }
  std::vector<double> last;
  EclRecords data(steps.text, base + ".UNSMRY");
  while (const auto array = data.next())
    if (array->name == "PARAMS") last = data.reals(*array);
  std::map<std::string, double> out;
  for (std::size_t n = 0; n < last.size(); ++n) out[keywords.at(n) + ":" + wells.at(n)] = last[n];
  return out;
}

/// A producer and an injector with radial meshes in a box of 300 x 300 x 20 m.
Mesh two_wells() {
  Case source;
  source.grid = grids::box({15, 15, 4}, {20.0, 20.0, 5.0});
  Well producer = near_well::straight("P", {90.0, 110.0, 990.0}, {90.0, 110.0, 1030.0});
  Well injector = near_well::straight("I", {210.0, 190.0, 990.0}, {210.0, 190.0, 1030.0});
  producer.radial.drainage_radius = injector.radial.drainage_radius = 9.0;
  injector.type = WellType::injector;
  return build_mesh(source, {producer, injector}, {}).mesh;
}

TEST(SteadyFlow, FlowComesToTheSameRates) {
  if (!has_flow()) GTEST_SKIP() << "flow is not installed";
  const Mesh mesh = two_wells();
  const ScratchFolder folder;
  write_flow_deck(mesh, folder.file("NET.DATA"), {FlowFluids::water});
  // Tolerances that let it come to rest; its own control of time steps stops at an exact steady state.
  const std::string command = fmt::format(
      "cd '{}' && flow NET.DATA --time-step-control=newtoniterationcount --tolerance-mb=1e-13 --tolerance-cnv=1e-9 "
      "--tolerance-wells=1e-9 --linear-solver-reduction=1e-10 --threads-per-process=1 > flow.log 2>&1",
      folder.path().string());
  ASSERT_EQ(std::system(command.c_str()), 0) << folder.read("flow.log");
  const auto summary = last_summary(folder.file("NET"));

  SteadyFlowProblem problem;
  problem.viscosity = 0.5e-3;  // the template's water
  problem.density = 1000.0;
  const auto pressures = deck_pressures(folder.read("NET.DATA"));
  for (const MeshWell& well : mesh.wells)
    problem.wells.push_back({WellControl::Kind::pressure, 1e5 * pressures.at(well.name)});
  const SteadyFlow flow = solve_steady_flow(mesh, problem);
  const double produced = flow.wells[WellId(0)].rate * 86400.0;
  const double injected = -flow.wells[WellId(1)].rate * 86400.0;
  ASSERT_GT(produced, 1.0);
  // Single precision of the summary, 6e-8, and a formation volume factor off 1 by 1e-9 a bar.
  EXPECT_NEAR(summary.at("WWPR:P") / produced, 1.0, 1e-6);
  EXPECT_NEAR(summary.at("WWIR:I") / injected, 1.0, 1e-6);
}

}  // namespace
}  // namespace wellknit
