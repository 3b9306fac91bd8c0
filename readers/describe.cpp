// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/describe.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <set>

#include "model/units.h"
#include "readers/cell_arrays.h"
#include "readers/exported_hdf5.h"
#include "readers/file_content.h"
#include "readers/formats.h"
#include "readers/read_case.h"
#include "readers/read_egrid.h"
#include "readers/read_grid_file.h"
#include "readers/read_mesh.h"
#include "readers/read_trajectory.h"

namespace wellknit {

namespace {

template <class T>
void add_range(GridDescription& out, const CornerPointGrid& grid, const std::string& name, const std::vector<T>& values,
               double unit_size, const char* unit) {
  PropertyRange range{name, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), unit};
  for (std::size_t cell = 0; cell < values.size(); ++cell) {
    if (grid.active[cell] == 0) continue;
    range.least = std::min(range.least, static_cast<double>(values[cell]) / unit_size);
    range.most = std::max(range.most, static_cast<double>(values[cell]) / unit_size);
  }
  if (range.least <= range.most) out.properties.push_back(std::move(range));
}

void add_properties(GridDescription& out, const CornerPointGrid& grid) {
  add_range(out, grid, "PORO", grid.porosity, 1.0, "1");
  add_range(out, grid, "NTG", grid.net_to_gross, 1.0, "1");
  for (std::size_t axis = 0; axis < 3; ++axis)
    add_range(out, grid, std::string("PERM") + "XYZ"[axis], grid.permeability[axis], m2_per_millidarcy, "mD");
  for (const auto& [name, property] : grid.properties)
    std::visit([&, &key = name](const auto& values) { add_range(out, grid, key, values, 1.0, ""); }, property);
}

/// Volumes, extent and the count of cells turned inside out.
void measure_cells(GridDescription& out, const CornerPointGrid& grid) {
  out.least = Vec3::Constant(std::numeric_limits<double>::infinity());
  out.most = -out.least;
  double pore_volume = 0.0;
  std::int64_t negative = 0;
  std::int64_t positive = 0;
  for (std::size_t cell = 0; cell < grid.active.size(); ++cell) {
    if (grid.active[cell] == 0) continue;
    ++out.active_cells;
    const auto corners = grid.corners(HostCellId(cell));
    for (const Vec3& corner : corners) {
      out.least = out.least.cwiseMin(corner);
      out.most = out.most.cwiseMax(corner);
    }
    const double volume = bilinear_hexahedron_volume(corners);
    negative += volume < 0.0 ? 1 : 0;
    positive += volume > 0.0 ? 1 : 0;
    out.bulk_volume += volume;
    if (grid.porosity.empty()) continue;
    pore_volume += volume * grid.porosity[cell] * (grid.net_to_gross.empty() ? 1.0 : grid.net_to_gross[cell]);
  }
  out.is_right_handed = out.bulk_volume >= 0.0;
  out.inverted_cells = out.is_right_handed ? negative : positive;
  out.bulk_volume = std::abs(out.bulk_volume);
  if (!grid.porosity.empty()) out.pore_volume = std::abs(pore_volume);
  if (out.active_cells == 0) out.least = out.most = Vec3::Zero();
}

/// Different numbers in the active cells of every array that names regions.
void count_regions(EditsDescription& out, const CornerPointGrid& grid) {
  for (const auto& [name, property] : grid.properties) {
    const auto* numbers = std::get_if<std::vector<std::int32_t>>(&property);
    if (numbers == nullptr) continue;
    std::set<std::int32_t> seen;
    std::optional<std::int32_t> last;
    for (std::size_t cell = 0; cell < numbers->size(); ++cell) {
      if (grid.active[cell] == 0 || (*numbers)[cell] == last) continue;
      last = (*numbers)[cell];
      seen.insert(*last);
    }
    out.regions[name] = static_cast<std::int64_t>(seen.size());
  }
}

EditsDescription describe_edits(const CornerPointGrid& grid) {
  const ConnectionEdits& edits = grid.edits;
  EditsDescription out;
  for (const Fault& fault : edits.faults) out.faults.push_back({fault.name, fault.face_count(), fault.multiplier});
  for (const FaceDirection face : {FaceDirection::i_plus, FaceDirection::i_minus, FaceDirection::j_plus,
                                   FaceDirection::j_minus, FaceDirection::k_plus, FaceDirection::k_minus})
    if (!edits.face_multiplier[static_cast<std::size_t>(face)].empty())
      out.multipliers.push_back(multiplier_keyword(face));
  if (!edits.pore_volume_multiplier.empty() || !edits.pore_volume_multiplier_edit.empty())
    out.multipliers.emplace_back("MULTPV");
  if (!edits.least_pore_volume_by_cell.empty()) out.multipliers.emplace_back("MINPVV");
  out.region_multipliers = static_cast<std::int64_t>(edits.region_multipliers.size());
  out.region_pore_volumes = static_cast<std::int64_t>(edits.region_pore_volumes.size());
  out.non_neighbours = static_cast<std::int64_t>(edits.non_neighbours.size());
  out.edited_non_neighbours =
      static_cast<std::int64_t>(edits.non_neighbour_multipliers.size() + edits.non_neighbour_transmissibilities.size());
  for (const ArrayEdit& edit : edits.array_edits) ++out.array_edits[keyword_of(edit.array)];
  count_regions(out, grid);
  return out;
}

double largest_deviation(const Trajectory& trajectory) {
  double largest = 0.0;
  for (std::size_t n = 1; n < trajectory.points.size(); ++n) {
    const Vec3 step = trajectory.points[n] - trajectory.points[n - 1];
    largest = std::max(largest, std::atan2(std::hypot(step.x(), step.y()), step.z()));
  }
  return largest * 180.0 / std::numbers::pi;
}

const char* name_of(CellKind kind) {
  switch (kind) {
    case CellKind::host: return "host";
    case CellKind::refined: return "refined";
    case CellKind::transition: return "transition";
    case CellKind::radial: break;
  }
  return "radial";
}

MeshDescription describe(const MeshFile& file) {
  const Mesh& mesh = file.mesh;
  MeshDescription out;
  out.vertices = static_cast<std::int64_t>(mesh.vertices.size());
  out.faces = static_cast<std::int64_t>(mesh.faces.size());
  out.connections = static_cast<std::int64_t>(mesh.connections.size());
  for (const CellKind kind : mesh.cells.kind.raw()) ++out.cells[name_of(kind)];
  for (const double volume : mesh.cells.volume.raw()) out.bulk_volume += volume;
  for (const double volume : mesh.cells.pore_volume.raw()) out.pore_volume += volume;
  for (const MeshWell& well : mesh.wells.raw())
    out.well_connections[well.name] = static_cast<std::int64_t>(well.connections.size());
  out.created_by = file.provenance.created_by;
  return out;
}

}  // namespace

