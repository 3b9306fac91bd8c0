// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/write_mrst.h"

#include <fmt/format.h>

#include "model/mesh_topology.h"
#include "writers/mat_file.h"
#include "writers/well_cells.h"

namespace wellknit {

namespace {

using Indices = std::vector<std::int32_t>;
using Numbers = std::vector<double>;

/// Rows of three numbers as three columns.
template <class Rows, class Get>
MatVariable three_columns(const Rows& rows, const Get& get) {
  return MatVariable::numbers(rows.size(), 3, [&rows, get] {
    Numbers values(3 * rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Vec3 row = get(i);
      for (std::size_t axis = 0; axis < 3; ++axis)
        values[axis * rows.size() + i] = row[static_cast<Eigen::Index>(axis)] + 0.0;  // no negative zero
    }
    return values;
  });
}
MatVariable points(const auto& rows) {
  return three_columns(rows, [&rows](std::size_t i) { return rows.raw()[i]; });
}

MatVariable column(const LargeArray<double>& values) {
  return MatVariable::numbers(values.size(), 1, [&values] { return Numbers(values.begin(), values.end()); });
}
template <class Get>
MatVariable column(std::size_t size, const Get& get) {
  return MatVariable::numbers(size, 1, [size, get] {
    Numbers values(size);
    for (std::size_t i = 0; i < size; ++i) values[i] = get(i);
    return values;
  });
}

/// Numbers from 0 as numbers from 1; none becomes 0.
template <class Get>
MatVariable from_one(std::size_t size, const Get& get, std::size_t columns = 1) {
  return MatVariable::indices(size, columns, [size, columns, get] {
    Indices values(size * columns);
    for (std::size_t side = 0; side < columns; ++side)
      for (std::size_t i = 0; i < size; ++i) values[side * size + i] = static_cast<std::int32_t>(get(i, side) + 1);
    return values;
  });
}

MatVariable starts(const std::vector<std::int64_t>& start) {
  return from_one(start.size(), [&start](std::size_t i, std::size_t) { return start[i]; });
}

// The arrays are made when the file is written: what they are made from must live until then.

MatVariable cells_of(const Mesh& mesh, const CellFaces& faces, const MrstOptions& options) {
  const Cells& cells = mesh.cells;
  MatVariable out = MatVariable::structs(
      1, {"num", "facePos", "faces", "indexMap", "volumes", "centroids", "depth", "kind", "sourceCell"});
  out.set("num", MatVariable::number(static_cast<double>(cells.size())));
  out.set("facePos", starts(faces.start));
  out.set("faces", from_one(faces.faces.size(), [&faces](std::size_t i, auto) { return faces.faces[i].face.value(); }));
  out.set("indexMap", from_one(cells.size(), [](std::size_t i, auto) { return static_cast<std::int64_t>(i); }));
  out.set("volumes", column(cells.volume.raw()));
  out.set("centroids", points(options.true_centroids ? cells.centroid : cells.center));
  out.set("depth", column(cells.depth.raw()));
  out.set("kind", column(cells.size(), [&cells](std::size_t i) { return static_cast<double>(cells.kind[CellId(i)]); }));
  out.set("sourceCell",
          from_one(cells.size(), [&cells](std::size_t i, auto) { return cells.source_cell[CellId(i)].value(); }));
  return out;
}

MatVariable faces_of(const Mesh& mesh) {
  const Faces& faces = mesh.faces;
  const auto geometry = [&mesh](std::size_t f) {
    thread_local std::vector<Vec3> buffer;  // one for all faces
    return polygon_geometry(face_points(mesh, FaceId(f), buffer));
  };
  MatVariable out =
      MatVariable::structs(1, {"num", "nodePos", "nodes", "neighbors", "areas", "normals", "centroids", "tag"});
  out.set("num", MatVariable::number(static_cast<double>(faces.size())));
  out.set("nodePos", starts(faces.vertex_start));
  out.set("nodes",
          from_one(faces.vertices.size(), [&faces](std::size_t i, auto) { return faces.vertices[i].value(); }));
  out.set(
      "neighbors",
      from_one(
          faces.size(), [&faces](std::size_t i, std::size_t side) { return faces.cells[FaceId(i)][side].value(); }, 2));
  out.set("areas", column(faces.size(), [geometry](std::size_t f) { return geometry(f).area; }));
  out.set("normals", three_columns(faces.cells, [geometry](std::size_t f) { return geometry(f).area_vector; }));
  out.set("centroids", three_columns(faces.cells, [geometry](std::size_t f) { return geometry(f).centroid; }));
  out.set("tag", from_one(faces.size(), [](std::size_t, auto) { return std::int64_t{-1}; }));
  return out;
}

MatVariable nodes_of(const Mesh& mesh) {
  MatVariable out = MatVariable::structs(1, {"num", "coords"});
  out.set("num", MatVariable::number(static_cast<double>(mesh.vertices.size())));
  out.set("coords", points(mesh.vertices));
  return out;
}

/// What flows between two cells.
struct Links {
  std::vector<std::array<CellId, 2>> cells;
  Numbers transmissibility;

