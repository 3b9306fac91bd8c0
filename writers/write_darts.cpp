// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/write_darts.h"

#include <fmt/format.h>

#include "model/units.h"
#include "writers/centre_line.h"
#include "writers/hdf5_file.h"
#include "writers/npz_file.h"
#include "writers/text_file.h"
#include "writers/well_cells.h"

namespace wellknit {

namespace {

using Indices = std::vector<std::int32_t>;
using Numbers = std::vector<double>;

/// m3 to the simulator's unit.
double in_simulator_unit(double transmissibility) {
  return transmissibility / m2_per_millidarcy * darts_transmissibility_per_md_m;
}

Indices side_of_connections(const Mesh& mesh, std::size_t side) {
  Indices out;
  out.reserve(mesh.connections.size());
  for (const auto& pair : mesh.connections.cells) out.push_back(static_cast<std::int32_t>(pair[side].value()));
  return out;
}

Numbers transmissibilities(const Mesh& mesh) {
  Numbers out;
  out.reserve(mesh.connections.size());
  for (const double value : mesh.connections.transmissibility) out.push_back(in_simulator_unit(value));
  return out;
}

Numbers geometric_factors(const Mesh& mesh) {
  Numbers out;
  out.reserve(mesh.connections.size());
  for (std::size_t n = 0; n < mesh.connections.size(); ++n) out.push_back(geometric_factor(mesh, ConnectionId(n)));
  return out;
}

/// The simulator's pore volume is porosity times volume: net-to-gross and multipliers are inside.
double porosity(const Mesh& mesh, std::size_t cell) {
  return mesh.cells.pore_volume[CellId(cell)] / mesh.cells.volume[CellId(cell)];
}

template <class Get>
Numbers of_cells(const Mesh& mesh, const Get& get) {
  Numbers out(mesh.cells.size());
  for (std::size_t c = 0; c < out.size(); ++c) out[c] = get(c);
  return out;
}

/// Wells as ragged lists.
struct WellArrays {
  std::vector<std::string> names;
  Indices start{0};
  Indices cell;
  Indices is_injector;
  Numbers index;  ///< in the simulator's unit
  Numbers reference_depth;

  explicit WellArrays(const Mesh& mesh) {
    for (const MeshWell& well : mesh.wells) {
      for (const WellConnection& connection : cells_of_well(well)) {
        cell.push_back(static_cast<std::int32_t>(connection.cell.value()));
        index.push_back(in_simulator_unit(connection.well_index));
      }
      names.push_back(well.name);
      start.push_back(static_cast<std::int32_t>(cell.size()));
      is_injector.push_back(well.type == WellType::injector ? 1 : 0);
      reference_depth.push_back(reference_depth_of(mesh, well));
    }
  }
};

/// All arrays, each made when it is its turn. File has array(name, values) and strings(name, values).
template <class File>
void write_arrays(const Mesh& mesh, File& out) {
  const auto numbers = [&](const char* name, const Numbers& values) { out.array(name, values); };
  const auto indices = [&](const char* name, const Indices& values) { out.array(name, values); };
  indices("block_m", side_of_connections(mesh, 0));
  indices("block_p", side_of_connections(mesh, 1));
  numbers("tran", transmissibilities(mesh));
  numbers("tranD", geometric_factors(mesh));
  numbers("volume", of_cells(mesh, [&](std::size_t c) { return mesh.cells.volume[CellId(c)]; }));
  numbers("depth", of_cells(mesh, [&](std::size_t c) { return mesh.cells.depth[CellId(c)]; }));
  numbers("poro", of_cells(mesh, [&](std::size_t c) { return porosity(mesh, c); }));
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const std::array<const char*, 3> names{"kx", "ky", "kz"};
    numbers(names[static_cast<std::size_t>(axis)], of_cells(mesh, [&](std::size_t c) {
              return mesh.cells.permeability[CellId(c)][axis] / m2_per_millidarcy;
            }));
  }
  if (mesh.stencils) {
    const FluxStencils& s = *mesh.stencils;
    indices("mpfa_offset", Indices(s.start.begin(), s.start.end()));
    Indices cells;
    Numbers coefficients;
    for (const CellId cell : s.cells) cells.push_back(static_cast<std::int32_t>(cell.value()));
    for (const double value : s.coefficients) coefficients.push_back(in_simulator_unit(value));
    indices("mpfa_stencil", cells);
    numbers("mpfa_tran", coefficients);
  }
  out.array("centers", std::vector<Vec3>(mesh.cells.center.begin(), mesh.cells.center.end()));
  const WellArrays wells(mesh);
  out.strings("well_name", wells.names);
  indices("well_start", wells.start);
  indices("well_cell", wells.cell);
  numbers("well_index", wells.index);
  indices("well_is_injector", wells.is_injector);
  numbers("well_reference_depth", wells.reference_depth);
}

/// open-DARTS takes the number of cells from the connections.
std::vector<std::string> notes_of(const Mesh& mesh) {
  std::vector<bool> is_connected(mesh.cells.size(), false);
  for (const auto& [a, b] : mesh.connections.cells) is_connected[a.index()] = is_connected[b.index()] = true;
  if (is_connected.empty() || is_connected.back()) return {};
  return {"the last cell has no connection; open-DARTS, which counts cells by connections, will not see it"};
}

class AdgprsFolder {
 public:
  AdgprsFolder(const Mesh& mesh, std::string folder, std::string shown_path)
      : mesh_(mesh), folder_(std::move(folder)), shown_path_(std::move(shown_path)) {}