GridDescription describe(const CornerPointGrid& grid) {
  GridDescription out;
  out.dimensions = grid.dimensions;
  out.units = std::string(name_of(grid.units));
  out.has_map_axes = grid.mapaxes.has_value();
  out.connects_across_pinch = grid.connects_across_pinch;
  measure_cells(out, grid);
  add_properties(out, grid);
  out.edits = describe_edits(grid);
  return out;
}

WellDescription describe(const Well& well) {
  const Trajectory& path = well.trajectory;
  WellDescription out;
  out.name = well.name;
  out.parent = well.parent;
  out.branch = well.branch;
  out.perforations = well.perforations.size();
  out.stations = path.points.size();
  out.completions = well.completions.size();
  out.is_approximate = well.approximate_path;
  if (!well.completions.empty() || !well.perforations.empty())
    out.type = well.type == WellType::injector ? "injector" : "producer";
  if (path.points.empty()) return out;
  out.measured_depth_from = path.measured_depth.front();
  out.measured_depth_to = path.measured_depth.back();
  out.depth_from = path.points.front().z();
  out.depth_to = path.points.back().z();
  out.largest_deviation = largest_deviation(path);
  out.open_length = well.open.empty() ? out.measured_depth_to - out.measured_depth_from : 0.0;
  for (const MeasuredDepthRange& range : well.open) out.open_length += range.to - range.from;
  return out;
}

