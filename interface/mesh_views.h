// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A mesh's arrays by the names that they have in the mesh file (docs/formats/hdf5.md), for other languages.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "model/mesh.h"

namespace wellknit {

enum class ElementType : std::uint8_t { float64, int64, int32, uint8 };

/// An array in memory that somebody else owns: `rows` times `columns` numbers, row after row. Ids have 32 bits here,
/// -1 for none.
struct ArrayView {
  const void* data = nullptr;
  std::int64_t rows = 0;
  std::int64_t columns = 1;
  ElementType type = ElementType::float64;
};

/// Views of all arrays of a mesh, which must outlive this and not change. Wells' arrays, which a mesh keeps in another
/// shape, are copied: wells/NAME/trajectory, wells/NAME/connections/cell, …/well_index, …/md.
class MeshViews {
 public:
  explicit MeshViews(const Mesh& mesh);
  MeshViews(const MeshViews&) = delete;
  MeshViews& operator=(const MeshViews&) = delete;

  [[nodiscard]] const std::map<std::string, ArrayView>& all() const { return views_; }
  /// Throws InvalidInput where there is none of this name.
  [[nodiscard]] const ArrayView& named(const std::string& name) const;

 private:
  struct WellArrays {
    std::vector<std::array<double, 4>> trajectory;
    std::vector<CellId> cell;
    std::vector<double> well_index;
    std::vector<std::array<double, 2>> measured_depth;
  };
  void add_well(const MeshWell& well, WellArrays& arrays);

  std::map<std::string, ArrayView> views_;
  std::vector<WellArrays> wells_;
};

}  // namespace wellknit
