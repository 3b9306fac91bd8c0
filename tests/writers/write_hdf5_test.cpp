// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/write_hdf5.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <cstring>
#include <filesystem>
#include <functional>

#include "model/errors.h"
#include "model/hdf5_layout.h"
#include "model/mesh_arrays.h"
#include "readers/read_mesh.h"
#include "tests/support/meshes.h"
#include "tests/support/scratch_folder.h"

namespace wellknit {
namespace {

MeshFile round_trip(const Mesh& mesh) {
  const ScratchFolder folder;
  write_hdf5(mesh, meshes::provenance(), folder.file("mesh.h5"));
  return read_mesh(folder.file("mesh.h5"));
}

/// The bytes of an array: equal bytes are equal values, infinities and signs of zero included.
template <class Array>
std::string bytes_of(const Array& values) {
  return values.empty()
             ? std::string()
             : std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values.front()));
}

std::vector<std::pair<std::string, std::string>> arrays_of(const Mesh& mesh) {
  std::vector<std::pair<std::string, std::string>> out;
  const auto visit = [&](const char* name, const auto& values) { out.emplace_back(name, bytes_of(values)); };
  for_each_array(mesh, visit);
  for_each_transfer_array(mesh, visit);
  return out;
}

void expect_equal_wells(const MeshWell& a, const MeshWell& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.trajectory.measured_depth, b.trajectory.measured_depth);
  EXPECT_EQ(bytes_of(a.trajectory.points), bytes_of(b.trajectory.points));
  EXPECT_EQ(a.bore_radius, b.bore_radius);
  EXPECT_EQ(a.drainage_radius, b.drainage_radius);
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(a.reference_depth, b.reference_depth);
  ASSERT_EQ(a.connections.size(), b.connections.size());
  for (std::size_t c = 0; c < a.connections.size(); ++c) {
    EXPECT_EQ(a.connections[c].cell, b.connections[c].cell);
    EXPECT_EQ(a.connections[c].well_index, b.connections[c].well_index);
    EXPECT_EQ(a.connections[c].measured_depth.from, b.connections[c].measured_depth.from);
    EXPECT_EQ(a.connections[c].measured_depth.to, b.connections[c].measured_depth.to);
  }
}

void expect_equal(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(arrays_of(a), arrays_of(b));
  EXPECT_EQ(a.cells.properties, b.cells.properties);
  EXPECT_EQ(a.source_dimensions, b.source_dimensions);
  EXPECT_EQ(a.mapaxes, b.mapaxes);
  EXPECT_EQ(a.source_units, b.source_units);
  ASSERT_EQ(a.wells.size(), b.wells.size());
  for (std::size_t w = 0; w < a.wells.size(); ++w) expect_equal_wells(a.wells[WellId(w)], b.wells[WellId(w)]);
}

TEST(MeshFile, RoundTripKeepsEveryValue) {
  for (const Mesh& mesh :
       {meshes::two_boxes(), meshes::box_grid(3), meshes::ring_in_boxes(), meshes::twisted_box(), Mesh()})
    expect_equal(mesh, round_trip(mesh).mesh);
}

TEST(MeshFile, RoundTripKeepsValuesThatAreNotFinite) {
  Mesh mesh = meshes::two_boxes();
  mesh.cells.volume[CellId(0)] = std::numeric_limits<double>::quiet_NaN();
  mesh.cells.volume[CellId(1)] = -std::numeric_limits<double>::infinity();
  expect_equal(mesh, round_trip(mesh).mesh);
}