namespace {

/// A file of properties alone: its arrays as they stand there.
GridDescription describe(const GridPart& part) {
  GridDescription out;
  out.has_geometry = false;
  out.dimensions = part.dimensions.value_or(std::array<std::int64_t, 3>{});
  out.units = part.units ? std::string(name_of(*part.units)) : "not given";
  out.has_map_axes = part.mapaxes.has_value();
  for (const GridPartArray& array : part.arrays) {
    PropertyRange range{array.name, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                        ""};
    if (array.name == "PORO" || array.name == "NTG") range.unit = "1";
    if (array.name.substr(0, 4) == "PERM") range.unit = "mD";
    const auto add = [&](auto value) {
      if (value == unset_integer || std::isnan(static_cast<double>(value))) return;
      range.least = std::min(range.least, static_cast<double>(value));
      range.most = std::max(range.most, static_cast<double>(value));
    };
    std::visit([&](const auto& values) { std::for_each(values.begin(), values.end(), add); }, array.values);
    if (range.least <= range.most) out.properties.push_back(std::move(range));
  }
  std::sort(out.properties.begin(), out.properties.end(),
            [](const PropertyRange& a, const PropertyRange& b) { return a.name < b.name; });
  return out;
}

/// A file that holds no geometry of its own, and has none beside it in the run: described all the same.
bool describe_properties(const std::string& path, const ReaderFormat& format, FileDescription& out) {
  const bool may_lack_geometry =
      format.read_grid != nullptr && format.read_grid != parse_egrid && format.read_grid != parse_grid_file;
  if (!may_lack_geometry) return false;
  const FileContent content = load_file(path);
  GridPart part = format.read_grid(content.text, content.path);
  if (!part.coord.empty() || !part.zcorn.empty()) return false;
  out.grid = describe(part);
  out.sources.push_back({path, sha256_hex(content.text)});
  for (const std::string& note : part.notes) out.notes.push_back(path + ": " + note);
  return true;
}

struct Exported {
  std::string format;
  ExportedCounts counts;
};

/// A mesh in the format of another program.
std::optional<Exported> exported_file(const std::string& path) {
  const FileContent content = load_file(path);
  const ReaderFormat& format = recognise_content(content);
  if (format.kind != FormatKind::mesh) return {};
  if (!format.is_read) return Exported{std::string(format.name), count_exported_mesh(content.text)};
  const auto found = describe_exported_hdf5(path);
  return found ? std::optional(Exported{std::string(found->format), found->counts}) : std::nullopt;
}

/// What the known files of a folder count together, under the first one's format.
std::optional<Exported> exported_folder(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) return {};
  std::optional<Exported> out;
  for (const std::string_view name : counted_files_of_folders()) {
    const fs::path file = fs::path(path) / name;
    if (!fs::is_regular_file(file, ignored)) continue;
    const auto found = exported_file(file.string());
    if (!found) continue;
    if (!out) out = Exported{found->format, {}};
    const auto take = [](auto& count, const auto& other) {
      if (!count) count = other;
    };
    take(out->counts.cells, found->counts.cells);
    take(out->counts.faces, found->counts.faces);
    take(out->counts.vertices, found->counts.vertices);
    take(out->counts.connections, found->counts.connections);
  }
  return out;
}

/// True, with what it counts, for a mesh in the format of another program.
bool describe_exported_mesh(const std::string& path, FileDescription& out) {
  auto found = exported_folder(path);
  if (!found) found = exported_file(path);
  if (!found) return false;
  out.format = std::move(found->format);
  out.exported = found->counts;
  out.notes.push_back("a mesh for another program: wellknit counts it and does not read it");
  return true;
}

}  // namespace

FileDescription describe_file(const std::string& path,
                              const std::function<GridValidity(const CornerPointGrid&)>& look_at) {
  FileDescription out;
  out.path = path;
  if (describe_exported_mesh(path, out)) return out;
  const ReaderFormat& format = recognise_file(path);
  out.format = std::string(format.name);
  switch (format.kind) {
    case FormatKind::grid: {
      if (describe_properties(path, format, out)) break;
      Case read = read_case(path);
      out.grid = describe(read.grid);
      if (look_at) out.validity = look_at(read.grid);
      for (const Well& well : read.deck_wells) out.wells.push_back(describe(well));
      out.sources = std::move(read.sources);
      out.notes = std::move(read.notes);
      break;
    }
    case FormatKind::wells: {
      TrajectoryFile read = read_trajectory(path, {{}, true});
      for (const Well& well : read.wells) out.wells.push_back(describe(well));
      out.notes = std::move(read.notes);
      break;
    }
    case FormatKind::mesh: out.mesh = describe(read_mesh(path)); break;
  }
  return out;
}

}  // namespace wellknit
