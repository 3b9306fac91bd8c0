// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <fmt/format.h>

#include <array>

#include "model/worst_cells.h"
#include "report/html.h"
#include "report/sections.h"

namespace wellknit {

namespace {

constexpr std::size_t made_shown = 5;  // in each measure
constexpr std::size_t host_shown = 1;

std::string_view title_of(CellKind kind) {
  static constexpr std::array<std::string_view, 4> names{"host", "refined", "transition", "radial"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view title_of(FaceMeasure measure) {
  static constexpr std::array<std::string_view, face_measure_count> names{"non-orthogonality", "K-orthogonality",
                                                                          "planarity", "centring"};
  return names[static_cast<std::size_t>(measure)];
}

/// Whose cell it is: the well of a radial cell, or the source cell (i, j, k) of a host cell, 1-based.
std::string owner(const Mesh& mesh, CellId cell) {
  const WellId well = mesh.cells.well[cell];
  if (well.is_valid()) return escaped(mesh.wells[well].name);
  const HostCellId source = mesh.cells.source_cell[cell];
  const std::int64_t nx = mesh.source_dimensions[0];
  const std::int64_t ny = mesh.source_dimensions[1];
  if (!source.is_valid() || nx < 1 || ny < 1) return "";
  return fmt::format("({}, {}, {})", source.value() % nx + 1, source.value() / nx % ny + 1,
                     source.value() / (nx * ny) + 1);
}

std::string worst_row(const Mesh& mesh, const CellQuality& quality, CellId cell, FaceMeasure measure) {
  const Vec3& center = mesh.cells.center[cell];
  return row({fmt::format("<button type=\"button\" class=\"show\" data-cell=\"{0}\">{0}</button>", cell.value()),
              std::string(title_of(mesh.cells.kind[cell])), owner(mesh, cell), std::string(title_of(measure)),
              shown(quality.max_non_orthogonality[cell]) + "°", shown(quality.max_k_non_orthogonality[cell]) + "°",
              shown(quality.max_planarity[cell]), shown(quality.max_skewness[cell]), shown(quality.centring[cell]),
              shown(mesh.cells.volume[cell]),
              fmt::format("{:.1f}, {:.1f}, {:.1f}", center.x(), center.y(), center.z())});
}

}  // namespace

std::string worst_section(const ReportInput& input) {
  if (!input.assessment.has_quality) return "";
  const CellQuality quality = cell_quality(input.mesh);
  std::string rows;
  for (std::size_t m = 0; m < face_measure_count; ++m) {
    const auto measure = static_cast<FaceMeasure>(m);
    const auto add = [&](std::size_t count, bool (*include)(CellKind)) {
      for (const CellId cell : worst_cells(input.mesh, quality, measure, count, include))
        rows += worst_row(input.mesh, quality, cell, measure);
    };
    add(made_shown, [](CellKind kind) { return kind >= CellKind::transition; });
    add(host_shown, [](CellKind kind) { return kind < CellKind::transition; });
  }
  return "<section id=\"worst\">\n<h2>The worst cells</h2>\n<p>In each condition the five worst made cells and the "
         "worst "
         "host cell. A cell's number shows it in the picture.</p>\n" +
         table("Worst cells",
               {"cell", "kind", "well or (i, j, k)", "worst in", "non-orth.", "K-orth.", "planarity", "skewness",
                "nearest face", "volume, m³", "x, y, depth, m"},
               rows) +
         "<p>Nearest face: distance from the centre over the cube root of the volume; 0.5 in a cube, negative where "
         "the "
         "centre lies outside.</p>\n</section>\n";
}

}  // namespace wellknit
