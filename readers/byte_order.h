// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Numbers of a binary file in either byte order.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace wellknit {

/// The number of 4 or 8 bytes that begins here.
template <class Raw>
Raw load_number(const char* from, bool is_swapped) {
  std::conditional_t<sizeof(Raw) == 8, std::uint64_t, std::uint32_t> bits = 0;
  static_assert(sizeof bits == sizeof(Raw));
  std::memcpy(&bits, from, sizeof bits);
  if (is_swapped) {
    if constexpr (sizeof(Raw) == 8)
      bits = __builtin_bswap64(bits);
    else
      bits = __builtin_bswap32(bits);
  }
  return std::bit_cast<Raw>(bits);
}

/// Numbers that stand side by side. Plain loops: compilers make vector instructions of them.
template <class Raw, class T>
void load_numbers(const char* from, std::size_t count, bool is_swapped, T* to) {
  if (is_swapped)
    for (std::size_t n = 0; n < count; ++n) to[n] = static_cast<T>(load_number<Raw>(from + n * sizeof(Raw), true));
  else
    for (std::size_t n = 0; n < count; ++n) to[n] = static_cast<T>(load_number<Raw>(from + n * sizeof(Raw), false));
}

}  // namespace wellknit
