// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The chain: the lattice of pillars with its nodes (refinement_lattice); the new cells with their volumes and what they
// are made of; the strips between neighbouring pillars and the tops and bases, with the host's own means; the
// exchange of faces (host_face_replacement).

#include "algorithm/host_refinement.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <unordered_map>
#include <utility>

#include "algorithm/host_balance.h"
#include "algorithm/host_face_replacement.h"
#include "algorithm/host_face_writer.h"
#include "algorithm/host_row.h"
#include "algorithm/host_strip.h"
#include "algorithm/host_transmissibility.h"
#include "algorithm/id_limit.h"
#include "algorithm/refinement_lattice.h"
#include "model/errors.h"

namespace wellknit {

namespace {

/// A part of a source cell in a refined cell.
struct Piece {
  HostCellId source;
  double volume = 0.0;  ///< m3, positive
  PieceBox box;
};

/// Cells of the lattice's columns, as the faces need them.
struct LatticeCells {
  std::vector<HostColumn> columns;  ///< of each column of the lattice
  std::vector<std::vector<HostCellState>> state;
  std::vector<std::vector<std::array<Vec3, 3>>> conductance;
};

bool is_mirrored(const HostMesh& host) { return host.left_handed != host.corners.upside_down; }

HostCellState state_of(const CornerPointGrid& grid, const HostMesh& host, HostCellId source) {
  if (host.exists[source] != 0) return HostCellState::exists;
  const bool is_nothing = grid.active[source.index()] != 0 && !(host.volume[source] > 0.0);
  return is_nothing ? HostCellState::none : HostCellState::inactive;
}

double cell_volume(const std::array<Vec3, 8>& corners, bool mirrored) {
  const double value = bilinear_hexahedron_volume(corners);
  return is_rounding(value, corners) ? 0.0 : std::max(0.0, mirrored ? -value : value);
}

/// Makes the cells of all columns of a lattice.
class CellMaker {
 public:
  CellMaker(const CornerPointGrid& grid, const RefinementLattice& lattice, HostMesh& host)
      : grid_(grid), lattice_(lattice), host_(host), has_conductance_(has_permeability(grid)) {}

  LatticeCells make(RefinementPlan& plan) {
    out_.columns.resize(lattice_.columns.size());
    out_.state.resize(lattice_.columns.size());
    out_.conductance.resize(lattice_.columns.size());
    for (std::size_t c = 0; c < lattice_.columns.size(); ++c) {
      if (lattice_.columns[c].is_refined)
        plan.columns[c].first_cell = add_refined(c);
      else
        add_unrefined(c);
      out_.columns[c].state = out_.state[c].data();
    }
    share_out();
    if (has_conductance_)
      for (std::size_t c = 0; c < lattice_.columns.size(); ++c) add_conductances(c);
    return std::move(out_);
  }

 private:
  [[nodiscard]] HostCellId source_at(const LatticeColumn& column, std::int64_t place) const {
    return grid_.cell_id(column.source[0], column.source[1], host_.corners.layer(place));
  }

  void add_unrefined(std::size_t c) {
    const LatticeColumn& column = lattice_.columns[c];
    const std::int64_t places = grid_.dimensions[2];
    const std::int64_t layer = grid_.dimensions[0] * grid_.dimensions[1];
    out_.columns[c].first_cell = source_at(column, 0).value();
    out_.columns[c].cell_step = host_.corners.upside_down ? -layer : layer;
    for (std::int64_t place = 0; place < places; ++place) {
      const HostCellId source = source_at(column, place);
      out_.state[c].push_back(state_of(grid_, host_, source));
    }
  }

