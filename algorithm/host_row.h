// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// One row of columns of the host, column by column: a cell's neighbours along k are beside it in memory, while in the
/// source they are a layer apart.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algorithm/host_face_writer.h"
#include "algorithm/host_mesh.h"

namespace wellknit {

/// Eight corners of the cells of one column, place by place.
class ColumnCorners {
 public:
  ColumnCorners(const HostCorners& corners, const IdVector<VertexId, Vec3>& nodes, std::int64_t i, std::int64_t j) {
    for (int c = 0; c < 4; ++c) {
      const auto at = static_cast<std::size_t>(c);
      rank_[at] = corners.on_pillar(i + corners.dimensions[0] * j, c);
      node_[at] = &nodes.raw()[corners.first[corners.pillar(i, j, c)].index()];
    }
  }
  /// Of the upper (0) or lower (1) level of a place.
  [[nodiscard]] const Vec3& at(int corner, std::int64_t place, int lower) const {
    const auto c = static_cast<std::size_t>(corner);
    return node_[c][rank_[c][2 * place + lower]];
  }
  /// In the order of depths: tops at 0 … 3, bases at 4 … 7.
  [[nodiscard]] std::array<Vec3, 8> corners(std::int64_t place) const {
    return {at(0, place, 0), at(1, place, 0), at(2, place, 0), at(3, place, 0),
            at(0, place, 1), at(1, place, 1), at(2, place, 1), at(3, place, 1)};
  }
  [[nodiscard]] std::int32_t rank(int corner, std::int64_t level) const {
    return rank_[static_cast<std::size_t>(corner)][level];
  }
  /// False: top and base coincide on all four pillars.
  [[nodiscard]] bool has_thickness(std::int64_t place) const {
    return rank(0, 2 * place) != rank(0, 2 * place + 1) || rank(1, 2 * place) != rank(1, 2 * place + 1) ||
           rank(2, 2 * place) != rank(2, 2 * place + 1) || rank(3, 2 * place) != rank(3, 2 * place + 1);
  }

 private:
  std::array<const std::int32_t*, 4> rank_{};
  std::array<const Vec3*, 4> node_{};
};

/// Values of a row of cells, i + nx j for each layer in the source, and place by place here.
template <class T>
class RowValues {
 public:
  void resize(const HostCorners& corners) {
    // Odd, since a power of two would put all columns into the same few lines of the cache.
    stride_ = corners.dimensions[2] | 1;
    values_.resize(static_cast<std::size_t>(corners.dimensions[0] * stride_));
  }
  [[nodiscard]] T* column(std::int64_t i) { return values_.data() + i * stride_; }
  [[nodiscard]] const T* column(std::int64_t i) const { return values_.data() + i * stride_; }

  /// `all` has an element for each source cell.
  template <class Array>
  void read(const HostCorners& corners, std::int64_t j, const Array& all) {
    resize(corners);
    const auto [nx, ny, nz] = corners.dimensions;
    for (std::int64_t place = 0; place < nz; ++place) {
      const auto* from = all.data() + nx * (j + ny * corners.layer(place));
      T* to = values_.data() + place;
      for (std::int64_t i = 0; i < nx; ++i, to += stride_) *to = from[i];
    }
  }
  template <class Array>
  void write(const HostCorners& corners, std::int64_t j, Array& all) const {
    const auto [nx, ny, nz] = corners.dimensions;
    for (std::int64_t place = 0; place < nz; ++place) {
      auto* to = all.data() + nx * (j + ny * corners.layer(place));
      const T* from = values_.data() + place;
      for (std::int64_t i = 0; i < nx; ++i, from += stride_) to[i] = *from;
    }
  }

 private:
  std::int64_t stride_ = 0;
  std::vector<T> values_;
};

/// What the faces need of a row's cells.
class HostRow {
 public:
  /// `states` has an element for each source cell.
  void read(const CornerPointGrid& grid, const HostCorners& corners, const IdVector<VertexId, Vec3>& nodes,
            const std::vector<HostCellState>& states, std::int64_t j);
  /// With the row's states and conductances, which must outlive it.
  [[nodiscard]] HostColumn column(std::int64_t i) const;

 private:
  void read_conductances(const CornerPointGrid& grid, const HostCorners& corners, const IdVector<VertexId, Vec3>& nodes,
                         std::int64_t j);

  std::int64_t first_cell_ = 0;
  std::int64_t cell_step_ = 0;
  RowValues<HostCellState> state_;
  RowValues<double> net_to_gross_;
  std::array<RowValues<double>, 3> permeability_;
  RowValues<std::array<Vec3, 3>> conductance_;
  bool has_conductance_ = false;
};

}  // namespace wellknit
