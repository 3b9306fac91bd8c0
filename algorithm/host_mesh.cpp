// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The chain: unique nodes along the pillars (host_pillars), cell volumes, the strips between pillars in the i and in
// the j direction with their fault polygons (host_strip), and last the tops and bases, which need the strips' crossings
// on their edges. Each step runs over rows; rows are joined in a fixed order, so the result does not depend on the
// number of threads. The structure of the input follows D. K. Ponting, "Corner point geometry in reservoir simulation",
// 1989 (key Ponting1989); the cutting of fault faces is our own (docs/algorithms/host.md).

#include "algorithm/host_mesh.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "algorithm/host_balance.h"
#include "algorithm/host_pillars.h"
#include "algorithm/host_strip.h"
#include "algorithm/source_pore_volume.h"
#include "model/errors.h"

namespace wellknit {

namespace {

/// Everything the steps share. Rows of strips: `rows_i` row j holds strips i = 0 … nx, `rows_j` row j holds i = 0 … nx
/// - 1.
struct Work {
  const CornerPointGrid& grid;
  PillarNodes pillars;
  HostMesh mesh;
  bool mirrored = false;  ///< i, j, depth are left-handed
  std::vector<HostCellState> states;
  std::vector<StripFaces> rows_i;
  std::vector<StripFaces> rows_j;
  std::vector<HostFaces> rows_k;

