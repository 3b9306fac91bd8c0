// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/write_vtu.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "model/mesh_topology.h"
#include "model/quality.h"

namespace wellknit {

namespace {

constexpr std::uint8_t vtk_hexahedron = 12;
constexpr std::uint8_t vtk_polyhedron = 42;

template <class T>
constexpr std::string_view vtk_type() {
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
  if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
}

/// The XML head with its DataArray elements, and the raw block that they point into.
class AppendedArrays {
 public:
  /// One row per point or cell, of `components` numbers.
  template <class Array>
  std::string element(std::string_view name, const Array& values, int components = 1) {
    using T = typename Array::value_type;
    std::string escaped;
    for (const char c : name)
      escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
    const std::string xml = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
        vtk_type<T>(), escaped, components, block_.size());
    const std::uint64_t bytes = values.size() * sizeof(T);
    append(&bytes, sizeof bytes);
    append(values.data(), bytes);
    return xml;
  }
  [[nodiscard]] const std::string& block() const { return block_; }

 private:
  void append(const void* data, std::size_t bytes) {
    if (bytes > 0) block_.append(static_cast<const char*>(data), bytes);
  }
  std::string block_;
};

double up(double depth) { return depth == 0.0 ? 0.0 : -depth; }  // no negative zero

std::vector<double> flat_points(std::span<const Vec3> points) {
  std::vector<double> out;
  out.reserve(3 * points.size());
  for (const Vec3& p : points) out.insert(out.end(), {p.x(), p.y(), up(p.z())});
  return out;
}

std::vector<double> flat(std::span<const Vec3> values) {
  std::vector<double> out;
  out.reserve(3 * values.size());
  for (const Vec3& v : values) out.insert(out.end(), {v.x(), v.y(), v.z()});
  return out;
}

template <class Array, class Function>
auto mapped(const Array& values, Function function) {
  std::vector<decltype(function(values.front()))> out;
  out.reserve(values.size());
  for (const auto& v : values) out.push_back(function(v));
  return out;
}

/// A cell's outer surface in the mirrored frame: every ring turns outwards after z has changed its sign.
class CellSurface {
 public:
  void assign(const Mesh& mesh, std::span<const CellFace> faces) {
    start_.assign(1, 0);
    vertices_.clear();
    for (const CellFace& side : faces) {
      const auto loop = mesh.faces.loop(side.face);
      // Outward in (x, y, depth) is inward in (x, y, -depth).
      if (side.outward)
        vertices_.insert(vertices_.end(), loop.rbegin(), loop.rend());
      else
        vertices_.insert(vertices_.end(), loop.begin(), loop.end());
      start_.push_back(vertices_.size());
    }
    points_ = vertices_;
    std::sort(points_.begin(), points_.end());
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
  }

  [[nodiscard]] std::size_t size() const { return start_.size() - 1; }
  [[nodiscard]] std::span<const VertexId> ring(std::size_t face) const {
    return std::span(vertices_).subspan(start_[face], start_[face + 1] - start_[face]);
  }
  /// Sorted, each once.
  [[nodiscard]] const std::vector<VertexId>& points() const { return points_; }

  /// The eight points in VTK's order when the surface is that of a hexahedron.
  [[nodiscard]] std::optional<std::array<VertexId, 8>> hexahedron() const {
    if (size() != 6 || points_.size() != 8 || vertices_.size() != 24) return std::nullopt;
    for (std::size_t f = 0; f < 6; ++f)
      if (ring(f).size() != 4) return std::nullopt;
    // VTK's base looks into the cell: the reverse of an outward ring.
    std::array<VertexId, 8> out;
    std::reverse_copy(ring(0).begin(), ring(0).end(), out.begin());
    for (std::size_t i = 0; i < 4; ++i) {
      const std::optional<VertexId> top = neighbour_off_base(out[i]);
      if (!top) return std::nullopt;
      out[4 + i] = *top;
    }
    return is_ring({out[4], out[5], out[6], out[7]}) ? std::optional(out) : std::nullopt;
  }

 private:
  [[nodiscard]] bool on_base(VertexId v) const { return std::count(ring(0).begin(), ring(0).end(), v) > 0; }

  /// The one vertex outside of the first face that an edge joins to v.
  [[nodiscard]] std::optional<VertexId> neighbour_off_base(VertexId v) const {
    std::optional<VertexId> found;
    for (std::size_t f = 1; f < 6; ++f) {
      const auto loop = ring(f);
      for (std::size_t i = 0; i < 4; ++i) {
        const VertexId next = loop[(i + 1) % 4];
        if (loop[i] != v || on_base(next)) continue;
        if (found && *found != next) return std::nullopt;
        found = next;
      }
    }
    return found;
  }

  /// Whether one of the faces is this ring, from any start. Outward, the top runs as VTK's order has it.
  [[nodiscard]] bool is_ring(std::array<VertexId, 4> wanted) const {
    for (std::size_t f = 1; f < 6; ++f) {
      const auto loop = ring(f);
      for (std::size_t turn = 0; turn < 4; ++turn) {
        std::rotate(wanted.begin(), wanted.begin() + 1, wanted.end());
        if (std::equal(wanted.begin(), wanted.end(), loop.begin())) return true;
      }
    }
    return false;
  }

