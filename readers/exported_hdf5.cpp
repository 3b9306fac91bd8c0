// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/exported_hdf5.h"

#include <array>
#include <vector>

#include "model/hdf5_layout.h"

namespace wellknit {

namespace {

using hdf5::Handle;
using Count = std::optional<std::int64_t>;

/// The first extent of a dataset by its whole path; unset where there is none. Links on the way are looked at one by
/// one, as HDF5 demands.
Count rows_of(const Handle& file, const std::string& path) {
  for (std::size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1))
    if (H5Lexists(file.get(), path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return {};
  if (H5Lexists(file.get(), path.c_str(), H5P_DEFAULT) <= 0) return {};
  const Handle set(H5Dopen2(file.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.is_valid()) return {};
  const Handle space(H5Dget_space(set.get()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 1) return {};
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr);
  return static_cast<std::int64_t>(shape[0]);
}

/// Datasets whose rows are cells, points and connections; null: none.
struct Layout {
  std::string_view format;
  const char* cells;
  const char* vertices;
  const char* connections;
};

constexpr std::array layouts{
    Layout{"PFLOTRAN grid", "/Domain/Cells/Volumes", nullptr, "/Domain/Connections/Areas"},
    Layout{"open-DARTS arrays", "/volume", nullptr, "/block_m"},
    Layout{"VTKHDF", "/VTKHDF/Types", "/VTKHDF/Points", nullptr},
};

}  // namespace

std::optional<ExportedHdf5> describe_exported_hdf5(const std::string& path) {
  const hdf5::Silence silence;
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file.is_valid()) return {};
  for (const Layout& layout : layouts) {
    const auto rows = [&](const char* name) { return name == nullptr ? Count() : rows_of(file, name); };
    ExportedHdf5 out{layout.format, {rows(layout.cells), {}, rows(layout.vertices), rows(layout.connections)}};
    const bool has_all = out.counts.cells && (layout.vertices == nullptr || out.counts.vertices) &&
                         (layout.connections == nullptr || out.counts.connections);
    if (has_all) return out;
  }
  return {};
}

}  // namespace wellknit
