// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <fmt/format.h>

#include <algorithm>

#include "model/mesh_arrays.h"
#include "model/mesh_check.h"

namespace wellknit {

namespace {

class StructureCheck {
 public:
  explicit StructureCheck(const Mesh& mesh) : mesh_(mesh) {}

  std::vector<Violation> run() {
    lengths();
    faces();
    cells();
    connections();
    wells();
    transfer();
    stencils();
    flow();
    return std::move(violations_);
  }

 private:
  void add(std::string check, std::string entity, std::string detail) {
    violations_.push_back({std::move(check), std::move(entity), std::move(detail)});
  }

  void expect_length(const std::string& array, std::size_t found, std::size_t expected) {
    if (found != expected)
      add("array of a wrong length", array, fmt::format("{} values where {} are expected", found, expected));
  }

  /// `index` must lie in [lowest, count).
  void expect_index(std::int64_t index, std::int64_t lowest, std::size_t count, const char* array, std::size_t entry) {
    if (index < lowest || index >= static_cast<std::int64_t>(count))
      add("index out of range", fmt::format("{}[{}]", array, entry),
          fmt::format("{} is not in {} to {}", index, lowest, static_cast<std::int64_t>(count) - 1));
  }

  /// Offsets from 0 to `size` that never fall; `count` of them plus one.
  void expect_offsets(const std::vector<std::int64_t>& start, std::size_t count, std::size_t size, const char* array) {
    expect_length(array, start.size(), count + 1);
    if (start.empty()) return;
    if (start.front() != 0) add("offsets do not start at 0", array, fmt::format("the first is {}", start.front()));
    if (start.back() != static_cast<std::int64_t>(size))
      add("offsets do not end at the size of their array", array,
          fmt::format("the last is {}, the size {}", start.back(), size));
    for (std::size_t i = 0; i + 1 < start.size(); ++i)
      if (start[i + 1] < start[i])
        add("offsets fall", fmt::format("{}[{}]", array, i + 1), fmt::format("{} after {}", start[i + 1], start[i]));
  }

  void lengths() {
    for_each_array(mesh_, [&](std::string_view path, const auto& values) {
      if (path.starts_with("cells/")) expect_length(std::string(path), values.size(), mesh_.cells.size());
      if (path.starts_with("connections/")) expect_length(std::string(path), values.size(), mesh_.connections.size());
    });
    for (const auto& [keyword, property] : mesh_.cells.properties)
      std::visit(
          [&, &key = keyword](const auto& values) {
            expect_length("cells/properties/" + key, values.size(), mesh_.cells.size());
          },
          property);
  }

  void faces() {
    const Faces& faces = mesh_.faces;
    expect_offsets(faces.vertex_start, faces.size(), faces.vertices.size(), "faces/vertex_start");
    for (std::size_t i = 0; i < faces.vertices.size(); ++i)
      expect_index(faces.vertices[i].value(), 0, mesh_.vertices.size(), "faces/vertices", i);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto& pair = faces.cells[FaceId(f)];
      expect_index(pair[0].value(), 0, mesh_.cells.size(), "faces/cells", f);
      expect_index(pair[1].value(), -1, mesh_.cells.size(), "faces/cells", f);
    }
  }

  void cells() {
    const Cells& cells = mesh_.cells;
    const auto [nx, ny, nz] = mesh_.source_dimensions;
    const auto source_cells = static_cast<std::size_t>(std::max<std::int64_t>(0, nx * ny * nz));
    for (std::size_t c = 0; c < cells.kind.size(); ++c)
      if (cells.kind[CellId(c)] > CellKind::radial)
        add("kind out of range", fmt::format("cells/kind[{}]", c),
            fmt::format("{}", static_cast<int>(cells.kind[CellId(c)])));
    for (std::size_t c = 0; c < cells.source_cell.size(); ++c)
      expect_index(cells.source_cell[CellId(c)].value(), -1, source_cells, "cells/source_cell", c);
    for (std::size_t c = 0; c < cells.well.size(); ++c)
      expect_index(cells.well[CellId(c)].value(), -1, mesh_.wells.size(), "cells/well", c);
  }

