// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/property_transfer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "algorithm/host_transmissibility.h"
#include "algorithm/rock_tensor.h"

namespace wellknit {

namespace {

/// Bulk volume of a source cell that lies in a made cell, m3.
struct Overlap {
  HostCellId source;
  CellId cell;
  double volume = 0.0;
};

/// Sample points of a tetrahedron: barycentric coordinates of the points of a 4-point rule of degree 2 (weights 1/4).
constexpr double near_weight = 0.58541019662496852;
constexpr double far_weight = 0.13819660112501050;

struct Corners {
  std::array<Vec3, 4> p;
};

/// Samples a tetrahedron, halving its longest edge until a part is small beside the source cells, and adds volumes by
/// source cell.
class TetrahedronSampler {
 public:
  TetrahedronSampler(const CellLocator& locator, double part_volume) : locator_(locator), part_volume_(part_volume) {}

  void add(const Corners& t, int depth = 0) {
    const double volume = std::abs((t.p[1] - t.p[0]).cross(t.p[2] - t.p[0]).dot(t.p[3] - t.p[0])) / 6.0;
    if (volume > part_volume_ && depth < 12) {
      halve(t, depth);
      return;
    }
    const Vec3 sum = t.p[0] + t.p[1] + t.p[2] + t.p[3];
    for (const Vec3& corner : t.p) {
      const Vec3 x = far_weight * (sum - corner) + near_weight * corner;
      const auto location = locator_.locate(x, hint_);
      if (!location) continue;
      hint_ = location->cell;
      volumes_[hint_] += 0.25 * volume;
    }
  }

  [[nodiscard]] const std::map<HostCellId, double>& volumes() const { return volumes_; }

 private:
  void halve(const Corners& t, int depth) {
    std::size_t a = 0;
    std::size_t b = 1;
    double longest = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j)
        if (const double length = (t.p[i] - t.p[j]).squaredNorm(); length > longest) {
          longest = length;
          a = i;
          b = j;
        }
    const Vec3 middle = 0.5 * (t.p[a] + t.p[b]);
    Corners one = t;
    Corners two = t;
    one.p[a] = middle;
    two.p[b] = middle;
    add(one, depth + 1);
    add(two, depth + 1);
  }

  const CellLocator& locator_;
  double part_volume_;
  HostCellId hint_;
  std::map<HostCellId, double> volumes_;
};

/// Faces of each cell as lists of ids.
std::vector<std::vector<FaceId>> faces_of_cells(const Mesh& mesh) {
  std::vector<std::vector<FaceId>> out(mesh.cells.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const CellId c : mesh.faces.cells[FaceId(f)])
      if (c.is_valid() && mesh.cells.kind[c] >= CellKind::transition) out[c.index()].push_back(FaceId(f));
  return out;
}

/// The source cell that holds all vertices and the centroid of a made cell; none where they lie in several.
HostCellId single_source(const Mesh& mesh, const CellLocator& locator, const std::vector<FaceId>& faces, CellId cell) {
  const auto first = locator.locate(mesh.cells.centroid[cell]);
  if (!first) return {};
  for (const FaceId f : faces)
    for (const VertexId v : mesh.faces.loop(f))
      if (!locator.locate_in(first->cell, mesh.vertices[v])) return {};
  return first->cell;
}

std::vector<Overlap> sample_overlaps(const Mesh& mesh, const CellLocator& locator, double part_volume,
                                     std::int64_t first_made) {
  const auto faces = faces_of_cells(mesh);
  const std::size_t first = static_cast<std::size_t>(first_made);
  std::vector<std::vector<Overlap>> parts(mesh.cells.size() - first);
  tbb::parallel_for(first, mesh.cells.size(), [&](std::size_t c) {
    if (const HostCellId only = single_source(mesh, locator, faces[c], CellId(c)); only.is_valid()) {
      parts[c - first].push_back({only, CellId(c), mesh.cells.volume[CellId(c)]});
      return;
    }
    TetrahedronSampler sampler(locator, part_volume);
    for (const FaceId f : faces[c]) {
      std::vector<Vec3> points;
      for (const VertexId v : mesh.faces.loop(f)) points.push_back(mesh.vertices[v]);
      const Vec3 mean = polygon_geometry(points).mean;
      for (std::size_t i = 0; i < points.size(); ++i)
        sampler.add({{mesh.cells.centroid[CellId(c)], mean, points[i], points[(i + 1) % points.size()]}});
    }
    for (const auto& [source, volume] : sampler.volumes()) parts[c - first].push_back({source, CellId(c), volume});
  });
  std::vector<Overlap> out;
  for (const auto& p : parts) out.insert(out.end(), p.begin(), p.end());
  return out;
}

/// Volume of each source cell that removed cells held, m3.
class RemovedVolumes {
 public:
  RemovedVolumes(const HostMesh& host, const std::vector<TransitionMesh>& cavities) : host_(host) {
    for (const TransitionMesh& c : cavities)
      for (const HostCellId cell : c.cavity.removed_cells) add(cell);
  }

