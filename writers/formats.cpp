// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/formats.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "writers/write_csv.h"
#include "writers/write_darts.h"
#include "writers/write_dgf.h"
#include "writers/write_fehm.h"
#include "writers/write_flow_deck.h"
#include "writers/write_geos.h"
#include "writers/write_hdf5.h"
#include "writers/write_mrst.h"
#include "writers/write_openfoam.h"
#include "writers/write_opm_grid.h"
#include "writers/write_pflotran.h"
#include "writers/write_tough.h"
#include "writers/write_vtkhdf.h"
#include "writers/write_vtp.h"
#include "writers/write_vtu.h"

namespace wellknit {

namespace {

using Notes = std::vector<std::string>;

Notes hdf5(const WriteRequest& r) {
  write_hdf5(r.mesh, r.provenance, r.path, r.overwrite);
  return {};
}

Notes vtu(const WriteRequest& r) {
  if (r.options.vtu_reader == VtuReader::geos) return write_geos(r.mesh, r.path, r.options.geos, r.overwrite);
  write_vtu(r.mesh, r.path, r.overwrite);
  return {};
}

Notes vtkhdf(const WriteRequest& r) { return write_vtkhdf(r.mesh, r.source, r.path, r.overwrite); }

Notes vtp(const WriteRequest& r) { return write_vtp(r.mesh, r.path, r.overwrite); }

Notes deck(const WriteRequest& r) {
  const Notes notes = write_flow_deck(r.mesh, r.path, r.options.deck, r.overwrite, r.source);
  const auto paths = r.side_paths.empty() ? flow_deck_side_files(r.path, r.options.deck) : r.side_paths;
  write_flow_deck_side_files(r.mesh, paths, r.options.deck, r.overwrite, r.source);
  return notes;
}

std::vector<std::string> deck_side_files(const std::string& path, const WriterOptions& options) {
  return flow_deck_side_files(path, options.deck);
}

Notes openfoam(const WriteRequest& r) { return write_openfoam(r.mesh, r.path, r.overwrite); }

Notes opm_grid(const WriteRequest& r) { return write_opm_grid(r.mesh, r.path, r.options.opm_grid, r.overwrite); }

Notes mrst(const WriteRequest& r) { return write_mrst(r.mesh, r.path, r.options.mrst, r.overwrite); }

Notes pflotran(const WriteRequest& r) { return write_pflotran(r.mesh, r.path, r.options.pflotran, r.overwrite); }

Notes pflotran_h5(const WriteRequest& r) {
  return write_pflotran(r.mesh, r.path, {PflotranGrid::hdf5, r.options.pflotran.areas}, r.overwrite);
}

Notes tough(const WriteRequest& r) { return write_tough(r.mesh, r.path, r.options.tough, r.overwrite); }

Notes darts(const WriteRequest& r) { return write_darts(r.mesh, r.path, r.overwrite); }

Notes darts_h5(const WriteRequest& r) { return write_darts_hdf5(r.mesh, r.path, r.overwrite); }

Notes adgprs(const WriteRequest& r) { return write_adgprs(r.mesh, r.path, r.overwrite); }

Notes csv(const WriteRequest& r) { return write_csv(r.mesh, r.path, r.overwrite); }

Notes fehm(const WriteRequest& r) { return write_fehm(r.mesh, r.path, r.options.fehm, r.overwrite); }

Notes dgf(const WriteRequest& r) { return write_dgf(r.mesh, r.path, r.overwrite); }

constexpr std::array<std::string_view, 2> hdf5_extensions{".h5", ".hdf5"};
constexpr std::array<std::string_view, 1> vtu_extensions{".vtu"};
constexpr std::array<std::string_view, 1> vtkhdf_extensions{".vtkhdf"};
constexpr std::array<std::string_view, 1> vtp_extensions{".vtp"};
constexpr std::array<std::string_view, 1> deck_extensions{".data"};
constexpr std::array<std::string_view, 1> openfoam_extensions{".openfoam"};
constexpr std::array<std::string_view, 1> opm_grid_extensions{".opmgrid"};
constexpr std::array<std::string_view, 1> mrst_extensions{".mat"};
constexpr std::array<std::string_view, 1> pflotran_extensions{".pflotran"};
constexpr std::array<std::string_view, 1> pflotran_h5_extensions{".pflotran_h5"};
constexpr std::array<std::string_view, 1> tough_extensions{".tough"};
constexpr std::array<std::string_view, 1> darts_extensions{".npz"};
constexpr std::array<std::string_view, 1> darts_h5_extensions{".darts_h5"};
constexpr std::array<std::string_view, 1> adgprs_extensions{".adgprs"};
constexpr std::array<std::string_view, 1> csv_extensions{".tables"};
constexpr std::array<std::string_view, 1> fehm_extensions{".fehm"};
constexpr std::array<std::string_view, 1> dgf_extensions{".dgf"};

constexpr auto table = std::to_array<WriterFormat>({
    {"hdf5", hdf5_extensions, "the mesh file: everything, exact, SI", "hdf5.md", {}, hdf5},
    {"vtu",
     vtu_extensions,
     "ParaView, VTK and GEOS: hexahedra and polyhedra with cell and quality arrays",
     "vtu.md",
     {},
     vtu},
    {"vtkhdf",
     vtkhdf_extensions,
     "ParaView and VTK: the source grid's active cells as hexahedra",
     "vtkhdf.md",
     {},
     vtkhdf},
    {"vtp", vtp_extensions, "ParaView, VTK and GEOS: the wells' trajectories as polylines", "vtp.md", {}, vtp},
    {"deck",
     deck_extensions,
     "OPM Flow: a complete deck on the connection list, wells on bottom-hole pressure",
     "deck.md",
     {},
     deck,
     deck_side_files},
    {"openfoam", openfoam_extensions, "OpenFOAM: a folder with polyMesh, patches, zones, permeability and porosity",
     "openfoam.md", openfoam_contents, openfoam},
    {"opm_grid",
     opm_grid_extensions,
     "OPM's UnstructuredGrid as text, for its read_grid()",
     "opm_grid.md",
     {},
     opm_grid},
    {"mrst", mrst_extensions, "MRST and JutulDarcy: a MATLAB file with G, rock, T, N and W", "mrst.md", {}, mrst},
    {"pflotran", pflotran_extensions,
     "PFLOTRAN: a folder with the explicit grid as text, regions, properties and wells", "pflotran.md",
     pflotran_contents, pflotran},
    {"pflotran_h5", pflotran_h5_extensions, "PFLOTRAN: the same with the grid as HDF5", "pflotran.md",
     pflotran_contents, pflotran_h5},
    {"tough", tough_extensions, "TOUGH2, TOUGH3, iTOUGH2: a folder with MESH, ROCKS and wells", "tough.md",
     tough_contents, tough},
    {"darts",
     darts_extensions,
     "open-DARTS: arrays of numpy, with the loader wellknit_darts.py",
     "darts.md",
     {},
     darts},
    {"darts_h5", darts_h5_extensions, "open-DARTS: the same arrays as HDF5", "darts.md", {}, darts_h5},
    {"adgprs", adgprs_extensions, "AD-GPRS: a folder of keyword files with the connection list", "darts.md",
     adgprs_contents, adgprs},
    {"csv", csv_extensions, "a folder with tables of cells, connections and wells", "csv.md", csv_contents, csv},
    {"fehm", fehm_extensions, "FEHM: a folder with .stor, coordinates, perm and rock macros", "fehm.md", fehm_contents,
     fehm},
    {"dgf", dgf_extensions, "Dune grid format: polyhedra, for opm-grid's PolyhedralGrid", "dgf.md", {}, dgf},
});

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](char c) { return lower(c); });
  return out;
}

}  // namespace

std::span<const WriterFormat> writer_formats() { return table; }

const WriterFormat* find_writer(std::string_view name) {
  const std::string wanted = lower(name);
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const WriterFormat& format) { return format.name == wanted; });
  return found == table.end() ? nullptr : &*found;
}

const WriterFormat* writer_of_path(const std::string& path) {
  const std::string extension = lower(std::filesystem::path(path).extension().string());
  const auto has_it = [&](const WriterFormat& format) {
    return std::find(format.extensions.begin(), format.extensions.end(), extension) != format.extensions.end();
  };
  const auto found = std::find_if(table.begin(), table.end(), has_it);
  return found == table.end() ? nullptr : &*found;
}

}  // namespace wellknit
