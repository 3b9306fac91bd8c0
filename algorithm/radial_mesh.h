// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The radial mesh of one well (method.md §3): rings of N points around the path, one ring set a station.
///
/// Source: T. Mouton, C. Bennis, H. Borouchaki (key Mouton); the reflection sweep is our own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/geometry.h"
#include "model/well.h"

namespace wellknit {

/// An orthonormal frame at a station: e1, e2, normal make a right-handed triple.
struct RingFrame {
  Vec3 center;
  Vec3 normal;
  Vec3 e1;
  Vec3 e2;
};

/// The points of the rings, in the real or the reference space.
struct RadialMesh {
  int segments = 0;  ///< along the well; stations are segments + 1
  int sectors = 0;
  int rings = 0;                       ///< cells from bore to drainage radius; circles are rings + 1
  std::vector<Vec3> points;            ///< at (station * (rings + 1) + circle) * sectors + sector
  std::vector<Vec3> axis;              ///< stations, segments + 1
  std::vector<double> measured_depth;  ///< of the stations, m

  [[nodiscard]] int stations() const { return segments + 1; }
  [[nodiscard]] std::size_t point_index(int station, int circle, int sector) const {
    return static_cast<std::size_t>((station * (rings + 1) + circle) * sectors + sector % sectors);
  }
  [[nodiscard]] const Vec3& point(int station, int circle, int sector) const {
    return points[point_index(station, circle, sector)];
  }
};

/// Radii of the rings + 1 circles, bore first, m. With options.growth the widths of the rings grow by that factor,
/// without it the radii are in geometric progression. Throws InvalidInput for radii, counts or a growth that make no
/// rings.
std::vector<double> circle_radii(const RadialOptions& options);
/// How many of these rings go into a tube of a smaller radius: that of the circle that is nearest to it, by ratio. The
/// smaller tube's rings then grow about as those of the larger one. At least 1.
int rings_within(const RadialOptions& options, double smaller_radius);

/// Frames along the stations: frame k+1 is the mirror image of frame k in the perpendicular bisector plane of their
/// chord, so that all lateral faces are isosceles trapezoids and the frame does not twist. The first normal is the one
/// that makes the sum of |normal - tangent|^2 smallest. Two or more stations; tangents point forwards, any length.
std::vector<RingFrame> sweep_frames(std::span<const Vec3> stations, std::span<const Vec3> tangents);

/// Largest angle between a frame's normal and the tangent, radians.
double largest_tilt(std::span<const RingFrame> frames, std::span<const Vec3> tangents);

/// Tangents of a polyline by central differences.
std::vector<Vec3> polyline_tangents(std::span<const Vec3> stations);

/// Stations moved as little as possible so that second differences get small: argmin |p - p0|^2 + weight |D2 p|^2.
std::vector<Vec3> smoothed_stations(std::span<const Vec3> stations, double weight);

/// Circles of these radii around the frames, the first point at `start_angle` from e1 towards e2.
RadialMesh sweep_rings(std::span<const RingFrame> frames, std::span<const double> radii, int sectors,
                       double start_angle);

/// Smallest ratio, over segments and sectors, of the outermost circle's edge along the well to the axis' edge: 1 - R /
/// (radius of curvature) in a bend, negative where rings cross. `station` (optional) gets the segment where it occurs.
double smallest_lateral_ratio(const RadialMesh& mesh, int* station = nullptr);

}  // namespace wellknit
