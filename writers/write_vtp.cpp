// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/write_vtp.h"

#include <fmt/format.h>

#include <cstdint>

#include "writers/vtk_xml.h"

namespace wellknit {

namespace {

/// Strings as VTK's text form has them: the codes of the characters, each string ended by a zero.
std::string string_element(std::string_view name, const std::vector<std::string>& values) {
  std::string xml = fmt::format("<DataArray type=\"String\" Name=\"{}\" format=\"ascii\">\n", name);
  for (const std::string& value : values) {
    for (const char c : value) xml += fmt::format("{} ", static_cast<int>(static_cast<unsigned char>(c)));
    xml += "0\n";
  }
  return xml + "</DataArray>\n";
}

struct Polylines {
  std::vector<Vec3> points;
  std::vector<double> measured_depth;
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets;

  explicit Polylines(const Mesh& mesh) {
    for (const MeshWell& well : mesh.wells) {
      const Trajectory& path = well.trajectory;
      points.insert(points.end(), path.points.begin(), path.points.end());
      measured_depth.insert(measured_depth.end(), path.measured_depth.begin(), path.measured_depth.end());
      offsets.push_back(static_cast<std::int64_t>(points.size()));
    }
    for (std::size_t n = 0; n < points.size(); ++n) connectivity.push_back(static_cast<std::int64_t>(n));
  }
};

/// VTK reads the four kinds of cells of a polygonal data set in this order.
std::string cells_element(AppendedArrays& arrays, std::string_view kind, const std::vector<std::int64_t>& connectivity,
                          const std::vector<std::int64_t>& offsets) {
  std::string xml = fmt::format("<{}>\n", kind);
  xml += arrays.element("connectivity", connectivity);
  xml += arrays.element("offsets", offsets);
  return xml + fmt::format("</{}>\n", kind);
}

std::string wells_xml(AppendedArrays& arrays, const Mesh& mesh) {
  const Polylines lines(mesh);
  std::string xml = fmt::format(
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"0\">\n",
      lines.points.size(), lines.offsets.size());
  xml += "<Points>\n" + arrays.element("Points", flat_points(lines.points), 3) + "</Points>\n";
  xml += cells_element(arrays, "Lines", lines.connectivity, lines.offsets);
  xml += "<PointData>\n" + arrays.element("measured_depth", lines.measured_depth) + "</PointData>\n<CellData>\n";
  const auto& wells = mesh.wells.raw();
  xml += string_element("name", mapped(wells, [](const MeshWell& w) { return w.name; }));
  xml += arrays.element("bore_radius", mapped(wells, [](const MeshWell& w) { return w.bore_radius; }));
  xml += arrays.element("drainage_radius", mapped(wells, [](const MeshWell& w) { return w.drainage_radius; }));
  xml += arrays.element("injector",
                        mapped(wells, [](const MeshWell& w) { return std::uint8_t{w.type == WellType::injector}; }));
  return xml + "</CellData>\n</Piece>\n";
}

}  // namespace

std::vector<std::string> write_vtp(const Mesh& mesh, const std::string& path, Overwrite overwrite) {
  OutputStream out(path, overwrite);
  AppendedArrays arrays;
  const std::string wells = wells_xml(arrays, mesh);
  write_vtk_file(out, "PolyData", wells, arrays);
  out.commit();
  if (mesh.wells.size() == 0) return {"the mesh has no wells: the file has no lines"};
  return {};
}

}  // namespace wellknit
