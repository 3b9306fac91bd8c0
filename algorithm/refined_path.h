// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A trajectory's way through refined cells.
#pragma once

#include <vector>

#include "algorithm/cell_path.h"
#include "algorithm/host_mesh.h"

namespace wellknit {

/// Parts in host cells, each in one source cell as well.
struct HostPath {
  std::vector<CellPart> parts;
  std::vector<HostCellId> source;  ///< of each part
};

/// Cuts parts in refined source cells at the refined cells' sides; the others stay as they are. A stretch that no
/// refined cell holds keeps the source cell. Ends are exact to about a thousandth of the refined cell's size.
HostPath split_at_refined(const CornerPointGrid& grid, const HostMesh& host, const std::vector<CellPart>& parts);

}  // namespace wellknit
