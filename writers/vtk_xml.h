// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// VTK's XML files with one raw appended block: arrays, and the frame around them. Points are (x, y, -depth): z up.
#pragma once

#include <fmt/format.h>

#include <cstdint>
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

/// The XML head with its DataArray elements, and the raw block that they point into.
class AppendedArrays {
 public:
  /// One row per point or cell, of `components` numbers.
  template <class Array>
  std::string element(std::string_view name, const Array& values, int components = 1) {
    using T = typename Array::value_type;
    std::string escaped;
    for (const char c : name)
      escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
    const std::string xml = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
        vtk_type<T>(), escaped, components, block_.size());
    const std::uint64_t bytes = values.size() * sizeof(T);
    append(&bytes, sizeof bytes);
    append(values.data(), bytes);
    return xml;
  }
  [[nodiscard]] const std::string& block() const { return block_; }

 private:
  void append(const void* data, std::size_t bytes) {
    if (bytes > 0) block_.append(static_cast<const char*>(data), bytes);
  }
  std::string block_;
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