  void add_conductances(std::size_t c) {
    const LatticeColumn& column = lattice_.columns[c];
    const ColumnCorners of_source(host_.corners, host_.vertices, column.source[0], column.source[1]);
    for (std::size_t place = 0; place < out_.state[c].size(); ++place) {
      const auto number = static_cast<std::int64_t>(place);
      const HostCellId cell = out_.columns[c].cell(number).id;
      std::array<Vec3, 8> points;
      if (column.is_refined)
        points = points_of(corners_of(c, place));
      else
        points = of_source.corners(number);
      out_.conductance[c].push_back(host_conductances(points, host_rock(grid_, host_, cell).effective()));
    }
    out_.columns[c].conductance = out_.conductance[c].data();
  }

  HostCellId add_refined(std::size_t c) {
    const LatticeColumn& column = lattice_.columns[c];
    const HostCellId first(host_.volume.size());
    out_.columns[c].first_cell = first.value();
    out_.columns[c].cell_step = 1;
    for (std::size_t place = 0; place < column.layers->cells.size(); ++place) add_cell(c, place);
    return first;
  }

  /// The four touches of a column's corners, di + 2 dj.
  [[nodiscard]] std::array<std::int32_t, 4> corner_touches(std::size_t c) const {
    const auto first = [&](ColumnSide side) { return lattice_.side(static_cast<std::int32_t>(c), side).front(); };
    return {first(ColumnSide::south), first(ColumnSide::east), first(ColumnSide::west), first(ColumnSide::north)};
  }

  /// In the lattice's vertices.
  [[nodiscard]] std::array<VertexId, 8> corners_of(std::size_t c, std::size_t place) const {
    const auto touches = corner_touches(c);
    std::array<VertexId, 8> corners;
    for (std::size_t n = 0; n < 8; ++n) corners[n] = lattice_.node(touches[n % 4], 2 * place + n / 4);
    return corners;
  }

  [[nodiscard]] std::array<Vec3, 8> points_of(const std::array<VertexId, 8>& corners) const {
    std::array<Vec3, 8> points;
    for (std::size_t n = 0; n < 8; ++n) points[n] = lattice_.nodes[corners[n]];
    return points;
  }

  void add_cell(std::size_t c, std::size_t place) {
    const LatticeColumn& column = lattice_.columns[c];
    const auto corners = corners_of(c, place);  // refine_host() turns them into the host's
    const auto points = points_of(corners);
    const bool is_flat = std::equal(corners.begin(), corners.begin() + 4, corners.begin() + 4);
    const ColumnLayers::Cell& cell = column.layers->cells[place];
    const double volume = is_flat ? 0.0 : cell_volume(points, is_mirrored(host_));
    const auto pieces = volume > 0.0 ? pieces_of(column, cell, volume) : std::vector<Piece>{};
    const bool exists =
        std::any_of(pieces.begin(), pieces.end(), [&](const Piece& piece) { return host_.exists[piece.source] != 0; });
    host_.volume.push_back(volume);
    host_.exists.push_back(exists ? 1 : 0);
    host_.refined.corners.push_back(corners);
    host_.refined.parent.push_back(parent_of(column, cell, pieces));
    for (const Piece& piece : pieces) {
      host_.refined.piece_source.push_back(piece.source);
      host_.refined.piece_fraction.push_back(piece.volume);
      host_.refined.piece_box.push_back(piece.box);
    }
    host_.refined.piece_start.push_back(static_cast<std::int64_t>(host_.refined.piece_source.size()));
    out_.state[c].push_back(exists         ? HostCellState::exists
                            : volume > 0.0 ? HostCellState::inactive
                                           : empty_state(column, cell));
  }

  /// Of a cell without volume: all of it inactive, or in part nothing.
  [[nodiscard]] HostCellState empty_state(const LatticeColumn& column, const ColumnLayers::Cell& cell) const {
    for (std::int64_t place = cell.upper.place; place <= cell.lower.place; ++place)
      if (state_of(grid_, host_, source_at(column, place)) != HostCellState::inactive) return HostCellState::none;
    return HostCellState::inactive;
  }

