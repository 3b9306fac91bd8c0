// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// A column of corner-point cells as a continuous shape: what refined columns are cut from.
///
/// Between the four pillars of a column, (1-s)(1-t) p00(z) + s(1-t) p10(z) + (1-s)t p01(z) + s t p11(z) is again a
/// straight line in depth z, and a horizon's depth is bilinear in (s, t). A refined column therefore is a corner-point
/// column itself; on a side of the column both come from the side's two pillars alone, so that neighbours agree.
#pragma once

#include <array>
#include <cstdint>

#include "algorithm/host_mesh.h"
#include "model/corner_point_grid.h"

namespace wellknit {

/// A level of a column: `fraction` of the way from the upper to the lower horizon of the cell at `place`. Places count
/// the cells of a column downwards from 0, whichever way the layers are numbered (HostCorners::layer).
struct ColumnLevel {
  std::int64_t place = 0;
  double fraction = 0.0;

  friend bool operator==(const ColumnLevel&, const ColumnLevel&) = default;
};

class ColumnShape {
 public:
  /// Of source column (i, j). The corners are the host's: in order of depth, as the simulators take them.
  ColumnShape(const CornerPointGrid& grid, const HostMesh& host, std::int64_t i, std::int64_t j);

  /// Depth of a level at (s, t) of the column, each in [0, 1]: bilinear.
  [[nodiscard]] double depth(double s, double t, const ColumnLevel& level) const;
  /// The point at a depth on the line at (s, t).
  [[nodiscard]] Vec3 on_line(double s, double t, double depth) const;
  [[nodiscard]] Vec3 point(double s, double t, const ColumnLevel& level) const {
    return on_line(s, t, depth(s, t, level));
  }

 private:
  const CornerPointGrid& grid_;
  const HostMesh& host_;
  std::int64_t i_;
  std::int64_t j_;
};

}  // namespace wellknit
