// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The chain: unique nodes along the pillars (host_pillars); cell volumes and which cells exist; the crossings in the
// strips between pillars (host_strip); then, row by row, the faces of the strips along i and j and the tops and bases,
// with their transmissibilities while a row's cells are at hand. Each step runs over rows, whose results are taken in
// order, so they do not depend on the number of threads. The structure of the input follows D. K. Ponting, "Corner
// point geometry in reservoir simulation", 1989 (key Ponting1989); the cutting of fault faces is our own
// (docs/algorithms/host.md).

#include "algorithm/host_mesh.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include "algorithm/host_balance.h"
#include "algorithm/host_pillars.h"
#include "algorithm/host_row.h"
#include "algorithm/host_strip.h"
#include "algorithm/id_limit.h"
#include "algorithm/ordered_pipeline.h"
#include "algorithm/source_pore_volume.h"
#include "model/errors.h"

namespace wellknit {

namespace {

/// Everything the steps share. `cuts_i` j holds strips i = 0 … nx, `cuts_j` j holds i = 0 … nx - 1.
struct Work {
  const CornerPointGrid& grid;
  HostMesh mesh;
  bool mirrored = false;  ///< i, j, depth are left-handed
  std::vector<HostCellState> states;
  std::vector<StripCuts> cuts_i;
  std::vector<StripCuts> cuts_j;

  [[nodiscard]] std::int64_t nx() const { return grid.dimensions[0]; }
  [[nodiscard]] std::int64_t ny() const { return grid.dimensions[1]; }
  [[nodiscard]] std::int64_t nz() const { return grid.dimensions[2]; }
  /// Rows of columns that make a piece of work worth handing out.
  [[nodiscard]] std::int64_t rows_in_a_piece() const {
    constexpr std::int64_t cells = 40'000;
    return std::max<std::int64_t>(1, cells / (nx() * nz()));
  }
};

/// Volumes of a row's cells, positive where i, j, depth are right-handed; not a number without thickness.
void measure_row(const Work& work, std::int64_t j, RowValues<double>& volume) {
  volume.resize(work.mesh.corners);
  for (std::int64_t i = 0; i < work.nx(); ++i) {
    const ColumnCorners column(work.mesh.corners, work.mesh.vertices, i, j);
    double* const out = volume.column(i);
    for (std::int64_t place = 0; place < work.nz(); ++place) {
      out[place] = std::numeric_limits<double>::quiet_NaN();
      if (!column.has_thickness(place)) continue;
      const auto corners = column.corners(place);
      const double value = bilinear_hexahedron_volume(corners);
      out[place] = is_rounding(value, corners) ? 0.0 : value;
    }
  }
}

/// Volumes; the sign of their sum over active cells tells the grid's handedness.
void measure(Work& work) {
  auto& volume = work.mesh.volume;
  volume.raw().resize(static_cast<std::size_t>(work.grid.cell_count()));
  std::vector<double> sums(static_cast<std::size_t>(work.ny()), 0.0);
  tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, work.ny()), [&](const auto& rows) {
    RowValues<double> row;
    RowValues<std::uint8_t> active;
    for (std::int64_t j = rows.begin(); j < rows.end(); ++j) {
      measure_row(work, j, row);
      active.read(work.mesh.corners, j, work.grid.active);
      double& sum = sums[static_cast<std::size_t>(j)];
      for (std::int64_t i = 0; i < work.nx(); ++i)
        for (std::int64_t place = 0; place < work.nz(); ++place)
          if (active.column(i)[place] != 0 && !std::isnan(row.column(i)[place])) sum += row.column(i)[place];
      row.write(work.mesh.corners, j, volume.raw());
    }
  });
  const double total = std::accumulate(sums.begin(), sums.end(), 0.0);
  if (total == 0.0) throw InvalidInput("no active cell of the grid has a volume; check COORD, ZCORN and ACTNUM");
  work.mirrored = total < 0.0;
  work.mesh.left_handed = work.mirrored != work.mesh.corners.upside_down;
}