  void connections() {
    const Connections& connections = mesh_.connections;
    if (!connections.linear_flux_error.empty())
      expect_length("connections/linear_flux_error", connections.linear_flux_error.size(), connections.size());
    for (std::size_t i = 0; i < connections.cells.size(); ++i)
      for (const CellId cell : connections.cells[ConnectionId(i)])
        expect_index(cell.value(), 0, mesh_.cells.size(), "connections/cells", i);
    for (std::size_t i = 0; i < connections.face.size(); ++i)
      expect_index(connections.face[ConnectionId(i)].value(), -1, mesh_.faces.size(), "connections/face", i);
    for (std::size_t i = 0; i < connections.kind.size(); ++i)
      if (connections.kind[ConnectionId(i)] > ConnectionKind::pinch_out)
        add("kind out of range", fmt::format("connections/kind[{}]", i),
            fmt::format("{}", static_cast<int>(connections.kind[ConnectionId(i)])));
  }

  void wells() {
    for (const MeshWell& well : mesh_.wells) {
      expect_length(fmt::format("measured depths of well {}", well.name), well.trajectory.measured_depth.size(),
                    well.trajectory.points.size());
      const std::string array = fmt::format("cells of well {}", well.name);
      for (std::size_t i = 0; i < well.connections.size(); ++i)
        expect_index(well.connections[i].cell.value(), 0, mesh_.cells.size(), array.c_str(), i);
    }
  }

  void transfer() {
    const Transfer& transfer = mesh_.transfer;
    if (transfer.start.empty() && transfer.cell.empty() && transfer.fraction.empty()) return;
    const auto [nx, ny, nz] = mesh_.source_dimensions;
    expect_offsets(transfer.start, static_cast<std::size_t>(std::max<std::int64_t>(0, nx * ny * nz)),
                   transfer.cell.size(), "transfer/start");
    expect_length("transfer/fraction", transfer.fraction.size(), transfer.cell.size());
    for (std::size_t i = 0; i < transfer.cell.size(); ++i)
      expect_index(transfer.cell[i].value(), 0, mesh_.cells.size(), "transfer/cell", i);
    const auto& [bulk, pores] = mesh_.source_volumes;
    if (bulk.empty() && pores.empty()) return;
    expect_length("transfer/source_volume", bulk.size(), transfer.start.size() - 1);
    expect_length("transfer/source_pore_volume", pores.size(), transfer.start.size() - 1);
  }

  void stencils() {
    if (!mesh_.stencils) return;
    const FluxStencils& s = *mesh_.stencils;
    expect_offsets(s.start, mesh_.connections.size(), s.cells.size(), "stencils/start");
    expect_length("stencils/coefficients", s.coefficients.size(), s.cells.size());
    for (std::size_t i = 0; i < s.cells.size(); ++i)
      expect_index(s.cells[i].value(), 0, mesh_.cells.size(), "stencils/cells", i);
    for (std::size_t i = 0; i < s.boundary_face.size(); ++i)
      expect_index(s.boundary_face[i].value(), 0, mesh_.faces.size(), "stencils/boundary_face", i);
    expect_length("stencils/boundary_transmissibility", s.boundary_transmissibility.size(), s.boundary_face.size());
    expect_offsets(s.boundary_start, s.boundary_face.size(), s.boundary_cells.size(), "stencils/boundary_start");
    expect_length("stencils/boundary_coefficients", s.boundary_coefficients.size(), s.boundary_cells.size());
    for (std::size_t i = 0; i < s.boundary_cells.size(); ++i)
      expect_index(s.boundary_cells[i].value(), 0, mesh_.cells.size(), "stencils/boundary_cells", i);
  }

  void flow() {
    if (!mesh_.flow) return;
    expect_length("flow/pressure", mesh_.flow->pressure.size(), mesh_.cells.size());
    expect_length("flow/flux", mesh_.flow->flux.size(), mesh_.connections.size());
    expect_length("flow/well_pressure", mesh_.flow->well_pressure.size(), mesh_.wells.size());
    expect_length("flow/well_rate", mesh_.flow->well_rate.size(), mesh_.wells.size());
    std::size_t connections = 0;
    for (const MeshWell& well : mesh_.wells) connections += well.connections.size();
    expect_length("flow/well_connection_rate", mesh_.flow->well_connection_rate.size(), connections);
  }

  const Mesh& mesh_;
  std::vector<Violation> violations_;
};

}  // namespace

std::vector<Violation> check_structure(const Mesh& mesh) { return StructureCheck(mesh).run(); }

}  // namespace wellknit
