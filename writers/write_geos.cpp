// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/write_geos.h"

#include <fmt/format.h>

#include <cstdint>
#include <type_traits>
#include <utility>

#include "model/errors.h"
#include "writers/split_cells.h"
#include "writers/vtk_xml.h"

namespace wellknit {

namespace {

/// A value of the mesh's cell for each piece.
template <class Get>
auto of_pieces(const SplitCells& split, const Get& get) {
  return mapped(split.mesh_cell, get);
}

/// The region of each cell of the mesh.
std::vector<std::int32_t> regions(const Mesh& mesh, const std::string& keyword) {
  const auto found = mesh.cells.properties.find(keyword);
  if (found == mesh.cells.properties.end()) return std::vector<std::int32_t>(mesh.cells.size(), 1);
  const auto* const values = std::get_if<std::vector<std::int32_t>>(&found->second);
  if (values == nullptr)
    throw InvalidInput(fmt::format("region={}: a region is a whole number; choose an integer property", keyword));
  for (const std::int32_t value : *values)
    if (value < 0)
      throw InvalidInput(
          fmt::format("region={}: a region of GEOS is 0 or more, found {}; choose another property", keyword, value));
  return *values;
}

/// GEOS takes volume times porosity times net-to-gross for the pore volume: multipliers go into the porosity.
double porosity(const Mesh& mesh, CellId cell) {
  const double sand = mesh.cells.volume[cell] * mesh.cells.net_to_gross[cell];
  return sand > 0.0 ? mesh.cells.pore_volume[cell] / sand : mesh.cells.porosity[cell];
}

std::string cell_data(AppendedArrays& arrays, const Mesh& its_mesh, const SplitCells& its_split,
                      const std::vector<std::int32_t>& its_regions) {
  // Pointers: the arrays are made when this has returned.
  const Mesh* const mesh = &its_mesh;
  const SplitCells* const split = &its_split;
  const std::int32_t* const regions = its_regions.data();
  std::string xml;
  const auto made = [&xml, &arrays, split](std::string_view name, auto get, int components = 1) {
    const auto make = [split, get] {
      if constexpr (std::is_same_v<decltype(get(CellId())), Vec3>)
        return flat(of_pieces(*split, get));
      else
        return of_pieces(*split, get);
    };
    xml += arrays.made_element(name, split->mesh_cell.size(), make, components);
  };
  made("attribute", [regions](CellId c) { return regions[c.index()]; });
  made(
      "PERM", [mesh](CellId c) { return mesh->cells.permeability[c]; }, 3);
  made("PORO", [mesh](CellId c) { return porosity(*mesh, c); });
  made("NTG", [mesh](CellId c) { return mesh->cells.net_to_gross[c]; });
  made("cell", [](CellId c) { return std::int64_t{c.value()}; });
  made("kind", [mesh](CellId c) { return static_cast<std::uint8_t>(mesh->cells.kind[c]); });
  xml += arrays.element("volume", split->volume);
  for (const auto& [keyword, property] : mesh->cells.properties)
    std::visit([&made, &key = keyword](
                   const auto& values) { made(key, [data = values.data()](CellId c) { return data[c.index()]; }); },
               property);
  return xml;
}

std::string grid_xml(AppendedArrays& arrays, const Mesh& mesh, const SplitCells& split,
                     const std::vector<std::int32_t>& regions) {
  std::string xml =
      fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", split.points.size(), split.mesh_cell.size());
  xml += "<Points>\n" +
         arrays.made_element(
             "Points", split.points.size(), [points = &split.points] { return flat_points(*points); }, 3) +
         "</Points>\n<Cells>\n";
  xml += arrays.element("connectivity", split.cells.connectivity);
  xml += arrays.element("offsets", split.cells.offsets);
  xml += arrays.element("types", split.cells.types);
  xml += arrays.element("faces", split.cells.faces);
  xml += arrays.element("faceoffsets", split.cells.face_offsets);
  xml += "</Cells>\n<CellData Scalars=\"attribute\">\n" + cell_data(arrays, mesh, split, regions) +
         "</CellData>\n</Piece>\n";
  return xml;
}

std::vector<std::string> notes_of(const Mesh& mesh, const SplitCells& split) {
  if (split.cells_split == 0) return {};
  std::vector<std::string> notes{fmt::format(
      "for=geos: {} of {} cells are split into {} pyramids and tetrahedra, {} cells in all; the angle between a face's "
      "normal and the line of the cells' centroids goes from {:.1f} degrees on average, {:.1f} at most, to {:.1f} and "
      "{:.1f}: two-point fluxes are less exact there",
      split.cells_split, mesh.cells.size(), split.pieces, split.mesh_cell.size(), split.before.mean,
      split.before.largest, split.after.mean, split.after.largest)};
  if (split.pieces_inverted > 0)
    notes.push_back(fmt::format(
        "for=geos: {} pieces have no positive volume, since no point was found that sees all of its cell's faces; "
        "GEOS refuses them: mend the grid there, or leave the cells out",
        split.pieces_inverted));
  return notes;
}

}  // namespace

std::vector<std::string> write_geos(const Mesh& mesh, const std::string& path, const GeosOptions& options,
                                    Overwrite overwrite) {
  OutputStream out(path, overwrite);
  const std::vector<std::int32_t> region = regions(mesh, options.region);
  const SplitCells split = split_cells(mesh, options.most_sides);
  AppendedArrays arrays;
  const std::string grid = grid_xml(arrays, mesh, split, region);
  write_vtk_file(out, "UnstructuredGrid", grid, arrays);
  out.commit();
  return notes_of(mesh, split);
}

}  // namespace wellknit
