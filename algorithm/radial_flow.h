// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What radial flow towards a well does to the transmissibility of a face of the transition mesh (method.md §12).
///
/// Two-point transmissibilities take the pressure as linear between two centres. Around a well it is linear in ln r.
/// For a face between centres at distances r_1 and r_2 from the well's axis, p = ln r gives the flux F = integral of
/// grad p . n over the face, and the transmissibility that carries just this flux is k F / (ln r_2 - ln r_1). Its ratio
/// to the linear one is the factor here. The idea, taking transmissibilities near wells from the analytical solution,
/// is Ding's (key Ding).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithm/assembly.h"

namespace wellknit {

class RadialFlow {
 public:
  /// `assembly` must outlive this.
  explicit RadialFlow(const Assembly& assembly);

  /// Factor on the linear transmissibility of a face between two transition cells; 1 far from all tubes, between two of
  /// them, beyond their ends, and where the line of centres runs around the well rather than to it. Between 1/2 and 2.
  [[nodiscard]] double factor(CellId first, CellId second, std::span<const Vec3> face) const;

 private:
  /// A straight piece of a tube's axis.
  struct Piece {
    Vec3 from;
    Vec3 to;
  };
  /// Foot of the perpendicular on the nearest tube's axis.
  struct Nearest {
    Vec3 foot = Vec3::Zero();
    double distance = 0.0;       ///< m
    double next_distance = 0.0;  ///< to the second nearest tube, m; infinite for a lone one
    bool is_beyond_end = false;
  };

  [[nodiscard]] Nearest nearest_axis(std::size_t cavity, const Vec3& point) const;

  const Assembly& assembly_;
  std::vector<std::vector<std::vector<Piece>>> axes_;  ///< per cavity, per tube
};

}  // namespace wellknit
