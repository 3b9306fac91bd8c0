// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Flow in and around a tube: half transmissibilities of its cells and of the transition cells at its side, indices of
/// the cells at the bore (docs/algorithms/flow.md). All from the field of a line sink, with the permeability of the
/// cell whose half it is.
#pragma once

#include "algorithm/assembly.h"
#include "algorithm/line_sink.h"
#include "model/well.h"

namespace wellknit {

/// Radius of the mean pressure of a ring cell between radii inner and outer in radial flow, m:
/// ln r_0 = (r_2^2 ln r_2 - r_1^2 ln r_1) / (r_2^2 - r_1^2) - 1/2.
double mean_pressure_radius(double inner, double outer);

/// One segment and sector of a tube, seen with one permeability. All lengths are those of the space that the tube was
/// made in, which leaves half transmissibilities and indices as they are (metric_space.h).
class TubeSector {
 public:
  /// `k`: permeability tensor in the real space, m2, with net to gross. `bore_radius`: of the round bore, m.
  TubeSector(const Tube& tube, int segment, int sector, const Eigen::Matrix3d& k, double bore_radius);

  /// False: no flow across the bore.
  [[nodiscard]] bool conducts() const { return field_.conductance() > 0.0; }

  /// From the middle of the cell of `ring` to its inner or outer circle, m3.
  [[nodiscard]] double half_to_circle(int ring, int circle) const;
  /// From the middle of the cell of `ring` to the sector's first (0) or second (1) side.
  [[nodiscard]] double half_to_side(int ring, int side) const;
  /// From the outermost circle to a transition cell whose centre is at `offset`, m, from the middle of a face of this
  /// area.
  [[nodiscard]] double half_beyond(const Vec3& area_vector, const Vec3& offset) const;
  /// Of the cell at the bore, over all of the segment's length, m3.
  [[nodiscard]] double well_index(double skin) const;

 private:
  [[nodiscard]] double radius(int circle) const;
  [[nodiscard]] double length(int circle, int side) const;
  [[nodiscard]] double mean_length(int circle) const { return 0.5 * (length(circle, 0) + length(circle, 1)); }
  /// ln rho at a radius in the sector's middle.
  [[nodiscard]] double log_rho(double radius) const { return std::log(std::abs(field_.at(radius * middle_))); }

  const RadialMesh& mesh_;
  const AffineMap& space_;
  bool layered_;
  int segment_;
  int sector_;
  BoreSection section_;
  LineSink field_;
  std::array<Eigen::Vector2d, 2> sides_;  ///< unit directions of the two sides in the section
  Eigen::Vector2d middle_;                ///< unit direction of the sector's middle
  double share_ = 0.0;                    ///< of the flow, as an angle; all sectors make 2 pi
};

/// Connections of a tube's innermost cells over the open measured depths of its well.
std::vector<WellConnection> connect_tube(const Assembly& assembly, const PlacedTube& tube, const Well& well);

/// The part of measured depths [from, to] that is open, m: of the well's open stretches, or of its path where it has
/// none.
double open_length(const Well& well, double from, double to);

}  // namespace wellknit
