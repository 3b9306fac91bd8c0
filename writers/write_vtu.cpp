// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/write_vtu.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/mesh_topology.h"
#include "model/quality.h"
#include "writers/vtk_cells.h"
#include "writers/vtk_xml.h"

namespace wellknit {

namespace {

VtkCells vtk_cells(const Mesh& mesh) {
  const CellFaces faces = faces_of_cells(mesh);
  VtkCells out;
  out.connectivity.reserve(8 * mesh.cells.size());
  out.offsets.reserve(mesh.cells.size());
  out.types.reserve(mesh.cells.size());
  out.face_offsets.reserve(mesh.cells.size());
  CellSurface surface;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    surface.assign(mesh, faces.of(CellId(c)));
    const bool host = mesh.cells.kind[CellId(c)] < CellKind::transition;
    const auto hexahedron = host ? surface.hexahedron() : std::nullopt;
    if (hexahedron) {
      std::array<std::int64_t, 8> points;
      std::transform(hexahedron->begin(), hexahedron->end(), points.begin(), [](VertexId v) { return v.value(); });
      out.add(vtk_hexahedron, points);
    } else {
      out.add_polyhedron(surface);
    }
  }
  return out;
}

std::string cell_data(AppendedArrays& arrays, const Mesh& mesh, const CellQuality& quality) {
  const Cells* const cells = &mesh.cells;
  const std::size_t count = cells->size();
  std::string xml;
  const auto made = [&](std::string_view name, auto make, int components = 1) {
    xml += arrays.made_element(name, count, make, components);
  };
  made("kind",
       [cells] { return mapped(cells->kind.raw(), [](CellKind kind) { return static_cast<std::uint8_t>(kind); }); });
  made(
      "center", [cells] { return flat_points(cells->center.raw()); }, 3);
  xml += arrays.element("volume", cells->volume.raw());
  xml += arrays.element("depth", cells->depth.raw());
  made("source_cell", [cells] {
    return mapped(cells->source_cell.raw(), [](HostCellId cell) { return std::int64_t{cell.value()}; });
  });
  made("well", [cells] {
    return mapped(cells->well.raw(), [](WellId well) { return static_cast<std::int32_t>(well.value()); });
  });
  made("radial_segment",
       [cells] { return mapped(cells->radial_index.raw(), [](const RadialIndex& at) { return at.segment; }); });
  made("radial_sector",
       [cells] { return mapped(cells->radial_index.raw(), [](const RadialIndex& at) { return at.sector; }); });
  made("radial_ring",
       [cells] { return mapped(cells->radial_index.raw(), [](const RadialIndex& at) { return at.ring; }); });
  xml += arrays.element("pore_volume", cells->pore_volume.raw());
  xml += arrays.element("porosity", cells->porosity.raw());
  xml += arrays.element("net_to_gross", cells->net_to_gross.raw());
  made(
      "permeability", [cells] { return flat(cells->permeability.raw()); }, 3);

  xml += arrays.element("max_non_orthogonality", quality.max_non_orthogonality.raw());
  xml += arrays.element("max_k_non_orthogonality", quality.max_k_non_orthogonality.raw());
  xml += arrays.element("max_planarity", quality.max_planarity.raw());
  xml += arrays.element("min_transmissibility", quality.min_transmissibility.raw());
  xml += arrays.element("centring", quality.centring.raw());
  if (mesh.flow) xml += arrays.element("pressure", mesh.flow->pressure.raw());
  for (const auto& [keyword, property] : cells->properties)
    xml += std::visit([&, &key = keyword](const auto& values) { return arrays.element(key, values); }, property);
  return xml;
}

std::string grid_xml(AppendedArrays& arrays, const Mesh& mesh, const VtkCells& cells, const CellQuality& quality) {
  std::string xml =
      fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", mesh.vertices.size(), mesh.cells.size());
  xml += "<Points>\n" +
         arrays.made_element(
             "Points", mesh.vertices.size(), [points = &mesh.vertices.raw()] { return flat_points(*points); }, 3) +
         "</Points>\n<Cells>\n";
  xml += arrays.element("connectivity", cells.connectivity);
  xml += arrays.element("offsets", cells.offsets);
  xml += arrays.element("types", cells.types);
  xml += arrays.element("faces", cells.faces);
  xml += arrays.element("faceoffsets", cells.face_offsets);
  xml += "</Cells>\n<CellData Scalars=\"kind\">\n" + cell_data(arrays, mesh, quality) + "</CellData>\n</Piece>\n";
  return xml;
}

}  // namespace

void write_vtu(const Mesh& mesh, const std::string& path, Overwrite overwrite) {
  OutputStream out(path, overwrite);
  const CellQuality quality = cell_quality_without_skewness(mesh);
  const VtkCells cells = vtk_cells(mesh);
  AppendedArrays arrays;
  const std::string grid = grid_xml(arrays, mesh, cells, quality);
  write_vtk_file(out, "UnstructuredGrid", grid, arrays);
  out.commit();
}

}  // namespace wellknit
