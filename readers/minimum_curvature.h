// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The path of a directional survey by the minimum curvature method: between two stations the bore is an arc of a
/// circle that leaves one and enters the other along the measured directions.
///
/// S. J. Sawaryn and J. L. Thorogood, A compendium of directional calculations based on the minimum curvature method,
/// 2005 [Sawaryn2005 in docs/references.bib].
#pragma once

#include <span>
#include <vector>

#include "model/geometry.h"

namespace wellknit {

struct SurveyStation {
  double measured_depth = 0.0;  ///< m
  double inclination = 0.0;     ///< rad from the vertical, 0 down
  double azimuth = 0.0;         ///< rad from the y axis (grid north) towards x (east)
};

struct SurveyPoint {
  double measured_depth = 0.0;  ///< m
  Vec3 point = Vec3::Zero();    ///< (x, y, depth), m
  std::size_t station = 0;      ///< the survey's station here, or the one that the arc through this point leads to
};

/// Unit vector (x, y, depth) along the bore.
Vec3 direction_of(const SurveyStation& station);

/// Angle between the directions of two stations, rad, 0 to pi.
double dogleg(const SurveyStation& from, const SurveyStation& to);

/// Largest turn between two points that follow each other, rad (5 degrees): a chord then leaves its arc by at most a
/// thousandth of the radius.
inline constexpr double largest_turn = 0.0872664625997164788;

/// The path from `start`, the place of the first station. Points are put into arcs so that none of its chords turns by
/// more than largest_turn. Measured depth must rise and no dogleg reach pi.
std::vector<SurveyPoint> minimum_curvature(std::span<const SurveyStation> stations, const Vec3& start);

}  // namespace wellknit
