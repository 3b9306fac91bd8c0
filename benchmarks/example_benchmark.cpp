// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The main job on the shipped example, part by part. The limit that each part is measured against stands beside it in
/// one run: reading against the pass over the same bytes alone, the mesh with wells against the host alone.

#include <benchmark/benchmark.h>

#include <numeric>
#include <string>

#include "algorithm/build_mesh.h"
#include "model/quality.h"
#include "readers/file_content.h"
#include "readers/read_case.h"
#include "readers/read_trajectory.h"

namespace wellknit {

namespace {

const std::string folder = WELLKNIT_EXAMPLE;
const std::string grid = folder + "/example.GRDECL";

std::vector<Well> example_wells() {
  std::vector<Well> wells = read_trajectory(folder + "/curved.csv").wells;
  for (Well& well : read_trajectory(folder + "/steep.dev").wells) wells.push_back(std::move(well));
  return wells;
}

void read_bytes(benchmark::State& state) {
  std::int64_t bytes = 0;
  for (auto _ : state) {
    const FileContent file = load_file(grid);
    benchmark::DoNotOptimize(std::accumulate(file.text.begin(), file.text.end(), 0));
    bytes += static_cast<std::int64_t>(file.text.size());
  }
  state.SetBytesProcessed(bytes);
}

void read_grid(benchmark::State& state) {
  const auto bytes = static_cast<std::int64_t>(load_file(grid).text.size());
  for (auto _ : state) benchmark::DoNotOptimize(read_case(grid));
  state.SetBytesProcessed(bytes * static_cast<std::int64_t>(state.iterations()));
}

void build(benchmark::State& state, const std::vector<Well>& wells) {
  const Case source = read_case(grid);
  std::size_t cells = 0;
  for (auto _ : state) {
    const BuildResult result = build_mesh(source, wells, {});
    cells = result.mesh.cells.size();
    benchmark::DoNotOptimize(result);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(cells) * static_cast<std::int64_t>(state.iterations()));
}

void build_host_alone(benchmark::State& state) { build(state, {}); }
void build_with_wells(benchmark::State& state) { build(state, example_wells()); }

void measure_quality(benchmark::State& state) {
  const BuildResult result = build_mesh(read_case(grid), example_wells(), {});
  for (auto _ : state) benchmark::DoNotOptimize(quality(result.mesh));
}

BENCHMARK(read_bytes)->Unit(benchmark::kMillisecond);
BENCHMARK(read_grid)->Unit(benchmark::kMillisecond);
BENCHMARK(build_host_alone)->Unit(benchmark::kMillisecond);
BENCHMARK(build_with_wells)->Unit(benchmark::kMillisecond);
BENCHMARK(measure_quality)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace wellknit
