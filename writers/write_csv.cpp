// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/write_csv.h"

#include "writers/text_file.h"
#include "writers/well_cells.h"

namespace wellknit {

namespace {

constexpr std::array<std::string_view, 4> cell_kinds{"host", "refined", "transition", "radial"};
constexpr std::array<std::string_view, 4> connection_kinds{"face", "fault", "nnc", "pinch_out"};

/// A line of fields, with commas between.
class Line {
 public:
  explicit Line(TextFile& out) : out_(out) {}
  ~Line() { out_.end_line(); }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  Line& add(double value) {
    comma();
    out_.number(value);
    return *this;
  }
  Line& add(std::int64_t value) {
    comma();
    out_.integer(value);
    return *this;
  }
  Line& add(std::string_view text) {
    comma();
    out_.text(text);
    return *this;
  }
  Line& add(const Vec3& p) { return add(p.x()).add(p.y()).add(p.z()); }

 private:
  void comma() {
    if (!is_first_) out_.text(",");
    is_first_ = false;
  }
  TextFile& out_;
  bool is_first_ = true;
};

void write_cells(TextFile& out, const Mesh& mesh) {
  out.text(
      "cell,kind,x,y,depth,volume_m3,pore_volume_m3,porosity,net_to_gross,kx_m2,ky_m2,kz_m2,source_cell,well,segment,"
      "sector,ring");
  for (const auto& [name, values] : mesh.cells.properties) out.text("," + csv_field(name));
  out.end_line();
  const Cells& cells = mesh.cells;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const CellId cell(c);
    Line line(out);
    line.add(cell.value()).add(cell_kinds[static_cast<std::size_t>(cells.kind[cell])]);
    line.add(cells.center[cell].x()).add(cells.center[cell].y()).add(cells.depth[cell]);
    line.add(cells.volume[cell]).add(cells.pore_volume[cell]).add(cells.porosity[cell]).add(cells.net_to_gross[cell]);
    line.add(cells.permeability[cell]).add(cells.source_cell[cell].value()).add(cells.well[cell].value());
    const RadialIndex& place = cells.radial_index[cell];
    for (const std::int32_t index : {place.segment, place.sector, place.ring})
      line.add(static_cast<std::int64_t>(index));
    for (const auto& [name, property] : cells.properties) {
      std::visit(
          [&](const auto& values) {
            if constexpr (std::is_integral_v<std::decay_t<decltype(values[c])>>)
              line.add(static_cast<std::int64_t>(values[c]));
            else
              line.add(static_cast<double>(values[c]));
          },
          property);
    }
  }
}

void write_connections(TextFile& out, const Mesh& mesh) {
  out.text(
      "first,second,kind,transmissibility_m3,area_m2,first_distance_m,second_distance_m,normal_x,normal_y,normal_depth,"
      "non_orthogonality_deg,k_non_orthogonality_deg,multiplier\n");
  const Connections& connections = mesh.connections;
  for (std::size_t n = 0; n < connections.size(); ++n) {
    const ConnectionId id(n);
    Line line(out);
    line.add(connections.cells[id][0].value()).add(connections.cells[id][1].value());
    line.add(connection_kinds[static_cast<std::size_t>(connections.kind[id])]);
    line.add(connections.transmissibility[id]).add(connections.area[id]);
    line.add(connections.half_distance[id][0]).add(connections.half_distance[id][1]).add(connections.normal[id]);
    line.add(connections.non_orthogonality[id]).add(connections.k_non_orthogonality[id]);
    line.add(connections.multiplier[id]);
  }
}

}  // namespace

std::vector<std::string> write_csv(const Mesh& mesh, const std::string& path, Overwrite overwrite) {
  OutputFile folder(path, overwrite, csv_contents);
  const auto file = [&](const char* name) { return TextFile(folder.temporary_path() + "/" + name, path); };
  TextFile cells = file("cells.csv");
  write_cells(cells, mesh);
  cells.close();
  TextFile connections = file("connections.csv");
  write_connections(connections, mesh);
  connections.close();
  TextFile wells = file("wells.csv");
  write_well_table(wells, mesh, 0);
  wells.close();
  folder.commit();
  return {};
}

}  // namespace wellknit