  void add(const std::array<CellId, 2>& pair, double value) {
    cells.push_back(pair);
    transmissibility.push_back(value);
  }
  [[nodiscard]] MatVariable values() const {
    return column(cells.size(), [this](std::size_t i) { return transmissibility[i]; });
  }
  [[nodiscard]] MatVariable pairs() const {
    return from_one(
        cells.size(), [this](std::size_t i, std::size_t side) { return cells[i][side].value(); }, 2);
  }
};

/// Every face between two cells, in order, closed ones too: MRST and Jutul count them so.
Links links_of_faces(const Mesh& mesh) {
  Numbers of_face(mesh.faces.size(), 0.0);
  const Connections& connections = mesh.connections;
  for (std::size_t n = 0; n < connections.size(); ++n) {
    const FaceId face = connections.face[ConnectionId(n)];
    if (face.is_valid()) of_face[face.index()] += connections.transmissibility[ConnectionId(n)];
  }
  Links out;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (mesh.faces.cells[FaceId(f)][1].is_valid()) out.add(mesh.faces.cells[FaceId(f)], of_face[f]);
  return out;
}

Links links_without_face(const Mesh& mesh) {
  Links out;
  const Connections& connections = mesh.connections;
  for (std::size_t n = 0; n < connections.size(); ++n)
    if (!connections.face[ConnectionId(n)].is_valid())
      out.add(connections.cells[ConnectionId(n)], connections.transmissibility[ConnectionId(n)]);
  return out;
}

MatVariable grid(const Mesh& mesh, const CellFaces& faces, const Links& bare, const MrstOptions& options) {
  MatVariable out = MatVariable::structs(1, {"cells", "faces", "nodes", "cartDims", "griddim", "type", "nnc"});
  out.set("cells", cells_of(mesh, faces, options));
  out.set("faces", faces_of(mesh));
  out.set("nodes", nodes_of(mesh));
  out.set("cartDims", MatVariable::numbers(1, 3, [count = static_cast<double>(mesh.cells.size())] {
            return Numbers{count, 1.0, 1.0};
          }));
  out.set("griddim", MatVariable::number(3.0));
  // By the second name Jutul knows that z is depth.
  std::vector<MatVariable> types;
  types.push_back(MatVariable::text("wellknit"));
  types.push_back(MatVariable::text("processGRDECL"));
  out.set("type", MatVariable::cell_row(std::move(types)));
  MatVariable nnc = MatVariable::structs(1, {"cells", "trans"});
  nnc.set("cells", bare.pairs());
  nnc.set("trans", bare.values());
  out.set("nnc", std::move(nnc));
  return out;
}

/// MRST's pore volume is poro times volume: net-to-gross and multipliers are inside.
MatVariable rock(const Cells& cells) {
  MatVariable out = MatVariable::structs(1, {"poro", "perm"});
  out.set("poro", column(cells.size(),
                         [&cells](std::size_t c) { return cells.pore_volume[CellId(c)] / cells.volume[CellId(c)]; }));
  out.set("perm", points(cells.permeability));
  return out;
}

void set_well(MatVariable& wells, const Mesh& mesh, const MeshWell& well, std::size_t n) {
  const std::vector<WellConnection> cells = cells_of_well(well);
  const double reference = reference_depth_of(mesh, well);
  Numbers index;
  Numbers below;
  for (const WellConnection& connection : cells) {
    index.push_back(connection.well_index);
    below.push_back(mesh.cells.depth[connection.cell] - reference);
  }
  const bool injects = well.type == WellType::injector;
  wells.set("name", MatVariable::text(well.name), n);
  wells.set("cells", from_one(cells.size(), [cells](std::size_t i, auto) { return cells[i].cell.value(); }), n);
  wells.set("type", MatVariable::text("bhp"), n);
  wells.set("val", MatVariable::number(std::numeric_limits<double>::quiet_NaN()), n);
  wells.set("sign", MatVariable::number(injects ? 1.0 : -1.0), n);
  wells.set("r", MatVariable::numbers(Numbers(cells.size(), well.bore_radius)), n);
  wells.set("dir", MatVariable::text(std::string(cells.size(), 'z')), n);
  wells.set("WI", MatVariable::numbers(index), n);
  wells.set("dZ", MatVariable::numbers(below), n);
  wells.set("refDepth", MatVariable::number(reference), n);
  wells.set("compi", MatVariable::number(1.0), n);
  wells.set("status", MatVariable::number(1.0), n);
  wells.set("cstatus", MatVariable::numbers(Numbers(cells.size(), 1.0)), n);
  wells.set("lims", MatVariable::numbers({}), n);
}

MatVariable wells_of(const Mesh& mesh) {
  MatVariable out = MatVariable::structs(mesh.wells.size(), {"name", "cells", "type", "val", "sign", "r", "dir", "WI",
                                                             "dZ", "refDepth", "compi", "status", "cstatus", "lims"});
  for (std::size_t n = 0; n < mesh.wells.size(); ++n) set_well(out, mesh, mesh.wells[WellId(n)], n);
  return out;
}

}  // namespace

std::vector<std::string> write_mrst(const Mesh& mesh, const std::string& path, const MrstOptions& options,
                                    Overwrite overwrite) {
  OutputFile file(path, overwrite);
  MatFile out(file.temporary_path(), path);
  const Links bare = links_without_face(mesh);
  {
    const CellFaces faces = faces_of_cells(mesh);
    out.write("G", grid(mesh, faces, bare, options));
  }
  out.write("rock", rock(mesh.cells));
  Links links = links_of_faces(mesh);
  for (std::size_t n = 0; n < bare.cells.size(); ++n) links.add(bare.cells[n], bare.transmissibility[n]);
  out.write("N", links.pairs());
  out.write("T", links.values());
  if (!mesh.wells.empty()) out.write("W", wells_of(mesh));
  out.close();
  file.commit();
  if (mesh.wells.empty()) return {};
  return {"the wells have no targets (W.val is NaN); wellknit_mrst.m sets them"};
}

}  // namespace wellknit