  void write() const {
    TextFile dimensions = file("dimens.txt");
    dimensions.print("DIMENS\n{} 1 1\n/\n", mesh_.cells.size());
    dimensions.close();
    connections();
    const auto& cells = mesh_.cells;
    array("volume.txt", "VOLUME", [&](std::size_t c) { return cells.volume[CellId(c)]; });
    array("poro.txt", "PORO", [&](std::size_t c) { return porosity(mesh_, c); });
    array("depth.txt", "DEPTH", [&](std::size_t c) { return cells.depth[CellId(c)]; });
    const auto millidarcy = [&](Eigen::Index axis) {
      return [&cells, axis](std::size_t c) { return cells.permeability[CellId(c)][axis] / m2_per_millidarcy; };
    };
    array("permx.txt", "PERMX", millidarcy(0));
    array("permy.txt", "PERMY", millidarcy(1));
    array("permz.txt", "PERMZ", millidarcy(2));
    TextFile wells = file("wells.csv");
    write_well_table(wells, mesh_, 0);
    wells.close();
  }

 private:
  [[nodiscard]] TextFile file(const std::string& name) const { return {folder_ + "/" + name, shown_path_}; }

  void connections() const {
    TextFile out = file("connections.txt");
    out.print("TPFACONNSN\n{}\n", mesh_.connections.size());
    for (std::size_t n = 0; n < mesh_.connections.size(); ++n) {
      const auto& [a, b] = mesh_.connections.cells[ConnectionId(n)];
      out.integer(a.value());
      out.text(" ");
      out.integer(b.value());
      out.text(" ");
      out.numbers({in_simulator_unit(mesh_.connections.transmissibility[ConnectionId(n)]),
                   geometric_factor(mesh_, ConnectionId(n))});
      out.end_line();
    }
    out.text("/\n");
    out.close();
  }

  template <class Get>
  void array(const std::string& name, std::string_view keyword, const Get& get) const {
    TextFile out = file(name);
    out.text(keyword);
    out.end_line();
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      out.number(get(c));
      out.end_line();
    }
    out.text("/\n");
    out.close();
  }

  const Mesh& mesh_;
  std::string folder_;
  std::string shown_path_;
};

}  // namespace

std::vector<std::string> write_darts(const Mesh& mesh, const std::string& path, Overwrite overwrite) {
  OutputFile file(path, overwrite);
  NpzFile out(file.temporary_path(), path);
  write_arrays(mesh, out);
  out.close();
  file.commit();
  return notes_of(mesh);
}

std::vector<std::string> write_darts_hdf5(const Mesh& mesh, const std::string& path, Overwrite overwrite) {
  const hdf5::Silence silence;
  OutputFile file(path, overwrite);
  Hdf5File out(file.temporary_path(), path);
  write_arrays(mesh, out);
  out.finish();
  file.commit();
  return notes_of(mesh);
}

std::vector<std::string> write_adgprs(const Mesh& mesh, const std::string& path, Overwrite overwrite) {
  OutputFile folder(path, overwrite, adgprs_contents);
  AdgprsFolder(mesh, folder.temporary_path(), path).write();
  folder.commit();
  return {};
}

}  // namespace wellknit
