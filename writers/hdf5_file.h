// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// An HDF5 file of groups, arrays, strings and attributes, without times: the same content gives the same bytes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/hdf5_layout.h"

namespace wellknit {

/// A file under construction. Every call that fails throws WriteError. An hdf5::Silence must live as long.
class Hdf5File {
 public:
  /// `file` is where it goes; `shown_path` stands in messages.
  Hdf5File(const std::string& file, std::string shown_path);

  void group(const std::string& path);

  /// One row for each element, as hdf5::element() lays it out; groups on the way must be there.
  template <class Array>
  void array(const std::string& path, const Array& values) {
    const hdf5::Element layout = hdf5::element(values.data());
    const std::array<hsize_t, 2> shape{values.size(), layout.columns};
    array_data(path, layout, std::span(shape).first(layout.columns == 1 ? 1 : 2),
               values.empty() ? nullptr : static_cast<const void*>(values.data()));
  }

  void strings(const std::string& path, const std::vector<std::string>& values);

  void attribute(const std::string& object, const std::string& name, const std::string& value);
  void attribute(const std::string& object, const std::string& name, double value);
  void attribute(const std::string& object, const std::string& name, std::span<const double> values);
  void attribute(const std::string& object, const std::string& name, std::span<const std::int64_t> values);
  /// Rows of `columns` strings.
  void attribute(const std::string& object, const std::string& name, const std::vector<std::string>& values,
                 hsize_t columns);

  void finish();

 private:
  [[noreturn]] void fail(const std::string& what) const;
  void need(hid_t status, const std::string& what) const;
  [[nodiscard]] hdf5::Handle create(const std::string& file) const;
  [[nodiscard]] hdf5::Handle dataset(const std::string& path, hid_t type, std::span<const hsize_t> shape) const;
  /// No data: an empty array.
  void array_data(const std::string& path, const hdf5::Element& layout, std::span<const hsize_t> shape,
                  const void* data) const;
  /// An empty shape makes a scalar.
  void attribute_data(const std::string& object, const std::string& name, hid_t file_type, hid_t memory_type,
                      std::span<const hsize_t> shape, const void* data) const;

  std::string target_;
  hdf5::Handle group_properties_;
  hdf5::Handle dataset_properties_;
  hdf5::Handle file_;
};

}  // namespace wellknit
