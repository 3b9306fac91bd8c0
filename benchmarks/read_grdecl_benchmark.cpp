// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Reading a large GRDECL file, in one run beside a loop that does nothing but turn the same bytes into numbers
/// (fast_float) and beside opm-common's parser. Times are of the whole process: user and system time of all threads
/// stand as counters. WELLKNIT_BENCHMARK_GRDECL names a file; without it a grid of a million cells is made.

#include <benchmark/benchmark.h>
#include <fast_float/fast_float.h>
#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opm/input/eclipse/Deck/Deck.hpp>
#include <opm/input/eclipse/Parser/Parser.hpp>
#include <string>

#include "readers/file_content.h"
#include "readers/number_array.h"
#include "readers/parse_case.h"

namespace wellknit {

namespace {

void write_array(std::ofstream& out, const char* keyword, std::int64_t count, double (*value)(std::int64_t),
                 int digits) {
  out << keyword << '\n';
  for (std::int64_t n = 0; n < count; ++n) out << fmt::format("{:.{}f}{}", value(n), digits, n % 8 == 7 ? '\n' : ' ');
  out << "/\n";
}

/// n^3 cells with values that look like those of a real model.
std::string make_file(std::int64_t n) {
  const auto path = std::filesystem::temp_directory_path() / fmt::format("wellknit_benchmark_{}.GRDECL", n);
  std::ofstream out(path);
  out << fmt::format("SPECGRID\n{} {} {} 1 F /\n", n, n, n);
  const auto coordinate = [](std::int64_t m) { return m % 3 == 2 ? 2000.0 : 50.0 * std::cbrt(double(m)); };
  write_array(out, "COORD", 6 * (n + 1) * (n + 1), coordinate, 3);
  write_array(
      out, "ZCORN", 8 * n * n * n, [](std::int64_t m) { return 2000.0 + std::sqrt(double(m)) / 7.0; }, 3);
  write_array(
      out, "PORO", n * n * n, [](std::int64_t m) { return 0.2 + 0.05 * std::sin(double(m)); }, 5);
  write_array(
      out, "PERMX", n * n * n, [](std::int64_t m) { return 100.0 + 90.0 * std::sin(1.7 * double(m)); }, 3);
  return path.string();
}

const std::string& file() {
  static const std::string path = [] {
    const char* named = std::getenv("WELLKNIT_BENCHMARK_GRDECL");
    return named != nullptr ? std::string(named) : make_file(100);
  }();
  return path;
}

/// Processor time of this process so far, s.
struct ProcessTime {
  double user = 0.0;
  double system = 0.0;
  static ProcessTime now() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
    return {seconds(usage.ru_utime), seconds(usage.ru_stime)};
  }
};

template <class Work>
void measure(benchmark::State& state, Work work) {
  const auto bytes = static_cast<double>(load_file(file()).text.size());
  const ProcessTime begin = ProcessTime::now();
  for (auto _ : state) work();
  const ProcessTime end = ProcessTime::now();
  const auto runs = static_cast<double>(state.iterations());
  state.counters["user_s"] = (end.user - begin.user) / runs;
  state.counters["system_s"] = (end.system - begin.system) / runs;
  state.counters["MB_per_user_s"] = 1e-6 * bytes * runs / (end.user - begin.user);
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes * runs));
}

/// Blanks are skipped, every word that is a number becomes one, every other word is passed over.
void bare_fast_float(benchmark::State& state) {
  measure(state, [] {
    const FileContent content = load_file(file());
    std::vector<double> values;
    values.reserve(content.text.size() / 6);
    const char* at = content.text.data();
    const char* const end = at + content.text.size();
    while (true) {
      while (at < end && (*at == ' ' || *at == '\n')) ++at;
      if (at == end) break;
      double value = 0.0;
      const auto [stop, error] = fast_float::from_chars(at, end, value);
      if (error == std::errc())
        values.push_back(value);
      else
        while (at < end && *at != ' ' && *at != '\n') ++at;
      if (error == std::errc()) at = stop;
    }
    benchmark::DoNotOptimize(values.data());
  });
}

void read_case_with_threads(benchmark::State& state) {
  const oneapi::tbb::global_control threads(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(state.range(0)));
  DeckLimits limits;
  limits.hashes_sources = state.range(1) != 0;
  measure(state, [&] {
    DiskFiles files;
    benchmark::DoNotOptimize(parse_case(files, file(), {}, limits));
  });
}

void opm_common_parser(benchmark::State& state) {
  measure(state, [] { benchmark::DoNotOptimize(Opm::Parser().parseFile(file())); });
}

BENCHMARK(bare_fast_float)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(read_case_with_threads)
    ->ArgNames({"threads", "digest"})
    ->Args({1, 0})
    ->Args({2, 0})
    ->Args({1, 1})
    ->Args({2, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(opm_common_parser)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

}  // namespace wellknit