TEST(MeshFile, RoundTripKeepsAFlowSolutionAndTheSourceVolumes) {
  Mesh mesh = meshes::box_grid(2);
  EXPECT_FALSE(round_trip(mesh).mesh.flow.has_value());
  EXPECT_TRUE(round_trip(mesh).mesh.source_volumes.bulk.empty());
  FlowSolution& flow = mesh.flow.emplace();
  double next = 0.5;
  const auto fill = [&](auto& values, std::size_t count) {
    values.resize(count);
    for (double& value : values) value = next *= 1.25;
  };
  std::size_t well_connections = 0;
  for (const MeshWell& well : mesh.wells) well_connections += well.connections.size();
  fill(flow.pressure, mesh.cells.size());
  fill(flow.flux, mesh.connections.size());
  fill(flow.well_pressure, mesh.wells.size());
  fill(flow.well_rate, mesh.wells.size());
  fill(flow.well_connection_rate, well_connections);
  flow.command = "wellknit solve --boundary all=200bar";
  for (std::size_t i = 0; i < mesh.connections.size(); ++i)
    mesh.connections.linear_flux_error.push_back(Vec3(0.25, 0.5, 0.125) * static_cast<double>(i));
  fill(mesh.source_volumes.bulk, 8);
  fill(mesh.source_volumes.pores, 8);
  const Mesh found = round_trip(mesh).mesh;
  ASSERT_TRUE(found.flow.has_value());
  EXPECT_EQ(found.flow->pressure.raw(), flow.pressure.raw());
  EXPECT_EQ(found.flow->flux.raw(), flow.flux.raw());
  EXPECT_EQ(found.flow->well_pressure.raw(), flow.well_pressure.raw());
  EXPECT_EQ(found.flow->well_rate.raw(), flow.well_rate.raw());
  EXPECT_EQ(found.flow->well_connection_rate, flow.well_connection_rate);
  EXPECT_EQ(found.flow->command, flow.command);
  EXPECT_EQ(found.connections.linear_flux_error.raw(), mesh.connections.linear_flux_error.raw());
  EXPECT_EQ(found.source_volumes.bulk, mesh.source_volumes.bulk);
  EXPECT_EQ(found.source_volumes.pores, mesh.source_volumes.pores);
}

TEST(MeshFile, RefusesLinearFluxErrorsThatDoNotFit) {
  Mesh mesh = meshes::box_grid(2);
  EXPECT_TRUE(round_trip(mesh).mesh.connections.linear_flux_error.empty());
  mesh.connections.linear_flux_error.resize(3);
  EXPECT_THROW((void)round_trip(mesh), ParseError);
}

TEST(MeshFile, RefusesAFlowSolutionThatDoesNotFit) {
  Mesh mesh = meshes::box_grid(2);
  mesh.flow.emplace().pressure.resize(3);
  EXPECT_THROW((void)round_trip(mesh), ParseError);
}

TEST(MeshFile, RoundTripKeepsTheProvenance) {
  const Provenance found = round_trip(meshes::two_boxes()).provenance;
  const Provenance expected = meshes::provenance();
  EXPECT_EQ(found.created_by, expected.created_by);
  EXPECT_EQ(found.command, expected.command);
  EXPECT_EQ(found.config, expected.config);
  ASSERT_EQ(found.sources.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(found.sources[i].path, expected.sources[i].path);
    EXPECT_EQ(found.sources[i].sha256, expected.sources[i].sha256);
  }
}