  struct Part {
    double volume = 0.0;
    HostCellId cell;  ///< the first that held some of it
  };
  [[nodiscard]] const std::map<HostCellId, Part>& parts() const { return parts_; }
  [[nodiscard]] double operator[](HostCellId source) const {
    const auto found = parts_.find(source);
    return found == parts_.end() ? 0.0 : found->second.volume;
  }

 private:
  void add(HostCellId cell) {
    if (cell.index() < host_.source_count()) return add(cell, cell, host_.volume[cell]);
    const RefinedCells& refined = host_.refined;
    const std::size_t number = cell.index() - host_.source_count();
    for (auto p = static_cast<std::size_t>(refined.piece_start[number]);
         p < static_cast<std::size_t>(refined.piece_start[number + 1]); ++p)
      add(refined.piece_source[p], cell, refined.piece_fraction[p] * host_.volume[refined.piece_source[p]]);
  }
  void add(HostCellId source, HostCellId cell, double volume) {
    Part& part = parts_[source];
    part.volume += volume;
    if (!part.cell.is_valid()) part.cell = cell;
  }

  const HostMesh& host_;
  std::map<HostCellId, Part> parts_;
};

/// Factor that makes a sum the wanted one. A cell turned inside out, which the mesh check tells of, is not filled.
double scale(double wanted, double sum) { return wanted > 0.0 && sum > 0.0 ? wanted / sum : 1.0; }

/// Scales rows and columns in turn until sources give their volumes and cells are filled (iterative proportional
/// fitting), sources last: their sums are what conserves pore volume.
void balance(std::vector<Overlap>& overlaps, const HostMesh& host, const RemovedVolumes& removed, const Mesh& mesh) {
  std::vector<double> by_cell(mesh.cells.size());
  std::vector<double> by_source(host.source_count());
  std::vector<double> wanted;
  for (const Overlap& o : overlaps) wanted.push_back(removed[o.source]);
  for (int round = 0; round < 30; ++round) {
    std::fill(by_cell.begin(), by_cell.end(), 0.0);
    for (const Overlap& o : overlaps) by_cell[o.cell.index()] += o.volume;
    for (Overlap& o : overlaps) o.volume *= scale(mesh.cells.volume[o.cell], by_cell[o.cell.index()]);
    for (const Overlap& o : overlaps) by_source[o.source.index()] = 0.0;
    for (const Overlap& o : overlaps) by_source[o.source.index()] += o.volume;
    for (std::size_t n = 0; n < overlaps.size(); ++n)
      overlaps[n].volume *= scale(wanted[n], by_source[overlaps[n].source.index()]);
  }
}

/// Source cells that no sample met give their volume to the made cell with the nearest centre.
void add_unmet(const RemovedVolumes& removed, const HostMesh& host, const Mesh& mesh, std::int64_t first_made,
               std::vector<Overlap>& overlaps) {
  std::vector<std::uint8_t> is_met(host.source_count(), 0);
  for (const Overlap& o : overlaps) is_met[o.source.index()] = 1;
  for (const auto& [source, part] : removed.parts()) {
    if (is_met[source.index()] != 0 || !(part.volume > 0.0)) continue;
    const Vec3 center = host_cell_center(host, part.cell);
    CellId best;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t m = static_cast<std::size_t>(first_made); m < mesh.cells.size(); ++m)
      if (const double d = (mesh.cells.center[CellId(m)] - center).squaredNorm(); d < nearest) {
        nearest = d;
        best = CellId(m);
      }
    overlaps.push_back({source, best, part.volume});
  }
}

/// Samples that fell into cells that were kept, by the chord error of curved faces, are not overlaps.
void drop_kept(const RemovedVolumes& removed, std::vector<Overlap>& overlaps) {
  std::erase_if(overlaps, [&](const Overlap& o) { return !(removed[o.source] > 0.0) || !(o.volume > 0.0); });
}

