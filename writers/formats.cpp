// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/formats.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "writers/write_flow_deck.h"
#include "writers/write_hdf5.h"
#include "writers/write_openfoam.h"
#include "writers/write_vtu.h"

namespace wellknit {

namespace {

using Notes = std::vector<std::string>;

Notes hdf5(const Mesh& mesh, const Provenance& provenance, const std::string& path, Overwrite overwrite) {
  write_hdf5(mesh, provenance, path, overwrite);
  return {};
}

Notes vtu(const Mesh& mesh, const Provenance&, const std::string& path, Overwrite overwrite) {
  write_vtu(mesh, path, overwrite);
  return {};
}

Notes deck(const Mesh& mesh, const Provenance&, const std::string& path, Overwrite overwrite) {
  return write_flow_deck(mesh, path, {}, overwrite);
}

Notes openfoam(const Mesh& mesh, const Provenance&, const std::string& path, Overwrite overwrite) {
  return write_openfoam(mesh, path, overwrite);
}

constexpr std::array<std::string_view, 2> hdf5_extensions{".h5", ".hdf5"};
constexpr std::array<std::string_view, 1> vtu_extensions{".vtu"};
constexpr std::array<std::string_view, 1> deck_extensions{".data"};

constexpr std::array<std::string_view, 1> openfoam_extensions{".openfoam"};

constexpr std::array<WriterFormat, 4> table{{
    {"hdf5", hdf5_extensions, "the mesh file: everything, exact, SI", "hdf5.md", {}, hdf5},
    {"vtu",
     vtu_extensions,
     "ParaView and VTK: hexahedra and polyhedra with cell and quality arrays",
     "vtu.md",
     {},
     vtu},
    {"deck",
     deck_extensions,
     "OPM Flow: a complete deck on the connection list, wells on bottom-hole pressure",
     "deck.md",
     {},
     deck},
    {"openfoam", openfoam_extensions, "OpenFOAM: a folder with polyMesh, patches, zones, permeability and porosity",
     "openfoam.md", openfoam_contents, openfoam},
}};

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
