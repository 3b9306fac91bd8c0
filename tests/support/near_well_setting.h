// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// All that a tube or a cavity is built in, for tests of one step.
#pragma once

#include <stdexcept>
#include <variant>

#include "algorithm/cavity.h"
#include "algorithm/well_tube.h"

namespace wellknit::near_well {

struct Setting {
  CornerPointGrid grid;
  HostMesh host;
  CellLocator locator;
  NearWellGrid near;
  ReferenceSpace space;
  Obstacles obstacles;

  explicit Setting(const CornerPointGrid& source, LatticePoint parts = {1, 1})
      : Setting(source, parts, source_layers(source.dimensions[2])) {}
  Setting(const CornerPointGrid& source, LatticePoint parts, const ColumnLayers& layers)
      : grid(source),
        host(build_host_mesh(grid)),
        locator(grid),
        near(grid, host, locator, parts, layers),
        space(near, CellRange{{0, 0, 0}, grid.dimensions}),
        obstacles(near, space, CellRange{{0, 0, 0}, grid.dimensions}) {}
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;
  ~Setting() = default;

  static ColumnLayers source_layers(std::int64_t places) {
    ColumnLayers layers;
    for (std::int64_t p = 0; p < places; ++p) layers.cells.push_back({{p, 0.0}, {p, 1.0}});
    return layers;
  }

  [[nodiscard]] HostFrame frame() const { return {near, space}; }
  [[nodiscard]] std::vector<MeasuredDepthRange> stretches(const Well& well, const Gaps& gaps = {}) const {
    return clear_stretches(frame(), well, path_in_reference(frame(), well), obstacles, {}, gaps);
  }
  /// Swept: along the first clear stretch.
  [[nodiscard]] TubeOrReason try_tube(const Well& well, bool layered) const {
    if (layered) return build_layered_tube(frame(), well, path_in_reference(frame(), well), obstacles);
    const auto clear = stretches(well);
    if (clear.empty()) return NoTube{"no clear stretch"};
    return build_swept_tube(frame(), well, clear.front());
  }
  [[nodiscard]] Tube tube(const Well& well, bool layered) const {
    auto made = try_tube(well, layered);
    if (auto* none = std::get_if<NoTube>(&made)) throw std::runtime_error(none->reason);
    return std::get<Tube>(std::move(made));
  }
  [[nodiscard]] Cavity cavity(const Tube& tube, const CavityOptions& options = {}) const {
    auto made = build_cavity(frame(), {tube}, options);
    if (auto* none = std::get_if<NoCavity>(&made)) throw std::runtime_error(none->reason);
    return std::get<Cavity>(std::move(made));
  }
};

}  // namespace wellknit::near_well
