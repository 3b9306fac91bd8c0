// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The two forms of a description: text and JSON.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "readers/describe.h"

namespace wellknit {

namespace {

using Json = nlohmann::ordered_json;

std::string grid_text(const GridDescription& grid) {
  const auto& n = grid.dimensions;
  std::string text = fmt::format("cells         {} x {} x {} = {}, {} active\n", n[0], n[1], n[2], n[0] * n[1] * n[2],
                                 grid.active_cells);
  text += fmt::format("units         {}{}\n", grid.units, grid.has_map_axes ? ", with map axes" : "");
  text += fmt::format("i, j, k       {}-handed (x, y, depth)\n", grid.is_right_handed ? "right" : "left");
  if (grid.inverted_cells > 0)
    text += fmt::format("inverted      {} cells have a volume of the wrong sign\n", grid.inverted_cells);
  text += fmt::format("bulk volume   {:.8g} m3\n", grid.bulk_volume);
  if (grid.pore_volume) text += fmt::format("pore volume   {:.8g} m3\n", *grid.pore_volume);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    static constexpr std::array names{"x", "y", "depth"};
    text += fmt::format("{:<13} {:.3f} to {:.3f} m\n", names[static_cast<std::size_t>(axis)], grid.least[axis],
                        grid.most[axis]);
  }
  for (const PropertyRange& range : grid.properties)
    text += fmt::format("{:<13} {:.6g} to {:.6g}{}\n", range.name, range.least, range.most,
                        range.unit == "mD" ? " mD" : "");
  return text;
}

std::string well_text(const WellDescription& well) {
  std::string text = fmt::format("well {}: {}", well.name, well.type.empty() ? "" : well.type + ", ");
  if (!well.parent.empty()) text += fmt::format("branch {} of {}, ", well.branch, well.parent);
  if (well.perforations > 0) text += fmt::format("{} perforations, ", well.perforations);
  if (well.completions > 0) text += fmt::format("{} completed cells, ", well.completions);
  text += fmt::format(
      "{} stations, measured depth {:.3f} to {:.3f} m, depth {:.3f} to {:.3f} m, up to {:.1f} degrees from the "
      "vertical, open over {:.3f} m",
      well.stations, well.measured_depth_from, well.measured_depth_to, well.depth_from, well.depth_to,
      well.largest_deviation, well.open_length);
  if (well.is_approximate) text += ", path through cell centres";
  return text + "\n";
}

std::string mesh_text(const MeshDescription& mesh) {
  std::int64_t cells = 0;
  std::string kinds;
  for (const auto& [kind, count] : mesh.cells) {
    cells += count;
    kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", count, kind);
  }
  std::string text = fmt::format("cells         {}: {}\n", cells, kinds);
  text += fmt::format("faces         {}\nvertices      {}\nconnections   {}\n", mesh.faces, mesh.vertices,
                      mesh.connections);
  text += fmt::format("bulk volume   {:.8g} m3\npore volume   {:.8g} m3\n", mesh.bulk_volume, mesh.pore_volume);
  for (const auto& [name, count] : mesh.well_connections) text += fmt::format("well {}: {} open cells\n", name, count);
  if (!mesh.created_by.empty()) text += fmt::format("created by    {}\n", mesh.created_by);
  return text;
}

/// JSON has no infinity.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json grid_json(const GridDescription& grid) {
  Json out;
  out["dimensions"] = grid.dimensions;
  out["active_cells"] = grid.active_cells;
  out["inverted_cells"] = grid.inverted_cells;
  out["right_handed"] = grid.is_right_handed;
  out["units"] = grid.units;
  out["map_axes"] = grid.has_map_axes;
  out["connects_across_pinch"] = grid.connects_across_pinch;
  out["bulk_volume"] = number(grid.bulk_volume);
  out["pore_volume"] = grid.pore_volume ? number(*grid.pore_volume) : Json(nullptr);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    out["least"].push_back(number(grid.least[axis]));
    out["most"].push_back(number(grid.most[axis]));
  }
  out["properties"] = Json::object();
  for (const PropertyRange& range : grid.properties)
    out["properties"][range.name] = {
        {"least", number(range.least)}, {"most", number(range.most)}, {"unit", range.unit}};
  return out;
}

Json well_json(const WellDescription& well) {
  return {{"name", well.name},
          {"parent", well.parent.empty() ? Json(nullptr) : Json(well.parent)},
          {"branch", well.branch},
          {"type", well.type.empty() ? Json(nullptr) : Json(well.type)},
          {"stations", well.stations},
          {"measured_depth", {number(well.measured_depth_from), number(well.measured_depth_to)}},
          {"depth", {number(well.depth_from), number(well.depth_to)}},
          {"largest_deviation", number(well.largest_deviation)},
          {"open_length", number(well.open_length)},
          {"completions", well.completions},
          {"perforations", well.perforations},
          {"approximate_path", well.is_approximate}};
}

Json mesh_json(const MeshDescription& mesh) {
  return {{"cells", mesh.cells},
          {"faces", mesh.faces},
          {"vertices", mesh.vertices},
          {"connections", mesh.connections},
          {"bulk_volume", number(mesh.bulk_volume)},
          {"pore_volume", number(mesh.pore_volume)},
          {"well_connections", mesh.well_connections},
          {"created_by", mesh.created_by}};
}

}  // namespace

std::string to_text(const FileDescription& description) {
  std::string text = fmt::format("{}: {}\n", description.path, description.format);
  if (description.grid) text += grid_text(*description.grid);
  if (description.mesh) text += mesh_text(*description.mesh);
  for (const WellDescription& well : description.wells) text += well_text(well);
  for (const SourceFile& source : description.sources)
    text += fmt::format("read {} sha256 {}\n", source.path, source.sha256);
  for (const std::string& note : description.notes) text += fmt::format("note: {}\n", note);
  return text;
}

std::string to_json(const FileDescription& description) {
  Json out;
  out["path"] = description.path;
  out["format"] = description.format;
  if (description.grid) out["grid"] = grid_json(*description.grid);
  if (description.mesh) out["mesh"] = mesh_json(*description.mesh);
  out["wells"] = Json::array();
  for (const WellDescription& well : description.wells) out["wells"].push_back(well_json(well));
  out["sources"] = Json::array();
  for (const SourceFile& source : description.sources)
    out["sources"].push_back({{"path", source.path}, {"sha256", source.sha256}});
  out["notes"] = description.notes;
  // Names in a file may be in any encoding: what is not UTF-8 is replaced.
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace wellknit