  [[nodiscard]] std::vector<Piece> pieces_of(const LatticeColumn& column, const ColumnLayers::Cell& cell,
                                             double volume) const {
    if (cell.upper.place == cell.lower.place)
      return {{source_at(column, cell.upper.place), volume, box_of(column, cell.upper.fraction, cell.lower.fraction)}};
    std::vector<Piece> pieces;
    for (std::int64_t place = cell.upper.place; place <= cell.lower.place; ++place) {
      const double low = place == cell.upper.place ? cell.upper.fraction : 0.0;
      const double high = place == cell.lower.place ? cell.lower.fraction : 1.0;
      const double part = low < high ? part_volume(column, {place, low}, {place, high}) : 0.0;
      if (part > 0.0) pieces.push_back({source_at(column, place), part, box_of(column, low, high)});
    }
    return pieces;
  }

  [[nodiscard]] PieceBox box_of(const LatticeColumn& column, double upper, double lower) const {
    const auto low = lattice_.place_in(column, column.low);
    const auto high = lattice_.place_in(column, column.high);
    if (host_.corners.upside_down) return {{low[0], low[1], 1.0 - lower}, {high[0], high[1], 1.0 - upper}};
    return {{low[0], low[1], upper}, {high[0], high[1], lower}};
  }

  [[nodiscard]] double part_volume(const LatticeColumn& column, const ColumnLevel& upper,
                                   const ColumnLevel& lower) const {
    const ColumnShape shape(grid_, host_, column.source[0], column.source[1]);
    const auto low = lattice_.place_in(column, column.low);
    const auto high = lattice_.place_in(column, column.high);
    std::array<Vec3, 8> points;
    for (std::size_t n = 0; n < 8; ++n)
      points[n] =
          shape.point((n & 1U) != 0 ? high[0] : low[0], (n & 2U) != 0 ? high[1] : low[1], n < 4 ? upper : lower);
    return cell_volume(points, is_mirrored(host_));
  }

  /// The largest part, of an existing source cell where there is one.
  [[nodiscard]] HostCellId parent_of(const LatticeColumn& column, const ColumnLayers::Cell& cell,
                                     const std::vector<Piece>& pieces) const {
    if (pieces.empty()) return source_at(column, cell.upper.place);
    const auto smaller = [&](const Piece& a, const Piece& b) {
      return std::pair(host_.exists[a.source], a.volume) < std::pair(host_.exists[b.source], b.volume);
    };
    return std::max_element(pieces.begin(), pieces.end(), smaller)->source;
  }

  /// Parts become fractions of their source cells, and share out the pore volume of those that exist.
  void share_out() {
    RefinedCells& refined = host_.refined;
    std::unordered_map<std::int64_t, double> whole;
    for (std::size_t p = 0; p < refined.piece_source.size(); ++p)
      whole[refined.piece_source[p].value()] += refined.piece_fraction[p];
    for (std::size_t c = 0; c < refined.size(); ++c) {
      double pore_volume = 0.0;
      for (auto p = static_cast<std::size_t>(refined.piece_start[c]);
           p < static_cast<std::size_t>(refined.piece_start[c + 1]); ++p) {
        const HostCellId source = refined.piece_source[p];
        refined.piece_fraction[p] /= whole.at(source.value());
        if (host_.exists[source] != 0) pore_volume += refined.piece_fraction[p] * host_.pore_volume[source];
      }
      host_.pore_volume.push_back(pore_volume);
    }
  }

  const CornerPointGrid& grid_;
  const RefinementLattice& lattice_;
  HostMesh& host_;
  bool has_conductance_;
  LatticeCells out_;
};

/// Writes the faces of a lattice, in its own vertices.
class FaceMaker {
 public:
  FaceMaker(const CornerPointGrid& grid, const RefinementLattice& lattice, const LatticeCells& cells,
            const HostMesh& host)
      : grid_(grid), lattice_(lattice), cells_(cells), host_(host), vertices_(lattice.nodes) {}

