// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/write_hdf5.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>

#include "model/errors.h"
#include "model/hdf5_layout.h"
#include "model/mesh_arrays.h"

namespace wellknit {

namespace {

using hdf5::Handle;

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

/// Strings side by side, each padded with zero bytes to the longest: HDF5's fixed-length strings.
struct PaddedStrings {
  explicit PaddedStrings(std::span<const std::string> values) {
    for (const std::string& value : values) length = std::max(length, value.size());
    for (const std::string& value : values) {
      bytes += value;
      bytes.append(length - value.size(), '\0');
    }
  }
  std::size_t length = 1;  ///< HDF5 has no strings of length 0
  std::string bytes;
};

/// A file under construction. Every call that fails throws WriteError.
class MeshFileWriter {
 public:
  MeshFileWriter(const std::string& file, std::string target)
      : target_(std::move(target)),
        group_properties_(H5Pcreate(H5P_GROUP_CREATE), H5Pclose),
        dataset_properties_(H5Pcreate(H5P_DATASET_CREATE), H5Pclose),
        file_(create(file)) {
    // No times: the same mesh gives the same bytes.
    need(H5Pset_obj_track_times(group_properties_.get(), false), "groups");
    need(H5Pset_obj_track_times(dataset_properties_.get(), false), "datasets");
    need(H5Pset_layout(dataset_properties_.get(), H5D_CONTIGUOUS), "datasets");
  }

  void group(const std::string& path) {
    const Handle made(H5Gcreate2(file_.get(), path.c_str(), H5P_DEFAULT, group_properties_.get(), H5P_DEFAULT),
                      H5Gclose);
    need(made.get(), path);
  }

  template <class Array>
  void array(const std::string& path, const Array& values) {
    const hdf5::Element layout = hdf5::element(values.data());
    const std::array<hsize_t, 2> shape{values.size(), layout.columns};
    const Handle set = dataset(path, layout.file_type, std::span(shape).first(layout.columns == 1 ? 1 : 2));
    if (!values.empty())
      need(H5Dwrite(set.get(), layout.memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path);
  }

  void strings(const std::string& path, const std::vector<std::string>& values) {
    const PaddedStrings padded(values);
    const Handle type = hdf5::string_type(padded.length);
    const std::array<hsize_t, 1> shape{values.size()};
    const Handle set = dataset(path, type.get(), shape);
    if (!values.empty())
      need(H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.bytes.data()), path);
  }

  void attribute(const std::string& object, const std::string& name, const std::string& value) {
    const PaddedStrings padded(std::span(&value, 1));
    const Handle type = hdf5::string_type(padded.length);
    attribute_data(object, name, type.get(), type.get(), {}, padded.bytes.data());
  }
  void attribute(const std::string& object, const std::string& name, double value) {
    attribute_data(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {}, &value);
  }
  void attribute(const std::string& object, const std::string& name, std::span<const double> values) {
    const std::array<hsize_t, 1> shape{values.size()};
    attribute_data(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, shape, values.data());
  }
  void attribute(const std::string& object, const std::string& name, std::span<const std::int64_t> values) {
    const std::array<hsize_t, 1> shape{values.size()};
    attribute_data(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, shape, values.data());
  }
  /// Rows of `columns` strings.
  void attribute(const std::string& object, const std::string& name, const std::vector<std::string>& values,
                 hsize_t columns) {
    const PaddedStrings padded(values);
    const Handle type = hdf5::string_type(padded.length);
    const std::array<hsize_t, 2> shape{values.size() / columns, columns};
    attribute_data(object, name, type.get(), type.get(), shape, padded.bytes.data());
  }

  void finish() {
    if (!file_.close()) fail("the end of the file");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw WriteError(fmt::format("{}: cannot be written: HDF5 failed at {}; is the disk full?", target_, what));
  }
  void need(hid_t status, const std::string& what) const {
    if (status < 0) fail(what);
  }

  [[nodiscard]] Handle create(const std::string& file) const {
    const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    need(H5Pset_obj_track_times(creation.get(), false), "the root group");
    // Fixed bounds: a newer library must not choose a newer layout. That of 1.8, of 2008, is the oldest with checksums.
    need(H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18), "the version bounds");
    Handle made(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
    need(made.get(), "its creation");
    return made;
  }

  [[nodiscard]] Handle dataset(const std::string& path, hid_t type, std::span<const hsize_t> shape) const {
    const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
    Handle set(
        H5Dcreate2(file_.get(), path.c_str(), type, space.get(), H5P_DEFAULT, dataset_properties_.get(), H5P_DEFAULT),
        H5Dclose);
    need(set.get(), path);
    return set;
  }

  /// An empty shape makes a scalar.
  void attribute_data(const std::string& object, const std::string& name, hid_t file_type, hid_t memory_type,
                      std::span<const hsize_t> shape, const void* data) const {
    const Handle space(
        shape.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
        H5Sclose);
    const Handle made(H5Acreate_by_name(file_.get(), object.c_str(), name.c_str(), file_type, space.get(), H5P_DEFAULT,
                                        H5P_DEFAULT, H5P_DEFAULT),
                      H5Aclose);
    need(made.get(), name);
    if (H5Sget_simple_extent_npoints(space.get()) > 0) need(H5Awrite(made.get(), memory_type, data), name);
  }

  std::string target_;
  Handle group_properties_;
  Handle dataset_properties_;
  Handle file_;
};

void write_root_attributes(MeshFileWriter& out, const Mesh& mesh, const Provenance& provenance) {
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

void write_properties(MeshFileWriter& out, const Cells& cells) {
  out.group("cells/properties");
  std::set<std::string> taken;
  for (const auto& [keyword, property] : cells.properties) {
    const std::string path = "cells/properties/" + link_name(keyword, taken);
    std::visit([&](const auto& values) { out.array(path, values); }, property);
  }
}

void write_well(MeshFileWriter& out, const MeshWell& well, const std::string& group) {
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

void write_wells(MeshFileWriter& out, const Mesh& mesh) {
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
  MeshFileWriter out(file.temporary_path(), path);
  write_root_attributes(out, mesh, provenance);
  for (const char* group : {"faces", "cells", "connections"}) out.group(group);
  const auto write_array = [&](const char* where, const auto& values) { out.array(where, values); };
  for_each_array(mesh, write_array);
  write_properties(out, mesh.cells);
  write_wells(out, mesh);
  if (!mesh.transfer.start.empty()) {
    out.group("transfer");
    for_each_transfer_array(mesh, write_array);
  }
  out.finish();
  file.commit();
}

}  // namespace wellknit