  [[nodiscard]] std::int64_t nx() const { return grid.dimensions[0]; }
  [[nodiscard]] std::int64_t ny() const { return grid.dimensions[1]; }
  [[nodiscard]] std::int64_t nz() const { return grid.dimensions[2]; }
};

void number_corners(Work& work) {
  const std::int64_t nx = work.nx();
  work.mesh.corner_vertex.resize(work.grid.zcorn.size());
  tbb::parallel_for(std::int64_t{0}, work.ny(), [&](std::int64_t j) {
    for (std::int64_t place = 0; place < work.nz(); ++place) {
      VertexId* out = &work.mesh.corner_vertex[8 * work.grid.cell_id(0, j, work.pillars.layer(place)).index()];
      for (std::int64_t i = 0; i < nx; ++i, out += 8) {
        for (int corner = 0; corner < 4; ++corner) {
          const std::int64_t* levels = work.pillars.on_pillar(i + nx * j, corner) + 2 * place;
          // dk counts with the layers' numbers, levels count downwards.
          out[corner] = VertexId(levels[work.pillars.upside_down ? 1 : 0]);
          out[corner + 4] = VertexId(levels[work.pillars.upside_down ? 0 : 1]);
        }
      }
    }
  });
}

/// Signed volumes; the sign of their sum over active cells tells the grid's handedness.
void measure(Work& work) {
  const std::int64_t cells = work.grid.cell_count();
  auto& volume = work.mesh.volume;
  volume.resize(static_cast<std::size_t>(cells));
  const std::int64_t row = work.nx();
  tbb::parallel_for(std::int64_t{0}, cells / row, [&](std::int64_t r) {
    for (std::int64_t c = r * row; c < (r + 1) * row; ++c) {
      std::array<Vec3, 8> corners;
      for (std::size_t n = 0; n < 8; ++n)
        corners[n] = work.pillars.nodes[work.mesh.corner_vertex[8 * static_cast<std::size_t>(c) + n]];
      volume[HostCellId(c)] = bilinear_hexahedron_volume(corners);
    }
  });
  double total = 0.0;
  for (std::int64_t c = 0; c < cells; ++c)
    if (work.grid.active[static_cast<std::size_t>(c)] != 0) total += volume[HostCellId(c)];
  if (total == 0.0) throw InvalidInput("no active cell of the grid has a volume; check COORD, ZCORN and ACTNUM");
  work.mesh.left_handed = total < 0.0;
  work.mirrored = work.mesh.left_handed != work.pillars.upside_down;
  if (work.mesh.left_handed)
    for (double& v : volume) v = -v;
}

bool has_thickness(const HostMesh& mesh, HostCellId cell) {
  const VertexId* corner = &mesh.corner_vertex[8 * cell.index()];
  return !std::equal(corner, corner + 4, corner + 4);
}

void classify(Work& work) {
  const auto cells = static_cast<std::size_t>(work.grid.cell_count());
  work.states.resize(cells);
  work.mesh.exists.resize(cells);
  std::int64_t folded = 0;
  std::int64_t too_small = 0;
  HostCellId first_folded;
  for (std::size_t c = 0; c < cells; ++c) {
    const HostCellId cell(c);
    double& volume = work.mesh.volume[cell];
    const bool thick = has_thickness(work.mesh, cell);
    const bool active = work.grid.active[c] != 0;
    if (active && thick && volume <= 0.0 && folded++ == 0) first_folded = cell;
    if (!thick || volume < 0.0) volume = 0.0;
  }
  work.mesh.pore_volume = source_pore_volumes(work.grid, work.mesh.volume);
  const bool knows_pore_volumes = has_pore_volumes(work.grid);
  for (std::size_t c = 0; c < cells; ++c) {
    const HostCellId cell(c);
    const bool has_volume = work.grid.active[c] != 0 && work.mesh.volume[cell] > 0.0;
    const bool is_too_small =
        has_volume && knows_pore_volumes && work.mesh.pore_volume[cell] < least_pore_volume(work.grid, cell);
    too_small += is_too_small ? 1 : 0;
    const bool exists = has_volume && !is_too_small;
    work.mesh.exists[cell] = exists ? 1 : 0;
    work.states[c] = exists                                      ? HostCellState::exists
                     : work.grid.active[c] != 0 && !is_too_small ? HostCellState::none
                                                                 : HostCellState::inactive;
  }
  if (too_small > 0)
    work.mesh.notes.push_back(
        fmt::format("{} active cells have less pore volume than MINPV and were left out.", too_small));
  if (folded == 0) return;
  const auto [i, j, k] = work.grid.ijk(first_folded);
  work.mesh.notes.push_back(
      fmt::format("{} active cells have thickness but no positive volume and were left out; the first is ({}, {}, {}).",
                  folded, i + 1, j + 1, k + 1));
}

StripSide side_of(const Work& work, std::int64_t i, std::int64_t j, int corner_p, int corner_q) {
  if (i < 0 || j < 0 || i >= work.nx() || j >= work.ny()) return {};
  const std::int64_t column = i + work.nx() * j;
  const auto levels = static_cast<std::size_t>(work.pillars.levels());
  const std::int64_t layer = work.nx() * work.ny();
  return {{work.pillars.on_pillar(column, corner_p), levels},
          {work.pillars.on_pillar(column, corner_q), levels},
          column + layer * work.pillars.layer(0),
          work.pillars.upside_down ? -layer : layer};
}

/// Between columns (i - 1, j) and (i, j): pillars p (i, j) and q (i, j + 1).
Strip strip_i(const Work& work, std::int64_t i, std::int64_t j) {
  return {Axis::i, {i, j}, {i, j + 1}, {side_of(work, i - 1, j, 1, 3), side_of(work, i, j, 0, 2)}};
}

/// Between columns (i, j - 1) and (i, j): pillars p (i + 1, j) and q (i, j).
Strip strip_j(const Work& work, std::int64_t i, std::int64_t j) {
  return {Axis::j, {i + 1, j}, {i, j}, {side_of(work, i, j - 1, 3, 2), side_of(work, i, j, 1, 0)}};
}

/// Room for a row of faces of four corners, so that vectors do not grow step by step.
void reserve(HostFaces& faces, std::int64_t count) {
  const auto n = static_cast<std::size_t>(count);
  faces.vertex_start.reserve(n + 1);
  faces.vertices.reserve(4 * n);
  faces.cells.reserve(n);
  faces.axis.reserve(n);
  faces.is_fault.reserve(n);
  faces.is_pinch.reserve(n);
}

void cut_strips(Work& work) {
  const std::int64_t nx = work.nx();
  const std::int64_t ny = work.ny();
  work.rows_i.resize(static_cast<std::size_t>(ny));
  work.rows_j.resize(static_cast<std::size_t>(ny + 1));
  tbb::parallel_for(std::int64_t{0}, 2 * ny + 1, [&](std::int64_t row) {
    const bool along_i = row < ny;
    const std::int64_t j = along_i ? row : row - ny;
    StripFaces& out = (along_i ? work.rows_i : work.rows_j)[static_cast<std::size_t>(j)];
    reserve(out.faces, (nx + 1) * work.nz());
    StripCutter cutter(work.grid, work.pillars.nodes, work.states, work.mirrored, out);
    for (std::int64_t i = 0; i < (along_i ? nx + 1 : nx); ++i)
      cutter.cut(along_i ? strip_i(work, i, j) : strip_j(work, i, j));
  });
}

/// Gives the crossings of all rows their final numbers, after the pillars' nodes, and makes the list of vertices.
void number_crossings(Work& work) {
  const auto nodes = static_cast<std::int64_t>(work.pillars.nodes.size());
  std::vector<StripFaces*> rows;
  for (StripFaces& row : work.rows_i) rows.push_back(&row);
  for (StripFaces& row : work.rows_j) rows.push_back(&row);
  std::size_t total = work.pillars.nodes.size();
  for (const StripFaces* row : rows) total += row->crossings.size();
  work.mesh.vertices = std::move(work.pillars.nodes);
  work.mesh.vertices.reserve(total);
  for (StripFaces* row : rows) {
    const std::int64_t shift = static_cast<std::int64_t>(work.mesh.vertices.size()) - nodes;
    for (const Vec3& point : row->crossings) work.mesh.vertices.push_back(point);
    if (shift == 0 || row->crossings.empty()) continue;
    const auto renumber = [&](VertexId& vertex) {
      if (vertex.value() >= nodes) vertex = VertexId(vertex.value() + shift);
    };
    std::for_each(row->faces.vertices.begin(), row->faces.vertices.end(), renumber);
    std::for_each(row->cut_vertices.begin(), row->cut_vertices.end(), renumber);
  }
}

/// The four nodes of a level of a column, corner di + 2 dj.
using Horizon = std::array<std::int64_t, 4>;

/// Tops and bases of one row of columns. Their edges carry the crossings of the four strips around the column.
class HorizonFaces {
 public:
  HorizonFaces(const Work& work, std::int64_t j, HostFaces& out)
      : work_(work),
        j_(j),
        row_i_(work.rows_i[static_cast<std::size_t>(j)]),
        south_(work.rows_j[static_cast<std::size_t>(j)]),
        north_(work.rows_j[static_cast<std::size_t>(j + 1)]),
        writer_(out, work.states, work.mirrored) {}

