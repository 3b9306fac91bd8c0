// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Arrays of an Eclipse output file, made by hand.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace wellknit::ecl {

/// Four or eight bytes, the most significant first.
template <class Number>
std::string big_endian(Number value) {
  std::string out(sizeof value, '\0');
  std::memcpy(out.data(), &value, sizeof value);
  return {out.rbegin(), out.rend()};
}

inline std::string framed(const std::string& block) {
  const std::string size = big_endian(static_cast<std::int32_t>(block.size()));
  return size + block + size;
}

inline std::string header(const std::string& name, std::int32_t count, const std::string& type) {
  return framed((name + "        ").substr(0, 8) + big_endian(count) + type);
}

/// Blocks of at most so many values.
template <class Number>
std::string array(const std::string& name, const std::string& type, const std::vector<Number>& values,
                  std::size_t block = 1000) {
  std::string out = header(name, static_cast<std::int32_t>(values.size()), type);
  for (std::size_t first = 0; first < values.size(); first += block) {
    std::string bytes;
    for (std::size_t n = first; n < values.size() && n < first + block; ++n) bytes += big_endian(values[n]);
    out += framed(bytes);
  }
  return out;
}

inline std::string inte(const std::string& name, const std::vector<std::int32_t>& v) { return array(name, "INTE", v); }
inline std::string real(const std::string& name, const std::vector<float>& v) { return array(name, "REAL", v); }

inline std::string text(const std::string& name, const std::vector<std::string>& values, std::size_t width = 8) {
  const std::string type = width == 8 ? "CHAR" : "C0" + std::to_string(width);
  std::string out = header(name, static_cast<std::int32_t>(values.size()), type);
  std::string bytes;
  for (const std::string& value : values) bytes += (value + std::string(width, ' ')).substr(0, width);
  return values.empty() ? out : out + framed(bytes);
}

/// Heads of a grid of this many cells: corner points, one medium, no refinement.
inline std::vector<std::int32_t> file_head() { return std::vector<std::int32_t>(100, 0); }
inline std::vector<std::int32_t> grid_head(std::int32_t nx, std::int32_t ny, std::int32_t nz) {
  std::vector<std::int32_t> out(100, 0);
  out[0] = 1;
  out[1] = nx;
  out[2] = ny;
  out[3] = nz;
  out[24] = 1;
  return out;
}

/// Two boxes side by side along x, 1 m each, depth 0 to 1 m.
inline std::vector<float> two_coord() {
  std::vector<float> out;
  for (int j = 0; j <= 1; ++j)
    for (int i = 0; i <= 2; ++i)
      for (const float z : {0.0F, 1.0F}) out.insert(out.end(), {static_cast<float>(i), static_cast<float>(j), z});
  return out;
}
inline std::vector<float> two_zcorn() {
  std::vector<float> out(16, 0.0F);
  for (std::size_t n = 8; n < 16; ++n) out[n] = 1.0F;
  return out;
}
inline std::string two_heads() { return inte("FILEHEAD", file_head()) + inte("GRIDHEAD", grid_head(2, 1, 1)); }
inline std::string two_boxes() { return two_heads() + real("COORD", two_coord()) + real("ZCORN", two_zcorn()); }

}  // namespace wellknit::ecl