TEST(MeshFile, RoundTripKeepsAConfigurationLongerThanAnAttributeHolds) {
  const ScratchFolder folder;
  Provenance provenance = meshes::provenance();
  provenance.config = std::string(200'000, '#');  // HDF5's own limit in an object header is 64 KiB
  write_hdf5(meshes::two_boxes(), provenance, folder.file("mesh.h5"));
  EXPECT_EQ(read_mesh(folder.file("mesh.h5")).provenance.config, provenance.config);
}

TEST(MeshFile, RoundTripKeepsAnyWellName) {
  Mesh mesh = meshes::box_grid(2);
  mesh.wells[WellId(0)].name = "34/10-A/B";
  mesh.wells[WellId(1)].name = "34_10-A_B";  // what the first one's group is called
  mesh.wells.push_back(mesh.wells[WellId(0)]);
  mesh.wells.push_back(mesh.wells[WellId(0)]);
  mesh.wells.raw()[2].name = ".";
  mesh.wells.raw()[3].name = "";
  expect_equal(mesh, round_trip(mesh).mesh);
}

TEST(MeshFile, GivesTheSameBytesTwice) {
  const ScratchFolder folder;
  write_hdf5(meshes::box_grid(3), meshes::provenance(), folder.file("a.h5"));
  write_hdf5(meshes::box_grid(3), meshes::provenance(), folder.file("b.h5"));
  EXPECT_EQ(folder.read("a.h5"), folder.read("b.h5"));
}

TEST(MeshFile, IsRefusedWhereAFileStands) {
  const ScratchFolder folder;
  folder.write("mesh.h5", "precious");
  EXPECT_THROW(write_hdf5(meshes::two_boxes(), {}, folder.file("mesh.h5")), WriteError);
  EXPECT_EQ(folder.read("mesh.h5"), "precious");
  EXPECT_EQ(folder.count(), 1U);
}

/// Writes a good mesh, lets `damage` change the file through HDF5, and returns the reader's message.
std::string message_after(const std::function<void(hid_t file)>& damage, const Mesh& mesh = meshes::box_grid(2)) {
  const ScratchFolder folder;
  const std::string path = folder.file("mesh.h5");
  write_hdf5(mesh, meshes::provenance(), path);
  {
    const hdf5::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    damage(file.get());
  }
  try {
    read_mesh(path);
  } catch (const ParseError& error) {
    return std::string(error.what()).substr(path.size());
  }
  return "no error";
}

template <class T>
void replace_dataset(hid_t file, const char* name, hid_t type, std::vector<hsize_t> shape,
                     const std::vector<T>& values) {
  H5Ldelete(file, name, H5P_DEFAULT);
  const hdf5::Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
  const hdf5::Handle set(H5Dcreate2(file, name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  if (!values.empty()) H5Dwrite(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
}

/// Writes one element of a list or table in place.
void poke(hid_t file, const char* name, hsize_t element, std::int64_t value) {
  const hdf5::Handle set(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
  const hdf5::Handle space(H5Dget_space(set.get()), H5Sclose);
  std::vector<std::int64_t> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())));
  H5Dread(set.get(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  values[element] = value;
  H5Dwrite(set.get(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
}

TEST(ReadMesh, ReportsAFileThatIsNotThere) {
  try {
    read_mesh("/no/such/mesh.h5");
    FAIL();
  } catch (const ParseError& error) {
    EXPECT_STREQ(error.what(), "/no/such/mesh.h5: expected a mesh file, found no such file; check the name");
  }
}

TEST(ReadMesh, ReportsFilesOfOtherFormats) {
  const ScratchFolder folder;
  folder.write("empty.h5", "");
  folder.write("text.h5", "SPECGRID\n 1 1 1 /\n");
  EXPECT_THROW(read_mesh(folder.file("empty.h5")), ParseError);
  EXPECT_THROW(read_mesh(folder.file("text.h5")), ParseError);
  EXPECT_THROW(read_mesh(folder.path().string()), ParseError);
}

TEST(ReadMesh, ReportsAnHdf5FileOfAnotherSchema) {
  EXPECT_EQ(message_after([](hid_t file) { H5Adelete(file, "schema"); }),
            ": schema: expected an HDF5 file with the schema wellknit-mesh, found an HDF5 file without one; make the "
            "file anew with `wellknit build`");
}

TEST(ReadMesh, ReportsAnotherSchemaVersion) {
  const std::string message = message_after([](hid_t file) {
    const hdf5::Handle attribute(H5Aopen(file, "schema_version", H5P_DEFAULT), H5Aclose);
    const hdf5::Handle type = hdf5::string_type(3);
    H5Awrite(attribute.get(), type.get(), "2.0");
  });
  EXPECT_NE(message.find("schema_version: expected 1.0, found 2.0"), std::string::npos) << message;
}

TEST(ReadMesh, ReportsEachMissingArray) {
  std::vector<std::string> names;
  const Mesh mesh = meshes::box_grid(2);
  const auto collect = [&](const char* name, const auto&) { names.emplace_back(name); };
  for_each_array(mesh, collect);
  for_each_transfer_array(mesh, collect);
  names.emplace_back("wells_order");
  names.emplace_back("wells/INJ/trajectory");
  names.emplace_back("wells/PROD/connections/md");
  for (const std::string& name : names) {
    const std::string message = message_after([&](hid_t file) { H5Ldelete(file, name.c_str(), H5P_DEFAULT); });
    EXPECT_NE(message.find(name + ": expected a dataset, found none"), std::string::npos) << message;
  }
}

TEST(ReadMesh, ReportsArraysThatDoNotFit) {
  // 8 cells.
  EXPECT_NE(message_after([](hid_t f) {
              replace_dataset<double>(f, "cells/volume", H5T_NATIVE_DOUBLE, {3}, {1, 2, 3});
            })
                .find("cells/volume: expected arrays that fit each other, found array of a wrong length (3 values "
                      "where 8 are expected)"),
            std::string::npos);
  EXPECT_NE(message_after([](hid_t f) {
              replace_dataset<double>(f, "cells/properties/SWAT", H5T_NATIVE_DOUBLE, {2}, {1, 2});
            }).find("SWAT"),
            std::string::npos);
  EXPECT_NE(message_after([](hid_t f) {
              replace_dataset<double>(f, "wells/INJ/connections/well_index", H5T_NATIVE_DOUBLE, {1}, {1});
            }).find("wells/INJ/connections"),
            std::string::npos);
}

TEST(ReadMesh, ReportsWrongShapesAndTypes) {
  EXPECT_NE(message_after([](hid_t f) {
              replace_dataset<double>(f, "vertices", H5T_NATIVE_DOUBLE, {4, 2}, std::vector<double>(8));
            }).find("vertices: expected rows of 3 numbers, found shape [4, 2]"),
            std::string::npos);
  EXPECT_NE(message_after([](hid_t f) {
              replace_dataset<double>(f, "faces/vertices", H5T_NATIVE_DOUBLE, {4}, std::vector<double>(4));
            }).find("faces/vertices: expected integers, found another type"),
            std::string::npos);
  EXPECT_NE(
      message_after([](hid_t f) {
        replace_dataset<std::int64_t>(f, "cells/radial_index", H5T_NATIVE_INT64, {8, 3}, std::vector<std::int64_t>(24));
      }).find("integers of at most 4 bytes"),
      std::string::npos);
}

TEST(ReadMesh, ReportsIndicesOutOfRange) {
  // 8 cells, 27 vertices, 36 faces.
  const std::vector<std::tuple<const char*, std::int64_t>> cases{
      {"faces/vertices", 27},   {"faces/vertices", -1},    {"faces/cells", 8},
      {"faces/cells", -1},      {"faces/vertex_start", 1}, {"connections/cells", 8},
      {"connections/face", 36}, {"connections/face", -2},  {"cells/source_cell", 8},
      {"cells/well", 2},        {"transfer/cell", 8},      {"transfer/start", 2},
      {"cells/kind", 4},        {"connections/kind", 4},   {"wells/INJ/connections/cell", -1}};
  for (const auto& [name, value] : cases) {
    const std::string message =
        message_after([&, &array = name, &bad = value](hid_t file) { poke(file, array, 0, bad); });
    EXPECT_NE(message.find("arrays that fit each other"), std::string::npos) << name << " " << value << ": " << message;
  }
}

TEST(ReadMesh, ReportsSizesThatTheFileCannotHold) {
  // A chunked dataset without data may claim any shape.
  const std::string message = message_after([](hid_t file) {
    H5Ldelete(file, "cells/volume", H5P_DEFAULT);
    const std::array<hsize_t, 1> shape{1'000'000'000'000};
    const std::array<hsize_t, 1> chunk{1024};
    const hdf5::Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(properties.get(), 1, chunk.data());
    const hdf5::Handle space(H5Screate_simple(1, shape.data(), nullptr), H5Sclose);
    const hdf5::Handle set(
        H5Dcreate2(file, "cells/volume", H5T_NATIVE_DOUBLE, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
        H5Dclose);
  });
  EXPECT_NE(
      message.find("cells/volume: expected as many values as its shape says, found shape [1000000000000] in 0 bytes"),
      std::string::npos)
      << message;
}

/// A list in one compressed piece: gzip and `bytes` in its place.
void replace_by_chunk(hid_t file, const char* name, hid_t type, hsize_t size, const std::string& bytes) {
  H5Ldelete(file, name, H5P_DEFAULT);
  const hdf5::Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(properties.get(), 1, &size);
  H5Pset_deflate(properties.get(), 9);
  const hdf5::Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
  const hdf5::Handle set(H5Dcreate2(file, name, type, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                         H5Dclose);
  const hsize_t first = 0;
  H5Dwrite_chunk(set.get(), H5P_DEFAULT, 0, &first, bytes.size(), bytes.data());
}

TEST(ReadMesh, ReportsDataThatCannotBeUnpacked) {
  const std::string noise(64, '\x55');  // no gzip stream begins so
  EXPECT_EQ(message_after([&](hid_t file) { replace_by_chunk(file, "cells/volume", H5T_IEEE_F64LE, 8, noise); }),
            ": cells/volume: expected readable data, found data that HDF5 cannot read; the file is damaged; make the "
            "file anew with `wellknit build`");
  const hdf5::Handle name(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(name.get(), 8);
  EXPECT_NE(message_after([&](hid_t file) {
              replace_by_chunk(file, "wells_order", name.get(), 2, noise);
            }).find("wells_order: expected readable data"),
            std::string::npos);
}

TEST(ReadMesh, ReportsDataThatAreNotInTheFile) {
  // HDF5 may keep a dataset in a file of its own, here of 8 MB: a mesh file is one file.
  const std::string message = message_after([](hid_t file) {
    H5Ldelete(file, "cells/volume", H5P_DEFAULT);
    const hdf5::Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_external(properties.get(), "elsewhere.bin", 0, 8'000'000);
    const std::array<hsize_t, 1> shape{1'000'000};
    const hdf5::Handle space(H5Screate_simple(1, shape.data(), nullptr), H5Sclose);
    const hdf5::Handle set(
        H5Dcreate2(file, "cells/volume", H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
        H5Dclose);
  });
  EXPECT_NE(message.find("cells/volume: expected data inside the file, found 8000000 bytes in a file of "),
            std::string::npos)
      << message;
}

TEST(ReadMesh, ReportsStringsThatAreLargerThanTheFile) {
  // Two names of 500,000 zeros each, which gzip packs into some 1,000 bytes.
  const std::string message = message_after([](hid_t file) {
    H5Ldelete(file, "wells_order", H5P_DEFAULT);
    const hdf5::Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.get(), 500'000);
    const std::array<hsize_t, 1> shape{2};
    const hdf5::Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(properties.get(), 1, shape.data());
    H5Pset_deflate(properties.get(), 9);
    const hdf5::Handle space(H5Screate_simple(1, shape.data(), nullptr), H5Sclose);
    const hdf5::Handle set(
        H5Dcreate2(file, "wells_order", type.get(), space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT), H5Dclose);
    const std::string zeros(1'000'000, '\0');
    H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, zeros.data());
  });
  EXPECT_NE(message.find("wells_order: expected strings that fit in the file, found 2 of 500000 bytes"),
            std::string::npos)
      << message;
}

TEST(ReadMesh, ReportsAWellThatIsNotThere) {
  EXPECT_NE(message_after([](hid_t file) {
              H5Ldelete(file, "wells/PROD", H5P_DEFAULT);
            }).find("wells_order: expected names of groups in wells, found PROD"),
            std::string::npos);
}

TEST(ReadMesh, ReadsChunkedCompressedArrays) {
  const ScratchFolder folder;
  const std::string path = folder.file("mesh.h5");
  const Mesh mesh = meshes::box_grid(3);
  write_hdf5(mesh, meshes::provenance(), path);
  {
    const hdf5::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    H5Ldelete(file.get(), "cells/volume", H5P_DEFAULT);
    const std::array<hsize_t, 1> shape{27};
    const hdf5::Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(properties.get(), 1, shape.data());
    H5Pset_shuffle(properties.get());
    H5Pset_deflate(properties.get(), 9);
    const hdf5::Handle space(H5Screate_simple(1, shape.data(), nullptr), H5Sclose);
    const hdf5::Handle set(
        H5Dcreate2(file.get(), "cells/volume", H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
        H5Dclose);
    H5Dwrite(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, mesh.cells.volume.raw().data());
  }
  expect_equal(mesh, read_mesh(path).mesh);
}

TEST(ReadMesh, ReadsStringsOfVariableLength) {
  // What h5py makes of a string attribute that somebody sets anew.
  EXPECT_EQ(message_after([](hid_t file) {
              H5Adelete(file, "schema");
              const hdf5::Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
              H5Tset_size(type.get(), H5T_VARIABLE);
              const hdf5::Handle space(H5Screate(H5S_SCALAR), H5Sclose);
              const hdf5::Handle attribute(
                  H5Acreate2(file, "schema", type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
              const char* text = "wellknit-mesh";
              H5Awrite(attribute.get(), type.get(), &text);
            }),
            "no error");
}

TEST(ReadMesh, RejectsEveryTruncation) {
  const ScratchFolder folder;
  write_hdf5(meshes::two_boxes(), meshes::provenance(), folder.file("whole.h5"));
  const std::string whole = folder.read("whole.h5");
  // A prime step meets every kind of place; the last bytes one by one.
  for (std::size_t length = 0; length<whole.size(); length += whole.size() - length> 64 ? 61 : 1) {
    folder.write("cut.h5", whole.substr(0, length));
    EXPECT_THROW(read_mesh(folder.file("cut.h5")), ParseError) << length << " of " << whole.size();
  }
}

#if defined(__SANITIZE_ADDRESS__)
constexpr bool leaks_are_errors = true;
#elif defined(__has_feature)
constexpr bool leaks_are_errors = __has_feature(address_sanitizer);
#else
constexpr bool leaks_are_errors = false;
#endif

TEST(ReadMesh, SurvivesDamagedBytes) {
  if (leaks_are_errors) GTEST_SKIP() << "HDF5 1.10 leaks what it had read of damaged metadata";
  const ScratchFolder folder;
  const Mesh mesh = meshes::two_boxes();
  write_hdf5(mesh, meshes::provenance(), folder.file("whole.h5"));
  const std::string whole = folder.read("whole.h5");
  std::size_t rejected = 0;
  for (std::size_t place = 0; place < whole.size(); place += 37) {
    std::string damaged = whole;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x55);
    folder.write("damaged.h5", damaged);
    try {
      const MeshFile file = read_mesh(folder.file("damaged.h5"));
      EXPECT_EQ(file.mesh.cells.kind.size(),
                file.mesh.cells.volume.size());  // damage in a value alone: the shapes still fit
    } catch (const ParseError&) {
      ++rejected;
    }
  }
  EXPECT_GT(rejected, 10U);
}

}  // namespace
}  // namespace wellknit