  FaceReplacement make() {
    for (const LatticeStrip& strip : lattice_.strips) cut(strip);
    out_.cuts.number_from(VertexId(vertices_.size()));
    vertices_.raw().insert(vertices_.end(), out_.cuts.crossings.begin(), out_.cuts.crossings.end());
    HostFaceWriter writer(out_.faces, vertices_, is_mirrored(host_));
    for (std::size_t s = 0; s < lattice_.strips.size(); ++s) add_strip(s, writer);
    for (std::size_t c = 0; c < lattice_.columns.size(); ++c)
      if (lattice_.columns[c].is_refined) add_horizons(static_cast<std::int32_t>(c), writer);
    out_.is_beside_split.resize(out_.faces.size(), 0);
    return std::move(out_);
  }
  [[nodiscard]] const IdVector<VertexId, Vec3>& vertices() const { return vertices_; }

 private:
  [[nodiscard]] Strip strip_of(const LatticeStrip& from) const {
    Strip strip;
    strip.axis = from.axis;
    for (std::size_t s = 0; s < 2; ++s) {
      const auto& side = from.sides[s];
      if (side.column < 0) continue;
      const auto pillar = [&](std::int32_t touch) {
        return static_cast<std::size_t>(lattice_.touches[static_cast<std::size_t>(touch)].pillar);
      };
      strip.first_p = lattice_.first_node[pillar(side.touch_p)];
      strip.first_q = lattice_.first_node[pillar(side.touch_q)];
      strip.sides[s] = {lattice_.ranks(side.touch_p), lattice_.ranks(side.touch_q),
                        cells_.columns[static_cast<std::size_t>(side.column)]};
    }
    return strip;
  }

  void cut(const LatticeStrip& from) {
    StripCuts& out = out_.cuts;
    const Strip strip = strip_of(from);
    if (strip.is_matched()) {
      out.first_crossing.push_back(StripCuts::matched);
      out.cut_start.insert(out.cut_start.end(), 2, out.cuts.size());
      return;
    }
    const auto first = static_cast<std::int64_t>(out.crossings.size());
    overlay_.read(strip, first);
    out.first_crossing.push_back(first);
    // As in the host: a throw that changes by so many layers is damage, and would fill the memory.
    const auto levels = static_cast<std::int64_t>(std::max(strip.sides[0].p.size(), strip.sides[1].p.size()));
    if (overlay_.crossing_count() > 1000 * levels)
      throw InvalidInput(fmt::format("the layers on both sides of a fault cross in {} points; check ZCORN there",
                                     overlay_.crossing_count()));
    const auto& side = from.sides[from.sides[0].column < 0 ? 1 : 0];
    const auto pillars = [&](double depth) {
      return std::array{lattice_.on_pillar(grid_, host_, side.touch_p, depth),
                        lattice_.on_pillar(grid_, host_, side.touch_q, depth)};
    };
    overlay_.add_crossings(pillars, strip, lattice_.nodes, out);
  }

  void add_strip(std::size_t number, HostFaceWriter& writer) {
    const LatticeStrip& from = lattice_.strips[number];
    if (!from.exists()) return;
    const Strip strip = strip_of(from);
    const std::int64_t first_crossing = out_.cuts.first_crossing[number];
    if (first_crossing == StripCuts::matched) {
      add_matched_faces(strip, writer);
    } else {
      overlay_.read(strip, first_crossing);
      overlay_.add_faces(strip, writer);
    }
    out_.is_beside_split.resize(out_.faces.size(), is_split(from) ? 1 : 0);
  }

  /// The source columns on both sides have different layers.
  [[nodiscard]] bool is_split(const LatticeStrip& strip) {
    if (strip.sides[0].column < 0 || strip.sides[1].column < 0) return false;
    const auto source = [&](std::size_t side) {
      return lattice_.columns[static_cast<std::size_t>(strip.sides[side].column)].source;
    };
    if (source(0) == source(1)) return false;
    const HostCorners& corners = host_.corners;
    const auto number = [&](std::size_t side) { return source(side)[0] + corners.dimensions[0] * source(side)[1]; };
    const auto [known, is_new] = split_.try_emplace(2 * number(0) + static_cast<std::int64_t>(strip.axis), false);
    if (!is_new) return known->second;
    const int step = strip.axis == Axis::i ? 1 : 2;  // to the corner on the column's far side
    for (const int corner : {0, 3 - step}) {
      const std::int32_t* low = corners.on_pillar(number(0), corner + step);
      known->second = known->second || !std::equal(low, low + corners.levels(), corners.on_pillar(number(1), corner));
    }
    return known->second;
  }

