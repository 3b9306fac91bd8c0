// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The corner-point host (topology, geometry, transmissibilities) beside opm-grid's C routines for the same: one
/// deformed and faulted grid, each variant in a process of its own, so that its peak memory can be told.
///
///     host_benchmark [CELLS…]      default: 1000000
///
/// Prints cells per second of processor time on one thread, of elapsed time on two, and the peak resident memory with
/// the input in it, which all variants share. Fault columns: every 25th along i, every 40th along j.

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <opm/grid/UnstructuredGrid.h>
#include <opm/grid/cornerpoint_grid.h>
#include <opm/grid/transmissibility/trans_tpfa.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "algorithm/host_mesh.h"

namespace wellknit {

namespace {

/// Depth of a layer's top: folded layers, thrown along the faults.
double depth_at(const std::array<std::int64_t, 3>& cell, double x, double y, std::int64_t level) {
  const double fold = 20.0 * std::sin(x / 700.0) * std::cos(y / 900.0) + 0.5 * std::sin(x / 90.0 + y / 130.0);
  const double throw_i = 7.0 * static_cast<double>((cell[0] / 25) % 3) * (0.6 + 0.4 * std::sin(y / 800.0));
  const double throw_j = 4.0 * static_cast<double>((cell[1] / 40) % 2) * (0.6 + 0.4 * std::sin(x / 600.0));
  const double thickness = 4.0 + std::sin(x / 400.0 + y / 300.0);
  return 2000.0 + fold + throw_i + throw_j + thickness * static_cast<double>(level);
}

/// As a deck would give it: depths with three decimals.
double rounded(double value) { return std::round(1000.0 * value) / 1000.0; }

CornerPointGrid make_grid(std::int64_t n) {
  CornerPointGrid grid;
  grid.dimensions = {n, n, n};
  constexpr double width = 50.0;
  for (std::int64_t j = 0; j <= n; ++j)
    for (std::int64_t i = 0; i <= n; ++i) {
      const double x = width * static_cast<double>(i);
      const double y = width * static_cast<double>(j);
      const double lean = 0.05 * std::sin(x / 500.0);
      grid.coord.insert(grid.coord.end(), {x, y, 1900.0, x + 1000.0 * lean, y - 500.0 * lean, 2900.0});
    }
  const auto cells = static_cast<std::size_t>(n * n * n);
  grid.zcorn.resize(8 * cells);
  grid.active.assign(cells, 1);
  for (auto& k : grid.permeability) k.resize(cells);
  grid.porosity.resize(cells);
  for (std::size_t c = 0; c < cells; ++c) {
    const auto at = grid.ijk(HostCellId(c));
    for (int corner = 0; corner < 8; ++corner) {
      const int di = corner & 1;
      const int dj = (corner >> 1) & 1;
      const int dk = corner >> 2;
      grid.zcorn[grid.zcorn_index(at, di, dj, dk)] = rounded(
          depth_at(at, width * static_cast<double>(at[0] + di), width * static_cast<double>(at[1] + dj), at[2] + dk));
    }
    if (c % 97 == 0) grid.active[c] = 0;
    const double k = 1e-13 * std::exp(std::sin(static_cast<double>(c % 1009)));
    grid.permeability[0][c] = grid.permeability[1][c] = k;
    grid.permeability[2][c] = 0.1 * k;
    grid.porosity[c] = 0.2;
  }
  return grid;
}

void wellknit_host(const CornerPointGrid& grid, std::size_t threads) {
  const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, threads);
  const HostMesh mesh = build_host_mesh(grid);
  if (mesh.faces.transmissibility.size() != mesh.faces.size()) std::abort();
}

void opm_grid(const CornerPointGrid& grid) {
  std::vector<int> active(grid.active.begin(), grid.active.end());
  grdecl input{};
  for (std::size_t a = 0; a < 3; ++a) input.dims[a] = static_cast<int>(grid.dimensions[a]);
  input.coord = grid.coord.data();
  input.zcorn = grid.zcorn.data();
  input.actnum = active.data();
  UnstructuredGrid* const out = create_grid_cornerpoint(&input, 0.0);
  if (out == nullptr) std::abort();
  std::vector<double> tensor(9 * static_cast<std::size_t>(out->number_of_cells), 0.0);
  for (std::size_t c = 0; c < static_cast<std::size_t>(out->number_of_cells); ++c) {
    const auto from = static_cast<std::size_t>(out->global_cell == nullptr ? static_cast<int>(c) : out->global_cell[c]);
    for (std::size_t a = 0; a < 3; ++a) tensor[9 * c + 4 * a] = grid.permeability[a][from];
  }
  std::vector<double> half(static_cast<std::size_t>(out->cell_facepos[out->number_of_cells]));
  tpfa_htrans_compute(out, tensor.data(), half.data());
  std::vector<double> whole(static_cast<std::size_t>(out->number_of_faces));
  tpfa_trans_compute(out, half.data(), whole.data());
  destroy_grid(out);
}

struct Cost {
  double processor = 0.0;  ///< s
  double elapsed = 0.0;    ///< s
  double peak = 0.0;       ///< GB
};

double seconds(const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); }

