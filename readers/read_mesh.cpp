// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/read_mesh.h"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <optional>
#include <span>

#include "model/errors.h"
#include "model/hdf5_layout.h"
#include "model/mesh_arrays.h"
#include "model/mesh_check.h"

namespace wellknit {

namespace {

using hdf5::Handle;

constexpr const char* advice = "make the file anew with `wellknit build`";

/// gzip cannot pack more than 1,032 bytes into one: a dataset that claims more than that was never written.
constexpr hsize_t largest_compression = 1032;

std::string shape_text(std::span<const hsize_t> shape) { return fmt::format("[{}]", fmt::join(shape, ", ")); }

/// An open mesh file. Everything that is not as the schema says becomes a ParseError that names the object.
class MeshFileReader {
 public:
  explicit MeshFileReader(const std::string& path)
      : path_(path), file_(open(path)), file_size_(std::filesystem::file_size(path)) {}

  [[noreturn]] void fail(const std::string& object, std::string expected, std::string found) const {
    throw ParseError({path_, 0, object}, {std::move(expected), std::move(found), advice});
  }

  [[noreturn]] void fail_to_read(const std::string& object) const {
    fail(object, "readable data", "data that HDF5 cannot read; the file is damaged");
  }

  /// Every group on the way must be there: HDF5 reports an error for a path through a missing one.
  [[nodiscard]] bool has(const std::string& object) const {
    for (std::size_t slash = object.find('/'); slash != std::string::npos; slash = object.find('/', slash + 1))
      if (H5Lexists(file_.get(), object.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    return H5Lexists(file_.get(), object.c_str(), H5P_DEFAULT) > 0;
  }

  template <class Array>
  void array(const std::string& name, Array& values) const {
    const hdf5::Element layout = hdf5::element(values.data());
    const Handle set = open_dataset(name);
    check_type(name, set, layout);
    const std::vector<hsize_t> shape = shape_of(name, set);
    if (shape.size() != (layout.columns == 1 ? 1U : 2U) || (layout.columns > 1 && shape[1] != layout.columns))
      fail(name, layout.columns == 1 ? "a list" : fmt::format("rows of {} numbers", layout.columns),
           "shape " + shape_text(shape));
    check_size(name, set, shape);
    values.resize(static_cast<std::size_t>(shape[0]));
    if (!values.empty() && H5Dread(set.get(), layout.memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      fail_to_read(name);
  }

  [[nodiscard]] CellProperty property(const std::string& name) const {
    const Handle set = open_dataset(name);
    const Handle type(H5Dget_type(set.get()), H5Tclose);
    if (H5Tget_class(type.get()) == H5T_INTEGER) {
      std::vector<std::int32_t> values;
      array(name, values);
      return values;
    }
    std::vector<double> values;
    array(name, values);
    return values;
  }

  [[nodiscard]] std::vector<std::string> strings(const std::string& name) const {
    const Handle set = open_dataset(name);
    const Handle type(H5Dget_type(set.get()), H5Tclose);
    const std::vector<hsize_t> shape = shape_of(name, set);
    check_size(name, set, shape);
    return read_strings(name, type, shape, [&](hid_t memory, void* data) {
      return H5Dread(set.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
    });
  }

  [[nodiscard]] bool has_attribute(const std::string& object, const std::string& name) const {
    return H5Aexists_by_name(file_.get(), object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
  }

  [[nodiscard]] std::vector<std::string> string_attribute(const std::string& object, const std::string& name) const {
    const Handle attribute = open_attribute(object, name);
    const Handle type(H5Aget_type(attribute.get()), H5Tclose);
    const Handle space(H5Aget_space(attribute.get()), H5Sclose);
    const std::array<hsize_t, 1> shape{points_of(name, space)};
    return read_strings(name, type, shape,
                        [&](hid_t memory, void* data) { return H5Aread(attribute.get(), memory, data); });
  }

  [[nodiscard]] std::string text_attribute(const std::string& object, const std::string& name) const {
    std::vector<std::string> values = string_attribute(object, name);
    if (values.size() != 1) fail(name, "one string", fmt::format("{} of them", values.size()));
    return std::move(values.front());
  }

  /// `count` numbers; T is double or std::int64_t.
  template <class T>
  void number_attribute(const std::string& object, const std::string& name, std::span<T> values) const {
    const Handle attribute = open_attribute(object, name);
    const Handle type(H5Aget_type(attribute.get()), H5Tclose);
    const Handle space(H5Aget_space(attribute.get()), H5Sclose);
    const hsize_t found = points_of(name, space);
    if (found != values.size()) fail(name, fmt::format("{} numbers", values.size()), fmt::format("{}", found));
    const hdf5::Element layout = hdf5::element(values.data());
    if (H5Tget_class(type.get()) != H5Tget_class(layout.memory_type)) fail(name, "numbers of its kind", "another type");
    if (H5Aread(attribute.get(), layout.memory_type, values.data()) < 0) fail_to_read(name);
  }

  [[nodiscard]] std::vector<std::string> links(const std::string& group) const {
    const Handle opened(H5Gopen2(file_.get(), group.c_str(), H5P_DEFAULT), H5Gclose);
    H5G_info_t info{};
    if (!opened.is_valid() || H5Gget_info(opened.get(), &info) < 0) fail(group, "a group", "none");
    std::vector<std::string> names;
    for (hsize_t i = 0; i < info.nlinks; ++i) {
      const ssize_t length =
          H5Lget_name_by_idx(opened.get(), ".", H5_INDEX_NAME, H5_ITER_INC, i, nullptr, 0, H5P_DEFAULT);
      if (length < 0) fail_to_read(group);
      std::string name(static_cast<std::size_t>(length) + 1, '\0');
      H5Lget_name_by_idx(opened.get(), ".", H5_INDEX_NAME, H5_ITER_INC, i, name.data(), name.size(), H5P_DEFAULT);
      name.pop_back();
      names.push_back(std::move(name));
    }
    return names;
  }

 private:
  [[nodiscard]] static Handle open(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error))
      throw ParseError({path, 0, ""}, {"a mesh file", "no such file", "check the name"});
    if (!std::filesystem::is_regular_file(path, error))
      throw ParseError({path, 0, ""}, {"a mesh file", "something that is not a file", "check the name"});
    Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (!file.is_valid())
      throw ParseError({path, 0, ""}, {"a mesh file (HDF5)",
                                       "a file that HDF5 cannot open: another format, cut or not readable", advice});
    return file;
  }

  [[nodiscard]] Handle open_dataset(const std::string& name) const {
    if (!has(name)) fail(name, "a dataset", "none");
    Handle set(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!set.is_valid()) fail(name, "a dataset", "something else");
    return set;
  }

  [[nodiscard]] Handle open_attribute(const std::string& object, const std::string& name) const {
    Handle attribute(H5Aopen_by_name(file_.get(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (!attribute.is_valid()) fail(name, fmt::format("an attribute of {}", object), "none");
    return attribute;
  }

  /// Numbers of the same class, and integers that fit: 64-bit values may not be squeezed into 32 bits unseen. Ids have
  /// 64 bits in the file; one that needs more than 32 becomes the largest of these, which names nothing.
  void check_type(const std::string& name, const Handle& set, const hdf5::Element& layout) const {
    const Handle type(H5Dget_type(set.get()), H5Tclose);
    const H5T_class_t wanted = H5Tget_class(layout.memory_type);
    const char* kind = wanted == H5T_FLOAT ? "floating-point numbers" : "integers";
    if (H5Tget_class(type.get()) != wanted) fail(name, kind, "another type");
    const std::size_t largest = std::max(H5Tget_size(layout.memory_type), H5Tget_size(layout.file_type));
    if (H5Tget_size(type.get()) > largest)
      fail(name, fmt::format("{} of at most {} bytes", kind, largest),
           fmt::format("{} bytes", H5Tget_size(type.get())));
  }

  [[nodiscard]] std::vector<hsize_t> shape_of(const std::string& name, const Handle& set) const {
    const Handle space(H5Dget_space(set.get()), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.get());
    if (rank < 1) fail(name, "an array", "none");
    std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr);
    return shape;
  }

  [[nodiscard]] hsize_t points_of(const std::string& name, const Handle& space) const {
    const hssize_t count = H5Sget_simple_extent_npoints(space.get());
    // An attribute lies in its object's header or heap: it cannot have more elements than the file has bytes.
    if (count < 0 || static_cast<std::uintmax_t>(count) > file_size_)
      fail(name, "as many values as its shape says", fmt::format("{}", count));
    return static_cast<hsize_t>(count);
  }

  /// Before anything is allocated: can this many elements be in the file?
  void check_size(const std::string& name, const Handle& set, const std::vector<hsize_t>& shape) const {
    const Handle type(H5Dget_type(set.get()), H5Tclose);
    const Handle properties(H5Dget_create_plist(set.get()), H5Pclose);
    hsize_t room = H5Dget_storage_size(set.get());
    if (room > file_size_)
      fail(name, "data inside the file", fmt::format("{} bytes in a file of {}", room, file_size_));
    if (H5Pget_layout(properties.get()) == H5D_CHUNKED) room *= largest_compression;
    hsize_t left = room / std::max<hsize_t>(1, H5Tget_size(type.get()));
    for (const hsize_t n : shape) {
      if (n == 0) return;
      left /= n;
    }
    if (left == 0)
      fail(name, "as many values as its shape says",
           fmt::format("shape {} in {} bytes; the file is cut", shape_text(shape), room));
  }

  /// Strings of fixed or of variable length.
  template <class Read>
  [[nodiscard]] std::vector<std::string> read_strings(const std::string& name, const Handle& type,
                                                      std::span<const hsize_t> shape, Read read) const {
    hsize_t count = 1;
    for (const hsize_t n : shape) count *= n;
    if (H5Tget_class(type.get()) != H5T_STRING) fail(name, "strings", "another type");
    if (count == 0) return {};
    return H5Tis_variable_str(type.get()) > 0 ? variable_strings(name, type, count, read)
                                              : fixed_strings(name, type, count, read);
  }

  template <class Read>
  [[nodiscard]] std::vector<std::string> variable_strings(const std::string& name, const Handle& type, hsize_t count,
                                                          Read read) const {
    const Handle memory(H5Tcopy(type.get()), H5Tclose);
    std::vector<char*> pointers(static_cast<std::size_t>(count), nullptr);
    const bool done = read(memory.get(), pointers.data()) >= 0;
    std::vector<std::string> out;
    for (char* text : pointers) {
      out.emplace_back(text != nullptr ? text : "");
      H5free_memory(text);
    }
    if (!done) fail_to_read(name);
    return out;
  }

  template <class Read>
  [[nodiscard]] std::vector<std::string> fixed_strings(const std::string& name, const Handle& type, hsize_t count,
                                                       Read read) const {
    const std::size_t length = H5Tget_size(type.get());
    if (count * length > file_size_)
      fail(name, "strings that fit in the file", fmt::format("{} of {} bytes", count, length));
    std::vector<char> bytes(static_cast<std::size_t>(count) * length);
    if (read(type.get(), bytes.data()) < 0) fail_to_read(name);
    std::vector<std::string> out;
    for (std::size_t i = 0; i < count; ++i) out.emplace_back(&bytes[i * length], ::strnlen(&bytes[i * length], length));
    return out;
  }

  std::string path_;
  Handle file_;
  std::uintmax_t file_size_;
};

void check_schema(const MeshFileReader& in) {
  if (!in.has_attribute("/", "schema"))
    in.fail("schema", std::string("an HDF5 file with the schema ") + hdf5::schema_name, "an HDF5 file without one");
  const std::string schema = in.text_attribute("/", "schema");
  if (schema != hdf5::schema_name) in.fail("schema", hdf5::schema_name, schema);
  const std::string version = in.text_attribute("/", "schema_version");
  if (version != hdf5::schema_version) in.fail("schema_version", hdf5::schema_version, version);
}

Provenance read_provenance(const MeshFileReader& in) {
  Provenance out;
  out.created_by = in.text_attribute("/", "created_by");
  out.command = in.text_attribute("/", "command");
  out.config = in.text_attribute("/", "config");
  std::vector<std::string> sources = in.string_attribute("/", "sources");
  if (sources.size() % 2 != 0)
    in.fail("sources", "pairs of a name and a SHA-256", fmt::format("{} strings", sources.size()));
  for (std::size_t i = 0; i < sources.size(); i += 2)
    out.sources.push_back({std::move(sources[i]), std::move(sources[i + 1])});
  return out;
}

UnitSystem read_units(const MeshFileReader& in) {
  const std::string name = in.text_attribute("/", "source_units");
  for (const UnitSystem units : {UnitSystem::metric, UnitSystem::field, UnitSystem::lab})
    if (name == name_of(units)) return units;
  in.fail("source_units", "METRIC, FIELD or LAB", name);
}

/// Dimensions whose product cannot overflow: it is compared with lengths of arrays later.
void read_dimensions(const MeshFileReader& in, Mesh& mesh) {
  in.number_attribute("/", "source_dimensions", std::span<std::int64_t>(mesh.source_dimensions));
  constexpr std::int64_t largest = 1'000'000;  // of one direction; simulators end far below it
  for (const std::int64_t n : mesh.source_dimensions)
    if (n < 0 || n > largest)
      in.fail("source_dimensions", fmt::format("numbers from 0 to {}", largest), fmt::format("{}", n));
}

void read_well_connections(const MeshFileReader& in, const std::string& group, MeshWell& well) {
  std::vector<CellId> cell;
  std::vector<double> well_index;
  std::vector<std::array<double, 2>> measured_depth;
  in.array(group + "/cell", cell);
  in.array(group + "/well_index", well_index);
  in.array(group + "/md", measured_depth);
  if (well_index.size() != cell.size() || measured_depth.size() != cell.size())
    in.fail(group, fmt::format("{} values in each array", cell.size()),
            fmt::format("{} well indices and {} measured depths", well_index.size(), measured_depth.size()));
  for (std::size_t i = 0; i < cell.size(); ++i)
    well.connections.push_back({cell[i], well_index[i], {measured_depth[i][0], measured_depth[i][1]}});
}

MeshWell read_well(const MeshFileReader& in, const std::string& link) {
  const std::string group = "wells/" + link;
  if (link.empty() || link.find('/') != std::string::npos || !in.has(group))
    in.fail("wells_order", "names of groups in wells", link);
  MeshWell well;
  well.name = in.has_attribute(group, "name") ? in.text_attribute(group, "name") : link;
  in.number_attribute(group, "bore_radius", std::span(&well.bore_radius, 1));
  in.number_attribute(group, "drainage_radius", std::span(&well.drainage_radius, 1));
  const std::string type = in.text_attribute(group, "type");
  if (type != "producer" && type != "injector") in.fail(group, "the type producer or injector", type);
  well.type = type == "injector" ? WellType::injector : WellType::producer;
  if (in.has_attribute(group, "reference_depth")) {
    double depth = 0.0;
    in.number_attribute(group, "reference_depth", std::span(&depth, 1));
    well.reference_depth = depth;
  }
  std::vector<std::array<double, 4>> stations;
  in.array(group + "/trajectory", stations);
  for (const auto& [md, x, y, depth] : stations) {
    well.trajectory.measured_depth.push_back(md);
    well.trajectory.points.emplace_back(x, y, depth);
  }
  read_well_connections(in, group + "/connections", well);
  return well;
}

}  // namespace

MeshFile read_mesh(const std::string& path) {
  const hdf5::Silence silence;
  const MeshFileReader in(path);
  check_schema(in);
  MeshFile out;
  out.provenance = read_provenance(in);
  Mesh& mesh = out.mesh;
  mesh.source_units = read_units(in);
  read_dimensions(in, mesh);
  if (in.has_attribute("/", "mapaxes")) in.number_attribute("/", "mapaxes", std::span<double>(mesh.mapaxes.emplace()));

  const auto read_array = [&](const char* name, auto& values) { in.array(name, values); };
  for_each_array(mesh, read_array);
  if (in.has("connections/linear_flux_error")) for_each_added_array(mesh, read_array);
  if (in.has("cells/properties"))
    for (const std::string& keyword : in.links("cells/properties"))
      mesh.cells.properties[keyword] = in.property("cells/properties/" + keyword);
  for (const std::string& link : in.strings("wells_order")) mesh.wells.push_back(read_well(in, link));
  if (in.has("transfer")) for_each_transfer_array(mesh, read_array);
  if (in.has("transfer/source_volume")) for_each_source_volume(mesh, read_array);
  if (in.has("stencils")) for_each_stencil_array(mesh.stencils.emplace(), read_array);
  if (in.has("flow")) {
    for_each_flow_array(mesh.flow.emplace(), read_array);
    mesh.flow->command = in.text_attribute("flow", "command");
  }

  const std::vector<Violation> violations = check_structure(mesh);
  if (!violations.empty())
    in.fail(violations.front().entity, "arrays that fit each other",
            violations.front().check + " (" + violations.front().detail + ")");
  return out;
}

}  // namespace wellknit