/// Turns a row's volumes the right way; cells that are folded over have none.
void unfold_row(Work& work, std::int64_t first) {
  for (std::int64_t c = first; c < first + work.nx(); ++c) {
    double& volume = work.mesh.volume[HostCellId(c)];
    if (work.mirrored) volume = -volume;
    if (!(volume > 0.0)) volume = 0.0;  // also what is not a number
  }
}

/// Of one row; returns how many active cells are below MINPV.
std::int64_t classify_row(Work& work, std::int64_t first, bool knows_pore_volumes) {
  std::int64_t below = 0;
  for (std::int64_t c = first; c < first + work.nx(); ++c) {
    const HostCellId cell(c);
    const bool active = work.grid.active[cell.index()] != 0;
    const bool has_volume = active && work.mesh.volume[cell] > 0.0;
    const bool is_too_small =
        has_volume && knows_pore_volumes && work.mesh.pore_volume[cell] < least_pore_volume(work.grid, cell);
    below += is_too_small ? 1 : 0;
    const bool exists = has_volume && !is_too_small;
    work.mesh.exists[cell] = exists ? 1 : 0;
    work.states[cell.index()] = exists                    ? HostCellState::exists
                                : active && !is_too_small ? HostCellState::none
                                                          : HostCellState::inactive;
  }
  return below;
}

void classify(Work& work) {
  const auto cells = static_cast<std::size_t>(work.grid.cell_count());
  const std::int64_t rows = work.ny() * work.nz();
  tbb::parallel_for(std::int64_t{0}, rows, [&](std::int64_t r) { unfold_row(work, r * work.nx()); });
  work.mesh.pore_volume = source_pore_volumes(work.grid, work.mesh.volume);
  work.states.resize(cells);
  work.mesh.exists.raw().resize(cells);
  const bool knows_pore_volumes = has_pore_volumes(work.grid);
  std::atomic<std::int64_t> below = 0;
  tbb::parallel_for(std::int64_t{0}, rows,
                    [&](std::int64_t r) { below += classify_row(work, r * work.nx(), knows_pore_volumes); });
  if (below > 0)
    work.mesh.notes.push_back(
        fmt::format("{} active cells have less pore volume than MINPV and were left out.", below.load()));
}

/// `rows`: of the two columns on the strip's sides; null while faces are not written yet.
StripSide side_of(const Work& work, std::int64_t i, std::int64_t j, int corner_p, int corner_q, const HostRow* row) {
  if (i < 0 || j < 0 || i >= work.nx() || j >= work.ny()) return {};
  const HostCorners& corners = work.mesh.corners;
  const std::int64_t column = i + work.nx() * j;
  const auto levels = static_cast<std::size_t>(corners.levels());
  return {{corners.on_pillar(column, corner_p), levels},
          {corners.on_pillar(column, corner_q), levels},
          row == nullptr ? HostColumn{} : row->column(i)};
}

VertexId first_node(const Work& work, std::array<std::int64_t, 2> pillar) {
  return work.mesh.corners.first[static_cast<std::size_t>(pillar[0] + (work.nx() + 1) * pillar[1])];
}

Strip strip_between(const Work& work, Axis axis, std::array<std::int64_t, 2> p, std::array<std::int64_t, 2> q,
                    const std::array<StripSide, 2>& sides) {
  return {axis, p, q, first_node(work, p), first_node(work, q), sides};
}

/// Between columns (i - 1, j) and (i, j): pillars p (i, j) and q (i, j + 1).
Strip strip_i(const Work& work, std::int64_t i, std::int64_t j, const HostRow* row) {
  return strip_between(work, Axis::i, {i, j}, {i, j + 1},
                       {side_of(work, i - 1, j, 1, 3, row), side_of(work, i, j, 0, 2, row)});
}

/// Between columns (i, j - 1) and (i, j): pillars p (i + 1, j) and q (i, j).
Strip strip_j(const Work& work, std::int64_t i, std::int64_t j, const HostRow* before, const HostRow* after) {
  return strip_between(work, Axis::j, {i + 1, j}, {i, j},
                       {side_of(work, i, j - 1, 3, 2, before), side_of(work, i, j, 1, 0, after)});
}