  /// Tops and bases of a refined column, as those of the host (host_mesh.cpp).
  void add_horizons(std::int32_t column, HostFaceWriter& writer) {
    const auto places =
        static_cast<std::int64_t>(lattice_.columns[static_cast<std::size_t>(column)].layers->cells.size());
    std::int64_t upper = -1;  // the last place with thickness
    for (std::int64_t place = 0; place < places; ++place) {
      if (are_one(column, 2 * place, 2 * place + 1)) continue;
      add_between(column, upper, place, writer);
      upper = place;
    }
    if (upper >= 0) add_between(column, upper, -1, writer);
  }

  /// Two levels coincide all round the column.
  [[nodiscard]] bool are_one(std::int32_t column, std::int64_t a, std::int64_t b) const {
    for (const ColumnSide side : column_sides)
      for (const std::int32_t touch : lattice_.side(column, side)) {
        const auto ranks = lattice_.ranks(touch);
        if (ranks[static_cast<std::size_t>(a)] != ranks[static_cast<std::size_t>(b)]) return false;
      }
    return true;
  }

  /// Between two places that follow each other with nothing or only flat cells in between; -1: the column ends.
  void add_between(std::int32_t column, std::int64_t upper, std::int64_t lower, HostFaceWriter& writer) const {
    const HostColumn& cells = cells_.columns[static_cast<std::size_t>(column)];
    const FaceCell from = upper < 0 ? FaceCell{} : cells.cell(upper);
    const FaceCell to = lower < 0 ? FaceCell{} : cells.cell(lower);
    const bool both = from.state == HostCellState::exists && to.state == HostCellState::exists;
    const bool meet = upper >= 0 && lower >= 0 && are_one(column, 2 * upper + 1, 2 * lower);
    const bool pinched = lower != upper + 1;
    if (meet && !(both && pinched && !grid_.connects_across_pinch)) {
      add_horizon(column, 2 * lower, from, to, both && pinched, writer);
      return;
    }
    if (upper >= 0) add_horizon(column, 2 * upper + 1, from, FaceCell{}, false, writer);
    if (lower >= 0) add_horizon(column, 2 * lower, FaceCell{}, to, false, writer);
  }

  void add_horizon(std::int32_t column, std::int64_t level, const FaceCell& from, const FaceCell& to, bool is_pinch,
                   HostFaceWriter& writer) const {
    std::array<VertexId, 4> corner;
    const auto at = static_cast<std::size_t>(level);
    for (const ColumnSide side : column_sides) {
      const auto along = lattice_.side(column, side);
      corner[static_cast<std::size_t>(side)] = lattice_.node(along.front(), at);
      const bool is_low = side == ColumnSide::east || side == ColumnSide::north;
      for (std::size_t n = 0; n + 1 < along.size(); ++n) {
        writer.push(lattice_.node(along[n], at));
        const auto strip = static_cast<std::int64_t>(lattice_.strip_between(along[n], along[n + 1], side));
        const auto cuts = out_.cuts.cuts_of(strip, is_low ? 0 : 1, lattice_.ranks(along[is_low ? n : n + 1])[at],
                                            lattice_.ranks(along[is_low ? n + 1 : n])[at]);
        for (std::size_t c = 0; c < cuts.size(); ++c) writer.push(cuts[is_low ? c : cuts.size() - 1 - c]);
      }
    }
    writer.close_horizon(from, to, corner, is_pinch);
  }

