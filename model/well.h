// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Wells as the user gives them: a path, its opening to flow, and the options of its radial mesh.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/geometry.h"
#include "model/ids.h"

namespace wellknit {

/// Of a path that was moved into another space (algorithm/metric_space.h): how, and its measured depths before.
struct PathMap {
  AffineMap map{};
  std::vector<double> measured_depth{};  ///< m; empty: nothing was done
};

/// A path in space. Both arrays have one length, 2 or more; measured depth rises strictly.
struct Trajectory {
  std::vector<double> measured_depth;  ///< m
  std::vector<Vec3> points;            ///< (x, y, depth), m, in the grid's frame
  PathMap moved{};
};

/// A stretch of measured depth, m.
struct MeasuredDepthRange {
  double from = 0.0;
  double to = 0.0;
};

/// One cell of a well's COMPDAT record, K range expanded. Only what the deck states is set.
struct DeckCompletion {
  HostCellId cell;
  bool open = true;
  char direction = 'Z';   ///< X, Y or Z
  double diameter = 0.0;  ///< m; 0: not given
  double skin = 0.0;
  std::optional<double> connection_factor;       ///< m3
  std::optional<double> permeability_thickness;  ///< m3 (permeability * length)
};

/// A stretch of the bore opened to flow, as a record of COMPTRAJ states it.
struct Perforation {
  MeasuredDepthRange range;
  bool open = true;
  double diameter = 0.0;  ///< m; 0: not given
  double skin = 0.0;
  std::optional<double> connection_factor;       ///< m3, of the whole stretch
  std::optional<double> permeability_thickness;  ///< m3 (permeability * length)
};

enum class MeshMode { automatic, layered, swept };

/// Radial mesh of one well. Lengths in metres.
struct RadialOptions {
  double drainage_radius = 15.0;  ///< of the outermost ring
  double bore_radius = 0.1;
  int sectors = 10;              ///< at least 3
  int rings = 5;                 ///< at least 1
  std::optional<double> growth;  ///< ratio of successive ring widths; unset: radii in geometric progression
  std::optional<int> segments;   ///< swept: cells along the well; unset: one for about one drainage radius
  MeshMode mode = MeshMode::automatic;
};

enum class WellType { producer, injector };

struct Well {
  std::string name;  ///< of a branch: its well's name, a colon, and the branch as the source calls it ("A-1:2")
  /// Of a branch: the name of the well that it belongs to; empty for a main bore. A branch is a well of its own with
  /// its whole path from where its source begins it, so that whoever does not look at these two needs no other case.
  std::string parent;
  int branch = 1;  ///< 1 for the main bore, 2 and more for the others, in the source's order
  Trajectory trajectory;
  bool approximate_path = false;            ///< a path through cell centres, from COMPDAT or COMPSEGS
  std::vector<MeasuredDepthRange> open;     ///< empty: open over its whole length
  std::vector<DeckCompletion> completions;  ///< from the deck; empty for a trajectory file
  std::vector<Perforation> perforations;    ///< from COMPTRAJ; `open` already follows them
  double skin = 0.0;
  WellType type = WellType::producer;
  std::optional<double> reference_depth;  ///< m, of the bottom-hole pressure
  RadialOptions radial;
};

}  // namespace wellknit
