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
  std::vector<double> points;  ///< with z up
  std::vector<double> measured_depth;
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets;
  std::vector<std::string> name;
  std::vector<double> bore_radius;
  std::vector<double> drainage_radius;
  std::vector<std::uint8_t> injector;

  explicit Polylines(const Mesh& mesh) {
    for (const MeshWell& well : mesh.wells) {
      const Trajectory& path = well.trajectory;
      for (const double coordinate : flat_points(path.points)) points.push_back(coordinate);
      measured_depth.insert(measured_depth.end(), path.measured_depth.begin(), path.measured_depth.end());
      offsets.push_back(static_cast<std::int64_t>(measured_depth.size()));
      name.push_back(well.name);
      bore_radius.push_back(well.bore_radius);
      drainage_radius.push_back(well.drainage_radius);
      injector.push_back(well.type == WellType::injector ? 1 : 0);
    }
    for (std::size_t n = 0; n < measured_depth.size(); ++n) connectivity.push_back(static_cast<std::int64_t>(n));
  }
};

std::string wells_xml(AppendedArrays& arrays, const Polylines& lines) {
  std::string xml = fmt::format(
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"0\">\n",
      lines.measured_depth.size(), lines.offsets.size());
  xml += "<Points>\n" + arrays.element("Points", lines.points, 3) + "</Points>\n<Lines>\n";
  xml += arrays.element("connectivity", lines.connectivity);
  xml += arrays.element("offsets", lines.offsets);
  xml += "</Lines>\n<PointData>\n" + arrays.element("measured_depth", lines.measured_depth);
  xml += "</PointData>\n<CellData>\n" + string_element("name", lines.name);
  xml += arrays.element("bore_radius", lines.bore_radius);
  xml += arrays.element("drainage_radius", lines.drainage_radius);
  xml += arrays.element("injector", lines.injector);
  return xml + "</CellData>\n</Piece>\n";
}

}  // namespace

std::vector<std::string> write_vtp(const Mesh& mesh, const std::string& path, Overwrite overwrite) {
  OutputStream out(path, overwrite);
  const Polylines lines(mesh);
  AppendedArrays arrays;
  const std::string wells = wells_xml(arrays, lines);
  write_vtk_file(out, "PolyData", wells, arrays);
  out.commit();
  if (mesh.wells.size() == 0) return {"the mesh has no wells: the file has no lines"};
  return {};
}

}  // namespace wellknit