  void column(std::int64_t i) {
    i_ = i;
    has_cuts_ = row_i_.has_cuts(i, 1) || row_i_.has_cuts(i + 1, 0) || south_.has_cuts(i, 1) || north_.has_cuts(i, 0);
    std::int64_t upper = -1;  // the last place with thickness
    for (std::int64_t place = 0; place < work_.nz(); ++place) {
      if (horizon(2 * place) == horizon(2 * place + 1)) continue;
      between(upper, place);
      upper = place;
    }
    if (upper >= 0) between(upper, -1);
  }

 private:
  /// Faces between two places that follow each other with nothing or only flat cells in between; -1: the column ends.
  void between(std::int64_t upper, std::int64_t lower) {
    const HostCellId from = cell(upper);
    const HostCellId to = cell(lower);
    const bool both = writer_.state(from) == HostCellState::exists && writer_.state(to) == HostCellState::exists;
    const bool meet = upper >= 0 && lower >= 0 && horizon(2 * upper + 1) == horizon(2 * lower);
    const bool pinched = lower != upper + 1;
    if (meet && !(both && pinched && !work_.grid.connects_across_pinch)) {
      face(2 * lower, from, to, both && pinched);
      return;
    }
    if (upper >= 0) face(2 * upper + 1, from, HostCellId{}, false);
    if (lower >= 0) face(2 * lower, HostCellId{}, to, false);
  }

  /// Round the column's four sides on this level, right-handed about the depth.
  void face(std::int64_t level, HostCellId from, HostCellId to, bool is_pinch) {
    if (writer_.state(from) != HostCellState::exists && writer_.state(to) != HostCellState::exists) return;
    const Horizon h = horizon(level);
    writer_.push(h[0]);
    if (has_cuts_) edge(south_.cuts_of(i_, 1, h[1], h[0]), true);
    writer_.push(h[1]);
    if (has_cuts_) edge(row_i_.cuts_of(i_ + 1, 0, h[1], h[3]), false);
    writer_.push(h[3]);
    if (has_cuts_) edge(north_.cuts_of(i_, 0, h[3], h[2]), false);
    writer_.push(h[2]);
    if (has_cuts_) edge(row_i_.cuts_of(i_, 1, h[0], h[2]), true);
    writer_.close(from, to, Axis::k, false, is_pinch);
  }

