// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Index types: a face cannot index cells. All are 0-based. They take 32 bits in memory; a grid has at most max_cells
/// cells, and what is made of it is checked against max_ids.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "model/large_array.h"

namespace wellknit {

/// An index into arrays of one kind of entity. A default-made one is "none".
template <class Tag>
class Id {
 public:
  constexpr Id() = default;
  constexpr explicit Id(std::int64_t value) : value_(static_cast<std::int32_t>(value)) {}
  constexpr explicit Id(std::size_t value) : value_(static_cast<std::int32_t>(value)) {}
  constexpr explicit Id(int value) : value_(value) {}

  [[nodiscard]] constexpr std::int64_t value() const { return value_; }
  [[nodiscard]] constexpr std::size_t index() const { return static_cast<std::size_t>(value_); }
  [[nodiscard]] constexpr bool is_valid() const { return value_ >= 0; }

  friend constexpr auto operator<=>(Id, Id) = default;

 private:
  std::int32_t value_ = -1;
};

using VertexId = Id<struct VertexTag>;
using FaceId = Id<struct FaceTag>;
using CellId = Id<struct CellTag>;          ///< cell of the mesh
using HostCellId = Id<struct HostCellTag>;  ///< corner-point cell i + nx (j + ny k)
using ConnectionId = Id<struct ConnectionTag>;
using WellId = Id<struct WellTag>;

/// The most entities of one kind that ids can name.
inline constexpr std::int64_t max_ids = std::numeric_limits<std::int32_t>::max();
/// The most cells of a source grid: with some eight vertices a cell in the worst case ids still suffice.
inline constexpr std::int64_t max_cells = 250'000'000;

/// What stands on the other side of a face of the outer boundary.
inline constexpr CellId no_cell{};

/// An array that only its own kind of id can index.
template <class IdType, class T>
class IdVector {
 public:
  IdVector() = default;
  explicit IdVector(std::size_t size, const T& value = T{}) : data_(size, value) {}

  [[nodiscard]] std::size_t size() const { return data_.size(); }
  [[nodiscard]] bool empty() const { return data_.empty(); }
  void reserve(std::size_t size) { data_.reserve(size); }
  void resize(std::size_t size, const T& value = T{}) { data_.resize(size, value); }
  IdType push_back(T value) {
    data_.push_back(std::move(value));
    return IdType(data_.size() - 1);
  }
  T& operator[](IdType id) { return data_[id.index()]; }
  const T& operator[](IdType id) const { return data_[id.index()]; }
  auto begin() { return data_.begin(); }
  auto end() { return data_.end(); }
  [[nodiscard]] auto begin() const { return data_.begin(); }
  [[nodiscard]] auto end() const { return data_.end(); }
  /// The plain array, for writers and loops over everything.
  [[nodiscard]] const LargeArray<T>& raw() const { return data_; }
  [[nodiscard]] LargeArray<T>& raw() { return data_; }

 private:
  LargeArray<T> data_;
};

}  // namespace wellknit
