// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What flow towards a well does to the transmissibility of a face outside of its tube (method.md §12).
///
/// Two-point transmissibilities take the pressure as linear between two centres. Around a well it is that of a line
/// sink, p = ln rho (line_sink.h). For a face between two centres this p gives the flux F = integral of n.K grad p over
/// the face; the transmissibility that carries just this flux is F over the drop of p. Its ratio to the linear one is
/// the factor here. The idea, taking transmissibilities near wells from the analytical solution, is Ding's (key Ding).
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "algorithm/assembly.h"
#include "algorithm/line_sink.h"
#include "model/well.h"

namespace wellknit {

/// A face and its linear transmissibility in rock of one permeability.
struct LinearFace {
  std::array<Vec3, 2> centers;
  std::span<const Vec3> points;
  const PolygonGeometry& geometry;
  Eigen::Matrix3d permeability;   ///< m2
  double transmissibility = 0.0;  ///< m3
};

/// Cosine of the angle between a face's normal and the line of centres where the permeability measures lengths:
/// A.l / sqrt(A.K A) / sqrt(l.K^-1 l). 1 where K A is along l, and where K cannot be inverted.
double permeability_cosine(const Eigen::Matrix3d& k, const Vec3& area_vector, const Vec3& line);

/// The field of a well as a face near it sees it: ln rho of a line sink.
struct WellField {
  BoreSection section;
  LineSink sink;
  Vec3 foot;          ///< on the well's axis
  double flux = 0.0;  ///< through the face, m3: positive along its area vector when ln rho grows that way

  [[nodiscard]] double at(const Vec3& point) const {
    return std::log(std::abs(sink.at(section.along_axis(point - foot))));
  }
};

class RadialFlow {
 public:
  /// `wells`: those that the tubes' numbers mean; tubes and their meshes must outlive this.
  RadialFlow(const std::vector<PlacedTube>& tubes, const std::vector<Well>& wells);

  /// What it needs to know about a face.
  struct Factor {
    double value = 1.0;
    double radial = 0.0;             ///< how far the flow through the face is the well's, 0 to 1
    std::optional<WellField> field;  ///< of the well; nothing where radial is 0
  };
  /// On a face's linear transmissibility; 1 far from all tubes, between two of them, beyond the ends of the
  /// wells, and where the line of centres runs around the well rather than to it. Between 1/2 and 2.
  [[nodiscard]] Factor factor(const LinearFace& face) const;

 private:
  /// A straight piece of a tube's axis.
  struct Piece {
    Vec3 from;
    Vec3 to;
  };
  struct Box {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());
    void add(const Vec3& p) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    void add(const Box& other) {
      low = low.cwiseMin(other.low);
      high = high.cwiseMax(other.high);
    }
    /// Infinite for an empty box.
    [[nodiscard]] double distance(const Vec3& p) const { return (low - p).cwiseMax(p - high).cwiseMax(0.0).norm(); }
  };
  /// An axis, with what the well goes on beyond the tube. Its boxes are a binary tree over runs of pieces: box n holds
  /// boxes 2 n + 1 and 2 n + 2; the last `leaves` of them hold run_length pieces each, in order.
  struct Axis {
    const Tube* tube = nullptr;
    double bore_radius = 0.0;  ///< m
    std::vector<Piece> pieces;
    std::vector<Box> boxes;
    std::size_t leaves = 1;  ///< a power of two; those beyond the pieces are empty
  };
  /// Foot of the perpendicular on the nearest axis.
  struct Nearest {
    const Axis* axis = nullptr;
    Vec3 foot = Vec3::Zero();
    Vec3 along = Vec3::Zero();                                       ///< of the piece
    double distance = std::numeric_limits<double>::infinity();       ///< m
    double next_distance = std::numeric_limits<double>::infinity();  ///< to the nearest of another well, m
    bool is_beyond_end = false;
  };

  static Axis axis_of(const Tube& tube, const Well& well);
  /// Of pieces nearer than `most`; an infinite distance where there are none.
  static Nearest nearest_on(const Axis& axis, const Vec3& point, double most);
  static void look_below(const Axis& axis, std::size_t box, const Vec3& point, std::size_t& best, Nearest& out);
  static void look_at_run(const Axis& axis, std::size_t run, const Vec3& point, std::size_t& best, Nearest& out);
  [[nodiscard]] Nearest nearest_axis(const Vec3& point) const;

  static constexpr std::size_t run_length = 8;

  std::vector<Axis> axes_;
};

}  // namespace wellknit
