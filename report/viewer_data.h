// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The mesh for the picture: arrays as script elements, shuffled, deflated and in base64, which report/assets/arrays.js
/// undoes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "model/mesh.h"

namespace wellknit {

struct ViewerData {
  std::string html;                   ///< the script elements, their list among them
  std::vector<std::string> left_out;  ///< names of cell arrays beyond the budget
};

/// Geometry, wells, and every array of the cells: kind, quality, geometry, rock, properties, pressure. `budget` is in
/// bytes before packing; the geometry is always there. The same mesh gives the same bytes.
ViewerData viewer_data(const Mesh& mesh, std::size_t budget);

}  // namespace wellknit
