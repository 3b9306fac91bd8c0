// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/well_connections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <unordered_map>

#include "algorithm/cell_center.h"
#include "algorithm/cell_path.h"
#include "algorithm/line_sink.h"
#include "algorithm/peaceman.h"
#include "algorithm/refined_path.h"
#include "algorithm/rock_tensor.h"
#include "algorithm/tube_flow.h"
#include "model/errors.h"

namespace wellknit {

namespace {

/// Length and mean direction of the path in a made cell.
struct MadePart {
  Vec3 path = Vec3::Zero();
  double length = 0.0;
  MeasuredDepthRange measured_depth;
};

/// Index of a bore through a polyhedral cell, as Peaceman's in a cube of its volume: an equivalent radius of 0.2 of its
/// edge and the permeability across the path. An estimate: the cell is no cube and the bore not in its middle.
double made_cell_index(const Assembly& assembly, CellId cell, const MadePart& part, double bore_radius, double skin) {
  const Vec3 direction = part.path.norm() > 0.0 ? Vec3(part.path.normalized()) : Vec3(Vec3::UnitZ());
  const Eigen::Matrix2d k = BoreSection(direction, direction).permeability(rock_tensor(assembly, cell));
  const double across = LineSink(k, bore_radius).conductance();
  const double radius = 0.2 * std::cbrt(assembly.mesh.cells.volume[cell]);
  const double resistance = std::log(std::max(radius / bore_radius, 1.0 + 1e-3)) + skin;
  return resistance > 0.0 ? 2.0 * std::numbers::pi * across * part.length / resistance : 0.0;
}

/// The open stretches of a well less the measured depths of its tubes.
std::vector<MeasuredDepthRange> open_outside(const Well& well, const std::vector<const PlacedTube*>& tubes) {
  std::vector<MeasuredDepthRange> open = well.open;
  if (open.empty()) open.push_back({well.trajectory.measured_depth.front(), well.trajectory.measured_depth.back()});
  for (const PlacedTube* tube : tubes) {
    const auto& md = tube->tube->real.measured_depth;
    const auto [from, to] = std::minmax_element(md.begin(), md.end());
    std::vector<MeasuredDepthRange> out;
    for (const MeasuredDepthRange& o : open) {
      // A millimetre is less than any perforation and more than rounding.
      constexpr double shortest = 1e-3;
      if (std::min(o.to, *from) - o.from > shortest) out.push_back({o.from, std::min(o.to, *from)});
      if (o.to - std::max(o.from, *to) > shortest) out.push_back({std::max(o.from, *to), o.to});
    }
    open = std::move(out);
  }
  return open;
}

}  // namespace

/// Outward faces of made cells, made when first asked for.
class WellConnector::MadeCells {
 public:
  explicit MadeCells(const Mesh& mesh) : mesh_(mesh) {}

  /// The made cell that holds a point of a removed source cell: of those with a share of it the one that the point is
  /// deepest in.
  std::optional<CellId> at(HostCellId source, const Vec3& point) {
    std::optional<CellId> best;
    double deepest = -std::numeric_limits<double>::infinity();
    for (std::int64_t i = mesh_.transfer.start[source.index()]; i < mesh_.transfer.start[source.index() + 1]; ++i) {
      const CellId cell = mesh_.transfer.cell[static_cast<std::size_t>(i)];
      if (mesh_.cells.kind[cell] < CellKind::transition) continue;
      const double h = smallest_height(faces_of(cell), point);
      if (h <= deepest) continue;
      deepest = h;
      best = cell;
    }
    return best;
  }

