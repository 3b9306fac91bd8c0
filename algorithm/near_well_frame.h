// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The cells, the reference space and the obstacles that a cluster is meshed in.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "algorithm/obstacles.h"
#include "algorithm/reference_space.h"
#include "algorithm/well_piece.h"
#include "algorithm/well_tube.h"

namespace wellknit {

struct NearWellFrame {
  std::shared_ptr<const NearWellGrid> grid;
  std::unique_ptr<ReferenceSpace> space;
  CellRange region;
  std::unique_ptr<Obstacles> obstacles;

  [[nodiscard]] HostFrame host() const { return {*grid, *space}; }
};

/// In cells that fit the pieces, or in those given.
NearWellFrame near_well_frame(const WellTask& task, const std::vector<Piece>& pieces,
                              const std::optional<std::pair<LatticePoint, ColumnLayers>>& cells = {});

/// Layers merged and split for these pieces.
ColumnLayers layers_of(const WellTask& task, const std::vector<Piece>& pieces);

}  // namespace wellknit
