// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/well_cells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace wellknit {

std::vector<WellConnection> cells_of_well(const MeshWell& well) {
  std::vector<WellConnection> out;
  std::map<CellId, std::size_t> place;
  for (const WellConnection& connection : well.connections) {
    const auto [known, is_new] = place.emplace(connection.cell, out.size());
    if (is_new) {
      out.push_back(connection);
      continue;
    }
    WellConnection& sum = out[known->second];
    sum.well_index += connection.well_index;
    sum.measured_depth.from = std::min(sum.measured_depth.from, connection.measured_depth.from);
    sum.measured_depth.to = std::max(sum.measured_depth.to, connection.measured_depth.to);
  }
  return out;
}

std::vector<double> permeability_thicknesses(const Mesh& mesh, const MeshWell& well) {
  std::map<std::pair<double, double>, int> around;
  for (const WellConnection& c : well.connections) ++around[{c.measured_depth.from, c.measured_depth.to}];
  std::vector<double> out;
  for (const WellConnection& c : well.connections) {
    const Vec3& k = mesh.cells.permeability[c.cell];
    const double length = std::abs(c.measured_depth.to - c.measured_depth.from);
    const double kh =
        std::sqrt(std::max(0.0, k.x() * k.y())) * length / around[{c.measured_depth.from, c.measured_depth.to}];
    // Without a length or a permeability: what the factor alone would say at an equivalent radius of e times the
    // bore's.
    out.push_back(kh > 0.0 ? kh : c.well_index / (2.0 * std::numbers::pi));
  }
  return out;
}

double reference_depth_of(const Mesh& mesh, const MeshWell& well) {
  if (well.reference_depth) return *well.reference_depth;
  if (well.connections.empty()) return 0.0;
  const auto depth = [&](const WellConnection& connection) { return mesh.cells.depth[connection.cell]; };
  return depth(*std::min_element(well.connections.begin(), well.connections.end(),
                                 [&](const auto& a, const auto& b) { return depth(a) < depth(b); }));
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

void write_well_table(TextFile& out, const Mesh& mesh, std::int64_t first_cell) {
  out.text("well,type,cell,well_index_m3,md_from_m,md_to_m,reference_depth_m\n");
  for (const MeshWell& well : mesh.wells) {
    const std::string name = csv_field(well.name);
    const double reference = reference_depth_of(mesh, well);
    for (const WellConnection& connection : cells_of_well(well)) {
      out.print("{},{},{}", name, well.type == WellType::injector ? "injector" : "producer",
                connection.cell.value() + first_cell);
      for (const double value :
           {connection.well_index, connection.measured_depth.from, connection.measured_depth.to, reference}) {
        out.text(",");
        out.number(value);
      }
      out.end_line();
    }
  }
}

}  // namespace wellknit