  const CornerPointGrid& grid_;
  const RefinementLattice& lattice_;
  const LatticeCells& cells_;
  const HostMesh& host_;
  IdVector<VertexId, Vec3> vertices_;  ///< nodes, then crossings
  FaceReplacement out_;
  StripOverlay overlay_;
  std::unordered_map<std::int64_t, bool> split_;  ///< by twice the low column, and axis
};

/// i + nx j for each source column: 1 refined.
std::vector<std::uint8_t> refined_columns(const CornerPointGrid& grid, const RefinementPlan& plan) {
  const auto [nx, ny, nz] = grid.dimensions;
  std::vector<std::uint8_t> out(static_cast<std::size_t>(nx * ny), 0);
  std::unordered_map<std::int64_t, std::int64_t> area;
  for (const RefinedColumn& column : plan.columns) {
    const std::int64_t number = column.source[0] + nx * column.source[1];
    area[number] += (column.high[0] - column.low[0]) * (column.high[1] - column.low[1]);
    out.at(static_cast<std::size_t>(number)) = 1;
  }
  for (const auto& [number, covered] : area)
    if (covered != plan.unit[0] * plan.unit[1])
      throw InvalidInput(
          fmt::format("the refined columns do not cover column ({}, {})", number % nx + 1, number / nx + 1));
  return out;
}

void check_layers(const CornerPointGrid& grid, const RefinementPlan& plan) {
  const auto key = [](const ColumnLevel& level) { return std::pair(level.place, level.fraction); };
  for (const ColumnLayers& layers : plan.layers) {
    ColumnLevel last{0, 0.0};
    for (const ColumnLayers::Cell& cell : layers.cells)
      for (const ColumnLevel& level : {cell.upper, cell.lower}) {
        if (key(level) < key(last) || level.place >= grid.dimensions[2] || !(level.fraction <= 1.0))
          throw InvalidInput(fmt::format("level {} of place {} is not in order in the layers of a refined column",
                                         level.fraction, level.place + 1));
        last = level;
      }
  }
}

/// Gives the lattice's vertices their ids in the host; new ones are added to it.
IdVector<VertexId, VertexId> number_vertices(const RefinementLattice& lattice, const IdVector<VertexId, Vec3>& vertices,
                                             HostMesh& host) {
  require_ids(host.vertices.size() + vertices.size(), "vertices");
  IdVector<VertexId, VertexId> in_host(vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const VertexId vertex(v);
    const bool is_known = v < lattice.host_vertex.size() && lattice.host_vertex[vertex].is_valid();
    in_host[vertex] = is_known ? lattice.host_vertex[vertex] : host.vertices.push_back(vertices[vertex]);
  }
  return in_host;
}

}  // namespace

void refine_host(const CornerPointGrid& grid, RefinementPlan& plan, HostMesh& host) {
  if (plan.empty()) return;
  if (host.refined.size() > 0) throw InvalidInput("the host is refined already");
  check_layers(grid, plan);
  const auto is_refined = refined_columns(grid, plan);
  const RefinementLattice lattice = make_lattice(grid, host, plan, is_refined);
  const LatticeCells cells = CellMaker(grid, lattice, host).make(plan);
  FaceMaker faces(grid, lattice, cells, host);
  FaceReplacement replacement = faces.make();
  replacement.is_refined = is_refined;
  replacement.in_host = number_vertices(lattice, faces.vertices(), host);
  for (VertexId& v : replacement.faces.vertices) v = replacement.in_host[v];
  for (auto& corners : host.refined.corners)
    for (VertexId& v : corners) v = replacement.in_host[v];
  host.refined.is_refined.assign(static_cast<std::size_t>(grid.cell_count()), 0);
  for (std::size_t c = 0; c < host.refined.is_refined.size(); ++c)
    host.refined.is_refined[c] = is_refined[c % is_refined.size()];
  replace_faces(lattice, replacement, host);
  balance_cut_tops(host);
}

}  // namespace wellknit
