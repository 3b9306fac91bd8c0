// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Topological adjustment of the power diagram (method.md §9): short edges are expanded by moving sites along their
/// axes.
///
/// Source: J. Flandrin, H. Borouchaki, C. Bennis (key Flandrin). Moving a site keeps every cell orthogonal and planar
/// in E_ref, where collapsing an edge would not.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "algorithm/power_diagram.h"

namespace wellknit {

/// Sites and their diagram, with its comparison to the boundary.
struct DiagramTrial {
  Sites sites;
  PowerDiagram diagram;
  BoundaryMatch match;

  /// All sites centred, every boundary face found as the same vertex set, the cavity filled.
  [[nodiscard]] bool is_sound(const Cavity& cavity) const { return fault(cavity).empty(); }
  /// What of it does not hold; empty when all does.
  [[nodiscard]] std::string fault(const Cavity& cavity) const;
};

DiagramTrial try_diagram(const Cavity& cavity, const std::vector<double>& part);

/// Edges of the diagram shorter than `limit` (m, in E_ref) that are not edges of the boundary, as vertex pairs, each
/// once, rising.
std::vector<std::array<std::int32_t, 2>> short_edges(const Cavity& cavity, const PowerDiagram& diagram, double limit);

struct AdjustmentReport {
  std::int64_t short_before = 0;
  std::int64_t short_after = 0;
};

/// Draws sites at the ends of short edges a little towards their faces, and keeps what has fewer short edges and stays
/// sound. A few rounds; the trial given when nothing helps.
DiagramTrial expand_short_edges(const Cavity& cavity, DiagramTrial trial, AdjustmentReport& report);

}  // namespace wellknit
