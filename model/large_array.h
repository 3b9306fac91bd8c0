// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Arrays of millions of elements: a std::vector whose memory comes in huge pages and is not cleared first.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace wellknit {

/// The first touch of fresh small pages costs up to half of a pass over an array (docs/performance.md).
template <class T>
class LargeAllocator {
 public:
  using value_type = T;

  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>& /*other*/) {}  // NOLINT(google-explicit-constructor): an allocator's duty

  [[nodiscard]] T* allocate(std::size_t count) {
    if (count > std::numeric_limits<std::size_t>::max() / (2 * sizeof(T))) throw std::bad_array_new_length();
    const std::size_t bytes = count * sizeof(T);
    if (bytes < least_bytes) return static_cast<T*>(::operator new(bytes));
    const std::size_t whole_pages = (bytes + page_bytes - 1) / page_bytes * page_bytes;
    void* const memory = std::aligned_alloc(page_bytes, whole_pages);
    if (memory == nullptr) throw std::bad_alloc();
    ::madvise(memory, whole_pages, MADV_HUGEPAGE);  // advice only: where it is not taken nothing changes
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) noexcept {
    if (count * sizeof(T) < least_bytes)
      ::operator delete(memory);
    else
      std::free(memory);
  }
  /// resize(n) leaves numbers as they are in memory; resize(n, value) sets them.
  template <class U>
  void construct(U* place) noexcept(noexcept(U{})) {
    ::new (static_cast<void*>(place)) U;
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    std::construct_at(place, std::forward<Arguments>(arguments)...);
  }

  friend bool operator==(LargeAllocator /*one*/, LargeAllocator /*other*/) { return true; }

 private:
  static constexpr std::size_t page_bytes = std::size_t{2} << 20;
  static constexpr std::size_t least_bytes = 2 * page_bytes;
};

template <class T>
using LargeArray = std::vector<T, LargeAllocator<T>>;

}  // namespace wellknit
