// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/write_vtkhdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "model/errors.h"
#include "writers/hdf5_file.h"
#include "writers/vtk_cells.h"
#include "writers/vtk_xml.h"

namespace wellknit {

namespace {

void require_source(const Mesh& mesh, const CornerPointGrid* source) {
  if (source == nullptr)
    throw InvalidInput("vtkhdf shows the source grid, which is not known here; name it with --source CASE");
  if (source->dimensions != mesh.source_dimensions)
    throw InvalidInput(fmt::format("vtkhdf: the source grid has {} x {} x {} cells, that of the mesh {} x {} x {}",
                                   source->dimensions[0], source->dimensions[1], source->dimensions[2],
                                   mesh.source_dimensions[0], mesh.source_dimensions[1], mesh.source_dimensions[2]));
}

/// Corners of the active cells, each place on a pillar once.
struct Corners {
  std::vector<Vec3> points;
  std::vector<std::int64_t> connectivity;  ///< eight a cell, in VTK's order
  std::vector<HostCellId> cells;

  explicit Corners(const CornerPointGrid& grid) {
    for (std::int64_t c = 0; c < grid.cell_count(); ++c)
      if (grid.active[static_cast<std::size_t>(c)] != 0) cells.emplace_back(c);
    turn_left_handed(grid);
    connectivity.resize(8 * cells.size());
    place_levels(grid);
    number_corners(grid);
  }

 private:
  /// Where i, j, k are left-handed, top and base change places: the base has to look into the cell.
  void turn_left_handed(const CornerPointGrid& grid) {
    for (const HostCellId cell : cells) {
      const double volume = bilinear_hexahedron_volume(grid.corners(cell));
      if (volume == 0.0) continue;
      if (volume < 0.0) std::rotate(order_.begin(), order_.begin() + 4, order_.end());
      return;
    }
  }

  static std::size_t pillar(const CornerPointGrid& grid, HostCellId cell, const std::array<int, 3>& corner) {
    const auto [i, j, k] = grid.ijk(cell);
    return static_cast<std::size_t>(i + corner[0] + (grid.dimensions[0] + 1) * (j + corner[1]));
  }
  static double depth(const CornerPointGrid& grid, HostCellId cell, const std::array<int, 3>& corner) {
    return grid.zcorn[grid.zcorn_index(grid.ijk(cell), corner[0], corner[1], corner[2])];
  }

  void place_levels(const CornerPointGrid& grid) {
    const std::size_t pillars =
        static_cast<std::size_t>(grid.dimensions[0] + 1) * static_cast<std::size_t>(grid.dimensions[1] + 1);
    levels_.resize(pillars);
    for (const HostCellId cell : cells)
      for (const auto& corner : order_) levels_[pillar(grid, cell, corner)].push_back(depth(grid, cell, corner));
    first_.resize(pillars);
    for (std::size_t p = 0; p < pillars; ++p) {
      auto& levels = levels_[p];
      std::sort(levels.begin(), levels.end());
      levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
      levels.shrink_to_fit();
      first_[p] = static_cast<std::int64_t>(points.size());
      const auto row = static_cast<std::size_t>(grid.dimensions[0] + 1);
      for (const double level : levels)
        points.push_back(
            grid.pillar_point(static_cast<std::int64_t>(p % row), static_cast<std::int64_t>(p / row), level));
    }
  }

  void number_corners(const CornerPointGrid& grid) {
    for (std::size_t n = 0; n < cells.size(); ++n)
      for (std::size_t corner = 0; corner < 8; ++corner) {
        const std::size_t p = pillar(grid, cells[n], order_[corner]);
        const auto& levels = levels_[p];
        const auto at = std::lower_bound(levels.begin(), levels.end(), depth(grid, cells[n], order_[corner]));
        connectivity[8 * n + corner] = first_[p] + (at - levels.begin());
      }
  }