  std::vector<std::size_t> start_;
  std::vector<VertexId> vertices_;
  std::vector<VertexId> points_;
};

/// The cells as VTK's legacy polyhedron form has them.
struct VtkCells {
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets;
  std::vector<std::uint8_t> types;
  std::vector<std::int64_t> faces;         ///< per polyhedron: number of faces, then per face its size and its points
  std::vector<std::int64_t> face_offsets;  ///< the END of each polyhedron's stream; -1 for other cells
};

void add_polyhedron(const CellSurface& surface, VtkCells& out) {
  for (const VertexId v : surface.points()) out.connectivity.push_back(v.value());
  out.faces.push_back(static_cast<std::int64_t>(surface.size()));
  for (std::size_t f = 0; f < surface.size(); ++f) {
    out.faces.push_back(static_cast<std::int64_t>(surface.ring(f).size()));
    for (const VertexId v : surface.ring(f)) out.faces.push_back(v.value());
  }
  out.face_offsets.push_back(static_cast<std::int64_t>(out.faces.size()));
  out.types.push_back(vtk_polyhedron);
}

VtkCells vtk_cells(const Mesh& mesh) {
  const CellFaces faces = faces_of_cells(mesh);
  VtkCells out;
  CellSurface surface;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    surface.assign(mesh, faces.of(CellId(c)));
    const bool host = mesh.cells.kind[CellId(c)] < CellKind::transition;
    const auto hexahedron = host ? surface.hexahedron() : std::nullopt;
    if (hexahedron) {
      for (const VertexId v : *hexahedron) out.connectivity.push_back(v.value());
      out.face_offsets.push_back(-1);
      out.types.push_back(vtk_hexahedron);
    } else {
      add_polyhedron(surface, out);
    }
    out.offsets.push_back(static_cast<std::int64_t>(out.connectivity.size()));
  }
  return out;
}

std::string cell_data(AppendedArrays& arrays, const Mesh& mesh) {
  const Cells& cells = mesh.cells;
  std::string xml;
  xml +=
      arrays.element("kind", mapped(cells.kind.raw(), [](CellKind kind) { return static_cast<std::uint8_t>(kind); }));
  xml += arrays.element("center", flat_points(cells.center.raw()), 3);
  xml += arrays.element("volume", cells.volume.raw());
  xml += arrays.element("depth", cells.depth.raw());
  xml += arrays.element("source_cell", mapped(cells.source_cell.raw(), [](HostCellId cell) { return cell.value(); }));
  xml += arrays.element("well",
                        mapped(cells.well.raw(), [](WellId well) { return static_cast<std::int32_t>(well.value()); }));
  xml += arrays.element("radial_segment",
                        mapped(cells.radial_index.raw(), [](const RadialIndex& at) { return at.segment; }));
  xml += arrays.element("radial_sector",
                        mapped(cells.radial_index.raw(), [](const RadialIndex& at) { return at.sector; }));
  xml += arrays.element("radial_ring", mapped(cells.radial_index.raw(), [](const RadialIndex& at) { return at.ring; }));
  xml += arrays.element("pore_volume", cells.pore_volume.raw());
  xml += arrays.element("porosity", cells.porosity.raw());
  xml += arrays.element("net_to_gross", cells.net_to_gross.raw());
  xml += arrays.element("permeability", flat(cells.permeability.raw()), 3);

  const CellQuality quality = cell_quality(mesh);
  xml += arrays.element("max_non_orthogonality", quality.max_non_orthogonality.raw());
  xml += arrays.element("max_k_non_orthogonality", quality.max_k_non_orthogonality.raw());
  xml += arrays.element("max_planarity", quality.max_planarity.raw());
  xml += arrays.element("min_transmissibility", quality.min_transmissibility.raw());
  xml += arrays.element("centring", quality.centring.raw());
  if (mesh.flow) xml += arrays.element("pressure", mesh.flow->pressure.raw());
  for (const auto& [keyword, property] : cells.properties)
    xml += std::visit([&, &key = keyword](const auto& values) { return arrays.element(key, values); }, property);
  return xml;
}

std::string grid_xml(AppendedArrays& arrays, const Mesh& mesh) {
  const VtkCells cells = vtk_cells(mesh);
  std::string xml =
      fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", mesh.vertices.size(), mesh.cells.size());
  xml += "<Points>\n" + arrays.element("Points", flat_points(mesh.vertices.raw()), 3) + "</Points>\n<Cells>\n";
  xml += arrays.element("connectivity", cells.connectivity);
  xml += arrays.element("offsets", cells.offsets);
  xml += arrays.element("types", cells.types);
  xml += arrays.element("faces", cells.faces);
  xml += arrays.element("faceoffsets", cells.face_offsets);
  xml += "</Cells>\n<CellData Scalars=\"kind\">\n" + cell_data(arrays, mesh) + "</CellData>\n</Piece>\n";
  return xml;
}

}  // namespace

void write_vtu(const Mesh& mesh, const std::string& path, Overwrite overwrite) {
  OutputStream out(path, overwrite);
  AppendedArrays arrays;
  const std::string grid = grid_xml(arrays, mesh);
  const std::string_view order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
  // Version 1.0 with 64-bit headers: what every VTK since 5.10 reads, polyhedra in their legacy arrays included.
  out.stream() << fmt::format(
                      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" "
                      "header_type=\"UInt64\">\n",
                      order)
               << "<UnstructuredGrid>\n"
               << grid << "</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  out.stream().write(arrays.block().data(), static_cast<std::streamsize>(arrays.block().size()));
  out.stream() << "\n</AppendedData>\n</VTKFile>\n";
  out.commit();
}

}  // namespace wellknit