  /// Parts of the path in removed source cells, by made cell, in steps of a hundredth of each part.
  std::map<CellId, MadePart> parts_of(const Assembly& assembly, const HostPath& path,
                                      const std::vector<MeasuredDepthRange>& open) {
    std::map<CellId, MadePart> out;
    for (std::size_t n = 0; n < path.parts.size(); ++n) {
      const CellPart& part = path.parts[n];
      if (assembly.cell_of[part.cell].is_valid()) continue;
      constexpr int steps = 100;
      const double step = (part.measured_depth.to - part.measured_depth.from) / steps;
      for (int s = 0; s < steps; ++s) {
        const double md = part.measured_depth.from + (s + 0.5) * step;
        if (std::none_of(open.begin(), open.end(),
                         [&](const MeasuredDepthRange& o) { return o.from <= md && md <= o.to; }))
          continue;
        const auto cell = at(path.source[n], part.entry + (s + 0.5) / steps * (part.exit - part.entry));
        if (!cell) continue;
        auto [entry, is_new] = out.emplace(*cell, MadePart{});
        if (is_new) entry->second.measured_depth = {md - 0.5 * step, md};
        entry->second.measured_depth.to = md + 0.5 * step;
        entry->second.path += (part.exit - part.entry) / steps;
        entry->second.length += (part.exit - part.entry).norm() / steps;
      }
    }
    return out;
  }

 private:
  const std::vector<OutwardFace>& faces_of(CellId cell) {
    if (faces_.empty()) collect();
    return faces_[cell.value()];
  }

  void collect() {
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const auto [a, b] = mesh_.faces.cells[FaceId(f)];
      const bool is_made_a = mesh_.cells.kind[a] >= CellKind::transition;
      const bool is_made_b = b.is_valid() && mesh_.cells.kind[b] >= CellKind::transition;
      if (!is_made_a && !is_made_b) continue;
      const PolygonGeometry g = face_geometry(mesh_, FaceId(f));
      if (is_made_a) faces_[a.value()].push_back({g.mean, g.area_vector});
      if (is_made_b) faces_[b.value()].push_back({g.mean, -g.area_vector});
    }
  }

  const Mesh& mesh_;
  std::unordered_map<std::int64_t, std::vector<OutwardFace>> faces_;
};

WellConnector::WellConnector(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator,
                             const Assembly& assembly, bool computes_all)
    : grid_(grid),
      host_(host),
      locator_(locator),
      assembly_(assembly),
      computes_all_(computes_all),
      made_cells_(std::make_unique<MadeCells>(assembly.mesh)) {}
WellConnector::~WellConnector() = default;

WellConnections WellConnector::connect(std::size_t well_index, const Well& well) {
  WellConnections out;
  std::vector<const PlacedTube*> tubes;
  for (const PlacedTube& t : assembly_.tubes)
    if (t.tube->well == well_index) tubes.push_back(&t);
  for (const PlacedTube* tube : tubes) {
    const auto more = connect_tube(assembly_, *tube, well);
    out.all.insert(out.all.end(), more.begin(), more.end());
  }
  // A layered tube runs from top to base.
  if (std::any_of(tubes.begin(), tubes.end(), [](const PlacedTube* t) { return t->tube->layered; })) return out;
  Well rest = well;
  rest.open = open_outside(well, tubes);
  if (rest.open.empty()) return out;
  const auto parts = cells_along(grid_, locator_, well.trajectory);
  const HostPath path = split_at_refined(grid_, host_, parts);
  const bool is_from_deck = tubes.empty() && !well.completions.empty() && !computes_all_;
  const auto kept =
      is_from_deck ? completion_indices(grid_, host_, well, parts) : peaceman_indices(grid_, host_, rest, path.parts);
  for (const HostWellConnection& c : kept)
    if (const CellId cell = assembly_.cell_of[c.cell]; cell.is_valid())
      out.all.push_back({cell, c.well_index, c.measured_depth});
  for (const auto& [cell, part] : made_cells_->parts_of(assembly_, path, rest.open)) {
    const double index = made_cell_index(assembly_, cell, part, well.radial.bore_radius, well.skin);
    // The well's own radial cells belong to its tube's open part.
    const bool is_own = assembly_.mesh.cells.well[cell] == WellId(well_index);
    if (index > 0.0 && !is_own) out.all.push_back({cell, index, part.measured_depth});
  }
  std::int64_t radial = 0;
  for (const WellConnection& c : out.all) radial += assembly_.mesh.cells.well[c.cell] == WellId(well_index) ? 1 : 0;
  out.by_index = static_cast<std::int64_t>(out.all.size()) - radial;
  return out;
}

}  // namespace wellknit
