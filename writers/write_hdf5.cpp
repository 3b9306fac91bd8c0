// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/write_hdf5.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>

#include "model/hdf5_layout.h"
#include "model/mesh_arrays.h"
#include "writers/hdf5_file.h"

namespace wellknit {

namespace {

/// A name that can be a link: '/' separates groups and "." is the group itself. The true name is kept as an attribute.
std::string link_name(const std::string& name, std::set<std::string>& taken) {
  std::string base = name;
  std::replace(base.begin(), base.end(), '/', '_');
  // Zero bytes pad the string in the file.
  std::replace(base.begin(), base.end(), '\0', '_');
  if (base.empty() || base == ".") base = "_";
  std::string link = base;
  for (int n = 2; !taken.insert(link).second; ++n) link = fmt::format("{}_{}", base, n);
  return link;
}

void write_root_attributes(Hdf5File& out, const Mesh& mesh, const Provenance& provenance) {
  out.attribute("/", "schema", std::string(hdf5::schema_name));
  out.attribute("/", "schema_version", std::string(hdf5::schema_version));
  out.attribute("/", "created_by", provenance.created_by);
  out.attribute("/", "command", provenance.command);
  out.attribute("/", "config", provenance.config);
  std::vector<std::string> sources;
  for (const SourceFile& source : provenance.sources) {
    sources.push_back(source.path);
    sources.push_back(source.sha256);
  }
  out.attribute("/", "sources", sources, 2);
  out.attribute("/", "source_dimensions", std::span<const std::int64_t>(mesh.source_dimensions));
  out.attribute("/", "source_units", std::string(name_of(mesh.source_units)));
  if (mesh.mapaxes) out.attribute("/", "mapaxes", std::span<const double>(*mesh.mapaxes));
}

void write_properties(Hdf5File& out, const Cells& cells) {
  out.group("cells/properties");
  std::set<std::string> taken;
  for (const auto& [keyword, property] : cells.properties) {
    const std::string path = "cells/properties/" + link_name(keyword, taken);
    std::visit([&](const auto& values) { out.array(path, values); }, property);
  }
}

void write_well(Hdf5File& out, const MeshWell& well, const std::string& group) {
  out.group(group);
  out.attribute(group, "name", well.name);
  out.attribute(group, "bore_radius", well.bore_radius);
  out.attribute(group, "drainage_radius", well.drainage_radius);
  out.attribute(group, "type", std::string(well.type == WellType::injector ? "injector" : "producer"));
  if (well.reference_depth) out.attribute(group, "reference_depth", *well.reference_depth);

  std::vector<std::array<double, 4>> stations;
  for (std::size_t i = 0; i < well.trajectory.points.size(); ++i) {
    const Vec3& p = well.trajectory.points[i];
    stations.push_back({well.trajectory.measured_depth[i], p.x(), p.y(), p.z()});
  }
  out.array(group + "/trajectory", stations);

  std::vector<CellId> cell;
  std::vector<double> well_index;
  std::vector<std::array<double, 2>> measured_depth;
  for (const WellConnection& connection : well.connections) {
    cell.push_back(connection.cell);
    well_index.push_back(connection.well_index);
    measured_depth.push_back({connection.measured_depth.from, connection.measured_depth.to});
  }
  out.group(group + "/connections");
  out.array(group + "/connections/cell", cell);
  out.array(group + "/connections/well_index", well_index);
  out.array(group + "/connections/md", measured_depth);
}

void write_wells(Hdf5File& out, const Mesh& mesh) {
  std::vector<std::string> order;
  std::set<std::string> taken;
  out.group("wells");
  for (const MeshWell& well : mesh.wells) {
    order.push_back(link_name(well.name, taken));
    write_well(out, well, "wells/" + order.back());
  }
  out.strings("wells_order", order);
}

}  // namespace

void write_hdf5(const Mesh& mesh, const Provenance& provenance, const std::string& path, Overwrite overwrite) {
  const hdf5::Silence silence;
  OutputFile file(path, overwrite);
  Hdf5File out(file.temporary_path(), path);
  write_root_attributes(out, mesh, provenance);
  for (const char* group : {"faces", "cells", "connections"}) out.group(group);
  const auto write_array = [&](const char* where, const auto& values) { out.array(where, values); };
  for_each_array(mesh, write_array);
  if (!mesh.connections.linear_flux_error.empty()) for_each_added_array(mesh, write_array);
  write_properties(out, mesh.cells);
  write_wells(out, mesh);
  if (!mesh.transfer.start.empty()) {
    out.group("transfer");
    for_each_transfer_array(mesh, write_array);
    if (!mesh.source_volumes.bulk.empty()) for_each_source_volume(mesh, write_array);
  }
  if (mesh.stencils) {
    out.group("stencils");
    for_each_stencil_array(*mesh.stencils, write_array);
  }
  if (mesh.flow) {
    out.group("flow");
    out.attribute("flow", "command", mesh.flow->command);
    for_each_flow_array(*mesh.flow, write_array);
  }
  out.finish();
  file.commit();
}

}  // namespace wellknit
