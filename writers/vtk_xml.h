// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// VTK's XML files with one raw appended block: arrays, and the frame around them. Points are (x, y, -depth): z up.
#pragma once

#include <cstdint>
#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "model/geometry.h"
#include "writers/output_file.h"

namespace wellknit {

template <class T>
constexpr std::string_view vtk_type() {
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
  if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
}

/// The DataArray elements of a file, and the raw block that they point into, array by array. Only one of those that
/// are made for the file is in memory at a time, while it is written.
class AppendedArrays {
 public:
  /// One row per point or cell, of `components` numbers. The array must live until the file is written.
  template <class Array>
  std::string element(std::string_view name, const Array& values, int components = 1) {
    using T = typename Array::value_type;
    return add(name, vtk_type<T>(), components, values.size() * sizeof(T), [array = &values](std::ostream& out) {
      out.write(reinterpret_cast<const char*>(array->data()), static_cast<std::streamsize>(array->size() * sizeof(T)));
    });
  }
  template <class Array>
  std::string element(std::string_view name, const Array&& values, int components = 1) = delete;

  /// The same of `rows` rows that `make()` gives when they are written, as an array of numbers. What it looks at must
  /// live until then.
  template <class Make>
  std::string made_element(std::string_view name, std::size_t rows, const Make& make, int components = 1) {
    using T = typename decltype(make())::value_type;
    return add(name, vtk_type<T>(), components, rows * static_cast<std::size_t>(components) * sizeof(T),
               [make](std::ostream& out) {
                 const auto values = make();
                 out.write(reinterpret_cast<const char*>(values.data()),
                           static_cast<std::streamsize>(values.size() * sizeof(T)));
               });
  }

  void write(std::ostream& out) const;

 private:
  using WriteData = std::function<void(std::ostream&)>;
  std::string add(std::string_view name, std::string_view type, int components, std::uint64_t bytes, WriteData data);

  struct Entry {
    std::uint64_t bytes;
    WriteData write;
  };
  std::vector<Entry> entries_;
  std::uint64_t size_ = 0;  ///< of the block so far
};

inline double up(double depth) { return depth == 0.0 ? 0.0 : -depth; }  // no negative zero

inline std::vector<double> flat_points(std::span<const Vec3> points) {
  std::vector<double> out;
  out.reserve(3 * points.size());
  for (const Vec3& p : points) out.insert(out.end(), {p.x(), p.y(), up(p.z())});
  return out;
}

inline std::vector<double> flat(std::span<const Vec3> values) {
  std::vector<double> out;
  out.reserve(3 * values.size());
  for (const Vec3& v : values) out.insert(out.end(), {v.x(), v.y(), v.z()});
  return out;
}

template <class Array, class Function>
auto mapped(const Array& values, Function function) {
  std::vector<decltype(function(values.front()))> out;
  out.reserve(values.size());
  for (const auto& v : values) out.push_back(function(v));
  return out;
}

/// A whole file of one kind, "UnstructuredGrid" or "PolyData". `pieces` is what stands inside of its element.
/// Version 1.0 with 64-bit headers: what every VTK since 5.10 reads, polyhedra in their legacy arrays included.
void write_vtk_file(OutputStream& out, std::string_view kind, const std::string& pieces, const AppendedArrays& arrays);

}  // namespace wellknit