/// What kept cells hold of the source cells: all of one, or its parts in refined cells.
void add_kept(const HostMesh& host, const Assembly& assembly, std::vector<Overlap>& overlaps) {
  const RefinedCells& refined = host.refined;
  for (std::size_t c = 0; c < assembly.host_cell.size(); ++c) {
    const HostCellId from = assembly.host_cell[c];
    if (from.index() < host.source_count()) {
      overlaps.push_back({from, CellId(c), host.volume[from]});
      continue;
    }
    const std::size_t number = from.index() - host.source_count();
    for (auto p = static_cast<std::size_t>(refined.piece_start[number]);
         p < static_cast<std::size_t>(refined.piece_start[number + 1]); ++p)
      overlaps.push_back(
          {refined.piece_source[p], CellId(c), refined.piece_fraction[p] * host.volume[refined.piece_source[p]]});
  }
}

void write_transfer(const CornerPointGrid& grid, const HostMesh& host, std::vector<Overlap> overlaps,
                    Assembly& assembly) {
  add_kept(host, assembly, overlaps);
  // A folded source cell has no volume to give, though parts of it may have.
  std::erase_if(overlaps, [&](const Overlap& o) { return !(host.volume[o.source] > 0.0); });
  std::sort(overlaps.begin(), overlaps.end(), [](const Overlap& a, const Overlap& b) {
    return a.source != b.source ? a.source < b.source : a.cell < b.cell;
  });
  Transfer& transfer = assembly.mesh.transfer;
  const auto sources = static_cast<std::ptrdiff_t>(grid.cell_count());
  assembly.mesh.source_volumes = {{host.volume.begin(), host.volume.begin() + sources},
                                  {host.pore_volume.begin(), host.pore_volume.begin() + sources}};
  for (std::size_t c = 0; c < static_cast<std::size_t>(sources); ++c)
    if (host.exists[HostCellId(c)] == 0) assembly.mesh.source_volumes.pores[c] = 0.0;
  transfer.start.assign(static_cast<std::size_t>(grid.cell_count()) + 1, 0);
  for (const Overlap& o : overlaps) {
    ++transfer.start[o.source.index() + 1];
    transfer.cell.push_back(o.cell);
    transfer.fraction.push_back(o.volume / host.volume[o.source]);
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(grid.cell_count()); ++c) {
    transfer.start[c + 1] += transfer.start[c];
    double sum = 0.0;
    for (std::int64_t at = transfer.start[c]; at < transfer.start[c + 1]; ++at)
      sum += transfer.fraction[static_cast<std::size_t>(at)];
    for (std::int64_t at = transfer.start[c]; at < transfer.start[c + 1]; ++at)
      transfer.fraction[static_cast<std::size_t>(at)] /= sum;
  }
}

double value_or(const std::vector<double>& values, HostCellId cell, double otherwise) {
  return values.empty() ? otherwise : values[cell.index()];
}

/// Sums over the sources of each mesh cell.
struct Sums {
  double bulk = 0.0;  ///< of active sources, m3
  double porosity = 0.0;
  double net_to_gross = 0.0;
  double pore_volume = 0.0;
  double net_bulk = 0.0;  ///< m3
  Vec3 permeability =
      Vec3::Zero();  ///< of net rock, arithmetic along x and y: times the mean net-to-gross it is the mean of k * ntg
  Vec3 gross_permeability = Vec3::Zero();
  double resistance = 0.0;  ///< volume over vertical permeability
};

/// Arithmetic horizontally, harmonic vertically; porosity and net-to-gross by volume; inactive sources give nothing.
void set_properties(const CornerPointGrid& grid, const HostMesh& host, Assembly& assembly) {
  Mesh& mesh = assembly.mesh;
  std::vector<Sums> sums(mesh.cells.size());
  const Transfer& transfer = mesh.transfer;
  for (std::size_t c = 0; c + 1 < transfer.start.size(); ++c) {
    const HostCellId source(c);
    if (host.exists[source] == 0) continue;
    const double porosity = value_or(grid.porosity, source, 0.0);
    const double ntg = value_or(grid.net_to_gross, source, 1.0);
    const Vec3 k(value_or(grid.permeability[0], source, 0.0), value_or(grid.permeability[1], source, 0.0),
                 value_or(grid.permeability[2], source, 0.0));
    for (std::int64_t at = transfer.start[c]; at < transfer.start[c + 1]; ++at) {
      Sums& s = sums[transfer.cell[static_cast<std::size_t>(at)].index()];
      const double v = transfer.fraction[static_cast<std::size_t>(at)] * host.volume[source];
      s.bulk += v;
      s.porosity += v * porosity;
      s.net_to_gross += v * ntg;
      s.pore_volume += transfer.fraction[static_cast<std::size_t>(at)] * host.pore_volume[source];
      s.net_bulk += v * ntg;
      s.permeability += v * ntg * k;
      s.gross_permeability += v * k;
      s.resistance += k.z() > 0.0 ? v / k.z() : std::numeric_limits<double>::infinity();
    }
  }
  Cells& cells = mesh.cells;
  cells.pore_volume.resize(cells.size());
  cells.porosity.resize(cells.size());
  cells.net_to_gross.resize(cells.size());
  cells.permeability.resize(cells.size(), Vec3::Zero());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const Sums& s = sums[c];
    const CellId cell(c);
    if (!(s.bulk > 0.0)) continue;  // wholly in inactive rock: no pores, no flow
    cells.pore_volume[cell] = s.pore_volume;
    cells.porosity[cell] = s.porosity / s.bulk;
    cells.net_to_gross[cell] = s.net_to_gross / s.bulk;
    const Vec3 lateral = s.net_bulk > 0.0 ? Vec3(s.permeability / s.net_bulk) : Vec3(s.gross_permeability / s.bulk);
    cells.permeability[cell] = {lateral.x(), lateral.y(), s.bulk / s.resistance};
  }
}