/// Adds one strip's crossings to its row's, numbered from 0 there.
void cut_strip(const Work& work, const Strip& strip, StripOverlay& overlay, StripCuts& out) {
  if (strip.is_matched()) {
    out.first_crossing.push_back(StripCuts::matched);
    out.cut_start.insert(out.cut_start.end(), 2, out.cuts.size());
    return;
  }
  const auto first = static_cast<std::int64_t>(out.crossings.size());
  overlay.read(strip, first);
  // A throw that changes by a thousand layers along one cell is damage; its points would fill the memory.
  if (overlay.crossing_count() > 1000 * work.mesh.corners.levels())
    throw InvalidInput(
        fmt::format("the layers on both sides of the fault at pillar ({}, {}) cross in {} points; check ZCORN there",
                    strip.pillar_p[0] + 1, strip.pillar_p[1] + 1, overlay.crossing_count()));
  out.first_crossing.push_back(first);
  const auto pillars = [&](double depth) {
    return std::array{work.grid.pillar_point(strip.pillar_p[0], strip.pillar_p[1], depth),
                      work.grid.pillar_point(strip.pillar_q[0], strip.pillar_q[1], depth)};
  };
  overlay.add_crossings(pillars, strip, work.mesh.vertices, out);
}

/// Gives the crossings of all rows their ids, after the pillars' nodes.
void number_crossings(Work& work) {
  auto& vertices = work.mesh.vertices;
  std::size_t total = vertices.size();
  for (const auto* rows : {&work.cuts_i, &work.cuts_j})
    for (const StripCuts& row : *rows) total += row.crossings.size();
  require_ids(total, "vertices");
  vertices.reserve(total);
  for (auto* rows : {&work.cuts_i, &work.cuts_j})
    for (StripCuts& row : *rows) {
      row.number_from(VertexId(vertices.size()));
      vertices.raw().insert(vertices.end(), row.crossings.begin(), row.crossings.end());
      row.crossings = {};
    }
}

void cut_strips(Work& work) {
  const std::int64_t nx = work.nx();
  const std::int64_t ny = work.ny();
  work.cuts_i.resize(static_cast<std::size_t>(ny));
  work.cuts_j.resize(static_cast<std::size_t>(ny + 1));
  tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, ny + 1), [&](const auto& rows) {
    StripOverlay overlay;
    for (std::int64_t j = rows.begin(); j < rows.end(); ++j) {
      StripCuts& along_j = work.cuts_j[static_cast<std::size_t>(j)];
      for (std::int64_t i = 0; i < nx; ++i) cut_strip(work, strip_j(work, i, j, nullptr, nullptr), overlay, along_j);
      if (j == ny) continue;
      StripCuts& along_i = work.cuts_i[static_cast<std::size_t>(j)];
      for (std::int64_t i = 0; i <= nx; ++i) cut_strip(work, strip_i(work, i, j, nullptr), overlay, along_i);
    }
  });
  number_crossings(work);
}

/// The ranks of a level of a column, corner di + 2 dj.
using Horizon = std::array<std::int32_t, 4>;

/// Tops and bases of one row of columns. Their edges carry the crossings of the four strips around the column.
class HorizonFaces {
 public:
  HorizonFaces(const Work& work, std::int64_t j, const HostRow& row, HostFaceWriter& writer)
      : work_(work),
        j_(j),
        row_(row),
        cuts_i_(work.cuts_i[static_cast<std::size_t>(j)]),
        south_(work.cuts_j[static_cast<std::size_t>(j)]),
        north_(work.cuts_j[static_cast<std::size_t>(j + 1)]),
        writer_(writer) {}

  void column(std::int64_t i) {
    i_ = i;
    cells_ = row_.column(i);
    for (int c = 0; c < 4; ++c) {
      const auto at = static_cast<std::size_t>(c);
      rank_[at] = work_.mesh.corners.on_pillar(i + work_.nx() * j_, c);
      first_[at] = work_.mesh.corners.first[work_.mesh.corners.pillar(i, j_, c)];
    }
    has_cuts_ = cuts_i_.has_cuts(i, 1) || cuts_i_.has_cuts(i + 1, 0) || south_.has_cuts(i, 1) || north_.has_cuts(i, 0);
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
    const FaceCell from = upper < 0 ? FaceCell{} : cells_.cell(upper);
    const FaceCell to = lower < 0 ? FaceCell{} : cells_.cell(lower);
    const bool both = from.state == HostCellState::exists && to.state == HostCellState::exists;
    const bool meet = upper >= 0 && lower >= 0 && horizon(2 * upper + 1) == horizon(2 * lower);
    const bool pinched = lower != upper + 1;
    if (meet && !(both && pinched && !work_.grid.connects_across_pinch)) {
      face(2 * lower, from, to, both && pinched);
      return;
    }
    if (upper >= 0) face(2 * upper + 1, from, FaceCell{}, false);
    if (lower >= 0) face(2 * lower, FaceCell{}, to, false);
  }