  /// VTK's corners of a hexahedron as (di, dj, dk), with z up: the deeper ones first.
  std::array<std::array<int, 3>, 8> order_{
      {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  std::vector<std::vector<double>> levels_;  ///< depths on each pillar
  std::vector<std::int64_t> first_;          ///< point of each pillar's first
};

/// What became of each source cell: 0 kept, 1 refined, 2 replaced by transition and radial cells.
std::vector<std::uint8_t> fates(const Mesh& mesh, const std::vector<HostCellId>& cells) {
  std::vector<std::uint8_t> fate(
      static_cast<std::size_t>(mesh.source_dimensions[0] * mesh.source_dimensions[1] * mesh.source_dimensions[2]), 0);
  for (std::size_t s = 0; s < fate.size() && s + 1 < mesh.transfer.start.size(); ++s)
    for (auto n = mesh.transfer.start[s]; n < mesh.transfer.start[s + 1]; ++n) {
      const CellKind kind = mesh.cells.kind[mesh.transfer.cell[static_cast<std::size_t>(n)]];
      const std::uint8_t here = kind == CellKind::host ? 0 : kind == CellKind::refined ? 1 : 2;
      fate[s] = std::max(fate[s], here);
    }
  return mapped(cells, [&](HostCellId cell) { return fate[cell.index()]; });
}

template <class Values>
auto of_cells(const std::vector<HostCellId>& cells, const Values& values) {
  return mapped(cells, [&](HostCellId cell) { return values[cell.index()]; });
}

void write_cell_data(const Mesh& mesh, const CornerPointGrid& grid, const Corners& corners, Hdf5File& out) {
  const std::string group = "/VTKHDF/CellData/";
  const auto& cells = corners.cells;
  out.group("/VTKHDF/CellData");
  for (std::size_t axis = 0; axis < 3; ++axis)
    out.array(group + "IJK"[axis],
              mapped(cells, [&](HostCellId cell) { return static_cast<std::int32_t>(grid.ijk(cell)[axis] + 1); }));
  out.array(group + "source_cell", mapped(cells, [](HostCellId cell) { return std::int64_t{cell.value()}; }));
  out.array(group + "fate", fates(mesh, cells));
  if (!grid.porosity.empty()) out.array(group + "porosity", of_cells(cells, grid.porosity));
  if (!grid.net_to_gross.empty()) out.array(group + "net_to_gross", of_cells(cells, grid.net_to_gross));
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!grid.permeability[axis].empty())
      out.array(group + "permeability_" + "ijk"[axis], of_cells(cells, grid.permeability[axis]));
  for (const auto& [keyword, property] : grid.properties)
    std::visit([&, &key = keyword](const auto& values) { out.array(group + key, of_cells(cells, values)); }, property);
}

void write_grid(const Mesh& mesh, const CornerPointGrid& grid, Hdf5File& out) {
  const Corners corners(grid);
  const std::string group = "/VTKHDF";
  out.group(group);
  out.attribute(group, "Version", std::span<const std::int64_t>(std::array<std::int64_t, 2>{1, 0}));
  out.attribute(group, "Type", std::string("UnstructuredGrid"));
  const auto one = [&](const char* name, std::size_t count) {
    out.array(group + '/' + name, std::vector<std::int64_t>{static_cast<std::int64_t>(count)});
  };
  one("NumberOfPoints", corners.points.size());
  one("NumberOfCells", corners.cells.size());
  one("NumberOfConnectivityIds", corners.connectivity.size());
  std::vector<Vec3> points = corners.points;
  for (Vec3& point : points) point.z() = up(point.z());
  out.array(group + "/Points", points);
  out.array(group + "/Connectivity", corners.connectivity);
  std::vector<std::int64_t> offsets(corners.cells.size() + 1);
  for (std::size_t n = 0; n < offsets.size(); ++n) offsets[n] = static_cast<std::int64_t>(8 * n);
  out.array(group + "/Offsets", offsets);
  out.array(group + "/Types", std::vector<std::uint8_t>(corners.cells.size(), vtk_hexahedron));
  write_cell_data(mesh, grid, corners, out);
}

}  // namespace

std::vector<std::string> write_vtkhdf(const Mesh& mesh, const CornerPointGrid* source, const std::string& path,
                                      Overwrite overwrite) {
  require_source(mesh, source);
  const hdf5::Silence silence;
  OutputFile file(path, overwrite);
  Hdf5File out(file.temporary_path(), path);
  write_grid(mesh, *source, out);
  out.finish();
  file.commit();
  return {};
}

}  // namespace wellknit