double processor_time() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Runs the work in a process of its own, which times it; its beginning and end are not counted.
Cost cost_of(const std::function<void()>& work) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) std::abort();
  const pid_t child = fork();
  if (child == 0) {
    const double processor = processor_time();
    const auto begin = std::chrono::steady_clock::now();
    work();
    const Cost cost{processor_time() - processor,
                    std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 0.0};
    _exit(write(ends[1], &cost, sizeof cost) == sizeof cost ? 0 : 1);
  }
  Cost cost;
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  if (status != 0 || read(ends[0], &cost, sizeof cost) != sizeof cost) {
    fmt::print(stderr, "a variant failed\n");
    std::exit(1);
  }
  close(ends[0]);
  close(ends[1]);
  cost.peak = static_cast<double>(usage.ru_maxrss) * 1024e-9;
  return cost;
}

Cost best(const std::vector<Cost>& costs) {
  const auto least = [&](double Cost::*member) {
    return (*std::min_element(costs.begin(), costs.end(),
                              [&](const Cost& a, const Cost& b) { return a.*member < b.*member; })).*
           member;
  };
  return {least(&Cost::processor), least(&Cost::elapsed), least(&Cost::peak)};
}

void compare(std::int64_t cells) {
  const auto n = static_cast<std::int64_t>(std::llround(std::cbrt(static_cast<double>(cells))));
  const CornerPointGrid grid = make_grid(n);
  const auto count = static_cast<double>(n * n * n);
  // Small grids are repeated, so that the clock has something to tell.
  const int runs = static_cast<int>(std::clamp(2e6 / count, 1.0, 200.0));
  const auto repeated = [&](const auto& work) {
    return cost_of([&] {
      for (int r = 0; r < runs; ++r) work();
    });
  };
  // In turns, and the best of each: the first process to touch a machine's memory pays for it, and others share it.
  std::array<std::vector<Cost>, 3> costs;
  for (int round = 0; round < 3; ++round) {
    costs[0].push_back(repeated([&] { wellknit_host(grid, 1); }));
    costs[1].push_back(repeated([&] { wellknit_host(grid, 2); }));
    costs[2].push_back(repeated([&] { opm_grid(grid); }));
  }
  const auto [one, two, peer] = std::array{best(costs[0]), best(costs[1]), best(costs[2])};
  const double done = count * runs;
  fmt::print(
      "{:>9.0f} cells: wellknit {:.2f} M cells/s on one thread, {:.2f} on two ({:.2f} x), {:.2f} GB; opm-grid {:.2f} "
      "M cells/s, {:.2f} GB; ratios {:.2f} x, {:.2f} x the memory\n",
      count, 1e-6 * done / one.processor, 1e-6 * done / two.elapsed, one.elapsed / two.elapsed, two.peak,
      1e-6 * done / peer.processor, peer.peak, peer.processor / one.processor, two.peak / peer.peak);
}

}  // namespace

}  // namespace wellknit

int main(int argc, char** argv) {
  if (argc == 1) wellknit::compare(1'000'000);
  for (int a = 1; a < argc; ++a) wellknit::compare(std::atoll(argv[a]));
}