  /// Round the column's four sides on this level, right-handed about the depth.
  void face(std::int64_t level, const FaceCell& from, const FaceCell& to, bool is_pinch) {
    if (from.state != HostCellState::exists && to.state != HostCellState::exists) return;
    const Horizon h = horizon(level);
    const std::array<VertexId, 4> corner{node(0, h[0]), node(1, h[1]), node(3, h[3]), node(2, h[2])};
    writer_.push(corner[0]);
    if (has_cuts_) edge(south_.cuts_of(i_, 1, h[1], h[0]), true);
    writer_.push(corner[1]);
    if (has_cuts_) edge(cuts_i_.cuts_of(i_ + 1, 0, h[1], h[3]), false);
    writer_.push(corner[2]);
    if (has_cuts_) edge(north_.cuts_of(i_, 0, h[3], h[2]), false);
    writer_.push(corner[3]);
    if (has_cuts_) edge(cuts_i_.cuts_of(i_, 1, h[0], h[2]), true);
    writer_.close_horizon(from, to, corner, is_pinch);
  }

  void edge(std::span<const VertexId> cuts, bool backwards) {
    const std::size_t n = cuts.size();
    for (std::size_t c = 0; c < n; ++c) writer_.push(cuts[backwards ? n - 1 - c : c]);
  }

  [[nodiscard]] VertexId node(std::size_t corner, std::int32_t rank) const {
    return VertexId(first_[corner].value() + rank);
  }
  [[nodiscard]] Horizon horizon(std::int64_t level) const {
    return {rank_[0][level], rank_[1][level], rank_[2][level], rank_[3][level]};
  }

  const Work& work_;
  std::int64_t j_;
  std::int64_t i_ = 0;
  const HostRow& row_;
  const StripCuts& cuts_i_;
  const StripCuts& south_;
  const StripCuts& north_;
  HostFaceWriter& writer_;
  HostColumn cells_;
  std::array<const std::int32_t*, 4> rank_{};
  std::array<VertexId, 4> first_{};
  bool has_cuts_ = false;
};

/// Faces of some rows, and what is needed to make them.
struct FacePiece {
  HostFaces faces;
  HostRow before;
  HostRow row;
  StripOverlay overlay;

  void clear() {
    faces.vertex_start.resize(1);
    faces.vertices.clear();
    faces.cells.raw().clear();
    faces.axis.raw().clear();
    faces.is_fault.raw().clear();
    faces.is_pinch.raw().clear();
    faces.transmissibility.raw().clear();
  }
};

void add_strip_faces(const Strip& strip, std::int64_t first_crossing, StripOverlay& overlay, HostFaceWriter& writer) {
  if (first_crossing == StripCuts::matched) return add_matched_faces(strip, writer);
  overlay.read(strip, first_crossing);
  overlay.add_faces(strip, writer);
}

/// The faces along i of rows [begin, end), of the strips before them along j (and after the last row), and their
/// horizons.
void make_faces(const Work& work, std::int64_t begin, std::int64_t end, FacePiece& piece) {
  piece.clear();
  HostFaceWriter writer(piece.faces, work.mesh.vertices, work.mirrored);
  const auto read = [&](HostRow& row, std::int64_t j) {
    row.read(work.grid, work.mesh.corners, work.mesh.vertices, work.states, j);
  };
  if (begin > 0) read(piece.row, begin - 1);
  for (std::int64_t j = begin; j < end; ++j) {
    std::swap(piece.before, piece.row);
    if (j < work.ny()) read(piece.row, j);
    const StripCuts& along_j = work.cuts_j[static_cast<std::size_t>(j)];
    for (std::int64_t i = 0; i < work.nx(); ++i)
      add_strip_faces(strip_j(work, i, j, &piece.before, &piece.row),
                      along_j.first_crossing[static_cast<std::size_t>(i)], piece.overlay, writer);
    if (j == work.ny()) continue;
    const StripCuts& along_i = work.cuts_i[static_cast<std::size_t>(j)];
    for (std::int64_t i = 0; i <= work.nx(); ++i)
      add_strip_faces(strip_i(work, i, j, &piece.row), along_i.first_crossing[static_cast<std::size_t>(i)],
                      piece.overlay, writer);
    HorizonFaces horizons(work, j, piece.row, writer);
    for (std::int64_t i = 0; i < work.nx(); ++i) horizons.column(i);
  }
}

