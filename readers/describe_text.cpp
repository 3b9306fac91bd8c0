// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The two forms of a description: text and JSON.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "readers/describe.h"

namespace wellknit {

namespace {

using Json = nlohmann::ordered_json;

/// "name (count), name (count)".
std::string counted(const std::map<std::string, std::int64_t>& counts) {
  std::string text;
  for (const auto& [name, count] : counts) text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", name, count);
  return text;
}

std::string edits_text(const EditsDescription& edits) {
  std::string text;
  const auto line = [&](std::string_view what, const std::string& value) {
    if (!value.empty()) text += fmt::format("{:<13} {}\n", what, value);
  };
  const auto count = [](std::int64_t n, std::string_view keyword) {
    return n == 0 ? std::string() : fmt::format("{} of {}", n, keyword);
  };
  for (const FaultDescription& fault : edits.faults)
    line("fault", fmt::format("{}: {} faces{}", fault.name, fault.faces,
                              fault.multiplier == 1.0 ? "" : fmt::format(", multiplier {:g}", fault.multiplier)));
  line("multipliers", fmt::format("{}", fmt::join(edits.multipliers, ", ")));
  line("region pairs", count(edits.region_multipliers, "MULTREGT"));
  line("region pores", count(edits.region_pore_volumes, "MULTREGP"));
  line("connections", count(edits.non_neighbours, "NNC"));
  line("edited", count(edits.edited_non_neighbours, "EDITNNC and EDITNNCR"));
  line("array edits", counted(edits.array_edits));
  line("regions", counted(edits.regions));
  return text;
}

std::string ranges_text(const GridDescription& grid) {
  std::string text;
  for (const PropertyRange& range : grid.properties)
    text += fmt::format("{:<13} {:.6g} to {:.6g}{}\n", range.name, range.least, range.most,
                        range.unit == "mD" ? " mD" : "");
  return text;
}

std::string properties_text(const GridDescription& grid) {
  const auto& n = grid.dimensions;
  std::string text = "geometry      none: properties to be read with a grid (--grid-include)\n";
  if (n[0] > 0) text += fmt::format("cells         {} x {} x {} = {}\n", n[0], n[1], n[2], n[0] * n[1] * n[2]);
  return text + fmt::format("units         {}\n", grid.units) + ranges_text(grid);
}

std::string grid_text(const GridDescription& grid) {
  const auto& n = grid.dimensions;
  if (!grid.has_geometry) return properties_text(grid);
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
  return text + ranges_text(grid) + edits_text(grid.edits);
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

Json edits_json(const EditsDescription& edits) {
  Json out;
  out["faults"] = Json::array();
  for (const FaultDescription& fault : edits.faults)
    out["faults"].push_back({{"name", fault.name}, {"faces", fault.faces}, {"multiplier", number(fault.multiplier)}});
  out["multipliers"] = edits.multipliers;
  out["region_multipliers"] = edits.region_multipliers;
  out["region_pore_volumes"] = edits.region_pore_volumes;
  out["non_neighbours"] = edits.non_neighbours;
  out["edited_non_neighbours"] = edits.edited_non_neighbours;
  out["array_edits"] = edits.array_edits;
  out["regions"] = edits.regions;
  return out;
}

Json grid_json(const GridDescription& grid) {
  Json out;
  out["dimensions"] = grid.dimensions;
  out["geometry"] = grid.has_geometry;
  // What depends on the geometry is null without it.
  const auto known = [&](auto value) { return grid.has_geometry ? Json(value) : Json(nullptr); };
  out["active_cells"] = known(grid.active_cells);
  out["inverted_cells"] = known(grid.inverted_cells);
  out["right_handed"] = known(grid.is_right_handed);
  out["units"] = grid.units;
  out["map_axes"] = grid.has_map_axes;
  out["connects_across_pinch"] = grid.connects_across_pinch;
  out["bulk_volume"] = grid.has_geometry ? number(grid.bulk_volume) : Json(nullptr);
  out["pore_volume"] = grid.pore_volume ? number(*grid.pore_volume) : Json(nullptr);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    out["least"].push_back(grid.has_geometry ? number(grid.least[axis]) : Json(nullptr));
    out["most"].push_back(grid.has_geometry ? number(grid.most[axis]) : Json(nullptr));
  }
  out["properties"] = Json::object();
  for (const PropertyRange& range : grid.properties)
    out["properties"][range.name] = {
        {"least", number(range.least)}, {"most", number(range.most)}, {"unit", range.unit}};
  out["edits"] = edits_json(grid.edits);
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

/// The counts that are known, by name.
std::vector<std::pair<std::string, std::int64_t>> known_counts(const ExportedCounts& counts) {
  std::vector<std::pair<std::string, std::int64_t>> out;
  if (counts.cells) out.emplace_back("cells", *counts.cells);
  if (counts.faces) out.emplace_back("faces", *counts.faces);
  if (counts.vertices) out.emplace_back("vertices", *counts.vertices);
  if (counts.connections) out.emplace_back("connections", *counts.connections);
  return out;
}

std::string exported_text(const ExportedCounts& counts) {
  std::string text;
  for (const auto& [name, count] : known_counts(counts)) text += fmt::format("{:<13} {}\n", name, count);
  return text;
}

Json exported_json(const ExportedCounts& counts) {
  Json out = Json::object();
  for (const auto& [name, count] : known_counts(counts)) out[name] = count;
  return out;
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
  if (description.exported) text += exported_text(*description.exported);
  for (const WellDescription& well : description.wells) text += well_text(well);
  for (const SourceFile& source : description.sources)
    text += fmt::format("read {} sha256 {}\n", source.path, source.sha256);
  if (description.validity)
    for (const std::string& line : to_lines(*description.validity)) text += fmt::format("grid: {}\n", line);
  for (const std::string& note : description.notes) text += fmt::format("note: {}\n", note);
  return text;
}

std::string to_json(const FileDescription& description) {
  Json out;
  out["path"] = description.path;
  out["format"] = description.format;
  if (description.grid) out["grid"] = grid_json(*description.grid);
  if (description.mesh) out["mesh"] = mesh_json(*description.mesh);
  if (description.exported) out["exported"] = exported_json(*description.exported);
  out["wells"] = Json::array();
  for (const WellDescription& well : description.wells) out["wells"].push_back(well_json(well));
  out["sources"] = Json::array();
  for (const SourceFile& source : description.sources)
    out["sources"].push_back({{"path", source.path}, {"sha256", source.sha256}});
  if (description.validity) out["validity"] = Json::parse(to_json(*description.validity));
  out["notes"] = description.notes;
  // Names in a file may be in any encoding: what is not UTF-8 is replaced.
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace wellknit
