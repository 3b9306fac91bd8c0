// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/hdf5_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "model/errors.h"

namespace wellknit {

using hdf5::Handle;

namespace {

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

}  // namespace

Hdf5File::Hdf5File(const std::string& file, std::string shown_path)
    : target_(std::move(shown_path)),
      group_properties_(H5Pcreate(H5P_GROUP_CREATE), H5Pclose),
      dataset_properties_(H5Pcreate(H5P_DATASET_CREATE), H5Pclose),
      file_(create(file)) {
  // No times: the same mesh gives the same bytes.
  need(H5Pset_obj_track_times(group_properties_.get(), false), "groups");
  need(H5Pset_obj_track_times(dataset_properties_.get(), false), "datasets");
  need(H5Pset_layout(dataset_properties_.get(), H5D_CONTIGUOUS), "datasets");
}

void Hdf5File::group(const std::string& path) {
  const Handle made(H5Gcreate2(file_.get(), path.c_str(), H5P_DEFAULT, group_properties_.get(), H5P_DEFAULT), H5Gclose);
  need(made.get(), path);
}

void Hdf5File::strings(const std::string& path, const std::vector<std::string>& values) {
  const PaddedStrings padded(values);
  const Handle type = hdf5::string_type(padded.length);
  const std::array<hsize_t, 1> shape{values.size()};
  const Handle set = dataset(path, type.get(), shape);
  if (!values.empty()) need(H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.bytes.data()), path);
}

void Hdf5File::attribute(const std::string& object, const std::string& name, const std::string& value) {
  const PaddedStrings padded(std::span(&value, 1));
  const Handle type = hdf5::string_type(padded.length);
  attribute_data(object, name, type.get(), type.get(), {}, padded.bytes.data());
}

void Hdf5File::attribute(const std::string& object, const std::string& name, double value) {
  attribute_data(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {}, &value);
}

void Hdf5File::attribute(const std::string& object, const std::string& name, std::span<const double> values) {
  const std::array<hsize_t, 1> shape{values.size()};
  attribute_data(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, shape, values.data());
}

void Hdf5File::attribute(const std::string& object, const std::string& name, std::span<const std::int64_t> values) {
  const std::array<hsize_t, 1> shape{values.size()};
  attribute_data(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, shape, values.data());
}

void Hdf5File::attribute(const std::string& object, const std::string& name, const std::vector<std::string>& values,
                         hsize_t columns) {
  const PaddedStrings padded(values);
  const Handle type = hdf5::string_type(padded.length);
  const std::array<hsize_t, 2> shape{values.size() / columns, columns};
  attribute_data(object, name, type.get(), type.get(), shape, padded.bytes.data());
}

void Hdf5File::finish() {
  if (!file_.close()) fail("the end of the file");
}

void Hdf5File::fail(const std::string& what) const {
  throw WriteError(fmt::format("{}: cannot be written: HDF5 failed at {}; is the disk full?", target_, what));
}

void Hdf5File::need(hid_t status, const std::string& what) const {
  if (status < 0) fail(what);
}

Handle Hdf5File::create(const std::string& file) const {
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  need(H5Pset_obj_track_times(creation.get(), false), "the root group");
  // Fixed bounds: a newer library must not choose a newer layout. That of 1.8, of 2008, is the oldest with checksums.
  need(H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18), "the version bounds");
  Handle made(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
  need(made.get(), "its creation");
  return made;
}

Handle Hdf5File::dataset(const std::string& path, hid_t type, std::span<const hsize_t> shape) const {
  const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
  Handle set(
      H5Dcreate2(file_.get(), path.c_str(), type, space.get(), H5P_DEFAULT, dataset_properties_.get(), H5P_DEFAULT),
      H5Dclose);
  need(set.get(), path);
  return set;
}

void Hdf5File::attribute_data(const std::string& object, const std::string& name, hid_t file_type, hid_t memory_type,
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

void Hdf5File::array_data(const std::string& path, const hdf5::Element& layout, std::span<const hsize_t> shape,
                          const void* data) const {
  const Handle set = dataset(path, layout.file_type, shape);
  if (data != nullptr) need(H5Dwrite(set.get(), layout.memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), path);
}

}  // namespace wellknit
