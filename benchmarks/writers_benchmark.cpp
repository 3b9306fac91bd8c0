// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Every writer on one mesh of N x N x N boxes, turned and shifted so that coordinates have all their digits:
///   writers_benchmark FOLDER [N [FORMAT]]
/// The limit that they are measured against stands in the first line: plain writes to the same folder. Memory is the
/// most that the process had during the writing, over what it had with the mesh alone.

#include <fmt/format.h>
#include <malloc.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include "tests/support/grids.h"
#include "tests/support/meshes.h"
#include "writers/formats.h"

namespace wellknit {

namespace {

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A line of /proc/self/status, kB to MB: VmRSS now, VmHWM at most.
double memory_mb(const std::string& name) {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(name + ":")) return std::stod(line.substr(name.size() + 1)) / 1024.0;
  return 0.0;
}

/// What was used at most is from now on.
void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

std::uintmax_t bytes_of(const std::filesystem::path& path) {
  if (!std::filesystem::is_directory(path)) return std::filesystem::file_size(path);
  std::uintmax_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
    if (entry.is_regular_file()) bytes += entry.file_size();
  return bytes;
}

/// Turned by 0.3 rad, in map coordinates; volumes and transmissibilities with all their digits.
Mesh map_mesh(std::int64_t n) {
  Mesh mesh = meshes::box_grid(n);
  const double c = std::cos(0.3);
  const double s = std::sin(0.3);
  const auto turn = [&](Vec3& p) {
    p = Vec3(464213.7 + c * p.x() - s * p.y(), 5931000.3 + s * p.x() + c * p.y(), p.z() + 1e-3 * p.x() / 7.0);
  };
  for (Vec3& p : mesh.vertices) turn(p);
  for (Vec3& p : mesh.cells.center) turn(p);
  for (Vec3& p : mesh.cells.centroid) turn(p);
  for (double& volume : mesh.cells.volume) volume *= 1.0 + 1.0 / 7.0;
  for (double& t : mesh.connections.transmissibility) t *= 1.0 + 1.0 / 7.0;
  return mesh;
}

void plain_writes(const std::filesystem::path& folder) {
  const std::string piece(1U << 20U, 'x');
  constexpr int pieces = 300;
  const std::filesystem::path path = folder / "plain";
  const double seconds = seconds_of([&] {
    std::ofstream out(path, std::ios::binary);
    for (int i = 0; i < pieces; ++i) out.write(piece.data(), static_cast<std::streamsize>(piece.size()));
  });
  std::filesystem::remove(path);
  fmt::print("{:<12} {:8.1f} MB {:7.2f} s {:8.0f} MB/s\n", "plain", 1.048576 * pieces, seconds,
             1.048576 * pieces / seconds);
}

int run(int count, char** arguments) {
  if (count < 2) {
    fmt::print(stderr, "usage: writers_benchmark FOLDER [N [FORMAT]]\n");
    return 2;
  }
  const std::filesystem::path folder = arguments[1];
  const Mesh mesh = map_mesh(count > 2 ? std::atoll(arguments[2]) : 100);
  const std::string_view wanted = count > 3 ? arguments[3] : "";
  const CornerPointGrid source = grids::box(mesh.source_dimensions);
  ::malloc_trim(0);
  const double before = memory_mb("VmRSS");
  fmt::print("mesh         {:8.1f} MB in memory\n", before);
  plain_writes(folder);
  for (const WriterFormat& format : writer_formats()) {
    if (!wanted.empty() && format.name != wanted) continue;
    const std::filesystem::path path = folder / fmt::format("out{}", format.extensions.front());
    ::malloc_trim(0);
    forget_peak();
    const double seconds = seconds_of([&] {
      format.write({mesh, meshes::provenance(), path.string(), Overwrite::allow, {}, &source});
    });
    const double size = static_cast<double>(bytes_of(path)) / 1e6;
    fmt::print("{:<12} {:8.1f} MB {:7.2f} s {:8.0f} MB/s  memory {:.2f}\n", format.name, size, seconds, size / seconds,
               memory_mb("VmHWM") / before);
    std::fflush(stdout);
    std::filesystem::remove_all(path);
  }
  return 0;
}

}  // namespace

}  // namespace wellknit

int main(int count, char** arguments) { return wellknit::run(count, arguments); }