  void edge(std::span<const VertexId> cuts, bool backwards) {
    const std::size_t n = cuts.size();
    for (std::size_t c = 0; c < n; ++c) writer_.push(cuts[backwards ? n - 1 - c : c].value());
  }

  [[nodiscard]] HostCellId cell(std::int64_t place) const {
    return place < 0 ? HostCellId{} : work_.grid.cell_id(i_, j_, work_.pillars.layer(place));
  }
  [[nodiscard]] Horizon horizon(std::int64_t level) const {
    const std::int64_t* first = work_.pillars.on_pillar(i_ + work_.nx() * j_, 0) + level;
    const std::int64_t step = work_.pillars.levels();
    return {first[0], first[step], first[2 * step], first[3 * step]};
  }

  const Work& work_;
  std::int64_t j_;
  std::int64_t i_ = 0;
  const StripFaces& row_i_;
  const StripFaces& south_;
  const StripFaces& north_;
  HostFaceWriter writer_;
  bool has_cuts_ = false;
};

void cut_horizons(Work& work) {
  work.rows_k.resize(static_cast<std::size_t>(work.ny()));
  tbb::parallel_for(std::int64_t{0}, work.ny(), [&](std::int64_t j) {
    HostFaces& out = work.rows_k[static_cast<std::size_t>(j)];
    reserve(out, work.nx() * (work.nz() + 1));
    HorizonFaces faces(work, j, out);
    for (std::int64_t i = 0; i < work.nx(); ++i) faces.column(i);
  });
}

/// Where a row's faces and their vertices begin in the whole.
struct Place {
  std::size_t face = 0;
  std::size_t vertex = 0;
};

void copy_row(const HostFaces& row, Place place, HostFaces& all) {
  const auto at = [](auto& array, std::size_t offset) { return array.begin() + static_cast<std::ptrdiff_t>(offset); };
  std::copy(row.vertices.begin(), row.vertices.end(), at(all.vertices, place.vertex));
  std::copy(row.cells.begin(), row.cells.end(), at(all.cells, place.face));
  std::copy(row.axis.begin(), row.axis.end(), at(all.axis, place.face));
  std::copy(row.is_fault.begin(), row.is_fault.end(), at(all.is_fault, place.face));
  std::copy(row.is_pinch.begin(), row.is_pinch.end(), at(all.is_pinch, place.face));
  std::transform(row.vertex_start.begin() + 1, row.vertex_start.end(), at(all.vertex_start, place.face + 1),
                 [&](std::int64_t start) { return start + static_cast<std::int64_t>(place.vertex); });
}

/// All faces: along i, then along j, then along k, row by row.
void join_rows(Work& work) {
  std::vector<const HostFaces*> rows;
  for (const StripFaces& row : work.rows_i) rows.push_back(&row.faces);
  for (const StripFaces& row : work.rows_j) rows.push_back(&row.faces);
  for (const HostFaces& row : work.rows_k) rows.push_back(&row);
  std::vector<Place> places(1);
  for (const HostFaces* row : rows)
    places.push_back({places.back().face + row->size(), places.back().vertex + row->vertices.size()});
  HostFaces& all = work.mesh.faces;
  all.vertex_start.resize(places.back().face + 1);
  all.vertices.resize(places.back().vertex);
  all.cells.resize(places.back().face);
  all.axis.resize(places.back().face);
  all.is_fault.resize(places.back().face);
  all.is_pinch.resize(places.back().face);
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t r) { copy_row(*rows[r], places[r], all); });
}

}  // namespace

HostMesh build_host_mesh(const CornerPointGrid& grid) {
  validate(grid);
  Work work{grid, resolve_pillars(grid), {}, false, {}, {}, {}, {}};
  work.mesh.notes = work.pillars.notes;
  number_corners(work);
  measure(work);
  classify(work);
  cut_strips(work);
  number_crossings(work);
  cut_horizons(work);
  join_rows(work);
  balance_cut_tops(work.mesh);
  return std::move(work.mesh);
}

}  // namespace wellknit
