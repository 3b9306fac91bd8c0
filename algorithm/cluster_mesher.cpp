// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/cluster_mesher.h"

#include <algorithm>

#include "algorithm/near_well_frame.h"
#include "model/errors.h"

namespace wellknit {

namespace {

TubeOrReason tube_of(const WellTask& task, const NearWellFrame& frame, const Piece& piece) {
  const Well well = task.with_radius(piece.well, piece.radius);
  if (!piece.layered) return build_swept_tube(frame.host(), well, piece.range);
  const auto path = path_in_reference(frame.host(), well);
  if (path.size() < 2) return NoTube{"its path inside the grid is shorter than a two-thousandth of its length"};
  return build_layered_tube(frame.host(), well, path, *frame.obstacles);
}

/// Source columns that the cavity's columns, with four around them, reach into.
std::set<std::array<std::int64_t, 2>> columns_of(const Cluster& cluster) {
  std::set<std::array<std::int64_t, 2>> out;
  const NearWellGrid& g = *cluster.grid;
  constexpr std::int64_t around = 4;
  for (const NearWellCell& c : cluster.mesh->cavity.removed) {
    std::array<std::int64_t, 2> low{};
    std::array<std::int64_t, 2> high{};
    for (std::size_t a = 0; a < 2; ++a) {
      low[a] = std::max<std::int64_t>(c[a] - around, 0);
      high[a] = std::min(c[a] + around, g.dimensions()[a] - 1);
    }
    const auto first = g.source_column({low[0], low[1], 0});
    const auto last = g.source_column({high[0], high[1], 0});
    for (std::int64_t j = first[1]; j <= last[1]; ++j)
      for (std::int64_t i = first[0]; i <= last[0]; ++i) out.insert({i, j});
  }
  return out;
}

/// Makes a piece thinner. False where it has become as thin as it may.
bool shrink(const WellTask& task, Piece& piece, int most_shrinks) {
  const double smaller = 0.75 * piece.radius;
  if (piece.shrinks >= most_shrinks || smaller < smallest_radius(task.wells[piece.well], task.samples[piece.well]))
    return false;
  piece.radius = smaller;
  ++piece.shrinks;
  return true;
}

/// Where two tubes are too close to each other, the wider one that still may gets thinner. False where that is not why.
bool shrink_widest(const WellTask& task, Cluster& cluster, const Failure& failure) {
  constexpr int most_shrinks = 5;
  std::vector<std::size_t> close;
  for (const TubePlace& place : failure.places)
    if (place.reach > 0.0) close.push_back(place.tube);
  std::stable_sort(close.begin(), close.end(),
                   [&](std::size_t a, std::size_t b) { return cluster.pieces[a].radius > cluster.pieces[b].radius; });
  return std::any_of(close.begin(), close.end(),
                     [&](std::size_t p) { return shrink(task, cluster.pieces[p], most_shrinks); });
}

/// From the last to the first; one where the failure names none or all.
std::vector<std::size_t> blamed_pieces(const Cluster& cluster, const Failure& failure) {
  std::vector<std::size_t> blamed = failure.blamed;
  if (blamed.empty() || blamed.size() == cluster.pieces.size()) blamed = {cluster.pieces.size() - 1};
  std::sort(blamed.rbegin(), blamed.rend());
  return blamed;
}

double length_of(const std::vector<Piece>& pieces) {
  double length = 0.0;
  for (const Piece& p : pieces) length += p.range.to - p.range.from;
  return length;
}

/// Cuts a piece where it fails if that costs little, else makes it thinner, else cuts it, and at last leaves it out.
void give_room(const WellTask& task, Cluster& cluster, std::size_t p, const Failure& failure,
               std::vector<std::string>& reasons) {
  constexpr int most_shrinks = 2;
  constexpr double little = 0.05;
  const auto at = cluster.pieces.begin() + static_cast<std::ptrdiff_t>(p);
  auto parts = cut(*at, p, failure);
  if (task.wells[at->well].radial.mode == MeshMode::layered)
    std::erase_if(parts, [](const Piece& part) { return !part.layered; });
  const bool is_cheap = !parts.empty() && length_of(parts) > (1.0 - little) * (at->range.to - at->range.from);
  if (!is_cheap && shrink(task, *at, most_shrinks)) return;
  if (parts.empty() && reasons[at->well].empty()) reasons[at->well] = failure.reason;
  cluster.pieces.insert(cluster.pieces.erase(at), parts.begin(), parts.end());
}

}  // namespace

Failure mesh_once(const WellTask& task, Cluster& cluster) {
  cluster.mesh.reset();
  const NearWellFrame frame = near_well_frame(task, cluster.pieces, cluster.cells);
  std::vector<Tube> tubes;
  for (std::size_t p = 0; p < cluster.pieces.size(); ++p) {
    const Piece& piece = cluster.pieces[p];
    try {
      auto tube = tube_of(task, frame, piece);
      if (const auto* none = std::get_if<NoTube>(&tube)) {
        Failure failure{none->reason, {p}, {}, true};
        if (none->measured_depth) failure.places.push_back({p, *none->measured_depth});
        return failure;
      }
      tubes.push_back(std::move(std::get<Tube>(tube)));
      tubes.back().well = piece.well;
    } catch (const InvalidInput& e) {
      return {e.what(), {p}, {}, true};
    }
  }
  auto mesh = build_transition_mesh(frame.host(), tubes, task.options.mapping, cluster.tight);
  if (auto* none = std::get_if<NoCavity>(&mesh)) return {none->reason, none->tubes, none->places};
  cluster.mesh = std::move(std::get<TransitionMesh>(mesh));
  for (std::size_t p = 0; p < tubes.size(); ++p)
    if (cluster.pieces[p].layered) cluster.pieces[p].range = range_of(tubes[p]);
  cluster.grid = frame.grid;
  cluster.columns = columns_of(cluster);
  return {};
}

void mesh_together(const WellTask& task, Cluster& cluster, std::vector<std::string>& reasons) {
  while (!cluster.pieces.empty()) {
    const Failure failure = mesh_once(task, cluster);
    if (cluster.mesh) return;
    if (shrink_widest(task, cluster, failure)) continue;
    for (const std::size_t p : blamed_pieces(cluster, failure)) give_room(task, cluster, p, failure, reasons);
  }
}

}  // namespace wellknit