/// Source cell with the largest overlap, for integers; the first where several are equal.
std::vector<HostCellId> largest_sources(const Mesh& mesh, const HostMesh& host) {
  std::vector<HostCellId> source(mesh.cells.size());
  std::vector<double> largest(mesh.cells.size(), -1.0);
  const Transfer& t = mesh.transfer;
  for (std::size_t c = 0; c + 1 < t.start.size(); ++c)
    for (std::int64_t at = t.start[c]; at < t.start[c + 1]; ++at) {
      const auto i = static_cast<std::size_t>(at);
      // Active rock decides wherever there is any.
      const double share = t.fraction[i] * host.volume[HostCellId(c)] + (host.exists[HostCellId(c)] != 0 ? 1e30 : 0.0);
      const std::size_t cell = t.cell[i].index();
      if (share <= largest[cell]) continue;
      largest[cell] = share;
      source[cell] = HostCellId(c);
    }
  return source;
}

void carry_other_properties(const CornerPointGrid& grid, const HostMesh& host, Mesh& mesh) {
  if (grid.properties.empty()) return;
  const auto source = largest_sources(mesh, host);
  const Transfer& t = mesh.transfer;
  for (const auto& [keyword, values] : grid.properties) {
    if (const auto* integers = std::get_if<std::vector<std::int32_t>>(&values)) {
      std::vector<std::int32_t> out(mesh.cells.size(), 0);
      for (std::size_t c = 0; c < out.size(); ++c)
        if (source[c].is_valid()) out[c] = (*integers)[source[c].index()];
      mesh.cells.properties[keyword] = std::move(out);
      continue;
    }
    const auto& reals = std::get<std::vector<double>>(values);
    std::vector<double> sum(mesh.cells.size(), 0.0);
    std::vector<double> weight(mesh.cells.size(), 0.0);
    for (std::size_t c = 0; c + 1 < t.start.size(); ++c)
      for (std::int64_t at = t.start[c]; at < t.start[c + 1]; ++at) {
        const auto i = static_cast<std::size_t>(at);
        const double v = t.fraction[i] * host.volume[HostCellId(c)];
        sum[t.cell[i].index()] += v * reals[c];
        weight[t.cell[i].index()] += v;
      }
    for (std::size_t c = 0; c < sum.size(); ++c)
      if (weight[c] > 0.0) sum[c] /= weight[c];
    mesh.cells.properties[keyword] = std::move(sum);
  }
}

}  // namespace

void transfer_properties(const CornerPointGrid& grid, const HostMesh& host, const CellLocator& locator,
                         const std::vector<TransitionMesh>& cavities, Assembly& assembly) {
  std::vector<Overlap> overlaps;
  if (!cavities.empty()) {
    const std::int64_t first_made = assembly.first_transition_cell.front();
    double volume = 0.0;
    std::set<HostCellId> sources;
    for (const TransitionMesh& c : cavities)
      for (const HostCellId cell : c.cavity.removed_cells) {
        volume += host.volume[cell];
        sources.insert(host.source_of(cell));
      }
    // About 64 parts of four points in what is removed of a mean source cell.
    overlaps = sample_overlaps(assembly.mesh, locator, volume / static_cast<double>(64 * sources.size()), first_made);
    const RemovedVolumes removed(host, cavities);
    drop_kept(removed, overlaps);
    add_unmet(removed, host, assembly.mesh, first_made, overlaps);
    balance(overlaps, host, removed, assembly.mesh);
  }
  write_transfer(grid, host, std::move(overlaps), assembly);
  set_properties(grid, host, assembly);
  set_rock_axes(host, assembly);
  carry_other_properties(grid, host, assembly.mesh);
}

}  // namespace wellknit
