// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The sites of the power diagram: a pair on the axis of each boundary face (method.md §8).
///
/// Source: T. Mouton, C. Bennis, H. Borouchaki (key Mouton); J. Flandrin, H. Borouchaki, C. Bennis (key Flandrin); the
/// theorem that such pairs give back every boundary face is in method.md §8.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithm/cavity.h"

namespace wellknit {

/// A weighted point; its power at x is |x - center|^2 - weight.
struct Site {
  Vec3 center = Vec3::Zero();
  double weight = 0.0;
  std::vector<std::int32_t> on_sphere;  ///< cavity vertices where its power is 0, by construction, rising
};

struct Sites {
  std::vector<Site> inner;             ///< one transition cell each
  std::vector<Site> outer;             ///< behind the boundary faces
  std::vector<std::int32_t> inner_of;  ///< per boundary face: its site in inner; faces may share one
  std::vector<std::int32_t> outer_of;  ///< per boundary face: its site in outer; faces may share one
  std::int64_t not_centred = 0;        ///< inner sites outside of their own cells after the last shrinking
};

/// Places the sites: inner ones at the natural distance or a part of t_high, drawn towards their faces until each lies
/// in its own cell; those of one cap stay at one distance. `part` (empty: 1 everywhere): per boundary face, what is
/// taken of the inner site's first distance; it moves vertices of the diagram.
Sites place_sites(const Cavity& cavity, const std::vector<double>& part = {});

}  // namespace wellknit