/// Room for the faces of a grid without faults and a few more, so that arrays seldom grow. What is not used takes no
/// memory.
void reserve(const Work& work, HostFaces& faces) {
  const auto [nx, ny, nz] = work.grid.dimensions;
  const std::int64_t plain = (nx + 1) * ny * nz + nx * (ny + 1) * nz + nx * ny * (nz + 1);
  const auto count = static_cast<std::size_t>(plain + plain / 8);
  faces.vertex_start.reserve(count + 1);
  faces.vertices.reserve(4 * count);
  faces.cells.reserve(count);
  faces.axis.reserve(count);
  faces.is_fault.reserve(count);
  faces.is_pinch.reserve(count);
  faces.transmissibility.reserve(count);
}

/// All faces: row by row those along j, along i, and along k.
void add_faces(Work& work) {
  HostFaces& faces = work.mesh.faces;
  reserve(work, faces);
  run_in_order<FacePiece>(
      work.ny() + 1, work.rows_in_a_piece(),
      [&](std::int64_t begin, std::int64_t end, FacePiece& piece) { make_faces(work, begin, end, piece); },
      [&](std::int64_t /*begin*/, std::int64_t /*end*/, const FacePiece& piece) { append_faces(faces, piece.faces); });
}

}  // namespace

double HostMesh::volume_of_sources(HostCellId cell) const {
  if (cell.index() < source_count()) return volume[cell];
  const std::size_t c = cell.index() - source_count();
  double sum = 0.0;
  for (auto p = static_cast<std::size_t>(refined.piece_start[c]);
       p < static_cast<std::size_t>(refined.piece_start[c + 1]); ++p)
    sum += refined.piece_fraction[p] * volume[refined.piece_source[p]];
  return sum;
}

VertexId HostMesh::corner(HostCellId cell, int di, int dj, int dk) const {
  const auto [nx, ny, nz] = corners.dimensions;
  if (cell.value() >= nx * ny * nz)
    return refined
        .corners[static_cast<std::size_t>(cell.value() - nx * ny * nz)][static_cast<std::size_t>(di + 2 * dj + 4 * dk)];
  const std::int64_t column = cell.value() % (nx * ny);
  const std::int64_t place = corners.layer(cell.value() / (nx * ny));
  const int corner = di + 2 * dj;
  const std::int64_t level = 2 * place + (corners.upside_down ? 1 - dk : dk);
  const VertexId first = corners.first[corners.pillar(column % nx, column / nx, corner)];
  return VertexId(first.value() + corners.on_pillar(column, corner)[level]);
}

std::array<VertexId, 8> HostMesh::corners_of(HostCellId cell) const {
  std::array<VertexId, 8> out;
  for (int c = 0; c < 8; ++c) out[static_cast<std::size_t>(c)] = corner(cell, c & 1, (c >> 1) & 1, c >> 2);
  return out;
}

HostMesh build_host_mesh(const CornerPointGrid& grid) {
  validate(grid);
  Work work{grid, {}, false, {}, {}, {}};
  PillarNodes pillars = resolve_pillars(grid);
  work.mesh.vertices = std::move(pillars.nodes);
  work.mesh.corners = std::move(pillars.corners);
  work.mesh.notes = std::move(pillars.notes);
  measure(work);
  classify(work);
  cut_strips(work);
  add_faces(work);
  balance_cut_tops(work.mesh);
  return std::move(work.mesh);
}

}  // namespace wellknit
